//! Triangles as they lie on a tile.

use super::draped::Draped;
use super::form::{BallForm, Form};
use super::tile_rays::TileRays;
use crate::footprint::HalfPlane;
use crate::interval::{Ball, BallVec};
use crate::math;
use crate::predicate;
use crate::space::{Plan, PlanBox, World};
use crate::terrain::{SurfaceTriangle, TriangleDrape, upward_normal};
use glam::{DVec2, DVec3};

/// Sides of a facet: three edges, the near and the far plane.
pub(super) const MOST_BOUNDS: usize = 5;

/// What vertex depths are trusted to, as a share.
const DEPTH_SHARE: f64 = 1e-9;

/// A triangle as it lies on a tile. A ray meets its plane at parameter (view depth) `depth / facing`.
#[derive(Debug)]
pub(super) struct Facet {
    /// The triangle's number.
    pub(super) id: u32,
    /// Its corners.
    pub(super) corners: [World; 3],
    bounds: [Form; MOST_BOUNDS],
    count: usize,
    /// Larger is nearer: 1 / view depth (perspective) or minus the view depth (orthographic).
    pub(super) nearness: Form,
    /// No point of the triangle is nearer.
    pub(super) nearest: f64,
    /// The numerator of the parameter.
    pub(super) depth: BallForm,
    /// Its denominator.
    pub(super) facing: BallForm,
    depth_plain: Form,
    facing_plain: Form,
    /// The sign of the denominator where the triangle is seen.
    sign: f64,
    /// The map to the plan; `None`: straight down.
    draped: Option<Box<Draped>>,
}

/// A visible point, with a bound of each coordinate's error in metres.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hit {
    pub(super) plan: Plan,
    pub(super) world: World,
    pub(super) error: f64,
}

/// Which side of a triangle is seen, told by the bounds where they do: 1, -1, or 0 where it is seen edge-on.
fn side_seen(rays: &TileRays, (depth, facing): (&BallForm, &BallForm), corners: &[World; 3]) -> f64 {
    let decisive = if rays.is_central { depth.c } else { facing.c };
    match (decisive.is_positive(), decisive.is_negative()) {
        (true, _) => 1.0,
        (_, true) => -1.0,
        _ => predicate::facing(&rays.frame, corners),
    }
}

impl Facet {
    /// `None`: it is seen edge-on, or lies beyond the planes of near and far.
    pub(super) fn new(rays: &TileRays, id: u32, triangle: &SurfaceTriangle) -> Option<Self> {
        let corners = triangle.world;
        let [a, b, c] = corners;
        let depths = corners.map(|p| rays.frame.depth(p));
        let (low, high) = (math::min(depths[0], math::min(depths[1], depths[2])), {
            math::max(depths[0], math::max(depths[1], depths[2]))
        });
        let margin = DEPTH_SHARE * (low.abs() + high.abs());
        if high + margin < rays.near || low - margin > rays.far {
            return None;
        }
        let normal =
            BallVec::difference(b.to_vec(), a.to_vec()).cross(BallVec::difference(c.to_vec(), a.to_vec()));
        let facing = rays.dot_along(normal);
        let depth = rays.dot_from(normal, BallVec::exact(a.to_vec())).signed(-1.0);
        let sign = side_seen(rays, (&depth, &facing), &corners);
        if sign == 0.0 {
            return None;
        }
        let side = |a, b| rays.edge(a, b).signed(sign).plain(rays.span);
        let mut bounds = [side(a, b); MOST_BOUNDS];
        (bounds[1], bounds[2]) = (side(b, c), side(c, a));
        let mut count = 3;
        // depth / facing >= near, < far, the denominator's sign known.
        let plane = |limit: f64, way: f64| {
            depth.plus(&facing.times(Ball::exact(-limit))).signed(sign * way).plain(rays.span)
        };
        if low - margin < rays.near {
            bounds[count] = plane(rays.near, 1.0);
            count += 1;
        }
        if high + margin > rays.far {
            bounds[count] = plane(rays.far, -1.0);
            count += 1;
        }
        let nearness = match rays.is_central {
            true => facing.times(depth.c.recip()),
            false => depth.times(-facing.c.recip()),
        };
        let first = if low - margin > rays.near { low - margin } else { rays.near };
        let nearest = if rays.is_central { (1.0 / first) * (1.0 + DEPTH_SHARE) } else { -first };
        let is_vertical = triangle.drape == TriangleDrape::Vertical;
        let draped = (!is_vertical).then(|| Box::new(Draped::new(rays, triangle)));
        Some(Self {
            id,
            corners,
            bounds,
            count,
            nearness: nearness.plain(rays.span),
            nearest,
            depth,
            facing,
            depth_plain: depth.plain(rays.span),
            facing_plain: facing.plain(rays.span),
            sign,
            draped,
        })
    }

    /// The sides: what is seen of it lies where all are at least 0.
    #[inline(always)]
    pub(super) fn bounds(&self) -> &[Form] {
        &self.bounds[..self.count]
    }

    /// How near its plane comes over a square, at most and at least.
    #[inline(always)]
    pub(super) fn nearness_range(&self, corner: [f64; 2], side: f64) -> (f64, f64) {
        let (low, high) = self.nearness.range(corner, side);
        let (low, high) = (low - self.nearness.error, high + self.nearness.error);
        (low, if high < self.nearest { high } else { self.nearest })
    }

    /// The function whose sign on the tile says on which side of a plan line the visible point lies.
    pub(super) fn half_plane(&self, rays: &TileRays, of: &HalfPlane) -> BallForm {
        if let Some(draped) = &self.draped {
            return draped.half_plane(&self.facing, of).signed(self.sign);
        }
        let normal = BallVec { x: of.normal[0], y: of.normal[1], z: Ball::ZERO };
        let at = BallVec { x: Ball::exact(of.at.x), y: Ball::exact(of.at.y), z: Ball::ZERO };
        let mut start = rays.dot_from(normal, at);
        start.c = start.c + of.offset;
        let along = rays.dot_along(normal);
        // n . (from + t along - at) + offset, times the denominator of t.
        let product = match rays.is_central {
            true => self.facing.times(start.c).plus(&along.times(self.depth.c)),
            false => start.times(self.facing.c).plus(&self.depth.times(along.c)),
        };
        product.signed(self.sign)
    }

    /// Where the ray of a tile's point meets its plane.
    #[inline]
    pub(super) fn hit(&self, rays: &TileRays, at: [f64; 2]) -> Hit {
        let (depth, facing) = (self.depth_plain.at(at), self.facing_plain.at(at));
        let parameter = depth / facing;
        let sure = facing.abs() - self.facing_plain.error;
        // Exact: (depth +- e) / (facing +- f).
        let doubt = (self.depth_plain.error + parameter.abs() * self.facing_plain.error) / sure;
        let offset = rays.plain.steps[0] * at[0] + rays.plain.steps[1] * at[1];
        let (from, along) = match rays.is_central {
            true => (rays.plain.from, rays.plain.along + offset),
            false => (rays.plain.from + offset, rays.plain.along),
        };
        // A unit direction (or little longer), coordinates of this size, a dozen roundings.
        let size = rays.plain.size + parameter.abs() * rays.plain.reach;
        let error = doubt * rays.plain.reach + 32.0 * f64::EPSILON * size;
        let error = if sure > 0.0 && error.is_finite() { error } else { f64::INFINITY };
        let world = World::from(from + along * parameter);
        match &self.draped {
            None => Hit { plan: world.plan(), world, error },
            Some(draped) => {
                let (plan, of_plan) = draped.plan_at(at, (facing, self.facing_plain.error));
                Hit { plan, world, error: math::max(error, of_plan) }
            }
        }
    }

    /// What a function of the surface point gains a metre east and north in the plan, of which this is the gradient in the world.
    pub(super) fn slope(&self, gradient: DVec3) -> DVec2 {
        if let Some(draped) = &self.draped {
            return draped.slope(gradient);
        }
        // The surface climbs by -n.xy / n.z a metre.
        let normal = upward_normal(&self.corners);
        let climb = gradient.z / math::max(normal.z, 1e-9);
        gradient.truncate() - normal.truncate() * climb
    }

    /// The box of the plan around the triangle.
    pub(super) fn plan(&self) -> PlanBox {
        match &self.draped {
            None => PlanBox::around(self.corners.map(World::plan)),
            Some(draped) => PlanBox::around(draped.corners()),
        }
    }
}
