//! How deep a surface lies where it is seen, and how fast that changes over the picture: what polygon offset asks of a triangle.

use super::Pipeline;
use super::matrix::Projection;
use super::number::{Real, clamp_to_unit};
use crate::space::{Lens, ViewFrame, World};

/// A triangle's depth at a screen point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceDepth<T> {
    /// The depth, 0..=1.
    pub depth: T,
    /// How much it changes at most from a pixel to its neighbour in the row or in the column.
    pub slope: T,
}

impl<T: Real> Pipeline<T> {
    /// The depth of the plane of a triangle that is seen somewhere with this view depth. A plane that is seen edge-on has an infinite slope.
    pub fn surface_depth(&self, frame: &ViewFrame, corners: &[World; 3], view_depth: f64) -> SurfaceDepth<T> {
        let slopes = self.projection.depth_slopes(frame, corners);
        let slope = crate::math::max(slopes[0].abs(), slopes[1].abs());
        let depth = self.projection.depth_of(view_depth, self.is_parallel);
        SurfaceDepth {
            depth: clamp_to_unit(T::of(depth)),
            slope: T::of(if slope.is_finite() { slope } else { f64::MAX }),
        }
    }
}

impl Projection {
    /// The depth after division of a view depth.
    fn depth_of(&self, view_depth: f64, is_parallel: bool) -> f64 {
        if is_parallel {
            self.slope * view_depth + self.constant
        } else {
            self.slope + self.constant / view_depth
        }
    }

    /// How much the depth of a triangle's plane changes per pixel to the right and down. A central lens sees 1 / view depth, a parallel one view
    /// depth change linearly over the picture; both follow from the plane's normal.
    fn depth_slopes(&self, frame: &ViewFrame, [a, b, c]: &[World; 3]) -> [f64; 2] {
        let normal = (*b - *a).cross(*c - *a);
        let pixel = frame.lens().pixel();
        let across = [frame.right(), -frame.up()].map(|axis| normal.dot(axis) * pixel);
        match frame.lens() {
            Lens::Central { .. } => {
                let distance = normal.dot(*a - frame.eye());
                across.map(|along| self.constant * along / distance)
            }
            Lens::Parallel { .. } => {
                let ahead = normal.dot(frame.forward());
                across.map(|along| -self.slope * along / ahead)
            }
        }
    }
}
