//! Schneider and Klein 2007.

mod fan;
mod landscapes;
mod sections;

use super::figure::Figure;

/// The paper's figures.
pub(super) const FIGURES: &[&Figure] =
    &[&landscapes::FIGURE_1, &sections::FIGURE_2, &sections::FIGURE_3, &fan::FIGURE_5, &landscapes::FIGURE_6];
