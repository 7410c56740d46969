//! Convex polygons of the screen: cut by lines, taken from one another, measured.
//!
//! They turn as the corners of a pixel do (right, down, left, up): the inside is where the cross product with each side is positive.

use glam::DVec2;

/// What is smaller than this share of a pixel is left out.
pub(super) const NOTHING: f64 = 1e-13;

/// Polygons that reach into one another by no more than this, pixels, do not overlap.
const TOUCH: f64 = 1e-11;

/// Sides shorter than this, pixels, have no direction that could be trusted.
const SHORT: f64 = 1e-9;

/// A line of the screen: the points where `normal . p + offset` is 0; inside is where that is positive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Side {
    pub(super) normal: DVec2,
    pub(super) offset: f64,
}

impl Side {
    /// The side of a polygon from one corner to the next.
    #[inline]
    pub(super) fn between(from: DVec2, to: DVec2) -> Self {
        let normal = (to - from).perp();
        Self { normal, offset: -normal.dot(from) }
    }

    /// Positive inside.
    #[inline(always)]
    pub(super) fn at(&self, p: DVec2) -> f64 {
        self.normal.dot(p) + self.offset
    }

    /// The same line from the other side.
    #[inline]
    pub(super) fn turned(&self) -> Self {
        Self { normal: -self.normal, offset: -self.offset }
    }
}

/// The area of a polygon.
pub(super) fn area(polygon: &[DVec2]) -> f64 {
    let Some(first) = polygon.first() else { return 0.0 };
    let sides = polygon.windows(2).map(|side| (side[0] - *first).perp_dot(side[1] - *first));
    0.5 * sides.sum::<f64>()
}

/// Where a line crosses the way between two points, each with what the line's side says of it.
#[inline]
fn crossing((before, was): (DVec2, f64), (p, is): (DVec2, f64)) -> Option<DVec2> {
    if !((was < 0.0 && is > 0.0) || (was > 0.0 && is < 0.0)) {
        return None;
    }
    // From the same corner whichever side is asked for: neighbours find the same point.
    let is_first = (before.x, before.y) < (p.x, p.y);
    let (a, b, of_a, of_b) = if is_first { (before, p, was, is) } else { (p, before, is, was) };
    Some(a + (b - a) * (of_a / (of_a - of_b)))
}

/// Adds what of a polygon lies inside of a line.
#[inline]
pub(super) fn cut(polygon: &[DVec2], side: &Side, out: &mut Vec<DVec2>) {
    let Some(mut before) = polygon.last().copied() else { return };
    let mut was = side.at(before);
    for &p in polygon {
        let is = side.at(p);
        out.extend(crossing((before, was), (p, is)));
        if is >= 0.0 {
            out.push(p);
        }
        (before, was) = (p, is);
    }
}

/// The sides of a polygon that have a direction.
fn sides(polygon: &[DVec2]) -> impl Iterator<Item = Side> + '_ {
    let ends = polygon.iter().zip(polygon.iter().cycle().skip(1));
    ends.filter(|(a, b)| a.distance_squared(**b) > SHORT * SHORT).map(|(a, b)| Side::between(*a, *b))
}

/// Whether a side of one has all of another outside of it.
fn has_side_between(one: &[DVec2], other: &[DVec2]) -> bool {
    sides(one).any(|side| {
        let limit = TOUCH * side.normal.abs().element_sum();
        other.iter().all(|p| side.at(*p) <= limit)
    })
}

/// Whether two polygons have hardly a point in common.
pub(super) fn are_apart(one: &[DVec2], other: &[DVec2]) -> bool {
    has_side_between(one, other) || has_side_between(other, one)
}

/// What two polygons have in common.
pub(super) fn common(one: &[DVec2], other: &[DVec2]) -> Vec<DVec2> {
    let (mut now, mut next) = (one.to_vec(), Vec::new());
    for side in sides(other) {
        next.clear();
        cut(&now, &side, &mut next);
        std::mem::swap(&mut now, &mut next);
    }
    now
}

/// Divides a polygon into what lies inside of a line and what lies outside of it.
#[inline]
fn divide(polygon: &[DVec2], side: &Side, [inside, outside]: [&mut Vec<DVec2>; 2]) {
    let Some(mut before) = polygon.last().copied() else { return };
    let mut was = side.at(before);
    for &p in polygon {
        let is = side.at(p);
        if let Some(between) = crossing((before, was), (p, is)) {
            inside.push(between);
            outside.push(between);
        }
        if is >= 0.0 {
            inside.push(p);
        }
        if is <= 0.0 {
            outside.push(p);
        }
        (before, was) = (p, is);
    }
}

/// What of a polygon lies outside of another, as convex pieces.
pub(super) fn without(polygon: &[DVec2], hole: &[DVec2], mut piece: impl FnMut(&[DVec2])) {
    let (mut rest, mut next, mut outside) = (polygon.to_vec(), Vec::new(), Vec::new());
    for side in sides(hole) {
        outside.clear();
        next.clear();
        divide(&rest, &side, [&mut next, &mut outside]);
        if area(&outside) > NOTHING {
            piece(&outside);
        }
        std::mem::swap(&mut rest, &mut next);
    }
}

/// Convex pieces of a polygon that loses parts; memory that is used again.
#[derive(Debug, Default)]
pub(super) struct Pieces {
    corners: Vec<DVec2>,
    ends: Vec<usize>,
    /// The same, as they are being made.
    next: (Vec<DVec2>, Vec<usize>),
    room: [Vec<DVec2>; 3],
}

impl Pieces {
    /// A polygon as its only piece.
    pub(super) fn set(&mut self, polygon: &[DVec2]) {
        self.corners.clear();
        self.corners.extend_from_slice(polygon);
        self.ends.clear();
        self.ends.push(polygon.len());
    }

    /// Whether nothing is left.
    pub(super) fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The pieces.
    pub(super) fn rings(&self) -> impl Iterator<Item = &[DVec2]> {
        let mut first = 0;
        self.ends.iter().map(move |end| {
            let ring = &self.corners[first..*end];
            first = *end;
            ring
        })
    }

    /// Takes away what another polygon covers.
    pub(super) fn lose(&mut self, hole: &[DVec2]) {
        let (mut corners, mut ends) = std::mem::take(&mut self.next);
        let [mut rest, mut next, mut outside] = std::mem::take(&mut self.room);
        corners.clear();
        ends.clear();
        let mut keep = |piece: &[DVec2]| {
            corners.extend_from_slice(piece);
            ends.push(corners.len());
        };
        for ring in self.rings() {
            if are_apart(ring, hole) {
                keep(ring);
                continue;
            }
            rest.clear();
            rest.extend_from_slice(ring);
            for side in sides(hole) {
                outside.clear();
                next.clear();
                divide(&rest, &side, [&mut next, &mut outside]);
                if area(&outside) > NOTHING {
                    keep(&outside);
                }
                std::mem::swap(&mut rest, &mut next);
            }
        }
        self.room = [rest, next, outside];
        self.next = (corners, ends);
        std::mem::swap(&mut self.corners, &mut self.next.0);
        std::mem::swap(&mut self.ends, &mut self.next.1);
    }
}

/// Whether a point lies in a polygon.
pub(super) fn holds(polygon: &[DVec2], at: DVec2) -> bool {
    sides(polygon).all(|side| side.at(at) >= 0.0)
}

/// The middle of a polygon's corners.
pub(super) fn middle(polygon: &[DVec2]) -> DVec2 {
    polygon.iter().sum::<DVec2>() / polygon.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn square(x: f64, y: f64, side: f64) -> Vec<DVec2> {
        [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)].map(|(a, b)| DVec2::new(x + a, y + b)).to_vec()
    }

    proptest! {
        #[test]
        fn what_two_have_in_common_and_what_is_left_add_up(
            corners in prop::collection::vec((-0.5..1.5f64, -0.5..1.5f64), 3),
        ) {
            let pixel = square(0.0, 0.0, 1.0);
            let mut triangle: Vec<DVec2> = corners.into_iter().map(DVec2::from).collect();
            if area(&triangle) < 0.0 {
                triangle.reverse();
            }
            let mut left = 0.0;
            without(&pixel, &triangle, |piece| left += area(piece));
            let both = area(&common(&pixel, &triangle));
            prop_assert!((left + both - 1.0).abs() < 1e-12, "{left} {both}");
            prop_assert!(both < 1e-9 || !are_apart(&pixel, &triangle));
            prop_assert!((area(&common(&triangle, &pixel)) - both).abs() < 1e-12);
        }
    }

    #[test]
    fn what_holes_leave_of_a_polygon_adds_up_with_them() {
        let mut pieces = Pieces::default();
        pieces.set(&square(0.0, 0.0, 1.0));
        let left = |pieces: &Pieces| pieces.rings().map(area).sum::<f64>();
        pieces.lose(&square(0.25, 0.25, 0.5));
        assert!((left(&pieces) - 0.75).abs() < 1e-15);
        // Half of it lies in the hole before.
        pieces.lose(&square(0.5, 0.25, 0.5));
        assert!((left(&pieces) - 0.625).abs() < 1e-15);
        pieces.lose(&square(-1.0, -1.0, 3.0));
        assert!(pieces.is_empty());
    }

    #[test]
    fn squares_that_touch_are_apart_and_those_that_overlap_are_not() {
        let one = square(0.0, 0.0, 1.0);
        assert!(are_apart(&one, &square(1.0, 0.5, 1.0)));
        assert!(are_apart(&one, &square(1.0, 1.0, 1.0)));
        assert!(!are_apart(&one, &square(0.999, 0.5, 1.0)));
    }
}
