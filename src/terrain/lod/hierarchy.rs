//! The triangles of a grid with their errors, from which each view's mesh is made.
//!
//! Input: a grid. Output: [`Hierarchy`]. Refuses: a grid whose diagonals are not those of the smallest triangles, one that is smaller than a quad.

use super::errors::Errors;
use super::extent::Extent;
use super::quad::CELLS;
use super::right_triangle::{Post, RightTriangle};
use crate::error::{Error, Result};
use crate::math;
use crate::scene::Diagonal;
use crate::space::World;
use crate::terrain::{Bounds, Grid};
use glam::DVec3;
use std::sync::Arc;

/// All restricted quadtree triangulations of a grid.
#[derive(Debug)]
pub struct Hierarchy {
    grid: Arc<Grid>,
    extent: Extent,
    heights: (f64, f64),
    errors: Errors,
}

impl Hierarchy {
    /// That of a grid, with the errors of its triangles.
    ///
    /// # Errors
    /// When the grid's diagonals do not alternate, or both its sides have fewer than 129 posts.
    pub fn new(grid: Arc<Grid>) -> Result<Self> {
        let [columns, rows] = [grid.posts().columns(), grid.posts().rows()];
        if grid.diagonal() != Diagonal::Alternating {
            let what = "only cells whose diagonals alternate nest in a level-of-detail mesh";
            return Err(Error::new(what).help("write terrain.diagonal = \"alternating\""));
        }
        if columns.max(rows) <= CELLS as usize {
            let what =
                format!("a terrain of {columns} x {rows} posts is too small for a level-of-detail mesh");
            return Err(Error::new(what).help("its quads have 129 x 129 posts: leave `terrain.lod` out"));
        }
        let extent = Extent::new(columns, rows);
        let heights = grid.heights();
        let errors = Errors::new(grid.posts(), heights);
        Ok(Self { grid, extent, heights, errors })
    }

    /// The grid.
    pub(super) fn grid(&self) -> &Arc<Grid> {
        &self.grid
    }

    /// Its part of the hierarchy of squares.
    pub(super) fn extent(&self) -> Extent {
        self.extent
    }

    /// The errors of its triangles.
    pub(super) fn errors(&self) -> &Errors {
        &self.errors
    }

    /// The box around a triangle and what of the full surface lies over it.
    pub(super) fn bounds(&self, triangle: &RightTriangle, error: f32) -> Bounds {
        let posts = self.grid.posts();
        let corners = triangle.corners();
        let ends = |k: usize| {
            let at = corners.map(|post| post[k]);
            let last = self.extent.last[k];
            let (low, high) = (at[0].min(at[1]).min(at[2]), at[0].max(at[1]).max(at[2]).min(last));
            (f64::from(low) + f64::from(high - low) / 2.0, f64::from(high - low) / 2.0)
        };
        let ((i, half_i), (j, half_j)) = (ends(0), ends(1));
        let (low, high) = match error.is_finite() {
            true => {
                let heights = corners.map(|post| self.height(post));
                let most = f64::from(error);
                let low = math::min(math::min(heights[0], heights[1]), heights[2]);
                let high = math::max(math::max(heights[0], heights[1]), heights[2]);
                (low - most, high + most)
            }
            false => self.heights,
        };
        let plan = posts.first + (posts.east() * i + posts.north() * j);
        Bounds {
            center: World::new(plan.x, plan.y, (low + high) / 2.0),
            axes: [
                (posts.east() * half_i).extend(0.0),
                (posts.north() * half_j).extend(0.0),
                DVec3::Z * ((high - low) / 2.0),
            ],
        }
    }

    /// Whether all corners of a triangle are posts that are there.
    pub(super) fn has_corners(&self, triangle: &RightTriangle) -> bool {
        let last = self.extent.last;
        let is_there = |post: Post| post[0] <= last[0] && post[1] <= last[1] && !self.height(post).is_nan();
        triangle.corners().into_iter().all(is_there)
    }

    /// A post's height; NaN where there is none.
    fn height(&self, [i, j]: Post) -> f64 {
        let posts = self.grid.posts();
        posts.heights()[j as usize * posts.columns() + i as usize]
    }
}
