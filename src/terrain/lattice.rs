//! The posts of a terrain as a lattice of columns and rows, over a plane or over a globe.
//!
//! Input: a grid, a globe's mesh. Output: [`Lattice`]. Refuses: nothing; beside the posts there are none.

use super::lod::Post;
use super::{Bounds, Drape, GlobeMesh, Grid, SurfaceVertex};
use crate::math;
use crate::scene::Diagonal;
use crate::space::{Plan, PlanBox, World};
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// The posts, column by column eastwards, row by row northwards.
#[derive(Debug, Clone)]
pub enum Lattice {
    /// Those of a grid, straight over the plan.
    Plane(Arc<Grid>),
    /// Those of a globe, along its normals. Rows at a pole are rows of the lattice, all of whose posts are one point; where the posts go all around, the last
    /// column is the first one, a turn on.
    Globe(Arc<GlobeMesh>),
}

/// So much wider may a cell at a globe's seam or a pole be than the others.
const WIDER: f64 = 1.02;

impl Lattice {
    /// Columns and rows.
    pub fn size(&self) -> [usize; 2] {
        match self {
            Self::Plane(grid) => [grid.posts().columns(), grid.posts().rows()],
            Self::Globe(globe) => globe.size(),
        }
    }

    /// Whether the last column is the first one.
    pub fn is_closed(&self) -> bool {
        match self {
            Self::Plane(_) => false,
            Self::Globe(globe) => globe.posts().is_closed,
        }
    }

    /// Whether the first and the last row are at a pole.
    pub fn poles(&self) -> [bool; 2] {
        match self {
            Self::Plane(_) => [false; 2],
            Self::Globe(globe) => globe.poles(),
        }
    }

    /// How cells are split.
    pub(super) fn diagonal(&self) -> Diagonal {
        match self {
            Self::Plane(grid) => grid.diagonal(),
            Self::Globe(globe) => globe.diagonal(),
        }
    }

    /// Which way a cell is split: true from south-west to north-east.
    pub fn splits_sw_ne(&self, [column, row]: [u32; 2]) -> bool {
        super::grid::splits_sw_ne(self.diagonal(), column as usize, row as usize)
    }

    /// The height of a post, over the plane or above the ellipsoid; NaN where there is none.
    #[inline]
    pub fn height(&self, post: Post) -> f64 {
        match self {
            Self::Plane(grid) => {
                let (posts, [column, row]) = (grid.posts(), post.map(|at| at as usize));
                if column < posts.columns() && row < posts.rows() {
                    posts.heights()[row * posts.columns() + column]
                } else {
                    f64::NAN
                }
            }
            Self::Globe(globe) => globe.height(post),
        }
    }

    /// Where a post that is there stands.
    pub fn vertex(&self, post: Post) -> SurfaceVertex {
        match self {
            Self::Plane(grid) => {
                SurfaceVertex::vertical(grid.posts().world(post[0] as usize, post[1] as usize))
            }
            Self::Globe(globe) => globe.vertex(post),
        }
    }

    /// How meshes of these posts are draped.
    pub(super) fn drape(&self) -> Drape {
        match self {
            Self::Plane(_) => Drape::Vertical,
            Self::Globe(_) => Drape::Affine,
        }
    }

    /// The lowest and the highest post; 0 where there is none.
    pub fn heights(&self) -> (f64, f64) {
        match self {
            Self::Plane(grid) => grid.heights(),
            Self::Globe(globe) => globe.heights(),
        }
    }

    pub(super) fn plan_bounds(&self) -> PlanBox {
        match self {
            Self::Plane(grid) => grid.plan_bounds(),
            Self::Globe(globe) => globe.plan_bounds(),
        }
    }

    pub(super) fn resolution(&self) -> f64 {
        match self {
            Self::Plane(grid) => grid.resolution(),
            Self::Globe(globe) => globe.resolution(),
        }
    }

    /// A box around all surfaces between the posts of a rectangle, given by its corners, whose heights are in a range. What of the rectangle lies beyond the
    /// posts counts as on a plane, and not on a globe.
    pub fn bounds_of(&self, [low, high]: [Post; 2], heights: (f64, f64)) -> Bounds {
        match self {
            Self::Plane(grid) => {
                let posts = grid.posts();
                let half = [0, 1].map(|k| f64::from(high[k] - low[k]) / 2.0);
                let middle = [0, 1].map(|k| (f64::from(low[k]) + f64::from(high[k])) / 2.0);
                let at = posts.first + (posts.east() * middle[0] + posts.north() * middle[1]);
                Bounds {
                    center: World::new(at.x, at.y, (heights.0 + heights.1) / 2.0),
                    axes: [
                        (posts.east() * half[0]).extend(0.0),
                        (posts.north() * half[1]).extend(0.0),
                        DVec3::Z * ((heights.1 - heights.0) / 2.0),
                    ],
                }
            }
            Self::Globe(globe) => {
                let last = globe.size().map(|count| count as u32 - 1);
                let [low, high] = [low, high].map(|[i, j]| [i.min(last[0]), j.min(last[1])]);
                let place =
                    |[i, j]: Post| Plan::new(globe.posts().column(i as usize), globe.y_of(j as usize));
                let (center, reach) = ball(globe, [place(low), place(high)], heights);
                Bounds { center, axes: [DVec3::X * reach, DVec3::Y * reach, DVec3::Z * reach] }
            }
        }
    }

    /// The middle of a globe, and how far all that its surface may be made of is from there at least; `None` where what lies behind the surface may be
    /// seen through it: of planes, parts of a globe, surfaces with holes.
    pub(super) fn core(&self) -> Option<(World, f64)> {
        let Self::Globe(globe) = self else { return None };
        let posts = globe.posts();
        let is_whole = posts.is_closed
            && globe.poles() == [true; 2]
            && posts.posts.heights().iter().all(|height| !height.is_nan());
        let ellipsoid = posts.globe.ellipsoid;
        let (low, high) = globe.heights();
        let least = ellipsoid.b() + math::min(low, 0.0);
        // No side of a smallest triangle is longer: two ways on the ground and up.
        let step = (posts.posts.east().x + posts.posts.north().y) / ellipsoid.a;
        let side = WIDER * step * (widest_radius(globe) + high.abs()) + (high - low);
        // A point of a triangle is no farther from its corners than that, on the average by weight: of the squares of lengths a third of the sides'.
        let square = least * least - side * side / 3.0;
        (is_whole && least > 0.0 && square > 0.0)
            .then(|| (World::from(-posts.globe.world_origin), square.sqrt()))
    }
}

/// No radius of curvature of the ellipsoid is larger.
fn widest_radius(globe: &GlobeMesh) -> f64 {
    let ellipsoid = globe.posts().globe.ellipsoid;
    math::max(ellipsoid.a * ellipsoid.a / ellipsoid.b(), ellipsoid.b() * ellipsoid.b() / ellipsoid.a)
}

/// A ball around all that lies over a rectangle of a globe's plan between two heights: no way along a meridian, a parallel and the normal is longer.
fn ball(globe: &GlobeMesh, [low, high]: [Plan; 2], heights: (f64, f64)) -> (World, f64) {
    let own = &globe.posts().globe;
    let half = (high - low) / 2.0;
    let middle = low + half;
    let center = own.world(middle, (heights.0 + heights.1) / 2.0);
    let radius = widest_radius(globe) + math::max(heights.0.abs(), heights.1.abs());
    let lats = [low, high].map(|at| own.geographic(at).1);
    let nearest = if lats[0] * lats[1] < 0.0 { 0.0 } else { math::min(lats[0].abs(), lats[1].abs()) };
    let angles: DVec2 = half / own.ellipsoid.a;
    let way = radius * (angles.x * math::cos(nearest) + angles.y) + (heights.1 - heights.0) / 2.0;
    (center, way * (1.0 + 1e-9))
}
