//! Geometries, added to the current feature.

use super::coordinates::Coordinates;
use crate::error::{Error, Result};
use crate::source::vector::collector::Collector;
use crate::space::Plan;
use serde::Deserialize;

/// A geometry as it is written.
#[derive(Deserialize)]
pub(super) struct Geometry {
    #[serde(rename = "type")]
    pub(super) kind: String,
    pub(super) coordinates: Option<Coordinates>,
    #[serde(default)]
    pub(super) geometries: Vec<Self>,
}

/// Adds a geometry to the current feature.
pub(super) fn add(geometry: Geometry, found: &mut Collector) -> Result<()> {
    let Geometry { kind, coordinates, geometries } = geometry;
    let coordinates = coordinates.unwrap_or(Coordinates::Nest(Vec::new()));
    match kind.as_str() {
        "Point" => match coordinates {
            Coordinates::Point(point) => found.add_points(vec![point])?,
            other => found.add_points(paths(other, 0)?.concat())?,
        },
        "MultiPoint" => found.add_points(paths(coordinates, 0)?.concat())?,
        "LineString" => found.add_line(paths(coordinates, 0)?)?,
        "MultiLineString" => found.add_line(paths(coordinates, 1)?)?,
        "Polygon" => found.add_polygon(paths(coordinates, 1)?)?,
        "MultiPolygon" => found.add_polygons(members(coordinates)?)?,
        "GeometryCollection" if geometries.is_empty() => found.leave_out_empty(),
        "GeometryCollection" => {
            for part in geometries {
                add(part, found)?;
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

/// The rings of each member of a multi-polygon.
fn members(coordinates: Coordinates) -> Result<Vec<Vec<Vec<Plan>>>> {
    match coordinates {
        Coordinates::Nest(inner) => inner.into_iter().map(|member| paths(member, 1)).collect(),
        _ => paths(coordinates, 2).map(|rings| vec![rings]),
    }
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
