//! What a winding number counts for.

use crate::scene::Rule;

/// How much of an item's paint lies where its winding number is k.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Weight {
    /// 1 inside, 0 outside.
    Rule(Rule),
    /// It is blended k times: as much as once with so many times the coverage.
    Layers {
        /// The paint's alpha; `None`: blending adds.
        alpha: Option<f64>,
    },
}

impl Weight {
    /// The union of an item's pieces.
    pub(super) const UNION: Self = Self::Rule(Rule::NonZero);

    /// The weight of a winding number.
    #[inline(always)]
    pub(super) fn of(self, winding: i32) -> f64 {
        match self {
            Self::Rule(rule) => f64::from(u8::from(rule.contains(winding))),
            Self::Layers { alpha } => match (winding, alpha) {
                (..=0, _) => 0.0,
                (1, _) => 1.0,
                (_, None) => f64::from(winding),
                (_, Some(alpha)) => layers(winding, alpha),
            },
        }
    }
}

impl Weight {
    /// Whether all winding numbers between two have the same weight; false also where that would take long to know.
    pub(super) fn is_alike(self, (least, most): (i32, i32)) -> bool {
        // From 1 on it does not decrease where it is no alternation.
        least > 0 && self != Self::Rule(Rule::EvenOdd) && self.of(least) == self.of(most)
    }
}

/// k times over a ground leaves (1 - alpha)^k of it; the sum of the geometric row is what lies on it.
fn layers(winding: i32, alpha: f64) -> f64 {
    let (mut sum, mut left) = (0.0, 1.0);
    for _ in 0..winding {
        sum += left;
        left *= 1.0 - alpha;
        if left < f64::EPSILON {
            break;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn twice_half_is_as_much_as_three_quarters_of_the_paint() {
        let weight = Weight::Layers { alpha: Some(0.5) };
        assert_eq!([-3, 0, 1, 2, 3].map(|k| 0.5 * weight.of(k)), [0.0, 0.0, 0.5, 0.75, 0.875]);
        let adding = Weight::Layers { alpha: None };
        assert_eq!([0, 1, 2, 3].map(|k| adding.of(k)), [0.0, 1.0, 2.0, 3.0]);
        assert_eq!(Weight::Layers { alpha: Some(1.0) }.of(1_000_000_000), 1.0);
    }
}
