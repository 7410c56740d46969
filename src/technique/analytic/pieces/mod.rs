//! Strokes as convex pieces of the plan, near a fragment.
//!
//! Input: a segment of a chain with the vertex before it, how its line is drawn, half its width there, the box around the fragment in the
//! plan. Output: convex rings whose union is, in the box, what `docs/semantics.md` says of the stroke, but for round parts, whose chords
//! are off by no more than a bound. Beyond the box rings may end anywhere. Refuses (`false`): widths that grow faster than half of the
//! distance.

mod join;
mod round;

use crate::math;
use crate::scene::{Cap, Join, Line, Width};
use crate::space::{Plan, PlanBox};
use glam::DVec2;
use round::Sector;

/// A segment of a stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// The vertex before it; `None` at a line's start.
    pub before: Option<Plan>,
    /// Where it starts.
    pub from: Plan,
    /// Where it ends; where it starts for a line of one point.
    pub to: Plan,
    /// Whether the line ends with it.
    pub is_last: bool,
}

/// Half of a stroke's width, metres: linear in the plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfWidth {
    /// A place.
    pub at: Plan,
    /// Half the width there.
    pub half: f64,
    /// Its change, metres a metre: 0 of lines whose width is in metres.
    pub gradient: DVec2,
}

impl HalfWidth {
    /// At a place.
    pub fn of(&self, p: Plan) -> f64 {
        self.half + self.gradient.dot(p - self.at)
    }

    /// How far in a direction from a place the points are that are as far from it as half the width is where they are.
    fn reach(&self, from: Plan, direction: DVec2) -> f64 {
        self.of(from) / (1.0 - self.gradient.dot(direction))
    }
}

/// Where pieces are wanted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Near {
    /// All of the plan that matters.
    pub plan: PlanBox,
    /// How far a chord of a round part may be off, metres.
    pub sagitta: f64,
}

impl Near {
    fn middle(&self) -> Plan {
        self.plan.min + (self.plan.max - self.plan.min) * 0.5
    }

    /// Half of its box's diagonal, and a little more; of a place that is a point, as little as nobody sees.
    fn radius(&self) -> f64 {
        let half = 0.5 * (self.plan.max - self.plan.min).length() * (1.0 + 1e-6);
        math::max(half, self.sagitta)
    }
}

/// Convex rings, one after the other.
#[derive(Debug, Default)]
pub struct Pieces {
    corners: Vec<Plan>,
    ends: Vec<u32>,
}

impl Pieces {
    /// Empties it.
    pub fn clear(&mut self) {
        self.corners.clear();
        self.ends.clear();
    }

    /// The rings, of either turn.
    pub fn rings(&self) -> impl Iterator<Item = &[Plan]> {
        let mut first = 0;
        self.ends.iter().map(move |end| {
            let ring = &self.corners[first..*end as usize];
            first = *end as usize;
            ring
        })
    }

    /// Adds a ring if it comes near.
    fn add(&mut self, ring: impl IntoIterator<Item = Plan>, near: &Near) {
        let first = self.corners.len();
        self.corners.extend(ring);
        if PlanBox::around(self.corners[first..].iter().copied()).meets(&near.plan) {
            self.ends.push(self.corners.len() as u32);
        } else {
            self.corners.truncate(first);
        }
    }
}

/// Widths that grow faster are refused, metres a metre.
const STEEPEST: f64 = 0.5;

/// Adds the pieces of a segment's stroke, with the join at its start and the caps at its ends. False: the width grows too fast.
pub fn stroke_pieces(
    segment: &Segment,
    line: &Line,
    half: &HalfWidth,
    near: &Near,
    out: &mut Pieces,
) -> bool {
    if half.gradient.length() > STEEPEST {
        return false;
    }
    let (is_round, cap) = match line.width {
        // All points near the centre line: caps and joins are round by definition.
        Width::Pixels(_) => (true, Cap::Round),
        Width::Metres(_) => (line.join == Join::Round, line.cap),
    };
    let stroke = Stroke { segment, half, near };
    if segment.from == segment.to {
        match cap {
            Cap::Butt => {}
            Cap::Square => stroke.dot(out),
            Cap::Round => round::add(segment.from, Sector::Whole, half, near, out),
        }
        return true;
    }
    stroke.body(cap, out);
    if cap == Cap::Round {
        if segment.before.is_none() {
            stroke.round_cap(segment.from, segment.from - segment.to, out);
        }
        if segment.is_last {
            stroke.round_cap(segment.to, segment.to - segment.from, out);
        }
    }
    if let Some(before) = segment.before {
        match line.join {
            _ if is_round => join::round(before, segment, half, near, out),
            Join::Round | Join::Bevel => join::sharp(before, segment, None, half, near, out),
            Join::Miter { limit } => join::sharp(before, segment, Some(limit), half, near, out),
        }
    }
    true
}

/// A box around all that a segment's stroke covers where half its width is at most `most`, metres.
pub fn segment_box(segment: &Segment, line: &Line, most: f64) -> PlanBox {
    let share = match (line.width, line.join) {
        (Width::Pixels(_), _) => 1.0,
        (Width::Metres(_), Join::Miter { limit }) => math::max(limit, std::f64::consts::SQRT_2),
        (Width::Metres(_), _) => std::f64::consts::SQRT_2,
    };
    // Far more than rounding.
    PlanBox::around([segment.from, segment.to]).grown(most * share * (1.0 + 1e-9) + 1e-9)
}

/// A segment, how wide it is, and where.
struct Stroke<'s> {
    segment: &'s Segment,
    half: &'s HalfWidth,
    near: &'s Near,
}

impl Stroke<'_> {
    /// What lies beside the segment, with square caps.
    fn body(&self, cap: Cap, out: &mut Pieces) {
        let Segment { before, from, to, is_last } = *self.segment;
        let length = (to - from).length();
        let along = (to - from) / length;
        let more = |is_end: bool| if is_end && cap == Cap::Square { self.half.of(from) } else { 0.0 };
        let (mut start, mut end) = (-more(before.is_none()), length + more(is_last));
        // Not much more than is near: of a long segment all else is far off the picture.
        let (middle, radius) = ((self.near.middle() - from).dot(along), 2.0 * self.near.radius());
        start = math::max(start, middle - radius);
        end = math::min(end, middle + radius);
        // Where a width that is linear near the fragment falls to nothing, there is no stroke beyond.
        let (at_start, growth) = (self.half.of(from), self.half.gradient.dot(along));
        if growth > 0.0 {
            start = math::max(start, -at_start / growth);
        } else if growth < 0.0 {
            end = math::min(end, -at_start / growth);
        } else if at_start <= 0.0 {
            return;
        }
        if start >= end {
            return;
        }
        let left = along.perp();
        let (a, b) = (from + along * start, from + along * end);
        let corner = |at: Plan, aside: DVec2| at + aside * math::max(self.half.reach(at, aside), 0.0);
        out.add([corner(a, -left), corner(b, -left), corner(b, left), corner(a, left)], self.near);
    }

    /// The square of a line that has no direction.
    fn dot(&self, out: &mut Pieces) {
        let (at, half) = (self.segment.from, self.half.of(self.segment.from));
        let corner = |x: f64, y: f64| at + DVec2::new(x, y) * half;
        out.add([corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)], self.near);
    }

    /// A round cap: the half of a disc, or all of it where the segment is too short to hold the rest.
    fn round_cap(&self, at: Plan, outwards: DVec2, out: &mut Pieces) {
        let length = outwards.length();
        let sector = match join::is_long(length, at, self.half) {
            true => Sector::Part { start: (outwards / length).perp() * -1.0, angle: std::f64::consts::PI },
            false => Sector::Whole,
        };
        round::add(at, sector, self.half, self.near, out);
    }
}

#[cfg(test)]
mod tests;
