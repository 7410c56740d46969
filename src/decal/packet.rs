//! Samples that are looked up together, and what that took.

use crate::space::{Plan, PlanBox, SmallBox};

/// What was done for some samples.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct LookupCounts {
    /// Nodes of trees whose boxes were looked at.
    pub nodes: u32,
    /// Segments, and polygons or parts of them, that samples were compared with.
    pub leaves: u32,
    /// Nodes of quadtrees on the way to those.
    pub quadtree_nodes: u64,
    /// Edges of leaf polygons that samples were compared with.
    pub edges: u64,
}

impl LookupCounts {
    /// Both.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self {
            nodes: self.nodes + other.nodes,
            leaves: self.leaves + other.leaves,
            quadtree_nodes: self.quadtree_nodes + other.quadtree_nodes,
            edges: self.edges + other.edges,
        }
    }
}

/// Some samples that lie in one cell.
pub(super) struct Packet<'a> {
    pub(super) points: &'a [Plan],
    /// Their coordinates apart.
    pub(super) x: &'a [f64],
    pub(super) y: &'a [f64],
    /// The box around those that are looked up.
    pub(super) plan: PlanBox,
    pub(super) bounds: SmallBox,
    /// Those that may still show something.
    pub(super) open: u64,
}

/// Which of the wanted points are as they should be.
#[inline(always)]
pub(super) fn of<P>(points: &[P], mut wanted: u64, is: impl Fn(&P) -> bool) -> u64 {
    let mut held = 0;
    while wanted != 0 {
        let k = wanted.trailing_zeros();
        wanted &= wanted - 1;
        held |= u64::from(is(&points[k as usize])) << k;
    }
    held
}

#[inline(always)]
pub(super) fn single(at: Plan) -> [f32; 2] {
    [at.x as f32, at.y as f32]
}
