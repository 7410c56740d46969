//! Ellipsoids of revolution as reference systems name them, and their conformal latitude.

use super::fourier::polynomial;
use crate::math::{asinh, atan, atanh, exp, sinh, tan};
pub(crate) use crate::space::Ellipsoid;

impl Ellipsoid {
    pub(crate) const WGS84: Self = Self { a: 6_378_137.0, f: 1.0 / 298.257_223_563 };

    /// From the equatorial radius and the inverse flattening; 0 means a sphere.
    pub(crate) fn from_inverse_flattening(a: f64, rf: f64) -> Self {
        Self { a, f: if rf == 0.0 { 0.0 } else { 1.0 / rf } }
    }

    /// The first eccentricity.
    pub(crate) fn e(&self) -> f64 {
        self.e2().sqrt()
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
    fn conformal_latitude_and_back_is_the_same_latitude() {
        for lat in [-90.0, -89.999, -60.0, -1e-9, 0.0, 1e-3, 45.0, 89.9999] {
            let taup = Ellipsoid::WGS84.conformal_tan(f64::to_radians(lat));
            let back = Ellipsoid::WGS84.latitude_of_conformal_tan(taup).to_degrees();
            assert!((back - lat).abs() < 1e-13, "{lat} became {back}");
        }
    }
}
