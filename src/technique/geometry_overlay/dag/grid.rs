//! Places and squares of a grid of posts.
//!
//! Input: nothing. Output: [`GridPoint`], [`Square`], [`Block`]. Refuses: nothing.

use crate::terrain::lod::{Post, Quad, RightTriangle};

/// A place in grid coordinates: columns east and rows north of the south-western post.
pub type GridPoint = [f64; 2];

/// A square of the grid, at a multiple of its side.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Square {
    /// How long its sides are, posts.
    pub side: u32,
    /// Its south-western corner.
    pub low: Post,
}

/// A square with cells: a quad's block of vertices.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Block {
    /// All of it.
    pub square: Square,
    /// How far apart its vertices are, posts.
    pub stride: u32,
}

impl From<Quad> for Square {
    fn from(quad: Quad) -> Self {
        Self { side: quad.side(), low: quad.corners()[0] }
    }
}

impl From<Quad> for Block {
    fn from(quad: Quad) -> Self {
        Self { square: quad.into(), stride: quad.stride() }
    }
}

impl Square {
    /// Its south-western and its north-eastern corner.
    pub fn corners(&self) -> [Post; 2] {
        [self.low, self.low.map(|at| at + self.side)]
    }

    /// The square of such a side that holds a triangle, which is no larger.
    #[inline]
    pub fn around(side: u32, triangle: &RightTriangle) -> Self {
        // The middle of its corners is no point of a border.
        let [a, b, c] = triangle.corners();
        let low = [0, 1].map(|k| {
            let sum = u64::from(a[k]) + u64::from(b[k]) + u64::from(c[k]);
            (sum / (3 * u64::from(side))) as u32 * side
        });
        Self { side, low }
    }

    /// Whether a moved point lies in it.
    pub fn holds(&self, point: GridPoint) -> bool {
        let [low, high] = self.corners().map(|corner| corner.map(f64::from));
        (0..2).all(|k| low[k] <= point[k] && point[k] < high[k])
    }
}
