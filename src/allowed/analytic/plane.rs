//! A triangle's plane, from the plan to the screen: what is straight in the plan is straight on the screen.

use crate::allowed::polygon::{cut, diameter};
use crate::footprint::HalfPlane;
use crate::space::{Lens, Plan, ViewFrame, World};
use crate::terrain::SurfaceTriangle;
use glam::DVec2;

/// A triangle before the eye.
#[derive(Debug, Clone)]
pub(super) struct Plane {
    /// Its corners on the screen.
    pub(super) screen: [DVec2; 3],
    plan: [Plan; 3],
    world: [World; 3],
    /// What a function that is linear in the plan is divided by at each corner to be linear on the screen.
    weights: [f64; 3],
}

/// Where something is 0 on the screen, and on which side of that it is more.
#[derive(Debug, Clone, Copy)]
struct Linear {
    slope: DVec2,
    at_zero: f64,
}

impl Linear {
    fn at(&self, p: DVec2) -> f64 {
        self.slope.dot(p) + self.at_zero
    }
}

impl Plane {
    /// Of a triangle in a view; `None`: a corner is behind the eye.
    pub(super) fn of(frame: &ViewFrame, triangle: &SurfaceTriangle) -> Option<Self> {
        let [a, b, c] = triangle.world.map(|p| frame.screen_from_world(p).map(|at| at.to_vec()));
        let weights = triangle.world.map(|p| match frame.lens() {
            Lens::Central { .. } => frame.depth(p),
            Lens::Parallel { .. } => 1.0,
        });
        Some(Self { screen: [a?, b?, c?], plan: triangle.plan(), world: triangle.world, weights })
    }

    /// Values of the plan that are linear there, up to a positive factor; `None`: the triangle is seen edge-on.
    fn linear(&self, value: impl Fn(Plan) -> f64) -> Option<Linear> {
        let [p, q, r]: [f64; 3] = std::array::from_fn(|k| value(self.plan[k]) / self.weights[k]);
        let [a, b, c] = self.screen;
        let (u, v) = (b - a, c - a);
        let slope = DVec2::new((q - p) * v.y - (r - p) * u.y, (r - p) * u.x - (q - p) * v.x) / u.perp_dot(v);
        let at_zero = p - slope.dot(a);
        (slope.is_finite() && at_zero.is_finite()).then_some(Linear { slope, at_zero })
    }

    fn side(&self, of: &HalfPlane) -> Option<Linear> {
        let [x, y] = of.normal;
        self.linear(|p| x.mid * (p.x - of.at.x) + y.mid * (p.y - of.at.y) + of.offset.mid)
    }

    /// How long the border of a half plane is within others in a convex part of the screen.
    pub(super) fn length_of(&self, border: &HalfPlane, others: &[&HalfPlane], shape: &[DVec2]) -> f64 {
        let Some(line) = self.side(border) else { return diameter(shape) };
        let mut shape = shape.to_vec();
        for other in others.iter().filter_map(|other| self.side(other)) {
            shape = cut(&shape, |p| other.at(p));
        }
        let mut ends = Vec::with_capacity(2);
        for (k, p) in shape.iter().enumerate() {
            let q = shape[(k + 1) % shape.len()];
            let (at_p, at_q) = (line.at(*p), line.at(q));
            if (at_p >= 0.0) != (at_q >= 0.0) {
                ends.push(*p + (q - *p) * (at_p / (at_p - at_q)));
            }
        }
        diameter(&ends)
    }

    /// The point of the surface over a point of the plan.
    pub(super) fn see(&self, at: Plan) -> World {
        let [a, b, c] = self.plan;
        let (u, v, to) = (b - a, c - a, at - a);
        let double = u.perp_dot(v);
        let (along_u, along_v) = (to.perp_dot(v) / double, u.perp_dot(to) / double);
        let [p, q, r] = self.world;
        p + ((q - p) * along_u + (r - p) * along_v)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interval::Ball;
    use crate::space::Viewpoint;
    use glam::DVec3;

    #[test]
    fn a_line_of_the_plan_is_as_long_in_a_square_as_its_ends_on_the_screen_are_apart() {
        let eye = World::new(3.0, -40.0, 25.0);
        let target = World::new(0.0, 0.0, 0.0);
        let view = Viewpoint { eye, target, up: DVec3::Z, near: 1.0, far: f64::INFINITY };
        let frame = ViewFrame::perspective(&view, 50.0, (64, 48)).unwrap();
        let corners =
            [World::new(-20.0, -10.0, 1.0), World::new(25.0, -12.0, 3.0), World::new(0.0, 30.0, 8.0)];
        let plane = Plane::of(&frame, &SurfaceTriangle::vertical(corners)).unwrap();
        // From x = -2 to x = 5 along y = -4.
        let side = |x: f64, y: f64, offset: f64| HalfPlane {
            at: Plan::new(0.0, 0.0),
            normal: [Ball::exact(x), Ball::exact(y)],
            offset: Ball::exact(offset),
        };
        let (border, others) = (side(0.0, 1.0, 4.0), [side(1.0, 0.0, 2.0), side(-1.0, 0.0, 5.0)]);
        let others: Vec<&HalfPlane> = others.iter().collect();
        let at = |x: f64| frame.screen_from_world(plane.see(Plan::new(x, -4.0))).unwrap().to_vec();
        let found = plane.length_of(&border, &others, &plane.screen);
        assert!((found - (at(5.0) - at(-2.0)).length()).abs() < 1e-9, "{found}");
    }
}
