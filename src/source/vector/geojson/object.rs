//! The objects of a GeoJSON text: collections, features, bare geometries, one in another.
//!
//! Features are added one by one as they are met, so that a text of any length is never kept.

use super::coordinates::Coordinates;
use super::geometry::{self, Geometry};
use super::properties::Properties;
use crate::error::{Error, Result};
use crate::source::vector::collector::Collector;
use serde::Deserialize;
use serde::de::{self, DeserializeSeed, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};
use std::fmt;

/// What the parser carries along.
#[derive(Default)]
pub(super) struct Reading {
    pub(super) found: Collector,
    /// Why it stopped, where that is not the text's syntax.
    pub(super) failure: Option<Error>,
    /// How many lists of features it is in.
    pub(super) depth: usize,
    /// `null` in the place of a feature.
    pub(super) nulls: usize,
    /// Collections in the place of a feature.
    pub(super) nested: usize,
    /// Geometries in the place of a feature.
    pub(super) bare: usize,
}

/// The members of an object that matter; features among them have been added when it is done.
#[derive(Default)]
pub(super) struct Object {
    pub(super) kind: String,
    pub(super) had_features: bool,
    /// `Some(None)` is a feature that says it has none.
    pub(super) geometry: Option<Option<Geometry>>,
    pub(super) coordinates: Option<Coordinates>,
    pub(super) geometries: Vec<Geometry>,
    /// Where they are wanted and stand before the type; after it they are added at once.
    pub(super) properties: Option<serde_json::Value>,
    /// `Some(null)` is a CRS that is said to be unknown.
    pub(super) crs: Option<serde_json::Value>,
}

/// The members of an object that matter.
#[derive(Deserialize)]
#[serde(field_identifier, rename_all = "lowercase")]
enum Member {
    Type,
    Features,
    Geometry,
    Properties,
    Coordinates,
    Geometries,
    Crs,
    #[serde(other)]
    Other,
}

impl<'de> DeserializeSeed<'de> for &mut Reading {
    type Value = Object;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> std::result::Result<Object, D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for &mut Reading {
    type Value = Object;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.depth > 0 { "a feature" } else { "a GeoJSON object" })
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> std::result::Result<Object, A::Error> {
        let mut object = Object::default();
        while let Some(member) = map.next_key::<Member>()? {
            match member {
                Member::Type => object.kind = map.next_value()?,
                Member::Geometry if object.geometry.is_some() => {
                    return Err(de::Error::duplicate_field("geometry"));
                }
                Member::Geometry => object.geometry = Some(map.next_value()?),
                Member::Coordinates => object.coordinates = map.next_value()?,
                Member::Geometries => object.geometries = map.next_value()?,
                Member::Crs => object.crs = Some(map.next_value()?),
                // Another member of a feature may have this name.
                Member::Features if object.kind != "Feature" => {
                    map.next_value_seed(Features(self))?;
                    object.had_features = true;
                }
                Member::Properties if !self.found.attributes.are_read() => ignore(&mut map)?,
                Member::Properties if object.kind == "Feature" => {
                    map.next_value_seed(Properties(&mut self.found))?;
                }
                Member::Properties if object.kind.is_empty() => object.properties = map.next_value()?,
                Member::Properties | Member::Features | Member::Other => ignore(&mut map)?,
            }
        }
        Ok(object)
    }
}

fn ignore<'de, A: MapAccess<'de>>(map: &mut A) -> std::result::Result<(), A::Error> {
    map.next_value::<IgnoredAny>().map(drop)
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
        let reading = self.0;
        reading.depth += 1;
        while let Some(object) = seq.next_element_seed(OrNull(reading))? {
            let added = match object {
                Some(object) => add_object(object, reading),
                None => {
                    reading.nulls += 1;
                    reading.found.next_feature();
                    Ok(())
                }
            };
            if let Err(e) = added {
                reading.failure = Some(e);
                return Err(de::Error::custom("stopped at a feature"));
            }
        }
        reading.depth -= 1;
        Ok(())
    }
}

/// An object, or `null`.
pub(super) struct OrNull<'a>(pub(super) &'a mut Reading);

impl<'de> DeserializeSeed<'de> for OrNull<'_> {
    type Value = Option<Object>;

    fn deserialize<D: Deserializer<'de>>(
        self,
        deserializer: D,
    ) -> std::result::Result<Option<Object>, D::Error> {
        deserializer.deserialize_option(self)
    }
}

impl<'de> Visitor<'de> for OrNull<'_> {
    type Value = Option<Object>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a feature")
    }

    fn visit_none<E>(self) -> std::result::Result<Option<Object>, E> {
        Ok(None)
    }

    fn visit_some<D: Deserializer<'de>>(
        self,
        deserializer: D,
    ) -> std::result::Result<Option<Object>, D::Error> {
        self.0.deserialize(deserializer).map(Some)
    }
}

/// Adds an object whose features, if it is a collection, have been added.
pub(super) fn add_object(object: Object, reading: &mut Reading) -> Result<()> {
    let Object { kind, had_features, geometry, coordinates, geometries, properties, crs: _ } = object;
    let is_nested = reading.depth > 0;
    match kind.as_str() {
        "FeatureCollection" if had_features => {
            reading.nested += usize::from(is_nested);
            Ok(())
        }
        "FeatureCollection" => Err(Error::new("the FeatureCollection has no features member")
            .help("check that the file was written whole")),
        "Topology" => Err(Error::unsupported("TopoJSON is not supported")
            .help("convert it to GeoJSON: ogr2ogr OUT.geojson IN")),
        "" if !is_nested => Err(Error::new("the object has no `type`, so it is no GeoJSON")
            .help("Esri JSON is converted by: ogr2ogr OUT.geojson IN")),
        // Some writers forget the type of features.
        kind if kind == "Feature" || (is_nested && geometry.is_some()) => {
            let found = &mut reading.found;
            if let Some(properties) = properties {
                let index = found.current();
                let added = Properties(found).deserialize(properties);
                added.map_err(|e| Error::new(format!("this is not GeoJSON: {e}")).in_feature(index))?;
            }
            add_feature(geometry.flatten(), found)
        }
        _ => {
            reading.bare += usize::from(is_nested);
            add_feature(Some(Geometry { kind, coordinates, geometries }), &mut reading.found)
        }
    }
}

fn add_feature(geometry: Option<Geometry>, found: &mut Collector) -> Result<()> {
    match geometry {
        Some(geometry) => {
            let index = found.current();
            geometry::add(geometry, found).map_err(|e| e.in_feature(index))?;
        }
        None => found.leave_out_empty(),
    }
    found.next_feature();
    Ok(())
}
