//! Zechmeister 2020: samples a pixel (4.5), with the thesis's joins and ends and with the style's; then the structures (5.2.3), whose pictures are the
//! same, what the thesis leaves open, and the machine.

use crate::technique::sweep::{Axis, MACHINES, Sweep};

pub(super) const SWEEP: Sweep = Sweep {
    crossed: &[SAMPLES, JOINS],
    alone: &[GRID, LEAF_CAPACITY, DEPTH, HIERARCHY, EDGES, MACHINES],
    remedies: REMEDIES,
};

const SAMPLES: Axis = &[
    &["technique.static-decal.samples=1"],
    &["technique.static-decal.samples=4"],
    &["technique.static-decal.samples=8"],
    &["technique.static-decal.samples=16"],
    &["technique.static-decal.samples=64"],
];

const JOINS: Axis = &[
    &["technique.static-decal.joins=thesis"],
    &["technique.static-decal.joins=style", "technique.static-decal.outlines=polygon"],
];

const GRID: Axis = &[&["technique.static-decal.grid=125"], &["technique.static-decal.grid=1000"]];

const LEAF_CAPACITY: Axis =
    &[&["technique.static-decal.leaf_capacity=2"], &["technique.static-decal.leaf_capacity=32"]];

const DEPTH: Axis = &[&["technique.static-decal.depth=4"], &["technique.static-decal.depth=16"]];

const HIERARCHY: Axis =
    &[&["technique.static-decal.hierarchy=wide"], &["technique.static-decal.hierarchy=curve"]];

const EDGES: Axis = &[&["technique.static-decal.edges=analytic"]];

const REMEDIES: Axis = &[
    &["technique.static-decal.samples=256"],
    &["technique.static-decal.edges=analytic"],
    &["technique.static-decal.joins=style", "technique.static-decal.outlines=polygon"],
];
