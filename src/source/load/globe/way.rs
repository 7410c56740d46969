//! How far it is along a path over the ground, and paths with as many places as strokes on a globe need.
//!
//! A segment is straight in longitude and latitude. Its length is the integral of sqrt((N cos(lat) dlon)^2 + (M dlat)^2) (J. P. Snyder 1987, *Map Projections:
//! A Working Manual*, 4-20 and 4-21: lengths of a degree along parallels and meridians), by Gauss and Legendre's rule of five points, halved until halves agree.

use super::foot::SAME_PLACE;
use crate::math::{cos, max, min};
use crate::scene::Measure;
use crate::space::Ellipsoid;
use glam::DVec2;
use std::f64::consts::FRAC_PI_2;

/// Places and weights of the rule of five points on 0..1.
const GAUSS: [(f64, f64); 5] = [
    (0.046_910_077_030_668, 0.118_463_442_528_094_54),
    (0.230_765_344_947_158_45, 0.239_314_335_249_683_24),
    (0.5, 0.284_444_444_444_444_44),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_24),
    (0.953_089_922_969_332, 0.118_463_442_528_094_54),
];

/// How often a stretch is halved, and up to which share of it its halves agree.
const DEEPEST: u32 = 12;
const AGREE: f64 = 1e-12;

/// No step to the east is longer, radians: of longer ones nobody could tell which way around they go.
const WIDEST: f64 = 1.0;

/// Along a segment of a stroke in pixels the length of a degree of longitude changes by this share at most; near a pole, where widths are not small beside the
/// distance from there, by more, lest a crowd of segments lie on one another; and within that share of the earth's radius by any.
const UNEVEN: f64 = 1.0 / 32.0;
const UNEVEN_NEAR_A_POLE: f64 = 1.0 / 8.0;
const NEAR_A_POLE: f64 = 1.0 / 12.0;
const AT_A_POLE: f64 = 1.0 / 4_096.0;
const MOST_HALVINGS: u32 = 24;

/// Lengths over the ground of an ellipsoid; places are longitude and latitude in radians.
#[derive(Clone, Copy)]
pub(super) struct OverTheGround(pub(super) Ellipsoid);

impl OverTheGround {
    /// How fast a place that moves by a step goes over the ground; beyond a pole it stands.
    fn speed(&self, lat: f64, step: DVec2) -> f64 {
        if lat.abs() > FRAC_PI_2 {
            return 0.0;
        }
        let (n, m) = (self.0.prime_vertical(lat), self.0.meridian(lat));
        DVec2::new(n * cos(lat) * step.x, m * step.y).length()
    }

    /// Whether a path is a ring: it ends where it begins, maybe a turn on, and has three places.
    pub(super) fn is_ring(&self, path: &[DVec2]) -> bool {
        let at = |place: DVec2| self.0.geocentric(place.x, place.y);
        let is_one = |a: DVec2, b: DVec2| (at(a) - at(b)).length() <= SAME_PLACE;
        let [first, between @ .., last] = path else { return false };
        let mut others = between.iter().filter(|place| !is_one(**place, *first));
        let is_around = (last.x - first.x).abs() > 1.0;
        let mut is_wide = || others.next().is_some_and(|one| others.any(|place| !is_one(*place, *one)));
        is_one(*first, *last) && (is_around || is_wide())
    }

    fn rule(&self, from: DVec2, step: DVec2) -> f64 {
        GAUSS.iter().map(|(share, weight)| weight * self.speed(from.y + step.y * share, step)).sum()
    }

    fn halved(&self, from: DVec2, step: DVec2, whole: f64, depth: u32) -> f64 {
        let half = step * 0.5;
        let [first, second] = [from, from + half].map(|from| self.rule(from, half));
        if depth == 0 || (first + second - whole).abs() <= AGREE * whole {
            return first + second;
        }
        self.halved(from, half, first, depth - 1) + self.halved(from + half, half, second, depth - 1)
    }
}

impl Measure for OverTheGround {
    type Place = DVec2;

    const SHORTEST: f64 = SAME_PLACE;

    fn length(&self, from: DVec2, to: DVec2) -> f64 {
        let step = to - from;
        // Along a parallel each step is as long.
        if step.y == 0.0 {
            self.speed(from.y, step)
        } else {
            self.halved(from, step, self.rule(from, step), DEEPEST)
        }
    }

    fn place(&self, [from, to]: [DVec2; 2], length: f64, at: f64) -> DVec2 {
        let step = to - from;
        let (mut low, mut high, mut share) = (0.0, 1.0, min(at / length, 1.0));
        // Newton's steps, as long as they stay where the place is known to be.
        for _ in 0..32 {
            let off = self.length(from, from + step * share) - at;
            if off.abs() <= 1e-9 {
                break;
            }
            if off > 0.0 {
                high = share;
            } else {
                low = share;
            }
            let next = share - off / self.speed(from.y + step.y * share, step);
            share = if low < next && next < high { next } else { 0.5 * (low + high) };
        }
        from + step * share
    }

    fn is_same(&self, one: DVec2, other: DVec2) -> bool {
        // At a pole places are one on the ground that are far from one another in the plan, and a path goes from the one to the other.
        (other - one).length() * self.0.a <= SAME_PLACE
    }

    fn after_the_end(&self, place: DVec2, begin: DVec2, end: DVec2) -> DVec2 {
        place + (end - begin)
    }
}

/// A path none of whose steps goes too far around.
pub(super) fn in_steps(path: &[DVec2]) -> Vec<DVec2> {
    with_places(path, |from, to, all| {
        let count = ((to.x - from.x).abs() / WIDEST).ceil();
        all.extend((1..count as u32).map(|k| from + (to - from) * (f64::from(k) / count)));
    })
}

/// A path along each of whose segments a degree of longitude is about as long everywhere.
pub(super) fn evenly(path: &[DVec2]) -> Vec<DVec2> {
    with_places(path, |from, to, all| halve(from, to, MOST_HALVINGS, all))
}

fn halve(from: DVec2, to: DVec2, depth: u32, all: &mut Vec<DVec2>) {
    let [start, end] = [from, to].map(|place| max(cos(min(place.y.abs(), FRAC_PI_2)), 0.0));
    // On both sides of the equator degrees are longer than at both ends.
    let most = if from.y * to.y < 0.0 { 1.0 } else { max(start, end) };
    let uneven = if most > NEAR_A_POLE { UNEVEN } else { UNEVEN_NEAR_A_POLE };
    let is_even = most - min(start, end) <= uneven * most;
    if depth == 0 || is_even || most <= AT_A_POLE {
        return;
    }
    let middle = from + (to - from) * 0.5;
    halve(from, middle, depth - 1, all);
    all.push(middle);
    halve(middle, to, depth - 1, all);
}

fn with_places(path: &[DVec2], mut between: impl FnMut(DVec2, DVec2, &mut Vec<DVec2>)) -> Vec<DVec2> {
    let mut all = Vec::with_capacity(path.len());
    for (k, &place) in path.iter().enumerate() {
        all.push(place);
        if let Some(&next) = path.get(k + 1) {
            between(place, next, &mut all);
        }
    }
    all
}
