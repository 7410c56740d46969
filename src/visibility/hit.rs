//! The surface point of a sample whose triangle is known.

use crate::predicate::{TrianglePlane, hit_weights};
use crate::space::{Plan, Ray, ViewFrame, World};
use crate::terrain::{PlanMap, SurfaceTriangle, TriangleDrape};

/// Where a ray meets the terrain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// The plan point.
    pub plan: Plan,
    /// The surface point.
    pub world: World,
    /// View depth in metres.
    pub depth: f64,
}

/// Where a ray meets a triangle's plane.
#[inline]
pub fn hit(frame: &ViewFrame, ray: &Ray, triangle: &SurfaceTriangle) -> Hit {
    let (world, depth) = on_plane(frame, ray, &TrianglePlane::new(&triangle.world));
    let plan = match &triangle.drape {
        TriangleDrape::Vertical => world.plan(),
        TriangleDrape::Affine { plan, .. } => draped(ray, world, (&triangle.world, plan)),
    };
    Hit { plan, world, depth }
}

/// Where a ray meets a plane that many rays may meet, and its view depth.
#[inline]
pub(super) fn on_plane(frame: &ViewFrame, ray: &Ray, plane: &TrianglePlane) -> (World, f64) {
    let t = plane.hit_parameter(ray);
    (ray.from + (ray.through - ray.from) * t, t * frame.reach())
}

/// The plan point of the point in which a ray meets a triangle's plane.
fn draped(ray: &Ray, at: World, (corners, plan): (&[World; 3], &[Plan; 3])) -> Plan {
    let map = PlanMap::new(corners, plan);
    if map.is_sure() {
        return map.at(at);
    }
    let [of_b, of_c] = hit_weights(ray, corners);
    let [a, b, c] = *plan;
    a + ((b - a) * of_b + (c - a) * of_c)
}
