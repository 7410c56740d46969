//! She et al. 2016.

mod approaches;
mod areas;
mod quads;
mod roads;
mod rule;
mod sampling;

use super::figure::Figure;

/// The paper's figures.
pub(super) const FIGURES: &[&Figure] = &[
    &approaches::FIGURE_1,
    &sampling::FIGURE_2,
    &quads::FIGURE_3,
    &rule::FIGURE_4,
    &quads::FIGURE_5,
    &quads::FIGURE_6,
    &sampling::FIGURE_7,
    &sampling::FIGURE_8,
    &rule::FIGURE_9,
    &rule::FIGURE_10,
    &roads::FIGURE_12,
    &roads::FIGURE_13,
    &roads::FIGURE_15,
];
