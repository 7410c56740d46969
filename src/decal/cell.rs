//! What a cell of the decal grid refers to (Figs. 2.11, 3.4, 4.2): line segments and polygons in trees of their own, each sorted by draw order,
//! what is drawn last first.

use super::bvh::Bvh;
use super::quadtree::Start;
use crate::space::Plan;
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
    /// Its style.
    pub(super) style: u32,
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

/// What a cell has of a ring, or of several of a member.
#[derive(Debug, Clone, Copy)]
pub(super) struct RingPart {
    /// Whether it is the first part of a member of its area.
    pub(super) opens_member: bool,
    pub(super) turns: Turns,
}

/// How often rings turn around the points of a cell.
#[derive(Debug, Clone, Copy)]
pub(super) enum Turns {
    /// So often around each.
    Throughout(i32),
    /// As edges say that the cell has itself: a leaf polygon whose leaf is the cell.
    Own {
        /// The first of the run's vertices among the cell's.
        first: u32,
        /// How many there are.
        count: u32,
        /// What the turns around the cell's south-east corner add.
        corner: i32,
    },
    /// As a quadtree says.
    Tree {
        /// The ring.
        ring: u32,
        /// Where its quadtree is entered (quadtree culling).
        start: Start,
    },
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
    /// The vertices of [`Turns::Own`].
    pub(super) vertices: Box<[Plan]>,
    /// Its south-east corner.
    pub(super) corner: Plan,
}

impl Cell {
    /// The rings of an area of the cell.
    #[inline(always)]
    pub(super) fn rings_of(&self, area: u32) -> &[RingPart] {
        let Range { start, end } = self.range_of(area);
        &self.rings[start..end]
    }

    /// The vertices of a run of edges that the cell has itself; of others none.
    #[inline(always)]
    pub(super) fn run_of(&self, turns: &Turns) -> &[Plan] {
        let Turns::Own { first, count, .. } = turns else { return &[] };
        &self.vertices[*first as usize..][..*count as usize]
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
        self.polygons.bytes() + leaves + size_of_val(&self.vertices[..])
    }
}
