//! Vector data -> polyhedra (4.1, Fig. 3).
//!
//! Input: the draw list, the terrain. Output: [`Extrusion`]: an object for each of its items, the volumes that each consists of, and
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
use crate::draw_list::{Chain, DrawList, Item, Role, Side};
use crate::parallel;
use crate::scene::Rule;
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
    /// What it stands on.
    base: Base,
    /// The level of the bottom cap.
    pub low: f64,
    /// The level of the top cap; not above `low`: there is no terrain and so no volume.
    pub high: f64,
    /// The rectangle around its footprint.
    pub plan: PlanBox,
    /// Whether it is one convex ring of at most four corners, counter-clockwise: its caps are one face each.
    pub is_box: bool,
}

/// What a volume stands on.
#[derive(Debug, Clone)]
enum Base {
    /// A piece of a stroke: a range of [`Extrusion::corners`].
    Piece(Range<u32>),
    /// The area of an item of the draw list.
    Area(u32),
}

/// What an item of the draw list is extruded to.
#[derive(Debug, Clone, PartialEq)]
pub struct Object {
    /// Its volumes.
    pub volumes: Range<u32>,
    /// Those of the polygon that it is cut to; none where it is not cut.
    pub cutters: Range<u32>,
}

/// Objects that share a mask.
#[derive(Debug, Clone, PartialEq)]
pub struct Pass {
    /// Their numbers, in draw order; they have one colour and one rule.
    pub objects: Vec<u32>,
}

/// All that is extruded.
#[derive(Debug)]
pub struct Extrusion<'l> {
    list: &'l DrawList,
    /// Corners of the pieces of strokes.
    pub corners: Vec<Plan>,
    /// Volumes, by object.
    pub volumes: Vec<Volume>,
    /// Objects, as many as there are items.
    pub objects: Vec<Object>,
    /// Passes in draw order.
    pub passes: Vec<Pass>,
}

impl<'l> Extrusion<'l> {
    /// Extrudes all items over a terrain; views of one that is not fixed may show other heights between the same lowest and highest.
    pub fn new(list: &'l DrawList, (mesh, is_fixed): (&Mesh, bool), settings: &Settings) -> Self {
        let (corners, volumes, objects, passes) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let mut all = Self { list, corners, volumes, objects, passes };
        list.numbered().for_each(|(number, item)| all.add_object(number, item, settings.joins));
        let levels = parallel::map(&all.volumes, |volume| all.levels((mesh, is_fixed), volume));
        for (volume, (low, high)) in all.volumes.iter_mut().zip(levels) {
            (volume.low, volume.high) = (low, high);
        }
        all.group(settings.grouping);
        all
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.corners[..])
            + size_of_val(&self.volumes[..])
            + size_of_val(&self.objects[..])
            + self.passes.iter().map(|p| size_of::<Pass>() + size_of_val(&p.objects[..])).sum::<usize>()
    }

    /// The corners of each ring of a volume.
    pub fn rings_of(&self, volume: &Volume) -> impl Iterator<Item = &[Plan]> + Clone {
        let (piece, area) = match &volume.base {
            Base::Piece(corners) => (Some(&self.corners[corners.start as usize..corners.end as usize]), None),
            Base::Area(item) => (None, Some(self.list.border(&self.list.items()[*item as usize]))),
        };
        let rings = area.unwrap_or(&[]).iter().map(|ring| self.list.vertices_of(ring));
        piece.into_iter().chain(rings)
    }

    /// The object that a volume was made for: its own, or what it is cut to.
    pub fn object_of(&self, volume: u32) -> u32 {
        self.objects.partition_point(|object| object.volumes.end <= volume) as u32
    }

    /// Which counts of an object are inside.
    pub fn rule_of(&self, object: u32) -> Rule {
        let style = self.list.style_of(object);
        if style.stroke.is_some() { Rule::NonZero } else { style.rule }
    }

    /// The rule of the polygon that an object is cut to, and whether the points in it (or those outside) count.
    pub fn cut_of(&self, object: u32) -> Option<(Rule, bool)> {
        let style = self.list.style_of(object);
        style.cut.map(|side| (style.rule, side == Side::Inside))
    }

    fn add_object(&mut self, number: u32, item: &Item, joins: VolumeJoins) {
        let owner = self.list.area_owner(number);
        let first = self.volumes.len();
        if owner == number && !item.border.is_empty() {
            let rings = self.list.border(item).iter().map(|ring| self.list.vertices_of(ring));
            let plan = PlanBox::around(rings.flatten().copied());
            self.push_volume(Base::Area(number), plan, false);
        }
        let area = self.volumes_from(first);
        let Some(line) = self.list.style_of(number).stroke else {
            return self.objects.push(Object { volumes: area, cutters: 0..0 });
        };
        let cutters = match item.border.is_empty() || owner == number {
            true => area,
            false => self.objects[owner as usize].volumes.clone(),
        };
        let first = self.volumes.len();
        // A point is nothing but its cap.
        let joins = if self.list.style_of(number).role == Role::Point { VolumeJoins::Style } else { joins };
        if let Some(stroke) = Stroke::new(&line, joins) {
            self.list.strokes(item).iter().for_each(|chain| self.add_pieces(&stroke, chain));
        }
        self.objects.push(Object { volumes: self.volumes_from(first), cutters });
    }

    fn volumes_from(&self, first: usize) -> Range<u32> {
        first as u32..self.volumes.len() as u32
    }

    fn add_pieces(&mut self, stroke: &Stroke, chain: &Chain) {
        let path = self.list.path_of(chain);
        stroke.pieces(path, chain.is_closed, &mut |ring| {
            let start = self.corners.len() as u32;
            self.corners.extend_from_slice(ring);
            let corners = start..self.corners.len() as u32;
            let plan = PlanBox::around(ring.iter().copied());
            self.push_volume(Base::Piece(corners), plan, ring.len() <= 4);
        });
    }

    fn push_volume(&mut self, base: Base, plan: PlanBox, is_box: bool) {
        self.volumes.push(Volume { base, low: 0.0, high: 0.0, plan, is_box });
    }

    /// The levels of a volume's caps; the same one twice where there is no terrain.
    fn levels(&self, (mesh, is_fixed): (&Mesh, bool), volume: &Volume) -> (f64, f64) {
        let is_convex = volume.is_box;
        let ring = self.rings_of(volume).next().unwrap_or(&[]);
        let region = if is_convex { Region::convex(ring) } else { Region::rectangle(volume.plan) };
        let Some(under) = heights_under(mesh, &region) else {
            return (0.0, 0.0);
        };
        let (low, high) = if is_fixed { under } else { mesh.heights().unwrap_or(under) };
        let extent = (volume.plan.max - volume.plan.min).element_sum();
        let clearance = (high - low) / 32.0 + extent / 512.0 + 1e-12 * (low.abs() + high.abs());
        (low - clearance, high + clearance)
    }

    /// Which objects share a mask (4.2: "sorting by color and then rendering each color group at once").
    fn group(&mut self, grouping: Grouping) {
        let is_shared = |object: u32| {
            grouping == Grouping::Color
                && self.rule_of(object) == Rule::NonZero
                && self.cut_of(object).is_none()
                && self.list.style_of(object).role != Role::Outside
        };
        // A layer that is composed as a whole shares with no other.
        let layer = |object: u32| self.list.style_of(object).group.map(|group| group.layer);
        let key = |object: u32| (layer(object), self.list.style_of(object).paint.0.map(f64::to_bits));
        let mut open = std::collections::BTreeMap::new();
        let mut passes: Vec<Pass> = Vec::new();
        for object in 0..self.objects.len() as u32 {
            let own = passes.len();
            let pass = if is_shared(object) { *open.entry(key(object)).or_insert(own) } else { own };
            if pass == own {
                passes.push(Pass { objects: Vec::new() });
            }
            passes[pass].objects.push(object);
        }
        self.passes = passes;
    }
}
