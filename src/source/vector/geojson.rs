//! GeoJSON: RFC 7946, and the `crs` member of its predecessor of 2008.
//!
//! Parsed by `serde_json` straight into vertices, a feature at a time: the `geojson` crate's reader keeps all
//! properties and takes the first `[` of the file for the features, which a `bbox` before them breaks. Nesting is
//! bounded by `serde_json` (128).

use super::bytes::contents_of;
use super::collector::Collector;
use crate::crs::Crs;
use crate::error::{Error, Position, Result};
use crate::space::Plan;
use serde::Deserialize;
use serde::de::{self, DeserializeSeed, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};
use std::fmt;
use std::path::Path;

/// Reads a GeoJSON file.
pub(super) fn read(path: &Path) -> Result<Collector> {
    let bytes = contents_of(path)?;
    read_text(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes))
}

fn read_text(text: &[u8]) -> Result<Collector> {
    let mut reading = Reading::default();
    let mut json = serde_json::Deserializer::from_slice(text);
    let parsed = (&mut reading).deserialize(&mut json).and_then(|top| json.end().map(|()| top));
    let top = match (parsed, reading.failure.take()) {
        (_, Some(failure)) => return Err(failure),
        (Err(e), None) => return Err(malformed(&e, &reading)),
        (Ok(top), None) => top,
    };
    let mut found = reading.found;
    found.crs = crs_of(top.crs.as_ref(), &mut found.notes);
    add_top(top, &mut found)?;
    found.finish();
    Ok(found)
}

fn malformed(e: &serde_json::Error, reading: &Reading) -> Error {
    let whole = e.to_string();
    let place = format!(" at line {} column {}", e.line(), e.column());
    let error = Error::new(format!("this is not GeoJSON: {}", whole.strip_suffix(&place).unwrap_or(&whole)))
        .help("check that the file was copied whole; one object a file, numbers and not NaN as coordinates")
        .at(Position { line: e.line(), column: if e.column() == 0 { 1 } else { e.column() }, length: 1 });
    if reading.in_features { error.in_feature(reading.found.current()) } else { error }
}

/// What the parser carries along.
#[derive(Default)]
struct Reading {
    found: Collector,
    failure: Option<Error>,
    in_features: bool,
}

/// The members of the outermost object that matter; features have been added when it is done.
#[derive(Default)]
struct Top {
    kind: String,
    had_features: bool,
    geometry: Option<Geometry>,
    coordinates: Option<Coordinates>,
    geometries: Vec<Geometry>,
    /// `Some(null)` is a CRS that is said to be unknown.
    crs: Option<serde_json::Value>,
}

#[derive(Deserialize)]
struct RawFeature {
    geometry: Option<Geometry>,
}

#[derive(Deserialize)]
struct Geometry {
    #[serde(rename = "type")]
    kind: String,
    coordinates: Option<Coordinates>,
    #[serde(default)]
    geometries: Vec<Self>,
}

/// Nested arrays of numbers, told apart as they are read.
enum Coordinates {
    Number(f64),
    Point(Plan),
    Path(Vec<Plan>),
    Nest(Vec<Self>),
}

impl<'de> Deserialize<'de> for Coordinates {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        deserializer.deserialize_any(CoordinatesVisitor)
    }
}

struct CoordinatesVisitor;

impl<'de> Visitor<'de> for CoordinatesVisitor {
    type Value = Coordinates;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("coordinates")
    }

    fn visit_f64<E>(self, x: f64) -> std::result::Result<Coordinates, E> {
        Ok(Coordinates::Number(x))
    }

    fn visit_i64<E>(self, x: i64) -> std::result::Result<Coordinates, E> {
        Ok(Coordinates::Number(x as f64))
    }

    fn visit_u64<E>(self, x: u64) -> std::result::Result<Coordinates, E> {
        Ok(Coordinates::Number(x as f64))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> std::result::Result<Coordinates, A::Error> {
        match seq.next_element()? {
            None => Ok(Coordinates::Nest(Vec::new())),
            Some(Coordinates::Number(x)) => position(x, seq),
            Some(Coordinates::Point(p)) => path(p, seq),
            Some(first) => nest(first, seq),
        }
    }
}

/// x, y, and a height or more that are dropped.
fn position<'de, A: SeqAccess<'de>>(x: f64, mut seq: A) -> std::result::Result<Coordinates, A::Error> {
    let y = seq.next_element()?.ok_or_else(|| de::Error::custom("a position has one number only"))?;
    while seq.next_element::<IgnoredAny>()?.is_some() {}
    Ok(Coordinates::Point(Plan::new(x, y)))
}

fn path<'de, A: SeqAccess<'de>>(first: Plan, mut seq: A) -> std::result::Result<Coordinates, A::Error> {
    let mut points = vec![first];
    while let Some(next) = seq.next_element()? {
        let Coordinates::Point(p) = next else {
            return Err(de::Error::custom("a list of positions holds something else"));
        };
        points.push(p);
    }
    Ok(Coordinates::Path(points))
}

fn nest<'de, A: SeqAccess<'de>>(
    first: Coordinates,
    mut seq: A,
) -> std::result::Result<Coordinates, A::Error> {
    let mut inner = vec![first];
    while let Some(next) = seq.next_element()? {
        if matches!(next, Coordinates::Number(_) | Coordinates::Point(_)) {
            return Err(de::Error::custom("coordinates are nested unevenly"));
        }
        inner.push(next);
    }
    Ok(Coordinates::Nest(inner))
}

impl<'de> DeserializeSeed<'de> for &mut Reading {
    type Value = Top;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> std::result::Result<Top, D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for &mut Reading {
    type Value = Top;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a GeoJSON object")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> std::result::Result<Top, A::Error> {
        let mut top = Top::default();
        while let Some(key) = map.next_key::<String>()? {
            match key.as_str() {
                "type" => top.kind = map.next_value()?,
                "geometry" => top.geometry = map.next_value()?,
                "coordinates" => top.coordinates = map.next_value()?,
                "geometries" => top.geometries = map.next_value()?,
                "crs" => top.crs = Some(map.next_value()?),
                "features" => {
                    map.next_value_seed(Features(self))?;
                    top.had_features = true;
                }
                _ => {
                    map.next_value::<IgnoredAny>()?;
                }
            }
        }
        Ok(top)
    }
}

/// The array of features, added one by one.
struct Features<'a>(&'a mut Reading);

impl<'de> DeserializeSeed<'de> for Features<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> std::result::Result<(), D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for Features<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an array of features")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> std::result::Result<(), A::Error> {
        self.0.in_features = true;
        while let Some(feature) = seq.next_element::<RawFeature>()? {
            if let Err(e) = add_feature(feature.geometry, &mut self.0.found) {
                self.0.failure = Some(e);
                return Err(de::Error::custom("stopped at a feature"));
            }
        }
        self.0.in_features = false;
        Ok(())
    }
}

fn add_top(top: Top, found: &mut Collector) -> Result<()> {
    match top.kind.as_str() {
        "FeatureCollection" if top.had_features => Ok(()),
        "FeatureCollection" => Err(Error::new("the FeatureCollection has no features member")
            .help("check that the file was written whole")),
        "Feature" => add_feature(top.geometry, found),
        "Topology" => Err(Error::new("TopoJSON is not supported").help("convert it to GeoJSON")),
        _ => add_feature(
            Some(Geometry { kind: top.kind, coordinates: top.coordinates, geometries: top.geometries }),
            found,
        ),
    }
}

fn add_feature(geometry: Option<Geometry>, found: &mut Collector) -> Result<()> {
    match geometry {
        Some(geometry) => {
            let index = found.current();
            add_geometry(geometry, found).map_err(|e| e.in_feature(index))?;
        }
        None => found.leave_out_empty(),
    }
    found.next_feature();
    Ok(())
}

fn add_geometry(geometry: Geometry, found: &mut Collector) -> Result<()> {
    let Geometry { kind, coordinates, geometries } = geometry;
    let coordinates = coordinates.unwrap_or(Coordinates::Nest(Vec::new()));
    match kind.as_str() {
        "Point" => found.leave_out_points(1),
        "MultiPoint" => found.leave_out_points(match coordinates {
            Coordinates::Path(points) => points.len(),
            _ => 0,
        }),
        "LineString" => found.add_line(paths(coordinates, 0)?)?,
        "MultiLineString" => found.add_line(paths(coordinates, 1)?)?,
        "Polygon" => found.add_polygon(paths(coordinates, 1)?)?,
        "MultiPolygon" => found.add_polygon(paths(coordinates, 2)?)?,
        "GeometryCollection" if geometries.is_empty() => found.leave_out_empty(),
        "GeometryCollection" => {
            for part in geometries {
                add_geometry(part, found)?;
            }
        }
        other => {
            let known: String = other.chars().take(40).collect();
            return Err(Error::new(format!("'{known}' is no type of GeoJSON"))
                .help("the types are FeatureCollection, Feature, (Multi)Point, (Multi)LineString, (Multi)Polygon, GeometryCollection"));
        }
    }
    Ok(())
}

/// The lists of positions `depth` arrays down; empty arrays may stand anywhere.
fn paths(coordinates: Coordinates, depth: usize) -> Result<Vec<Vec<Plan>>> {
    match (coordinates, depth) {
        (Coordinates::Path(points), 0) => Ok(vec![points]),
        (Coordinates::Nest(inner), _) if inner.is_empty() => Ok(Vec::new()),
        (Coordinates::Nest(inner), 1..) => {
            let mut all = Vec::with_capacity(inner.len());
            for part in inner {
                all.append(&mut paths(part, depth - 1)?);
            }
            Ok(all)
        }
        _ => Err(Error::new("the coordinates are not nested as the geometry's type asks")
            .help("a LineString is a list of positions, a Polygon a list of such lists, a MultiPolygon a list of those")),
    }
}

/// No `crs` member means longitude and latitude on WGS 84; one that is null, that nothing is known.
fn crs_of(member: Option<&serde_json::Value>, notes: &mut Vec<String>) -> Option<Crs> {
    let Some(member) = member else {
        return Crs::crs84().ok();
    };
    let name = member.get("properties").and_then(|p| p.get("name")).and_then(|n| n.as_str());
    let read = match name {
        Some(name) => Crs::parse(name),
        None => Err(Error::new("it names none")),
    };
    read.map_err(|e| notes.push(format!("the CRS in the crs member is not understood: {}", e.what()))).ok()
}
