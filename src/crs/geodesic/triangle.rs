//! Two places of an ellipsoid as a triangle with the pole: Karney (2013), section 2 and the beginning of section 4.

use super::angle::Angle;
use crate::crs::ellipsoid::Ellipsoid;
use crate::math::max;

/// What a number near 1 is rounded by.
pub(super) const ROUNDING: f64 = f64::EPSILON;

/// Instead of 0 where something is divided by it: its square is still a number.
pub(super) const TINY: f64 = 1.5e-154;

/// Two places, turned so that the first one is south of the equator and no nearer to it than the second, which lies east of it (eq. 44).
pub(super) struct Triangle<'a> {
    pub(super) ellipsoid: &'a Ellipsoid,
    /// Reduced latitudes.
    pub(super) beta1: Angle,
    pub(super) beta2: Angle,
    /// The difference in longitude; ...
    pub(super) lambda: Angle,
    /// ... and by how much it is less than half a turn, radians, which rounds nothing off where places are nearly antipodal.
    pub(super) short_of_half_a_turn: f64,
}

/// The reduced latitude of one in degrees (eq. 6); at a pole its cosine is tiny, but not 0.
pub(super) fn reduced(ellipsoid: &Ellipsoid, latitude: f64) -> Angle {
    let phi = Angle::of_degrees(latitude);
    let beta = Angle::towards((1.0 - ellipsoid.f) * phi.sin, phi.cos);
    Angle { sin: beta.sin, cos: max(TINY, beta.cos) }
}

/// What the series are in, of the cosine of the azimuth at the equator (eqs. 9 and 16).
pub(super) fn epsilon(ellipsoid: &Ellipsoid, cos_alpha0: f64) -> f64 {
    let k2 = ellipsoid.e2() / (1.0 - ellipsoid.e2()) * cos_alpha0 * cos_alpha0;
    k2 / (2.0 * (1.0 + (1.0 + k2).sqrt()) + k2)
}
