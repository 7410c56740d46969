//! The fragment: a convex polygon, and what of an edge lies in it.

use super::Part;
use glam::DVec2;

/// Shorter sides of a piece, in pixels, may have any direction: their ends are rounded.
const SHORT: f64 = 1e-6;

/// Corners nearer to one another, in pixels, are one.
const SAME: f64 = 1e-9;

/// A convex polygon that turns so that what is inside lies on the left of its sides.
#[derive(Debug, Default)]
pub(super) struct Convex {
    corners: Vec<DVec2>,
    area: f64,
}

impl Convex {
    pub(super) fn set(&mut self, corners: &[DVec2]) {
        let twice = twice_area(corners);
        self.area = 0.5 * twice.abs();
        self.corners.clear();
        // A side that is hardly longer than roundings has any direction, and its line would cut off what it should not.
        let long = |a: DVec2, b: DVec2| a.distance_squared(b) > SAME * SAME;
        let ends = corners.iter().zip(corners.iter().cycle().skip(1));
        self.corners.extend(ends.filter(|(a, b)| long(**a, **b)).map(|(a, _)| *a));
        if self.corners.len() < 3 {
            self.corners.clear();
            self.corners.extend_from_slice(corners);
        }
        if twice < 0.0 {
            self.corners.reverse();
        }
    }

    pub(super) fn corners(&self) -> &[DVec2] {
        &self.corners
    }

    pub(super) fn area(&self) -> f64 {
        self.area
    }

    /// A side's ends.
    pub(super) fn side(&self, k: usize) -> (DVec2, DVec2) {
        let next = if k + 1 < self.corners.len() { k + 1 } else { 0 };
        (self.corners[k], self.corners[next])
    }

    /// Whether all of it lies on the right of a line, or on it; false where two points are too near to tell their line's direction.
    pub(super) fn is_right_of(&self, line: (DVec2, DVec2)) -> bool {
        (line.1 - line.0).length_squared() > SHORT * SHORT
            && self.corners.iter().all(|corner| beside(line, *corner) <= 0.0)
    }

    /// Whether the boxes around it and a ring have nothing in common.
    pub(super) fn is_apart_from(&self, ring: &[DVec2]) -> bool {
        let ([low, high], [from, to]) = (bounds(&self.corners), bounds(ring));
        high.x < from.x || to.x < low.x || high.y < from.y || to.y < low.y
    }

    /// What of an edge lies in it, in the edge's direction (Cyrus & Beck's way of clipping); a point where it only touches the border.
    pub(super) fn cut(&self, from: DVec2, to: DVec2) -> Option<Part> {
        let (mut start, mut end) = ((0.0, None), (1.0, None));
        for k in 0..self.corners.len() {
            let side = self.side(k);
            let (a, b) = (beside(side, from), beside(side, to));
            // An edge's end is in or out by the same bits for both edges that meet there.
            match (a >= 0.0, b >= 0.0) {
                (true, true) => {}
                (false, false) => return None,
                (false, true) => {
                    let at = a / (a - b);
                    if at > start.0 || start.1.is_none() {
                        start = (at, Some(k as u8));
                    }
                }
                (true, false) => {
                    let at = a / (a - b);
                    if at < end.0 || end.1.is_none() {
                        end = (at, Some(k as u8));
                    }
                }
            }
        }
        let point = |(at, side): (f64, Option<u8>), own: DVec2| match side {
            Some(_) => from + (to - from) * at,
            None => own,
        };
        (start.0 <= end.0).then(|| Part {
            from: point(start, from),
            to: point(end, to),
            enters: start.1,
            leaves: end.1,
            counter: 0,
        })
    }
}

/// Twice the area on the left of a line's direction that it and a point span.
#[inline(always)]
pub(super) fn beside((a, b): (DVec2, DVec2), p: DVec2) -> f64 {
    (b - a).perp_dot(p - a)
}

/// The least and the most of each coordinate.
fn bounds(points: &[DVec2]) -> [DVec2; 2] {
    let none = [DVec2::INFINITY, DVec2::NEG_INFINITY];
    points.iter().fold(none, |[low, high], p| [low.min(*p), high.max(*p)])
}

/// Twice a polygon's area, negative if it turns the other way.
pub(super) fn twice_area(corners: &[DVec2]) -> f64 {
    let first = corners.first().copied().unwrap_or_default();
    corners.windows(2).map(|pair| (pair[0] - first).perp_dot(pair[1] - first)).sum()
}

/// Whether a ring encloses a place that is clear of it: a ray crosses it an odd number of times.
pub(super) fn holds(ring: &[DVec2], at: DVec2) -> bool {
    let mut is_in = false;
    for k in 0..ring.len() {
        let (a, b) = (ring[k], ring[(k + 1) % ring.len()]);
        if (a.y <= at.y) != (b.y <= at.y) {
            let is_left = beside((a, b), at) > 0.0;
            is_in ^= is_left == (a.y <= at.y);
        }
    }
    is_in
}
