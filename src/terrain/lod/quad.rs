//! The quads that a level-of-detail mesh is drawn by (Wartell et al. 2003, 2.1: quadnodes).
//!
//! Input: nothing. Output: [`Quad`] and [`QuadInUse`]. Refuses: nothing.

use super::right_triangle::{Post, RightTriangle};

/// Cells a side of a quad's block: 129 x 129 vertices.
pub const CELLS: u32 = 128;

/// A square of the grid with a block of vertices that are 2^level posts apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Quad {
    /// 0: every post is a vertex.
    pub level: u32,
    /// Column among the quads of its level.
    pub x: u32,
    /// Row among the quads of its level.
    pub y: u32,
}

/// A quad that is drawn, and the quad whose block of vertices it is drawn by: itself, or one that holds it (3.2.1: borrowed data).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct QuadInUse {
    /// What is drawn.
    pub quad: Quad,
    /// Whose vertices.
    pub data: Quad,
}

impl Quad {
    /// How far apart its vertices are, posts.
    #[inline]
    pub fn stride(self) -> u32 {
        1 << self.level
    }

    /// How long its sides are, posts.
    #[inline]
    pub fn side(self) -> u32 {
        CELLS << self.level
    }

    /// Its south-western and its north-eastern corner.
    #[inline]
    pub fn corners(self) -> [Post; 2] {
        let side = self.side();
        [[self.x * side, self.y * side], [(self.x + 1) * side, (self.y + 1) * side]]
    }

    /// Whether a post lies in it or on its border.
    #[inline]
    pub fn contains(self, post: Post) -> bool {
        let [low, high] = self.corners();
        (0..2).all(|k| low[k] <= post[k] && post[k] <= high[k])
    }

    /// The two triangles that it is covered by at least.
    pub fn roots(self) -> [RightTriangle; 2] {
        RightTriangle::of_cell([self.x, self.y], self.side())
    }

    /// The quad of the next level that it is a quarter of.
    #[inline]
    pub fn parent(self) -> Self {
        Self { level: self.level + 1, x: self.x / 2, y: self.y / 2 }
    }

    /// Its quarters, row by row; none of a quad of level 0.
    pub fn children(self) -> Option<[Self; 4]> {
        let level = self.level.checked_sub(1)?;
        let (x, y) = (2 * self.x, 2 * self.y);
        Some([[x, y], [x + 1, y], [x, y + 1], [x + 1, y + 1]].map(|[x, y]| Self { level, x, y }))
    }
}
