//! The ellipsoid and datum of a CRS that a file describes piece by piece, as tokens of a PROJ string.

use super::datum::{Datum, Helmert};
use super::epsg;
use super::proj_string::Definition;
use super::wkt_names::{GEOGRAPHIC_CODES, datum_named};

/// What a PROJ string says of its datum.
const KEYS: [&str; 9] = ["ellps", "a", "b", "rf", "R", "datum", "towgs84", "nadgrids", "pm"];

/// Those of EPSG's geographic CRS of a code; `None` where there is none in the list.
pub(crate) fn of_geographic(code: u32) -> Option<String> {
    let known = epsg::known(code).filter(|known| known.wkt.starts_with("GEOGCS"))?;
    let definition = Definition::parse(&known.proj).ok()?;
    let datum = definition.listed_datum(&definition.ellipsoid().ok()?).ok()?;
    let key = |token: &str| token.trim_start_matches('+').split('=').next().unwrap_or("").to_owned();
    let mut tokens: Vec<&str> = known.proj.split(' ').filter(|token| KEYS.contains(&&*key(token))).collect();
    let is_said = tokens.iter().any(|token| matches!(&*key(token), "datum" | "towgs84" | "nadgrids"));
    if datum == Datum::Wgs84 && !is_said {
        tokens.push("+towgs84=0,0,0");
    }
    Some(tokens.join(" "))
}

/// Those of EPSG's datum of a code: of a geographic CRS that is on it.
pub(crate) fn of_datum(code: u32) -> Option<String> {
    let authority = format!("AUTHORITY[\"EPSG\",\"{code}\"]],PRIMEM");
    let is_on_it = |crs: &u32| epsg::known(*crs).is_some_and(|known| known.wkt.contains(&authority));
    // EPSG has given most geographic CRSs the code of their datum less 2000.
    let likely = code.checked_sub(2000).filter(|crs| GEOGRAPHIC_CODES.contains(crs));
    likely.into_iter().chain(GEOGRAPHIC_CODES).filter(is_on_it).find_map(of_geographic)
}

/// The shift of a datum that is known by its name, on an ellipsoid that is given as tokens; `None` where the name says nothing.
pub(crate) fn shift_named(name: &str, ellipsoid: &str) -> Option<String> {
    let definition = Definition::parse(&format!("+proj=longlat {ellipsoid}")).ok()?;
    let name = name.strip_prefix("GCS_").unwrap_or(name);
    match datum_named(name, &definition.ellipsoid().ok()?) {
        Datum::Wgs84 => Some("+towgs84=0,0,0".to_owned()),
        Datum::Shift(Helmert { translation: t, rotation: r, scale }) => {
            Some(format!("+towgs84={},{},{},{},{},{},{scale}", t.x, t.y, t.z, r.x, r.y, r.z))
        }
        Datum::Unknown => None,
    }
}
