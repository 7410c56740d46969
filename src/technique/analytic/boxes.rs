//! Boxes of the plan around what is seen, what comes near them, and what convex pieces hold.

use crate::space::{Plan, PlanBox};
use glam::DVec2;

/// A place in a box on which data hardly have an edge.
pub(super) fn odd_place(plan: &PlanBox) -> Plan {
    let size = plan.max - plan.min;
    plan.min + DVec2::new(0.381_966_011_250_105 * size.x, 0.723_606_797_749_979 * size.y)
}

/// A box with what roundings may have left out.
pub(super) fn with_hem(plan: &PlanBox) -> PlanBox {
    let size = plan.max - plan.min;
    plan.grown(1e-6 * (size.x + size.y))
}

/// Whether a line through two points may come nearer to a box than so many metres.
#[inline]
pub(super) fn comes_near([from, to]: [Plan; 2], reach: f64, plan: &PlanBox) -> bool {
    let (normal, half) = ((to - from).perp(), (plan.max - plan.min) * 0.5);
    let to_middle = plan.min + half - from;
    let (across, size) = (normal.x.abs() * half.x + normal.y.abs() * half.y, normal.abs().element_sum());
    let wide = if reach > 0.0 { reach * normal.length() } else { 0.0 };
    // The slack is far above the roundings of these few operations.
    normal.dot(to_middle).abs()
        <= (across + wide) * (1.0 + 1e-9) + 1e-12 * size * to_middle.abs().element_sum()
}

/// The corners of a box.
pub(super) fn corners_of(plan: &PlanBox) -> [Plan; 4] {
    let PlanBox { min, max } = *plan;
    [min, Plan::new(max.x, min.y), max, Plan::new(min.x, max.y)]
}

/// How much of something a convex piece holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Held {
    None,
    Some,
    All,
}

/// How much of a convex polygon a piece holds.
pub(super) fn held(ring: &[Plan], plan: &[Plan]) -> Held {
    let turn: f64 = (2..ring.len()).map(|k| (ring[k - 1] - ring[0]).perp_dot(ring[k] - ring[0])).sum();
    let mut all = turn != 0.0;
    for (k, from) in ring.iter().enumerate() {
        let side = ring[(k + 1) % ring.len()] - *from;
        let values = plan.iter().map(|p| turn.signum() * side.perp_dot(*p - *from));
        let (mut is_apart, mut is_in) = (true, true);
        for value in values {
            is_apart &= value <= 0.0;
            is_in &= value >= 0.0;
        }
        if is_apart && side != DVec2::ZERO {
            return Held::None;
        }
        all &= is_in;
    }
    if all { Held::All } else { Held::Some }
}
