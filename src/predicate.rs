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
    let parameter = |triangle| Parameter::of(ray, triangle);
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
    let (t, limit) = (Parameter::of(ray, triangle), depth / frame.reach());
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

    /// The numbers that [`quick_hit_parameter`] takes.
    #[inline]
    pub fn numbers(&self) -> [f64; 9] {
        let [a, n, s] = [self.triangle[0].to_vec(), self.normal, self.spread];
        [a.x, a.y, a.z, n.x, n.y, n.z, s.x, s.y, s.z]
    }

    /// As the function [`hit_parameter`].
    #[inline]
    pub fn hit_parameter(&self, ray: &Ray) -> f64 {
        let (value, is_sure) = quick_hit_parameter(ray, &self.numbers());
        if is_sure {
            return value;
        }
        let (n, d) = hit_fraction(ray, &self.triangle);
        if d.0.is_empty() { 0.0 } else { n.rounded() / d.rounded() }
    }
}

/// The parameter of a ray at a plane of these [`TrianglePlane::numbers`] in plain doubles, and whether it is good to a relative 2^-30.
#[inline(always)]
pub fn quick_hit_parameter(ray: &Ray, numbers: &[f64; 9]) -> (f64, bool) {
    let fast = Parameter::new(ray, numbers);
    (fast.value, fast.error < fast.value.abs() * (1.0 / (1u64 << 30) as f64))
}

/// A ray's parameter at a triangle's plane in plain doubles, with a bound of its error (infinite or NaN when the plane
/// nearly holds the ray).
struct Parameter {
    value: f64,
    error: f64,
}

impl Parameter {
    #[inline]
    fn of(ray: &Ray, triangle: &[World; 3]) -> Self {
        Self::new(ray, &TrianglePlane::new(triangle).numbers())
    }

    #[inline(always)]
    fn new(ray: &Ray, &[ax, ay, az, nx, ny, nz, sx, sy, sz]: &[f64; 9]) -> Self {
        let (start, along) = (World::new(ax, ay, az) - ray.from, ray.through - ray.from);
        let (normal, spread) = (DVec3::new(nx, ny, nz), DVec3::new(sx, sy, sz));
        let (n, d) = (start.dot(normal), along.dot(normal));
        // Nine roundings bound each product's path (see `sign_of_det`), one more the quotient.
        let n_error = 10.0 * U * start.abs().dot(spread);
        let d_error = 10.0 * U * along.abs().dot(spread);
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
mod tests;
