//! A triangle as a picture has it: which pixels it may cover, how near it is, and the maps between the screen and the plan.
//!
//! Within a triangle everything follows from its corners' homogeneous coordinates (x, y, w): the weights that a point of the screen has of
//! them are linear in it, up to a factor (Olano & Greer 1997, "Triangle scan conversion using 2D homogeneous coordinates"). So a straight
//! line of the plan is one of the screen, and no corner needs to lie before the eye.

use super::convex::{Side, cut};
use crate::math;
use crate::resolve::Paint;
use crate::space::{Lens, Plan, PlanBox, ViewFrame, World};
use glam::{DVec2, DVec3};

/// A triangle seen from less than this from its edge covers nothing: the determinant's share of its terms.
const EDGE_ON: f64 = 1e-15;

/// Keys that differ by less than this share are equal.
const SAME_KEY: f64 = 1e-12;

/// Triangles that reach over no more pixels are bounded by their corners, not by what is seen of them.
const SMALL: f64 = 2.0;

/// Triangles that reach farther, pixels from a tile's corner, are cut by their sides' lines: their corners' places have too few bits.
const FAR: f64 = 4096.0;

/// A corner of a triangle of the terrain, in screen coordinates that are counted from a tile's corner.
#[derive(Debug, Clone, Copy)]
pub(super) struct Corner {
    /// Homogeneous.
    homogeneous: DVec3,
    depth: f64,
    /// How near it is: the larger, the nearer. Of a central lens 1 / depth, of a parallel one -depth; linear in the screen.
    pub(super) key: f64,
    /// On the screen, if it lies before the eye.
    pub(super) screen: DVec2,
}

impl Corner {
    pub(super) fn new(view: &ViewFrame, origin: DVec2, world: World) -> Self {
        let h = view.homogeneous(world - view.eye()) + view.homogeneous_eye();
        let homogeneous = DVec3::new(h.x - origin.x * h.z, h.y - origin.y * h.z, h.z);
        let depth = view.depth(world);
        let screen = homogeneous.truncate() / homogeneous.z;
        let key = if matches!(view.lens(), Lens::Central { .. }) { 1.0 / depth } else { -depth };
        Self { homogeneous, depth, key, screen }
    }

    /// Whether no plane cuts off anything near it.
    pub(super) fn is_between_planes(&self, view: &ViewFrame) -> bool {
        self.depth >= view.near() && self.depth < view.far()
    }

    /// Whether it lies clearly before the eye, so that its place on the screen and its key count.
    pub(super) fn is_before(&self, view: &ViewFrame) -> bool {
        self.depth >= 0.5 * view.near() || matches!(view.lens(), Lens::Parallel { .. })
    }
}

/// A triangle of the terrain in screen coordinates that are counted from a tile's corner.
#[derive(Debug, Clone)]
pub(super) struct Facet {
    /// Its number.
    pub(super) id: u32,
    /// How near it is, as corners have it.
    pub(super) key: Side,
    /// The least and the most key of its corners; no bounds where one of them is not before the eye.
    pub(super) keys: [f64; 2],
    /// Weights of the corners from (x, y, 1), up to a factor: its sides as lines of the screen.
    weights: [DVec3; 3],
    /// What keeps it beyond the near plane and before the far one, where it reaches over them.
    planes: [Option<Side>; 2],
    corners: [DVec3; 3],
    plan: [Plan; 3],
    /// The box around it in the plan.
    bounds: PlanBox,
    is_central: bool,
    /// Whether it reaches over hardly more than a pixel.
    pub(super) is_small: bool,
    /// The terrain's paint on it, where that is the same everywhere on it.
    pub(super) ground: Paint,
}

/// Where a triangle lies on the screen.
#[derive(Debug, Clone)]
pub(super) struct Outline {
    /// Its corners, where they have places that can be trusted and no plane cuts it.
    pub(super) corners: Option<[DVec2; 3]>,
    /// The columns and rows that it may reach: x from, y from, x to, y to.
    pub(super) reach: [f64; 4],
}

/// Homogeneous screen coordinates from plan points of a triangle's plane.
#[derive(Debug, Clone)]
pub(super) struct FromPlan {
    corner: Plan,
    /// Those of the corner, and what they grow by along the plan's axes.
    rows: [DVec3; 3],
}

impl FromPlan {
    /// Of a triangle.
    pub(super) fn new(facet: &Facet) -> Self {
        let ([a, b, c], plan) = (facet.corners, facet.plan);
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
    /// The triangle between three corners with their plan points; `None`: it is seen edge-on. Its ground is clear so far.
    pub(super) fn new(view: &ViewFrame, id: u32, of: &[Corner; 3], plan: [Plan; 3]) -> Option<Self> {
        let corners = of.map(|corner| corner.homogeneous);
        let depths = of.map(|corner| corner.depth);
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
        let keys = match of.iter().all(|corner| corner.is_before(view)) {
            true => [
                math::min(math::min(of[0].key, of[1].key), of[2].key),
                math::max(math::max(of[0].key, of[1].key), of[2].key),
            ],
            false => [f64::NEG_INFINITY, f64::INFINITY],
        };
        let [x0, y0, x1, y1] = reach(view, of);
        Some(Self {
            id,
            key,
            keys,
            weights,
            planes: planes(view, key, &depths, is_central),
            corners,
            plan,
            bounds: PlanBox::around(plan),
            is_central,
            is_small: x1 - x0 <= SMALL && y1 - y0 <= SMALL,
            ground: Paint::CLEAR,
        })
    }

    /// Where it lies on the screen, of the same corners.
    pub(super) fn outline(&self, view: &ViewFrame, of: &[Corner; 3]) -> Outline {
        let reach = reach(view, of);
        let is_exact = self.planes == [None; 2] && reach.iter().all(|v| v.abs() <= FAR);
        Outline { corners: is_exact.then(|| of.map(|corner| corner.screen)), reach }
    }

    /// The lines of the screen that bound it.
    pub(super) fn sides(&self) -> impl Iterator<Item = Side> + Clone + '_ {
        self.weights.iter().map(|row| line(*row)).chain(self.planes.iter().flatten().copied())
    }

    /// Whether it has a point of the screen.
    pub(super) fn holds(&self, at: DVec2) -> bool {
        self.sides().all(|side| side.at(at) >= 0.0)
    }

    /// The greatest key that it has in a square of the screen around a point.
    #[inline]
    pub(super) fn nearest_in(&self, middle: DVec2, half: f64) -> f64 {
        math::min(self.key.at(middle) + half * self.key.normal.abs().element_sum(), self.keys[1])
    }

    /// The least key there.
    #[inline]
    pub(super) fn farthest_in(&self, middle: DVec2, half: f64) -> f64 {
        math::max(self.key.at(middle) - half * self.key.normal.abs().element_sum(), self.keys[0])
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

    /// A box around what a square of the screen sees of it in the plan.
    pub(super) fn plan_in(&self, square: [DVec2; 4]) -> PlanBox {
        if self.is_small || (self.is_central && square.iter().any(|p| self.key.at(*p) <= 0.0)) {
            return self.bounds;
        }
        // Where all of the square has a place on its plane, that is a homography's.
        self.bounds.common(&super::boxes::with_hem(&PlanBox::around(square.map(|p| self.plan_at(p)))))
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

/// A row that is multiplied with (x, y, 1), as a line.
#[inline(always)]
fn line(row: DVec3) -> Side {
    Side { normal: row.truncate(), offset: row.z }
}

/// The columns and rows that a triangle may reach; all where it comes near the eye's plane.
fn reach(view: &ViewFrame, corners: &[Corner; 3]) -> [f64; 4] {
    if corners.iter().any(|corner| !corner.is_before(view)) {
        return [f64::NEG_INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::INFINITY];
    }
    let [a, b, c] = corners.map(|corner| corner.screen);
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
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

/// Which of two triangles is nearer.
pub(super) enum Order {
    /// The new one.
    Nearer,
    /// The old one.
    Farther,
}

/// Which of two triangles is clearly the nearer one wherever two polygons of them overlap; `None`: they are not clearly apart.
pub(super) fn order(new: &Facet, old: &Facet, polygons: [&[DVec2]; 2]) -> Option<Order> {
    for polygon in polygons {
        let (mut most, mut least, mut size) = (f64::NEG_INFINITY, f64::INFINITY, 0.0);
        for p in polygon {
            let (of_new, of_old) = (new.key.at(*p), old.key.at(*p));
            let difference = of_new - of_old;
            (most, least) = (math::max(difference, most), math::min(difference, least));
            size = math::max(of_new.abs() + of_old.abs(), size);
        }
        if least > SAME_KEY * size {
            return Some(Order::Nearer);
        }
        if most < -SAME_KEY * size {
            return Some(Order::Farther);
        }
    }
    None
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
    use crate::space::{Screen, Viewpoint};
    use crate::terrain::SurfaceTriangle;
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
            let corners = triangle.world.map(|corner| Corner::new(&view, origin, corner));
            let facet = Facet::new(&view, 7, &corners, triangle.plan()).unwrap();
            let from_plan = FromPlan::new(&facet);
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
        let of = corners.map(|corner| Corner::new(&view, DVec2::ZERO, corner));
        assert!(Facet::new(&view, 0, &of, corners.map(World::plan)).is_none());
    }
}
