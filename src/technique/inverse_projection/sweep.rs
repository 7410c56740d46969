//! She 2016: samples a pixel (3.4) with both kinds of corners (3.2), then how a sample is judged (3.5) and the rest.

use crate::technique::sweep::{Axis, MACHINES, Sweep};

pub(super) const SWEEP: Sweep = Sweep {
    crossed: &[SAMPLES, CORNERS],
    alone: &[POINT_IN_POLYGON, SILHOUETTE, MACHINES],
    remedies: REMEDIES,
};

const SAMPLES: Axis = &[
    &["technique.inverse-projection.samples=1"],
    &["technique.inverse-projection.samples=2"],
    &["technique.inverse-projection.samples=3"],
    &["technique.inverse-projection.samples=4"],
    &["technique.inverse-projection.samples=5"],
    &["technique.inverse-projection.samples=6"],
    &["technique.inverse-projection.samples=7"],
    &["technique.inverse-projection.samples=8"],
];

const CORNERS: Axis = &[
    &["technique.inverse-projection.corners=centres"],
    // A bare `true` would be a truth value.
    &["technique.inverse-projection.corners=\"true\""],
];

const POINT_IN_POLYGON: Axis = &[&["technique.inverse-projection.point_in_polygon=winding"]];

const SILHOUETTE: Axis = &[&["technique.inverse-projection.silhouette=smear"]];

const REMEDIES: Axis = &[
    &["technique.inverse-projection.corners=\"true\""],
    &["technique.inverse-projection.corners=\"true\"", "technique.inverse-projection.samples=16"],
    &["technique.inverse-projection.point_in_polygon=winding"],
    &["technique.inverse-projection.silhouette=smear"],
];
