//! The largest distance of a triangle from its posts, found by what is known of the triangles that it may be split into.
//!
//! Input: a triangle's plane, the largest distances of all below it from their posts. Output: its own. Refuses: nothing.
//!
//! The difference of two planes is largest at a corner: no post of a smaller triangle is farther from the larger one than the most of its corners and its own
//! largest distance together. Where that is no more than a distance that was found, nothing below is looked at (branch and bound; Land and Doig 1960). The result is
//! the same as that of looking at every post, to the bit.

use super::deviation::{Slope, Value, Window};
use super::right_triangle::RightTriangle;
use crate::math;

/// Looking for the post that is farthest from a plane.
pub(super) struct Search<'a, V, W> {
    slope: Slope<V>,
    window: &'a Window<V>,
    /// The largest distance of the posts in a triangle from itself.
    within: W,
    /// What roundings may add to a bound.
    slack: f64,
    is_level: bool,
    most: f64,
    /// How many more posts are worth it.
    left: u32,
}

impl<'a, V: Value, W: Fn(&RightTriangle) -> f64> Search<'a, V, W> {
    /// Nothing is found; after `left` posts the search is given up.
    pub fn new(slope: Slope<V>, window: &'a Window<V>, within: W, (slack, left): (f64, u32)) -> Self {
        Self { slope, window, within, slack, is_level: slope.is_level(), most: 0.0, left }
    }

    /// The distance of the farthest post of a triangle; `None` where looking at all is quicker.
    pub fn over(mut self, triangle: &RightTriangle) -> Option<f64> {
        let corners = triangle.corners().map(|post| self.off(post));
        corners.into_iter().for_each(|off| self.most = math::max(off, self.most));
        self.split(triangle, corners).then_some(self.most)
    }

    #[inline(always)]
    fn off(&self, post: super::Post) -> f64 {
        (self.slope.at(post.map(f64::from)) - self.window.at(post)).size()
    }

    /// Looks at the posts in a triangle, by how far its corners are off; `false`: it is given up.
    fn split(&mut self, triangle: &RightTriangle, [apex, left, right]: [f64; 3]) -> bool {
        let Some((middle, halves)) = triangle.middle().zip(triangle.halves()) else { return true };
        let Some(less) = self.left.checked_sub(1) else { return false };
        self.left = less;
        let off = self.off(middle);
        self.most = math::max(off, self.most);
        let corners = [[off, apex, left], [off, right, apex]];
        // What is farther off first: then less is left to be looked at.
        let first = usize::from(right > left);
        [first, 1 - first]
            .into_iter()
            .all(|k| self.is_ruled_out(&halves[k], corners[k]) || self.split(&halves[k], corners[k]))
    }

    /// Whether no post in a triangle is farther off than one that was found.
    #[inline(always)]
    fn is_ruled_out(&self, triangle: &RightTriangle, [apex, left, right]: [f64; 3]) -> bool {
        let bound = math::max(math::max(apex, left), right) + (self.within)(triangle);
        // Of a level plane through level ground nothing is rounded.
        bound + self.slack <= self.most || bound == 0.0 && self.is_level
    }
}
