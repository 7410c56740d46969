//! Gauss's conformal sphere of an ellipsoid, and the projections that turn it: the Swiss oblique Mercator and Krovak's cone.
//!
//! *Coordinate Conversions and Transformations including Formulas*, IOGP publication 373-7-2, methods 9809, 9815 and 9819, written
//! with isometric latitudes: the sphere's is a linear function of the ellipsoid's, its longitude a multiple.

use super::ellipsoid::Ellipsoid;
use super::sphere::{Direction, Pole, Seen};
use crate::math::{asinh, atan, atan2, atanh, cos, cosh, exp, ln, sin, sinh, tanh};
use glam::DVec2;

/// A sphere on which an ellipsoid is pictured conformally, true near one parallel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct GaussSphere {
    ellipsoid: Ellipsoid,
    /// Degrees of the sphere's longitude in one of the ellipsoid's.
    factor: f64,
    /// What is added to so many times the isometric latitude.
    shift: f64,
    /// The sphere's radius.
    pub(crate) radius: f64,
}

impl GaussSphere {
    /// With the latitude of the origin at asin(sin(lat) / factor): methods 9815 and 9819.
    pub(crate) fn new(ellipsoid: Ellipsoid, lat: f64) -> Self {
        let factor = longitude_factor(&ellipsoid, lat);
        let on_sphere = asinh(sin(lat) / (factor * factor - sin(lat) * sin(lat)).sqrt());
        let shift = on_sphere - factor * ellipsoid.isometric(lat);
        Self { ellipsoid, factor, shift, radius: mean_radius(&ellipsoid, lat) }
    }

    /// With method 9809's constant; `None` where the origin is a pole.
    pub(crate) fn of_stereographic(ellipsoid: Ellipsoid, lat: f64) -> Option<Self> {
        let factor = longitude_factor(&ellipsoid, lat);
        let (s, chi) = (sin(lat), tanh(factor * ellipsoid.isometric(lat)));
        let c = (factor + s) * (1.0 - chi) / ((factor - s) * (1.0 + chi));
        let shift = 0.5 * ln(c);
        shift.is_finite().then(|| Self { ellipsoid, factor, shift, radius: mean_radius(&ellipsoid, lat) })
    }

    /// The sphere's latitude of a latitude, radians.
    pub(crate) fn latitude(&self, lat: f64) -> f64 {
        atan(sinh(self.isometric(lat)))
    }

    fn isometric(&self, lat: f64) -> f64 {
        self.factor * self.ellipsoid.isometric(lat) + self.shift
    }

    /// The direction of a longitude from the central meridian and a latitude, radians; `None` where the sphere overlaps itself, next to the
    /// opposite meridian.
    pub(crate) fn direction(&self, lam: f64, lat: f64) -> Option<Direction> {
        let isometric = self.isometric(lat);
        let (cosine, l) = (1.0 / cosh(isometric), self.factor * lam);
        let d = Direction { x: cosine * cos(l), y: cosine * sin(l), z: tanh(isometric) };
        (l.abs() <= std::f64::consts::PI).then_some(d)
    }

    /// The longitude from the central meridian and the latitude (radians) of a direction; `None` where the sphere overlaps itself.
    pub(crate) fn geographic(&self, d: &Direction) -> Option<(f64, f64)> {
        let lam = atan2(d.y, d.x) / self.factor;
        let isometric = (asinh(d.z / d.equatorial()) - self.shift) / self.factor;
        let lat = self.ellipsoid.latitude_of_conformal_tan(sinh(isometric));
        (lam.abs() <= std::f64::consts::PI + 1e-9 && lat.is_finite()).then_some((lam, lat))
    }
}

fn longitude_factor(ellipsoid: &Ellipsoid, lat: f64) -> f64 {
    let c = cos(lat);
    (1.0 + ellipsoid.e2() * c * c * c * c / (1.0 - ellipsoid.e2())).sqrt()
}

/// The geometric mean of the radii of curvature.
fn mean_radius(ellipsoid: &Ellipsoid, lat: f64) -> f64 {
    (ellipsoid.meridian(lat) * ellipsoid.prime_vertical(lat)).sqrt()
}

/// The Swiss oblique Mercator projection: Gauss's sphere on a cylinder that touches it along the circle through the origin and east.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SwissMercator {
    /// Latitude of origin, degrees.
    pub(crate) lat_0: f64,
    /// Scale at the origin.
    pub(crate) k_0: f64,
    sphere: GaussSphere,
    pole: Pole,
}

impl SwissMercator {
    pub(crate) fn new(ellipsoid: Ellipsoid, lat_0: f64, k_0: f64) -> Self {
        let sphere = GaussSphere::new(ellipsoid, lat_0.to_radians());
        Self { lat_0, k_0, sphere, pole: Pole::at(sphere.latitude(lat_0.to_radians())) }
    }

    /// Longitude from the central meridian and latitude (radians) to metres; `None` at the cylinder's ends.
    pub(crate) fn forward(&self, lam: f64, lat: f64) -> Option<DVec2> {
        let seen = self.pole.seen(&self.sphere.direction(lam, lat)?);
        let along = (seen.towards * seen.towards + seen.east * seen.east).sqrt();
        let p = DVec2::new(atan2(seen.east, seen.towards), asinh(seen.north / along));
        (along > 1e-9).then(|| p * (self.sphere.radius * self.k_0))
    }

    /// Metres to longitude from the central meridian and latitude (radians); `None` off the map.
    pub(crate) fn inverse(&self, p: DVec2) -> Option<(f64, f64)> {
        let q = p / (self.sphere.radius * self.k_0);
        if !(q.x.abs() <= std::f64::consts::PI + 1e-9 && q.y.abs() < 25.0) {
            return None;
        }
        let along = 1.0 / cosh(q.y);
        let seen = Seen { towards: along * cos(q.x), east: along * sin(q.x), north: tanh(q.y) };
        self.sphere.geographic(&self.pole.direction(&seen))
    }
}

/// Krovak's oblique conformal conic projection, counted east and north (both negative in its own country).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Krovak {
    /// Latitude of origin, degrees.
    pub(crate) lat_0: f64,
    /// Scale on the pseudo standard parallel.
    pub(crate) k_0: f64,
    sphere: GaussSphere,
    /// Where the cone's axis meets the sphere.
    axis: Pole,
    cone: f64,
    /// The radius of the picture of the cone's equator.
    scale: f64,
}

/// The co-latitude of the cone's axis: 30 degrees 17 minutes 17.30311 seconds. (PROJ takes it whatever `+alpha` says, and so do we: old
/// lists round it.)
const AXIS_COLATITUDE_DEG: f64 = 30.288_139_752_777_78;

/// The pseudo standard parallel.
const PSEUDO_PARALLEL_DEG: f64 = 78.5;

impl Krovak {
    pub(crate) fn new(ellipsoid: Ellipsoid, lat_0: f64, k_0: f64) -> Self {
        let sphere = GaussSphere::new(ellipsoid, lat_0.to_radians());
        let parallel = PSEUDO_PARALLEL_DEG.to_radians();
        let cone = sin(parallel);
        let radius = sphere.radius * k_0 * cos(parallel) / cone;
        Self {
            lat_0,
            k_0,
            sphere,
            axis: Pole::at((90.0 - AXIS_COLATITUDE_DEG).to_radians()),
            cone,
            scale: radius * exp(cone * atanh(cone)),
        }
    }

    /// Longitude from the central meridian and latitude (radians) to metres; `None` at the cone's open end.
    pub(crate) fn forward(&self, lam: f64, lat: f64) -> Option<DVec2> {
        let seen = self.axis.seen(&self.sphere.direction(lam, lat)?);
        // The latitude about the axis, and the longitude from its side that looks south.
        let along = (seen.east * seen.east + seen.north * seen.north).sqrt();
        let r = self.scale * exp(-self.cone * asinh(seen.towards / along));
        let theta = self.cone * atan2(seen.east, -seen.north);
        (r < 1e10).then(|| DVec2::new(r * sin(theta), -r * cos(theta)))
    }

    /// Metres to longitude from the central meridian and latitude (radians); `None` out of the domain.
    pub(crate) fn inverse(&self, p: DVec2) -> Option<(f64, f64)> {
        let r = p.length();
        let theta = atan2(p.x, -p.y) / self.cone;
        if !(r > 0.0 && r < 1e10 && theta.abs() <= std::f64::consts::PI + 1e-9) {
            return None;
        }
        let isometric = -ln(r / self.scale) / self.cone;
        let along = 1.0 / cosh(isometric);
        let seen = Seen { towards: tanh(isometric), east: along * sin(theta), north: -along * cos(theta) };
        self.sphere.geographic(&self.axis.direction(&seen))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::asin;

    #[test]
    fn the_origin_of_a_sphere_is_where_its_definition_says() {
        let bessel = Ellipsoid::from_inverse_flattening(6_377_397.155, 299.152_812_8);
        let lat = 46.95_f64.to_radians();
        let sphere = GaussSphere::new(bessel, lat);
        assert!((sphere.latitude(lat) - asin(sin(lat) / sphere.factor)).abs() < 1e-15);
    }
}
