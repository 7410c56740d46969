//! PROJ strings (`+proj=utm +zone=33 +south +datum=WGS84`) and what their names stand for.

use super::datum::{Datum, Helmert};
use super::ellipsoid::Ellipsoid;
use crate::error::{Error, Result};
use std::collections::BTreeMap;
use std::fmt;

/// The `+key=value` pairs of a PROJ string; a key without a value has an empty one, the first of equal keys counts.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Definition(BTreeMap<String, String>);

impl fmt::Display for Definition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, (key, value)) in self.0.iter().enumerate() {
            let space = if i == 0 { "" } else { " " };
            let equals = if value.is_empty() { "" } else { "=" };
            write!(f, "{space}+{key}{equals}{value}")?;
        }
        Ok(())
    }
}

impl Definition {
    pub(crate) fn parse(text: &str) -> Result<Self> {
        let mut pairs = BTreeMap::new();
        for token in text.split_whitespace() {
            let token = token.strip_prefix('+').unwrap_or(token);
            let (key, value) = token.split_once('=').unwrap_or((token, ""));
            let key = if key == "k" { "k_0" } else { key };
            pairs.entry(key.to_owned()).or_insert_with(|| value.to_owned());
        }
        if pairs.get("proj").is_none_or(String::is_empty) {
            return Err(Error::new("the PROJ string names no projection")
                .help("write for example '+proj=utm +zone=33 +datum=WGS84', or 'EPSG:32633'"));
        }
        Ok(Self(pairs))
    }

    pub(crate) fn text(&self, key: &str) -> Option<&str> {
        self.0.get(key).map(String::as_str)
    }

    pub(crate) fn forget(&mut self, keys: &[&str]) {
        self.0.retain(|key, _| !keys.contains(&key.as_str()));
    }

    /// The finite number under a key, where there is one.
    pub(crate) fn number(&self, key: &str) -> Result<Option<f64>> {
        self.text(key).map(|text| number(key, text)).transpose()
    }

    pub(crate) fn number_or(&self, key: &str, default: f64) -> Result<f64> {
        Ok(self.number(key)?.unwrap_or(default))
    }

    /// The scale factor.
    pub(crate) fn scale(&self) -> Result<f64> {
        positive("k_0", self.number_or("k_0", 1.0)?)
    }

    /// Whether all pairs are equal, numbers to nine digits.
    pub(crate) fn agrees_with(&self, other: &Self) -> bool {
        let idle = |k: &str, v: &str| {
            matches!(k, "no_defs" | "wktext" | "over" | "type" | "title")
                || v.parse() == Ok(0.0)
                || (k, v) == ("k_0", "1")
                || (k, v) == ("units", "m")
        };
        let ours = self.0.iter().filter(|(k, v)| !idle(k, v));
        let theirs = other.0.iter().filter(|(k, v)| !idle(k, v));
        ours.clone().count() == theirs.clone().count()
            && ours.zip(theirs).all(|(a, b)| a.0 == b.0 && same_value(a.1, b.1))
    }

    pub(crate) fn ellipsoid(&self) -> Result<Ellipsoid> {
        if let Some(key) = ["R_A", "R_V", "R_a", "R_g", "R_h", "R_lat_a", "R_lat_g", "e", "es"]
            .iter()
            .find(|key| self.text(key).is_some())
        {
            return Err(Error::unsupported(format!("+{key} in the PROJ string is not supported"))
                .help("give the ellipsoid as +a= and +rf=, or the sphere as +R="));
        }
        if let Some(radius) = self.number("R")? {
            return Ok(Ellipsoid::from_inverse_flattening(positive("R", radius)?, 0.0));
        }
        if let Some(a) = self.number("a")? {
            return self.ellipsoid_of_radius(positive("a", a)?);
        }
        match (self.text("ellps"), self.text("datum")) {
            (Some(name), _) => ellipsoid_named(name),
            (None, Some(datum)) => ellipsoid_named(known_datum(datum)?.0),
            (None, None) => Ok(Ellipsoid::WGS84),
        }
    }

    fn ellipsoid_of_radius(&self, a: f64) -> Result<Ellipsoid> {
        let f = match (self.number("rf")?, self.number("f")?, self.number("b")?) {
            (Some(rf), _, _) if rf != 0.0 => 1.0 / rf,
            (None, Some(f), _) => f,
            (None, None, Some(b)) => (a - b) / a,
            _ => 0.0,
        };
        if (0.0..0.5).contains(&f) {
            return Ok(Ellipsoid { a, f });
        }
        Err(Error::new(format!("an ellipsoid flattened by {f} is no figure of a planet")))
    }

    /// The datum that is stated; an ellipsoid alone states none.
    pub(crate) fn datum(&self, ellipsoid: &Ellipsoid) -> Result<Datum> {
        if self.text("nadgrids") == Some("@null") {
            return Ok(Datum::Wgs84);
        }
        if let Some(text) = self.text("towgs84") {
            return shift_of_text(text, ellipsoid);
        }
        let name = match (self.text("datum"), self.text("nadgrids")) {
            (Some(name), _) => name,
            (None, Some(grids)) if grids.contains("nzgd2k") => "nzgd49",
            _ => "",
        };
        match known_datum(name) {
            Ok((_, shift)) if !name.is_empty() => shift_of_numbers(shift, ellipsoid),
            _ => Ok(Datum::Unknown),
        }
    }

    /// The datum of a definition in the list of EPSG codes. One on the ellipsoid of WGS 84 or GRS 80 that has no shift there has the
    /// datum WGS 84: all codes of the list were compared with PROJ's. Of other texts that does not hold (GGRS87 is on GRS 80, 300 m off).
    pub(crate) fn listed_datum(&self, ellipsoid: &Ellipsoid) -> Result<Datum> {
        let stated = self.datum(ellipsoid)?;
        let is_wgs84 = stated == Datum::Unknown && ellipsoid.agrees_with(&Ellipsoid::WGS84);
        Ok(if is_wgs84 { Datum::Wgs84 } else { stated })
    }

    /// Degrees east of Greenwich.
    pub(crate) fn prime_meridian(&self) -> Result<f64> {
        let Some(text) = self.text("pm") else {
            return Ok(0.0);
        };
        let named = PRIME_MERIDIANS.iter().find(|m| m.0.eq_ignore_ascii_case(text));
        named.map_or_else(|| number("pm", text), |m| Ok(m.1))
    }

    /// Metres per unit of length.
    pub(crate) fn metres_per_unit(&self) -> Result<f64> {
        if let Some(factor) = self.number("to_meter")? {
            return positive("to_meter", factor);
        }
        let name = self.text("units").unwrap_or("m");
        let known = UNITS.iter().find(|u| u.0 == name);
        known.map(|u| u.1).ok_or_else(|| {
            Error::unsupported(format!("the PROJ string's unit '{name}' is not known"))
                .help("give the metres in a unit as +to_meter=")
        })
    }
}

fn same_value(a: &str, b: &str) -> bool {
    match (a.parse::<f64>(), b.parse::<f64>()) {
        (Ok(a), Ok(b)) => (a - b).abs() <= 1e-9 * (1.0 + a.abs()),
        _ => a == b,
    }
}

fn number(key: &str, text: &str) -> Result<f64> {
    let parsed = text.parse::<f64>().ok().filter(|x| x.is_finite());
    parsed.ok_or_else(|| {
        Error::new(format!("+{key}={text} in the PROJ string is not a number"))
            .help("write degrees and metres as decimals")
    })
}

fn positive(key: &str, value: f64) -> Result<f64> {
    if value > 0.0 && value < 1e12 {
        return Ok(value);
    }
    Err(Error::new(format!("+{key}={value} in the PROJ string is not a positive size")))
}

fn shift_of_text(text: &str, ellipsoid: &Ellipsoid) -> Result<Datum> {
    let numbers: Result<Vec<f64>> = text.split(',').map(|n| number("towgs84", n)).collect();
    shift_of_numbers(&numbers?, ellipsoid)
}

fn shift_of_numbers(numbers: &[f64], ellipsoid: &Ellipsoid) -> Result<Datum> {
    let shift = Helmert::from_numbers(numbers).ok_or_else(|| {
        Error::new(format!("+towgs84 takes 3 or 7 numbers of sensible size, not {numbers:?}"))
    })?;
    if shift.is_zero() && ellipsoid.agrees_with(&Ellipsoid::WGS84) {
        return Ok(Datum::Wgs84);
    }
    Ok(Datum::Shift(shift))
}

fn ellipsoid_named(name: &str) -> Result<Ellipsoid> {
    let found = ELLIPSOIDS.iter().find(|e| e.0.eq_ignore_ascii_case(name));
    found.map(|e| Ellipsoid::from_inverse_flattening(e.1, e.2)).ok_or_else(|| {
        Error::unsupported(format!("the PROJ string's ellipsoid '{name}' is not known"))
            .help("give its radius and inverse flattening as +a= and +rf=")
    })
}

fn known_datum(name: &str) -> Result<(&'static str, &'static [f64])> {
    let found = DATUMS.iter().find(|d| d.0.eq_ignore_ascii_case(name));
    found.map(|d| (d.1, d.2)).ok_or_else(|| {
        Error::unsupported(format!("the PROJ string's datum '{name}' is not known"))
            .help("give its ellipsoid and shift as +ellps= and +towgs84=")
    })
}

/// PROJ's names, equatorial radii and inverse flattenings.
const ELLIPSOIDS: [(&str, f64, f64); 23] = [
    ("WGS84", 6_378_137.0, 298.257_223_563),
    ("GRS80", 6_378_137.0, 298.257_222_101),
    ("bessel", 6_377_397.155, 299.152_812_8),
    ("intl", 6_378_388.0, 297.0),
    ("krass", 6_378_245.0, 298.3),
    ("airy", 6_377_563.396, 299.324_964_6),
    ("mod_airy", 6_377_340.189, 299.324_964_6),
    ("clrk66", 6_378_206.4, 294.978_698_213_898),
    ("clrk80", 6_378_249.145, 293.466_3),
    ("clrk80ign", 6_378_249.2, 293.466_021_293_626_9),
    ("aust_SA", 6_378_160.0, 298.25),
    ("GRS67", 6_378_160.0, 298.247_167_427),
    ("helmert", 6_378_200.0, 298.3),
    ("bess_nam", 6_377_483.865, 299.152_812_8),
    ("evrst30", 6_377_276.345, 300.801_7),
    ("evrstSS", 6_377_298.556, 300.801_7),
    ("WGS66", 6_378_145.0, 298.25),
    ("WGS72", 6_378_135.0, 298.26),
    ("NWL9D", 6_378_145.0, 298.25),
    ("GSK2011", 6_378_136.5, 298.256_415_1),
    ("PZ90", 6_378_136.0, 298.257_84),
    ("hough", 6_378_270.0, 297.0),
    ("sphere", 6_370_997.0, 0.0),
];

/// PROJ's datum names, their ellipsoids and shifts to WGS 84. NAD27's is the mean for the conterminous United States
/// (about 10 m), since PROJ's own answer is a set of grid files.
const DATUMS: [(&str, &str, &[f64]); 10] = [
    ("WGS84", "WGS84", &[0.0, 0.0, 0.0]),
    ("NAD83", "GRS80", &[0.0, 0.0, 0.0]),
    ("NAD27", "clrk66", &[-8.0, 160.0, 176.0]),
    ("GGRS87", "GRS80", &[-199.87, 74.79, 246.62]),
    ("potsdam", "bessel", &[598.1, 73.7, 418.2, 0.202, 0.045, -2.455, 6.7]),
    ("carthage", "clrk80ign", &[-263.0, 6.0, 431.0]),
    ("hermannskogel", "bessel", &[577.326, 90.129, 463.919, 5.137, 1.474, 5.297, 2.4232]),
    ("ire65", "mod_airy", &[482.530, -130.596, 564.557, -1.042, -0.214, -0.631, 8.15]),
    ("nzgd49", "intl", &[59.47, -5.04, 187.44, 0.47, -0.1, 1.024, -4.5993]),
    ("OSGB36", "airy", &[446.448, -125.157, 542.060, 0.1502, 0.2470, 0.8421, -20.4894]),
];

const PRIME_MERIDIANS: [(&str, f64); 14] = [
    ("greenwich", 0.0),
    ("lisbon", -9.131_906_111_111),
    ("paris", 2.337_229_166_667),
    ("bogota", -74.080_916_666_667),
    ("madrid", -3.687_938_888_889),
    ("rome", 12.452_333_333_333),
    ("bern", 7.439_583_333_333),
    ("jakarta", 106.807_719_444_444),
    ("ferro", -17.666_666_666_667),
    ("brussels", 4.367_975),
    ("stockholm", 18.058_277_777_778),
    ("athens", 23.716_337_5),
    ("oslo", 10.722_916_666_667),
    ("copenhagen", 12.577_875),
];

const UNITS: [(&str, f64); 9] = [
    ("m", 1.0),
    ("km", 1000.0),
    ("dm", 0.1),
    ("cm", 0.01),
    ("mm", 0.001),
    ("ft", 0.3048),
    ("us-ft", 1200.0 / 3937.0),
    ("ind-ft", 0.304_798_41),
    ("link", 0.201_168),
];
