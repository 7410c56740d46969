//! Scenes on a globe: what of loading is different there.
//!
//! Input: a terrain in longitude and latitude, features in any CRS. Output: posts over an ellipsoid, features in longitude and latitude of its
//! CRS, strokes in metres as areas on the ground. Refuses: terrains that are no grid of meridians and parallels, offsets, plan coordinates,
//! all with the reason.

mod camera;
mod features;
mod foot;
mod stroke;
mod terrain;
mod unlike_planes;
mod way;

pub(super) use camera::{framing, place, up};
pub(super) use features::{Strokes, check_styles, in_degrees, near_strokes, stroked};
pub(super) use terrain::{above_the_middle, generated, terrain};
pub(super) use unlike_planes::{check, without_crs};

#[cfg(test)]
mod tests;
