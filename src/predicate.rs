//! Exact decisions: the sign of a determinant, whatever the rounding.
//!
//! Input: finite doubles, taken as exact numbers of magnitude 2^-160 .. 2^160 (or 0), so that no product of the
//! expansions below leaves the range of doubles. Output: a sign, never a guess. A floating-point filter with a
//! proven bound decides nearly every case; expansions (Shewchuk 1997, "Adaptive precision floating-point arithmetic")
//! the rest. Refuses: nothing; NaN in gives an arbitrary sign.

mod hit_side;
mod near;

pub use hit_side::{hit_is_above, hit_side, moved_ray_side};
pub use near::{Displacement, distance_squared, is_near_segment};

use crate::space::{Lens, Plan, Ray, ViewFrame, World};
use glam::DVec3;
use std::cmp::Ordering;

/// Unit roundoff of doubles.
const U: f64 = f64::EPSILON / 2.0;

/// The side of `p` relative to the line a -> b: positive left, negative right, 0 exactly on it.
#[inline]
pub fn orient2d(a: Plan, b: Plan, p: Plan) -> f64 {
    let c = |p: Plan| robust::Coord { x: p.x, y: p.y };
    robust::orient2d(c(a), c(b), c(p))
}

/// The sign of det[a - d, b - d, c - d].
#[inline]
fn orient3d(a: World, b: World, c: World, d: World) -> f64 {
    let c3 = |p: World| robust::Coord3D { x: p.x, y: p.y, z: p.z };
    robust::orient3d(c3(a), c3(b), c3(c), c3(d))
}

/// On which side of a ray the edge a -> b passes: positive when `a`, `b` turn counter-clockwise about the ray on the
/// screen as the viewer sees it (y up).
///
/// A ray that meets the edge exactly is moved by an infinitesimal step right and a still smaller one down on the
/// screen, the same for every edge: so each sample on a shared edge or vertex belongs to exactly one of the triangles
/// around it (the rule "top-left" of rasterizers, for all cases). 0 only for an edge seen end-on or of no length.
pub fn ray_side(frame: &ViewFrame, ray: &Ray, a: World, b: World) -> f64 {
    // robust's det[a - d, b - d, c - d] with c on the ray and d its start: positive when a, b turn clockwise seen
    // from d towards c in a right-handed space.
    let side = -orient3d(a, b, ray.through, ray.from);
    if side != 0.0 {
        return side;
    }
    tie_side(frame, ray, a, b)
}

/// The sign of the first non-vanishing derivative of [`ray_side`] as the ray moves right, then down.
#[cold]
fn tie_side(frame: &ViewFrame, ray: &Ray, a: World, b: World) -> f64 {
    for step in [frame.right(), -frame.up()] {
        let step = Difference { of: step, minus: DVec3::ZERO };
        let rows = match frame.lens() {
            Lens::Central { .. } => [Difference::new(a, ray.from), Difference::new(b, ray.from), step],
            Lens::Parallel { .. } => [Difference::new(b, a), step, Difference::new(ray.through, ray.from)],
        };
        let sign = -sign_of_det(&rows);
        if sign != 0.0 {
            return sign;
        }
    }
    0.0
}

/// From which side a triangle is seen: the sign of `normal . (corner - eye)` (perspective) or of `normal . forward`
/// (orthographic), the normal `(b - a) x (c - a)`; 0 exactly when it is seen edge-on.
pub fn facing(frame: &ViewFrame, [a, b, c]: &[World; 3]) -> f64 {
    match frame.lens() {
        Lens::Central { .. } => orient3d(*a, *b, *c, frame.eye()),
        Lens::Parallel { .. } => {
            let forward = Difference { of: frame.forward(), minus: DVec3::ZERO };
            sign_of_det(&[Difference::new(*b, *a), Difference::new(*c, *a), forward])
        }
    }
}

/// Which of two triangles a ray that crosses both meets first; the ray crosses neither edge-on.
///
/// Exact: equal means that they meet the ray in the very same point.
pub fn compare_along_ray(ray: &Ray, first: &[World; 3], second: &[World; 3]) -> Ordering {
    let parameter = |triangle| Parameter::new(ray, &TrianglePlane::new(triangle));
    let (t1, t2) = (parameter(first), parameter(second));
    if (t1.value - t2.value).abs() > t1.error + t2.error {
        return if t1.value < t2.value { Ordering::Less } else { Ordering::Greater };
    }
    let (n1, d1) = hit_fraction(ray, first);
    let (n2, d2) = hit_fraction(ray, second);
    let flip = d1.sign() * d2.sign();
    let sign = n1.times(&d2).minus(&n2.times(&d1)).sign() * flip;
    sign.partial_cmp(&0.0).unwrap_or(Ordering::Equal)
}

/// Whether the view depth at which a ray meets a triangle is at least `depth` metres (exactly).
pub fn is_hit_beyond(frame: &ViewFrame, ray: &Ray, triangle: &[World; 3], depth: f64) -> bool {
    // The ray reaches view depth `reach` (a power of two) at parameter 1.
    let (t, limit) = (Parameter::new(ray, &TrianglePlane::new(triangle)), depth / frame.reach());
    if (t.value - limit).abs() > t.error {
        return t.value > limit;
    }
    let (n, d) = hit_fraction(ray, triangle);
    let flip = d.sign();
    n.scaled(frame.reach()).minus(&d.scaled(depth)).sign() * flip >= 0.0
}

/// The ray's parameter (0 at `from`, 1 at `through`) where it meets a triangle's plane, to a relative 2^-30 however
/// grazing the ray; 0 for a plane that holds the ray's direction.
pub fn hit_parameter(ray: &Ray, triangle: &[World; 3]) -> f64 {
    TrianglePlane::new(triangle).hit_parameter(ray)
}

/// The weights of a triangle's second and third corner in the point where a ray meets its plane, good to a few roundings however thin the
/// triangle and grazing the ray; 0 for a plane that holds the ray's direction.
#[cold]
pub fn hit_weights(ray: &Ray, [a, b, c]: &[World; 3]) -> [f64; 2] {
    let (u, v, start) = (Difference::new(*b, *a), Difference::new(*c, *a), Difference::new(ray.from, *a));
    let along = Difference::new(ray.through, ray.from);
    let whole = exact_det(&[along, u, v]);
    let share = |part: Expansion| if whole.0.is_empty() { 0.0 } else { part.rounded() / whole.rounded() };
    [share(exact_det(&[along, start, v])), share(exact_det(&[along, u, start]))]
}

/// A triangle's plane, for many rays.
#[derive(Debug, Clone, Copy)]
pub struct TrianglePlane {
    triangle: [World; 3],
    normal: DVec3,
    /// What the normal's components may be made of: their terms' magnitudes.
    spread: DVec3,
}

impl TrianglePlane {
    /// The plane of a triangle.
    #[inline]
    pub fn new(triangle: &[World; 3]) -> Self {
        let [a, b, c] = *triangle;
        let (u, v) = (b - a, c - a);
        let (m, p) = (u.abs(), v.abs());
        let spread = DVec3::new(m.y * p.z + m.z * p.y, m.z * p.x + m.x * p.z, m.x * p.y + m.y * p.x);
        Self { triangle: *triangle, normal: u.cross(v), spread }
    }

    /// The parameter in plain doubles, and whether it is good to a relative 2^-30.
    #[inline(always)]
    pub fn quick_hit_parameter(&self, ray: &Ray) -> (f64, bool) {
        let fast = Parameter::new(ray, self);
        (fast.value, fast.error < fast.value.abs() * (1.0 / (1u64 << 30) as f64))
    }

    /// As the function [`hit_parameter`].
    #[inline]
    pub fn hit_parameter(&self, ray: &Ray) -> f64 {
        let (value, is_sure) = self.quick_hit_parameter(ray);
        if is_sure {
            return value;
        }
        let (n, d) = hit_fraction(ray, &self.triangle);
        if d.0.is_empty() { 0.0 } else { n.rounded() / d.rounded() }
    }
}

/// A ray's parameter at a triangle's plane in plain doubles, with a bound of its error (infinite or NaN when the plane
/// nearly holds the ray).
struct Parameter {
    value: f64,
    error: f64,
}

impl Parameter {
    #[inline(always)]
    fn new(ray: &Ray, plane: &TrianglePlane) -> Self {
        let (start, along) = (plane.triangle[0] - ray.from, ray.through - ray.from);
        let (n, d) = (start.dot(plane.normal), along.dot(plane.normal));
        // Nine roundings bound each product's path (see `sign_of_det`), one more the quotient.
        let n_error = 10.0 * U * start.abs().dot(plane.spread);
        let d_error = 10.0 * U * along.abs().dot(plane.spread);
        let value = n / d;
        let certain = d.abs() - d_error;
        let error = (n_error + value.abs() * d_error) / certain + 2.0 * U * value.abs();
        let is_certain = certain > 0.0;
        Self {
            value: if is_certain { value } else { 0.0 },
            error: if is_certain { error } else { f64::INFINITY },
        }
    }
}

/// The ray's parameter where it meets a triangle's plane, as numerator and denominator.
fn hit_fraction(ray: &Ray, [a, b, c]: &[World; 3]) -> (Expansion, Expansion) {
    let (u, v) = (Difference::new(*b, *a), Difference::new(*c, *a));
    let numerator = exact_det(&[Difference::new(*a, ray.from), u, v]);
    let denominator = exact_det(&[Difference::new(ray.through, ray.from), u, v]);
    (numerator, denominator)
}

/// A vector given as the difference of two stored ones: exact, where its rounded components would not be.
#[derive(Debug, Clone, Copy)]
struct Difference {
    of: DVec3,
    minus: DVec3,
}

impl Difference {
    fn new(of: World, minus: World) -> Self {
        Self { of: of.to_vec(), minus: minus.to_vec() }
    }

    fn rounded(&self) -> DVec3 {
        self.of - self.minus
    }

    fn component(&self, axis: usize) -> Expansion {
        Expansion::difference(self.of[axis], self.minus[axis])
    }
}

/// The sign of a 3 x 3 determinant of exact rows.
fn sign_of_det(rows: &[Difference; 3]) -> f64 {
    let [a, b, c] = [rows[0].rounded(), rows[1].rounded(), rows[2].rounded()];
    let det = a.dot(b.cross(c));
    let (m, p, q) = (a.abs(), b.abs(), c.abs());
    let permanent =
        m.x * (p.y * q.z + p.z * q.y) + m.y * (p.z * q.x + p.x * q.z) + m.z * (p.x * q.y + p.y * q.x);
    // Each of the six products carries at most 3 rounded differences, 2 products and 3 sums: 8 roundings, so
    // 9 U per product bounds the error with the higher-order terms.
    if det.abs() > 9.0 * U * permanent || permanent == 0.0 { det } else { exact_det(rows).sign() }
}

/// A 3 x 3 determinant, exactly.
fn exact_det(rows: &[Difference; 3]) -> Expansion {
    let minor = |i: usize, j: usize| {
        let left = rows[1].component(i).times(&rows[2].component(j));
        left.minus(&rows[1].component(j).times(&rows[2].component(i)))
    };
    let x = rows[0].component(0).times(&minor(1, 2));
    let y = rows[0].component(1).times(&minor(2, 0));
    let z = rows[0].component(2).times(&minor(0, 1));
    x.plus(&y).plus(&z)
}

/// A number as the exact sum of doubles that do not overlap, smallest first, none zero (Shewchuk 1997, section 2.3).
#[derive(Debug, Clone, PartialEq)]
pub struct Expansion(Vec<f64>);

impl Expansion {
    /// What a double is.
    pub fn exactly(v: f64) -> Self {
        Self(two_term(v, 0.0))
    }

    /// A difference of two doubles.
    pub fn difference(of: f64, minus: f64) -> Self {
        let high = of - minus;
        Self(two_term(high, two_diff_tail(of, minus, high)))
    }

    /// -1, 0 or 1: the largest component's sign is that of the sum.
    pub fn sign(&self) -> f64 {
        self.0.last().map_or(0.0, |v| v.signum())
    }

    /// The nearest double, or its neighbour.
    pub fn rounded(&self) -> f64 {
        self.0.iter().fold(0.0, |sum, v| sum + v)
    }

    /// The sum: Shewchuk's GROW-EXPANSION with zero elimination, once for each component of `other`.
    pub fn plus(&self, other: &Self) -> Self {
        let mut sum = self.0.clone();
        for &term in &other.0 {
            sum = grow(&sum, term);
        }
        Self(sum)
    }

    /// The difference.
    pub fn minus(&self, other: &Self) -> Self {
        self.plus(&Self(other.0.iter().map(|v| -v).collect()))
    }

    /// The product with a double (SCALE-EXPANSION).
    pub fn scaled(&self, by: f64) -> Self {
        let mut sum = Vec::with_capacity(2 * self.0.len());
        for &term in &self.0 {
            let high = term * by;
            let low = two_product_tail(term, by, high);
            sum = grow(&grow(&sum, low), high);
        }
        Self(sum)
    }

    /// The product.
    pub fn times(&self, other: &Self) -> Self {
        other.0.iter().fold(Self(Vec::new()), |sum, &term| sum.plus(&self.scaled(term)))
    }
}

/// The expansion plus one double.
fn grow(expansion: &[f64], term: f64) -> Vec<f64> {
    let mut out = Vec::with_capacity(expansion.len() + 1);
    let mut carry = term;
    for &e in expansion {
        let sum = carry + e;
        let tail = two_sum_tail(carry, e, sum);
        if tail != 0.0 {
            out.push(tail);
        }
        carry = sum;
    }
    if carry != 0.0 {
        out.push(carry);
    }
    out
}

fn two_term(high: f64, low: f64) -> Vec<f64> {
    [low, high].into_iter().filter(|v| *v != 0.0).collect()
}

/// What rounding lost in `sum = a + b` (Knuth's TWO-SUM).
fn two_sum_tail(a: f64, b: f64, sum: f64) -> f64 {
    let b_virtual = sum - a;
    (a - (sum - b_virtual)) + (b - b_virtual)
}

/// What rounding lost in `difference = a - b`.
fn two_diff_tail(a: f64, b: f64, difference: f64) -> f64 {
    let b_virtual = a - difference;
    (a - (difference + b_virtual)) + (b_virtual - b)
}

/// What rounding lost in `product = a * b` (Dekker's split, Veltkamp's constant 2^27 + 1).
fn two_product_tail(a: f64, b: f64, product: f64) -> f64 {
    let split = |v: f64| {
        let scaled = 134_217_729.0 * v;
        let high = scaled - (scaled - v);
        (high, v - high)
    };
    let ((a_high, a_low), (b_high, b_low)) = (split(a), split(b));
    a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::Viewpoint;
    use dashu::rational::RBig;
    use proptest::prelude::*;

    fn rational(v: f64) -> RBig {
        RBig::try_from(v).unwrap()
    }

    fn rational_det(rows: &[Difference; 3]) -> RBig {
        let m: Vec<Vec<RBig>> =
            rows.iter().map(|r| (0..3).map(|k| rational(r.of[k]) - rational(r.minus[k])).collect()).collect();
        let minor =
            |i: usize, j: usize| m[1][i].clone() * m[2][j].clone() - m[1][j].clone() * m[2][i].clone();
        m[0][0].clone() * minor(1, 2) + m[0][1].clone() * minor(2, 0) + m[0][2].clone() * minor(0, 1)
    }

    fn sign(v: &RBig) -> f64 {
        match v.partial_cmp(&RBig::ZERO).unwrap() {
            Ordering::Less => -1.0,
            Ordering::Equal => 0.0,
            Ordering::Greater => 1.0,
        }
    }

    fn coordinate() -> impl Strategy<Value = f64> {
        // Few distinct values a few ulps apart: determinants near and at zero are frequent.
        (0..6i32, -2..3i64).prop_map(|(k, ulps)| {
            let base = f64::from(k) * 0.1;
            f64::from_bits((base.to_bits() as i64 + if base == 0.0 { 0 } else { ulps }) as u64)
        })
    }

    fn point() -> impl Strategy<Value = World> {
        (coordinate(), coordinate(), coordinate()).prop_map(|(x, y, z)| World::new(x, y, z))
    }

    /// Points of a small lattice: that a ray meets an edge is frequent, and determinants of doubles are exact.
    fn post() -> impl Strategy<Value = World> {
        let at = || (-2..3i8).prop_map(f64::from);
        (at(), at(), at()).prop_map(|(x, y, z)| World::new(x, y, z))
    }

    /// A central and a parallel view to the north: right is east on the screen, up is up.
    fn looking_north() -> [ViewFrame; 2] {
        let (eye, target) = (World::new(0.0, -8.0, 0.0), World::new(0.0, 0.0, 0.0));
        let view = Viewpoint { eye, target, up: DVec3::Z, near: 0.5, far: f64::INFINITY };
        [ViewFrame::perspective(&view, 60.0, (8, 8)), ViewFrame::orthographic(&view, 8.0, (8, 8))]
            .map(|frame| frame.unwrap())
    }

    /// The first side that is not 0 of the edge a -> b, as the ray is moved by each of these steps (`true`: its start too).
    fn first_side(ray: &Ray, is_start_moved: bool, [a, b]: [World; 2], steps: &[DVec3]) -> f64 {
        let side = |step: &DVec3| {
            let (from, through) =
                (if is_start_moved { ray.from + *step } else { ray.from }, ray.through + *step);
            (through - from).dot((b - from).cross(a - from))
        };
        steps.iter().map(side).find(|side| *side != 0.0).unwrap_or(0.0)
    }

    /// -1, 0 or 1.
    fn signum(v: f64) -> f64 {
        if v == 0.0 { 0.0 } else { v.signum() }
    }

    #[test]
    fn an_edge_that_turns_counter_clockwise_about_the_ray_is_on_its_positive_side() {
        for frame in looking_north() {
            let ray = Ray { from: frame.eye(), through: World::new(0.0, 0.0, 0.0) };
            let (a, b, c) =
                (World::new(1.0, 3.0, -1.0), World::new(1.0, 2.0, 1.0), World::new(-1.0, 2.5, 0.0));
            for (from, to) in [(a, b), (b, c), (c, a)] {
                assert!(ray_side(&frame, &ray, from, to) > 0.0 && moved_ray_side(&ray, from, to) > 0.0);
                assert!(ray_side(&frame, &ray, to, from) < 0.0 && moved_ray_side(&ray, to, from) < 0.0);
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]
        #[test]
        fn a_ray_that_meets_an_edge_is_moved_right_on_the_screen_and_then_down(p in prop::array::uniform3(post())) {
            let [through, a, b] = p;
            let steps = [DVec3::ZERO, DVec3::X, -DVec3::Z];
            let [central, parallel] = looking_north();
            let ray = Ray { from: central.eye(), through };
            let expected = first_side(&ray, false, [a, b], &steps);
            prop_assert_eq!(signum(ray_side(&central, &ray, a, b)), signum(expected));
            let ray = Ray { from: World::new(through.x, -8.0, through.z), through };
            let expected = first_side(&ray, true, [a, b], &steps);
            prop_assert_eq!(signum(ray_side(&parallel, &ray, a, b)), signum(expected));
        }

        #[test]
        fn the_side_of_a_line_of_the_plan_is_that_of_rational_arithmetic(p in prop::array::uniform3(point())) {
            let [a, b, q] = p.map(|p| p.plan());
            let [ab, aq] = [b, q].map(|to| [rational(to.x) - rational(a.x), rational(to.y) - rational(a.y)]);
            let expected = ab[0].clone() * aq[1].clone() - ab[1].clone() * aq[0].clone();
            prop_assert_eq!(signum(orient2d(a, b, q)), sign(&expected));
        }

        #[test]
        fn a_ray_that_meets_an_edge_is_moved_east_then_north_then_up(p in prop::array::uniform4(post())) {
            let [from, through, a, b] = p;
            let ray = Ray { from, through };
            let expected = first_side(&ray, true, [a, b], &[DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z]);
            prop_assert_eq!(signum(moved_ray_side(&ray, a, b)), signum(expected));
        }

        #[test]
        fn a_triangle_faces_along_its_normal(p in prop::array::uniform3(post())) {
            let [a, b, c] = p;
            let normal = (b - a).cross(c - a);
            let [central, parallel] = looking_north();
            prop_assert_eq!(signum(facing(&central, &p)), signum(normal.dot(a - central.eye())));
            prop_assert_eq!(signum(facing(&parallel, &p)), signum(normal.y));
        }

        #[test]
        fn the_parameter_of_a_hit_and_what_it_lies_beyond_are_those_of_rational_arithmetic(
            p in prop::array::uniform5(point()),
        ) {
            let (ray, t) = (Ray { from: p[0], through: p[1] }, [p[2], p[3], p[4]]);
            let (u, v) = (Difference::new(t[1], t[0]), Difference::new(t[2], t[0]));
            let d = rational_det(&[Difference::new(ray.through, ray.from), u, v]);
            if d == RBig::ZERO {
                prop_assert_eq!(hit_parameter(&ray, &t), 0.0);
                return Ok(());
            }
            let exact = rational_det(&[Difference::new(t[0], ray.from), u, v]) / d;
            let nearest = exact.to_f64().value();
            prop_assert!((hit_parameter(&ray, &t) - nearest).abs() <= nearest.abs() / f64::from(1 << 30));
            let [frame, _] = looking_north();
            let exact = exact * rational(frame.reach());
            let nearest = exact.to_f64().value();
            let depths = [nearest, nearest.next_up(), nearest.next_down(), 2.0 * nearest, -nearest, 0.0];
            // Nearer to 0 products leave the range of doubles.
            for depth in depths.into_iter().filter(|depth| *depth == 0.0 || depth.abs() > 1e-48) {
                prop_assert_eq!(is_hit_beyond(&frame, &ray, &t, depth), exact >= rational(depth));
            }
        }

        #[test]
        fn the_sign_of_a_determinant_is_that_of_rational_arithmetic(p in prop::array::uniform6(point())) {
            let rows = [Difference::new(p[0], p[1]), Difference::new(p[2], p[3]), Difference::new(p[4], p[5])];
            let expected = sign(&rational_det(&rows));
            prop_assert_eq!(exact_det(&rows).sign(), expected);
            let filtered = sign_of_det(&rows);
            prop_assert_eq!(signum(filtered), expected);
        }

        #[test]
        fn the_order_along_a_ray_is_that_of_rational_arithmetic(p in prop::array::uniform8(point())) {
            let ray = Ray { from: p[0], through: p[1] };
            let (t1, t2) = ([p[2], p[3], p[4]], [p[5], p[6], p[7]]);
            let parameter = |t: &[World; 3]| {
                let (u, v) = (Difference::new(t[1], t[0]), Difference::new(t[2], t[0]));
                let n = rational_det(&[Difference::new(t[0], ray.from), u, v]);
                let d = rational_det(&[Difference::new(ray.through, ray.from), u, v]);
                (d != RBig::ZERO).then(|| n / d)
            };
            if let (Some(first), Some(second)) = (parameter(&t1), parameter(&t2)) {
                prop_assert_eq!(compare_along_ray(&ray, &t1, &t2), first.partial_cmp(&second).unwrap());
            }
        }

        #[test]
        fn the_weights_of_a_hit_are_those_of_rational_arithmetic(p in prop::array::uniform5(point())) {
            let (ray, t) = (Ray { from: p[0], through: p[1] }, [p[2], p[3], p[4]]);
            let (u, v) = (Difference::new(t[1], t[0]), Difference::new(t[2], t[0]));
            let along = Difference::new(ray.through, ray.from);
            let d = rational_det(&[along, u, v]);
            prop_assume!(d != RBig::ZERO);
            let start = Difference::new(ray.from, t[0]);
            let exact = [[along, start, v], [along, u, start]].map(|rows| rational_det(&rows) / d.clone());
            for (weight, exact) in hit_weights(&ray, &t).into_iter().zip(exact) {
                prop_assert!((weight - exact.to_f64().value()).abs() <= 1e-14 * weight.abs());
            }
        }

        #[test]
        fn the_side_of_a_hit_is_that_of_rational_arithmetic(p in prop::array::uniform7(point())) {
            let (ray, t) = (Ray { from: p[0], through: p[1] }, [p[2], p[3], p[4]]);
            let (a, b) = (p[5].plan(), p[6].plan());
            let (u, v) = (Difference::new(t[1], t[0]), Difference::new(t[2], t[0]));
            let n = rational_det(&[Difference::new(t[0], ray.from), u, v]);
            let d = rational_det(&[Difference::new(ray.through, ray.from), u, v]);
            prop_assume!(d != RBig::ZERO && a != b);
            let at = |from: f64, to: f64| rational(from) + (rational(to) - rational(from)) * n.clone() / d.clone();
            let (x, y) = (at(ray.from.x, ray.through.x), at(ray.from.y, ray.through.y));
            let (along_x, along_y) = (rational(b.x) - rational(a.x), rational(b.y) - rational(a.y));
            let side = along_x.clone() * (y - rational(a.y)) - along_y.clone() * (x - rational(a.x));
            // On the line: a step east, then one north.
            let signs = [sign(&side), -sign(&along_y), sign(&along_x)];
            let expected = signs.into_iter().find(|s| *s != 0.0).unwrap();
            prop_assert_eq!(hit_side(&ray, &t, a, b).signum(), expected);
            let height = at(ray.from.z, ray.through.z) - rational(p[5].z);
            prop_assert_eq!(hit_is_above(&ray, &t, p[5].z), sign(&height) >= 0.0);
        }
    }
}
