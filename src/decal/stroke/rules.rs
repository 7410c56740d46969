//! How strokes are joined and ended, and what that says of one segment of a chain.

use super::exact;
use super::kind::{Corner, End};
use crate::decal::Joins;
use crate::predicate::orient2d;
use crate::scene::{Cap, Join, Line, Width};
use crate::space::Plan;
use glam::DVec2;

/// The cosine of 40 degrees: "if two consecutive line segments are at an angle smaller than a predefined angle limit of 40 degrees, [...]
/// the miter corner is replaced by a round corner" (4.2.1).
const COS_40: f64 = 0.766_044_443_118_978;

/// How a stroke's segments are made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrokeRules {
    /// Half the width, metres.
    pub(in crate::decal) half: f64,
    pub(in crate::decal) join: Join,
    pub(in crate::decal) cap: Cap,
    pub(in crate::decal) joins: Joins,
}

impl StrokeRules {
    /// Those of a line; `None` for one whose width is in pixels, which is no static line.
    pub fn of(line: &Line, joins: Joins) -> Option<Self> {
        let Width::Metres(width) = line.width else { return None };
        let cap = if joins == Joins::Thesis { Cap::Round } else { line.cap };
        Some(Self { half: width / 2.0, join: line.join, cap, joins })
    }

    /// How far a stroke reaches from its chain at most, metres.
    pub fn reach(&self) -> f64 {
        let corner = match (self.join, self.joins) {
            // A little more than what 40 degrees reach.
            (Join::Miter { .. }, Joins::Thesis) => 2.93,
            (Join::Miter { limit }, Joins::Style) => limit,
            _ => 1.0,
        };
        // Square caps have corners; the rounding of these few operations is far below this share.
        self.half * crate::math::max(corner, std::f64::consts::SQRT_2) * (1.0 + 1e-9)
    }
}

/// Of the k-th segment of a path of so many vertices, the places of the vertex before it, of that at its end (none of a dot), and of the one after it.
#[inline(always)]
pub(in crate::decal) fn around(vertices: usize, is_closed: bool, k: usize) -> [Option<usize>; 3] {
    let last = vertices - 1;
    let is_ring = is_closed && last > 0;
    let before = if k > 0 { Some(k - 1) } else { is_ring.then(|| last - 1) };
    let to = (k < last).then_some(k + 1);
    let after = if k + 2 <= last { Some(k + 2) } else { is_ring.then_some(1) };
    [before, to, after]
}

/// A segment with what is around it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Link {
    pub(super) before: Option<Plan>,
    pub(super) from: Plan,
    pub(super) to: Plan,
    pub(super) after: Option<Plan>,
}

impl Link {
    /// The k-th of a chain's path.
    pub(super) fn new(path: &[Plan], is_closed: bool, k: usize) -> Self {
        let [before, to, after] = around(path.len(), is_closed, k);
        let there = |place: Option<usize>| place.map(|place| path[place]);
        Self { before: there(before), from: path[k], to: path[to.unwrap_or(k)], after: there(after) }
    }

    /// How its rectangle starts, which is where it meets `before`, and ends.
    pub(super) fn ends(&self, rules: &StrokeRules) -> [End; 2] {
        let end = |neighbour: Option<Plan>| match (neighbour, rules.cap) {
            (Some(_), _) if rules.join == Join::Round => End::Round,
            (Some(_), _) => End::Joined,
            (None, Cap::Butt) => End::Butt,
            (None, Cap::Square) => End::Square,
            (None, Cap::Round) => End::Round,
        };
        [end(self.before), end(self.after)]
    }
}

/// What closes the gap at a vertex, and its side of the way: 1 where it is on the left (the way turns right), -1 where it is on the right.
pub(super) fn corner(before: Plan, at: Plan, after: Plan, rules: &StrokeRules) -> (Corner, f64) {
    if rules.join == Join::Round {
        return (Corner::Round, 0.0);
    }
    let turn = orient2d(before, at, after);
    let (into, leaving) = (at - before, after - at);
    let is_thesis = rules.joins == Joins::Thesis;
    if turn == 0.0 {
        // Exactly on one line: straight on there is no gap ("the gap does not exist", 3.6); straight back the bevel has no area and the
        // miter no end.
        let is_sharp = into.dot(leaving) < 0.0 && is_thesis && rules.join != Join::Bevel;
        return (if is_sharp { Corner::Round } else { Corner::None }, 0.0);
    }
    let outer = if turn > 0.0 { -1.0 } else { 1.0 };
    let corner = match rules.join {
        Join::Miter { .. } if is_thesis => {
            let is_sharp = -into.dot(leaving) > COS_40 * (into.length() * leaving.length());
            if is_sharp { Corner::Round } else { Corner::Miter }
        }
        Join::Miter { limit } if is_within_limit(before, at, after, limit) => Corner::Miter,
        Join::Miter { .. } | Join::Bevel => Corner::Bevel,
        Join::Round => Corner::Round,
    };
    (corner, outer)
}

/// Whether a miter reaches at most `limit` half widths: the square of its reach is 2 / (1 + cos turn).
fn is_within_limit(before: Plan, at: Plan, after: Plan, limit: f64) -> bool {
    let (into, leaving) = (at - before, after - at);
    let (product, lengths) = (into.dot(leaving), (into.length_squared() * leaving.length_squared()).sqrt());
    let square = limit * limit;
    let excess = square * (lengths + product) - 2.0 * lengths;
    // Ten roundings at most on each way to it, the product's terms together at most twice the lengths.
    if excess.abs() > 64.0 * f64::EPSILON * (square + 1.0) * lengths {
        return excess > 0.0;
    }
    exact::is_within_limit(before, at, after, limit)
}

/// The unit vector along a vector, each component good to 6 roundings, and the vector's length, to 3; east for one of no length.
#[inline(always)]
pub(super) fn unit(v: DVec2) -> (DVec2, f64) {
    let length = (v.x * v.x + v.y * v.y).sqrt();
    if length > 0.0 { (v * (1.0 / length), length) } else { (DVec2::X, 0.0) }
}

/// What is left of a direction.
#[inline(always)]
pub(super) fn left(v: DVec2) -> DVec2 {
    DVec2::new(-v.y, v.x)
}
