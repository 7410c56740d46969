//! The hierarchy's nodes and the boxes around them.

use crate::space::World;
use glam::DVec3;

/// A node of the hierarchy: level 0 holds triangles, higher levels hold nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Node {
    /// Height in the tree, 0 at the leaves.
    pub level: u32,
    /// Column of the node in its level.
    pub x: u32,
    /// Row of the node in its level (0 in a TIN).
    pub y: u32,
}

/// A box `center + a * axes[0] + b * axes[1] + c * axes[2]` with a, b, c in -1..=1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Its middle.
    pub center: World,
    /// Its half extents; the third is vertical.
    pub axes: [DVec3; 3],
}
