//! Coordinate reference systems: what a file's coordinates mean, and how they become plan coordinates.
//!
//! Takes a CRS by EPSG code, PROJ string or WKT; gives maps between its coordinates, longitude and latitude on
//! WGS 84, and the scene's plan. Refuses geocentric and engineering systems, places outside a projection's domain,
//! and anything it cannot name; it never returns a coordinate that is not finite.
//!
//! # What the text of a CRS leaves open
//! - Coordinates are x (east), y (north), or longitude, latitude, whatever axis order the authority states: that is
//!   how files store them.
//! - Axes that a CRS counts west and south stay so: that is how files store them, too.
//! - Datum shifts are Helmert transformations; there are no grid files. Where neither the text nor the list of EPSG
//!   datums knows a shift (an ellipsoid alone, WGS 84's too, says nothing of one), longitudes and latitudes are taken for those of WGS 84, and [`Crs::note`] says so.
//! - ETRS89, NAD83, NZGD2000, GDA94 and their like count as WGS 84 (they differ by less than 2 m).
//!
//! # Determinism
//! Transverse Mercator, Mercator, Web Mercator, Lambert's conformal cone and equal-area plane, Albers, the stereographic projections of a
//! pole and of any place (double), the Swiss oblique Mercator, Krovak, the local plane and datum shifts are our own, on `libm`: the
//! same bits everywhere. All other projections go through `proj4rs`, rounded to 2^-20 m and 2^-36 degrees, where
//! processors may differ by one such step; [`PlanFrom::note`] says so.

mod authalic;
mod conic;
mod datum;
pub(crate) mod datum_text;
mod degrees;
mod ellipsoid;
mod epsg;
mod epsg_corrections;
mod fourier;
mod gauss;
mod geodesic;
mod geodesy;
mod imported;
mod plan;
mod proj_string;
mod projection;
mod rhumb;
mod sphere;
mod stereographic;
mod transverse_mercator;
mod wkt;
mod wkt_names;

pub use geodesy::{CurveKind, Geodesy, GroundCurve};
pub use plan::{Affine, PlanFrom, PlanSpace};

use crate::error::{Error, Result};
use datum::Datum;
use degrees::checked_geographic;
use ellipsoid::Ellipsoid;
use glam::DVec2;
use proj_string::Definition;
use projection::Projection;

/// A turn around the globe in the coordinates of a CRS.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turn {
    /// By how much x grows, in the CRS's unit.
    pub length: f64,
    /// The y of the northern pole: a quarter of that in degrees, infinite on Mercator's cylinder.
    pub pole: f64,
}

/// A coordinate reference system.
///
/// ```
/// use drapery::crs::Crs;
/// let utm = Crs::parse("EPSG:32733")?;
/// assert_eq!(utm.name(), "EPSG:32733 (WGS 84 / UTM zone 33S)");
/// assert!(utm.is_same(&Crs::parse("+proj=utm +zone=33 +south +datum=WGS84")?));
/// # Ok::<(), drapery::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Crs {
    epsg: Option<u32>,
    name: String,
    ellipsoid: Ellipsoid,
    datum: Datum,
    prime_meridian: f64,
    projection: Projection,
    /// Metres, or degrees where geographic, per unit.
    unit: f64,
}

impl Crs {
    /// The CRS of an EPSG code.
    ///
    /// # Errors
    /// When the code is not known, names a system without a plane of coordinates (geocentric, vertical), or is one of few that
    /// the list and EPSG define differently.
    pub fn from_epsg(code: u32) -> Result<Self> {
        if let Some(help) = epsg_corrections::refused(code) {
            return Err(
                Error::unsupported(format!("EPSG:{code} cannot be placed to the metre here")).help(help)
            );
        }
        let known = epsg::known(code).ok_or_else(|| {
            Error::unsupported(format!("EPSG:{code} is not a CRS known here"))
                .help("write it as a PROJ string or as WKT (a compound one by the codes of its parts: EPSG:4326+3855), or reproject the data")
        })?;
        let definition = Definition::parse(&known.proj)?;
        let mut crs = Self::from_definition(&definition).map_err(|e| {
            Error::unsupported(format!("EPSG:{code} cannot be used: {}", e.what()))
                .help("reproject the data, for example to UTM")
        })?;
        crs.datum = definition.listed_datum(&definition.ellipsoid()?)?;
        crs.epsg = Some(code);
        if crs.is_geographic() {
            // The unit of angles is what a PROJ string cannot say.
            crs.unit = wkt::degrees_per_unit_of(known.wkt);
        }
        let words = known.wkt.split('"').nth(1).unwrap_or("");
        crs.name = format!("EPSG:{code} ({words})");
        Ok(crs)
    }

    /// The CRS of a text: `EPSG:32733`, `OGC:CRS84`, an OGC URN or URL, a PROJ string, or WKT (1, 2 or Esri's). Of a compound
    /// one (`EPSG:32633+5773`) it is the horizontal part.
    ///
    /// # Errors
    /// When the text is none of these, or what it describes is not supported.
    pub fn parse(text: &str) -> Result<Self> {
        let text = text.trim().trim_start_matches('\u{feff}').trim_end_matches('\0');
        if let Some(crs) = Self::from_identifier(text) {
            return crs;
        }
        if text.starts_with('+') && text.contains("+proj") {
            return Self::from_proj_string(text);
        }
        if text.contains(['[', '(']) {
            return wkt::parse(text);
        }
        let start: String = text.chars().take(60).collect();
        Err(Error::new(format!("'{start}' does not name a CRS"))
            .help("write for example 'EPSG:32733', a PROJ string or WKT"))
    }

    fn from_identifier(text: &str) -> Option<Result<Self>> {
        let upper = text.to_ascii_uppercase();
        if upper.len() <= 80 && (upper.ends_with(":CRS84") || upper.ends_with("/CRS84") || upper == "CRS84") {
            return Some(Self::crs84());
        }
        if WEB_MERCATORS.contains(&upper.as_str()) {
            return Some(Self::from_epsg(3857));
        }
        let short = upper.strip_prefix("EPSG:").or_else(|| upper.strip_prefix("+INIT=EPSG:").map(first_word));
        let short = short.map(horizontal_code);
        let urn = upper.strip_prefix("URN:OGC:DEF:CRS:EPSG:").and_then(|t| t.split(':').nth(1));
        let url = upper.split_once("/DEF/CRS/EPSG/").and_then(|t| t.1.split('/').nth(1));
        let code: u32 = short.or(urn).or(url)?.trim().parse().ok()?;
        Some(Self::from_epsg(code))
    }

    /// Longitude and latitude on WGS 84 in degrees: what GeoJSON means when it says nothing.
    ///
    /// # Errors
    /// None in practice: its definition is built in.
    pub fn crs84() -> Result<Self> {
        let mut crs = Self::from_epsg(4326)?;
        crs.name = "OGC:CRS84 (WGS 84 longitude, latitude)".to_owned();
        Ok(crs)
    }

    /// The CRS of a PROJ string.
    ///
    /// # Errors
    /// When it is malformed or names something unknown.
    pub fn from_proj_string(text: &str) -> Result<Self> {
        Self::from_definition(&Definition::parse(text)?)
    }

    fn from_definition(definition: &Definition) -> Result<Self> {
        let ellipsoid = definition.ellipsoid()?;
        let datum = definition.datum(&ellipsoid)?;
        let projection = Projection::new(definition, ellipsoid)?;
        let unit = match projection {
            Projection::Geographic => 1.0,
            _ => definition.metres_per_unit()?,
        };
        Ok(Self {
            epsg: None,
            name: definition.to_string(),
            ellipsoid: projection.own_ellipsoid().unwrap_or(ellipsoid),
            datum,
            prime_meridian: definition.prime_meridian()?,
            projection,
            unit,
        })
    }

    /// Whether its coordinates are longitude and latitude.
    pub fn is_geographic(&self) -> bool {
        matches!(self.projection, Projection::Geographic)
    }

    /// Whether its projection is another library's, whose last bits differ between processors.
    pub(crate) fn is_imported(&self) -> bool {
        matches!(self.projection, Projection::Imported(_))
    }

    /// What to call it before people.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its EPSG code, where it came with one.
    pub fn epsg(&self) -> Option<u32> {
        self.epsg
    }

    /// Metres in a unit of its coordinates; `None` where they are angles.
    pub fn metres_per_unit(&self) -> Option<f64> {
        (!self.is_geographic()).then_some(self.unit)
    }

    /// Degrees in a unit of its coordinates; `None` where they are lengths.
    pub fn degrees_per_unit(&self) -> Option<f64> {
        self.is_geographic().then_some(self.unit)
    }

    /// A turn around the globe, where places whose x is so much greater are the same: in degrees and on Mercator's cylinder.
    pub fn turn(&self) -> Option<Turn> {
        if let Some(degrees) = self.degrees_per_unit() {
            let length = 360.0 / degrees;
            return Some(Turn { length, pole: 0.25 * length });
        }
        let (_, turn) = self.projection.cylinder()?;
        Some(Turn { length: turn / self.unit, pole: f64::INFINITY })
    }

    /// An x, and the degrees east of Greenwich there, from which both count turns.
    fn middle(&self) -> (f64, f64) {
        let zero = self.projection.cylinder().map_or(0.0, |(zero, _)| zero / self.unit);
        (zero, self.prime_meridian + self.projection.central_meridian())
    }

    /// The point on the turn around that middle, where it lies so far off that nothing would be found there; its own bits where not.
    fn on_a_known_turn(&self, p: DVec2) -> DVec2 {
        let Some(turn) = self.turn() else { return p };
        let turns = (p.x - self.middle().0) / turn.length;
        let known = if self.is_geographic() { 1.5 } else { 0.5 + 1e-10 };
        if turns.abs() <= known { p } else { DVec2::new(p.x - turn.length * turns.round(), p.y) }
    }

    /// What the user should know before trusting positions to the metre.
    pub fn note(&self) -> Option<String> {
        matches!(self.datum, Datum::Unknown).then(|| {
            format!(
                "no datum shift is known for {}: its longitudes and latitudes are taken for those of WGS 84, \
                 which can be some hundred metres off",
                self.name
            )
        })
    }

    /// Whether coordinates in both mean the same places, to the millimetre within one datum. Names do not count, and
    /// a datum of which nothing is known agrees with any on the same ellipsoid.
    pub fn is_same(&self, other: &Self) -> bool {
        (self.epsg.is_some() && self.epsg == other.epsg)
            || (self.ellipsoid.agrees_with(&other.ellipsoid)
                && self.has_datum_of(other)
                && (self.prime_meridian - other.prime_meridian).abs() < 1e-8
                && (self.unit - other.unit).abs() < 1e-9 * self.unit
                && self.projection.agrees_with(&other.projection))
    }

    fn has_datum_of(&self, other: &Self) -> bool {
        match (&self.datum, &other.datum) {
            (Datum::Wgs84, Datum::Wgs84) => true,
            (Datum::Shift(a), Datum::Shift(b)) => {
                a.agrees_with(b) && self.ellipsoid.agrees_with(&other.ellipsoid)
            }
            // On WGS 84's ellipsoid, what is unknown is taken for WGS 84, and not for what is known to be another datum.
            (Datum::Unknown, Datum::Shift(_)) | (Datum::Shift(_), Datum::Unknown)
                if self.ellipsoid.agrees_with(&Ellipsoid::WGS84) =>
            {
                false
            }
            (Datum::Unknown, _) | (_, Datum::Unknown) => self.ellipsoid.agrees_with(&other.ellipsoid),
            _ => false,
        }
    }

    /// Longitude and latitude on WGS 84, degrees, of a point in this CRS.
    ///
    /// # Errors
    /// When the point lies outside the projection's domain or is not finite.
    pub fn geographic_from_native(&self, p: DVec2) -> Result<DVec2> {
        let own = self.own_geographic(p)?;
        match &self.datum {
            Datum::Shift(shift) => Ok(shift.wgs84_from(&self.ellipsoid, own)),
            Datum::Wgs84 | Datum::Unknown => Ok(own),
        }
    }

    /// The point in this CRS of a longitude and latitude on WGS 84, degrees.
    ///
    /// # Errors
    /// When the place lies outside the projection's domain or is not finite.
    pub fn native_from_geographic(&self, p: DVec2) -> Result<DVec2> {
        let p = checked_geographic(p).ok_or_else(|| self.outside(p))?;
        let own = match &self.datum {
            Datum::Shift(shift) => shift.own_from_wgs84(&self.ellipsoid, p)?,
            Datum::Wgs84 | Datum::Unknown => p,
        };
        self.project(own)
    }

    /// Degrees east of Greenwich and north, on the CRS's own datum.
    fn own_geographic(&self, p: DVec2) -> Result<DVec2> {
        let refused = || {
            Error::new(format!("({}, {}) is not a place in {}", p.x, p.y, self.name)).help(
                "check that the coordinates are in the CRS that the file states; degrees under a projected CRS, \
                 or metres under a geographic one, end here",
            )
        };
        let finite = Some(p).filter(|p| p.is_finite()).ok_or_else(refused)?;
        let found = match &self.projection {
            Projection::Geographic => Some(finite * self.unit + DVec2::new(self.prime_meridian, 0.0)),
            Projection::Imported(imported) => imported.inverse(finite),
            own => own.inverse(finite * self.unit, self.prime_meridian),
        };
        found.and_then(checked_geographic).ok_or_else(refused)
    }

    /// The inverse of [`Self::own_geographic`].
    fn project(&self, p: DVec2) -> Result<DVec2> {
        let found = match &self.projection {
            Projection::Geographic => Some((p - DVec2::new(self.prime_meridian, 0.0)) / self.unit),
            Projection::Imported(imported) => imported.forward(p),
            own => own.forward(p, self.prime_meridian).map(|q| q / self.unit),
        };
        found.filter(|q| q.is_finite()).ok_or_else(|| self.outside(p))
    }

    fn outside(&self, p: DVec2) -> Error {
        Error::new(format!("longitude {}, latitude {} lies outside the domain of {}", p.x, p.y, self.name))
            .help("clip the data, or choose a CRS made for that area")
    }
}

/// What Web Mercator was called before it had a code of EPSG.
const WEB_MERCATORS: [&str; 5] = ["EPSG:900913", "ESRI:102100", "ESRI:102113", "EPSG:102100", "EPSG:102113"];

/// `32633` of a compound `32633+5773`.
fn horizontal_code(text: &str) -> &str {
    match text.split_once('+') {
        Some((horizontal, vertical)) if vertical.parse::<u32>().is_ok() => horizontal,
        _ => text,
    }
}

/// Nothing that can follow the code of `+init=` alone changes the CRS.
fn first_word(text: &str) -> &str {
    let (first, rest) = text.split_once(' ').unwrap_or((text, ""));
    let is_idle = |word: &str| matches!(word, "+NO_DEFS" | "+WKTEXT" | "+TYPE=CRS");
    if rest.split_whitespace().all(is_idle) { first } else { text }
}

#[cfg(test)]
mod tests;
