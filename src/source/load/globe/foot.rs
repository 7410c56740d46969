//! Places on the ground, and chains of them in longitude and latitude.

use crate::math::{cos, max};
use crate::space::Ellipsoid;
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Places nearer than this, metres, are one: the last digits of geocentric coordinates and of angles.
pub(super) const SAME_PLACE: f64 = 1e-6;

/// How often what leads from one place to another is halved.
const DEEPEST: u32 = 16;

/// An angle within half a turn.
pub(super) fn wrapped(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

/// The ground of an ellipsoid, known up to a tolerance.
#[derive(Clone, Copy)]
pub(super) struct Ground {
    pub(super) ellipsoid: Ellipsoid,
    /// Metres that an edge may be off.
    pub(super) tolerance: f64,
}

impl Ground {
    /// The geocentric point of a longitude and latitude.
    pub(super) fn at(&self, place: DVec2) -> DVec3 {
        self.ellipsoid.geocentric(place.x, place.y)
    }

    /// The longitude and latitude below a geocentric point.
    pub(super) fn below(&self, point: DVec3) -> DVec2 {
        DVec2::from(self.ellipsoid.geographic(point))
    }

    /// How far a place is from a point of the straight edge of the plan between two places, the short way around.
    pub(super) fn off(&self, (from, to): (DVec2, DVec2), share: f64, place: DVec2) -> f64 {
        let way = DVec2::new(wrapped(to.x - from.x), to.y - from.y);
        (self.at(from + way * share) - self.at(place)).length()
    }

    /// Whether edges of some length are as good as straight in the plan at a place: it is far from the poles.
    pub(super) fn is_level(&self, place: DVec2, length: f64) -> bool {
        self.ellipsoid.b() * cos(place.y) > 64.0 * length
    }

    /// Adds the places between two along the straight way over the ground.
    pub(super) fn between(&self, from: DVec2, to: DVec2, all: &mut Vec<DVec2>) {
        self.halve(from, to, DEEPEST, all);
    }

    fn halve(&self, from: DVec2, to: DVec2, depth: u32, all: &mut Vec<DVec2>) {
        let (a, b) = (self.at(from), self.at(to));
        if depth == 0 || (b - a).length() <= self.tolerance {
            return;
        }
        let places = [0.25, 0.5, 0.75].map(|share| (share, self.below(a + (b - a) * share)));
        let off = places.iter().map(|(share, place)| self.off((from, to), *share, *place)).fold(0.0, max);
        if off <= self.tolerance {
            return;
        }
        let [_, (_, middle), _] = places;
        self.halve(from, middle, depth - 1, all);
        all.push(middle);
        self.halve(middle, to, depth - 1, all);
    }

    /// Whether a place is a pole.
    pub(super) fn is_pole(&self, place: DVec2) -> bool {
        self.ellipsoid.a * max(FRAC_PI_2 - place.y.abs(), 0.0) < SAME_PLACE
    }

    /// A ring whose vertices at a pole stand there twice, with the longitudes of both their neighbours: in the plan it goes along the pole.
    /// Of a ring that passes straight over the pole, counter-clockwise, the inside lies away from the pole's row.
    pub(super) fn along_the_poles(&self, ring: Vec<DVec2>) -> Vec<DVec2> {
        let others: Vec<usize> = (0..ring.len()).filter(|k| !self.is_pole(ring[*k])).collect();
        if others.len() == ring.len() || others.is_empty() {
            return ring;
        }
        let mut all = Vec::with_capacity(ring.len() + 2);
        for (n, &k) in others.iter().enumerate() {
            let next = others[(n + 1) % others.len()];
            all.push(ring[k]);
            if (k + 1) % ring.len() == next {
                continue;
            }
            let (from, to) = (ring[k].x, ring[next].x);
            let side = 1_f64.copysign(ring[(k + 1) % ring.len()].y);
            let mut way = wrapped(to - from);
            if way.abs() > PI * (1.0 - 1e-6) {
                way = -side * way.abs();
            }
            all.extend([DVec2::new(from, side * FRAC_PI_2), DVec2::new(from + way, side * FRAC_PI_2)]);
        }
        all
    }
}
