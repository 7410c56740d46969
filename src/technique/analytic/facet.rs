//! A triangle as a picture has it: which pixels it may cover, how near it is, and the maps between the screen and the plan.
//!
//! Within a triangle everything follows from its corners' homogeneous coordinates (x, y, w): the weights that a point of the screen has of
//! them are linear in it, up to a factor (Olano & Greer 1997, "Triangle scan conversion using 2D homogeneous coordinates"). So a straight
//! line of the plan is one of the screen, and no corner needs to lie before the eye.

use super::convex::{Side, cut};
use crate::math;
use crate::space::{Lens, Plan, PlanBox, ViewFrame};
use crate::terrain::SurfaceTriangle;
use glam::{DVec2, DVec3};

/// A triangle seen from less than this from its edge covers nothing: the determinant's share of its terms.
const EDGE_ON: f64 = 1e-15;

/// Keys that differ by less than this share are equal.
const SAME_KEY: f64 = 1e-12;

/// Triangles that reach over no more pixels are bounded by their corners, not by what is seen of them.
const SMALL: f64 = 2.0;

/// A triangle of the terrain in screen coordinates that are counted from a tile's corner.
#[derive(Debug, Clone)]
pub(super) struct Facet {
    /// Its number.
    pub(super) id: u32,
    /// How near it is: the larger, the nearer. Of a central lens 1 / depth, of a parallel one -depth; linear in the screen.
    pub(super) key: Side,
    /// Weights of the corners from (x, y, 1), up to a factor.
    weights: [DVec3; 3],
    plan: [Plan; 3],
    is_central: bool,
    /// Whether it reaches over hardly more than a pixel.
    pub(super) is_small: bool,
}

/// Where a triangle lies on the screen.
#[derive(Debug, Clone)]
pub(super) struct Outline {
    /// Its sides, lines of the screen.
    sides: [Side; 3],
    /// What keeps it beyond the near plane and before the far one, where it reaches over them.
    planes: [Option<Side>; 2],
    /// The columns and rows that it may reach: x from, y from, x to, y to.
    pub(super) reach: [f64; 4],
}

impl Outline {
    /// The lines of the screen that bound it.
    pub(super) fn bounds(&self) -> impl Iterator<Item = &Side> + Clone {
        self.sides.iter().chain(self.planes.iter().flatten())
    }
}

/// Homogeneous screen coordinates from plan points of a triangle's plane.
#[derive(Debug, Clone)]
pub(super) struct FromPlan {
    corner: Plan,
    /// Those of the corner, and what they grow by along the plan's axes.
    rows: [DVec3; 3],
}

impl FromPlan {
    /// Of a triangle, with the screen counted from `origin`.
    pub(super) fn new(view: &ViewFrame, origin: DVec2, triangle: &SurfaceTriangle) -> Self {
        let ([a, b, c], plan) = (corners(view, origin, triangle), triangle.plan());
        let (along, other) = (plan[1] - plan[0], plan[2] - plan[0]);
        let area = along.perp_dot(other);
        let (u, v) = (b - a, c - a);
        let rows = [a, (u * other.y - v * along.y) / area, (v * along.x - u * other.x) / area];
        Self { corner: plan[0], rows }
    }

    /// The homogeneous coordinates of a plan point.
    #[inline]
    pub(super) fn at(&self, at: Plan) -> DVec3 {
        let from = at - self.corner;
        self.rows[0] + self.rows[1] * from.x + self.rows[2] * from.y
    }

    /// Whether what turns left in the plan turns the other way on the screen, y down.
    pub(super) fn is_mirrored(&self) -> bool {
        let [first, east, north] = self.rows;
        first.dot(east.cross(north)) < 0.0
    }
}

impl Facet {
    /// A triangle in a view, with the screen counted from `origin`, and where it lies; `None`: it is seen edge-on.
    pub(super) fn new(
        view: &ViewFrame,
        origin: DVec2,
        id: u32,
        triangle: &SurfaceTriangle,
    ) -> Option<(Self, Outline)> {
        let corners = corners(view, origin, triangle);
        let depths = triangle.world.map(|corner| view.depth(corner));
        let [a, b, c] = corners;
        let normals = [b.cross(c), c.cross(a), a.cross(b)];
        let det = a.dot(normals[0]);
        let size = a.length_squared() * b.length_squared() * c.length_squared();
        if det.is_nan() || det * det <= EDGE_ON * EDGE_ON * size {
            return None;
        }
        let weights = normals.map(|normal| normal / det);
        let is_central = matches!(view.lens(), Lens::Central { .. });
        let key = match is_central {
            true => weights[0] + weights[1] + weights[2],
            false => -(weights[0] * depths[0] + weights[1] * depths[1] + weights[2] * depths[2]),
        };
        let key = line(key);
        let outline = Outline {
            sides: weights.map(unit),
            planes: planes(view, key, &depths, is_central),
            reach: reach(view, &corners, &depths, is_central),
        };
        let [x0, y0, x1, y1] = outline.reach;
        let is_small = x1 - x0 <= SMALL && y1 - y0 <= SMALL;
        Some((Self { id, key, weights, plan: triangle.plan(), is_central, is_small }, outline))
    }

    /// The greatest key in a square of the screen around a point.
    #[inline]
    pub(super) fn nearest_in(&self, middle: DVec2, half: f64) -> f64 {
        self.key.at(middle) + half * self.key.normal.abs().element_sum()
    }

    /// The least key there.
    #[inline]
    pub(super) fn farthest_in(&self, middle: DVec2, half: f64) -> f64 {
        self.key.at(middle) - half * self.key.normal.abs().element_sum()
    }

    /// The plan point of a point of the screen.
    #[inline]
    pub(super) fn plan_at(&self, at: DVec2) -> Plan {
        let h = at.extend(1.0);
        let [of_a, of_b, of_c] = self.weights.map(|row| row.dot(h));
        let [a, b, c] = self.plan;
        let share = 1.0 / (of_a + of_b + of_c);
        a + ((b - a) * (of_b * share) + (c - a) * (of_c * share))
    }

    /// The box around it in the plan.
    pub(super) fn plan_box(&self) -> PlanBox {
        PlanBox::around(self.plan)
    }

    /// The smallest way in the plan of a pixel's way on the screen, metres, around a point.
    pub(super) fn finest_at(&self, middle: DVec2) -> f64 {
        const STEP: f64 = 0.25;
        let at = self.plan_at(middle);
        let [dx, dy] = [DVec2::X, DVec2::Y].map(|axis| (self.plan_at(middle + axis * STEP) - at) / STEP);
        // The smaller singular value of the map: its determinant over the larger one.
        let (sum, det) = (dx.length_squared() + dy.length_squared(), dx.perp_dot(dy).abs());
        let root = math::max(sum * sum - 4.0 * det * det, 0.0).sqrt();
        det / (0.5 * (sum + root)).sqrt()
    }

    /// How far east (axis 0) or north (axis 1) of a line of the plan a point (x, y, 1) of the screen lies, up to a positive factor.
    pub(super) fn beyond(&self, axis: usize, at: f64) -> DVec3 {
        let of = self.plan.map(|p| if axis == 0 { p.x - at } else { p.y - at });
        self.weights[0] * of[0] + self.weights[1] * of[1] + self.weights[2] * of[2]
    }

    /// Whether plan points have a place on its plane; they have none where the corners' lie on a line.
    pub(super) fn has_plan(&self) -> bool {
        let [a, b, c] = self.plan;
        (b - a).perp_dot(c - a) != 0.0
    }

    /// The least w that plan points at some points of the screen have.
    pub(super) fn least_w(&self, polygon: &[DVec2]) -> f64 {
        if !self.is_central {
            return 1.0;
        }
        let nearest = polygon.iter().map(|p| self.key.at(*p)).fold(0.0, |most, key| math::max(key, most));
        1.0 / nearest
    }
}

/// The homogeneous coordinates of a triangle's corners, counted from `origin`.
fn corners(view: &ViewFrame, origin: DVec2, triangle: &SurfaceTriangle) -> [DVec3; 3] {
    triangle.world.map(|corner| {
        let h = view.homogeneous(corner - view.eye()) + view.homogeneous_eye();
        DVec3::new(h.x - origin.x * h.z, h.y - origin.y * h.z, h.z)
    })
}

/// A row that is multiplied with (x, y, 1), as a line.
fn line(row: DVec3) -> Side {
    Side { normal: row.truncate(), offset: row.z }
}

/// The same in pixels, where it is a line that has pixels.
fn unit(row: DVec3) -> Side {
    let length = row.truncate().length();
    line(if length > 0.0 { row / length } else { row })
}

/// The columns and rows that a triangle may reach; all where it comes near the eye's plane.
fn reach(view: &ViewFrame, corners: &[DVec3; 3], depths: &[f64; 3], is_central: bool) -> [f64; 4] {
    if is_central && depths.iter().any(|depth| *depth < 0.5 * view.near()) {
        return [f64::NEG_INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::INFINITY];
    }
    let points = corners.map(|h| h.truncate() / h.z);
    let low = points[0].min(points[1]).min(points[2]);
    let high = points[0].max(points[1]).max(points[2]);
    [low.x, low.y, high.x, high.y]
}

/// What cuts a triangle at the near and the far plane.
fn planes(view: &ViewFrame, key: Side, depths: &[f64; 3], is_central: bool) -> [Option<Side>; 2] {
    let key_of = |depth: f64| if is_central { 1.0 / depth } else { -depth };
    let nearer = depths.iter().any(|depth| *depth < view.near());
    let farther = depths.iter().any(|depth| *depth >= view.far());
    let beyond_near = Side { normal: -key.normal, offset: key_of(view.near()) - key.offset };
    let before_far = Side { normal: key.normal, offset: key.offset - key_of(view.far()) };
    [nearer.then_some(beyond_near), farther.then_some(before_far)]
}

/// What of a polygon that two triangles cover the first is nearer in, and what of it the second.
pub(super) fn split_by_key(new: &Facet, old: &Facet, polygon: &[DVec2]) -> [Vec<DVec2>; 2] {
    let (mut most, mut least) = (f64::NEG_INFINITY, f64::INFINITY);
    let mut size = 0.0;
    for p in polygon {
        let (of_new, of_old) = (new.key.at(*p), old.key.at(*p));
        let difference = of_new - of_old;
        (most, least) = (math::max(difference, most), math::min(difference, least));
        size = math::max(of_new.abs() + of_old.abs(), size);
    }
    let same = SAME_KEY * size;
    let new_wins_ties = new.id < old.id;
    if least >= -same && (most > same || new_wins_ties) {
        return [polygon.to_vec(), Vec::new()];
    }
    if most <= same {
        return [Vec::new(), polygon.to_vec()];
    }
    // They pass through one another.
    let difference =
        Side { normal: new.key.normal - old.key.normal, offset: new.key.offset - old.key.offset };
    let (mut nearer, mut farther) = (Vec::new(), Vec::new());
    cut(polygon, &difference, &mut nearer);
    cut(polygon, &difference.turned(), &mut farther);
    [nearer, farther]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::{Screen, Viewpoint, World};
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
    fn a_point_of_the_screen_has_the_plan_point_and_the_depth_of_its_ray() {
        let triangle = SurfaceTriangle::vertical([
            World::new(-300.0, -350.0, -20.0),
            World::new(300.0, -160.0, 10.0),
            World::new(0.0, 400.0, 80.0),
        ]);
        let origin = DVec2::new(64.0, 128.0);
        for view in views() {
            let (facet, _) = Facet::new(&view, origin, 7, &triangle).unwrap();
            let from_plan = FromPlan::new(&view, origin, &triangle);
            for at in [DVec2::new(100.5, 200.25), DVec2::new(256.0, 112.0)] {
                let screen = Screen::new(at.x + origin.x, at.y + origin.y);
                let seen = hit(&view, &view.ray(screen), &triangle);
                assert!((facet.plan_at(at) - seen.plan).length() < 1e-9);
                let key = if facet.is_central { 1.0 / seen.depth } else { -seen.depth };
                assert!((facet.key.at(at) - key).abs() < 1e-12 * (1.0 + key.abs()));
                let back = from_plan.at(seen.plan);
                assert!((back.truncate() / back.z - at).length() < 1e-9);
            }
            assert!(from_plan.is_mirrored(), "north is up, y is down");
        }
    }

    #[test]
    fn a_triangle_that_is_seen_edge_on_is_none() {
        let view = views()[1];
        let eye = view.eye();
        let corners = [eye, eye + view.forward() * 100.0, eye + (view.forward() + view.up()) * 100.0];
        assert!(Facet::new(&view, DVec2::ZERO, 0, &SurfaceTriangle::vertical(corners)).is_none());
    }
}
