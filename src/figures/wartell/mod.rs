//! Wartell et al. 2003.

mod borders;
mod quad;

use super::figure::Figure;

/// The paper's figures.
pub(super) const FIGURES: &[&Figure] =
    &[&quad::FIGURE_1, &quad::FIGURE_2, &borders::FIGURE_3, &borders::FIGURE_4];
