//! What features are called, by a bundle's `features.geojson`.

use serde::Deserialize;
use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// The file.
pub(super) const FILE: &str = "features.geojson";

#[derive(Debug, Deserialize)]
struct Collection {
    features: Vec<Feature>,
}

/// Geometries are passed over.
#[derive(Debug, Deserialize)]
struct Feature {
    id: Option<Value>,
    #[serde(default)]
    properties: Map<String, Value>,
}

/// The names of features by the places of their layer and of themselves in it. Where `features.geojson` is none, nothing has a name.
pub(super) fn names(bytes: &[u8]) -> BTreeMap<(u32, u32), String> {
    let Ok(Collection { features }) = serde_json::from_slice(bytes) else { return BTreeMap::new() };
    let mut names = BTreeMap::new();
    // The file is in the order in which layers are drawn.
    let (mut layer, mut feature, mut last) = (0, 0, None);
    for Feature { id, properties } in &features {
        let of = properties.get("layer");
        match last.replace(of) {
            None => {}
            Some(before) if before == of => feature += 1,
            Some(_) => (layer, feature) = (layer + 1, 0),
        }
        let place = id.as_ref().and_then(place).unwrap_or((layer, feature));
        names.insert(place, name(properties, place));
    }
    names
}

/// A feature that says its own place, `LAYER/FEATURE`.
fn place(id: &Value) -> Option<(u32, u32)> {
    let (layer, feature) = id.as_str()?.split_once('/')?;
    Some((layer.parse().ok()?, feature.parse().ok()?))
}

fn name(properties: &Map<String, Value>, place: (u32, u32)) -> String {
    let text = |key: &str| properties.get(key).and_then(Value::as_str).filter(|text| !text.is_empty());
    let layer = text("layer").map_or_else(|| format!("layer {}", place.0), |layer| format!("`{layer}`"));
    let number = properties.get("number").and_then(Value::as_u64).unwrap_or(u64::from(place.1));
    match ["name", "Name", "NAME"].into_iter().find_map(text) {
        Some(name) => format!("{layer} feature {number} ({name})"),
        None => format!("{layer} feature {number}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn features_are_found_by_their_order_or_by_the_place_that_they_tell() {
        let file = r#"{"type":"FeatureCollection","features":[
            {"type":"Feature","properties":{"layer":"roads","number":4,"name":"High Street"},"geometry":null},
            {"type":"Feature","properties":{"layer":"roads","number":null},"geometry":{"type":"Point","coordinates":[0,0]}},
            {"type":"Feature","properties":{"layer":"lakes"},"geometry":null},
            {"type":"Feature","id":"7/9","properties":{"layer":"fields"},"geometry":null}]}"#;
        let found: Vec<((u32, u32), String)> = names(file.as_bytes()).into_iter().collect();
        let wanted = [
            ((0, 0), "`roads` feature 4 (High Street)"),
            ((0, 1), "`roads` feature 1"),
            ((1, 0), "`lakes` feature 0"),
            ((7, 9), "`fields` feature 9"),
        ];
        assert_eq!(found, wanted.map(|(place, name)| (place, name.to_owned())));
        assert!(names(b"{}").is_empty());
    }
}
