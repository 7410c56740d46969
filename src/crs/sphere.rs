//! Directions on a sphere, and how they look from a point of it: what the oblique projections turn.

use crate::math::{atan2, cos, sin};
use glam::DVec2;

/// A unit vector: towards the central meridian on the equator, east of that, and north.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Direction {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) z: f64,
}

impl Direction {
    /// Of a longitude and a latitude, radians.
    pub(crate) fn new(lon: f64, lat: f64) -> Self {
        let c = cos(lat);
        Self { x: c * cos(lon), y: c * sin(lon), z: sin(lat) }
    }

    /// Its longitude and latitude, radians: of full precision at the poles.
    pub(crate) fn angles(&self) -> (f64, f64) {
        (atan2(self.y, self.x), atan2(self.z, self.equatorial()))
    }

    /// The cosine of the latitude.
    pub(crate) fn equatorial(&self) -> f64 {
        (self.x * self.x + self.y * self.y).sqrt()
    }
}

/// A point of the central meridian that a projection is centred on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pole {
    pub(crate) sine: f64,
    pub(crate) cosine: f64,
}

/// A direction as a point sees it: the cosine of the angle between the two, and the parts to the east and to the north.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Seen {
    pub(crate) towards: f64,
    pub(crate) east: f64,
    pub(crate) north: f64,
}

impl Pole {
    /// At a latitude, radians.
    pub(crate) fn at(lat: f64) -> Self {
        Self { sine: sin(lat), cosine: cos(lat) }
    }

    /// At the north or the south pole, by the sign.
    pub(crate) fn at_pole(sign: f64) -> Self {
        Self { sine: 1.0_f64.copysign(sign), cosine: 0.0 }
    }

    /// How a direction looks from here.
    pub(crate) fn seen(&self, d: &Direction) -> Seen {
        Seen {
            towards: self.sine * d.z + self.cosine * d.x,
            east: d.y,
            north: self.cosine * d.z - self.sine * d.x,
        }
    }

    /// The direction that looks so from here.
    pub(crate) fn direction(&self, seen: &Seen) -> Direction {
        Direction {
            x: self.cosine * seen.towards - self.sine * seen.north,
            y: seen.east,
            z: self.sine * seen.towards + self.cosine * seen.north,
        }
    }

    /// The direction at an angle from here, on the side of a vector (east, north) of some length.
    pub(crate) fn direction_of(&self, side: DVec2, length: f64, angle: f64) -> Direction {
        let unit = if length > 0.0 { side / length } else { DVec2::ZERO };
        let s = sin(angle);
        self.direction(&Seen { towards: cos(angle), east: unit.x * s, north: unit.y * s })
    }
}
