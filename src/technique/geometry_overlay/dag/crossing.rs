//! Where a chain crosses the line that an edge lies on: one set of bits for all triangles of all quads that have an edge there.
//!
//! Input: the ends of a segment and of an edge. Output: [`Crossing`]. Refuses: nothing.

use super::grid::GridPoint;
use crate::predicate::Expansion;
use crate::terrain::lod::{Post, RightTriangle};

/// Which way an edge runs. Each of a triangle's has another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// South to north.
    Column,
    /// West to east.
    Row,
    /// South-west to north-east.
    Rising,
    /// North-west to south-east.
    Falling,
}

/// A point where a chain crosses an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// Where, to the nearest doubles.
    pub at: GridPoint,
    /// Which way the edge runs.
    pub direction: Direction,
}

impl Direction {
    /// Of the edge between two posts.
    pub fn of([a, b]: [Post; 2]) -> Self {
        if a[0] == b[0] {
            Self::Column
        } else if a[1] == b[1] {
            Self::Row
        } else if (a[0] < b[0]) == (a[1] < b[1]) {
            Self::Rising
        } else {
            Self::Falling
        }
    }

    /// How far a point lies beyond the line that runs this way through a post, in some unit; exact.
    fn beyond(self, point: GridPoint, post: Post) -> Expansion {
        let [x, y] = [0, 1].map(|k| Expansion::difference(point[k], f64::from(post[k])));
        match self {
            Self::Column => x,
            Self::Row => y,
            Self::Rising => x.minus(&y),
            Self::Falling => x.plus(&y),
        }
    }

    /// The edge of a triangle that runs this way, from its lesser end; `None` if none does.
    pub fn edge_of(self, triangle: &RightTriangle) -> Option<[Post; 2]> {
        let [a, b, c] = triangle.corners();
        let edge = [[a, b], [b, c], [c, a]].into_iter().find(|edge| Self::of(*edge) == self);
        edge.map(|[a, b]| [a.min(b), a.max(b)])
    }
}

impl Crossing {
    /// Of the segment between two points with an edge that it crosses when it is moved (so its ends lie on either side of the edge's line, or
    /// on it). The same from either end of either.
    pub fn new(p: GridPoint, q: GridPoint, edge: [Post; 2]) -> Self {
        let direction = Direction::of(edge);
        let [p, q] = if p <= q { [p, q] } else { [q, p] };
        let [from, to] = [p, q].map(|end| direction.beyond(end, edge[0]));
        let at = if from.sign() == 0.0 {
            p
        } else if to.sign() == 0.0 {
            q
        } else {
            let whole = to.minus(&from);
            [0, 1].map(|k| match (direction, k) {
                (Direction::Column, 0) | (Direction::Row, 1) => f64::from(edge[0][k]),
                _ => quotient(&to.scaled(p[k]).minus(&from.scaled(q[k])), &whole),
            })
        };
        Self { at, direction }
    }
}

/// A quotient, rounded to the nearest double but for a share of its last digit that is as small again as this: a crossing between two posts
/// never lies beyond one.
fn quotient(of: &Expansion, by: &Expansion) -> f64 {
    let divisor = by.rounded();
    let first = of.rounded() / divisor;
    // Of the two zeros the positive one, whichever way a line was walked.
    first + of.minus(&by.scaled(first)).rounded() / divisor + 0.0
}
