//! An edge, and the order of places that its ends are in.

use crate::predicate::orient2d;
use crate::space::{Plan, PlanBox};
use std::cmp::Ordering;

/// The order along a line to the east that falls by an infinitesimal slope: what is higher comes later, then what is farther east.
pub(super) fn order(a: Plan, b: Plan) -> Ordering {
    // Both zeros are one place; there is no NaN.
    let by = |p: f64, q: f64| p.partial_cmp(&q).unwrap_or(Ordering::Equal);
    by(a.y, b.y).then(by(a.x, b.x))
}

/// An edge of a member, from its lower end to its upper one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Edge {
    pub(super) member: u32,
    pub(super) low: Plan,
    pub(super) high: Plan,
    /// How often the member's rings run up it, less how often they run down.
    pub(super) turns: i32,
}

impl Edge {
    /// The edge between two vertices; `None` where they are the same.
    pub(super) fn between(member: u32, from: Plan, to: Plan, turns: i32) -> Option<Self> {
        match order(from, to) {
            Ordering::Less => Some(Self { member, low: from, high: to, turns }),
            Ordering::Greater => Some(Self { member, low: to, high: from, turns: -turns }),
            Ordering::Equal => None,
        }
    }

    pub(super) fn bounds(&self) -> PlanBox {
        PlanBox::around([self.low, self.high])
    }

    /// Whether it crosses the line to the east from just above a point, right of all edges that start there; none passes through it.
    pub(super) fn is_east_of(&self, at: Plan) -> bool {
        order(self.low, at).is_le() && order(self.high, at).is_gt() && orient2d(self.low, self.high, at) > 0.0
    }
}
