//! Scenes on a globe: what of loading is different there.
//!
//! Input: a terrain in longitude and latitude, features in any CRS. Output: posts over an ellipsoid, features in longitude and latitude of its
//! CRS, strokes as areas on the ground. Refuses: terrains that are no grid of meridians and parallels, offsets, plan coordinates, widths in
//! pixels, all with the reason.

mod camera;
mod terrain;

pub(super) use camera::{framing, place, up};
pub(super) use terrain::{generated, terrain};
pub(super) use unlike_planes::{check, without_crs};

mod unlike_planes;
