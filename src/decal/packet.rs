//! Samples that are looked up together, and what that took.

use super::hits::MOST_TOGETHER;
use crate::math::{max, min};
use crate::space::{Plan, PlanBox, SmallBox};
use std::cell::OnceCell;

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
    /// Their coordinates apart, where somebody has asked.
    axes: OnceCell<[[f64; MOST_TOGETHER]; 2]>,
    /// The box around those that are looked up.
    pub(super) plan: PlanBox,
    pub(super) bounds: SmallBox,
    /// Those that may still show something.
    pub(super) open: u64,
}

impl<'a> Packet<'a> {
    /// Those of some points that have a bit in `open`; `plan` is the box around them.
    #[inline(always)]
    pub(super) fn new(points: &'a [Plan], open: u64, plan: &PlanBox) -> Self {
        Self { points, axes: OnceCell::new(), plan: *plan, bounds: SmallBox::around(plan), open }
    }

    /// The points' coordinates, x and y. Those that are not looked up, and may be infinite, are moved into the box.
    #[inline(always)]
    pub(super) fn axes(&self) -> (&[f64], &[f64]) {
        let [x, y] = self.axes.get_or_init(|| {
            let mut axes = [[0.0; MOST_TOGETHER]; 2];
            let PlanBox { min: low, max: high } = self.plan;
            for (k, at) in self.points.iter().enumerate() {
                axes[0][k] = min(max(at.x, low.x), high.x);
                axes[1][k] = min(max(at.y, low.y), high.y);
            }
            axes
        });
        (&x[..self.points.len()], &y[..self.points.len()])
    }
}

/// Which of the wanted points are as they should be.
#[inline(always)]
pub(super) fn of<P>(points: &[P], mut wanted: u64, mut is: impl FnMut(&P) -> bool) -> u64 {
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
