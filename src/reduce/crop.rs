//! Smaller pictures.

use super::draft::Draft;
use crate::error::Result;
use crate::math;
use crate::scene::Projection;
use crate::space::{Lens, Screen};

/// The draft whose picture is `side` pixels a side around a place of the draft's picture, at the same scale. Of parallel rays the
/// same pixels; through an eye the camera turns there. `None`: it is no larger already.
pub(super) fn cropped(draft: &Draft, at: [usize; 2], side: usize) -> Result<Option<Draft>> {
    let (width, height) = (draft.image.width, draft.image.height);
    let (columns, rows) = (side.min(width), side.min(height));
    if (columns, rows) == (width, height) {
        return Ok(None);
    }
    let view = draft.camera.view(&draft.image)?;
    let first = |at: usize, part: usize, whole: usize| at.saturating_sub(part / 2).min(whole - part);
    let middle = |at: usize, part: usize, whole: usize| first(at, part, whole) as f64 + part as f64 / 2.0;
    let ray = view.ray(Screen::new(middle(at[0], columns, width), middle(at[1], rows, height)));
    let mut smaller = draft.clone();
    (smaller.image.width, smaller.image.height) = (columns, rows);
    let distance = (draft.camera.target - draft.camera.eye).length();
    let direction = (ray.through - ray.from).normalize();
    smaller.camera.eye = ray.from;
    smaller.camera.target = ray.from + direction * distance;
    let pixel = view.lens().pixel();
    smaller.camera.projection = match view.lens() {
        Lens::Central { .. } => {
            // Beside its middle a picture is larger.
            let middle = direction.dot(view.forward());
            let half = pixel * middle * rows as f64 / 2.0;
            Projection::Perspective { fov_y_deg: 2.0 * math::atan2(half, 1.0).to_degrees() }
        }
        Lens::Parallel { .. } => Projection::Orthographic { height_m: pixel * rows as f64 },
    };
    Ok(Some(smaller))
}

/// The whole view in half as many pixels a side.
pub(super) fn coarser(draft: &Draft) -> Draft {
    let mut coarser = draft.clone();
    coarser.image.width = draft.image.width.div_ceil(2);
    coarser.image.height = draft.image.height.div_ceil(2);
    coarser
}
