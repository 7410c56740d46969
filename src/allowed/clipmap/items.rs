//! What tiles are drawn from: the areas of items as rings, their strokes as chunks of segments, found by boxes.
//!
//! How a stroke becomes triangles is data that a bundle hands to its clients: the technique's tessellation. What they cover is decided here.

use crate::draw_list::{Chain, DrawList, Role, Side};
use crate::error::{Error, Result};
use crate::index::BoxTree;
use crate::math;
use crate::resolve::{Compositor, Paint};
use crate::scene::{Rule, Scene, Width};
use crate::space::{Plan, PlanBox};
use crate::technique::clipmap::tessellation::{Polyline, Rule as Tessellation, Sagitta, Strips};
use crate::technique::clipmap::{Joints, PixelWidth, Settings, Solution};
use std::ops::Range;

/// Segments of a chunk.
const CHUNK: usize = 32;

/// How far a circle's sides may stay within it where strips are made as finely as a level needs, texels.
pub(super) const ROUND_TEXELS: f64 = 1.0 / 640.0;

/// How strokes of a style are drawn.
#[derive(Debug, Clone)]
pub(super) struct StrokeStyle {
    tessellation: Tessellation,
    width: Width,
    is_point: bool,
    /// The side of the item's area that counts, and what is inside of the area.
    pub(super) cut: Option<(Side, Rule)>,
}

/// How items of a style are drawn.
#[derive(Debug, Clone)]
pub(super) enum Drawn {
    /// An area, by its rule.
    Fill(Rule),
    /// A stroke.
    Stroke(StrokeStyle),
}

/// Consecutive segments of a stroke.
#[derive(Debug, Clone)]
pub(super) struct Chunk {
    pub(super) item: u32,
    chain: Chain,
    segments: Range<usize>,
}

/// All items.
pub(super) struct Items<'a> {
    pub(super) list: &'a DrawList,
    settings: Settings,
    /// By style.
    drawn: Vec<(Drawn, Paint)>,
    chunks: Vec<Chunk>,
    chunk_index: BoxTree,
    areas: Vec<u32>,
    area_index: BoxTree,
    /// How far strokes of widths in metres reach from their vertices, metres, and those of widths in pixels, pixels.
    reach: [f64; 2],
    /// A pixel's size where widths in pixels follow it, metres.
    pixel_m: f64,
}

/// What of an item lies near a tile.
#[derive(Debug)]
pub(super) enum Near<'c> {
    Area(u32),
    Stroke(u32, &'c [u32]),
}

/// How a stroke is drawn in a level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Way {
    /// Its width, metres.
    pub(super) width_m: f64,
    /// Whether by line primitives.
    pub(super) is_lines: bool,
    sagitta: f64,
}

impl<'a> Items<'a> {
    /// The items of a list; `pixel_m` is a pixel's size at the distance of what the middle of the picture shows.
    ///
    /// # Errors
    /// When lines cannot be tessellated so.
    pub(super) fn new(list: &'a DrawList, scene: &Scene, settings: Settings, pixel_m: f64) -> Result<Self> {
        let compositor = Compositor::new(scene.compositing);
        let drawn = |style: &crate::draw_list::ItemStyle| {
            let drawn = match &style.stroke {
                None => Drawn::Fill(style.rule),
                Some(line) => {
                    let is_point = style.role == Role::Point;
                    let joints = if is_point { Joints::Style } else { settings.joints };
                    Drawn::Stroke(StrokeStyle {
                        tessellation: Tessellation::of_line(joints, settings.angle_deg, line)?,
                        width: line.width,
                        is_point,
                        cut: style.cut.map(|side| (side, style.rule)),
                    })
                }
            };
            Ok((drawn, compositor.paint(style.paint)))
        };
        let drawn = list.styles().iter().map(drawn).collect::<Result<Vec<_>>>()?;
        let mut items = Self {
            list,
            settings,
            drawn,
            chunks: Vec::new(),
            chunk_index: BoxTree::default(),
            areas: Vec::new(),
            area_index: BoxTree::default(),
            reach: [0.0; 2],
            pixel_m,
        };
        items.collect()?;
        Ok(items)
    }

    fn collect(&mut self) -> Result<()> {
        let (mut of_chunks, mut of_areas) = (Vec::new(), Vec::new());
        for (number, item) in self.list.numbered() {
            let style = match &self.drawn[item.style as usize].0 {
                Drawn::Fill(_) => {
                    self.areas.push(number);
                    let rings = self.list.border(item).iter();
                    let vertices = rings.flat_map(|ring| self.list.vertices_of(ring)).copied();
                    of_areas.push(PlanBox::around(vertices));
                    continue;
                }
                Drawn::Stroke(style) => style,
            };
            for chain in self.list.strokes(item) {
                let line = Polyline { vertices: self.list.vertices_of(chain), is_loop: chain.is_closed };
                let (unit, width) = match style.width {
                    Width::Metres(width) => (0, width),
                    Width::Pixels(width) => (1, width),
                };
                let reach = 0.5 * width * style.tessellation.reach(&line);
                self.reach[unit] = math::max(self.reach[unit], reach);
                let count = line.segments();
                let path = self.list.path_of(chain);
                for first in (0..count.max(1)).step_by(CHUNK) {
                    let segments = first..count.min(first + CHUNK);
                    let vertices = path[first..=segments.end.max(first)].iter();
                    of_chunks.push(PlanBox::around(vertices.copied()));
                    self.chunks.push(Chunk { item: number, chain: *chain, segments });
                }
            }
        }
        if self.chunks.len().max(self.areas.len()) > u32::MAX as usize / 2 {
            return Err(Error::unsupported("more vertices than this program can number"));
        }
        (self.chunk_index, self.area_index) = (BoxTree::new(&of_chunks), BoxTree::new(&of_areas));
        Ok(())
    }

    /// How an item is drawn, and its paint.
    pub(super) fn drawn(&self, item: u32) -> (&Drawn, Paint) {
        let (drawn, paint) = &self.drawn[self.list.items()[item as usize].style as usize];
        (drawn, *paint)
    }

    /// A width in a level of texels of a size, metres.
    fn width_m(&self, width: Width, texel_m: f64) -> f64 {
        match (width, self.settings.pixel_width) {
            (Width::Metres(width), _) => width,
            (Width::Pixels(pixels), PixelWidth::Distance) => pixels * self.pixel_m,
            (Width::Pixels(texels), PixelWidth::Texels) => texels * texel_m,
        }
    }

    /// Calls `visit` with what may lie in a window of a level of texels of a size, in draw order.
    pub(super) fn near(&self, window: &PlanBox, texel_m: f64, visit: &mut dyn FnMut(Near)) {
        let [metres, pixels] = self.reach;
        let reach = math::max(metres, self.width_m(Width::Pixels(pixels), texel_m));
        let chunks = self.chunk_index.found(&window.grown(reach + 4.0 * texel_m));
        let areas = self.area_index.found(&window.grown(2.0 * texel_m));
        let mut areas = areas.iter().map(|area| self.areas[*area as usize]).peekable();
        for stroke in chunks.chunk_by(|a, b| self.chunk(*a).item == self.chunk(*b).item) {
            let item = self.chunk(stroke[0]).item;
            while let Some(area) = areas.next_if(|area| *area < item) {
                visit(Near::Area(area));
            }
            visit(Near::Stroke(item, stroke));
        }
        areas.for_each(|area| visit(Near::Area(area)));
    }

    fn chunk(&self, number: u32) -> &Chunk {
        &self.chunks[number as usize]
    }

    /// How strokes of a style are drawn in a level of texels of a size.
    pub(super) fn way(&self, style: &StrokeStyle, texel_m: f64) -> Way {
        let width_m = self.width_m(style.width, texel_m);
        let width = width_m / texel_m;
        let is_lines = match self.settings.solution {
            _ if style.is_point => false,
            Solution::Lines => true,
            Solution::Polygons => false,
            Solution::Both | Solution::Wireframe | Solution::Adjacency | Solution::Offsets => {
                width < self.settings.threshold_texels
            }
        };
        let is_stored = !style.is_point
            && match self.settings.solution {
                Solution::Offsets => true,
                Solution::Polygons | Solution::Wireframe | Solution::Both => {
                    matches!(style.width, Width::Metres(_))
                }
                Solution::Lines | Solution::Adjacency => false,
            };
        let sagitta = match is_stored {
            true => Sagitta::DEFAULT.0,
            false => math::min(2.0 * ROUND_TEXELS / math::max(width, 1e-9), 0.05),
        };
        Way { width_m, is_lines, sagitta }
    }

    /// Calls `visit` with the strips of chunks of a stroke: pairs of vertices, left and right.
    pub(super) fn strips(
        &self,
        (style, way): (&StrokeStyle, &Way),
        chunks: &[u32],
        visit: &mut dyn FnMut(&[[Plan; 2]]),
    ) {
        let mut strips = Strips::default();
        for chunk in chunks.iter().map(|chunk| self.chunk(*chunk)) {
            let vertices = self.list.vertices_of(&chunk.chain);
            let line = Polyline { vertices, is_loop: chunk.chain.is_closed };
            let (half, sagitta) = (0.5 * way.width_m, Sagitta(way.sagitta));
            strips.clear();
            match vertices {
                [at] => style.tessellation.dot(*at, half, sagitta, &mut strips),
                _ => style.tessellation.part(&line, chunk.segments.clone(), half, sagitta, &mut strips),
            }
            for strip in strips.iter() {
                let pairs: Vec<[Plan; 2]> = strip.iter().map(|v| [v.at + v.left, v.at + v.right]).collect();
                visit(&pairs);
            }
        }
    }

    /// Calls `visit` with the segments that are line primitives of chunks of a stroke.
    pub(super) fn segments(
        &self,
        (style, way): (&StrokeStyle, &Way),
        chunks: &[u32],
        visit: &mut dyn FnMut([Plan; 2]),
    ) {
        let is_wireframe =
            self.settings.solution == Solution::Wireframe && matches!(style.width, Width::Metres(_));
        if is_wireframe {
            // The sides of the quadrilaterals.
            return self.strips((style, way), chunks, &mut |strip| {
                for pair in strip.windows(2) {
                    let ([a, b], [c, d]) = (pair[0], pair[1]);
                    [[a, b], [b, d], [d, c], [c, a]].into_iter().for_each(&mut *visit);
                }
            });
        }
        for chunk in chunks.iter().map(|chunk| self.chunk(*chunk)).filter(|chunk| !chunk.segments.is_empty())
        {
            let path = &self.list.path_of(&chunk.chain)[chunk.segments.start..=chunk.segments.end];
            path.windows(2).for_each(|pair| visit([pair[0], pair[1]]));
        }
    }

    /// Calls `visit` with the edges of the rings around an item's area.
    pub(super) fn rings(&self, item: u32, visit: &mut dyn FnMut(Plan, Plan)) {
        for ring in self.list.border(&self.list.items()[item as usize]) {
            let vertices = self.list.vertices_of(ring);
            let ends = vertices.iter().cycle().skip(1);
            vertices.iter().zip(ends).for_each(|(from, to)| visit(*from, *to));
        }
    }
}
