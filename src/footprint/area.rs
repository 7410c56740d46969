//! Exact winding numbers of a polygon, by buckets of its height.

use crate::draw_list::{DrawList, Item};
use crate::predicate::orient2d;
use crate::space::{Plan, PlanBox};
use std::ops::Range;

/// Edges a bucket holds on average, at least.
const EDGES_A_BUCKET: usize = 4;

/// A polygon's edges, sorted into buckets of y.
#[derive(Debug)]
pub(super) struct Area {
    bounds: PlanBox,
    /// Where each bucket begins in `edges`, and where the last ends.
    starts: Vec<u32>,
    /// The first points of edges.
    edges: Vec<u32>,
}

impl Area {
    /// The edges of an item's border: from each vertex of its rings to the one behind it.
    pub(super) fn new(list: &DrawList, item: &Item) -> Self {
        let points = list.vertices();
        let vertices = || list.area(item).iter().flat_map(|ring| ring.first..ring.first + ring.count);
        let bounds = PlanBox::around(vertices().map(|k| points[k as usize]));
        let count = vertices().count();
        let mut buckets = (count / EDGES_A_BUCKET).max(1);
        loop {
            let area = Self { bounds, starts: vec![0; buckets + 1], edges: Vec::new() };
            let entries: usize = vertices().map(|k| area.buckets_of(points, k).count()).sum();
            // Long edges lie in many buckets: fewer buckets keep the whole linear in the number of edges.
            if entries <= 4 * count || buckets == 1 {
                return area.filled(points, vertices, entries);
            }
            buckets /= 2;
        }
    }

    fn filled<I: Iterator<Item = u32>>(
        mut self,
        points: &[Plan],
        vertices: impl Fn() -> I,
        entries: usize,
    ) -> Self {
        for k in vertices() {
            self.buckets_of(points, k).for_each(|b| self.starts[b + 1] += 1);
        }
        for b in 1..self.starts.len() {
            self.starts[b] += self.starts[b - 1];
        }
        let mut next = self.starts.clone();
        self.edges = vec![0; entries];
        for k in vertices() {
            for b in self.buckets_of(points, k) {
                self.edges[next[b] as usize] = k;
                next[b] += 1;
            }
        }
        self
    }

    /// The buckets that the edge from a point meets.
    fn buckets_of(&self, points: &[Plan], k: u32) -> Range<usize> {
        let (a, b) = (points[k as usize].y, points[k as usize + 1].y);
        let (low, high) = if a < b { (a, b) } else { (b, a) };
        self.bucket(low)..self.bucket(high) + 1
    }

    /// The bucket of a height: it never falls as the height grows, so that an edge is in each bucket it crosses.
    fn bucket(&self, y: f64) -> usize {
        let count = self.starts.len() - 1;
        let (low, high) = (self.bounds.min.y, self.bounds.max.y);
        // The cast saturates: NaN (no height at all) and what is below are 0.
        (((y - low) / (high - low) * count as f64) as usize).min(count - 1)
    }

    /// The box around it.
    pub(super) fn bounds(&self) -> PlanBox {
        self.bounds
    }

    pub(super) fn bytes(&self) -> usize {
        size_of::<Self>() + size_of_val(&self.starts[..]) + size_of_val(&self.edges[..])
    }

    /// How often the rings turn around a point that lies on none of them: a ray to the east counts the edges that it crosses,
    /// half-open, each side decided exactly.
    pub(super) fn winding(&self, points: &[Plan], at: Plan) -> i32 {
        let inside = self.bounds.min.y <= at.y && at.y <= self.bounds.max.y;
        if !inside || at.x > self.bounds.max.x || at.x < self.bounds.min.x {
            return 0;
        }
        let b = self.bucket(at.y);
        let edges = &self.edges[self.starts[b] as usize..self.starts[b + 1] as usize];
        let mut turns = 0;
        for &k in edges {
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
        turns
    }
}
