//! The conformal projections with straight meridians: Lambert's cone and Mercator's cylinder.
//!
//! J. P. Snyder, *Map Projections: A Working Manual*, USGS Professional Paper 1395 (1987), eqs. 15-1 to 15-11 and 7-6
//! to 7-9, written with the isometric latitude.

use super::ellipsoid::Ellipsoid;
use crate::math::{atan2, cos, exp, ln, sin, sinh};
use glam::DVec2;

/// Lambert's conformal conic projection with one or two standard parallels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Lambert {
    /// The standard parallels, degrees, the southern one first.
    pub(crate) parallels: [f64; 2],
    /// Latitude of origin, degrees.
    pub(crate) lat_0: f64,
    /// A further scale factor (1 with two parallels).
    pub(crate) k_0: f64,
    ellipsoid: Ellipsoid,
    cone: f64,
    scale: f64,
    origin_radius: f64,
}

impl Lambert {
    /// `None` for a cone that is a plane or a cylinder (a pole or opposite parallels).
    pub(crate) fn new(ellipsoid: Ellipsoid, parallels: [f64; 2], lat_0: f64, k_0: f64) -> Option<Self> {
        let [first, second] = parallels.map(f64::to_radians);
        let cone = cone_constant(&ellipsoid, first, second);
        if !(cone.abs() > 1e-10 && first.abs() < 1.57 && second.abs() < 1.57) {
            return None;
        }
        let scale =
            ellipsoid.a * k_0 * parallel_radius(&ellipsoid, first) * exp(cone * ellipsoid.isometric(first))
                / cone;
        let mut made = Self {
            parallels: if parallels[0] <= parallels[1] { parallels } else { [parallels[1], parallels[0]] },
            lat_0,
            k_0,
            ellipsoid,
            cone,
            scale,
            origin_radius: 0.0,
        };
        made.origin_radius = made.radius(lat_0.to_radians());
        made.origin_radius.is_finite().then_some(made)
    }

    fn radius(&self, lat: f64) -> f64 {
        self.scale * exp(-self.cone * self.ellipsoid.isometric(lat))
    }

    /// Longitude from the central meridian and latitude (radians) to metres; `None` at the open end of the cone.
    pub(crate) fn forward(&self, lam: f64, lat: f64) -> Option<DVec2> {
        let r = self.radius(lat);
        let theta = self.cone * lam;
        let p = DVec2::new(r * sin(theta), self.origin_radius - r * cos(theta));
        (r.abs() < 1e10).then_some(p)
    }

    /// Metres to longitude from the central meridian and latitude (radians); `None` out of the domain.
    pub(crate) fn inverse(&self, p: DVec2) -> Option<(f64, f64)> {
        let sign = if self.cone < 0.0 { -1.0 } else { 1.0 };
        let (x, y) = (sign * p.x, sign * (self.origin_radius - p.y));
        let r = (x * x + y * y).sqrt();
        let lam = atan2(x, y) / self.cone;
        if !(r > 0.0 && r < 1e10 && lam.abs() <= std::f64::consts::PI + 1e-9) {
            return None;
        }
        let isometric = -ln(sign * r / self.scale) / self.cone;
        Some((lam, self.ellipsoid.latitude_of_conformal_tan(sinh(isometric))))
    }
}

/// The sine of the cone's latitude: Snyder, eq. 15-8, or its limit for one parallel.
fn cone_constant(ellipsoid: &Ellipsoid, first: f64, second: f64) -> f64 {
    if (first - second).abs() < 1e-10 {
        return sin(first);
    }
    let radii = ln(parallel_radius(ellipsoid, first)) - ln(parallel_radius(ellipsoid, second));
    radii / (ellipsoid.isometric(second) - ellipsoid.isometric(first))
}

/// The radius of a parallel on an ellipsoid of radius 1: Snyder, eq. 14-15.
pub(crate) fn parallel_radius(ellipsoid: &Ellipsoid, lat: f64) -> f64 {
    let s = sin(lat);
    cos(lat) / (1.0 - ellipsoid.e2() * s * s).sqrt()
}

/// Mercator's projection; on a sphere, with longitudes and latitudes of WGS 84, it is Web Mercator.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Mercator {
    /// Scale on the equator.
    pub(crate) k_0: f64,
    /// A sphere for Web Mercator.
    pub(crate) ellipsoid: Ellipsoid,
}

impl Mercator {
    pub(crate) fn new(ellipsoid: Ellipsoid, k_0: f64) -> Self {
        Self { k_0, ellipsoid }
    }

    /// Longitude from the central meridian and latitude (radians) to metres; `None` at a pole.
    pub(crate) fn forward(&self, lam: f64, lat: f64) -> Option<DVec2> {
        let radius = self.ellipsoid.a * self.k_0;
        (lat.abs() < std::f64::consts::FRAC_PI_2 - 1e-9)
            .then(|| DVec2::new(radius * lam, radius * self.ellipsoid.isometric(lat)))
    }

    /// Metres to longitude from the central meridian and latitude (radians); `None` off the map.
    pub(crate) fn inverse(&self, p: DVec2) -> Option<(f64, f64)> {
        let q = p / (self.ellipsoid.a * self.k_0);
        (q.x.abs() <= std::f64::consts::PI + 1e-9 && q.y.abs() < 25.0)
            .then(|| (q.x, self.ellipsoid.latitude_of_conformal_tan(sinh(q.y))))
    }
}
