//! How a point of the surface gets to the plan.
//!
//! Input: a triangle's corners, each a point of the world, a point of the plan and what is up there. Output: the plan point of each point of
//! the triangle: of the corners' plan points the combination that the point is of the corners (what a graphics processor
//! interpolates). Refuses: nothing; corners on a line have no such map, and no ray sees them.
//!
//! Where the corners lie straight over their plan points (a grid, a TIN over the plan), that is the vertical projection, exactly: a point's
//! plan coordinates are its first two, and nothing is computed ([`Drape::Vertical`]).

use crate::space::{Plan, World};
use glam::{DVec2, DVec3};

/// How a mesh is draped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Drape {
    /// Every vertex lies straight over its plan point, up is z.
    Vertical,
    /// Every vertex has a plan point and an up of its own.
    Affine,
}

/// A vertex of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceVertex {
    /// Where it is, scene-local metres.
    pub world: World,
    /// Its place in the plan.
    pub plan: Plan,
    /// What is up there: a unit vector.
    pub up: DVec3,
}

impl SurfaceVertex {
    /// A vertex straight over its plan point.
    #[inline]
    pub const fn vertical(world: World) -> Self {
        Self { world, plan: world.plan(), up: DVec3::Z }
    }
}

/// A triangle of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceTriangle {
    /// Its corners, scene-local metres.
    pub world: [World; 3],
    /// How its points get to the plan.
    pub drape: TriangleDrape,
}

/// How a triangle's points get to the plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TriangleDrape {
    /// Straight down.
    Vertical,
    /// As combinations of the corners' plan points.
    Affine {
        /// The corners' plan points.
        plan: [Plan; 3],
        /// What is up on it, of any length: the sum of its corners' up.
        up: DVec3,
    },
}

impl SurfaceTriangle {
    /// A triangle straight over the plan.
    #[inline]
    pub const fn vertical(world: [World; 3]) -> Self {
        Self { world, drape: TriangleDrape::Vertical }
    }

    /// The triangle between three vertices, whatever they are.
    #[inline]
    pub fn between(corners: [SurfaceVertex; 3]) -> Self {
        let [a, b, c] = corners.map(|corner| corner.up);
        let plan = corners.map(|corner| corner.plan);
        let drape = TriangleDrape::Affine { plan, up: a + b + c };
        Self { world: corners.map(|corner| corner.world), drape }
    }

    /// The corners' plan points.
    #[inline]
    pub fn plan(&self) -> [Plan; 3] {
        match self.drape {
            TriangleDrape::Vertical => self.world.map(World::plan),
            TriangleDrape::Affine { plan, .. } => plan,
        }
    }

    /// The unit normal on the upper side as its components east, north and up, east being the level direction in which plan x grows
    /// and plan y does not; straight up for a triangle without area.
    pub fn normal(&self) -> DVec3 {
        let TriangleDrape::Affine { up, .. } = self.drape else { return upward_normal(&self.world) };
        let [a, b, c] = self.world;
        let up = up.try_normalize().unwrap_or(DVec3::Z);
        let normal = (b - a).cross(c - a).try_normalize().unwrap_or(up);
        let normal = if normal.dot(up) < 0.0 { -normal } else { normal };
        let level = |along: DVec3| (along - up * up.dot(along)).try_normalize();
        let east = self.world_from_plan().and_then(|[east, _]| level(east));
        let east = east.unwrap_or_else(|| up.any_orthonormal_vector());
        DVec3::new(normal.dot(east), normal.dot(up.cross(east)), normal.dot(up))
    }

    /// How far a point of the triangle's plane moves as its plan point moves by one metre east, or north; `None` where the corners'
    /// plan points lie on a line.
    pub fn world_from_plan(&self) -> Option<[DVec3; 2]> {
        let ([a, b, c], [p, q, r]) = (self.world, self.plan());
        let (u, v, along, other) = (b - a, c - a, q - p, r - p);
        let area = along.perp_dot(other);
        let [east, north] = [(u * other.y - v * along.y) / area, (v * along.x - u * other.x) / area];
        (east.is_finite() && north.is_finite()).then_some([east, north])
    }
}

/// The unit normal of a triangle that is draped vertically, pointing up; straight up for a degenerate one.
pub fn upward_normal([a, b, c]: &[World; 3]) -> DVec3 {
    let normal = (*b - *a).cross(*c - *a).try_normalize().unwrap_or(DVec3::Z);
    if normal.z < 0.0 { -normal } else { normal }
}

/// The map from the points of a triangle's plane to the plan, in plain doubles.
#[derive(Debug, Clone, Copy)]
pub struct PlanMap {
    corner: World,
    plan: Plan,
    /// What plan x and plan y grow by along a displacement in the plane.
    rows: [DVec3; 2],
    is_sure: bool,
}

/// A triangle whose sides enclose an angle with a sine below 2^-10 maps by its corners' weights only.
const SLIVER: f64 = 1.0 / (1u64 << 20) as f64;

impl PlanMap {
    /// The map of a triangle with these corners and their plan points.
    pub fn new([a, b, c]: &[World; 3], [p, q, r]: &[Plan; 3]) -> Self {
        let (u, v) = (*b - *a, *c - *a);
        let normal = u.cross(v);
        let area = normal.length_squared();
        // The weights of b and c in a point of the plane: products with its displacement from a.
        let (of_b, of_c) = (v.cross(normal) / area, normal.cross(u) / area);
        let (along, other) = (*q - *p, *r - *p);
        let rows = [of_b * along.x + of_c * other.x, of_b * along.y + of_c * other.y];
        Self { corner: *a, plan: *p, rows, is_sure: area > SLIVER * u.length_squared() * v.length_squared() }
    }

    /// Whether the map is precise: off by 2^-30 of the triangle's size in the plan at most, besides what its point is off. The map of a
    /// sliver is not.
    pub fn is_sure(&self) -> bool {
        self.is_sure
    }

    /// The plan point of a point of the plane.
    #[inline(always)]
    pub fn at(&self, point: World) -> Plan {
        self.plan + self.along(point - self.corner)
    }

    /// How far the plan point moves as the point moves along the plane.
    #[inline(always)]
    pub fn along(&self, step: DVec3) -> DVec2 {
        DVec2::new(self.rows[0].dot(step), self.rows[1].dot(step))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corners() -> ([World; 3], [Plan; 3]) {
        let world = [World::new(3.0, -1.0, 7.0), World::new(9.0, 2.0, 5.0), World::new(4.0, 6.0, -2.0)];
        (world, [Plan::new(100.0, 20.0), Plan::new(130.0, 25.0), Plan::new(96.0, 70.0)])
    }

    #[test]
    fn a_combination_of_corners_has_that_combination_of_their_plan_points() {
        let (world, plan) = corners();
        let map = PlanMap::new(&world, &plan);
        for (s, t) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.25, 0.5), (-2.0, 3.0)] {
            let at = world[0] + (world[1] - world[0]) * s + (world[2] - world[0]) * t;
            let expected = plan[0] + (plan[1] - plan[0]) * s + (plan[2] - plan[0]) * t;
            assert!((map.at(at) - expected).length() < 1e-12, "{s} {t}");
        }
        // What lies beside the plane is taken to the point below it.
        let off = (world[1] - world[0]).cross(world[2] - world[0]);
        assert!((map.at(world[1] + off) - plan[1]).length() < 1e-12);
    }

    #[test]
    fn a_step_in_the_plan_and_the_way_it_takes_on_the_plane_are_inverse() {
        let (world, plan) = corners();
        let triangle = SurfaceTriangle { world, drape: TriangleDrape::Affine { plan, up: DVec3::Z } };
        let [east, north] = triangle.world_from_plan().unwrap();
        let map = PlanMap::new(&world, &plan);
        assert!((map.along(east) - DVec2::X).length() < 1e-12);
        assert!((map.along(north) - DVec2::Y).length() < 1e-12);
        let line =
            SurfaceTriangle { drape: TriangleDrape::Affine { plan: [plan[0]; 3], up: DVec3::Z }, ..triangle };
        assert_eq!(line.world_from_plan(), None);
    }

    #[test]
    fn a_normal_does_not_depend_on_how_the_world_is_turned() {
        let (world, _) = corners();
        let turn = glam::DQuat::from_xyzw(0.1, -0.5, 0.3, 0.4).normalize();
        let turned = world.map(|p| SurfaceVertex {
            world: World::from(turn * p.to_vec()),
            plan: p.plan(),
            up: turn * DVec3::Z,
        });
        let (own, other) =
            (SurfaceTriangle::vertical(world).normal(), SurfaceTriangle::between(turned).normal());
        assert!((own - other).length() < 1e-14, "{own} {other}");
    }
}
