//! Zechmeister 2020.

mod basics;
mod corners;
mod decals;
mod lines;
mod structures;

use super::figure::Figure;

/// The thesis's figures.
pub(super) const FIGURES: &[&Figure] = &[
    &basics::FIGURE_2_4,
    &corners::FIGURE_2_5,
    &basics::FIGURE_2_7,
    &basics::FIGURE_2_9,
    &structures::FIGURE_2_11,
    &structures::FIGURE_2_12,
    &basics::FIGURE_2_14,
    &basics::FIGURE_2_15,
    &decals::FIGURE_3_2,
    &decals::FIGURE_3_3,
    &structures::FIGURE_3_4,
    &lines::FIGURE_3_6,
    &lines::FIGURE_3_7,
    &decals::FIGURE_3_9,
    &corners::FIGURE_3_10,
    &decals::FIGURE_3_11,
    &decals::FIGURE_3_12,
    &lines::FIGURE_4_4,
    &lines::FIGURE_4_7,
    &decals::FIGURE_4_8,
    &decals::FIGURE_4_9,
    &decals::FIGURE_5_11,
];
