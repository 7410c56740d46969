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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::Viewpoint;
    use glam::DVec3;

    #[test]
    fn the_plan_point_on_a_needle_is_not_lost_in_the_rounding_of_its_place() {
        let width = 1.0 / (1u64 << 30) as f64;
        let world =
            [World::new(-128.0, -width, 0.0), World::new(-128.0, width, 0.0), World::new(128.0, 0.0, 0.0)];
        let plan = [Plan::new(0.0, 0.0), Plan::new(64.0, 0.0), Plan::new(0.0, 64.0)];
        let triangle = SurfaceTriangle { world, drape: TriangleDrape::Affine { plan, up: DVec3::Z } };
        // A ray through a quarter of the first corner, a quarter of the second, half of the third.
        let away = DVec3::new(3.3, 7.7, 100.1);
        let ray = Ray { from: World::from(away), through: World::from(-away) };
        let view =
            Viewpoint { eye: ray.from, target: ray.through, up: DVec3::Y, near: 0.1, far: f64::INFINITY };
        let frame = ViewFrame::perspective(&view, 40.0, (8, 8)).unwrap();
        let hit = hit(&frame, &ray, &triangle);
        assert!((hit.plan - Plan::new(16.0, 32.0)).length() < 1e-12, "{hit:?}");
    }
}
