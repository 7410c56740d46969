//! The camera as the scene states it.

use super::ImageSettings;
use crate::error::Result;
use crate::space::{ViewFrame, Viewpoint, World};
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

impl Camera {
    /// A camera at `eye` that looks at `target`, with the scene file's defaults: perspective, 45 degrees, z up, from a metre away on.
    pub fn new(eye: World, target: World) -> Self {
        Self {
            eye,
            target,
            up: DVec3::Z,
            projection: Projection::Perspective { fov_y_deg: 45.0 },
            near_m: 1.0,
            far_m: None,
        }
    }

    /// The view of this camera on a picture.
    ///
    /// # Errors
    /// When the camera shows nothing (eye = target, `up` along the view, an angle out of range).
    pub fn view(&self, image: &ImageSettings) -> Result<ViewFrame> {
        let far = self.far_m.unwrap_or(f64::INFINITY);
        let point = Viewpoint { eye: self.eye, target: self.target, up: self.up, near: self.near_m, far };
        let size = (image.width, image.height);
        match self.projection {
            Projection::Perspective { fov_y_deg } => ViewFrame::perspective(&point, fov_y_deg, size),
            Projection::Orthographic { height_m } => ViewFrame::orthographic(&point, height_m, size),
        }
    }
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
