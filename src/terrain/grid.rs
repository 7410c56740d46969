//! Two triangles a cell of a grid, and the quadtree of bounding heights over blocks of cells.

use super::{BLOCK, Bounds, Node};
use crate::error::{Error, Result};
use crate::math;
use crate::parallel;
use crate::scene::{Diagonal, Posts};
use crate::space::{Plan, PlanBox, World};
use std::ops::Range;

/// A grid of posts as triangles.
///
/// Triangle `2 * (j * (columns - 1) + i) + k` is half `k` of cell (i, j). With the diagonal south-west to north-east,
/// half 0 lies south-east of it; with the other, half 0 holds the cell's south-west corner.
#[derive(Debug, Clone)]
pub struct Grid {
    posts: Posts,
    diagonal: Diagonal,
    /// From the leaves up, the lowest and highest height of each node; (inf, -inf) where all is hole.
    levels: Vec<Level>,
}

#[derive(Debug, Clone)]
struct Level {
    columns: usize,
    rows: usize,
    heights: Vec<(f64, f64)>,
}

/// The heights' range of nothing.
const NOTHING: (f64, f64) = (f64::INFINITY, f64::NEG_INFINITY);

impl Grid {
    /// The triangles of a grid of posts and their bounding heights.
    ///
    /// # Errors
    /// When there are more triangles than a `u32` can number.
    pub fn new(posts: Posts, diagonal: Diagonal) -> Result<Self> {
        let cells = (posts.columns() - 1) as u64 * (posts.rows() - 1) as u64;
        if cells * 2 >= u64::from(u32::MAX) {
            return Err(Error::unsupported(format!("{cells} cells are more than this program can number"))
                .help("give the terrain a `window`"));
        }
        let mut levels = vec![leaf_level(&posts)];
        while let Some(top) = levels.last().filter(|l| l.heights.len() > 1) {
            let next = parent_level(top);
            levels.push(next);
        }
        Ok(Self { posts, diagonal, levels })
    }

    /// The posts.
    pub fn posts(&self) -> &Posts {
        &self.posts
    }

    /// Which way cell (i, j) is split: true from south-west to north-east.
    #[inline(always)]
    pub fn splits_sw_ne(&self, i: usize, j: usize) -> bool {
        splits_sw_ne(self.diagonal, i, j)
    }

    /// How cells are split.
    pub fn diagonal(&self) -> Diagonal {
        self.diagonal
    }

    pub(super) fn triangle_ids(&self) -> u32 {
        (2 * (self.posts.columns() - 1) * (self.posts.rows() - 1)) as u32
    }

    /// The number of half 0 of cell (i, j).
    #[inline(always)]
    pub fn first_triangle(&self, i: usize, j: usize) -> u32 {
        (2 * (j * (self.posts.columns() - 1) + i)) as u32
    }

    #[inline]
    pub(super) fn triangle(&self, id: u32) -> Option<[World; 3]> {
        let cell = (id / 2) as usize;
        let (i, j) = (cell % (self.posts.columns() - 1), cell / (self.posts.columns() - 1));
        let corners = self.half_corners(i, j, id % 2 == 1);
        let [a, b, c] = corners.map(|(di, dj)| self.posts.world(i + di, j + dj));
        (a.z + b.z + c.z).is_finite().then_some([a, b, c])
    }

    /// The numbers of a triangle's posts, counted row by row from the first.
    pub(super) fn corners(&self, id: u32) -> Option<[u32; 3]> {
        self.triangle(id)?;
        let cell = (id / 2) as usize;
        let (i, j) = (cell % (self.posts.columns() - 1), cell / (self.posts.columns() - 1));
        let corners = self.half_corners(i, j, id % 2 == 1);
        Some(corners.map(|(di, dj)| ((j + dj) * self.posts.columns() + i + di) as u32))
    }

    /// A post by its number.
    pub(super) fn vertex(&self, number: usize) -> World {
        self.posts.world(number % self.posts.columns(), number / self.posts.columns())
    }

    /// The corners of a half of cell (i, j) as offsets from its south-west post, counter-clockwise.
    #[inline(always)]
    pub fn half_corners(&self, i: usize, j: usize, second: bool) -> [(usize, usize); 3] {
        half_corners(self.splits_sw_ne(i, j), second)
    }

    /// The height over a plan point, on the half of the cell that it lies in; `None` beside the posts and in holes.
    pub(super) fn height_at(&self, at: Plan) -> Option<f64> {
        let (east, north, from) = (self.posts.east(), self.posts.north(), at - self.posts.first);
        let area = east.perp_dot(north);
        let (u, v) = (from.perp_dot(north) / area, east.perp_dot(from) / area);
        let last = [self.posts.columns() - 1, self.posts.rows() - 1];
        if !(u >= 0.0 && v >= 0.0 && u <= last[0] as f64 && v <= last[1] as f64) {
            return None;
        }
        let (i, j) = ((u as usize).min(last[0] - 1), (v as usize).min(last[1] - 1));
        let (u, v) = (u - i as f64, v - j as f64);
        let post = |(di, dj): (usize, usize)| self.posts.heights()[(j + dj) * self.posts.columns() + i + di];
        let height = match self.splits_sw_ne(i, j) {
            true if v <= u => post((0, 0)) * (1.0 - u) + post((1, 0)) * (u - v) + post((1, 1)) * v,
            true => post((0, 0)) * (1.0 - v) + post((1, 1)) * u + post((0, 1)) * (v - u),
            false if u + v <= 1.0 => post((0, 0)) * (1.0 - u - v) + post((1, 0)) * u + post((0, 1)) * v,
            false => post((1, 0)) * (1.0 - v) + post((1, 1)) * (u + v - 1.0) + post((0, 1)) * (1.0 - u),
        };
        // A hole's post is no number, and its triangles have no height.
        height.is_finite().then_some(height)
    }

    /// The smaller side of its cells.
    pub(super) fn resolution(&self) -> f64 {
        math::min(self.posts.east().length(), self.posts.north().length())
    }

    pub(super) fn plan_bounds(&self) -> PlanBox {
        let (i, j) = (self.posts.columns() - 1, self.posts.rows() - 1);
        PlanBox::around([(0, 0), (i, 0), (0, j), (i, j)].map(|(i, j)| self.posts.plan(i, j)))
    }

    /// The lowest and the highest post; 0 where there is none.
    pub(super) fn heights(&self) -> (f64, f64) {
        let all = self.levels.last().map_or(NOTHING, |top| top.heights[0]);
        if all.0 <= all.1 { all } else { (0.0, 0.0) }
    }

    pub(super) fn levels(&self) -> usize {
        self.levels.len()
    }

    pub(super) fn bytes(&self) -> usize {
        size_of_val(self.posts.heights())
            + self.levels.iter().map(|l| size_of_val(&l.heights[..])).sum::<usize>()
    }

    /// The columns and rows of cells in a node.
    #[inline]
    pub fn cells(&self, node: Node) -> (Range<usize>, Range<usize>) {
        let size = BLOCK << node.level;
        let (i, j) = (node.x as usize * size, node.y as usize * size);
        (i..(i + size).min(self.posts.columns() - 1), j..(j + size).min(self.posts.rows() - 1))
    }

    #[inline]
    pub(super) fn bounds(&self, node: Node) -> Option<Bounds> {
        let level = &self.levels[node.level as usize];
        let (low, high) = level.heights[node.y as usize * level.columns + node.x as usize];
        if low > high {
            return None;
        }
        let (i, j) = self.cells(node);
        let (half_i, half_j) = ((i.end - i.start) as f64 / 2.0, (j.end - j.start) as f64 / 2.0);
        let (east, north) = (self.posts.east(), self.posts.north());
        let plan = self.posts.first + (east * (i.start as f64 + half_i) + north * (j.start as f64 + half_j));
        Some(Bounds {
            center: World::new(plan.x, plan.y, (low + high) / 2.0),
            axes: [
                (east * half_i).extend(0.0),
                (north * half_j).extend(0.0),
                glam::DVec3::Z * ((high - low) / 2.0),
            ],
        })
    }

    #[inline]
    pub(super) fn for_each_child(&self, node: Node, mut visit: impl FnMut(Node)) {
        let level = node.level - 1;
        let below = &self.levels[level as usize];
        for y in 2 * node.y..(2 * node.y + 2).min(below.rows as u32) {
            for x in 2 * node.x..(2 * node.x + 2).min(below.columns as u32) {
                visit(Node { level, x, y });
            }
        }
    }
}

/// Which way cell (i, j) is split: true from south-west to north-east.
#[inline(always)]
pub(super) fn splits_sw_ne(diagonal: Diagonal, i: usize, j: usize) -> bool {
    match diagonal {
        Diagonal::SwNe => true,
        Diagonal::NwSe => false,
        Diagonal::Alternating => (i + j).is_multiple_of(2),
    }
}

/// The corners of a cell's half as offsets from its south-west post, counter-clockwise.
#[inline(always)]
pub(super) fn half_corners(sw_ne: bool, second: bool) -> [(usize, usize); 3] {
    match (sw_ne, second) {
        (true, false) => [(0, 0), (1, 0), (1, 1)],
        (true, true) => [(0, 0), (1, 1), (0, 1)],
        (false, false) => [(0, 0), (1, 0), (0, 1)],
        (false, true) => [(1, 0), (1, 1), (0, 1)],
    }
}

fn leaf_level(posts: &Posts) -> Level {
    let columns = (posts.columns() - 1).div_ceil(BLOCK);
    let rows = (posts.rows() - 1).div_ceil(BLOCK);
    let heights = parallel::map_indices(rows, |y| {
        let mut row = vec![NOTHING; columns];
        for j in y * BLOCK..=((y + 1) * BLOCK).min(posts.rows() - 1) {
            let line = &posts.heights()[j * posts.columns()..(j + 1) * posts.columns()];
            for (x, range) in row.iter_mut().enumerate() {
                let end = ((x + 1) * BLOCK).min(posts.columns() - 1);
                *range = line[x * BLOCK..=end].iter().fold(*range, |r, &h| joined(r, (h, h)));
            }
        }
        row
    });
    Level { columns, rows, heights: heights.concat() }
}

fn parent_level(below: &Level) -> Level {
    let (columns, rows) = (below.columns.div_ceil(2), below.rows.div_ceil(2));
    let mut heights = vec![NOTHING; columns * rows];
    for (k, range) in below.heights.iter().enumerate() {
        let parent = &mut heights[k / below.columns / 2 * columns + k % below.columns / 2];
        *parent = joined(*parent, *range);
    }
    Level { columns, rows, heights }
}

/// The union of two ranges; NaN (a hole) adds nothing.
#[inline(always)]
fn joined(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    (math::min(b.0, a.0), math::max(b.1, a.1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::terrain::Mesh;
    use glam::DVec2;

    fn grid(columns: usize, rows: usize, height: impl Fn(usize, usize) -> f64) -> Mesh {
        let heights = (0..columns * rows).map(|k| height(k % columns, k / columns)).collect();
        let posts = Posts::new((columns, rows), Plan::default(), (DVec2::X, DVec2::Y), heights).unwrap();
        Mesh::Grid(Grid::new(posts, Diagonal::SwNe).unwrap().into())
    }

    #[test]
    fn a_hole_removes_the_six_triangles_that_use_its_post() {
        let mesh = grid(4, 4, |i, j| if (i, j) == (1, 2) { f64::NAN } else { 0.0 });
        let missing = (0..mesh.triangle_ids()).filter(|&t| mesh.triangle(t).is_none()).count();
        assert_eq!(missing, 6);
    }

    #[test]
    fn a_height_is_that_of_the_triangle_that_lies_over_the_point() {
        for diagonal in [Diagonal::SwNe, Diagonal::NwSe, Diagonal::Alternating] {
            let hole = 2 * 7 + 3;
            let heights = (0..7 * 5).map(|k| if k == hole { f64::NAN } else { f64::from(k * 7919 % 23) });
            let steps = (DVec2::new(3.0, 0.5), DVec2::new(-0.25, 2.0));
            let posts = Posts::new((7, 5), Plan::new(10.0, -4.0), steps, heights.collect()).unwrap();
            let mesh = Mesh::Grid(Grid::new(posts, diagonal).unwrap().into());
            assert_eq!(mesh.resolution(), DVec2::new(-0.25, 2.0).length());
            for id in 0..mesh.triangle_ids() {
                let Mesh::Grid(grid) = &mesh else { unreachable!() };
                let (cell, second) = ((id / 2) as usize, id % 2 == 1);
                let corners = grid.half_corners(cell % 6, cell / 6, second);
                let plan = corners.map(|(i, j)| grid.posts().plan(cell % 6 + i, cell / 6 + j));
                let at = plan[0] + ((plan[1] - plan[0]) * 0.25 + (plan[2] - plan[0]) * 0.625);
                let expected = mesh.triangle(id).map(|[a, b, c]| a.z * 0.125 + b.z * 0.25 + c.z * 0.625);
                match (mesh.height_at(at), expected) {
                    (Some(found), Some(height)) => assert!((found - height).abs() < 1e-9, "{id}"),
                    (found, height) => assert_eq!(found, height, "{id}"),
                }
            }
            assert_eq!(mesh.height_at(Plan::new(9.0, -5.0)), None, "beside the posts");
        }
    }

    #[test]
    fn every_triangle_lies_in_the_boxes_of_its_ancestors() {
        let mesh = grid(70, 37, |i, j| ((i * 7919 + j * 104_729) % 101) as f64);
        let Mesh::Grid(g) = &mesh else { unreachable!() };
        let mut stack = vec![mesh.root()];
        let mut leaves = 0;
        while let Some(node) = stack.pop() {
            let b = mesh.bounds(node).unwrap();
            let (i, j) = g.cells(node);
            for (i, j) in j.flat_map(|j| i.clone().map(move |i| (i, j))) {
                let p = g.posts().world(i, j) - b.center;
                assert!(p.x.abs() <= b.axes[0].x && p.y.abs() <= b.axes[1].y && p.z.abs() <= b.axes[2].z);
            }
            if node.level > 0 { mesh.for_each_child(node, |n| stack.push(n)) } else { leaves += 1 }
        }
        assert_eq!(leaves, 5 * 3);
    }
}
