//! Well-known text: WKT 1 (OGC and Esri) and WKT 2, by way of a PROJ string.
//!
//! An EPSG code at the root wins over the parameters; without one the parameters are used, and the datum's shift
//! is looked up by its name (see [`super::wkt_names`]).

use super::datum::Datum;
use super::ellipsoid::Ellipsoid;
use super::wkt_names::{self, simplified};
use super::{Crs, Definition};
use crate::error::{Error, Result};
use std::fmt::Write;

const DEEPEST: usize = 24;
const LONGEST: usize = 200_000;

pub(crate) fn parse(text: &str) -> Result<Crs> {
    crs_of(&root(text)?)
}

fn root(text: &str) -> Result<Node> {
    if text.len() > LONGEST {
        return Err(malformed("it is longer than any CRS"));
    }
    Reader { text, at: 0 }.node(0)
}

/// The degrees in a unit of a geographic CRS; 1 where the text says nothing.
pub(crate) fn degrees_per_unit_of(text: &str) -> f64 {
    let root = root(text).ok();
    root.as_ref().and_then(|root| root.find(&GEOGRAPHIC)).map_or(1.0, degrees_per_unit)
}

fn malformed(why: &str) -> Error {
    Error::new(format!("the WKT of the CRS cannot be read: {why}"))
        .help("check the .prj file, or name the CRS by its EPSG code")
}

/// `KEYWORD[arguments]`.
#[derive(Debug, Clone)]
struct Node {
    keyword: String,
    arguments: Vec<Argument>,
}

#[derive(Debug, Clone)]
enum Argument {
    Text(String),
    Number(f64),
    Node(Node),
}

struct Reader<'a> {
    text: &'a str,
    at: usize,
}

impl Reader<'_> {
    fn rest(&self) -> &str {
        self.text.get(self.at..).unwrap_or("")
    }

    fn skip_blanks(&mut self) {
        let rest = self.rest();
        self.at += rest.len() - rest.trim_start().len();
    }

    fn peek(&mut self) -> Option<char> {
        self.skip_blanks();
        self.rest().chars().next()
    }

    fn take(&mut self, wanted: &[char]) -> Option<char> {
        let c = self.peek().filter(|c| wanted.contains(c))?;
        self.at += c.len_utf8();
        Some(c)
    }

    fn word(&mut self) -> String {
        self.skip_blanks();
        let rest = self.rest();
        let end = rest.find(|c: char| !(c.is_alphanumeric() || "_+-.".contains(c))).unwrap_or(rest.len());
        let word = rest[..end].to_owned();
        self.at += end;
        word
    }

    fn node(&mut self, depth: usize) -> Result<Node> {
        let keyword = self.word().to_ascii_uppercase();
        match self.argument_after(keyword, depth)? {
            Argument::Node(node) => Ok(node),
            _ => Err(malformed("it does not begin with a keyword and a bracket")),
        }
    }

    fn argument_after(&mut self, word: String, depth: usize) -> Result<Argument> {
        if depth > DEEPEST {
            return Err(malformed("its brackets are nested too deep"));
        }
        if self.take(&['[', '(']).is_none() {
            let number = word.parse::<f64>().ok().filter(|x| x.is_finite());
            return Ok(number.map_or(Argument::Text(word), Argument::Number));
        }
        let mut arguments = Vec::new();
        while self.take(&[']', ')']).is_none() {
            let before = self.at;
            arguments.push(self.argument(depth)?);
            let _ = self.take(&[',']);
            if self.at == before || self.peek().is_none() {
                return Err(malformed("a bracket is not closed"));
            }
        }
        Ok(Argument::Node(Node { keyword: word.to_ascii_uppercase(), arguments }))
    }

    fn argument(&mut self, depth: usize) -> Result<Argument> {
        if self.take(&['"']).is_some() {
            return self.quoted().map(Argument::Text);
        }
        let word = self.word();
        self.argument_after(word, depth + 1)
    }

    /// The rest of a quoted text; two quotes in it stand for one.
    fn quoted(&mut self) -> Result<String> {
        let mut text = String::new();
        loop {
            let rest = self.rest();
            let end = rest.find('"').ok_or_else(|| malformed("a quote is not closed"))?;
            text.push_str(&rest[..end]);
            self.at += end + 1;
            if !self.rest().starts_with('"') {
                return Ok(text);
            }
            text.push('"');
            self.at += 1;
        }
    }
}

impl Node {
    fn children(&self) -> impl Iterator<Item = &Self> {
        self.arguments.iter().filter_map(|a| match a {
            Argument::Node(node) => Some(node),
            _ => None,
        })
    }

    fn child(&self, keywords: &[&str]) -> Option<&Self> {
        self.children().find(|n| keywords.contains(&n.keyword.as_str()))
    }

    /// The first node of one of these keywords, at any depth.
    fn find(&self, keywords: &[&str]) -> Option<&Self> {
        if keywords.contains(&self.keyword.as_str()) {
            return Some(self);
        }
        self.children().find_map(|n| n.find(keywords))
    }

    fn text(&self, index: usize) -> Option<&str> {
        match self.arguments.get(index) {
            Some(Argument::Text(text)) => Some(text),
            _ => None,
        }
    }

    fn number(&self, index: usize) -> Option<f64> {
        match self.arguments.get(index) {
            Some(Argument::Number(x)) => Some(*x),
            Some(Argument::Text(text)) => text.trim().parse().ok().filter(|x: &f64| x.is_finite()),
            _ => None,
        }
    }

    fn name(&self) -> &str {
        self.text(0).unwrap_or("unnamed")
    }

    fn epsg(&self) -> Option<u32> {
        let id = self.children().find(|n| {
            matches!(n.keyword.as_str(), "AUTHORITY" | "ID") && n.name().eq_ignore_ascii_case("EPSG")
        })?;
        let code = id.number(1)?;
        ((1.0..1e6).contains(&code) && code == code.floor()).then_some(code as u32)
    }
}

const PROJECTED: [&str; 3] = ["PROJCS", "PROJCRS", "PROJECTEDCRS"];
const GEOGRAPHIC: [&str; 8] = [
    "GEOGCS",
    "GEOGCRS",
    "GEODCRS",
    "GEODETICCRS",
    "GEOGRAPHICCRS",
    "BASEGEOGCRS",
    "BASEGEODCRS",
    "BASEGEODETICCRS",
];
const UNIT: [&str; 2] = ["UNIT", "LENGTHUNIT"];
const ANGLE: [&str; 2] = ["UNIT", "ANGLEUNIT"];

fn crs_of(root: &Node) -> Result<Crs> {
    let node = root.find(&PROJECTED).or_else(|| root.find(&GEOGRAPHIC)).ok_or_else(|| {
        Error::unsupported(format!("a {} is not a CRS of places on the earth", root.keyword))
            .help("georeference the data, or name the CRS by its EPSG code")
    })?;
    if let Some(Ok(crs)) = node.epsg().map(Crs::from_epsg) {
        return Ok(crs);
    }
    let geographic =
        node.find(&GEOGRAPHIC).ok_or_else(|| malformed("a projected CRS lacks its geographic one"))?;
    let mut crs = match proj4_extension(node) {
        Some(text) => Crs::from_proj_string(text)?,
        None => crs_of_parameters(node, geographic)?,
    };
    settle(&mut crs, geographic)?;
    crs.name = node.name().to_owned();
    Ok(crs)
}

/// GDAL writes what WKT 1 cannot say (Web Mercator) as a PROJ string.
fn proj4_extension(node: &Node) -> Option<&str> {
    let extension = node.child(&["EXTENSION"]).filter(|n| n.name() == "PROJ4")?;
    extension.text(1).filter(|text| text.contains("proj="))
}

fn crs_of_parameters(node: &Node, geographic: &Node) -> Result<Crs> {
    let angle = degrees_per_unit(geographic);
    let mut text = match PROJECTED.contains(&node.keyword.as_str()) {
        true => projection_text(node, angle)? + axes_of(node),
        false => "+proj=longlat".to_owned(),
    };
    let ellipsoid = ellipsoid_of(geographic)?;
    let _ = write!(text, " +a={} +rf={}", ellipsoid.0, ellipsoid.1);
    if let Some(meridian) = prime_meridian_of(geographic) {
        let _ = write!(text, " +pm={meridian}");
    }
    if let Some(shift) = geographic.find(&["TOWGS84"]) {
        let numbers: Vec<String> = (0..7).map(|i| shift.number(i).unwrap_or(0.0).to_string()).collect();
        let _ = write!(text, " +towgs84={}", numbers.join(","));
    }
    Crs::from_definition(&Definition::parse(&text)?)
}

/// Set what a PROJ string cannot say: the unit of angles, and the shift of a datum that is known by name alone.
fn settle(crs: &mut Crs, geographic: &Node) -> Result<()> {
    if crs.is_geographic() {
        crs.unit = degrees_per_unit(geographic);
    }
    if crs.datum != Datum::Unknown {
        return Ok(());
    }
    let (a, rf) = ellipsoid_of(geographic)?;
    let ellipsoid = Ellipsoid::from_inverse_flattening(a, rf);
    let by_code = geographic.epsg().map(|code| wkt_names::datum_of_code(code, &ellipsoid));
    let datum = geographic.find(&["DATUM", "GEODETICDATUM", "TRF", "ENSEMBLE"]);
    crs.datum = match (by_code, datum) {
        (Some(known), _) if known != Datum::Unknown => known,
        (_, Some(datum)) => wkt_names::datum_named(datum.name(), &ellipsoid),
        _ => Datum::Unknown,
    };
    Ok(())
}

/// The unit of angles in degrees; exactly 1 for every spelling of a degree.
fn degrees_per_unit(geographic: &Node) -> f64 {
    let own = geographic.child(&ANGLE);
    let of_axis = || geographic.child(&["AXIS"]).and_then(|axis| axis.child(&ANGLE));
    let radians = own.or_else(of_axis).and_then(|unit| unit.number(1)).unwrap_or(0.0);
    let degrees = radians.to_degrees();
    if degrees < 1e-6 || (degrees - 1.0).abs() < 1e-9 { 1.0 } else { degrees }
}

fn ellipsoid_of(geographic: &Node) -> Result<(f64, f64)> {
    let spheroid = geographic.find(&["SPHEROID", "ELLIPSOID"]);
    let sizes = spheroid.and_then(|s| Some((s.number(1)?, s.number(2)?)));
    let (a, rf) = sizes.ok_or_else(|| malformed("its ellipsoid lacks a size"))?;
    let snapped = Ellipsoid::from_inverse_flattening(a, rf);
    // Some writers round WGS 84's flattening: a hundredth of a micrometre is no other ellipsoid.
    if a == Ellipsoid::WGS84.a && (snapped.b() - Ellipsoid::WGS84.b()).abs() < 1e-7 {
        return Ok((a, 298.257_223_563));
    }
    Ok((a, rf))
}

/// In degrees whatever the unit of the CRS, unless it states its own: that is how GDAL and Esri write it.
fn prime_meridian_of(geographic: &Node) -> Option<f64> {
    let meridian = geographic.child(&["PRIMEM", "PRIMEMERIDIAN"])?;
    let own = meridian.child(&ANGLE).and_then(|unit| unit.number(1)).map(f64::to_degrees);
    let degrees = meridian.number(1)? * own.unwrap_or(1.0);
    (degrees != 0.0).then_some(degrees)
}

/// The axes of a survey that counts west and south. (East and north are meant in this order, whatever the text's.)
fn axes_of(node: &Node) -> &'static str {
    let mut directions = node.children().filter(|n| n.keyword == "AXIS").filter_map(|axis| axis.text(1));
    let mut next = || directions.next().unwrap_or("").to_ascii_lowercase();
    match (next().as_str(), next().as_str()) {
        ("west", "south") => " +axis=wsu",
        ("south", "west") => " +axis=swu",
        _ => "",
    }
}

fn projection_text(node: &Node, angle: f64) -> Result<String> {
    let conversion = node.child(&["CONVERSION", "DERIVINGCONVERSION"]).unwrap_or(node);
    let method =
        conversion.child(&["PROJECTION", "METHOD"]).ok_or_else(|| malformed("it names no projection"))?;
    let metres = metres_per_unit(node);
    let mut parameters = Vec::new();
    for parameter in conversion.children().filter(|n| n.keyword == "PARAMETER") {
        if let Some((key, value)) = parameter_of(parameter, angle, metres)? {
            parameters.push((key, value));
        }
    }
    wkt_names::proj_text(&simplified(method.name()), method.name(), &parameters, metres)
}

/// Key and value in PROJ's terms: degrees, metres, ratios.
fn parameter_of(parameter: &Node, angle: f64, metres: f64) -> Result<Option<(&'static str, f64)>> {
    let Some(key) = wkt_names::parameter_key(&simplified(parameter.name())) else {
        return Ok(None);
    };
    let value = parameter.number(1).ok_or_else(|| malformed("a parameter lacks its number"))?;
    let own = |keywords: &[&str]| parameter.child(keywords).and_then(|unit| unit.number(1));
    let factor = match key {
        "x_0" | "y_0" => own(&UNIT).unwrap_or(metres),
        "k_0" => 1.0,
        _ => own(&ANGLE).map_or(angle, f64::to_degrees),
    };
    let exact = if (factor - 1.0).abs() < 1e-12 { value } else { value * factor };
    Ok(Some((key, exact)))
}

fn metres_per_unit(node: &Node) -> f64 {
    let own = node.child(&UNIT);
    let of_axis = || node.child(&["AXIS"]).and_then(|axis| axis.child(&UNIT));
    let unit = own.or_else(of_axis).and_then(|unit| unit.number(1));
    unit.filter(|metres| *metres > 0.0).unwrap_or(1.0)
}
