//! The vertex sequences of all lines, each line whole: an output to compare one's own tessellation with.

use super::prepare::Prepare;
use super::tessellation::{Polyline, Rule, Sagitta, Strips};
use crate::buffer::{Plane, Values};
use crate::error::Result;
use crate::scene::{Line, Shape, Width, distinct_vertices};
use crate::space::Plan;

/// A strip among the vertices of all strips.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StripOf {
    /// The layer's number in the scene.
    pub layer: u32,
    /// The feature's number in the layer.
    pub feature: u32,
    /// The number of its line or ring in the feature.
    pub part: u32,
    /// The first vertex.
    pub first: u32,
    /// How many there are.
    pub count: u32,
}

/// Strips and their vertices: left, right, left, right, ... (Taibo et al. 2014, 4.2).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sequences {
    /// All vertices, scene-local.
    pub vertices: Vec<Plan>,
    /// The strips, in draw order.
    pub strips: Vec<StripOf>,
}

impl Prepare<'_> {
    /// The vertex sequences of all lines and outlines; widths in pixels are multiples of a pixel's size in metres.
    ///
    /// # Errors
    /// Internal errors only.
    pub fn sequences(&self, pixel_m: f64) -> Result<Sequences> {
        let mut all = Sequences::default();
        for (number, layer) in self.stage.scene.layers.iter().enumerate() {
            for (feature, of) in layer.features.iter().enumerate() {
                let style = layer.style_of(of);
                let (line, parts, is_ring) = match (&of.shape, &style.line, &style.outline) {
                    (Shape::Line(parts), Some(line), _) => (line, parts, false),
                    (Shape::Polygon(rings), _, Some(outline)) => (&outline.line, rings, true),
                    _ => continue,
                };
                for (part, vertices) in parts.iter().enumerate() {
                    let strip = StripOf {
                        layer: number as u32,
                        feature: feature as u32,
                        part: part as u32,
                        first: 0,
                        count: 0,
                    };
                    self.add_sequence(vertices, (line, is_ring), pixel_m, strip, &mut all)?;
                }
            }
        }
        Ok(all)
    }

    fn add_sequence(
        &self,
        vertices: &[Plan],
        (line, is_ring): (&Line, bool),
        pixel_m: f64,
        strip: StripOf,
        all: &mut Sequences,
    ) -> Result<()> {
        let mut vertices = distinct_vertices(vertices);
        let returns = vertices.len() > 1 && vertices.first() == vertices.last();
        let is_loop = if is_ring { vertices.len() > 1 } else { returns && vertices.len() > 3 };
        if is_loop && returns {
            vertices.pop();
        }
        // A dot has no segments (and a style's cap of it no sequence).
        if vertices.len() < 2 {
            return Ok(());
        }
        let width = match line.width {
            Width::Metres(width) => width,
            Width::Pixels(pixels) => pixels * pixel_m,
        };
        let rule = Rule::of_line(self.settings.joints, self.settings.angle_deg, line)?;
        let mut strips = Strips::default();
        let polyline = Polyline { vertices: &vertices, is_loop };
        rule.tessellate(&polyline, width, Sagitta::DEFAULT, &mut strips)?;
        for one in strips.iter() {
            let first = all.vertices.len() as u32;
            all.strips.push(StripOf { first, count: 2 * one.len() as u32, ..strip });
            all.vertices.extend(one.iter().map(|v| v.pair(1.0)).flat_map(|pair| [pair.left, pair.right]));
        }
        Ok(())
    }
}

impl Sequences {
    /// The vertices as a buffer: a row each, x and y.
    pub(super) fn vertices_plane(&self) -> Plane {
        let values = Values::F64(self.vertices.iter().flat_map(|p| [p.x, p.y]).collect());
        Plane { name: "vertices", width: 2, height: self.vertices.len(), components: 1, values }
    }

    /// The strips as a buffer: a row each, layer, feature, part, first vertex and how many there are.
    pub(super) fn strips_plane(&self) -> Plane {
        let row = |s: &StripOf| [s.layer, s.feature, s.part, s.first, s.count];
        let values = Values::U32(self.strips.iter().flat_map(row).collect());
        Plane { name: "strips", width: 5, height: self.strips.len(), components: 1, values }
    }
}
