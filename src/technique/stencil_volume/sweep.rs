//! Schneider & Klein 2007: samples a pixel (theirs is one) without joins, as in the paper, and with the style's; then how volumes are
//! counted (3.1, 4.2.1), what shares a mask (4.2.2), and the machine's stencil and depth.

use crate::technique::sweep::{Axis, MACHINES, Sweep};

pub(super) const SWEEP: Sweep = Sweep {
    crossed: &[SAMPLES, JOINS],
    alone: &[METHOD, GROUPING, STENCIL, DEPTH, MACHINES],
    remedies: REMEDIES,
};

const SAMPLES: Axis = &[
    &["technique.stencil-volume.samples=1"],
    &["technique.stencil-volume.samples=2"],
    &["technique.stencil-volume.samples=3"],
    &["technique.stencil-volume.samples=4"],
    &["technique.stencil-volume.samples=8"],
];

const JOINS: Axis = &[&["technique.stencil-volume.joins=none"], &["technique.stencil-volume.joins=style"]];

const METHOD: Axis =
    &[&["technique.stencil-volume.method=z-pass"], &["technique.stencil-volume.method=z-fail"]];

const GROUPING: Axis = &[&["technique.stencil-volume.grouping=color"]];

const STENCIL: Axis = &[
    &["device.stencil_bits=4"],
    &["device.stencil_bits=4", "technique.stencil-volume.overflow=saturate"],
    &["device.stencil_bits=16"],
];

const DEPTH: Axis = &[&["device.depth=f32"], &["device.depth=unorm24"], &["device.depth=unorm16"]];

const REMEDIES: Axis = &[
    &["technique.stencil-volume.samples=4"],
    &["technique.stencil-volume.samples=4", "technique.stencil-volume.joins=style"],
];
