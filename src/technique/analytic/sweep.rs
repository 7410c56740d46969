//! Ours: how many parts of triangles and of edges are told apart before a pixel is sampled, and by how many samples.

use crate::technique::sweep::{Axis, Sweep};

pub(super) const SWEEP: Sweep =
    Sweep { crossed: &[], alone: &[FRAGMENTS, CROWD, SAMPLES], remedies: REMEDIES };

const FRAGMENTS: Axis = &[
    &["technique.analytic.fragments=0"],
    &["technique.analytic.fragments=4"],
    &["technique.analytic.fragments=16"],
    &["technique.analytic.fragments=256"],
];

const CROWD: Axis = &[
    &["technique.analytic.crowd=4"],
    &["technique.analytic.crowd=16"],
    &["technique.analytic.crowd=64"],
    &["technique.analytic.crowd=1024"],
];

const SAMPLES: Axis = &[&["technique.analytic.samples=2"], &["technique.analytic.samples=8"]];

/// A pixel that is sampled may be cut, or sampled more densely.
const REMEDIES: Axis = &[
    &["technique.analytic.fragments=256"],
    &["technique.analytic.crowd=1024"],
    &["technique.analytic.samples=8"],
];
