//! How far a pixel reaches in the plan: the exact derivatives of the surface point on the plane of the triangle that is seen there.

use crate::space::{Lens, Screen, ViewFrame};
use crate::terrain::{PlanMap, SurfaceTriangle, TriangleDrape};
use glam::{DVec2, DVec3};

/// How the plan point that is seen moves as the screen point moves by a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PixelFootprint {
    /// By a pixel to the right, metres.
    pub dx: DVec2,
    /// By a pixel down, metres.
    pub dy: DVec2,
}

/// The plane of a triangle as pixels of one view reach over it.
#[derive(Debug, Clone, Copy)]
pub struct FootprintPlane<'a> {
    frame: &'a ViewFrame,
    normal: DVec3,
    /// What a ray starts with (parallel) or runs along (central) moves by in the plan as the screen point moves a pixel to the right,
    /// or down; and how far that takes it from the plane.
    steps: [(DVec2, f64); 2],
    /// How far the eye is from the plane, along the normal and times its length.
    distance: f64,
    /// `None`: straight down.
    map: Option<PlanMap>,
}

impl<'a> FootprintPlane<'a> {
    /// The plane of a triangle.
    pub fn new(frame: &'a ViewFrame, triangle: &SurfaceTriangle) -> Self {
        let [a, b, c] = triangle.world;
        let normal = (b - a).cross(c - a);
        let pixel = frame.lens().pixel();
        let map = match &triangle.drape {
            TriangleDrape::Vertical => None,
            TriangleDrape::Affine { plan, .. } => Some(PlanMap::new(&triangle.world, plan)),
        };
        let steps = [frame.right() * pixel, -frame.up() * pixel];
        let steps = steps.map(|step| (in_plan(map.as_ref(), step), normal.dot(step)));
        Self { frame, normal, steps, distance: normal.dot(a - frame.eye()), map }
    }

    /// The footprint of a screen point; `None` where the plane is seen edge-on.
    #[inline(always)]
    pub fn footprint(&self, at: Screen) -> Option<PixelFootprint> {
        let frame = self.frame;
        let (along, reach) = match frame.lens() {
            Lens::Parallel { .. } => (frame.forward(), 1.0),
            Lens::Central { pixel } => {
                let x = (at.x - 0.5 * frame.width() as f64) * pixel;
                let y = (0.5 * frame.height() as f64 - at.y) * pixel;
                let along = frame.forward() + frame.right() * x + frame.up() * y;
                (along, self.distance / self.normal.dot(along))
            }
        };
        // The point from + reach * along stays on the plane: what leaves it is taken back along the ray.
        let back = in_plan(self.map.as_ref(), along) / self.normal.dot(along);
        let [dx, dy] = self.steps.map(|(step, leaves)| (step - back * leaves) * reach);
        (dx.is_finite() && dy.is_finite()).then_some(PixelFootprint { dx, dy })
    }
}

/// A displacement in the plan, where its part out of the plane does not count.
#[inline(always)]
fn in_plan(map: Option<&PlanMap>, step: DVec3) -> DVec2 {
    map.map_or_else(|| step.truncate(), |map| map.along(step))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::{Plan, Viewpoint, World};
    use crate::visibility::hit;

    fn views() -> [ViewFrame; 2] {
        let view = Viewpoint {
            eye: World::new(10.0, -200.0, 90.0),
            target: World::new(0.0, 0.0, 5.0),
            up: DVec3::Z,
            near: 0.1,
            far: f64::INFINITY,
        };
        [
            ViewFrame::perspective(&view, 50.0, (640, 480)).unwrap(),
            ViewFrame::orthographic(&view, 300.0, (640, 480)).unwrap(),
        ]
    }

    #[test]
    fn a_footprint_is_the_difference_of_neighbouring_hits_in_the_limit() {
        let world = [
            World::new(-300.0, -150.0, -20.0),
            World::new(300.0, -160.0, 10.0),
            World::new(0.0, 400.0, 80.0),
        ];
        let plan = [Plan::new(7.0, -8.0), Plan::new(50.0, 30.0), Plan::new(-90.0, 60.0)];
        let drape = TriangleDrape::Affine { plan, up: DVec3::Z };
        let triangles = [SurfaceTriangle::vertical(world), SurfaceTriangle { world, drape }];
        for (frame, triangle) in views().into_iter().flat_map(|frame| triangles.map(|t| (frame, t))) {
            for at in [Screen::new(100.5, 300.25), Screen::new(320.0, 240.0), Screen::new(600.0, 470.0)] {
                let plan =
                    |x: f64, y: f64| hit(&frame, &frame.ray(Screen::new(at.x + x, at.y + y)), &triangle).plan;
                let footprint = FootprintPlane::new(&frame, &triangle).footprint(at).unwrap();
                let h = 1e-4;
                let dx = (plan(h, 0.0) - plan(-h, 0.0)) / (2.0 * h);
                let dy = (plan(0.0, h) - plan(0.0, -h)) / (2.0 * h);
                assert!((footprint.dx - dx).length() < 1e-6 * dx.length(), "{footprint:?} {dx}");
                assert!((footprint.dy - dy).length() < 1e-6 * dy.length(), "{footprint:?} {dy}");
            }
        }
    }

    #[test]
    fn a_plane_that_is_seen_edge_on_has_no_footprint() {
        let frame = views()[1];
        let eye = frame.eye();
        let triangle = [eye, eye + frame.forward() * 100.0, eye + (frame.forward() + frame.up()) * 100.0];
        let triangle = SurfaceTriangle::vertical(triangle);
        assert_eq!(FootprintPlane::new(&frame, &triangle).footprint(Screen::new(320.0, 240.0)), None);
    }
}
