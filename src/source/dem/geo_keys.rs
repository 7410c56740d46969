//! GeoTIFF keys -> what they say of the CRS.
//!
//! Source: OGC 19-008r4, "GeoTIFF Standard" 1.1: key directory in section 7.1, keys in annex D. Vertical keys say nothing
//! here but the unit. It refuses nothing: what it cannot read becomes [`CrsHint::Unknown`].

use super::vertical::VerticalUnit;
use crate::crs::datum_text;
use std::collections::BTreeMap;

/// What a terrain file says of its CRS, as it says it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum CrsHint {
    /// A code of the EPSG register.
    Epsg(u32),
    /// A PROJ string, made from the file's own parameters.
    Proj(String),
    /// Well-known text, as found.
    Wkt(String),
    /// Something is said that is not understood; in words.
    Unknown(String),
}

/// Key ids.
mod key {
    pub(super) const MODEL_TYPE: u16 = 1024;
    pub(super) const RASTER_TYPE: u16 = 1025;
    pub(super) const CITATION: u16 = 1026;
    pub(super) const GEODETIC_CRS: u16 = 2048;
    pub(super) const GEODETIC_CITATION: u16 = 2049;
    pub(super) const DATUM: u16 = 2050;
    pub(super) const ANGULAR_UNITS: u16 = 2054;
    pub(super) const ELLIPSOID: u16 = 2056;
    pub(super) const SEMI_MAJOR: u16 = 2057;
    pub(super) const SEMI_MINOR: u16 = 2058;
    pub(super) const INVERSE_FLATTENING: u16 = 2059;
    pub(super) const PRIME_MERIDIAN: u16 = 2051;
    pub(super) const PROJECTED_CRS: u16 = 3072;
    pub(super) const PROJECTED_CITATION: u16 = 3073;
    pub(super) const PROJECTION: u16 = 3074;
    pub(super) const METHOD: u16 = 3075;
    pub(super) const LINEAR_UNITS: u16 = 3076;
    pub(super) const PARALLEL_1: u16 = 3078;
    pub(super) const PARALLEL_2: u16 = 3079;
    pub(super) const ORIGIN_LON: u16 = 3080;
    pub(super) const ORIGIN_LAT: u16 = 3081;
    pub(super) const FALSE_EASTING: u16 = 3082;
    pub(super) const FALSE_NORTHING: u16 = 3083;
    pub(super) const FALSE_ORIGIN_LON: u16 = 3084;
    pub(super) const FALSE_ORIGIN_LAT: u16 = 3085;
    pub(super) const FALSE_ORIGIN_EASTING: u16 = 3086;
    pub(super) const FALSE_ORIGIN_NORTHING: u16 = 3087;
    pub(super) const CENTER_LON: u16 = 3088;
    pub(super) const CENTER_LAT: u16 = 3089;
    pub(super) const SCALE: u16 = 3092;
    pub(super) const VERTICAL_CRS: u16 = 4096;
    pub(super) const VERTICAL_CITATION: u16 = 4097;
    pub(super) const VERTICAL_UNITS: u16 = 4099;
}

/// The code that stands for "described by the other keys".
const USER_DEFINED: u16 = 32767;
const DEGREE: u16 = 9102;
const METRE: u16 = 9001;

/// The keys of a GeoTIFF.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct GeoKeys {
    keys: BTreeMap<u16, Value>,
}

#[derive(Debug, Clone, PartialEq)]
enum Value {
    Code(u16),
    Number(f64),
    Text(String),
}

impl GeoKeys {
    /// Reads the key directory and the two tags it points into; leaves out keys that point nowhere.
    pub(super) fn new(directory: &[u16], numbers: &[f64], text: &str) -> Self {
        let entries = directory.as_chunks::<4>().0.iter().skip(1);
        let count = usize::from(directory.get(3).copied().unwrap_or(0));
        let keys = entries
            .take(count)
            .filter_map(|&[id, place, count, at]| Some((id, value(place, count, at, numbers, text)?)))
            .collect();
        Self { keys }
    }

    /// Whether samples stand at the tie points (true) or fill the cell south-east of them.
    pub(super) fn pixel_is_point(&self) -> bool {
        self.code(key::RASTER_TYPE) == Some(2)
    }

    /// What heights count in, where anything is said of it: by the unit's key, the vertical CRS, a compound CRS, or a text of
    /// Esri's programs.
    pub(super) fn vertical_unit(&self) -> Option<VerticalUnit> {
        let code = |key| self.code(key).filter(|code| is_register(*code));
        let of_crs = [key::VERTICAL_CRS, key::PROJECTED_CRS, key::GEODETIC_CRS]
            .into_iter()
            .find_map(|key| VerticalUnit::of_crs_code(code(key)?.into()))
            .or_else(|| VerticalUnit::of_wkt(&self.esri_wkt()?));
        let Some(unit) = code(key::VERTICAL_UNITS).map(VerticalUnit::of_unit_code) else {
            return of_crs.or_else(|| self.unsaid_unit());
        };
        // The key has no direction: that is the CRS's.
        let down = of_crs.is_some_and(|unit| unit.metres() < 0.0);
        match unit {
            VerticalUnit::Metres(metres, words) if down => Some(VerticalUnit::Metres(-metres, words)),
            unit => Some(unit),
        }
    }

    /// The unit of a vertical CRS that no code describes; `None` where one does, or where there is none.
    fn unsaid_unit(&self) -> Option<VerticalUnit> {
        let citation = self.text(key::VERTICAL_CITATION).filter(|name| !name.is_empty());
        match (self.code(key::VERTICAL_CRS), citation) {
            (Some(code), _) if is_register(code) => None,
            (_, Some(name)) => Some(VerticalUnit::Unsaid(name.to_owned())),
            (Some(USER_DEFINED), None) => Some(VerticalUnit::Unsaid("user-defined".to_owned())),
            _ => None,
        }
    }

    /// What the keys say of the CRS; `None` where they say nothing.
    pub(super) fn crs_hint(&self) -> Option<CrsHint> {
        if let Some(wkt) = self.esri_wkt() {
            return Some(CrsHint::Wkt(wkt));
        }
        let projected = self.code(key::PROJECTED_CRS);
        let geodetic = self.code(key::GEODETIC_CRS);
        match (self.code(key::MODEL_TYPE), projected, geodetic) {
            (Some(1) | None, Some(code), _) if is_register(code) => Some(CrsHint::Epsg(code.into())),
            (Some(2) | None, None, Some(code)) if is_register(code) => Some(CrsHint::Epsg(code.into())),
            (Some(1), _, _) => Some(self.described(self.projected())),
            (Some(2), _, Some(code)) if is_register(code) => Some(CrsHint::Epsg(code.into())),
            (Some(2), _, _) => Some(self.described(self.geographic())),
            (Some(3), _, _) => Some(self.unknown("geocentric coordinates")),
            (Some(other), _, _) if other != 0 && other != USER_DEFINED => {
                Some(self.unknown(&format!("model type {other}")))
            }
            _ => None,
        }
    }

    fn described(&self, proj: Result<String, String>) -> CrsHint {
        match proj {
            Ok(text) => CrsHint::Proj(text),
            Err(why) => self.unknown(&why),
        }
    }

    fn unknown(&self, why: &str) -> CrsHint {
        let citation = [key::PROJECTED_CITATION, key::CITATION, key::GEODETIC_CITATION]
            .into_iter()
            .find_map(|k| self.text(k));
        match citation {
            Some(name) => CrsHint::Unknown(format!("{name}: {why}")),
            None => CrsHint::Unknown(why.to_owned()),
        }
    }

    /// The well-known text that Esri's programs write into a citation.
    fn esri_wkt(&self) -> Option<String> {
        [key::PROJECTED_CITATION, key::CITATION, key::GEODETIC_CITATION]
            .into_iter()
            .filter_map(|k| self.text(k))
            .find_map(|t| t.strip_prefix("ESRI PE String = ").map(str::to_owned))
    }

    /// The PROJ string of a user-defined projected CRS.
    fn projected(&self) -> Result<String, String> {
        if let Some(unit) = self.code(key::LINEAR_UNITS).filter(|u| *u != METRE) {
            return Err(format!("its linear unit EPSG:{unit} is not the metre"));
        }
        self.check_degrees()?;
        let datum = self.datum()?;
        let projection = match self.code(key::PROJECTION) {
            Some(code @ 16001..=16060) => format!("+proj=utm +zone={}", code - 16000),
            Some(code @ 16101..=16160) => format!("+proj=utm +zone={} +south", code - 16100),
            _ => self.method()?,
        };
        Ok(format!("{projection} {datum} +units=m +no_defs"))
    }

    /// The projection method with its parameters.
    fn method(&self) -> Result<String, String> {
        let name = match self.code(key::METHOD) {
            Some(1) => return Ok(format!("+proj=tmerc {} {}", self.natural_origin(), self.scale())),
            Some(7) => return Ok(format!("+proj=merc {} {}", self.natural_origin(), self.scale())),
            Some(9) => return Ok(self.conic_at_one_parallel()),
            Some(10) => "laea",
            Some(8) => return Ok(format!("+proj=lcc {}", self.two_parallels())),
            Some(11) => return Ok(format!("+proj=aea {}", self.two_parallels())),
            Some(other) => return Err(format!("projection method {other} is not supported")),
            None => return Err("the projection is not described".to_owned()),
        };
        Ok(format!("+proj={name} {}", self.natural_origin()))
    }

    fn natural_origin(&self) -> String {
        let lat = self.first_of(&[key::ORIGIN_LAT, key::CENTER_LAT]);
        let lon = self.first_of(&[key::ORIGIN_LON, key::CENTER_LON]);
        format!("+lat_0={lat} +lon_0={lon} {}", self.false_offsets())
    }

    fn conic_at_one_parallel(&self) -> String {
        let lat = self.first_of(&[key::ORIGIN_LAT, key::PARALLEL_1]);
        format!("+proj=lcc +lat_1={lat} {} {}", self.natural_origin(), self.scale())
    }

    fn two_parallels(&self) -> String {
        let lat = self.first_of(&[key::FALSE_ORIGIN_LAT, key::ORIGIN_LAT, key::CENTER_LAT]);
        let lon = self.first_of(&[key::FALSE_ORIGIN_LON, key::ORIGIN_LON, key::CENTER_LON]);
        let (one, two) = (self.first_of(&[key::PARALLEL_1]), self.first_of(&[key::PARALLEL_2]));
        format!("+lat_1={one} +lat_2={two} +lat_0={lat} +lon_0={lon} {}", self.false_offsets())
    }

    fn false_offsets(&self) -> String {
        let x = self.first_of(&[key::FALSE_EASTING, key::FALSE_ORIGIN_EASTING]);
        let y = self.first_of(&[key::FALSE_NORTHING, key::FALSE_ORIGIN_NORTHING]);
        format!("+x_0={x} +y_0={y}")
    }

    fn scale(&self) -> String {
        format!("+k={}", self.number(key::SCALE).unwrap_or(1.0))
    }

    /// The PROJ string of a user-defined geographic CRS.
    fn geographic(&self) -> Result<String, String> {
        self.check_degrees()?;
        Ok(format!("+proj=longlat {} +no_defs", self.datum()?))
    }

    fn check_degrees(&self) -> Result<(), String> {
        if let Some(unit) = self.code(key::ANGULAR_UNITS).filter(|u| *u != DEGREE) {
            return Err(format!("its angular unit EPSG:{unit} is not the degree"));
        }
        match self.code(key::PRIME_MERIDIAN) {
            None | Some(8901) => Ok(()),
            Some(other) => Err(format!("its prime meridian EPSG:{other} is not Greenwich")),
        }
    }

    /// The datum or at least the ellipsoid, by the geodetic CRS, the datum's code or its name.
    fn datum(&self) -> Result<String, String> {
        let code = |key| self.code(key).filter(|code| is_register(*code)).map(u32::from);
        let known = code(key::GEODETIC_CRS).and_then(datum_text::of_geographic);
        if let Some(known) = known.or_else(|| code(key::DATUM).and_then(datum_text::of_datum)) {
            return Ok(known);
        }
        let ellipsoid = self.ellipsoid()?;
        let shift = self.datum_name().and_then(|name| datum_text::shift_named(name, &ellipsoid));
        Ok(shift.map_or(ellipsoid.clone(), |shift| format!("{ellipsoid} {shift}")))
    }

    /// The name of the datum, or of the geographic CRS on it: GDAL writes `GCS Name = A|Datum = B|...`, others the name alone.
    fn datum_name(&self) -> Option<&str> {
        let citation = self.text(key::GEODETIC_CITATION)?;
        let named = |start: &str| citation.split('|').find_map(|part| part.trim().strip_prefix(start));
        named("Datum = ").or_else(|| named("GCS Name = ")).or(Some(citation))
    }

    /// The ellipsoid, by its code or its axes.
    fn ellipsoid(&self) -> Result<String, String> {
        if let Some(known) = self.code(key::ELLIPSOID).and_then(of_ellipsoid) {
            return Ok(known.to_owned());
        }
        let semi_major = self.number(key::SEMI_MAJOR).ok_or("its ellipsoid is not described")?;
        if let Some(rf) = self.number(key::INVERSE_FLATTENING) {
            Ok(format!("+a={semi_major} +rf={rf}"))
        } else {
            let semi_minor = self.number(key::SEMI_MINOR).unwrap_or(semi_major);
            Ok(format!("+a={semi_major} +b={semi_minor}"))
        }
    }

    fn code(&self, key: u16) -> Option<u16> {
        match self.keys.get(&key)? {
            Value::Code(code) => Some(*code),
            _ => None,
        }
    }

    fn number(&self, key: u16) -> Option<f64> {
        match self.keys.get(&key)? {
            Value::Number(number) => Some(*number).filter(|n| n.is_finite()),
            _ => None,
        }
    }

    fn text(&self, key: u16) -> Option<&str> {
        match self.keys.get(&key)? {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    /// The first of some keys that is present; 0, as the standard has it, where none is.
    fn first_of(&self, keys: &[u16]) -> f64 {
        keys.iter().find_map(|k| self.number(*k)).unwrap_or(0.0)
    }
}

/// The value of a key: in place, or in one of the two tags.
fn value(place: u16, count: u16, at: u16, numbers: &[f64], text: &str) -> Option<Value> {
    let (at_index, count) = (usize::from(at), usize::from(count));
    match place {
        0 => Some(Value::Code(at)),
        34736 => numbers.get(at_index).copied().map(Value::Number),
        34737 => {
            let text = text.get(at_index..at_index + count)?;
            Some(Value::Text(text.trim_end_matches(['|', '\0']).trim().to_owned()))
        }
        _ => None,
    }
}

fn is_register(code: u16) -> bool {
    code != 0 && code != USER_DEFINED
}

fn of_ellipsoid(code: u16) -> Option<&'static str> {
    Some(match code {
        7001 => "+ellps=airy",
        7004 => "+ellps=bessel",
        7008 => "+ellps=clrk66",
        7019 => "+ellps=GRS80",
        7022 => "+ellps=intl",
        7024 => "+ellps=krass",
        7030 => "+ellps=WGS84",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crs::Crs;

    fn keys(entries: &[[u16; 4]], numbers: &[f64], text: &str) -> GeoKeys {
        let mut directory = vec![1, 1, 0, entries.len() as u16];
        directory.extend(entries.iter().flatten());
        GeoKeys::new(&directory, numbers, text)
    }

    #[test]
    fn register_codes_are_taken_as_they_are() {
        let utm = keys(&[[1024, 0, 1, 1], [2048, 0, 1, 4326], [3072, 0, 1, 32733]], &[], "");
        assert_eq!(utm.crs_hint(), Some(CrsHint::Epsg(32733)));
        let wgs = keys(&[[1024, 0, 1, 2], [1025, 0, 1, 2], [2048, 0, 1, 4326]], &[], "");
        assert_eq!(wgs.crs_hint(), Some(CrsHint::Epsg(4326)));
        assert!(wgs.pixel_is_point());
    }

    #[test]
    fn a_described_transverse_mercator_becomes_a_proj_string() {
        let numbers = [0.0, 173.0, 0.9996, 1_600_000.0, 10_000_000.0];
        let nztm = keys(
            &[
                [1024, 0, 1, 1],
                [2048, 0, 1, 4167],
                [3072, 0, 1, 32767],
                [3074, 0, 1, 32767],
                [3075, 0, 1, 1],
                [3076, 0, 1, 9001],
                [3081, 34736, 1, 0],
                [3080, 34736, 1, 1],
                [3092, 34736, 1, 2],
                [3082, 34736, 1, 3],
                [3083, 34736, 1, 4],
            ],
            &numbers,
            "",
        );
        let expected = "+proj=tmerc +lat_0=0 +lon_0=173 +x_0=1600000 +y_0=10000000 +k=0.9996 \
                        +ellps=GRS80 +towgs84=0,0,0,0,0,0,0 +units=m +no_defs";
        assert_eq!(nztm.crs_hint(), Some(CrsHint::Proj(expected.into())));
    }

    /// What is said of the datum of a transverse Mercator that is described, with some keys of its datum.
    fn note_of(datum: &[[u16; 4]], citation: &str) -> (Crs, Option<String>) {
        let length = citation.len() as u16;
        let own = [
            [1024, 0, 1, 1],
            [2049, 34737, length, 0],
            [3072, 0, 1, 32767],
            [3075, 0, 1, 1],
            [3076, 0, 1, 9001],
        ];
        let entries: Vec<[u16; 4]> = own.iter().chain(datum).copied().collect();
        let Some(CrsHint::Proj(text)) = keys(&entries, &[], citation).crs_hint() else { panic!("{datum:?}") };
        let crs = Crs::from_proj_string(&text).unwrap();
        let note = crs.note();
        (crs, note)
    }

    #[test]
    fn datums_known_by_code_or_name_alone_have_their_shifts() {
        let (wgs84, _) = note_of(&[[2048, 0, 1, 4326]], "WGS 84");
        let user = [[2048, 0, 1, 32767], [2050, 0, 1, 32767], [2056, 0, 1, 7019]];
        // SIRGAS 2000, NAD83(CSRS), GDA2020, ETRS89, NAD83, by the code of the degrees and of the datum, and by names.
        for (codes, citation) in [
            (&[[2048, 0, 1, 4674]][..], "x"),
            (&[[2048, 0, 1, 4617]], "x"),
            (&[[2048, 0, 1, 7844]], "x"),
            (&[[2048, 0, 1, 4258]], "x"),
            (&[[2048, 0, 1, 4269]], "x"),
            (&[[2048, 0, 1, 32767], [2050, 0, 1, 6674]], "x"),
            (&[[2050, 0, 1, 1168]], "x"),
            (&[[2050, 0, 1, 6140]], "x"),
            (&user, "SIRGAS 2000"),
            (&user, "GCS Name = unnamed|Datum = GDA2020|Ellipsoid = GRS 1980|Primem = Greenwich|"),
            (&user, "GCS_ETRS_1989"),
        ] {
            let (crs, note) = note_of(codes, citation);
            assert_eq!(note, None, "{codes:?} {citation}");
            assert!(crs.is_same(&wgs84), "{codes:?} {citation}: {}", crs.name());
        }
        // On other ellipsoids, and on this one too: known shifts are shifts.
        for codes in
            [&[[2048, 0, 1, 4230]][..], &[[2048, 0, 1, 4312]], &[[2050, 0, 1, 6312]], &[[2048, 0, 1, 4121]]]
        {
            let (crs, note) = note_of(codes, "x");
            let place = glam::DVec2::new(0.5, 45.0);
            let off =
                crs.native_from_geographic(place).unwrap() - wgs84.native_from_geographic(place).unwrap();
            assert!(note.is_none() && off.length() > 50.0, "{codes:?}: {off} {note:?}");
        }
        for (codes, citation) in [(&user[..], "Barsoom"), (&[[2048, 0, 1, 32767], [2056, 0, 1, 7004]], "x")] {
            assert!(note_of(codes, citation).1.is_some(), "{citation}");
        }
    }

    #[test]
    fn foreign_units_are_named() {
        let feet = keys(
            &[
                [1024, 0, 1, 1],
                [3072, 0, 1, 32767],
                [3073, 34737, 6, 0],
                [3076, 0, 1, 9003],
                [4099, 0, 1, 9002],
            ],
            &[],
            "Maine|",
        );
        let Some(CrsHint::Unknown(why)) = feet.crs_hint() else {
            panic!("a CRS in feet is not understood");
        };
        assert!(why.starts_with("Maine: ") && why.contains("EPSG:9003"), "{why}");
        assert_eq!(feet.vertical_unit().map(|unit| unit.metres()), Some(0.3048));
    }

    #[test]
    fn the_vertical_crs_tells_the_unit_where_no_key_does() {
        let metres = |entries: &[[u16; 4]]| keys(entries, &[], "").vertical_unit().map(|unit| unit.metres());
        let survey_foot = Some(1200.0 / 3937.0);
        assert_eq!(metres(&[[1024, 0, 1, 1], [3072, 0, 1, 2263], [4096, 0, 1, 6360]]), survey_foot);
        assert_eq!(metres(&[[1024, 0, 1, 1], [3072, 0, 1, 8712]]), survey_foot);
        assert_eq!(metres(&[[1024, 0, 1, 1], [3072, 0, 1, 32633], [4096, 0, 1, 5773]]), None);
        assert_eq!(metres(&[[4096, 0, 1, 6358], [4099, 0, 1, 9001]]), Some(-1.0));
        assert_eq!(metres(&[[4096, 0, 1, 32767], [4099, 0, 1, 9002]]), Some(0.3048));
    }

    #[test]
    fn keys_that_point_nowhere_are_left_out() {
        let keys = GeoKeys::new(&[1, 1, 0, 900, 3082, 34736, 1, 7, 1026, 34737, 50, 3, 1024], &[1.0], "é");
        assert_eq!(keys, GeoKeys::default());
        assert_eq!(keys.crs_hint(), None);
        assert_eq!(GeoKeys::new(&[], &[], ""), GeoKeys::default());
    }
}
