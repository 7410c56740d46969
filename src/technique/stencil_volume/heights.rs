//! The bounding heights of the terrain under a part of the plan (4.1, Fig. 3).
//!
//! Input: the hierarchy of bounding boxes of a terrain that is draped vertically, the plan's rectangle or a convex ring. Output: the lowest and the highest height
//! of the smallest boxes (cells of a grid, triangles of a TIN) that may lie under it; `None` where there is no
//! terrain. Refuses: nothing.

use crate::math;
use crate::space::{Plan, PlanBox, World};
use crate::terrain::{Grid, Leaf, Mesh, Node};

/// A part of the plan whose heights are asked for.
pub struct Region<'a> {
    bounds: PlanBox,
    /// The corners of a convex ring, counter-clockwise; empty: the whole rectangle.
    convex: &'a [Plan],
}

impl<'a> Region<'a> {
    /// The rectangle around a footprint (4.1: "the projection of the whole polygon").
    pub fn rectangle(bounds: PlanBox) -> Self {
        Self { bounds, convex: &[] }
    }

    /// A convex footprint (4.1: "the projection of the line segment").
    pub fn convex(ring: &'a [Plan]) -> Self {
        Self { bounds: PlanBox::around(ring.iter().copied()), convex: ring }
    }

    /// Whether a rectangle may share a point with the region: no edge of the ring has it wholly outside.
    fn meets(&self, other: &PlanBox) -> bool {
        self.bounds.meets(other)
            && self.convex.iter().enumerate().all(|(k, a)| {
                let along = self.convex[(k + 1) % self.convex.len()] - *a;
                // The rectangle's corner that lies farthest to the left of the edge.
                let x = if along.y > 0.0 { other.min.x } else { other.max.x };
                let y = if along.x > 0.0 { other.max.y } else { other.min.y };
                let (dx, dy) = (x - a.x, y - a.y);
                along.x * dy - along.y * dx >= -1e-9 * ((along.x * dy).abs() + (along.y * dx).abs())
            })
    }
}

/// The lowest and the highest height of the terrain under a region.
pub fn heights_under(mesh: &Mesh, region: &Region) -> Option<(f64, f64)> {
    let mut range = Range { low: f64::INFINITY, high: f64::NEG_INFINITY };
    visit(mesh, mesh.root(), region, &mut range);
    (range.low <= range.high).then_some((range.low, range.high))
}

struct Range {
    low: f64,
    high: f64,
}

impl Range {
    /// Takes a height; NaN (a hole) changes nothing.
    fn include(&mut self, height: f64) {
        self.low = math::min(height, self.low);
        self.high = math::max(height, self.high);
    }
}

fn visit(mesh: &Mesh, node: Node, region: &Region, range: &mut Range) {
    let Some(bounds) = mesh.bounds(node) else { return };
    if !region.meets(&bounds.below()) {
        return;
    }
    let (low, high) = bounds.heights();
    if low >= range.low && high <= range.high {
        return;
    }
    if node.level > 0 {
        mesh.for_each_child(node, |child| visit(mesh, child, region, range));
        return;
    }
    match mesh.leaf(node) {
        Leaf::Cells(grid) => visit_cells(grid, node, region, range),
        Leaf::Triangles(ids) => {
            for corners in ids.filter_map(|id| mesh.triangle(id)) {
                include_if_met(&corners, region, range);
            }
        }
    }
}

fn visit_cells(grid: &Grid, node: Node, region: &Region, range: &mut Range) {
    let (columns, rows) = grid.cells(node);
    let posts = grid.posts();
    for j in rows {
        let ends = [(columns.start, j), (columns.end, j), (columns.start, j + 1), (columns.end, j + 1)];
        // Posts are rounded one by one: those between the ends may lie a little beside the ends' rectangle.
        let row = PlanBox::around(ends.map(|(i, j)| posts.plan(i, j)));
        let slack = 1e-9 * (row.min.to_vec().abs() + row.max.to_vec().abs()).element_sum();
        if !region.meets(&row.grown(slack)) {
            continue;
        }
        for i in columns.clone() {
            let corners =
                [posts.world(i, j), posts.world(i + 1, j), posts.world(i, j + 1), posts.world(i + 1, j + 1)];
            include_if_met(&corners, region, range);
        }
    }
}

#[inline(always)]
fn include_if_met(corners: &[World], region: &Region, range: &mut Range) {
    if region.meets(&PlanBox::around(corners.iter().map(|p| p.plan()))) {
        corners.iter().for_each(|p| range.include(p.z));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Diagonal, Posts, Surface};
    use glam::DVec2;

    fn plane(tilt: f64) -> Mesh {
        let heights = (0..100 * 100).map(|k| tilt * f64::from(k % 100)).collect();
        let posts = Posts::new((100, 100), Plan::default(), (DVec2::X, DVec2::Y), heights).unwrap();
        Mesh::new(Surface::Grid(posts), Diagonal::SwNe).unwrap()
    }

    #[test]
    fn a_segment_takes_the_heights_of_its_own_cells() {
        let ring = [(10.2, 50.2), (12.8, 50.2), (12.8, 50.8), (10.2, 50.8)].map(|(x, y)| Plan::new(x, y));
        assert_eq!(heights_under(&plane(2.0), &Region::convex(&ring)), Some((20.0, 26.0)));
    }

    #[test]
    fn a_diagonal_segment_does_not_take_what_lies_beside_it() {
        let peak = |x: f64, y: f64| {
            let mut heights = vec![0.0; 100 * 100];
            heights[y as usize * 100 + x as usize] = 9.0;
            let posts = Posts::new((100, 100), Plan::default(), (DVec2::X, DVec2::Y), heights).unwrap();
            Mesh::new(Surface::Grid(posts), Diagonal::SwNe).unwrap()
        };
        let ring = [(10.0, 10.0), (10.5, 10.0), (80.5, 80.0), (80.0, 80.0)].map(|(x, y)| Plan::new(x, y));
        assert_eq!(heights_under(&peak(40.0, 60.0), &Region::convex(&ring)), Some((0.0, 0.0)));
        assert_eq!(heights_under(&peak(41.0, 40.0), &Region::convex(&ring)), Some((0.0, 9.0)));
    }

    #[test]
    fn beside_the_terrain_there_are_no_heights() {
        let beside = PlanBox::around([Plan::new(200.0, 0.0), Plan::new(210.0, 10.0)]);
        assert_eq!(heights_under(&plane(1.0), &Region::rectangle(beside)), None);
    }
}
