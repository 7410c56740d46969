//! Zechmeister 2020: simplification (3.3.1) with anti-aliasing (3.5), then thin lines (4.5), boxes (3.3.2) and the rest.

use crate::technique::sweep::{Axis, MACHINES, Sweep};

pub(super) const SWEEP: Sweep = Sweep {
    crossed: &[SIMPLIFICATION, ANTIALIASING],
    alone: &[THIN_LINES, BOXES, CULLING, CORNERS, SORTING, OVERLAPS, L_MAX, MACHINES],
    remedies: REMEDIES,
};

const SIMPLIFICATION: Axis = &[
    &["technique.dynamic-line.simplification=none"],
    &["technique.dynamic-line.simplification=same-pixel"],
    &["technique.dynamic-line.simplification=screen-error", "technique.dynamic-line.error_px=0.25"],
    &["technique.dynamic-line.simplification=screen-error", "technique.dynamic-line.error_px=1"],
];

const ANTIALIASING: Axis = &[
    &["technique.dynamic-line.antialiasing=none"],
    &["technique.dynamic-line.antialiasing=fxaa"],
    &["technique.dynamic-line.antialiasing=analytic"],
];

const THIN_LINES: Axis =
    &[&["technique.dynamic-line.thin_lines=none"], &["technique.dynamic-line.thin_lines=second-depth"]];

const BOXES: Axis =
    &[&["technique.dynamic-line.boxes=overlapping"], &["technique.dynamic-line.boxes=enclosing"]];

const CULLING: Axis = &[&["technique.dynamic-line.culling=boxes"]];

const CORNERS: Axis = &[&["technique.dynamic-line.corners=style"]];

const SORTING: Axis = &[&["technique.dynamic-line.sorting=none"]];

const OVERLAPS: Axis = &[&["technique.dynamic-line.overlaps=double"]];

const L_MAX: Axis = &[&["technique.dynamic-line.l_max=10"], &["technique.dynamic-line.l_max=1000"]];

const REMEDIES: Axis = &[
    &["technique.dynamic-line.antialiasing=none"],
    &["technique.dynamic-line.antialiasing=analytic"],
    &[
        "technique.dynamic-line.boxes=enclosing",
        "technique.dynamic-line.culling=boxes",
        "technique.dynamic-line.simplification=none",
        "technique.dynamic-line.thin_lines=none",
    ],
];
