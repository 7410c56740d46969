//! How many times as high as they are heights are drawn.

use super::heights::heights;
use crate::cli::new::rounding::two_digits;
use drapery::math::{max, min};
use drapery::space::{PlanBox, World};

/// Relief of a smaller share of the terrain's longer side looks flat...
const FLAT: f64 = 0.02;
/// ... and is raised to about this.
const RAISED: f64 = 0.05;
/// Heights are drawn so many times as high at most.
const MOST_EXAGGERATED: f64 = 50.0;
/// Relief of a greater share, which no mountainside has (a steep one has half), is that of a plan which is not in metres...
const STEEP: f64 = 1.0;
/// ... and is lowered to about this.
const LOWERED: f64 = 0.2;

/// The relief as a multiple of the longer side of the plan.
pub(super) fn steepness(points: &[World]) -> f64 {
    let size = PlanBox::around(points.iter().map(|p| p.plan()));
    let size = size.max - size.min;
    let [low, high] = heights(points);
    let extent = max(size.x, size.y);
    if extent > 0.0 { (high - low) / extent } else { 0.0 }
}

/// How many times as high heights are to be drawn: 1, but on flat land, and where the plan is not in metres.
pub(super) fn exaggeration(steepness: f64, is_to_scale: bool) -> f64 {
    if steepness > STEEP && !is_to_scale {
        return two_digits(LOWERED / steepness);
    }
    if steepness <= 1e-6 || steepness >= FLAT {
        return 1.0;
    }
    let wanted = min(RAISED / steepness, MOST_EXAGGERATED);
    let steps = [2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 15.0, 20.0, 30.0, 40.0, 50.0];
    steps.into_iter().rev().find(|step| *step <= wanted).unwrap_or(2.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heights_are_lowered_where_the_plan_is_not_in_metres() {
        assert_eq!(exaggeration(7.3, false), 0.027);
        assert_eq!([exaggeration(7.3, true), exaggeration(0.51, false)], [1.0, 1.0]);
    }
}
