//! Longitudes and latitudes in degrees.

use glam::DVec2;

/// A longitude and latitude that make sense: the latitude up to a pole, the longitude at most one turn off.
pub(super) fn checked_geographic(p: DVec2) -> Option<DVec2> {
    (p.y.abs() <= 90.0 && p.x.abs() <= 540.0).then_some(p)
}

/// A difference of longitudes within half a turn; both ends stay as they are.
pub(super) fn wrapped(degrees: f64) -> f64 {
    if degrees.abs() <= 180.0 {
        return degrees;
    }
    degrees - 360.0 * ((degrees + 180.0) / 360.0).floor()
}
