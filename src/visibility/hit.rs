//! The surface point of a sample whose triangle is known.

use crate::predicate::TrianglePlane;
use crate::space::{Plan, Ray, ViewFrame, World};

/// Where a ray meets the terrain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// The plan point.
    pub plan: Plan,
    /// Height in metres.
    pub height: f64,
    /// View depth in metres.
    pub depth: f64,
}

/// Where a ray meets a triangle's plane.
#[inline]
pub fn hit(frame: &ViewFrame, ray: &Ray, triangle: &[World; 3]) -> Hit {
    hit_plane(frame, ray, &TrianglePlane::new(triangle))
}

/// Where a ray meets a plane that many rays may meet.
#[inline]
pub(super) fn hit_plane(frame: &ViewFrame, ray: &Ray, plane: &TrianglePlane) -> Hit {
    let t = plane.hit_parameter(ray);
    let at = ray.from + (ray.through - ray.from) * t;
    Hit { plan: at.plan(), height: at.z, depth: t * frame.reach() }
}
