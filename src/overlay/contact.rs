//! Where two edges meet.

use super::edge::{Edge, order};
use crate::math::{max, min};
use crate::predicate::orient2d;
use crate::space::Plan;

/// What two edges share.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Contact {
    /// An end of both, or no more than that.
    Ends,
    /// They cross at a point, rounded.
    Crossing(Plan),
    /// Ends of one lie inside the other.
    Touch {
        /// Those of the second that lie in the first.
        in_first: [Option<Plan>; 2],
        /// Those of the first that lie in the second.
        in_second: [Option<Plan>; 2],
    },
}

/// What two edges share; `None`: nothing.
pub(super) fn contact(a: &Edge, b: &Edge) -> Option<Contact> {
    let sides = |edge: &Edge, of: &Edge| {
        [orient2d(edge.low, edge.high, of.low), orient2d(edge.low, edge.high, of.high)]
    };
    let is_apart = |[p, q]: [f64; 2]| (p > 0.0 && q > 0.0) || (p < 0.0 && q < 0.0);
    let (of_a, of_b) = (sides(b, a), sides(a, b));
    if is_apart(of_a) || is_apart(of_b) {
        return None;
    }
    if of_a.iter().chain(&of_b).all(|side| *side != 0.0) {
        return Some(Contact::Crossing(crossing(a, b, of_a)));
    }
    let within = |edge: &Edge, [low, high]: [f64; 2], of: &Edge| {
        let is_in = |p: Plan| order(edge.low, p).is_lt() && order(p, edge.high).is_lt();
        [(low, of.low), (high, of.high)].map(|(side, p)| Some(p).filter(|p| side == 0.0 && is_in(*p)))
    };
    let (in_first, in_second) = (within(a, of_b, b), within(b, of_a, a));
    if in_first.iter().chain(&in_second).any(Option::is_some) {
        return Some(Contact::Touch { in_first, in_second });
    }
    let ends = [a.low, a.high];
    (ends.contains(&b.low) || ends.contains(&b.high)).then_some(Contact::Ends)
}

/// Where two edges cross, of which the first one's ends have these sides of the second: in the boxes of both.
fn crossing(a: &Edge, b: &Edge, [low, high]: [f64; 2]) -> Plan {
    let p = a.low + (a.high - a.low) * (low / (low - high));
    let (a, b) = (a.bounds(), b.bounds());
    let clamped = |v: f64, low: f64, high: f64| max(min(v, high), low);
    Plan::new(
        clamped(p.x, max(a.min.x, b.min.x), min(a.max.x, b.max.x)),
        clamped(p.y, max(a.min.y, b.min.y), min(a.max.y, b.max.y)),
    )
}
