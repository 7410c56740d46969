//! Which geodesic leads from one place to another: the inverse problem, Karney (2013), section 4.

use super::angle::Angle;
use super::guess::{Guess, guess};
use super::series::{a1, a2, a3, c1, c2, c3};
use super::triangle::{ROUNDING, TINY, Triangle, epsilon, reduced};
use crate::crs::ellipsoid::Ellipsoid;
use crate::crs::fourier::sines;
use crate::math::{atan2, hypot, max};
use std::f64::consts::PI;

/// Steps by Newton's method; beyond, the azimuth is bracketed by halves. Three or four are usual.
const NEWTON_STEPS: u32 = 20;

/// Steps in all: so many halves of an azimuth are a last digit.
const STEPS: u32 = NEWTON_STEPS + 63;

/// The way that was found.
pub(super) struct Found {
    /// In metres.
    pub(super) length: f64,
    /// At the first place.
    pub(super) azimuth: Angle,
}

/// The way between two latitudes and so many degrees to the east (-180..=180).
pub(super) fn inverse(ellipsoid: &Ellipsoid, from: f64, to: f64, east: f64) -> Found {
    let is_swapped = from.abs() < to.abs();
    let (first, second) = if is_swapped { (to, from) } else { (from, to) };
    let upright = if first < 0.0 { 1.0 } else { -1.0 };
    let degrees = east.abs();
    let triangle = Triangle {
        ellipsoid,
        beta1: reduced(ellipsoid, upright * first),
        beta2: reduced(ellipsoid, upright * second),
        lambda: Angle::of_degrees(degrees),
        short_of_half_a_turn: (180.0 - degrees).to_radians(),
    };
    let Way { length, alpha1, alpha2 } = triangle.way();
    let (there, mirrored) = if is_swapped { (alpha2, -upright) } else { (alpha1, upright) };
    let azimuth = Angle { sin: there.sin * 1_f64.copysign(east), cos: there.cos * mirrored };
    Found { length, azimuth }
}

/// A way in the turned triangle: its length in metres and its azimuths at both places.
struct Way {
    length: f64,
    alpha1: Angle,
    alpha2: Angle,
}

/// Where an azimuth leads to.
struct Try {
    alpha2: Angle,
    sigma1: Angle,
    sigma2: Angle,
    sigma12: f64,
    epsilon: f64,
    /// By how many radians of longitude the second latitude is met too far east, and how fast that grows with the azimuth.
    off: f64,
    slope: f64,
}

impl Triangle<'_> {
    fn way(&self) -> Way {
        const EAST: Angle = Angle { sin: 1.0, cos: 0.0 };
        if self.lambda.sin == 0.0 || self.beta1.cos <= TINY {
            // Along a meridian, over the nearer pole where the places are on two.
            let (alpha1, alpha2) =
                (Angle { sin: self.lambda.sin.abs(), ..self.lambda }, Angle { sin: 0.0, cos: 1.0 });
            let sigma1 = Angle { sin: self.beta1.sin, cos: alpha1.cos * self.beta1.cos };
            let sigma2 = Angle { sin: self.beta2.sin, cos: self.beta2.cos };
            let length = self.length(epsilon(self.ellipsoid, 1.0), (sigma1, sigma2), arc(sigma1, sigma2));
            return Way { length, alpha1, alpha2 };
        }
        let lambda12 = PI - self.short_of_half_a_turn;
        if self.beta1.sin == 0.0 && self.short_of_half_a_turn >= self.ellipsoid.f * PI {
            return Way { length: self.ellipsoid.a * lambda12, alpha1: EAST, alpha2: EAST };
        }
        match guess(self) {
            Guess::Short { alpha1, alpha2, length } => Way { length, alpha1, alpha2 },
            Guess::Azimuth(alpha1) => {
                let (alpha1, found) = self.solved(alpha1);
                let length = self.length(found.epsilon, (found.sigma1, found.sigma2), found.sigma12);
                Way { length, alpha1, alpha2: found.alpha2 }
            }
        }
    }

    /// The distance of an arc (eqs. 7 and 15).
    fn length(&self, epsilon: f64, (sigma1, sigma2): (Angle, Angle), sigma12: f64) -> f64 {
        let c1 = c1(epsilon);
        let off = sines(&c1, sigma2.doubled()) - sines(&c1, sigma1.doubled());
        self.ellipsoid.b() * a1(epsilon) * (sigma12 + off)
    }

    /// Newton's method, kept within brackets.
    fn solved(&self, guess: Angle) -> (Angle, Try) {
        let mut alpha1 = guess;
        let (mut low, mut high) = (Angle { sin: TINY, cos: 1.0 }, Angle { sin: TINY, cos: -1.0 });
        let mut found = self.tried(alpha1);
        let (mut is_converging, mut is_closed) = (false, false);
        for step in 0..STEPS {
            let enough = if is_converging { 8.0 * ROUNDING } else { ROUNDING };
            if is_closed || found.off.abs() < enough {
                break;
            }
            // Cotangents fall with the azimuth.
            let cotangent = |alpha: Angle| alpha.cos / alpha.sin;
            if found.off > 0.0 && (step > NEWTON_STEPS || cotangent(alpha1) > cotangent(high)) {
                high = alpha1;
            } else if found.off < 0.0 && (step > NEWTON_STEPS || cotangent(alpha1) < cotangent(low)) {
                low = alpha1;
            }
            let turn = -found.off / found.slope;
            let next = alpha1.plus(Angle::of_radians(turn));
            if step < NEWTON_STEPS && found.slope > 0.0 && turn.abs() < PI && next.sin > 0.0 {
                alpha1 = Angle::towards(next.sin, next.cos);
                is_converging = found.off.abs() <= 16.0 * ROUNDING;
            } else {
                alpha1 = Angle::towards((low.sin + high.sin) / 2.0, (low.cos + high.cos) / 2.0);
                is_converging = false;
                let gap = |a: Angle, b: Angle| (a.sin - b.sin).abs() + (a.cos - b.cos).abs();
                is_closed = gap(low, alpha1) < ROUNDING || gap(alpha1, high) < ROUNDING;
            }
            found = self.tried(alpha1);
        }
        (alpha1, found)
    }

    /// Follows an azimuth to the second latitude.
    fn tried(&self, alpha1: Angle) -> Try {
        let Self { ellipsoid, beta1, beta2, .. } = self;
        // On the equator southward means a bit south of it.
        let cos_alpha1 = if beta1.sin == 0.0 && alpha1.cos == 0.0 { -TINY } else { alpha1.cos };
        let alpha0 = Angle { sin: alpha1.sin * beta1.cos, cos: hypot(cos_alpha1, alpha1.sin * beta1.sin) };
        let alpha2 = self.azimuth_there(alpha0.sin, alpha1.sin, cos_alpha1);
        let place = |alpha_cos: f64, beta: &Angle| {
            let along = alpha_cos * beta.cos;
            (Angle::towards(beta.sin, along), Angle::towards(alpha0.sin * beta.sin, along))
        };
        let (sigma1, omega1) = place(cos_alpha1, beta1);
        let (sigma2, omega2) = place(alpha2.cos, beta2);
        let sigma12 = arc(sigma1, sigma2);
        let omega12 = omega2.minus(omega1);
        let omega12 = Angle { sin: max(omega12.sin, 0.0), cos: omega12.cos };
        let epsilon = epsilon(ellipsoid, alpha0.cos);
        let n = ellipsoid.third_flattening();
        let c3 = c3(n, epsilon);
        let ahead = sines(&c3, sigma2.doubled()) - sines(&c3, sigma1.doubled());
        // Eq. 8; the difference to the longitude that is wanted is taken before it is one of radians.
        let behind = ellipsoid.f * a3(n, epsilon) * alpha0.sin * (sigma12 + ahead);
        let off = omega12.minus(self.lambda).radians() - behind;
        let slope = match alpha2.cos == 0.0 {
            // Eq. 46 where the way is along a parallel at both places.
            true => -2.0 * (1.0 - ellipsoid.f) * self.stretch(beta1) / beta1.sin,
            false => {
                let reduced = self.reduced_length(epsilon, (sigma1, sigma2), sigma12);
                reduced * (1.0 - ellipsoid.f) / (alpha2.cos * beta2.cos)
            }
        };
        Try { alpha2, sigma1, sigma2, sigma12, epsilon, off, slope }
    }

    /// The azimuth at the second latitude, northward (eqs. 5 and 45).
    fn azimuth_there(&self, sin_alpha0: f64, sin_alpha1: f64, cos_alpha1: f64) -> Angle {
        let (beta1, beta2) = (self.beta1, self.beta2);
        if beta2.cos == beta1.cos && beta2.sin.abs() == -beta1.sin {
            return Angle { sin: sin_alpha1, cos: cos_alpha1.abs() };
        }
        // The difference of the squares of whatever is small.
        let more = match beta1.cos < -beta1.sin {
            true => (beta2.cos - beta1.cos) * (beta1.cos + beta2.cos),
            false => (beta1.sin - beta2.sin) * (beta1.sin + beta2.sin),
        };
        let along = cos_alpha1 * beta1.cos;
        let sin = if beta2.cos == beta1.cos { sin_alpha1 } else { sin_alpha0 / beta2.cos };
        Angle { sin, cos: max(0.0, along * along + more).sqrt() / beta2.cos }
    }

    /// sqrt(1 + e'^2 sin^2(beta)).
    fn stretch(&self, beta: &Angle) -> f64 {
        let e2 = self.ellipsoid.e2();
        (1.0 + e2 / (1.0 - e2) * beta.sin * beta.sin).sqrt()
    }

    /// m12 / b (eqs. 38 to 40).
    fn reduced_length(&self, epsilon: f64, (sigma1, sigma2): (Angle, Angle), sigma12: f64) -> f64 {
        let (a1, a2, c1, c2) = (a1(epsilon), a2(epsilon), c1(epsilon), c2(epsilon));
        let off = |c: &[f64; 6]| sines(c, sigma2.doubled()) - sines(c, sigma1.doubled());
        let j12 = (a1 - a2) * sigma12 + (a1 * off(&c1) - a2 * off(&c2));
        let (dn1, dn2) = (self.stretch(&self.beta1), self.stretch(&self.beta2));
        dn2 * sigma1.cos * sigma2.sin - dn1 * sigma1.sin * sigma2.cos - sigma1.cos * sigma2.cos * j12
    }
}

/// The arc from one place to the next one, 0..=pi.
fn arc(sigma1: Angle, sigma2: Angle) -> f64 {
    let between = sigma2.minus(sigma1);
    // A zero becomes the positive one: half a turn is not half a turn back.
    atan2(max(between.sin, 0.0), between.cos)
}
