//! Stereographic projections: of a pole, and the double one of any place.
//!
//! J. P. Snyder, *Map Projections: A Working Manual*, USGS Professional Paper 1395 (1987), eqs. 21-33 to 21-40; *Coordinate
//! Conversions and Transformations including Formulas*, IOGP publication 373-7-2, methods 9809 (double), 9810, 9829.

use super::conic::parallel_radius;
use super::ellipsoid::Ellipsoid;
use super::gauss::GaussSphere;
use super::sphere::Pole;
use crate::math::{atan2, atanh, cos, exp, sin};
use glam::DVec2;

/// The stereographic projection of a pole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PolarStereographic {
    /// The latitude of true scale, degrees; its sign tells the pole.
    pub(crate) lat_ts: f64,
    /// A further scale factor.
    pub(crate) k_0: f64,
    ellipsoid: Ellipsoid,
    /// Metres where the tangent of half the conformal colatitude is 1.
    scale: f64,
}

impl PolarStereographic {
    pub(crate) fn new(ellipsoid: Ellipsoid, lat_ts: f64, k_0: f64) -> Self {
        let true_scale = lat_ts.abs().to_radians();
        let e = ellipsoid.e();
        let by = match 90.0 - lat_ts.abs() < 1e-9 {
            // Snyder, eq. 21-33: its root is sqrt(1 - e2) exp(e atanh e).
            true => 2.0 / ((1.0 - ellipsoid.e2()).sqrt() * exp(e * atanh(e))),
            false => {
                parallel_radius(&ellipsoid, true_scale) / half_tangent(ellipsoid.conformal_tan(true_scale))
            }
        };
        Self { lat_ts, k_0, ellipsoid, scale: ellipsoid.a * k_0 * by }
    }

    fn sign(&self) -> f64 {
        1.0_f64.copysign(self.lat_ts)
    }

    /// Longitude from the central meridian and latitude (radians) to metres; `None` at the other pole.
    pub(crate) fn forward(&self, lam: f64, lat: f64) -> Option<DVec2> {
        let sign = self.sign();
        let r = self.scale * half_tangent(self.ellipsoid.conformal_tan(sign * lat));
        (r < 1e10).then(|| DVec2::new(r * sin(lam), -sign * r * cos(lam)))
    }

    /// Metres to longitude from the central meridian and latitude (radians); `None` out of the domain.
    pub(crate) fn inverse(&self, p: DVec2) -> Option<(f64, f64)> {
        let sign = self.sign();
        let t = p.length() / self.scale;
        if t.is_nan() || t > 1e6 {
            return None;
        }
        let lam = if t == 0.0 { 0.0 } else { atan2(p.x, -sign * p.y) };
        let lat = match t < 1e-15 {
            true => std::f64::consts::FRAC_PI_2,
            false => self.ellipsoid.latitude_of_conformal_tan(0.5 * (1.0 / t - t)),
        };
        Some((lam, sign * lat))
    }
}

/// The tangent of half the colatitude of a latitude's tangent.
fn half_tangent(tan: f64) -> f64 {
    let secant = (1.0 + tan * tan).sqrt();
    if tan > 0.0 { 1.0 / (secant + tan) } else { secant - tan }
}

/// The double stereographic projection: by way of Gauss's sphere (method 9809).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ObliqueStereographic {
    /// Latitude of origin, degrees.
    pub(crate) lat_0: f64,
    /// Scale at the origin.
    pub(crate) k_0: f64,
    sphere: GaussSphere,
    pole: Pole,
    /// Twice the sphere's radius, scaled.
    diameter: f64,
}

impl ObliqueStereographic {
    pub(crate) fn new(ellipsoid: Ellipsoid, lat_0: f64, k_0: f64) -> Option<Self> {
        let sphere = GaussSphere::of_stereographic(ellipsoid, lat_0.to_radians())?;
        let pole = Pole::at(sphere.latitude(lat_0.to_radians()));
        Some(Self { lat_0, k_0, sphere, pole, diameter: 2.0 * sphere.radius * k_0 })
    }

    /// Longitude from the central meridian and latitude (radians) to metres; `None` at the origin's antipode.
    pub(crate) fn forward(&self, lam: f64, lat: f64) -> Option<DVec2> {
        let seen = self.pole.seen(&self.sphere.direction(lam, lat)?);
        let p = DVec2::new(seen.east, seen.north) * (self.diameter / (1.0 + seen.towards));
        (seen.towards > -1.0 + 1e-12).then_some(p)
    }

    /// Metres to longitude from the central meridian and latitude (radians); `None` out of the domain.
    pub(crate) fn inverse(&self, p: DVec2) -> Option<(f64, f64)> {
        let distance = p.length();
        let angle = 2.0 * atan2(distance, self.diameter);
        self.sphere.geographic(&self.pole.direction_of(p, distance, angle))
    }
}
