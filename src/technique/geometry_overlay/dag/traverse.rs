//! Walks along a quad clipping over the triangles in use (3.2.1).
//!
//! Input: which posts are vertices of the mesh in use. Output: clippings, in the polyline's order. Refuses: nothing.

use super::structure::{QuadClipping, TriangleClipping};
use crate::terrain::lod::Post;
use std::ops::AddAssign;

/// What walks cost.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Cost {
    /// Clippings that a walk went to.
    pub visited: u64,
    /// Clippings that were asked, to find where to begin, whether they are over a triangle in use.
    pub tested: u64,
    /// Clippings that were drawn.
    pub drawn: u64,
}

impl AddAssign for Cost {
    fn add_assign(&mut self, other: Self) {
        self.visited += other.visited;
        self.tested += other.tested;
        self.drawn += other.drawn;
    }
}

impl QuadClipping {
    /// Algorithm 1: calls `draw` with each clipping over a triangle in use, in the polyline's order.
    ///
    /// `has_vertex` says which posts are vertices of the mesh in use, also where there is no post or no height: with a vertex it has all those that its
    /// triangles need, and the quad's corners.
    pub fn traverse(
        &self,
        has_vertex: impl Fn(Post) -> bool,
        mut draw: impl FnMut(&TriangleClipping),
    ) -> Cost {
        let mut cost = Cost::default();
        let mut at = self.in_use(0, &has_vertex, &mut cost);
        while let Some(clipping) = at {
            cost.visited += 1;
            cost.drawn += 1;
            draw(clipping);
            at = self.following(clipping, &has_vertex, &mut cost);
        }
        cost
    }

    /// How many clippings over smallest triangles there are: the first ones.
    pub(super) fn finest_count(&self) -> u32 {
        self.triangle_clippings.last().map_or(0, |last| last.finest_exit_descendant + 1)
    }

    /// The clipping over a triangle in use that holds one over a smallest triangle: climbs to the first with enabled vertices. (The apex is
    /// enabled after the ends of the longest side.)
    pub(super) fn in_use(
        &self,
        finest: u32,
        has_vertex: impl Fn(Post) -> bool,
        cost: &mut Cost,
    ) -> Option<&TriangleClipping> {
        let mut clipping = self.triangle_clippings.get(finest as usize)?;
        loop {
            cost.tested += 1;
            if has_vertex(clipping.triangle.apex) {
                return Some(clipping);
            }
            match clipping.parent() {
                Some(parent) => clipping = &self.triangle_clippings[parent as usize],
                None => return Some(clipping),
            }
        }
    }

    /// Which of the next clippings follows.
    ///
    /// Beyond the last posts the mesh in use is not closed, and layers may differ by more than one: where a polyline comes back from there, the next clipping is found as the first one is.
    pub(super) fn following(
        &self,
        clipping: &TriangleClipping,
        has_vertex: impl Fn(Post) -> bool,
        cost: &mut Cost,
    ) -> Option<&TriangleClipping> {
        let next = match clipping.next() {
            [next, None] => next,
            [finer, coarser] => {
                if has_vertex(clipping.decision_vertex) {
                    finer
                } else {
                    coarser
                }
            }
        };
        let next = &self.triangle_clippings[next? as usize];
        let is_split = next.triangle.middle().is_some_and(&has_vertex);
        if has_vertex(next.triangle.apex) && !is_split {
            return Some(next);
        }
        self.in_use(clipping.finest_exit_descendant + 1, has_vertex, cost)
    }
}
