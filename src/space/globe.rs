//! A globe: where a place of its plan is in the world, and which place lies below a point of the world.
//!
//! The plan of a globe is longitude and latitude, each as metres on the equator's circle (angle times equatorial radius), so that its numbers
//! are of the size of metres. Places a turn apart are one place of the world. The world is geocentric: x through the equator at longitude 0,
//! z through the northern pole.

use super::{Ellipsoid, Plan, World};
use crate::math::cos;
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_PI_2, TAU};

/// An ellipsoid, and where the local zeros of the plan and of the world are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Globe {
    /// Its shape.
    pub ellipsoid: Ellipsoid,
    /// The place of the plan that is local (0, 0): longitude and latitude as metres on the equator's circle.
    pub plan_origin: DVec2,
    /// The geocentric point that is the local zero of the world.
    pub world_origin: DVec3,
}

impl Globe {
    /// The longitude and latitude of a place, radians; what lies beyond a pole is at the pole.
    pub fn geographic(&self, at: Plan) -> (f64, f64) {
        let angles = (at.to_vec() + self.plan_origin) / self.ellipsoid.a;
        (angles.x, angles.y.clamp(-FRAC_PI_2, FRAC_PI_2))
    }

    /// The place of a longitude and latitude, radians.
    pub fn plan(&self, lon: f64, lat: f64) -> Plan {
        Plan::from(DVec2::new(lon, lat) * self.ellipsoid.a - self.plan_origin)
    }

    /// How many metres on the ground a metre of the plan is to the east and to the north, at the latitude in the middle of a segment.
    pub fn ground_scale(&self, from: Plan, to: Plan) -> DVec2 {
        let (_, lat) = self.geographic(from + (to - from) * 0.5);
        let Ellipsoid { a, .. } = self.ellipsoid;
        DVec2::new(self.ellipsoid.prime_vertical(lat) / a * cos(lat), self.ellipsoid.meridian(lat) / a)
    }

    /// The length of a turn of longitude in the plan.
    pub fn turn(&self) -> f64 {
        TAU * self.ellipsoid.a
    }

    /// What is up at a place: the ellipsoid's normal.
    pub fn up(&self, at: Plan) -> DVec3 {
        let (lon, lat) = self.geographic(at);
        let [_, _, up] = Ellipsoid::directions(lon, lat);
        up
    }

    /// The point so high over a place, along the ellipsoid's normal.
    pub fn world(&self, at: Plan, height: f64) -> World {
        let (lon, lat) = self.geographic(at);
        let foot = self.ellipsoid.geocentric(lon, lat) - self.world_origin;
        World::from(foot + self.up(at) * height)
    }

    /// How far the place below a point of the world is from a place of the plan, metres along the chord.
    pub fn distance_on_the_ground(&self, point: World, at: Plan) -> f64 {
        let (lon, lat) = self.ellipsoid.geographic(point.to_vec() + self.world_origin);
        let (own_lon, own_lat) = self.geographic(at);
        (self.ellipsoid.geocentric(lon, lat) - self.ellipsoid.geocentric(own_lon, own_lat)).length()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn globe() -> Globe {
        let ellipsoid = Ellipsoid { a: 6_378_137.0, f: 1.0 / 298.257_223_563 };
        let (plan_origin, world_origin) = (DVec2::new(1e6, -2e6), DVec3::new(6e6, 1e6, -2e6));
        Globe { ellipsoid, plan_origin, world_origin }
    }

    #[test]
    fn a_step_of_the_plan_is_as_long_on_the_ground_as_its_scale_says() {
        let globe = globe();
        for lat in [0.0, 0.7, -1.3, 1.56] {
            let at = globe.plan(2.0, lat);
            for step in [DVec2::new(10.0, 0.0), DVec2::new(0.0, 10.0), DVec2::new(-6.0, 8.0)] {
                let (from, to) = (at + step * -0.5, at + step * 0.5);
                let told = (globe.ground_scale(from, to) * step).length();
                let way = (globe.world(to, 0.0) - globe.world(from, 0.0)).length();
                assert!((told - way).abs() < 1e-6, "{lat} {step}: {told} {way}");
            }
        }
        let pole = globe.plan(0.0, FRAC_PI_2);
        assert!(globe.ground_scale(pole, pole).x < 1e-15);
    }

    #[test]
    fn a_point_over_a_place_lies_over_that_place_and_no_other() {
        let globe = globe();
        for (x, y, height) in [(3e5, 4e4, 0.0), (-1.9e7, 6e6, 8848.0), (1.9e7, -7e6, -400.0)] {
            let (at, other) = (Plan::new(x, y), Plan::new(x + 10.0, y));
            let point = globe.world(at, height);
            assert!(globe.distance_on_the_ground(point, at) < 1e-6);
            let (_, lat) = globe.geographic(at);
            let east = globe.ellipsoid.prime_vertical(lat) * crate::math::cos(lat) * 10.0 / 6_378_137.0;
            assert!((globe.distance_on_the_ground(point, other) - east).abs() < 1e-6);
        }
    }

    #[test]
    fn places_a_turn_apart_are_one_and_beyond_a_pole_is_the_pole() {
        let globe = globe();
        let at = Plan::new(3e5, 4e4);
        let around = at + DVec2::new(globe.turn(), 0.0);
        assert!((globe.world(at, 9.0) - globe.world(around, 9.0)).length() < 1e-7);
        let pole = globe.plan(1.0, FRAC_PI_2);
        let beyond = globe.world(pole + DVec2::Y * 1e6, 3.0);
        let expected = DVec3::Z * (globe.ellipsoid.b() + 3.0) - globe.world_origin;
        assert!((beyond.to_vec() - expected).length() < 1e-8);
    }
}
