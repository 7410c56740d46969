//! What footprints are made of: half planes, convex shapes, discs.

use crate::interval::Ball;
use crate::space::Plan;

/// The most half planes of a [`Convex`].
pub const MOST_SIDES: usize = 4;

/// The plan points p with `normal . (p - at) + offset >= 0`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfPlane {
    /// A point to measure from.
    pub at: Plan,
    /// The direction of what is inside.
    pub normal: [Ball; 2],
    /// How far `at` is inside, in lengths of the normal.
    pub offset: Ball,
}

impl HalfPlane {
    /// The other side.
    #[must_use]
    pub fn opposite(&self) -> Self {
        Self { at: self.at, normal: self.normal.map(|n| -n), offset: -self.offset }
    }
}

/// The points in some half planes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Convex {
    sides: [HalfPlane; MOST_SIDES],
    count: usize,
}

/// The half planes of a [`Convex`].
pub type Sides<'a> = &'a [HalfPlane];

impl Convex {
    /// The points in all of these.
    ///
    /// # Panics
    /// When there are none, or more than [`MOST_SIDES`].
    pub fn new(sides: &[HalfPlane]) -> Self {
        let mut all = [sides[0]; MOST_SIDES];
        all[..sides.len()].copy_from_slice(sides);
        Self { sides: all, count: sides.len() }
    }

    /// The half planes.
    pub fn sides(&self) -> Sides<'_> {
        &self.sides[..self.count]
    }
}

/// A piece of an item's boundary, or of its inside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Primitive {
    /// An edge of the item's polygon: across it the winding number changes.
    Edge {
        /// Where it starts.
        from: Plan,
        /// Where it ends.
        to: Plan,
    },
    /// Points of the item's stroke.
    Convex(Convex),
    /// Points of the item's stroke: those within `reach + growth * r` of the segment from -> to, r their distance from the
    /// eye in space, metres.
    Near {
        /// Where the segment starts.
        from: Plan,
        /// Where it ends; for a disc where it starts.
        to: Plan,
        /// The part of the distance that is the same everywhere, metres.
        reach: f64,
        /// The part that grows with the distance from the eye.
        growth: f64,
    },
    /// Points that may be of the item's stroke: a join on the verge of its miter limit.
    Perhaps(Convex),
}
