//! The usual comparators of a picture with the expected one, at their usual settings.

mod fuzzy;
mod pixelmatch;

use super::edit::Picture;
use crate::report;

/// Their names, in the order of [`passed`].
pub(super) const NAMES: [&str; 4] = ["+-1 code", "pixelmatch", "FLIP", "dEQP fuzzy"];

/// A mean of FLIP up to which a picture passes.
const FLIP_MEAN: f64 = 0.01;

/// Which of them take a picture for the expected one.
pub(super) fn passed(expected: &Picture, actual: &Picture) -> [bool; 4] {
    let most = expected.values().iter().flatten().zip(actual.values().iter().flatten());
    let most = most.map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0);
    [
        most <= 1,
        pixelmatch::differing(expected, actual) == 0,
        report::flip(expected, actual).is_some_and(|mean| mean <= FLIP_MEAN),
        fuzzy::error(expected, actual) <= fuzzy::THRESHOLD,
    ]
}
