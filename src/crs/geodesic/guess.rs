//! A first azimuth from which Newton's method finds the geodesic: Karney (2013), sections 4 and 5.

use super::angle::Angle;
use super::series::a3;
use super::triangle::{ROUNDING, Triangle, epsilon};
use crate::math::{atan2, cbrt, cos, hypot, max, min, sin};
use std::f64::consts::PI;

/// Nearer to the end of the cut locus than this the azimuth depends on nothing but x (section 5, around eq. 57).
const AT_THE_CUT: f64 = 1000.0 * 1.5e-8;

/// What is known before the first step.
pub(super) enum Guess {
    /// The places are so near that the sphere's formulas are right: azimuths at both, and the arc times the ellipsoid's semi-minor axis
    /// and the stretch that eq. 48 gives.
    Short { alpha1: Angle, alpha2: Angle, length: f64 },
    /// An azimuth at the first place.
    Azimuth(Angle),
}

pub(super) fn guess(triangle: &Triangle<'_>) -> Guess {
    let &Triangle { ellipsoid, beta1, beta2, lambda, short_of_half_a_turn } = triangle;
    let lambda12 = PI - short_of_half_a_turn;
    let second_e2 = ellipsoid.e2() / (1.0 - ellipsoid.e2());
    let difference = beta2.minus(beta1);
    // Of the latitudes' sum: 0 at antipodes.
    let sum = beta2.sin * beta1.cos + beta2.cos * beta1.sin;
    let is_near = difference.cos >= 0.0 && difference.sin < 0.5 && beta2.cos * lambda12 < 0.5;
    // Eq. 48: the longitude on the sphere where the curvature is that of the middle latitude.
    let stretch = {
        let (s, c) = (beta1.sin + beta2.sin, beta1.cos + beta2.cos);
        (1.0 + second_e2 * s * s / (s * s + c * c)).sqrt()
    };
    let omega = if is_near { Angle::of_radians(lambda12 / ((1.0 - ellipsoid.f) * stretch)) } else { lambda };
    // Eqs. 49 and 50, written so that nothing cancels.
    let versine = |omega: Angle| match omega.cos >= 0.0 {
        true => omega.sin * omega.sin / (1.0 + omega.cos),
        false => 1.0 - omega.cos,
    };
    let east = beta2.cos * omega.sin;
    let north = match omega.cos >= 0.0 {
        true => difference.sin + beta2.cos * beta1.sin * versine(omega),
        false => sum - beta2.cos * beta1.sin * omega.sin * omega.sin / (1.0 - omega.cos),
    };
    let arc =
        Angle { sin: hypot(east, north), cos: beta1.sin * beta2.sin + beta1.cos * beta2.cos * omega.cos };
    if is_near && arc.sin < short(ellipsoid.f) {
        let back = difference.sin - beta1.cos * beta2.sin * versine(omega);
        let length = ellipsoid.b() * stretch * arc.radians();
        return Guess::Short {
            alpha1: eastward(east, north),
            alpha2: eastward(beta1.cos * omega.sin, back),
            length,
        };
    }
    let n = ellipsoid.third_flattening();
    if arc.cos >= 0.0 || arc.sin >= 6.0 * n * PI * beta1.cos * beta1.cos {
        return Guess::Azimuth(eastward(east, north));
    }
    // Eqs. 53 and 54: coordinates around the antipode, in units of the cut locus.
    let scale = ellipsoid.f * beta1.cos * a3(n, epsilon(ellipsoid, beta1.sin)) * PI;
    let (x, y) = (-short_of_half_a_turn / scale, sum / (scale * beta1.cos));
    if y > -200.0 * ROUNDING && x > -1.0 - AT_THE_CUT {
        // Eqs. 57 and 58, on the cut locus.
        let sin = min(1.0, -x);
        return Guess::Azimuth(eastward(sin, -max(0.0, 1.0 - sin * sin).sqrt()));
    }
    // Eq. 56 by way of omega, whose error is one order smaller.
    let k = astroid(x, y);
    let short_of_half = scale * -x * k / (1.0 + k);
    let (s, c) = (sin(short_of_half), -cos(short_of_half));
    Guess::Azimuth(eastward(beta2.cos * s, sum - beta2.cos * beta1.sin * s * s / (1.0 - c)))
}

/// An azimuth between north and south by way of east.
fn eastward(sin: f64, cos: f64) -> Angle {
    if sin > 0.0 { Angle::towards(sin, cos) } else { Angle { sin: 1.0, cos: 0.0 } }
}

/// Arcs so short, radians, are the sphere's to the last digits (the end of section 4).
fn short(flattening: f64) -> f64 {
    0.1 * ROUNDING.sqrt() / (max(0.001, flattening) * min(1.0, 1.0 - flattening / 2.0) / 2.0).sqrt()
}

/// The positive root of k^4 + 2 k^3 - (x^2 + y^2 - 1) k^2 - 2 y^2 k - y^2 = 0 (eqs. 55 and 59 to 65).
fn astroid(x: f64, y: f64) -> f64 {
    let (p, q) = (x * x, y * y);
    let r = (p + q - 1.0) / 6.0;
    if q == 0.0 && r <= 0.0 {
        return 0.0;
    }
    let (s, r3) = (p * q / 4.0, r * r * r);
    let discriminant = s * (s + 2.0 * r3);
    let u = if discriminant >= 0.0 {
        // The larger root of the two, for fewer digits lost.
        let t3 = s + r3;
        let t = cbrt(t3 + if t3 < 0.0 { -discriminant.sqrt() } else { discriminant.sqrt() });
        r + t + if t == 0.0 { 0.0 } else { r * r / t }
    } else {
        r + 2.0 * r * cos(atan2((-discriminant).sqrt(), -(s + r3)) / 3.0)
    };
    let v = (u * u + q).sqrt();
    let both = if u < 0.0 { q / (v - u) } else { u + v };
    let w = (both - q) / (2.0 * v);
    both / ((both + w * w).sqrt() + w)
}
