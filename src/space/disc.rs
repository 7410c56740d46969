//! Discs as polygons, for who draws by edges alone.

use super::Plan;
use crate::math;
use glam::DVec2;

/// Corners of the polygon that stands for a disc.
pub const DISC_CORNERS: usize = 32;

/// The corners of a regular polygon within a disc, counter-clockwise.
pub fn disc_corners(at: Plan, radius: f64) -> [Plan; DISC_CORNERS] {
    std::array::from_fn(|k| {
        let angle = std::f64::consts::TAU * k as f64 / DISC_CORNERS as f64;
        at + DVec2::new(math::cos(angle), math::sin(angle)) * radius
    })
}
