//! What the names in WKT stand for: projections, their parameters, datums.

use super::datum::Datum;
use super::ellipsoid::Ellipsoid;
use super::epsg;
use super::proj_string::Definition;
use crate::error::{Error, Result};
use std::fmt::Write;

/// A name's letters and digits in lower case: `Lambert_Conformal_Conic (2SP)` -> `lambertconformalconic2sp`.
pub(crate) fn simplified(name: &str) -> String {
    name.chars().filter(char::is_ascii_alphanumeric).map(|c| c.to_ascii_lowercase()).collect()
}

/// PROJ's key of a parameter.
pub(crate) fn parameter_key(name: &str) -> Option<&'static str> {
    Some(match name {
        "latitudeoforigin"
        | "latitudeofcenter"
        | "latitudeofcentre"
        | "latitudeofnaturalorigin"
        | "latitudeoffalseorigin"
        | "latitudeofprojectioncentre" => "lat_0",
        "centralmeridian"
        | "longitudeofcenter"
        | "longitudeofcentre"
        | "longitudeofnaturalorigin"
        | "longitudeoffalseorigin"
        | "longitudeoforigin"
        | "longitudeofprojectioncentre" => "lon_0",
        "standardparallel1" | "latitudeof1ststandardparallel" | "latitudeofstandardparallel" => "lat_1",
        "standardparallel2" | "latitudeof2ndstandardparallel" => "lat_2",
        "scalefactor"
        | "scalefactoratnaturalorigin"
        | "scalefactoratprojectioncentre"
        | "scalefactoroninitialline" => "k_0",
        "falseeasting" | "eastingatfalseorigin" | "eastingatprojectioncentre" => "x_0",
        "falsenorthing" | "northingatfalseorigin" | "northingatprojectioncentre" => "y_0",
        "azimuth" | "azimuthofinitialline" | "azimuthatprojectioncentre" => "alpha",
        "rectifiedgridangle" | "anglefromrectifiedtoskewgrid" => "gamma",
        _ => return None,
    })
}

/// The PROJ string of a projection and its parameters, without the ellipsoid.
pub(crate) fn proj_text(
    method: &str,
    name: &str,
    parameters: &[(&'static str, f64)],
    metres: f64,
) -> Result<String> {
    let value = |key: &str| parameters.iter().find(|p| p.0 == key).map(|p| p.1);
    // Esri's plain name is that of a pole's projection and of any place's alike; the latter is not the double one.
    let is_other = method == "stereographic" && value("lat_0").is_none_or(|lat| lat.abs() != 90.0);
    let proj = proj_of(method, value("alpha")).filter(|_| !is_other).ok_or_else(|| {
        Error::unsupported(format!("the projection '{name}' is not supported"))
            .help("reproject the data, for example to UTM, or name the CRS by its EPSG code")
    })?;
    let mut text = format!("+proj={proj}");
    for (key, number) in parameters {
        let key = match (proj, *key) {
            ("merc" | "stere" | "eqc" | "cea", "lat_1") => "lat_ts",
            // WKT 1 calls the latitude of true scale of a polar projection its origin.
            ("stere", "lat_0") if number.abs() < 90.0 => "lat_ts",
            ("stere", "lat_0") => continue,
            ("omerc", "lon_0") => "lonc",
            ("somerc", "alpha" | "gamma") | ("krovak", "lat_1") => continue,
            ("webmerc", "lat_1" | "alpha") => continue,
            (_, key) => key,
        };
        let _ = write!(text, " +{key}={number}");
    }
    if method == "behrmann" {
        text += " +lat_ts=30";
    }
    if proj == "stere" {
        let south = value("lat_1").or(value("lat_0")).unwrap_or(90.0) < 0.0;
        text += if south { " +lat_0=-90" } else { " +lat_0=90" };
    }
    if matches!(
        method,
        "hotineobliquemercator"
            | "hotineobliquemercatorvarianta"
            | "hotineobliquemercatorazimuthnaturalorigin"
    ) {
        text += " +no_uoff";
    }
    if metres != 1.0 {
        let _ = write!(text, " +to_meter={metres}");
    }
    Ok(text)
}

fn proj_of(method: &str, azimuth: Option<f64>) -> Option<&'static str> {
    Some(match method {
        "transversemercator" | "gausskruger" | "gausskrger" => "tmerc",
        "lambertconformalconic"
        | "lambertconformalconic1sp"
        | "lambertconformalconic2sp"
        | "lambertconformalconic2spbelgium"
        | "lambertconicconformal1sp"
        | "lambertconicconformal2sp" => "lcc",
        "mercatorauxiliarysphere" | "popularvisualisationpseudomercator" => "webmerc",
        "mercator" | "mercator1sp" | "mercator2sp" | "mercatorvarianta" | "mercatorvariantb" => "merc",
        "albers" | "albersconicequalarea" | "albersequalarea" => "aea",
        "lambertazimuthalequalarea" => "laea",
        "polarstereographic"
        | "polarstereographicvarianta"
        | "polarstereographicvariantb"
        | "stereographicnorthpole"
        | "stereographicsouthpole"
        | "stereographic" => "stere",
        "obliquestereographic" | "doublestereographic" => "sterea",
        "cassinisoldner" | "cassini" => "cass",
        "polyconic" | "americanpolyconic" => "poly",
        "equirectangular" | "platecarree" | "equidistantcylindrical" => "eqc",
        "azimuthalequidistant" | "modifiedazimuthalequidistant" => "aeqd",
        "cylindricalequalarea" | "lambertcylindricalequalarea" | "behrmann" => "cea",
        "swissobliquecylindrical" | "swissobliquemercator" => "somerc",
        "hotineobliquemercator"
        | "hotineobliquemercatorvarianta"
        | "hotineobliquemercatorazimuthnaturalorigin" => "omerc",
        "hotineobliquemercatorazimuthcenter"
        | "hotineobliquemercatorvariantb"
        | "rectifiedskeworthomorphiccenter" => {
            let square = azimuth.is_some_and(|a| (a - 90.0).abs() < 1e-9);
            if square { "somerc" } else { "omerc" }
        }
        "krovak" => "krovak",
        _ => return None,
    })
}

/// Datums whose usual names in WKT are not those of EPSG, each with the code of its geographic CRS.
const ALIASES: [(&str, u32); 41] = [
    ("mgi", 4312),
    ("militargeographischeinstitut", 4312),
    ("europeandatum1950", 4230),
    ("osgb36", 4277),
    ("ordnancesurveyofgreatbritain1936", 4277),
    ("dhdn", 4314),
    ("ch1903plus", 4150),
    ("sjtsk", 4156),
    ("systemofthecdastraltrigonometricalnetwork", 4156),
    ("pulkovo1942", 4284),
    ("northamerican1927", 4267),
    ("ntf", 4275),
    ("romamm", 4265),
    ("ggrs1987", 4121),
    ("israel", 4141),
    ("twd1997", 3824),
    ("moznet", 4130),
    ("hartebeesthoek1994", 4148),
    ("swisstrf1995", 4151),
    ("swissterrestrialreferencesystem1995", 4151),
    ("yemenngn1996", 4163),
    ("regven", 4189),
    ("ngn", 4318),
    ("mexicanof1993", 4483),
    ("rraf1991", 4558),
    ("rgfg1995", 4624),
    ("rgr1992", 4627),
    ("islandsnetwork1993", 4659),
    ("islandsnetwork2004", 5324),
    ("latviangeodeticcoordinatesystem1992", 4661),
    ("lithuania1994", 4669),
    ("igm1995", 4670),
    ("magna", 4686),
    ("koreageodetic2002", 4737),
    ("koreangeodetic2002", 4737),
    ("gdm2000", 4742),
    ("ptra08", 5013),
    ("gdbd2009", 5246),
    ("marcogeodesiconacional", 5354),
    ("kyrgyzrepublic2006", 7686),
    ("macao2008", 8431),
];

/// How the names of datums begin that are WGS 84 within its own realisations, in all their spellings and realisations.
const AGREEING: [&str; 23] = [
    "wgs1984",
    "wgs84",
    "worldgeodeticsystem1984",
    "itrf",
    "internationalterrestrialreferenceframe",
    "igs",
    "igb",
    "etrs",
    "etrf",
    "europeanterrestrialreference",
    "northamerican1983",
    "northamericanof1983",
    "nad83",
    "nad1983",
    "gda1994",
    "gda2020",
    "nzgd2000",
    "jgd2000",
    "jgd2011",
    "sirgas",
    "posgar",
    "rgf1993",
    "reseaugeodesiquefrancais1993",
];

/// The codes among which EPSG's geographic CRSs are.
pub(crate) const GEOGRAPHIC_CODES: std::ops::Range<u32> = 3800..10_000;

/// What is known of a datum by its name: the shift that EPSG's geographic CRS of that datum has here. Nothing of a name that is not
/// known, whatever its ellipsoid.
pub(crate) fn datum_named(name: &str, ellipsoid: &Ellipsoid) -> Datum {
    let wanted = datum_key(name);
    if ellipsoid.agrees_with(&Ellipsoid::WGS84) && AGREEING.iter().any(|start| wanted.starts_with(start)) {
        return Datum::Wgs84;
    }
    let alias = ALIASES.iter().find(|a| a.0 == wanted).map(|a| a.1);
    let named = |code: &u32| {
        epsg::known(*code)
            .filter(|known| known.wkt.starts_with("GEOGCS"))
            .and_then(|d| Some(datum_key(d.wkt.split_once("DATUM[\"")?.1.split('"').next()?)))
            .is_some_and(|key| Some(*code) == alias || key == wanted)
    };
    let codes = alias.into_iter().chain(GEOGRAPHIC_CODES).filter(named);
    let mut known = codes.map(|code| datum_of_code(code, ellipsoid)).filter(|datum| *datum != Datum::Unknown);
    known.next().unwrap_or(Datum::Unknown)
}

/// What is known of the datum of EPSG's CRS of a code; nothing where it is on another ellipsoid.
pub(crate) fn datum_of_code(code: u32, ellipsoid: &Ellipsoid) -> Datum {
    let listed = || {
        let definition = Definition::parse(&epsg::known(code)?.proj).ok()?;
        let theirs = definition.ellipsoid().ok()?;
        let datum = definition.listed_datum(&theirs).ok()?;
        theirs.agrees_with(ellipsoid).then_some(datum)
    };
    listed().unwrap_or(Datum::Unknown)
}

/// `D_European_1950`, `European_Datum_1950` -> `european1950`.
fn datum_key(name: &str) -> String {
    let name = name.strip_prefix("D_").unwrap_or(name);
    simplified(name).replace("datum", "")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::crs::datum::Helmert;

    #[test]
    fn esri_and_epsg_names_of_a_datum_find_one_shift() {
        let bessel = Ellipsoid::from_inverse_flattening(6_377_397.155, 299.152_812_8);
        let expected = [577.326, 90.129, 463.919, 5.137, 1.474, 5.297, 2.4232];
        let expected = Datum::Shift(Helmert::from_numbers(&expected).unwrap());
        assert_eq!(datum_named("D_MGI", &bessel), expected);
        assert_eq!(datum_named("Militar_Geographische_Institute", &bessel), expected);
        assert_eq!(datum_named("D_Barsoom", &bessel), Datum::Unknown);
    }

    #[test]
    fn a_name_with_another_ellipsoid_is_another_datum() {
        assert_eq!(
            datum_named("D_MGI", &Ellipsoid::from_inverse_flattening(6_378_388.0, 297.0)),
            Datum::Unknown
        );
    }
}
