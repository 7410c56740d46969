//! What a cell of the decal grid refers to (Figs. 2.11, 3.4, 4.2): line segments and polygons in trees of their own, each sorted by draw order,
//! what is drawn last first.

use super::bvh::Bvh;
use super::quadtree::Start;
use super::settings::Hierarchy;
use crate::index::morton;
use crate::space::{PlanBox, SmallBox};
use std::cmp::Reverse;
use std::ops::Range;

/// A segment of a stroke that may hold points of the cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct LineLeaf {
    /// Its item.
    pub(super) item: u32,
    /// Its chain's place among those of the item.
    pub(super) chain: u32,
    /// The vertex of the chain that it starts with, from 0.
    pub(super) vertex: u32,
}

/// An item whose area counts: a fill, or what is outside of a layer's polygons.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct FillLeaf {
    /// The item.
    pub(super) item: u32,
    /// Its area's place among the cell's; [`NOTHING`]: no ring of it is near.
    pub(super) area: u32,
}

/// No place.
pub(super) const NOTHING: u32 = u32::MAX;

/// The part of an area that lies in the cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct AreaPart {
    /// The item that owns the area.
    pub(super) owner: u32,
    /// Where its rings start in the list of [`RingPart`]s; they end where the next area's start.
    pub(super) first: u32,
}

/// The part of a ring's quadtree that lies in the cell (quadtree culling).
#[derive(Debug, Clone, Copy)]
pub(super) struct RingPart {
    /// The ring.
    pub(super) ring: u32,
    /// Where its quadtree is entered.
    pub(super) start: Start,
}

/// What a cell refers to.
#[derive(Debug, Default)]
pub(super) struct Cell {
    pub(super) lines: Bvh,
    pub(super) segments: Box<[LineLeaf]>,
    pub(super) polygons: Bvh,
    pub(super) fills: Box<[FillLeaf]>,
    pub(super) areas: Box<[AreaPart]>,
    pub(super) rings: Box<[RingPart]>,
}

/// What a cell is made of.
#[derive(Debug, Default)]
pub(super) struct Contents {
    /// Segments with their boxes.
    pub(super) lines: Vec<(LineLeaf, SmallBox)>,
    /// Fills with the boxes of what lies of them in the cell.
    pub(super) fills: Vec<(FillLeaf, SmallBox)>,
    /// By owner.
    pub(super) areas: Vec<AreaPart>,
    pub(super) rings: Vec<RingPart>,
}

impl Contents {
    /// The cell; none where there is nothing in it.
    pub(super) fn into_cell(mut self, hierarchy: Hierarchy, plan: &PlanBox) -> Option<Box<Cell>> {
        if self.lines.is_empty() && self.fills.is_empty() {
            return None;
        }
        let bits = if hierarchy == Hierarchy::Wide { 3 } else { 1 };
        // Segments of a line keep their order, so that those of one line are next to each other (4.4.1).
        let by_draw_order = |(leaf, _): &(LineLeaf, SmallBox)| (Reverse(leaf.item), leaf.chain, leaf.vertex);
        match hierarchy {
            Hierarchy::Curve => {
                self.lines.sort_by_cached_key(|entry| (curve_place(plan, &entry.1), by_draw_order(entry)))
            }
            Hierarchy::Binary | Hierarchy::Wide => self.lines.sort_unstable_by_key(by_draw_order),
        }
        self.fills.sort_unstable_by_key(|(leaf, _)| Reverse(leaf.item));
        let (segments, line_boxes): (Vec<LineLeaf>, Vec<SmallBox>) = self.lines.into_iter().unzip();
        let (fills, fill_boxes): (Vec<FillLeaf>, Vec<SmallBox>) = self.fills.into_iter().unzip();
        Some(Box::new(Cell {
            lines: Bvh::new(&line_boxes, bits),
            segments: segments.into(),
            polygons: Bvh::new(&fill_boxes, bits),
            fills: fills.into(),
            areas: self.areas.into(),
            rings: self.rings.into(),
        }))
    }
}

/// The place of a box's middle on a curve through the cell (Thöny et al. 2017).
fn curve_place(plan: &PlanBox, of: &SmallBox) -> u64 {
    let (middle, size) = (of.middle(), plan.max - plan.min);
    // Casts saturate: what reaches out of the cell is put on its border.
    let place = |d: f64, size: f64| (d / size * 65536.0) as u32;
    morton(place(middle.x - plan.min.x, size.x).min(65535), place(middle.y - plan.min.y, size.y).min(65535))
}

impl Cell {
    /// The rings of an area of the cell.
    #[inline(always)]
    pub(super) fn rings_of(&self, area: u32) -> &[RingPart] {
        let Range { start, end } = self.range_of(area);
        &self.rings[start..end]
    }

    fn range_of(&self, area: u32) -> Range<usize> {
        let Some(part) = self.areas.get(area as usize) else { return 0..0 };
        let end = self.areas.get(area as usize + 1).map_or(self.rings.len(), |next| next.first as usize);
        part.first as usize..end
    }

    /// The place of an owner's area among the cell's.
    pub(super) fn area_of(&self, owner: u32) -> u32 {
        self.areas.binary_search_by_key(&owner, |part| part.owner).map_or(NOTHING, |k| k as u32)
    }

    /// Bytes of its line segments and their tree.
    pub(super) fn line_bytes(&self) -> usize {
        self.lines.bytes() + size_of_val(&self.segments[..])
    }

    /// Bytes of its references to polygons, their rings, and their tree.
    pub(super) fn polygon_bytes(&self) -> usize {
        let leaves =
            size_of_val(&self.fills[..]) + size_of_val(&self.areas[..]) + size_of_val(&self.rings[..]);
        self.polygons.bytes() + leaves
    }
}
