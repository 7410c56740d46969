//! Which vertices of a stroke are one.

use crate::space::Plan;

/// Vertices of a stroke nearer to each other than this are one vertex, metres: far below any width that can be seen, far above
/// the rounding of plan coordinates, so that a duplicate written with an error has no direction of its own.
pub const SAME_VERTEX: f64 = 1e-9;

/// How a stroke ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Ends {
    /// With caps, unless it ends where it begins.
    AsWritten,
    /// It runs back to its start.
    Joined,
}

fn is_same(a: Plan, b: Plan) -> bool {
    (a - b).length() <= SAME_VERTEX
}

/// Whether no vertex of a ring is the same as the next one, the last one's being the first.
pub(super) fn are_distinct(ring: &[Plan]) -> bool {
    let ends = (ring.first(), ring.last());
    !ring.windows(2).any(|pair| is_same(pair[0], pair[1]))
        && !matches!(ends, (Some(first), Some(last)) if is_same(*first, *last))
}

/// Adds the distinct ones of some vertices (at least one), and of a closed stroke the first once more; returns how many there are
/// without that one, and whether it is closed.
pub(super) fn add_distinct(points: &[Plan], ends: Ends, out: &mut Vec<Plan>) -> (u32, bool) {
    let first = out.len();
    for &p in points {
        if out[first..].last().is_none_or(|last| !is_same(*last, p)) {
            out.push(p);
        }
    }
    let start = out[first];
    let count = out.len() - first;
    let back = out[first + 1..].iter().rev().take_while(|p| is_same(**p, start)).count();
    let around = count - back;
    let is_closed = match ends {
        // A line that ends where it begins is a ring (a loop of Taibo 4.2), unless it only runs there and back.
        Ends::AsWritten => back > 0 && around > 2,
        Ends::Joined => around > 1,
    };
    if is_closed || back > 0 {
        // What ends where it begins ends there exactly.
        out.truncate(first + around);
        out.push(start);
    }
    let count = if is_closed { around } else { out.len() - first };
    (count as u32, is_closed)
}
