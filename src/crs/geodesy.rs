//! Lengths and curves on the ground of a CRS in degrees: its ellipsoid.
//!
//! Input: places in the file's coordinates. Output: metres, and places on the way between two. Refuses a CRS that is not in degrees, and
//! ellipsoids so flat that the series of geodesics hold no longer.

use super::Crs;
use super::ellipsoid::Ellipsoid;
use super::geodesic::Geodesic;
use super::rhumb::Rhumb;
use crate::error::{Error, Result};
use glam::DVec2;

/// The flattest ellipsoid on which the series to the sixth order are good to a micrometre.
const FLATTEST: f64 = 0.02;

/// The ground of a CRS in degrees.
///
/// ```
/// use drapery::crs::{Crs, CurveKind, Geodesy};
/// use glam::DVec2;
/// let ground = Geodesy::of(&Crs::crs84()?)?;
/// let edge = ground.curve(CurveKind::Geodesic, DVec2::new(-120.0, 40.0), DVec2::new(-80.0, 40.0));
/// assert!((edge.at(0.5).y - 41.770).abs() < 1e-3);
/// # Ok::<(), drapery::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Geodesy {
    ellipsoid: Ellipsoid,
    /// Degrees in a unit of the file.
    unit: f64,
}

/// Which way leads from one place to another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CurveKind {
    /// The shortest one.
    Geodesic,
    /// That of constant bearing.
    RhumbLine,
}

/// A way on the ground.
#[derive(Debug, Clone, PartialEq)]
pub struct GroundCurve {
    way: Way,
    from: DVec2,
    unit: f64,
}

#[derive(Debug, Clone, PartialEq)]
enum Way {
    Geodesic(Geodesic),
    RhumbLine(Rhumb),
}

impl Geodesy {
    /// The ground of a CRS.
    ///
    /// # Errors
    /// When the CRS is not in degrees, or its ellipsoid flatter than 1/50.
    pub fn of(crs: &Crs) -> Result<Self> {
        let Some(unit) = crs.degrees_per_unit() else {
            return Err(Error::new(format!("{} is a plane, not in degrees", crs.name())));
        };
        if crs.ellipsoid.f > FLATTEST {
            return Err(Error::unsupported(format!(
                "the ellipsoid of {} is flatter than 1/50, too flat for geodesics and rhumb lines",
                crs.name()
            )));
        }
        Ok(Self { ellipsoid: crs.ellipsoid, unit })
    }

    /// The way between two places that are no poles and at most half a turn apart in longitude: from the first one east where the
    /// second one's longitude is the larger one, whatever turns they are written on. Latitudes are -90 to 90 degrees.
    pub fn curve(&self, kind: CurveKind, from: DVec2, to: DVec2) -> GroundCurve {
        let (south, north) = (from.y * self.unit, to.y * self.unit);
        let east = (to.x - from.x) * self.unit;
        let way = match kind {
            CurveKind::Geodesic => Way::Geodesic(Geodesic::between(&self.ellipsoid, south, north, east)),
            CurveKind::RhumbLine => Way::RhumbLine(Rhumb::between(&self.ellipsoid, south, north, east)),
        };
        GroundCurve { way, from, unit: self.unit }
    }

    /// Metres through the ground between two places: on short ways as good as along it.
    pub fn chord(&self, a: DVec2, b: DVec2) -> f64 {
        let place = |p: DVec2| self.ellipsoid.geocentric(self.radians(p.x), self.radians(p.y));
        (place(b) - place(a)).length()
    }

    /// The equatorial radius in metres.
    pub fn radius(&self) -> f64 {
        self.ellipsoid.a
    }

    /// The angle that a coordinate is.
    pub fn radians(&self, coordinate: f64) -> f64 {
        (coordinate * self.unit).to_radians()
    }
}

impl GroundCurve {
    /// Its length in metres.
    pub fn length(&self) -> f64 {
        match &self.way {
            Way::Geodesic(way) => way.length(),
            Way::RhumbLine(way) => way.length(),
        }
    }

    /// The place after a share of its length, its longitude on from that of the first one.
    pub fn at(&self, share: f64) -> DVec2 {
        let (east, latitude) = match &self.way {
            Way::Geodesic(way) => way.at(share),
            Way::RhumbLine(way) => way.at(share),
        };
        DVec2::new(self.from.x + east / self.unit, latitude / self.unit)
    }
}
