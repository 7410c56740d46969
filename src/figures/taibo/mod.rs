//! Taibo et al. 2014.

mod joints;
mod landscapes;
mod memory;

use super::figure::Figure;

/// The paper's figures.
pub(super) const FIGURES: &[&Figure] = &[
    &landscapes::FIGURE_1,
    &landscapes::FIGURE_2,
    &landscapes::FIGURE_3,
    &joints::FIGURE_4,
    &joints::FIGURE_5,
    &joints::FIGURE_6,
    &joints::FIGURE_7,
    &joints::FIGURE_8,
    &landscapes::FIGURE_9,
    &memory::FIGURE_10,
];
