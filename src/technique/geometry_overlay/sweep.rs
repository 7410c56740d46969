//! Wartell et al. 2003: the mesh's screen error (2.1) with lines as OpenGL draws them and with ours; then the share of borrowed quads (3.2.1), filled polygons, polygon offset,
//! the BLG tolerance (3.2.2) and the machine.

use crate::technique::sweep::{Axis, MACHINES, Sweep};

pub(super) const SWEEP: Sweep =
    Sweep { crossed: &[LINES, WIDTHS], alone: &[POLYGONS, OFFSET, TOLERANCE, MACHINES], remedies: REMEDIES };

const LINES: Axis =
    &[&["technique.geometry-overlay.lines=gl"], &["technique.geometry-overlay.lines=antialiased"]];

const WIDTHS: Axis =
    &[&["technique.geometry-overlay.widths=style"], &["technique.geometry-overlay.widths=one"]];

const POLYGONS: Axis =
    &[&["technique.geometry-overlay.polygons=filled"], &["technique.geometry-overlay.polygons=antialiased"]];

const OFFSET: Axis = &[
    &["technique.geometry-overlay.offset_factor=0", "technique.geometry-overlay.offset_units=0"],
    &["technique.geometry-overlay.offset_factor=4", "technique.geometry-overlay.offset_units=4"],
];

const TOLERANCE: Axis =
    &[&["technique.geometry-overlay.tolerance_px=0.5"], &["technique.geometry-overlay.tolerance_px=2"]];

const REMEDIES: Axis = &[
    &["technique.geometry-overlay.polygons=filled"],
    &["technique.geometry-overlay.lines=antialiased"],
    &["technique.geometry-overlay.offset_factor=4"],
];
