//! Rhumb lines: ways of constant bearing between places of an ellipsoid, straight on Mercator's map.
//!
//! Along one, longitude is proportional to the isometric latitude, length to the rectifying latitude: C. F. F. Karney, *The area of
//! rhumb polygons*, Stud. Geophys. Geod. 68 (2024), section 2. Differences of both latitudes are computed as such, so that a course
//! nearly along a parallel is as exact as any.

use super::ellipsoid::Ellipsoid;
use super::fourier::polynomials;
use crate::math::{asinh, atanh, cos, hypot, sin};

/// The rhumb line between two places, neither of them a pole.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Rhumb {
    ellipsoid: Ellipsoid,
    /// In metres.
    length: f64,
    /// Of the first place: latitude in degrees, and rectifying latitude.
    from: f64,
    mu1: f64,
    /// By how much the rectifying latitude grows, the isometric latitude, and the longitude in degrees.
    mu12: f64,
    psi12: f64,
    east: f64,
    from_rectifying: [f64; 6],
}

impl Rhumb {
    /// Between two latitudes in degrees, the second one's place so many degrees to the east.
    pub(super) fn between(ellipsoid: &Ellipsoid, from: f64, to: f64, east: f64) -> Self {
        let n = ellipsoid.third_flattening();
        let phi1 = from.to_radians();
        let phi12 = (to - from).to_radians();
        let from_geographic = from_geographic(n);
        let mu12 = phi12 + difference(&from_geographic, phi1, phi12);
        let psi12 = isometric_difference(ellipsoid, from, to, phi12);
        let radius = ellipsoid.rectifying_radius();
        // How many metres a radian of longitude is long, over the way: d mu / d psi is the parallel's radius.
        let parallel = match psi12 == 0.0 {
            true => ellipsoid.prime_vertical(phi1) * cos(phi1),
            false => radius * (mu12 / psi12),
        };
        Self {
            ellipsoid: *ellipsoid,
            length: hypot(parallel * east.to_radians(), radius * mu12),
            from,
            mu1: phi1 + difference(&from_geographic, 0.0, phi1),
            mu12,
            psi12,
            east,
            from_rectifying: to_geographic(n),
        }
    }

    /// Its length in metres.
    pub(super) fn length(&self) -> f64 {
        self.length
    }

    /// The point after a share of its length: degrees east of the first place, and the latitude.
    pub(super) fn at(&self, share: f64) -> (f64, f64) {
        let mu = share * self.mu12;
        let phi = mu + difference(&self.from_rectifying, self.mu1, mu);
        let latitude = self.from + phi.to_degrees();
        let psi = isometric_difference(&self.ellipsoid, self.from, latitude, phi);
        let there = if self.psi12 == 0.0 { share } else { psi / self.psi12 };
        (there * self.east, latitude)
    }
}

/// By how much the isometric latitude, asinh(tan(phi)) - e atanh(e sin(phi)), grows between two latitudes in degrees, `by` radians apart: both
/// differences are brought under one function each, which leaves nothing to cancel.
fn isometric_difference(ellipsoid: &Ellipsoid, from: f64, to: f64, by: f64) -> f64 {
    let (e, e2) = (ellipsoid.e(), ellipsoid.e2());
    // As distances from the pole, whose sines keep their digits.
    let cosine = |degrees: f64| sin((90.0 - degrees.abs()).to_radians());
    // Of the difference of the sines.
    let half = cosine(0.5 * (from + to)) * sin(0.5 * by);
    let sphere = asinh(2.0 * half / (cosine(from) * cosine(to)));
    let sines = sin(from.to_radians()) * sin(to.to_radians());
    sphere - e * atanh(2.0 * e * half / (1.0 - e2 * sines))
}

/// By how much the sum of `c[j] sin(2 (j + 1) x)` grows from x on.
fn difference(c: &[f64; 6], x: f64, by: f64) -> f64 {
    let grown = |(j, c): (usize, &f64)| {
        let multiple = (j + 1) as f64;
        2.0 * c * cos(multiple * (2.0 * x + by)) * sin(multiple * by)
    };
    c.iter().enumerate().rev().map(grown).sum()
}

/// The Fourier coefficients of the rectifying minus the geographic latitude in the third flattening: C. F. F. Karney, *On auxiliary
/// latitudes*, Survey Review 56 (2024).
#[rustfmt::skip]
fn from_geographic(n: f64) -> [f64; 6] {
    let rows: [&[f64]; 6] = [
        &[0.0, -3.0 / 2.0, 0.0, 9.0 / 16.0, 0.0, -3.0 / 32.0],
        &[0.0, 0.0, 15.0 / 16.0, 0.0, -15.0 / 32.0, 0.0, 135.0 / 2048.0],
        &[0.0, 0.0, 0.0, -35.0 / 48.0, 0.0, 105.0 / 256.0],
        &[0.0, 0.0, 0.0, 0.0, 315.0 / 512.0, 0.0, -189.0 / 512.0],
        &[0.0, 0.0, 0.0, 0.0, 0.0, -693.0 / 1280.0],
        &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1001.0 / 2048.0],
    ];
    polynomials(rows, n)
}

/// Those of the geographic minus the rectifying latitude.
#[rustfmt::skip]
fn to_geographic(n: f64) -> [f64; 6] {
    let rows: [&[f64]; 6] = [
        &[0.0, 3.0 / 2.0, 0.0, -27.0 / 32.0, 0.0, 269.0 / 512.0],
        &[0.0, 0.0, 21.0 / 16.0, 0.0, -55.0 / 32.0, 0.0, 6759.0 / 4096.0],
        &[0.0, 0.0, 0.0, 151.0 / 96.0, 0.0, -417.0 / 128.0],
        &[0.0, 0.0, 0.0, 0.0, 1097.0 / 512.0, 0.0, -15543.0 / 2560.0],
        &[0.0, 0.0, 0.0, 0.0, 0.0, 8011.0 / 2560.0],
        &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 293_393.0 / 61_440.0],
    ];
    polynomials(rows, n)
}

#[cfg(test)]
mod tests;
