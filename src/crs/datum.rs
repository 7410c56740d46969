//! Datums: how longitudes and latitudes of one become those of WGS 84.

use super::degrees::wrapped;
use super::ellipsoid::Ellipsoid;
use crate::error::{Error, Result};
use glam::{DVec2, DVec3};

/// What is known of a datum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Datum {
    /// WGS 84 or one that differs from it by less than its own realisations do (ETRS89, NAD83, NZGD2000, ...).
    Wgs84,
    /// A Helmert transformation to WGS 84.
    Shift(Helmert),
    /// Nothing: its longitudes and latitudes are taken for those of WGS 84.
    Unknown,
}

/// A seven-parameter similarity of geocentric coordinates, in the position-vector convention of `+towgs84`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Helmert {
    /// Metres.
    pub(crate) translation: DVec3,
    /// Seconds of arc.
    pub(crate) rotation: DVec3,
    /// Parts per million.
    pub(crate) scale: f64,
}

impl Helmert {
    /// From three or seven numbers.
    pub(crate) fn from_numbers(v: &[f64]) -> Option<Self> {
        let at = |i: usize| v.get(i).copied().unwrap_or(0.0);
        (matches!(v.len(), 3 | 7) && v.iter().all(|x| x.is_finite() && x.abs() < 1e5)).then(|| Self {
            translation: DVec3::new(at(0), at(1), at(2)),
            rotation: DVec3::new(at(3), at(4), at(5)),
            scale: at(6),
        })
    }

    pub(crate) fn is_zero(&self) -> bool {
        self.translation == DVec3::ZERO && self.rotation == DVec3::ZERO && self.scale == 0.0
    }

    /// Whether two shifts move no place by as much as some centimetres against each other.
    pub(crate) fn agrees_with(&self, other: &Self) -> bool {
        (self.translation - other.translation).length() < 0.05
            && (self.rotation - other.rotation).length() < 0.001
            && (self.scale - other.scale).abs() < 0.005
    }

    fn apply(&self, p: DVec3) -> DVec3 {
        let r = self.rotation * (std::f64::consts::PI / (180.0 * 3600.0));
        let turned = DVec3::new(
            p.x - r.z * p.y + r.y * p.z,
            r.z * p.x + p.y - r.x * p.z,
            -r.y * p.x + r.x * p.y + p.z,
        );
        self.translation + turned * (1.0 + self.scale * 1e-6)
    }

    /// Degrees on `from` at height 0 to degrees on WGS 84.
    pub(crate) fn wgs84_from(self, from: &Ellipsoid, p: DVec2) -> DVec2 {
        let here = from.geocentric(p.x.to_radians(), p.y.to_radians());
        let (lon, lat) = Ellipsoid::WGS84.geographic(self.apply(here));
        DVec2::new(lon.to_degrees(), lat.to_degrees())
    }

    /// Degrees on WGS 84 to those degrees on `to` that [`Self::wgs84_from`] maps there.
    ///
    /// PROJ's inverse applies the transposed rotation to a point at height 0 instead, which comes back some
    /// millimetres off. The map is nearly the identity, so the plain fixed-point iteration gains four digits a round.
    ///
    /// # Errors
    /// Within about a kilometre of a pole, where longitude means nothing.
    pub(crate) fn own_from_wgs84(self, to: &Ellipsoid, p: DVec2) -> Result<DVec2> {
        let mut guess = p;
        for _ in 0..12 {
            let seen = self.wgs84_from(to, guess);
            let off = DVec2::new(wrapped(p.x - seen.x), p.y - seen.y);
            if off.x.abs() < 1e-13 && off.y.abs() < 1e-13 {
                return Ok(guess);
            }
            guess += off;
        }
        let left = p - self.wgs84_from(to, guess);
        if wrapped(left.x).abs() < 1e-10 && left.y.abs() < 1e-10 && guess.y.abs() <= 90.0 {
            return Ok(guess);
        }
        Err(Error::new(format!("the datum shift does not converge at longitude {}, latitude {}", p.x, p.y))
            .help("places this near a pole need a polar projection on WGS 84"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MGI: [f64; 7] = [577.326, 90.129, 463.919, 5.137, 1.474, 5.297, 2.4232];

    #[test]
    fn a_shift_and_back_is_the_same_place() {
        let bessel = Ellipsoid::from_inverse_flattening(6_377_397.155, 299.152_812_8);
        let shift = Helmert::from_numbers(&MGI).unwrap();
        for p in [(11.9, 46.6), (-179.9999, 10.0), (179.9999, -60.0), (0.0, 89.0)] {
            let p = DVec2::new(p.0, p.1);
            let back = shift.own_from_wgs84(&bessel, shift.wgs84_from(&bessel, p)).unwrap();
            assert!((back - p).length() < 1e-11, "{p} came back as {back}");
        }
    }

    #[test]
    fn four_numbers_are_no_shift() {
        assert_eq!(Helmert::from_numbers(&MGI[..4]), None);
        assert_eq!(Helmert::from_numbers(&[f64::NAN, 0.0, 0.0]), None);
    }
}
