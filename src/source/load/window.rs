//! Which part of a file's coordinates a rectangle of the plan is, and how far around it a projection can be used.
//!
//! Input: the map from a file to the plan, a rectangle of the plan. Output: boxes in the file's coordinates. Nothing is refused: where
//! no box can be told there is none.

use crate::crs::{PlanFrom, Turn};
use crate::math::{cos, max, min};
use crate::space::{Plan, PlanBox};
use glam::DVec2;

/// The farthest that a horizon is looked for, metres of the plan.
const FARTHEST: f64 = 8e6;

/// Points a side of a rectangle by which its image is found, and of a box by which the map is judged; even.
const SAMPLES: usize = 16;

/// Between the samples the image of a rectangle bends: by less than this share of its size.
const MARGIN: f64 = 0.05;

/// Neighbours of a sample lie on both of its sides, to this share of their distance; across a seam of a projection it is a half.
const SMOOTH: f64 = 0.3;

/// A box in a file's coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Region {
    /// The box; with a pole it has all longitudes, and only its side away from the pole means anything.
    pub(super) bounds: PlanBox,
    /// The pole that is inside: 1 the northern, -1 the southern one, 0 none.
    pub(super) pole: f64,
}

impl Region {
    /// The image of a rectangle of the plan. `None` where a part of the rectangle has no place in the file.
    pub(super) fn of(map: &PlanFrom, rectangle: &PlanBox) -> Option<Self> {
        let turn = map.file().turn();
        let quarter = turn.map_or(f64::INFINITY, |turn| turn.pole);
        // Where turns are kept no two longitudes meet.
        let turn = turn.filter(|_| !map.keeps_turns());
        let size = rectangle.max - rectangle.min;
        let share = |k: usize| k as f64 / SAMPLES as f64;
        let at = |i: usize, j: usize| {
            map.invert_unrolled(rectangle.min.to_vec() + size * DVec2::new(share(i), share(j))).ok()
        };
        let middle = at(SAMPLES / 2, SAMPLES / 2)?;
        let mut bounds = PlanBox::EMPTY;
        for (i, j) in (0..=SAMPLES).flat_map(|i| (0..=SAMPLES).map(move |j| (i, j))) {
            let mut p = at(i, j)?;
            if let Some(turn) = turn {
                p.x -= turn.length * ((p.x - middle.x) / turn.length).round();
            }
            bounds.include(Plan::from(p));
        }
        let mut pole = 0.0;
        if let Some(turn) = turn.filter(|turn| turn.pole.is_finite()) {
            let holds = |pole: f64| {
                let place = map.apply(DVec2::new(middle.x, pole * turn.pole)).ok();
                place.is_some_and(|p| rectangle.contains(&PlanBox::around([Plan::from(p)])))
            };
            pole = match (holds(1.0), holds(-1.0)) {
                (true, true) => return None,
                (true, false) => 1.0,
                (false, true) => -1.0,
                (false, false) => 0.0,
            };
            if pole != 0.0 {
                bounds.include(Plan::new(middle.x - 0.5 * turn.length, pole * turn.pole));
                bounds.include(Plan::new(middle.x + 0.5 * turn.length, pole * turn.pole));
            }
        }
        let margin = (bounds.max - bounds.min) * if map.affine().is_none() { MARGIN } else { 0.0 };
        if pole == 0.0 {
            // A pole that is not inside may have no place in the plan.
            let (south, north) = (0.5 * (bounds.min.y + quarter), 0.5 * (quarter - bounds.max.y));
            bounds.min = bounds.min + -DVec2::new(margin.x, min(margin.y, max(south, 0.0)));
            bounds.max = bounds.max + DVec2::new(margin.x, min(margin.y, max(north, 0.0)));
        } else {
            bounds.min.y -= if pole > 0.0 { margin.y } else { 0.0 };
            bounds.max.y += if pole < 0.0 { margin.y } else { 0.0 };
        }
        let is_whole = bounds.min.is_finite() && bounds.max.is_finite();
        let is_wound = turn.is_some_and(|turn| pole == 0.0 && bounds.max.x - bounds.min.x >= turn.length);
        (is_whole && !is_wound).then_some(Self { bounds, pole })
    }

    /// All of the globe between the two sides of a seam, opposite to a longitude.
    pub(super) fn between_seams(longitude: f64, turn: Turn) -> Self {
        // A bit less, lest the eastern side becomes the western one.
        let half = DVec2::new(0.5 * turn.length * (1.0 - 1e-9), turn.pole);
        let middle = Plan::new(longitude, 0.0);
        Self { bounds: PlanBox { min: middle + -half, max: middle + half }, pole: 0.0 }
    }

    /// The largest region around a rectangle of the plan in which the map can be used, at least that of the rectangle grown by `least`.
    pub(super) fn horizon(map: &PlanFrom, rectangle: &PlanBox, least: f64) -> Option<Self> {
        let mut far = FARTHEST;
        while far > least {
            let region = Self::of(map, &rectangle.grown(far));
            if let Some(region) = region.filter(|region| region.is_smooth(map)) {
                return Some(region);
            }
            far *= 0.25;
        }
        Self::of(map, &rectangle.grown(least))
    }

    /// Whether the map has a place for all of the region, without a seam, and leads back from there.
    fn is_smooth(&self, map: &PlanFrom) -> bool {
        let turn = map.file().turn();
        let PlanBox { min: low, max: high } = self.bounds;
        let size = high - low;
        let file = |i: usize, j: usize| {
            low.to_vec() + size * DVec2::new(i as f64 / SAMPLES as f64, j as f64 / SAMPLES as f64)
        };
        let mut placed = Vec::with_capacity((SAMPLES + 1) * (SAMPLES + 1));
        for (j, i) in (0..=SAMPLES).flat_map(|j| (0..=SAMPLES).map(move |i| (j, i))) {
            let p = on_the_globe(file(i, j), turn);
            let Ok(q) = map.apply_unrolled(p) else { return false };
            let Ok(back) = map.invert_unrolled(q) else { return false };
            let mut off = back - p;
            if let Some(turn) = turn {
                off.x -= turn.length * (off.x / turn.length).round();
                // In degrees a step along a parallel is shorter than one along a meridian; on a cylinder they are alike.
                off.x *=
                    if turn.pole.is_finite() { cos(p.y / turn.length * std::f64::consts::TAU) } else { 1.0 };
            }
            if !(off.abs().cmple(1e-6 * size).all()) {
                return false;
            }
            placed.push(q);
        }
        let at = |i: usize, j: usize| placed[j * (SAMPLES + 1) + i];
        let least = 1e-6 * (at(SAMPLES, SAMPLES) - at(0, 0)).length();
        let is_between =
            |a: DVec2, m: DVec2, b: DVec2| (m - (a + b) * 0.5).length() <= SMOOTH * (b - a).length() + least;
        let odd = || (1..SAMPLES).step_by(2);
        (0..=SAMPLES).all(|k| {
            odd().all(|i| {
                is_between(at(i - 1, k), at(i, k), at(i + 1, k))
                    && is_between(at(k, i - 1), at(k, i), at(k, i + 1))
            })
        })
    }
}

/// A place in degrees that misses a pole by rounding, or lies beyond it, at the pole.
pub(super) fn on_the_globe(p: DVec2, turn: Option<Turn>) -> DVec2 {
    let Some(turn) = turn else { return p };
    DVec2::new(p.x, p.y.clamp(-turn.pole, turn.pole))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crs::{Crs, PlanSpace};

    /// The horizon in degrees around a place of a plan.
    fn horizon(plan: &str, (x, y): (f64, f64)) -> Option<Region> {
        let plan = PlanSpace::projected(Crs::parse(plan).ok()?).ok()?;
        let map = plan.plan_from(&Crs::crs84().ok()?).ok()?;
        Region::horizon(&map, &PlanBox::around([Plan::new(x, y)]).grown(1000.0), 5000.0)
    }

    #[test]
    fn a_horizon_is_as_far_as_the_projection_can_be_used() {
        let utm = horizon("EPSG:32632", (500_000.0, 5_100_000.0)).unwrap();
        assert_eq!(utm.pole, 0.0);
        assert!(utm.bounds.max.x > 15.0 && utm.bounds.max.x < 99.0 && utm.bounds.max.y < 90.0, "{utm:?}");
        let antarctic = horizon("EPSG:3031", (300_000.0, -500_000.0)).unwrap();
        assert_eq!(antarctic.pole, -1.0);
        assert!(antarctic.bounds.max.y > -70.0 && antarctic.bounds.max.y < 30.0, "{antarctic:?}");
        // Mercator's map goes on over its seam, an equidistant one ends there.
        let mercator = horizon("EPSG:3857", (19_900_000.0, 0.0)).unwrap();
        assert!(mercator.bounds.max.x > 240.0 && mercator.bounds.min.x < 120.0, "{mercator:?}");
        let equidistant = horizon("+proj=eqc +datum=WGS84", (19_900_000.0, 0.0)).unwrap();
        assert!(equidistant.bounds.max.x < 180.0 && equidistant.bounds.min.x < 178.7, "{equidistant:?}");
    }
}
