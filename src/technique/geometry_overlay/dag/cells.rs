//! The smallest triangles of a quad: which one holds a point, is entered by a segment, lies beyond an edge.
//!
//! Input: a quad, how its cells are split. Output: [`Cells`]. Refuses: nothing.

use super::grid::{Block, GridPoint};
use super::side::{is_left_of_edge, is_left_of_way};
use crate::terrain::lod::{Post, RightTriangle, splits_sw_ne};

/// Which triangles a quad has.
#[derive(Clone, Copy)]
pub enum Layers<'a> {
    /// The smallest, and all that they are halves of up to half the quad: 15 layers (3.3).
    All,
    /// The smallest alone, of a grid of which no level-of-detail mesh is made: whether the cell at column and row is split from south-west to
    /// north-east.
    Smallest(&'a dyn Fn([u32; 2]) -> bool),
}

/// A triangle, and which of its edges (0 from the apex, then counter-clockwise).
pub type AtEdge = (RightTriangle, usize);

/// The two ends of a triangle's edge, counter-clockwise.
pub fn edge_of(triangle: &RightTriangle, edge: usize) -> [Post; 2] {
    let corners = triangle.corners();
    [corners[edge], corners[(edge + 1) % 3]]
}

/// The halves of the cell of `size` posts a side at column and row, in such cells, which is split from south-west to north-east or the other way.
pub fn halves_of_cell(cell: [u32; 2], size: u32, is_sw_ne: bool) -> [RightTriangle; 2] {
    let halves = RightTriangle::of_cell(cell, size);
    if is_sw_ne == splits_sw_ne(cell) {
        return halves;
    }
    // The other diagonal: the ends of the longest sides are apexes.
    halves.map(|RightTriangle { apex, left, right }| RightTriangle {
        apex: left,
        left: [0, 1].map(|k| left[k] + right[k] - apex[k]),
        right: apex,
    })
}

/// The smallest triangles of a block.
pub struct Cells<'a> {
    block: Block,
    layers: Layers<'a>,
}

impl<'a> Cells<'a> {
    /// Of a block, whose cells are split as these layers are.
    pub fn new(block: Block, layers: Layers<'a>) -> Self {
        Self { block, layers }
    }

    /// The halves of the cell at column and row, in cells.
    fn halves(&self, cell: [u32; 2]) -> [RightTriangle; 2] {
        match self.layers {
            Layers::All => RightTriangle::of_cell(cell, self.block.stride),
            Layers::Smallest(splits) => halves_of_cell(cell, self.block.stride, splits(cell)),
        }
    }

    /// The triangle that holds a moved point; `None` outside.
    pub fn holding(&self, point: GridPoint) -> Option<RightTriangle> {
        let stride = f64::from(self.block.stride);
        let cell = self.block.square.holds(point).then(|| point.map(|v| (v / stride) as u32))?;
        let [lower, upper] = self.halves(cell);
        Some(if is_left_of_edge([lower.left, lower.right], point) { lower } else { upper })
    }

    /// The triangle by which the way from a moved point outside to another one enters, and its edge there; `None` if it does not.
    pub fn entered(&self, p: GridPoint, q: GridPoint) -> Option<AtEdge> {
        let Block { square, stride } = self.block;
        let [low, high] = square.corners();
        let is_beyond = |k: usize| {
            let (low, high) = (f64::from(low[k]), f64::from(high[k]));
            (p[k] < low && q[k] < low) || (p[k] >= high && q[k] >= high)
        };
        if is_beyond(0) || is_beyond(1) {
            return None;
        }
        let corners = [low, [high[0], low[1]], high, [low[0], high[1]]];
        let is_left = |post: Post| is_left_of_way(p, q, post);
        let lefts = corners.map(is_left);
        // As not both lie beyond the same side, neither has p the square behind it nor q before it: the line's entrance is the way's.
        let k = (0..4).find(|&k| lefts[k] && !lefts[(k + 1) % 4])?;
        let side = [corners[k], corners[(k + 1) % 4]];
        // Of the posts of this side the first ones are on the left of the way.
        let post = |n: u32| {
            [0, 1].map(|k| match side[1][k].cmp(&side[0][k]) {
                std::cmp::Ordering::Less => side[0][k] - n * stride,
                std::cmp::Ordering::Equal => side[0][k],
                std::cmp::Ordering::Greater => side[0][k] + n * stride,
            })
        };
        let (mut left, mut right) = (0, square.side / stride);
        while right - left > 1 {
            let middle = left + (right - left) / 2;
            *(if is_left(post(middle)) { &mut left } else { &mut right }) = middle;
        }
        self.beside([post(left), post(right)])
    }

    /// The triangle beyond an edge of one, and its edge there; `None` outside.
    pub fn across(&self, (triangle, edge): AtEdge) -> Option<AtEdge> {
        let [a, b] = edge_of(&triangle, edge);
        self.beside([b, a])
    }

    /// The triangle on the left of an edge; `None` outside.
    fn beside(&self, edge: [Post; 2]) -> Option<AtEdge> {
        let Block { square, stride } = self.block;
        let [a, b] = edge;
        let mut low = [0, 1].map(|k| a[k].min(b[k]));
        // On the left of an edge that goes north is the cell to the west, of one that goes west that to the south.
        if a[0] == b[0] && b[1] > a[1] {
            low[0] = low[0].checked_sub(stride)?;
        } else if a[1] == b[1] && b[0] < a[0] {
            low[1] = low[1].checked_sub(stride)?;
        }
        let [least, end] = square.corners();
        if (0..2).any(|k| low[k] < least[k] || low[k] >= end[k]) {
            return None;
        }
        let halves = self.halves(low.map(|at| at / stride));
        halves.into_iter().find_map(|half| Some((half, (0..3).find(|&k| edge_of(&half, k) == edge)?)))
    }
}
