//! This program's own figures: the truth, and how far techniques are from it.

mod errors;
mod intervals;

use super::figure::Figure;

/// The figures.
pub(super) const FIGURES: &[&Figure] =
    &[&intervals::INTERVALS, &errors::TECHNIQUES, &errors::SAMPLES, &errors::MACHINES];
