//! Outward-rounded arithmetic for the truth: numbers that are known up to a radius.
//!
//! Input: doubles, taken as exact. Output: [`Ball`]s that contain the exact results of the same operations on real numbers.
//! Refuses: nothing; what cannot be bounded has an infinite radius. (Midpoint and radius rather than two ends: the widths here are
//! a few roundings, and one rounding direction is enough.)

use glam::DVec3;
use std::ops::{Add, Mul, Neg, Sub};

/// Unit roundoff of doubles: a rounded result is within this share of itself of the exact one.
const U: f64 = f64::EPSILON / 2.0;

/// What a radius that was itself computed with at most four roundings is widened by.
const WIDEN: f64 = 1.0 + 8.0 * f64::EPSILON;

/// What the rounding of a product or quotient can lose below the normal numbers.
const UNDERFLOW: f64 = f64::MIN_POSITIVE;

/// The real numbers within `radius` of `mid`.
///
/// # Guarantees
/// `radius` is at least 0 and never NaN; where it is infinite `mid` is 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ball {
    /// The middle.
    pub mid: f64,
    /// How far the exact number may be from the middle.
    pub radius: f64,
}

impl Ball {
    /// Zero.
    pub const ZERO: Self = Self::exact(0.0);

    /// Any number at all.
    pub const ANY: Self = Self { mid: 0.0, radius: f64::INFINITY };

    /// A double, taken as exact.
    #[inline(always)]
    pub const fn exact(mid: f64) -> Self {
        Self { mid, radius: 0.0 }
    }

    /// A middle and a radius with at most four roundings in it.
    #[inline(always)]
    fn rounded(mid: f64, radius: f64) -> Self {
        let radius = radius * WIDEN;
        if radius < f64::INFINITY && mid.is_finite() { Self { mid, radius } } else { Self::ANY }
    }

    /// As the sum that [`Add`] gives, unless it is not known: then what is made of it has to be asked by [`Self::known`].
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        let mid = self.mid + other.mid;
        Self { mid, radius: (self.radius + other.radius + U * mid.abs()) * WIDEN }
    }

    /// As [`Self::plus`], of the product.
    #[inline(always)]
    fn by(self, other: Self) -> Self {
        let mid = self.mid * other.mid;
        let spread = self.mid.abs() * other.radius + self.radius * (other.mid.abs() + other.radius);
        Self { mid, radius: (spread + U * mid.abs() + UNDERFLOW) * WIDEN }
    }

    /// Anything, where a middle or a radius on the way has left the finite numbers: sums and products of it have, too.
    #[inline(always)]
    fn known(self) -> Self {
        if self.radius < f64::INFINITY && self.mid.is_finite() { self } else { Self::ANY }
    }

    /// The smallest number in it, or a little less.
    #[inline(always)]
    pub fn low(self) -> f64 {
        (self.mid - self.radius).next_down()
    }

    /// The largest number in it, or a little more.
    #[inline(always)]
    pub fn high(self) -> f64 {
        (self.mid + self.radius).next_up()
    }

    /// Whether all of it is above 0.
    #[inline(always)]
    pub fn is_positive(self) -> bool {
        self.mid > self.radius
    }

    /// Whether all of it is below 0.
    #[inline(always)]
    pub fn is_negative(self) -> bool {
        -self.mid > self.radius
    }

    /// One over it; anything where it holds 0.
    #[inline]
    pub fn recip(self) -> Self {
        let least = (self.mid.abs() - self.radius).next_down();
        if least.is_nan() || least <= 0.0 {
            return Self::ANY;
        }
        let mid = 1.0 / self.mid;
        // |1/x - 1/mid| = |x - mid| / (|x| |mid|), and one rounding.
        Self::rounded(mid, self.radius / (least * self.mid.abs()) + U * mid.abs() + UNDERFLOW)
    }

    /// Its square root; numbers below 0 in it count as 0.
    #[inline]
    pub fn sqrt(self) -> Self {
        let (low, high) = (self.low(), self.high());
        if high <= 0.0 {
            return Self::ZERO;
        }
        let (low, high) = (if low > 0.0 { low.sqrt().next_down() } else { 0.0 }, high.sqrt().next_up());
        let mid = 0.5 * (low + high);
        Self::rounded(mid, (high - mid) + (mid - low) + UNDERFLOW)
    }

    /// Its square.
    #[inline(always)]
    pub fn squared(self) -> Self {
        self * self
    }
}

impl Add for Ball {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.plus(other).known()
    }
}

impl Sub for Ball {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Ball {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { mid: -self.mid, radius: self.radius }
    }
}

impl Mul for Ball {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.by(other).known()
    }
}

impl Mul<f64> for Ball {
    type Output = Self;
    #[inline(always)]
    fn mul(self, by: f64) -> Self {
        let mid = self.mid * by;
        Self::rounded(mid, self.radius * by.abs() + U * mid.abs() + UNDERFLOW)
    }
}

/// A vector of balls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BallVec {
    /// First component.
    pub x: Ball,
    /// Second component.
    pub y: Ball,
    /// Third component.
    pub z: Ball,
}

impl BallVec {
    /// A vector, taken as exact.
    #[inline(always)]
    pub fn exact(v: DVec3) -> Self {
        Self { x: Ball::exact(v.x), y: Ball::exact(v.y), z: Ball::exact(v.z) }
    }

    /// `a - b` of exact vectors.
    #[inline(always)]
    pub fn difference(a: DVec3, b: DVec3) -> Self {
        Self::exact(a) - Self::exact(b)
    }

    /// The middles.
    pub fn middle(self) -> DVec3 {
        DVec3::new(self.x.mid, self.y.mid, self.z.mid)
    }

    /// The dot product.
    #[inline(always)]
    pub fn dot(self, other: Self) -> Ball {
        self.x.by(other.x).plus(self.y.by(other.y)).plus(self.z.by(other.z)).known()
    }

    /// The cross product.
    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        let minus = |a: Ball, b: Ball, c: Ball, d: Ball| a.by(b).plus(-c.by(d)).known();
        Self {
            x: minus(self.y, other.z, self.z, other.y),
            y: minus(self.z, other.x, self.x, other.z),
            z: minus(self.x, other.y, self.y, other.x),
        }
    }

    /// So many times it.
    #[inline(always)]
    #[must_use]
    pub fn times(self, by: Ball) -> Self {
        Self { x: self.x * by, y: self.y * by, z: self.z * by }
    }
}

impl Add for BallVec {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }
}

impl Sub for BallVec {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use dashu::rational::RBig;
    use proptest::prelude::*;

    fn rational(v: f64) -> RBig {
        RBig::try_from(v).unwrap()
    }

    fn holds(ball: Ball, exact: &RBig) -> bool {
        let (mid, radius) = (rational(ball.mid), rational(ball.radius));
        exact >= &(mid.clone() - radius.clone()) && exact <= &(mid + radius)
    }

    fn double() -> impl Strategy<Value = f64> {
        (-1e6..1e6f64, -30..30i32).prop_map(|(m, e)| m * crate::math::pow(2.0, f64::from(e)))
    }

    proptest! {
        #[test]
        fn a_ball_holds_the_exact_result_of_every_operation(a in double(), b in double(), c in double()) {
            let (x, y, z) = (Ball::exact(a), Ball::exact(b), Ball::exact(c));
            let (p, q, r) = (rational(a), rational(b), rational(c));
            prop_assert!(holds(x + y, &(p.clone() + q.clone())));
            prop_assert!(holds(x * y - z, &(p.clone() * q.clone() - r.clone())));
            let inner = (x - y) * z;
            let exact = (p.clone() - q.clone()) * r.clone();
            prop_assert!(holds(inner * inner + x * c, &(exact.clone() * exact.clone() + p * r)));
            if inner.recip() != Ball::ANY {
                prop_assert!(holds(inner.recip(), &(RBig::ONE / exact)));
            }
        }

        #[test]
        fn the_root_of_a_square_holds_the_number(a in 0.0..1e9f64) {
            let root = Ball::exact(a).squared().sqrt();
            prop_assert!(root.low() <= a && a <= root.high());
            prop_assert!(root.radius <= 1e-15 * a + 1e-150);
        }
    }

    #[test]
    fn products_of_vectors_that_leave_the_finite_numbers_on_the_way_are_anything() {
        let vector = |x, y, z| BallVec { x: Ball::exact(x), y: Ball::exact(y), z: Ball::exact(z) };
        let (huge, tiny) = (vector(1e200, 1e200, 2.0), vector(1e200, -1e200, 3.0));
        assert_eq!(huge.dot(tiny), Ball::ANY, "of the two infinities nothing is left");
        let BallVec { x, y, z } = huge.cross(tiny);
        assert_eq!(z, Ball::ANY);
        assert!(x != Ball::ANY && y != Ball::ANY);
        let open = BallVec { x: Ball::ANY, ..vector(0.0, 1.0, 2.0) };
        assert_eq!(open.dot(vector(0.0, 1.0, 1.0)), Ball::ANY);
        assert_eq!((open.x + Ball::ZERO, Ball::ZERO * open.x), (Ball::ANY, Ball::ANY));
    }

    proptest! {
        #[test]
        fn products_of_vectors_hold_the_exact_ones(
            a in prop::array::uniform3(double()),
            b in prop::array::uniform3(double()),
        ) {
            let vector = |v: [f64; 3]| BallVec::exact(DVec3::from_array(v));
            let (p, q) = (a.map(rational), b.map(rational));
            let exact = |i: usize, j: usize| p[i].clone() * q[j].clone();
            prop_assert!(holds(vector(a).dot(vector(b)), &(exact(0, 0) + exact(1, 1) + exact(2, 2))));
            let BallVec { x, y, z } = vector(a).cross(vector(b));
            prop_assert!(holds(x, &(exact(1, 2) - exact(2, 1))));
            prop_assert!(holds(y, &(exact(2, 0) - exact(0, 2))));
            prop_assert!(holds(z, &(exact(0, 1) - exact(1, 0))));
        }
    }

    #[test]
    fn one_over_a_ball_that_holds_zero_is_anything() {
        assert_eq!((Ball::exact(1e-30) - Ball { mid: 0.0, radius: 1e-29 }).recip(), Ball::ANY);
        assert_eq!(Ball::ZERO.recip(), Ball::ANY);
        assert_eq!(Ball::ANY * Ball::ZERO, Ball::ANY);
    }
}
