//! Vector data -> polyhedra (4.1, Fig. 3).
//!
//! Input: the scene's layers, the terrain. Output: [`Extrusion`]: objects in draw order, the volumes that each consists of, and
//! the passes that share a mask (4.2). A volume stands on rings of the plan between two levels just below and just
//! above the terrain under it. Refuses: nothing; what has no area or no terrain under it has no volume.
//!
//! Where the paper is silent:
//! - Extrusion runs along the nadir of a plan: straight down and up ([`nadir`]); walls are vertical.
//! - Caps keep a distance from the terrain: a 32nd of the heights under the volume and a 512th of its extent, so that flat
//!   ground has a volume and a rounded depth does not meet its cap.
//! - A polygon's rule is the stencil test's read mask: all bits for `nonzero`, the lowest one for `even-odd`. Those of the
//!   latter kind share no mask with others, since overlaps would cancel.
//! - An outline that is cut to the inside or outside of its polygon counts the polygon first, keeps the result in one bit of the
//!   stencil, and counts the stroke in the others.

use super::heights::{Region, heights_under};
use super::stroke::Stroke;
use crate::parallel;
use crate::scene::{Color, Feature, Layer, Outline, OutlineMode, Rule, Shape, Style};
use crate::space::{Plan, PlanBox, World};
use crate::technique::stencil_volume::{Grouping, Settings, VolumeJoins};
use crate::terrain::Mesh;
use std::ops::Range;

/// Where a plan point lies at a height: the direction of extrusion.
#[inline(always)]
pub fn nadir(plan: Plan, height: f64) -> World {
    World::new(plan.x, plan.y, height)
}

/// A polyhedron: rings of the plan between two levels.
#[derive(Debug, Clone)]
pub struct Volume {
    /// Its rings, as a range of [`Extrusion::rings`].
    pub rings: Range<u32>,
    /// The level of the bottom cap.
    pub low: f64,
    /// The level of the top cap; not above `low`: there is no terrain and so no volume.
    pub high: f64,
    /// The rectangle around its footprint.
    pub plan: PlanBox,
    /// Whether it is one convex ring of at most four corners, counter-clockwise: its caps are one face each.
    pub is_box: bool,
}

/// A set of plan points that is painted in one go: a fill, a line, an outline.
#[derive(Debug, Clone, PartialEq)]
pub struct Object {
    /// What it is painted with.
    pub color: Color,
    /// Which counts are inside.
    pub rule: Rule,
    /// Its volumes.
    pub volumes: Range<u32>,
    /// For an outline that is cut: the polygon's volumes and its rule, and whether the points in it (or those outside) count.
    pub cut: Option<(Range<u32>, Rule, bool)>,
}

/// Objects that share a mask.
#[derive(Debug, Clone, PartialEq)]
pub struct Pass {
    /// Their numbers, in draw order; they have one colour and one rule.
    pub objects: Vec<u32>,
}

/// All that is extruded.
#[derive(Debug, Default)]
pub struct Extrusion {
    /// Corners of all rings.
    pub corners: Vec<Plan>,
    /// Rings as ranges of corners.
    pub rings: Vec<Range<u32>>,
    /// Volumes, by object.
    pub volumes: Vec<Volume>,
    /// Objects in draw order.
    pub objects: Vec<Object>,
    /// Passes in draw order.
    pub passes: Vec<Pass>,
}

impl Extrusion {
    /// Extrudes all layers.
    pub fn new(layers: &[Layer], mesh: &Mesh, settings: &Settings) -> Self {
        let mut all = Self::default();
        for layer in layers {
            for feature in &layer.features {
                all.add_feature(layer.style_of(feature), feature, settings.joins);
            }
        }
        let levels = parallel::map(&all.volumes, |volume| all.levels(mesh, volume));
        for (volume, (low, high)) in all.volumes.iter_mut().zip(levels) {
            (volume.low, volume.high) = (low, high);
        }
        all.group(settings.grouping);
        all
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.corners[..])
            + size_of_val(&self.rings[..])
            + size_of_val(&self.volumes[..])
            + size_of_val(&self.objects[..])
            + self.passes.iter().map(|p| size_of::<Pass>() + size_of_val(&p.objects[..])).sum::<usize>()
    }

    /// The corners of each ring of a volume.
    pub fn rings_of(&self, volume: &Volume) -> impl Iterator<Item = &[Plan]> + Clone {
        let rings = &self.rings[volume.rings.start as usize..volume.rings.end as usize];
        rings.iter().map(|ring| &self.corners[ring.start as usize..ring.end as usize])
    }

    fn add_feature(&mut self, style: &Style, feature: &Feature, joins: VolumeJoins) {
        match &feature.shape {
            Shape::Polygon(rings) => self.add_polygon(style, rings, joins),
            Shape::Line(parts) => {
                let Some(line) = &style.line else { return };
                let first = self.volumes.len();
                if let Some(stroke) = Stroke::new(line, joins) {
                    parts.iter().for_each(|part| stroke.open(part, &mut |ring| self.add_convex(ring)));
                }
                self.add_object(line.color, Rule::NonZero, first, None);
            }
        }
    }

    fn add_polygon(&mut self, style: &Style, rings: &[Vec<Plan>], joins: VolumeJoins) {
        let rule = style.fill.map_or(Rule::EvenOdd, |fill| fill.rule);
        let outline = style.outline;
        let needs_inside = outline.is_some_and(|o| o.mode != OutlineMode::Normal);
        let first = self.volumes.len();
        if style.fill.is_some() || needs_inside {
            self.add_volume(rings);
        }
        let inside = first as u32..self.volumes.len() as u32;
        if let Some(fill) = style.fill {
            self.add_object(fill.color, rule, first, None);
        }
        if let Some(outline) = outline {
            self.add_outline(rings, &outline, (inside, rule), joins);
        }
    }

    fn add_outline(
        &mut self,
        rings: &[Vec<Plan>],
        outline: &Outline,
        (inside, rule): (Range<u32>, Rule),
        joins: VolumeJoins,
    ) {
        let first = self.volumes.len();
        if let Some(stroke) = Stroke::new(&outline.line, joins) {
            rings.iter().for_each(|ring| stroke.closed(ring, &mut |ring| self.add_convex(ring)));
        }
        let cut = match outline.mode {
            OutlineMode::Normal => None,
            OutlineMode::Inset => Some((inside, rule, true)),
            OutlineMode::Offset => Some((inside, rule, false)),
        };
        self.add_object(outline.line.color, Rule::NonZero, first, cut);
    }

    fn add_object(&mut self, color: Color, rule: Rule, first: usize, cut: Option<(Range<u32>, Rule, bool)>) {
        let volumes = first as u32..self.volumes.len() as u32;
        self.objects.push(Object { color, rule, volumes, cut });
    }

    fn add_convex(&mut self, ring: &[Plan]) {
        let is_box = ring.len() <= 4;
        self.push_volume(&[ring], is_box);
    }

    fn add_volume(&mut self, rings: &[Vec<Plan>]) {
        let rings: Vec<&[Plan]> = rings.iter().map(Vec::as_slice).filter(|ring| ring.len() > 2).collect();
        if !rings.is_empty() {
            self.push_volume(&rings, false);
        }
    }

    fn push_volume(&mut self, rings: &[&[Plan]], is_box: bool) {
        let first = self.rings.len() as u32;
        for ring in rings {
            let start = self.corners.len() as u32;
            self.corners.extend_from_slice(ring);
            self.rings.push(start..self.corners.len() as u32);
        }
        let plan = PlanBox::around(rings.iter().flat_map(|ring| ring.iter().copied()));
        let rings = first..self.rings.len() as u32;
        self.volumes.push(Volume { rings, low: 0.0, high: 0.0, plan, is_box });
    }

    /// The levels of a volume's caps; the same one twice where there is no terrain.
    fn levels(&self, mesh: &Mesh, volume: &Volume) -> (f64, f64) {
        let is_convex = volume.is_box;
        let ring = self.rings_of(volume).next().unwrap_or(&[]);
        let region = if is_convex { Region::convex(ring) } else { Region::rectangle(volume.plan) };
        let Some((low, high)) = heights_under(mesh, &region) else {
            return (0.0, 0.0);
        };
        let extent = (volume.plan.max - volume.plan.min).element_sum();
        let clearance = (high - low) / 32.0 + extent / 512.0 + 1e-12 * (low.abs() + high.abs());
        (low - clearance, high + clearance)
    }

    /// Which objects share a mask (4.2: "sorting by color and then rendering each color group at once").
    fn group(&mut self, grouping: Grouping) {
        let is_shared = |object: &Object| {
            grouping == Grouping::Color && object.rule == Rule::NonZero && object.cut.is_none()
        };
        let key = |object: &Object| object.color.0.map(f64::to_bits);
        let mut open = std::collections::BTreeMap::new();
        for (number, object) in self.objects.iter().enumerate() {
            let own = self.passes.len();
            let pass = if is_shared(object) { *open.entry(key(object)).or_insert(own) } else { own };
            if pass == own {
                self.passes.push(Pass { objects: Vec::new() });
            }
            self.passes[pass].objects.push(number as u32);
        }
    }
}
