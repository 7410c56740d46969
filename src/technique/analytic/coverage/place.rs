//! A place that is clear of all edges.

use super::Part;
use super::convex::Convex;
use crate::math;
use glam::DVec2;

/// How far, in pixels, a place must be from edges: far beyond the rounding of places and edges.
const CLEAR: f64 = 1e-9;

/// A fragment of a smaller area may be told wrong: nobody sees it.
const NO_MATTER: f64 = 1e-10;

/// How far places lie from the fragment's middle towards its corners. Many and irregular: edges that meet in one point, or a grid of
/// them, leave some of them clear.
const TOWARDS: [f64; 4] = [0.5, 0.83, 0.27, 0.671];

/// A place in a fragment as far from its edges as a few tries find.
pub(super) fn clear_of(fragment: &Convex, parts: &[Part]) -> Option<DVec2> {
    let corners = fragment.corners();
    let middle = corners.iter().sum::<DVec2>() / corners.len() as f64;
    // Half of what so many edges leave free if they are spread out.
    let size = fragment.area().sqrt();
    let enough = 0.125 * size / (1 + parts.len()) as f64;
    let (mut best, mut clearance) = (middle, -1.0);
    let tries = TOWARDS.iter().flat_map(|share| (0..corners.len()).map(move |k| (k, *share)));
    let towards = tries.map(|(k, share)| {
        // Not on the fragment's diagonals and middle lines.
        let (a, b) = fragment.side(k);
        middle + (a + (b - a) * (0.37 * share) - middle) * share
    });
    for at in std::iter::once(middle).chain(towards) {
        let squared =
            parts.iter().fold(f64::INFINITY, |least, part| math::min(distance_squared(part, at), least));
        if squared > clearance {
            (best, clearance) = (at, squared);
        }
        if squared > enough * enough {
            break;
        }
    }
    (clearance > CLEAR * CLEAR || fragment.area() < NO_MATTER).then_some(best)
}

/// The square of a place's distance from a part of an edge.
fn distance_squared(part: &Part, at: DVec2) -> f64 {
    let (along, to) = (part.to - part.from, at - part.from);
    let squared = along.length_squared();
    let share = if squared > 0.0 { (to.dot(along) / squared).clamp(0.0, 1.0) } else { 0.0 };
    (to - along * share).length_squared()
}
