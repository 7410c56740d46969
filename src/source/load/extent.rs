//! How far a surface reaches, and how far it may.

use crate::error::{Error, Result};
use crate::math::{max, min};
use crate::scene::{GlobePosts, Posts, Surface};
use crate::space::{Plan, PlanBox, World};
use glam::{DVec2, DVec3};

/// Refuses a terrain so far from 0, or so high, that nothing near it could be told apart.
pub(super) fn within_reach(surface: &Surface, bounds: &PlanBox, origin: DVec3) -> Result<()> {
    let (low, high) = height_range(surface, bounds);
    let local = [bounds.min.to_vec().extend(low), bounds.max.to_vec().extend(high)];
    let absolute = local.map(|corner| corner + origin);
    match absolute
        .into_iter()
        .chain(local)
        .flat_map(|corner| corner.to_array())
        .find(|number| !in_reach(*number))
    {
        None => Ok(()),
        Some(far) => Err(Error::new(format!("the terrain reaches {far:e} m, beyond {REACH:e} m"))
            .help("check the file's heights, its nodata value and position, and the scene's offset")),
    }
}

/// Whether a coordinate or height in metres is one that scenes can have.
pub(super) fn in_reach(number: f64) -> bool {
    number.abs() <= REACH
}

/// The farthest coordinate and the greatest height of a scene, in metres: some planets on. There a number has a
/// resolution of 0.1 mm.
pub(super) const REACH: f64 = 1e12;

/// The rectangle that a surface lies in.
pub(super) fn bounds(surface: &Surface) -> PlanBox {
    match surface {
        Surface::Grid(posts) => grid_bounds(posts),
        Surface::Points(points) => PlanBox::around(points.iter().map(|p| p.plan())),
        Surface::Globe(posts) => posts.plan_bounds(),
    }
}

pub(super) fn grid_bounds(posts: &Posts) -> PlanBox {
    let (i, j) = (posts.columns() - 1, posts.rows() - 1);
    PlanBox::around([(0, 0), (i, 0), (0, j), (i, j)].map(|(i, j)| posts.plan(i, j)))
}

/// The middle of a box, rounded to whole metres.
pub(super) fn middle(bounds: PlanBox) -> DVec2 {
    let sum = bounds.min.to_vec() * 0.5 + bounds.max.to_vec() * 0.5;
    DVec2::new(sum.x.round() + 0.0, sum.y.round() + 0.0)
}

/// The lowest and highest height of a surface inside a rectangle; of all of it where nothing lies inside.
pub(super) fn height_range(surface: &Surface, within: &PlanBox) -> (f64, f64) {
    let inside = |p: Plan| within.meets(&PlanBox { min: p, max: p });
    let (mut near, mut all) = (NOTHING, NOTHING);
    let mut take = |p: World| {
        if inside(p.plan()) {
            near = joined(near, p.z);
        }
        all = joined(all, p.z);
    };
    match surface {
        Surface::Grid(posts) | Surface::Globe(GlobePosts { posts, .. }) => {
            for j in 0..posts.rows() {
                (0..posts.columns()).for_each(|i| take(posts.world(i, j)));
            }
        }
        Surface::Points(points) => points.iter().for_each(|p| take(*p)),
    }
    let range = if near.0 <= near.1 { near } else { all };
    if range.0 <= range.1 { range } else { (0.0, 0.0) }
}

const NOTHING: (f64, f64) = (f64::INFINITY, f64::NEG_INFINITY);

/// A range grown to a height; NaN adds nothing.
fn joined((low, high): (f64, f64), z: f64) -> (f64, f64) {
    (min(z, low), max(z, high))
}
