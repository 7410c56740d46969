//! The surface point of a sample whose triangle is known.

use crate::predicate;
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
    let t = predicate::hit_parameter(ray, triangle);
    let along = ray.through - ray.from;
    let at = ray.from + along * t;
    Hit { plan: at.plan(), height: at.z, depth: t * frame.reach() }
}
