//! Where one is on a geodesic after a share of the way: the direct problem, Karney (2013), section 3.

use super::angle::Angle;
use super::inverse::{Found, inverse};
use super::series::{a1, a3, c1, c1_inverse, c3};
use super::triangle::{self, reduced};
use crate::crs::ellipsoid::Ellipsoid;
use crate::crs::fourier::sines;
use crate::math::{atan2, hypot};

/// The geodesic between two places.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::crs) struct Geodesic {
    /// In metres.
    length: f64,
    flattening: f64,
    /// The azimuth where it crosses the equator northward.
    alpha0: Angle,
    /// The arc and the longitude on the auxiliary sphere from there to the first place.
    sigma1: Angle,
    omega1: Angle,
    /// Metres in a radian of tau (eq. 20).
    scale: f64,
    c1_inverse: [f64; 6],
    c3: [f64; 6],
    /// What the sum at the first place is, of the distance and of the longitude (eqs. 7 and 8).
    distance1: f64,
    longitude1: f64,
    /// A3 f sin(alpha0) (eq. 8).
    a3: f64,
}

impl Geodesic {
    /// Between two latitudes, the second one's place so many degrees to the east (-180..=180).
    pub(in crate::crs) fn between(ellipsoid: &Ellipsoid, from: f64, to: f64, east: f64) -> Self {
        let Found { length, azimuth } = inverse(ellipsoid, from, to, east);
        let beta1 = reduced(ellipsoid, from);
        let alpha0 = {
            let (sin, cos) = (azimuth.sin * beta1.cos, hypot(azimuth.cos, azimuth.sin * beta1.sin));
            Angle { sin, cos }
        };
        let (up, along) = (beta1.sin, beta1.cos * azimuth.cos);
        // On the equator, and along it, both are 0 (eqs. 11 and 12).
        let along = if up == 0.0 && along == 0.0 { 1.0 } else { along };
        let sigma1 = Angle::towards(up, along);
        let epsilon = triangle::epsilon(ellipsoid, alpha0.cos);
        let n = ellipsoid.third_flattening();
        let c3 = c3(n, epsilon);
        Self {
            length,
            flattening: ellipsoid.f,
            alpha0,
            sigma1,
            omega1: Angle { sin: alpha0.sin * up, cos: along },
            scale: ellipsoid.b() * a1(epsilon),
            c1_inverse: c1_inverse(epsilon),
            distance1: sines(&c1(epsilon), sigma1.doubled()),
            longitude1: sines(&c3, sigma1.doubled()),
            c3,
            a3: a3(n, epsilon) * ellipsoid.f * alpha0.sin,
        }
    }

    /// Its length in metres.
    pub(in crate::crs) fn length(&self) -> f64 {
        self.length
    }

    /// The point after a share of its length: degrees east of the first place, and the latitude.
    pub(in crate::crs) fn at(&self, share: f64) -> (f64, f64) {
        let tau12 = share * self.length / self.scale;
        let tau = self.sigma1.plus(Angle::of_radians(self.distance1)).plus(Angle::of_radians(tau12));
        let sigma12 = tau12 + self.distance1 + sines(&self.c1_inverse, tau.doubled());
        let sigma = self.sigma1.plus(Angle::of_radians(sigma12));
        // Fig. 1 and eqs. 13 to 15: the triangle of the auxiliary sphere.
        let (up, along) = (self.alpha0.cos * sigma.sin, self.alpha0.cos * sigma.cos);
        let beta = (up, hypot(self.alpha0.sin, along));
        let omega = Angle { sin: self.alpha0.sin * sigma.sin, cos: sigma.cos };
        // Both in turns that follow the arc, however far it leads.
        let eastward = 1_f64.copysign(self.alpha0.sin);
        let turned = |omega: Angle| Angle { sin: eastward * omega.sin, cos: omega.cos }.radians();
        let ahead = turned(omega) - sigma.radians() - (turned(self.omega1) - self.sigma1.radians());
        let omega12 = eastward * (sigma12 + ahead);
        let longitude = sines(&self.c3, sigma.doubled()) - self.longitude1;
        let east = omega12 - self.a3 * (sigma12 + longitude);
        let latitude = atan2(beta.0, (1.0 - self.flattening) * beta.1);
        (east.to_degrees(), latitude.to_degrees())
    }
}
