//! Latitudes and projections that keep areas: Albers' cone and Lambert's azimuthal plane.
//!
//! J. P. Snyder, *Map Projections: A Working Manual*, USGS Professional Paper 1395 (1987), sections 14 and 24; the authalic
//! latitude by the series of C. F. F. Karney, *On auxiliary latitudes*, Survey Review 56 (2024), which keeps its digits at the poles.

use super::conic::parallel_radius;
use super::ellipsoid::Ellipsoid;
use super::fourier::{polynomials, sines};
use super::sphere::{Direction, Pole};
use crate::math::{asin, atan2, atanh, cos, sin};
use glam::DVec2;

/// The latitude on the sphere of the ellipsoid's area.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Authalic {
    /// q at the pole (Snyder, eq. 3-12): the sphere's radius is a sqrt(q / 2).
    polar: f64,
    from_geographic: [f64; 6],
    to_geographic: [f64; 6],
}

impl Authalic {
    fn new(ellipsoid: &Ellipsoid) -> Self {
        let n = ellipsoid.third_flattening();
        Self {
            polar: area_function(ellipsoid, 1.0),
            from_geographic: from_geographic(n),
            to_geographic: to_geographic(n),
        }
    }

    fn of(&self, lat: f64) -> f64 {
        lat + sines(&self.from_geographic, (sin(2.0 * lat), cos(2.0 * lat)))
    }

    fn geographic(&self, beta: f64) -> f64 {
        beta + sines(&self.to_geographic, (sin(2.0 * beta), cos(2.0 * beta)))
    }
}

/// q of the sine of a latitude (Snyder, eq. 3-12): the area of a zone from the equator, in units of pi a^2.
fn area_function(ellipsoid: &Ellipsoid, s: f64) -> f64 {
    let (e, e2) = (ellipsoid.e(), ellipsoid.e2());
    if e == 0.0 {
        return 2.0 * s;
    }
    (1.0 - e2) * (s / (1.0 - e2 * s * s) + atanh(e * s) / e)
}

/// Karney (2024): the Fourier coefficients of the authalic minus the geographic latitude, in the third flattening.
#[rustfmt::skip]
fn from_geographic(n: f64) -> [f64; 6] {
    let rows: [&[f64]; 6] = [
        &[0.0, -4.0 / 3.0, -4.0 / 45.0, 88.0 / 315.0, 538.0 / 4_725.0, 20_824.0 / 467_775.0, -44_732.0 / 2_837_835.0],
        &[0.0, 0.0, 34.0 / 45.0, 8.0 / 105.0, -2_482.0 / 14_175.0, -37_192.0 / 467_775.0, -12_467_764.0 / 212_837_625.0],
        &[0.0, 0.0, 0.0, -1_532.0 / 2_835.0, -898.0 / 14_175.0, 54_968.0 / 467_775.0, 100_320_856.0 / 1_915_538_625.0],
        &[0.0, 0.0, 0.0, 0.0, 6_007.0 / 14_175.0, 24_496.0 / 467_775.0, -5_884_124.0 / 70_945_875.0],
        &[0.0, 0.0, 0.0, 0.0, 0.0, -23_356.0 / 66_825.0, -839_792.0 / 19_348_875.0],
        &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 570_284_222.0 / 1_915_538_625.0],
    ];
    polynomials(rows, n)
}

/// Karney (2024): those of the geographic minus the authalic latitude.
#[rustfmt::skip]
fn to_geographic(n: f64) -> [f64; 6] {
    let rows: [&[f64]; 6] = [
        &[0.0, 4.0 / 3.0, 4.0 / 45.0, -16.0 / 35.0, -2_582.0 / 14_175.0, 60_136.0 / 467_775.0, 28_112_932.0 / 212_837_625.0],
        &[0.0, 0.0, 46.0 / 45.0, 152.0 / 945.0, -11_966.0 / 14_175.0, -21_016.0 / 51_975.0, 251_310_128.0 / 638_512_875.0],
        &[0.0, 0.0, 0.0, 3_044.0 / 2_835.0, 3_802.0 / 14_175.0, -94_388.0 / 66_825.0, -8_797_648.0 / 10_945_935.0],
        &[0.0, 0.0, 0.0, 0.0, 6_059.0 / 4_725.0, 41_072.0 / 93_555.0, -1_472_637_812.0 / 638_512_875.0],
        &[0.0, 0.0, 0.0, 0.0, 0.0, 768_272.0 / 467_775.0, 455_935_736.0 / 638_512_875.0],
        &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 4_210_684_958.0 / 1_915_538_625.0],
    ];
    polynomials(rows, n)
}

/// Lambert's azimuthal equal-area projection, of any aspect (Snyder, eqs. 24-17 to 24-26).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct AzimuthalEqualArea {
    /// Latitude of origin, degrees.
    pub(crate) lat_0: f64,
    authalic: Authalic,
    pole: Pole,
    /// The radius of the sphere of the ellipsoid's area.
    radius: f64,
    /// What makes the scale at the origin that of the ellipsoid in both directions (Snyder's D).
    stretch: f64,
}

impl AzimuthalEqualArea {
    pub(crate) fn new(ellipsoid: Ellipsoid, lat_0: f64) -> Self {
        let authalic = Authalic::new(&ellipsoid);
        let radius = ellipsoid.a * (authalic.polar / 2.0).sqrt();
        let lat = lat_0.to_radians();
        let is_polar = lat_0.abs() > 90.0 - 1e-9;
        let pole = if is_polar { Pole::at_pole(lat_0) } else { Pole::at(authalic.of(lat)) };
        let stretch = match is_polar {
            true => 1.0,
            false => ellipsoid.a * parallel_radius(&ellipsoid, lat) / (radius * pole.cosine),
        };
        Self { lat_0, authalic, pole, radius, stretch }
    }

    /// Longitude from the central meridian and latitude (radians) to metres; `None` where the origin's antipode is.
    pub(crate) fn forward(&self, lam: f64, lat: f64) -> Option<DVec2> {
        let seen = self.pole.seen(&Direction::new(lam, self.authalic.of(lat)));
        let length = (2.0 / (1.0 + seen.towards)).sqrt() * self.radius;
        let p = DVec2::new(seen.east * self.stretch, seen.north / self.stretch) * length;
        (seen.towards > -1.0 + 1e-12).then_some(p)
    }

    /// Metres to longitude from the central meridian and latitude (radians); `None` out of the domain.
    pub(crate) fn inverse(&self, p: DVec2) -> Option<(f64, f64)> {
        let q = DVec2::new(p.x / self.stretch, p.y * self.stretch);
        let distance = q.length();
        let half = distance / (2.0 * self.radius);
        if half.is_nan() || half > 1.0 {
            return None;
        }
        let (lam, beta) = self.pole.direction_of(q, distance, 2.0 * asin(half)).angles();
        Some((lam, self.authalic.geographic(beta)))
    }
}

/// Albers' equal-area conic projection (Snyder, eqs. 14-12 to 14-21).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Albers {
    /// The standard parallels, degrees, the southern one first.
    pub(crate) parallels: [f64; 2],
    /// Latitude of origin, degrees.
    pub(crate) lat_0: f64,
    authalic: Authalic,
    a: f64,
    cone: f64,
    /// Snyder's C.
    constant: f64,
    origin_radius: f64,
}

impl Albers {
    /// `None` for a cone that is a cylinder (opposite parallels).
    pub(crate) fn new(ellipsoid: Ellipsoid, parallels: [f64; 2], lat_0: f64) -> Option<Self> {
        let [first, second] = parallels.map(f64::to_radians);
        let square = |lat: f64| parallel_radius(&ellipsoid, lat) * parallel_radius(&ellipsoid, lat);
        let q = |lat: f64| area_function(&ellipsoid, sin(lat));
        let cone = match (first - second).abs() < 1e-10 {
            true => sin(first),
            false => (square(first) - square(second)) / (q(second) - q(first)),
        };
        let mut made = Self {
            parallels: if parallels[0] <= parallels[1] { parallels } else { [parallels[1], parallels[0]] },
            lat_0,
            authalic: Authalic::new(&ellipsoid),
            a: ellipsoid.a,
            cone,
            constant: square(first) + cone * q(first),
            origin_radius: 0.0,
        };
        made.origin_radius = made.radius(lat_0.to_radians())?;
        (cone.abs() > 1e-10).then_some(made)
    }

    fn radius(&self, lat: f64) -> Option<f64> {
        let square = self.constant - self.cone * self.authalic.polar * sin(self.authalic.of(lat));
        // The nearer pole of a cone with a standard parallel there rounds to either side of 0.
        let square = if square.abs() < 1e-14 { 0.0 } else { square };
        (square >= 0.0).then(|| self.a * square.sqrt() / self.cone)
    }

    /// Longitude from the central meridian and latitude (radians) to metres.
    pub(crate) fn forward(&self, lam: f64, lat: f64) -> Option<DVec2> {
        let r = self.radius(lat)?;
        let theta = self.cone * lam;
        Some(DVec2::new(r * sin(theta), self.origin_radius - r * cos(theta)))
    }

    /// Metres to longitude from the central meridian and latitude (radians); `None` out of the domain.
    pub(crate) fn inverse(&self, p: DVec2) -> Option<(f64, f64)> {
        let sign = if self.cone < 0.0 { -1.0 } else { 1.0 };
        let (x, y) = (sign * p.x, sign * (self.origin_radius - p.y));
        let by = self.cone / self.a;
        let sine = (self.constant - (x * x + y * y) * by * by) / (self.cone * self.authalic.polar);
        let lam = atan2(x, y) / self.cone;
        if !(sine.abs() <= 1.0 + 1e-12 && lam.abs() <= std::f64::consts::PI + 1e-9) {
            return None;
        }
        let beta = if sine.abs() < 1.0 { asin(sine) } else { std::f64::consts::FRAC_PI_2.copysign(sine) };
        Some((lam, self.authalic.geographic(beta)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_series_is_the_area() {
        for rf in [298.257_222_101, 293.465, 0.0] {
            let ellipsoid = Ellipsoid::from_inverse_flattening(6.4e6, rf);
            let authalic = Authalic::new(&ellipsoid);
            for k in -88..=88 {
                let lat = f64::from(k).to_radians();
                let exact = area_function(&ellipsoid, sin(lat)) / authalic.polar;
                let beta = authalic.of(lat);
                assert!((sin(beta) - exact).abs() < 3e-16, "{k}: {} {exact}", sin(beta));
                assert!((authalic.geographic(beta) - lat).abs() < 4e-16, "{k}");
            }
        }
    }
}
