//! Whether a point lies in a polygon, by exact winding numbers and buckets of its height.

use crate::draw_list::{DrawList, Item};
use crate::index::CellLists;
use crate::predicate::orient2d;
use crate::scene::Rule;
use crate::space::{Plan, PlanBox};
use std::ops::Range;

/// Edges a bucket holds on average, at least.
const EDGES_A_BUCKET: usize = 4;

/// A polygon's edges, sorted into buckets of y.
#[derive(Debug)]
pub(super) struct Area {
    heights: Heights,
    bounds: PlanBox,
    /// The first points of edges, by bucket.
    edges: CellLists<u32>,
    /// Behind which points each member's edges end.
    member_ends: Vec<u32>,
}

/// A range of y cut into buckets.
#[derive(Debug, Clone, Copy)]
struct Heights {
    low: f64,
    high: f64,
    buckets: usize,
}

impl Heights {
    /// The bucket of a height: it never falls as the height grows, so that an edge is in each bucket it crosses.
    fn bucket(&self, y: f64) -> usize {
        // The cast saturates: NaN (no height at all) and what is below are 0.
        (((y - self.low) / (self.high - self.low) * self.buckets as f64) as usize).min(self.buckets - 1)
    }

    /// The buckets that the edge from a point meets.
    fn buckets_of(&self, points: &[Plan], k: u32) -> Range<usize> {
        let (a, b) = (points[k as usize].y, points[k as usize + 1].y);
        let (low, high) = if a < b { (a, b) } else { (b, a) };
        self.bucket(low)..self.bucket(high) + 1
    }
}

impl Area {
    /// The edges of an item's border: from each vertex of its rings to the one behind it.
    pub(super) fn new(list: &DrawList, item: &Item) -> Self {
        let points = list.vertices();
        let vertices = || list.area(item).iter().flat_map(|ring| ring.first..ring.first + ring.count);
        let bounds = PlanBox::around(vertices().map(|k| points[k as usize]));
        let count = vertices().count();
        let buckets = (count / EDGES_A_BUCKET).max(1);
        let mut heights = Heights { low: bounds.min.y, high: bounds.max.y, buckets };
        // Long edges lie in many buckets: fewer buckets keep the whole linear in the number of edges.
        let entries = |heights: &Heights| vertices().map(|k| heights.buckets_of(points, k).len()).sum();
        while heights.buckets > 1 && 4 * count < entries(&heights) {
            heights.buckets /= 2;
        }
        let edges = CellLists::new(heights.buckets, |edges| {
            for k in vertices() {
                heights.buckets_of(points, k).for_each(|bucket| edges.put(bucket, k));
            }
        });
        let chains = list.area(item).chunk_by(|a, b| a.member == b.member);
        let ends = chains.filter_map(|rings| rings.last()).map(|ring| ring.first + ring.count);
        Self { heights, bounds, edges, member_ends: ends.collect() }
    }

    /// The box around it.
    pub(super) fn bounds(&self) -> PlanBox {
        self.bounds
    }

    pub(super) fn bytes(&self) -> usize {
        size_of::<Self>() + self.edges.bytes() + size_of_val(&self.member_ends[..])
    }

    /// Whether the rule has a point that lies on no ring inside of any member: a ray to the east counts the edges of each that it
    /// crosses, half-open, each side decided exactly.
    pub(super) fn holds(&self, points: &[Plan], rule: Rule, at: Plan) -> bool {
        let inside = self.bounds.min.y <= at.y && at.y <= self.bounds.max.y;
        if !inside || at.x > self.bounds.max.x || at.x < self.bounds.min.x {
            return false;
        }
        let (mut turns, mut member) = (0, 0);
        for &k in self.edges.of(self.heights.bucket(at.y)) {
            // A cell has its edges in the order of their members.
            if self.member_ends.get(member).is_some_and(|end| *end <= k) {
                if rule.contains(turns) {
                    return true;
                }
                turns = 0;
                member += self.member_ends[member..].partition_point(|end| *end <= k);
            }
            let (from, to) = (points[k as usize], points[k as usize + 1]);
            if (from.y <= at.y) != (to.y <= at.y) {
                let side = orient2d(from, to, at);
                match from.y <= at.y {
                    true if side > 0.0 => turns += 1,
                    false if side < 0.0 => turns -= 1,
                    _ => {}
                }
            }
        }
        rule.contains(turns)
    }
}
