//! The part of the squares' hierarchy that lies over a grid.
//!
//! Input: the posts of a grid or a globe. Output: [`Extent`]. Refuses: nothing.
//!
//! The squares start at post (0, 0); the largest is the smallest quad that holds the grid. Triangles count that reach into the grid from
//! the south-west; what only touches it is beside it.

use super::quad::{CELLS, Quad};
use super::right_triangle::{Post, RightTriangle};
use crate::terrain::Lattice;

/// The corner of no box over a grid.
const NOWHERE: [i64; 2] = [i64::MAX; 2];

/// How far a grid reaches, and the quad that holds it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Extent {
    /// The north-eastern post.
    pub last: Post,
    /// The level of the quad that holds all.
    pub root: u32,
    /// Whether the last column is the first one.
    is_closed: bool,
    /// Whether the first and the last row are at a pole.
    poles: [bool; 2],
}

impl Extent {
    /// That of some posts.
    pub fn of(lattice: &Lattice) -> Self {
        let last = lattice.size().map(|count| count as u32 - 1);
        let side = last[0].max(last[1]).next_power_of_two().max(CELLS);
        let root = side.trailing_zeros() - CELLS.trailing_zeros();
        Self { last, root, is_closed: lattice.is_closed(), poles: lattice.poles() }
    }

    /// The post that is the same place at the other end of a full circle.
    pub fn twin(&self, [column, row]: Post) -> Option<Post> {
        let twin = match column {
            0 => self.last[0],
            column if column == self.last[0] => 0,
            _ => return None,
        };
        (self.is_closed && row <= self.last[1]).then_some([twin, row])
    }

    /// Whether a post is at a pole.
    pub fn is_at_pole(&self, post: Post) -> bool {
        (self.poles[0] && post[1] == 0) || (self.poles[1] && post[1] == self.last[1])
    }

    /// Whether a triangle reaches beyond the posts' last column or row.
    pub fn is_beyond(&self, triangle: &RightTriangle) -> bool {
        (0..2).any(|k| triangle.corners().iter().any(|corner| corner[k] > self.last[k]))
    }

    /// The quad that holds all.
    pub fn root(&self) -> Quad {
        Quad { level: self.root, x: 0, y: 0 }
    }

    /// The largest square has 2^n posts a side.
    pub fn top(&self) -> u32 {
        self.root().side().trailing_zeros()
    }

    /// How many squares of 2^n posts a side lie over the grid, in columns and rows.
    pub fn cells(&self, n: u32) -> [u32; 2] {
        self.last.map(|last| last.div_ceil(1 << n))
    }

    /// Whether a triangle reaches into the grid, by the box around it.
    #[inline]
    pub fn holds(&self, triangle: &RightTriangle) -> bool {
        let [a, b, c] = triangle.corners();
        (0..2).all(|k| a[k].min(b[k]).min(c[k]) < self.last[k])
    }

    /// Whether a quad reaches into the grid.
    #[inline]
    pub fn holds_quad(&self, quad: Quad) -> bool {
        let [low, _] = quad.corners();
        low[0] < self.last[0] && low[1] < self.last[1]
    }

    /// The level of a post that is a vertex: every 2^n-th of every 2^n-th row, by the largest such n up to that of the largest square.
    #[inline]
    pub fn level_of(&self, [i, j]: Post) -> u32 {
        (i | j).trailing_zeros().min(self.top())
    }

    /// The quads of a level that hold a post, and reach into the grid.
    pub fn quads_at(&self, level: u32, post: Post) -> impl Iterator<Item = Quad> {
        let side = CELLS << level;
        let around = post.map(|at| {
            let own = at / side;
            (if at % side == 0 { own.saturating_sub(1) } else { own })..=own
        });
        let [xs, ys] = around;
        let extent = *self;
        ys.flat_map(move |y| xs.clone().map(move |x| Quad { level, x, y }))
            .filter(move |quad| extent.holds_quad(*quad))
    }

    /// The right angles of the triangles whose longest side a post halves: it is a vertex only where these are. The corners of the largest square
    /// halve none.
    pub fn apexes(&self, post: Post) -> impl Iterator<Item = Post> {
        let n = self.level_of(post);
        let step = 1i64 << n;
        let at = post.map(i64::from);
        let is_odd = at.map(|at| at >> n & 1 == 1);
        // Where they are, and the south-western corners of the boxes around the triangles.
        let around: [([i64; 2], [i64; 2]); 2] =
            match is_odd {
                // The middle of a square, which its diagonal runs through.
                [true, true] => {
                    let low = [at[0] - step, at[1] - step];
                    let along = if super::splits_sw_ne(post.map(|at| at >> (n + 1))) { 1 } else { -1 };
                    let off = |side: i64| [at[0] + side * step, at[1] - side * along * step];
                    [(off(1), low), (off(-1), low)]
                }
                // The middle of a square's side from west to east, or from south to north.
                [true, false] => [1, -1]
                    .map(|side| ([at[0], at[1] + side * step], [at[0] - step, at[1] + side.min(0) * step])),
                [false, true] => [1, -1]
                    .map(|side| ([at[0] + side * step, at[1]], [at[0] + side.min(0) * step, at[1] - step])),
                [false, false] => [(at, NOWHERE); 2],
            };
        let around = if n < self.top() { around } else { [(at, NOWHERE); 2] };
        let last = self.last.map(i64::from);
        let is_over = move |low: [i64; 2]| (0..2).all(|k| low[k] >= 0 && low[k] < last[k]);
        around.into_iter().filter(move |(_, low)| is_over(*low)).map(|(apex, _)| apex.map(|at| at as u32))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    fn for_each(extent: &Extent, triangle: RightTriangle, visit: &mut impl FnMut(&RightTriangle)) {
        if extent.holds(&triangle) {
            visit(&triangle);
            triangle.halves().into_iter().flatten().for_each(|half| for_each(extent, half, visit));
        }
    }

    fn of_size(columns: u32, rows: u32) -> Extent {
        let last = [columns - 1, rows - 1];
        let side = last[0].max(last[1]).next_power_of_two().max(CELLS);
        Extent { last, root: (side / CELLS).trailing_zeros(), is_closed: false, poles: [false; 2] }
    }

    #[test]
    fn the_right_angles_around_a_post_are_those_of_the_triangles_that_it_halves() {
        for (columns, rows) in [(129, 129), (130, 257), (5, 140), (300, 131)] {
            let extent = of_size(columns, rows);
            let mut expected: BTreeMap<Post, Vec<Post>> = BTreeMap::new();
            for root in extent.root().roots() {
                for_each(&extent, root, &mut |triangle| {
                    if let Some(middle) = triangle.middle() {
                        expected.entry(middle).or_default().push(triangle.apex);
                    }
                });
            }
            for (post, mut apexes) in expected {
                let mut found: Vec<Post> = extent.apexes(post).collect();
                found.sort_unstable();
                apexes.sort_unstable();
                assert_eq!(found, apexes, "{post:?} of {columns} x {rows}");
            }
            let corners = extent.root().corners();
            assert!(corners.iter().all(|corner| extent.apexes(*corner).count() == 0));
        }
    }
}
