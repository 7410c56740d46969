//! A triangle whose corners have plan points of their own, as it lies on a tile: its map from the screen to the plan.
//!
//! A ray meets the triangle's plane in the point whose weights of the corners are `side / facing`, where `side` is the function of the ray
//! that tells on which side of the opposite edge it passes, and `facing` the sum of the three. Its plan point is the corners' plan points
//! by these weights, so that a function that is affine in the plan becomes one that is linear on the screen, over `facing`.

use super::form::{BallForm, Form};
use super::tile_rays::TileRays;
use crate::footprint::HalfPlane;
use crate::interval::Ball;
use crate::space::Plan;
use crate::terrain::SurfaceTriangle;
use glam::{DVec2, DVec3};

#[derive(Debug)]
pub(super) struct Draped {
    plan: [Plan; 3],
    /// Numerators of the weights of the second and the third corner.
    weights: [BallForm; 2],
    plain: [Form; 2],
    /// How far the surface point moves as the plan point moves a metre east, or north; `None`: the corners' plan points lie on a line.
    steps: Option<[DVec3; 2]>,
}

impl Draped {
    /// The map of a triangle.
    pub(super) fn new(rays: &TileRays, triangle: &SurfaceTriangle) -> Self {
        let [a, b, c] = triangle.world;
        let weights = [rays.edge(c, a), rays.edge(a, b)];
        let plain = weights.map(|weight| weight.plain(rays.span));
        Self { plan: triangle.plan(), weights, plain, steps: triangle.world_from_plan() }
    }

    /// The corners' plan points.
    pub(super) fn corners(&self) -> [Plan; 3] {
        self.plan
    }

    /// How far inside a half plane the visible point's plan point lies, times `facing`.
    pub(super) fn half_plane(&self, facing: &BallForm, of: &HalfPlane) -> BallForm {
        let [a, b, c] = self.plan;
        let along = |to: Plan, from: Plan| {
            of.normal[0] * (Ball::exact(to.x) - Ball::exact(from.x))
                + of.normal[1] * (Ball::exact(to.y) - Ball::exact(from.y))
        };
        let [of_b, of_c] = &self.weights;
        let first = facing.times(along(a, of.at) + of.offset);
        first.plus(&of_b.times(along(b, a))).plus(&of_c.times(along(c, a)))
    }

    /// The plan point seen at a point of the tile, and a bound of each coordinate's error, metres; `facing` with its own error.
    pub(super) fn plan_at(&self, at: [f64; 2], (facing, doubt): (f64, f64)) -> (Plan, f64) {
        let sure = facing.abs() - doubt;
        let [p, q] = [&self.plain[0], &self.plain[1]].map(|numerator| {
            let weight = numerator.at(at) / facing;
            // Exact: (numerator +- e) / (facing +- f).
            (weight, (numerator.error + weight.abs() * doubt) / sure)
        });
        let [a, b, c] = self.plan;
        let (along, other) = (b - a, c - a);
        let size = |v: DVec2| v.abs().max_element();
        let reach = size(along) * p.0.abs() + size(other) * q.0.abs();
        // A dozen roundings of coordinates of this size.
        let rounding = 32.0 * f64::EPSILON * (size(a.to_vec()) + reach);
        let error = size(along) * p.1 + size(other) * q.1 + rounding;
        let error = if sure > 0.0 && error.is_finite() { error } else { f64::INFINITY };
        (a + (along * p.0 + other * q.0), error)
    }

    /// What a function of the surface point gains a metre east and north in the plan, of which this is the gradient in the world.
    pub(super) fn slope(&self, gradient: DVec3) -> DVec2 {
        self.steps.map_or(DVec2::ZERO, |[east, north]| DVec2::new(gradient.dot(east), gradient.dot(north)))
    }
}
