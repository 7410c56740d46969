//! She et al. 2016.

mod roads;

use super::figure::Figure;

/// The paper's figures.
pub(super) const FIGURES: &[&Figure] = &[&roads::FIGURE_12, &roads::FIGURE_13, &roads::FIGURE_15];
