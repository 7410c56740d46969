//! Ellipsoids of revolution: radii of curvature, geocentric coordinates.

use crate::math::{atan2, cos, sin};
use glam::DVec3;

/// An ellipsoid of revolution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ellipsoid {
    /// Equatorial radius in metres.
    pub a: f64,
    /// Flattening.
    pub f: f64,
}

impl Ellipsoid {
    /// The first eccentricity squared.
    pub fn e2(&self) -> f64 {
        self.f * (2.0 - self.f)
    }

    /// The polar radius.
    pub fn b(&self) -> f64 {
        self.a * (1.0 - self.f)
    }

    /// The radius of curvature in the prime vertical, N.
    pub fn prime_vertical(&self, lat: f64) -> f64 {
        let s = sin(lat);
        self.a / (1.0 - self.e2() * s * s).sqrt()
    }

    /// The radius of curvature in the meridian, M.
    pub fn meridian(&self, lat: f64) -> f64 {
        let s = sin(lat);
        let w2 = 1.0 - self.e2() * s * s;
        self.a * (1.0 - self.e2()) / (w2 * w2.sqrt())
    }

    /// Geographic (radians) to geocentric (metres), at height 0.
    pub fn geocentric(&self, lon: f64, lat: f64) -> DVec3 {
        let n = self.prime_vertical(lat);
        let r = n * cos(lat);
        DVec3::new(r * cos(lon), r * sin(lon), n * (1.0 - self.e2()) * sin(lat))
    }

    /// Geocentric (metres) to geographic (radians); the height is dropped.
    ///
    /// Bowring's formula (1976), iterated on the parametric latitude: each round gains some five digits near the
    /// surface, so three give all of them.
    pub fn geographic(&self, p: DVec3) -> (f64, f64) {
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

    /// The directions east, north and up (the normal) at a longitude and latitude (radians), geocentric. At a pole east and north
    /// are those of the meridian.
    pub fn directions(lon: f64, lat: f64) -> [DVec3; 3] {
        let ((s, c), (sin_lon, cos_lon)) = ((sin(lat), cos(lat)), (sin(lon), cos(lon)));
        let east = DVec3::new(-sin_lon, cos_lon, 0.0);
        let north = DVec3::new(-s * cos_lon, -s * sin_lon, c);
        [east, north, DVec3::new(c * cos_lon, c * sin_lon, s)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WGS84: Ellipsoid = Ellipsoid { a: 6_378_137.0, f: 1.0 / 298.257_223_563 };

    #[test]
    fn geocentric_coordinates_agree_with_proj() {
        // reference: PROJ 9, +proj=cart +ellps=WGS84 of (7.5, 46.9, 0)
        let (lon, lat) = (7.5_f64.to_radians(), 46.9_f64.to_radians());
        let at_500_m = DVec3::new(4_328_800.129_357_4, 569_897.348_586_543_4, 4_634_541.012_035_782);
        let [_, _, up] = Ellipsoid::directions(lon, lat);
        assert!((WGS84.geocentric(lon, lat) + up * 500.0 - at_500_m).length() < 1e-6);
    }

    #[test]
    fn geocentric_coordinates_are_those_of_epsgs_example() {
        // EPSG guidance note 7-2, 4.1.1: 53 48' 33.820" N, 2 07' 46.380" E, 73.0 m.
        let degrees = |d: f64, m: f64, s: f64| (d + m / 60.0 + s / 3600.0).to_radians();
        let (lat, lon) = (degrees(53.0, 48.0, 33.820), degrees(2.0, 7.0, 46.380));
        let [_, _, up] = Ellipsoid::directions(lon, lat);
        let expected = DVec3::new(3_771_793.968, 140_253.342, 5_124_304.349);
        let placed = WGS84.geocentric(lon, lat) + up * 73.0;
        assert!((placed - expected).abs().max_element() < 6e-4, "{placed}");
        let (back_lon, back_lat) = WGS84.geographic(expected);
        assert!((back_lon - lon).abs() < 2e-10 && (back_lat - lat).abs() < 2e-10);
    }

    #[test]
    fn geocentric_and_back_is_the_same_place() {
        for (lon, lat) in [(0.0, 0.0), (120.0, 89.0), (-179.9, -45.0), (10.0, -89.999)] {
            let p = WGS84.geocentric(f64::to_radians(lon), f64::to_radians(lat));
            let (back_lon, back_lat) = WGS84.geographic(p);
            assert!((back_lon.to_degrees() - lon).abs() < 1e-12);
            assert!((back_lat.to_degrees() - lat).abs() < 1e-12);
        }
    }

    #[test]
    fn directions_are_those_in_which_places_move() {
        let (lon, lat, step) = (2.1, -0.7, 1e-6);
        let here = WGS84.geocentric(lon, lat);
        let [east, north, up] = Ellipsoid::directions(lon, lat);
        let along = (WGS84.geocentric(lon + step, lat) - here) / step;
        assert!((along - east * WGS84.prime_vertical(lat) * cos(lat)).length() < 10.0);
        let along = (WGS84.geocentric(lon, lat + step) - here) / step;
        assert!((along - north * WGS84.meridian(lat)).length() < 10.0);
        assert!((east.cross(north) - up).length() < 1e-15);
    }
}
