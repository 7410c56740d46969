//! Boxes of the plan around what is seen, and what comes near them.

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
    let middle = plan.min + half;
    let away = normal.dot(middle - from).abs();
    let across = normal.x.abs() * half.x + normal.y.abs() * half.y;
    // The slack is far above the roundings of these few operations.
    away <= (across + reach * normal.length()) * (1.0 + 1e-9)
        + 1e-12 * normal.length() * (middle - from).length()
}
