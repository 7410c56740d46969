//! Discs and their sectors by chords. Where half the width is linear in the plan a "disc" is a conic around a focus: the points as far from
//! it as half the width is where they are.

use super::{HalfWidth, Near, Pieces};
use crate::math;
use crate::space::Plan;
use glam::DVec2;
use std::f64::consts::{PI, TAU};

/// Which part of a disc.
#[derive(Debug, Clone, Copy)]
pub(super) enum Sector {
    /// All.
    Whole,
    /// From a direction on, counter-clockwise, by an angle of at most half a turn.
    Part { start: DVec2, angle: f64 },
}

/// The most chords of one piece.
const MOST: f64 = 4096.0;

/// The longest chord, radians: the vertices of longer ones would be farther out than a sagitta.
const LONGEST: f64 = PI / 4.0;

/// So near to what matters, in radii of that, no sector of it is cut out.
const BESIDE: f64 = 1.05;

/// Adds what of a sector is near, as one piece.
pub(super) fn add(at: Plan, sector: Sector, half: &HalfWidth, near: &Near, out: &mut Pieces) {
    let steep = half.gradient.length();
    let (least, most) = (half.of(at) / (1.0 + steep), half.of(at) / (1.0 - steep));
    let (to, radius) = (near.middle() - at, near.radius());
    let distance = to.length();
    // What an area-preserving chord is off is less than its sagitta.
    if least.is_nan() || least <= 0.0 || distance - radius > most + near.sagitta {
        return;
    }
    if matches!(sector, Sector::Whole) && distance + radius < least - near.sagitta {
        let around = near.plan.grown(2.0 * radius);
        let corners = [around.min, Plan::new(around.max.x, around.min.y), around.max];
        return out.add(corners.into_iter().chain([Plan::new(around.min.x, around.max.y)]), near);
    }
    let Some((start, angle)) = seen((to, distance, radius), sector) else { return };
    // A chord of an angle is off by 1 - cos(angle / 2) = 2 sin(angle / 4)^2 of the radius.
    let chord = 4.0 * math::asin(math::min(near.sagitta / (2.0 * most), 0.5).sqrt());
    let count = math::min((angle / math::min(chord, LONGEST)).ceil(), MOST) as usize;
    let count = count.max(1);
    let step = angle / count as f64;
    // Vertices so far out that the polygon has the disc's area: pixels along the border then have theirs.
    let out_by = (step / math::sin(step)).sqrt();
    let (sine, cosine) = (math::sin(step), math::cos(step));
    let is_whole = angle >= TAU;
    let mut direction = start;
    let arc = (0..count + usize::from(!is_whole)).map(move |_| {
        let here = at + direction * (half.reach(at, direction) * out_by);
        direction =
            DVec2::new(direction.x * cosine - direction.y * sine, direction.x * sine + direction.y * cosine);
        here
    });
    out.add((!is_whole).then_some(at).into_iter().chain(arc), near);
}

/// The directions of a sector in which what matters is seen from its middle: the first one, and the angle. `None`: there are none.
fn seen((to, distance, radius): (DVec2, f64, f64), sector: Sector) -> Option<(DVec2, f64)> {
    let is_apart = distance > BESIDE * radius;
    let spread = if is_apart { math::asin(radius / distance) } else { 0.0 };
    match sector {
        Sector::Whole if is_apart => Some((turned(to / distance, -spread), 2.0 * spread)),
        Sector::Whole => Some((DVec2::X, TAU)),
        Sector::Part { start, angle } if is_apart => {
            let middle = math::atan2(start.perp_dot(to), start.dot(to));
            // At most one of these meets the sector: the rest of the turn is wider than what is seen.
            [middle, middle + TAU].into_iter().find_map(|middle| {
                let (first, last) = (math::max(middle - spread, 0.0), math::min(middle + spread, angle));
                (first < last).then(|| (turned(start, first), last - first))
            })
        }
        Sector::Part { start, angle } => (angle > 0.0).then_some((start, angle)),
    }
}

fn turned(v: DVec2, by: f64) -> DVec2 {
    let (sine, cosine) = (math::sin(by), math::cos(by));
    DVec2::new(v.x * cosine - v.y * sine, v.x * sine + v.y * cosine)
}
