//! The triangles over a grid or a globe with their errors, from which each view's mesh is made.
//!
//! Input: the posts. Output: [`Hierarchy`]. Refuses: diagonals that are not those of the smallest triangles, fewer posts than a quad has.

use super::errors::Errors;
use super::extent::Extent;
use super::hull::{Around, Hull};
use super::quad::CELLS;
use super::right_triangle::{Post, RightTriangle};
use crate::error::{Error, Result};
use crate::math;
use crate::scene::Diagonal;
use crate::space::World;
use crate::terrain::{Bounds, Grid, Lattice};
use glam::DVec3;

/// All restricted quadtree triangulations of a grid or a globe.
#[derive(Debug)]
pub struct Hierarchy {
    lattice: Lattice,
    extent: Extent,
    heights: (f64, f64),
    errors: Errors,
    /// See [`Lattice::core`].
    core: Option<(World, f64)>,
}

impl Hierarchy {
    /// That of a grid or a globe, with the errors of its triangles.
    ///
    /// # Errors
    /// When the diagonals do not alternate, or both sides have fewer than 129 posts.
    pub fn new(lattice: Lattice) -> Result<Self> {
        let [columns, rows] = lattice.size();
        if lattice.diagonal() != Diagonal::Alternating {
            let what = "only cells whose diagonals alternate nest in a level-of-detail mesh";
            return Err(Error::new(what).help("write terrain.diagonal = \"alternating\""));
        }
        if columns.max(rows) <= CELLS as usize {
            let what =
                format!("a terrain of {columns} x {rows} posts is too small for a level-of-detail mesh");
            return Err(Error::new(what).help("its quads have 129 x 129 posts: leave `terrain.lod` out"));
        }
        let (extent, heights, core) = (Extent::of(&lattice), lattice.heights(), lattice.core());
        let errors = Errors::new(&lattice);
        Ok(Self { lattice, extent, heights, errors, core })
    }

    /// The posts.
    pub(super) fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// What nothing is seen through: a globe's middle, and how far its surface is from there at least.
    pub(super) fn core(&self) -> Option<(World, f64)> {
        self.core
    }

    /// Its part of the hierarchy of squares.
    pub(super) fn extent(&self) -> Extent {
        self.extent
    }

    /// The errors of its triangles.
    pub(super) fn errors(&self) -> &Errors {
        &self.errors
    }

    /// What is around a triangle and what of the full surface lies over it.
    pub(super) fn around(&self, triangle: &RightTriangle, error: f32) -> Around {
        match &self.lattice {
            Lattice::Plane(grid) => Around::Box(self.bounds(grid, triangle, error)),
            Lattice::Globe(_) if error.is_finite() => Around::Hull(Hull {
                corners: triangle.corners().map(|post| self.lattice.vertex(post).world),
                reach: error.into(),
            }),
            Lattice::Globe(_) => {
                let corners = triangle.corners();
                let ends = |k: usize| {
                    let at = corners.map(|post| post[k]);
                    (at[0].min(at[1]).min(at[2]), at[0].max(at[1]).max(at[2]))
                };
                let ((west, east), (south, north)) = (ends(0), ends(1));
                let bounds = self.lattice.bounds_of([[west, south], [east, north]], self.heights);
                Around::Hull(Hull { corners: [bounds.center; 3], reach: bounds.axes[0].length() })
            }
        }
    }

    /// The box around a triangle over a plane and what of the full surface lies over it.
    fn bounds(&self, grid: &Grid, triangle: &RightTriangle, error: f32) -> Bounds {
        let posts = grid.posts();
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
                let heights = corners.map(|post| self.lattice.height(post));
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
        triangle.corners().into_iter().all(|post: Post| !self.lattice.height(post).is_nan())
    }
}
