//! Segments that a view may have of dynamic lines, and the pieces of lines that they are tried for.

use super::outline::Outline;
use crate::certainty::Known;
use crate::space::{Plan, PlanBox, World};

/// A segment that a view may have.
#[derive(Debug, Clone)]
pub(super) struct Segment {
    pub(super) ends: [World; 2],
    /// Whether it is kept by the vertices that the frustum holds.
    pub(super) kept: Known,
    /// What its box may cover, by its neighbours; none: the whole screen.
    pub(super) outlines: Vec<Option<Outline>>,
    /// Its box's corners in the plan by its first neighbours: at the start left and right, at the end right and left.
    pub(super) plan: [Plan; 4],
    /// What of it lies before the near plane.
    pub(super) picture: Option<Picture>,
}

/// A segment on the screen.
#[derive(Debug, Clone, Copy)]
pub(super) struct Picture {
    pub(super) screen: [Plan; 2],
    pub(super) world: [World; 2],
    /// View depths; 1 where rays are parallel.
    pub(super) depth: [f64; 2],
}

/// What may be drawn between two vertices that are surely kept.
#[derive(Debug)]
pub(super) struct Piece {
    pub(super) item: u32,
    /// The number of its chain.
    pub(super) chain: u32,
    /// Half the line's width, pixels.
    pub(super) half_px: f64,
    /// Each way that it may be made of segments.
    pub(super) ways: Vec<Vec<Segment>>,
    pub(super) is_wild: bool,
}

/// How far a box is grown for thin lines (ours: `docs/semantics.md`).
pub(super) const THIN_MARGIN: f64 = 0.75;

/// What single precision does to a place, as a share of its coordinates: some roundings.
pub(super) const SHARE: f64 = 1.0 / (1 << 21) as f64;

impl Segment {
    /// Whether its box covers a pixel's centre.
    pub(super) fn covers(&self, centre: Plan, shift: f64) -> Known {
        let told = self
            .outlines
            .iter()
            .map(|outline| outline.as_ref().map_or(Known::Out, |of| of.holds(centre, shift)));
        told.reduce(|a, b| if a == b { a } else { Known::Open }).unwrap_or(Known::In)
    }
}

impl Piece {
    /// What its picture and thin lines' reach beside it may cover of the screen.
    pub(super) fn picture(&self) -> PlanBox {
        let ends = self
            .ways
            .iter()
            .flatten()
            .filter_map(|segment| segment.picture)
            .flat_map(|picture| picture.screen);
        let around = PlanBox::around(ends);
        if around.is_empty() { around } else { around.grown(THIN_MARGIN) }
    }
}
