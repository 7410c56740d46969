//! How large a pixel is where a stroke lies.

use crate::math::max;
use crate::scene::{Line, Width};
use crate::space::{Lens, ViewFrame, World};

/// How widths in pixels become metres: what the view says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PixelSize {
    /// A pixel's size at distance 1 (perspective) or everywhere (orthographic).
    pub pixel: f64,
    /// The eye, when a pixel's size grows with the distance from it.
    pub eye: Option<World>,
    /// The farthest that terrain lies above or below the eye, metres.
    pub height_span: f64,
}

impl PixelSize {
    /// The size in a view of a terrain whose heights lie between two.
    pub fn of(view: &ViewFrame, (low, high): (f64, f64)) -> Self {
        let eye = view.eye();
        let height_span = max((high - eye.z).abs(), (low - eye.z).abs());
        match view.lens() {
            Lens::Central { pixel } => Self { pixel, eye: Some(eye), height_span },
            Lens::Parallel { pixel } => Self { pixel, eye: None, height_span },
        }
    }
}

impl Default for PixelSize {
    fn default() -> Self {
        Self { pixel: 1.0, eye: None, height_span: 0.0 }
    }
}

/// Whether a line's width grows with the distance from the eye.
pub(super) fn grows_with_distance(line: &Line, pixel: &PixelSize) -> bool {
    matches!(line.width, Width::Pixels(_)) && pixel.eye.is_some()
}
