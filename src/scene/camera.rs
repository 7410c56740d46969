//! The camera as the scene states it.

use crate::space::World;
use glam::DVec3;

/// From where and how the terrain is seen (scene-local coordinates).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// The eye.
    pub eye: World,
    /// A point in the middle of the picture.
    pub target: World,
    /// The direction that is up in the picture.
    pub up: DVec3,
    /// Perspective or orthographic.
    pub projection: Projection,
    /// Nothing nearer than this (view depth in metres) is seen.
    pub near_m: f64,
    /// Nothing farther than this is seen; `None`: no limit.
    pub far_m: Option<f64>,
}

/// The kind of projection.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Projection {
    /// Rays through one point.
    Perspective {
        /// The whole vertical angle of view in degrees, between 0 and 180.
        fov_y_deg: f64,
    },
    /// Parallel rays.
    Orthographic {
        /// What the picture's height spans in metres.
        height_m: f64,
    },
}
