//! The camera of a scene on a globe.

use crate::error::{Error, Result};
use crate::math::{cos, max, min, tan};
use crate::scene::{GlobePosts, Projection};
use crate::space::{Ellipsoid, Globe, Plan, PlanBox, ViewFrame, World};
use glam::DVec3;
use std::f64::consts::FRAC_PI_2;

/// A view looks down where the sine of its angle with the normal is below this (30 degrees): north is up then.
const DOWN: f64 = 0.5;

/// A subject that spans more of the ellipsoid's radius is seen as a part of a ball.
const REGIONAL: f64 = 0.35;

/// From how many radii a whole globe is seen.
const DISTANCE: f64 = 3.0;

/// A longitude and latitude of the globe's own CRS (degrees) and a height above the ellipsoid, in the world.
pub(in crate::source::load) fn place(globe: &Globe, at: DVec3) -> World {
    globe.world(globe.plan(at.x.to_radians(), at.y.to_radians()), at.z)
}

/// What is up in a picture where the scene does not say it: the ellipsoid's normal at the eye, or north of there for who looks down.
pub(in crate::source::load) fn up(globe: &Globe, eye: World, target: World) -> DVec3 {
    let (lon, lat) = globe.ellipsoid.geographic(eye.to_vec() + globe.world_origin);
    let [_, north, normal] = Ellipsoid::directions(lon, lat);
    let view = (target - eye).normalize_or_zero();
    if view.cross(normal).length() < DOWN { north } else { normal }
}

/// The eye and the target of a view of a part of the plan, whose heights are in a range: from the south of a small one, from outside of one
/// that spans a good part of the globe.
pub(in crate::source::load) fn framing(
    posts: &GlobePosts,
    subject: &PlanBox,
    heights: (f64, f64),
    projection: Projection,
    aspect: f64,
) -> Result<(World, World)> {
    let globe = &posts.globe;
    let fov_y_deg = match projection {
        Projection::Perspective { fov_y_deg } => fov_y_deg,
        Projection::Orthographic { .. } => 45.0,
    };
    let middle = Plan::from((subject.min.to_vec() + subject.max.to_vec()) * 0.5);
    let (lon, lat) = globe.geographic(middle);
    let [east, north, up] = Ellipsoid::directions(lon, lat);
    let (a, size) = (globe.ellipsoid.a, (subject.max - subject.min) / globe.ellipsoid.a);
    let ground = glam::DVec2::new(
        size.x * globe.ellipsoid.prime_vertical(lat) * cos(lat),
        size.y * globe.ellipsoid.meridian(lat),
    );
    if !(ground.is_finite() && heights.0.is_finite() && heights.1.is_finite()) {
        return Err(Error::internal("a globe without an extent"));
    }
    if max(ground.x, ground.y) <= REGIONAL * a && lat.abs() < FRAC_PI_2 - 0.01 {
        let half = ground * 0.5;
        let level = PlanBox { min: Plan::from(-half), max: Plan::from(half) };
        let (eye, target) = ViewFrame::framing(&level, heights, fov_y_deg, aspect);
        let foot = globe.world(middle, 0.0);
        let there = |p: World| foot + (east * p.x + north * p.y + up * p.z);
        return Ok((there(eye), there(target)));
    }
    // A ball of radius 1 fills the picture from 1 over the sine of half the narrower angle of view.
    let half = fov_y_deg.to_radians() * 0.5;
    let narrower = min(1.0, aspect) * tan(half);
    let least = (1.0 + narrower * narrower).sqrt() / narrower;
    let centre = World::from(-globe.world_origin);
    Ok((centre + up * (a * max(DISTANCE, 1.1 * least)), centre))
}
