//! Ellipsoids of revolution: radii of curvature, geocentric coordinates, conformal latitude.

use super::fourier::polynomial;
use crate::math::{asinh, atan, atan2, atanh, cos, exp, sin, sinh, tan};
use glam::DVec3;

/// An ellipsoid of revolution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Ellipsoid {
    /// Equatorial radius in metres.
    pub(crate) a: f64,
    /// Flattening.
    pub(crate) f: f64,
}

impl Ellipsoid {
    pub(crate) const WGS84: Self = Self { a: 6_378_137.0, f: 1.0 / 298.257_223_563 };

    /// From the equatorial radius and the inverse flattening; 0 means a sphere.
    pub(crate) fn from_inverse_flattening(a: f64, rf: f64) -> Self {
        Self { a, f: if rf == 0.0 { 0.0 } else { 1.0 / rf } }
    }

    /// The first eccentricity squared.
    pub(crate) fn e2(&self) -> f64 {
        self.f * (2.0 - self.f)
    }

    /// The first eccentricity.
    pub(crate) fn e(&self) -> f64 {
        self.e2().sqrt()
    }

    /// The polar radius.
    pub(crate) fn b(&self) -> f64 {
        self.a * (1.0 - self.f)
    }

    /// The third flattening, n = (a - b) / (a + b).
    pub(crate) fn third_flattening(&self) -> f64 {
        self.f / (2.0 - self.f)
    }

    /// The radius of the circle as long as a meridian: Karney (2011), eq. 14.
    pub(crate) fn rectifying_radius(&self) -> f64 {
        let n = self.third_flattening();
        self.a / (1.0 + n) * polynomial(&[1.0, 1.0 / 4.0, 1.0 / 64.0, 1.0 / 256.0], n * n)
    }

    /// Whether two ellipsoids agree to a millimetre in both radii.
    pub(crate) fn agrees_with(&self, other: &Self) -> bool {
        (self.a - other.a).abs() < 1e-3 && (self.b() - other.b()).abs() < 1e-3
    }

    /// The radius of curvature in the prime vertical, N.
    pub(crate) fn prime_vertical(&self, lat: f64) -> f64 {
        let s = sin(lat);
        self.a / (1.0 - self.e2() * s * s).sqrt()
    }

    /// The radius of curvature in the meridian, M.
    pub(crate) fn meridian(&self, lat: f64) -> f64 {
        let s = sin(lat);
        let w2 = 1.0 - self.e2() * s * s;
        self.a * (1.0 - self.e2()) / (w2 * w2.sqrt())
    }

    /// Geographic (radians) to geocentric (metres), at height 0.
    pub(crate) fn geocentric(&self, lon: f64, lat: f64) -> DVec3 {
        let n = self.prime_vertical(lat);
        let r = n * cos(lat);
        DVec3::new(r * cos(lon), r * sin(lon), n * (1.0 - self.e2()) * sin(lat))
    }

    /// Geocentric (metres) to geographic (radians); the height is dropped.
    ///
    /// Bowring's formula (1976), iterated on the parametric latitude: each round gains some five digits near the
    /// surface, so three give all of them.
    pub(crate) fn geographic(&self, p: DVec3) -> (f64, f64) {
        let r = (p.x * p.x + p.y * p.y).sqrt();
        let second_e2 = self.e2() / (1.0 - self.e2());
        let mut beta = atan2(p.z * self.a, r * self.b());
        let mut lat = beta;
        for _ in 0..3 {
            let (s, c) = (sin(beta), cos(beta));
            lat = atan2(p.z + second_e2 * self.b() * s * s * s, r - self.e2() * self.a * c * c * c);
            beta = atan2((1.0 - self.f) * sin(lat), cos(lat));
        }
        (atan2(p.y, p.x), lat)
    }

    /// The tangent of the conformal latitude of a geographic latitude: Karney (2011), eqs. 7 to 9.
    pub(crate) fn conformal_tan(&self, lat: f64) -> f64 {
        self.conformal_from_tan(tan(lat))
    }

    fn conformal_from_tan(&self, tau: f64) -> f64 {
        let e = self.e();
        let secant = (1.0 + tau * tau).sqrt();
        let sigma = sinh(e * atanh(e * tau / secant));
        (1.0 + sigma * sigma).sqrt() * tau - sigma * secant
    }

    /// The isometric latitude (the northing of the Mercator projection on radius 1).
    pub(crate) fn isometric(&self, lat: f64) -> f64 {
        asinh(self.conformal_tan(lat))
    }

    /// The geographic latitude of a conformal latitude's tangent: Newton's method, Karney (2011), eqs. 19 to 21.
    pub(crate) fn latitude_of_conformal_tan(&self, taup: f64) -> f64 {
        let (e, e2m) = (self.e(), 1.0 - self.e2());
        let mut tau = if taup.abs() > 70.0 { taup * exp(e * atanh(e)) } else { taup / e2m };
        for _ in 0..6 {
            let here = self.conformal_from_tan(tau);
            let step = (taup - here) / (1.0 + here * here).sqrt() * (1.0 + e2m * tau * tau)
                / (e2m * (1.0 + tau * tau).sqrt());
            tau += step;
            if step.abs() <= 1e-10 * (1.0 + tau.abs()) {
                break;
            }
        }
        atan(tau)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn geocentric_coordinates_agree_with_proj() {
        // reference: PROJ 9, +proj=cart +ellps=WGS84 of (7.5, 46.9, 0)
        let p = Ellipsoid::WGS84.geocentric(7.5_f64.to_radians(), 46.9_f64.to_radians());
        let at_500_m = DVec3::new(4_328_800.129_357_4, 569_897.348_586_543_4, 4_634_541.012_035_782);
        let up = DVec3::new(
            cos(46.9_f64.to_radians()) * cos(7.5_f64.to_radians()),
            cos(46.9_f64.to_radians()) * sin(7.5_f64.to_radians()),
            sin(46.9_f64.to_radians()),
        );
        assert!((p + up * 500.0 - at_500_m).length() < 1e-6);
    }

    #[test]
    fn geocentric_and_back_is_the_same_place() {
        for (lon, lat) in [(0.0, 0.0), (120.0, 89.0), (-179.9, -45.0), (10.0, -89.999)] {
            let p = Ellipsoid::WGS84.geocentric(f64::to_radians(lon), f64::to_radians(lat));
            let (back_lon, back_lat) = Ellipsoid::WGS84.geographic(p);
            assert!((back_lon.to_degrees() - lon).abs() < 1e-12);
            assert!((back_lat.to_degrees() - lat).abs() < 1e-12);
        }
    }

    #[test]
    fn conformal_latitude_and_back_is_the_same_latitude() {
        for lat in [-90.0, -89.999, -60.0, -1e-9, 0.0, 1e-3, 45.0, 89.9999] {
            let taup = Ellipsoid::WGS84.conformal_tan(f64::to_radians(lat));
            let back = Ellipsoid::WGS84.latitude_of_conformal_tan(taup).to_degrees();
            assert!((back - lat).abs() < 1e-13, "{lat} became {back}");
        }
    }
}
