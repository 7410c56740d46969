//! Transverse Mercator by Krüger's series in the third flattening, to the sixth order.
//!
//! C. F. F. Karney, *Transverse Mercator with an accuracy of a few nanometers*, J. Geodesy 85 (2011): eqs. 35
//! (forward coefficients) and 36 (inverse coefficients). Within 35 degrees of the central meridian the series is
//! good to 5 nm.

use super::ellipsoid::Ellipsoid;
use super::fourier::polynomial;
use crate::math::{asinh, atan2, cos, cosh, sin, sinh};
use glam::DVec2;

/// Beyond this transverse isometric latitude (about 83 degrees off the central meridian on the equator) the series
/// no longer converges usefully; PROJ refuses at the same place.
const LARGEST_ETA: f64 = 2.623_395_162_778;

/// A transverse Mercator projection; false easting and northing are added by the caller.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TransverseMercator {
    /// Latitude of origin, degrees.
    pub(crate) lat_0: f64,
    /// Scale on the central meridian.
    pub(crate) k_0: f64,
    ellipsoid: Ellipsoid,
    radius: f64,
    origin_northing: f64,
    alpha: [f64; 6],
    beta: [f64; 6],
}

impl TransverseMercator {
    pub(crate) fn new(ellipsoid: Ellipsoid, lat_0: f64, k_0: f64) -> Self {
        let n = ellipsoid.third_flattening();
        let mut made = Self {
            lat_0,
            k_0,
            ellipsoid,
            radius: k_0 * ellipsoid.rectifying_radius(),
            origin_northing: 0.0,
            alpha: alpha(n),
            beta: beta(n),
        };
        made.origin_northing = made.series_northing(lat_0.to_radians());
        made
    }

    fn series_northing(&self, lat: f64) -> f64 {
        let xi = atan2(self.ellipsoid.conformal_tan(lat), 1.0);
        self.radius * (xi + sine_series(&self.alpha, DVec2::new(xi, 0.0)).x)
    }

    /// Longitude from the central meridian and latitude (radians) to metres; `None` out of the domain.
    pub(crate) fn forward(&self, lam: f64, lat: f64) -> Option<DVec2> {
        let taup = self.ellipsoid.conformal_tan(lat);
        let (s, c) = (sin(lam), cos(lam));
        let sphere = DVec2::new(atan2(taup, c), asinh(s / (taup * taup + c * c).sqrt()));
        if sphere.y.is_nan() || sphere.y.abs() > LARGEST_ETA {
            return None;
        }
        let z = sphere + sine_series(&self.alpha, sphere);
        Some(DVec2::new(self.radius * z.y, self.radius * z.x - self.origin_northing))
    }

    /// Metres to longitude from the central meridian and latitude (radians); `None` out of the domain.
    pub(crate) fn inverse(&self, p: DVec2) -> Option<(f64, f64)> {
        let z = DVec2::new((p.y + self.origin_northing) / self.radius, p.x / self.radius);
        if !(z.y.abs() <= LARGEST_ETA && z.x.abs() <= std::f64::consts::PI) {
            return None;
        }
        let sphere = z - sine_series(&self.beta, z);
        let (s, c) = (sinh(sphere.y), cos(sphere.x));
        let taup = sin(sphere.x) / (s * s + c * c).sqrt();
        Some((atan2(s, c), self.ellipsoid.latitude_of_conformal_tan(taup)))
    }
}

/// The sum of `a[j] sin(2 (j + 1) z)` over complex `z = x + i y`, by Clenshaw's recurrence.
fn sine_series(a: &[f64; 6], z: DVec2) -> DVec2 {
    let (s, c) = (sin(2.0 * z.x), cos(2.0 * z.x));
    let (sh, ch) = (sinh(2.0 * z.y), cosh(2.0 * z.y));
    let twice_cosine = DVec2::new(2.0 * c * ch, -2.0 * s * sh);
    let (mut next, mut after) = (DVec2::ZERO, DVec2::ZERO);
    for &coefficient in a.iter().rev() {
        let here = DVec2::new(coefficient, 0.0) + complex_product(twice_cosine, next) - after;
        (next, after) = (here, next);
    }
    complex_product(next, DVec2::new(s * ch, c * sh))
}

fn complex_product(a: DVec2, b: DVec2) -> DVec2 {
    DVec2::new(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x)
}

/// Karney (2011), eq. 35.
#[rustfmt::skip]
fn alpha(n: f64) -> [f64; 6] {
    let row = |c: &[f64]| polynomial(c, n);
    [
        row(&[0.0, 1.0 / 2.0, -2.0 / 3.0, 5.0 / 16.0, 41.0 / 180.0, -127.0 / 288.0, 7_891.0 / 37_800.0]),
        row(&[0.0, 0.0, 13.0 / 48.0, -3.0 / 5.0, 557.0 / 1_440.0, 281.0 / 630.0, -1_983_433.0 / 1_935_360.0]),
        row(&[0.0, 0.0, 0.0, 61.0 / 240.0, -103.0 / 140.0, 15_061.0 / 26_880.0, 167_603.0 / 181_440.0]),
        row(&[0.0, 0.0, 0.0, 0.0, 49_561.0 / 161_280.0, -179.0 / 168.0, 6_601_661.0 / 7_257_600.0]),
        row(&[0.0, 0.0, 0.0, 0.0, 0.0, 34_729.0 / 80_640.0, -3_418_889.0 / 1_995_840.0]),
        row(&[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 212_378_941.0 / 319_334_400.0]),
    ]
}

/// Karney (2011), eq. 36.
#[rustfmt::skip]
fn beta(n: f64) -> [f64; 6] {
    let row = |c: &[f64]| polynomial(c, n);
    [
        row(&[0.0, 1.0 / 2.0, -2.0 / 3.0, 37.0 / 96.0, -1.0 / 360.0, -81.0 / 512.0, 96_199.0 / 604_800.0]),
        row(&[0.0, 0.0, 1.0 / 48.0, 1.0 / 15.0, -437.0 / 1_440.0, 46.0 / 105.0, -1_118_711.0 / 3_870_720.0]),
        row(&[0.0, 0.0, 0.0, 17.0 / 480.0, -37.0 / 840.0, -209.0 / 4_480.0, 5_569.0 / 90_720.0]),
        row(&[0.0, 0.0, 0.0, 0.0, 4_397.0 / 161_280.0, -11.0 / 504.0, -830_251.0 / 7_257_600.0]),
        row(&[0.0, 0.0, 0.0, 0.0, 0.0, 4_583.0 / 161_280.0, -108_847.0 / 3_991_680.0]),
        row(&[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 20_648_693.0 / 638_668_800.0]),
    ]
}
