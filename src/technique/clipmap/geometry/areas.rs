//! The rings of areas.

use super::limit::{MOST, too_many};
use crate::error::Result;
use crate::scene::{Clipmap, PolygonRaster, Rule};
use crate::space::{Plan, PlanBox};
use crate::technique::clipmap::simple;

/// A polygon.
#[derive(Debug, Clone, Copy)]
pub(in crate::technique::clipmap) struct AreaRings {
    /// The item of its feature's fill, whether it is filled or not.
    pub(in crate::technique::clipmap) item: u32,
    rings: (u32, u32),
    /// Whether its winding numbers are 0 and 1.
    pub(in crate::technique::clipmap) is_simple: bool,
}

/// Polygons in memory.
#[derive(Debug, Default)]
pub(super) struct Areas {
    areas: Vec<AreaRings>,
    /// The box around each polygon; empty where it is not filled.
    pub(super) boxes: Vec<PlanBox>,
    ring_ends: Vec<u32>,
    points: Vec<Plan>,
}

impl Areas {
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.areas[..]) + size_of_val(&self.ring_ends[..]) + size_of_val(&self.points[..])
    }

    /// Adds a polygon.
    pub(super) fn push(
        &mut self,
        item: u32,
        rings: &[Vec<Plan>],
        rule: Rule,
        is_filled: bool,
        settings: &Clipmap,
    ) {
        let mut rings: Vec<Vec<Plan>> = rings.iter().filter(|ring| ring.len() > 2).cloned().collect();
        let plan = PlanBox::around(rings.iter().flatten().copied());
        let is_simple = settings.polygons == PolygonRaster::Exact && simple::orient(&mut rings, rule);
        let first = self.ring_ends.len() as u32;
        for ring in &rings {
            self.points.extend(ring);
            self.ring_ends.push(self.points.len() as u32);
        }
        self.areas.push(AreaRings { item, rings: (first, self.ring_ends.len() as u32), is_simple });
        self.boxes.push(if is_filled { plan } else { PlanBox::EMPTY });
    }

    /// Adds another's areas after these.
    ///
    /// # Errors
    /// When there are too many.
    pub(super) fn append(&mut self, other: Self) -> Result<()> {
        let (rings, points) = (self.ring_ends.len() as u32, self.points.len());
        if points + other.points.len() > MOST {
            return Err(too_many("vertices"));
        }
        let moved =
            |area: &AreaRings| AreaRings { rings: (area.rings.0 + rings, area.rings.1 + rings), ..*area };
        self.areas.extend(other.areas.iter().map(moved));
        self.boxes.extend(other.boxes);
        self.ring_ends.extend(other.ring_ends.iter().map(|end| end + points as u32));
        self.points.extend(other.points);
        Ok(())
    }

    /// A polygon by its number.
    pub(super) fn get(&self, area: u32) -> AreaRings {
        self.areas[area as usize]
    }

    /// The polygon of a feature, by the item of its fill.
    pub(super) fn of_item(&self, item: u32) -> Option<AreaRings> {
        let at = self.areas.binary_search_by_key(&item, |area| area.item).ok()?;
        Some(self.areas[at])
    }

    /// The rings of a polygon.
    pub(super) fn rings(&self, area: &AreaRings) -> impl Iterator<Item = &[Plan]> {
        (area.rings.0 as usize..area.rings.1 as usize).map(|ring| {
            let start = if ring == 0 { 0 } else { self.ring_ends[ring - 1] };
            &self.points[start as usize..self.ring_ends[ring] as usize]
        })
    }
}
