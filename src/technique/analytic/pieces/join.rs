//! What is between the ends of two segments.

use super::round::{self, Sector};
use super::{HalfWidth, Near, Pieces, Segment};
use crate::math;
use crate::predicate::orient2d;
use crate::space::Plan;
use glam::DVec2;

/// Both directions at a join and their normals on the outer side of the turn; `None` where it goes straight on or straight back.
fn outer(before: Plan, segment: &Segment) -> Option<[DVec2; 4]> {
    let turn = orient2d(before, segment.from, segment.to);
    if turn == 0.0 {
        return None;
    }
    let directions = [segment.from - before, segment.to - segment.from].map(|v| v / v.length());
    let normals = directions.map(|d| if turn > 0.0 { -d.perp() } else { d.perp() });
    Some([directions[0], directions[1], normals[0], normals[1]])
}

/// Whether all of a disc's half that lies along a segment of this length is beside the segment.
pub(super) fn is_long(length: f64, at: Plan, half: &HalfWidth) -> bool {
    length * (1.0 - half.gradient.length()) >= half.of(at)
}

/// A round join: the sector between both strokes' corners, or the disc where a segment is too short to hold the rest of it.
pub(super) fn round(before: Plan, segment: &Segment, half: &HalfWidth, near: &Near, out: &mut Pieces) {
    let at = segment.from;
    let lengths = [at - before, segment.to - at].map(DVec2::length);
    let is_long = lengths.iter().all(|length| is_long(*length, at, half));
    let sector = match outer(before, segment) {
        Some([_, _, n1, n2]) if is_long => {
            let (cross, dot) = (n1.perp_dot(n2), n1.dot(n2));
            let start = if cross > 0.0 { n1 } else { n2 };
            Sector::Part { start, angle: math::atan2(cross.abs(), dot) }
        }
        None if is_long && (segment.to - at).dot(at - before) > 0.0 => return,
        _ => Sector::Whole,
    };
    round::add(at, sector, half, near, out);
}

/// A miter within its limit, or a bevel.
pub(super) fn sharp(
    before: Plan,
    segment: &Segment,
    limit: Option<f64>,
    half: &HalfWidth,
    near: &Near,
    out: &mut Pieces,
) {
    let Some([d1, d2, n1, n2]) = outer(before, segment) else { return };
    let (at, half) = (segment.from, half.of(segment.from));
    let cosine = d1.dot(d2);
    let corners = [at + n1 * half, at + n2 * half];
    // The ratio of miter length to width is 1 / cos(turn / 2), its square 2 / (1 + cos turn).
    if limit.is_some_and(|limit| (1.0 + cosine) * limit * limit > 2.0) {
        let tip = at + (n1 + n2) * (half / (1.0 + cosine));
        out.add([at, corners[0], tip, corners[1]], near);
    } else {
        out.add([at, corners[0], corners[1]], near);
    }
}
