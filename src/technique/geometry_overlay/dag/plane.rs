//! What the points of a triangle have that is known of its corners: a height, a point of space.
//!
//! Input: a triangle, what its corners have. Output: [`Plane`]. Refuses: nothing.

use super::crossing::Crossing;
use super::grid::GridPoint;
use crate::terrain::lod::{Post, RightTriangle};
use std::ops::{Add, Mul, Sub};

/// A triangle with what its corners have.
#[derive(Debug, Clone, Copy)]
pub struct Plane<V> {
    triangle: RightTriangle,
    corners: [V; 3],
}

impl<V> Plane<V>
where
    V: Copy + Add<Output = V> + Sub<Output = V> + Mul<f64, Output = V>,
{
    /// Of a triangle whose corners have what `of` says.
    pub fn new(triangle: RightTriangle, of: impl Fn(Post) -> V) -> Self {
        Self { triangle, corners: triangle.corners().map(of) }
    }

    /// What the corners have, from the apex on.
    pub fn corners(&self) -> &[V; 3] {
        &self.corners
    }

    /// What a point has: the combination of the corners that it is.
    pub fn at(&self, [x, y]: GridPoint) -> V {
        let Self { triangle, corners: [apex, left, right] } = *self;
        let [east, north] = [x - f64::from(triangle.apex[0]), y - f64::from(triangle.apex[1])];
        // Legs at a right angle, as long as powers of two or diagonals of such squares.
        let share = |end: Post| {
            let [u, v] = [0, 1].map(|k| f64::from(end[k]) - f64::from(triangle.apex[k]));
            (u * east + v * north) / (u * u + v * v)
        };
        let along = (left - apex) * share(triangle.left);
        apex + along + (right - apex) * share(triangle.right)
    }

    /// What a crossing of one of its edges has: what the edge has there, whichever of its two triangles asks. `None` where no edge runs that way.
    pub fn on_edge(&self, crossing: &Crossing) -> Option<V> {
        let [low, high] = crossing.direction.edge_of(&self.triangle)?;
        let of = |end: Post| {
            let corner = self.triangle.corners().iter().position(|post| *post == end);
            self.corners[corner.unwrap_or(2)]
        };
        let k = usize::from(low[0] == high[0]);
        let [from, to] = [low, high].map(|end| f64::from(end[k]));
        let (start, end) = (of(low), of(high));
        Some(start + (end - start) * ((crossing.at[k] - from) / (to - from)))
    }
}
