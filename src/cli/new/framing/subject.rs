//! What is worth seeing of a terrain.

use drapery::math::max;
use drapery::scene::Feature;
use drapery::space::{Plan, PlanBox};

/// Layers whose box has a smaller share of the terrain's longer side are looked at from near.
const NEAR: f64 = 0.4;
/// Then so much of their box's longer side is seen around them.
const AROUND: f64 = 0.15;
/// The least share of the terrain that is seen.
const LEAST: f64 = 1.0 / 32.0;

/// What is worth seeing: the terrain, or the layers and a little around them where they lie in a small part of it.
pub(super) fn subject<'a>(whole: &PlanBox, features: impl Iterator<Item = &'a Feature>) -> PlanBox {
    let (low, high) = (whole.min.to_vec(), whole.max.to_vec());
    let mut seen = PlanBox::EMPTY;
    for feature in features {
        let of = PlanBox::around(feature.shape.parts().flatten().copied());
        if of.meets(whole) {
            seen.include(Plan::from(of.min.to_vec().clamp(low, high)));
            seen.include(Plan::from(of.max.to_vec().clamp(low, high)));
        }
    }
    let longer = |bounds: &PlanBox| {
        let size = bounds.max - bounds.min;
        max(size.x, size.y)
    };
    if seen.is_empty() || longer(&seen) > NEAR * longer(whole) {
        return *whole;
    }
    let lacking = max(longer(whole) * LEAST - longer(&seen), 0.0);
    let seen = seen.grown(max(0.5 * lacking, AROUND * longer(&seen)));
    PlanBox {
        min: Plan::from(seen.min.to_vec().clamp(low, high)),
        max: Plan::from(seen.max.to_vec().clamp(low, high)),
    }
}
