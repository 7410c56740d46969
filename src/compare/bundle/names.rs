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
    properties: Map<String, Value>,
}

/// The place of what a layer paints outside of all of its features.
const OUTSIDE: u32 = u32::MAX;

/// The names of features by the places of their layer and of themselves in it. Where `features.geojson` is none, nothing has a name.
pub(super) fn names(bytes: &[u8]) -> BTreeMap<(u32, u32), String> {
    let Ok(Collection { features }) = serde_json::from_slice(bytes) else { return BTreeMap::new() };
    features.iter().filter_map(|feature| named(&feature.properties)).collect()
}

/// A feature's place and its name, where it tells its place.
fn named(properties: &Map<String, Value>) -> Option<((u32, u32), String)> {
    let number = |key: &str| u32::try_from(properties.get(key)?.as_u64()?).ok();
    let text = |key: &str| properties.get(key).and_then(Value::as_str).filter(|text| !text.is_empty());
    let layer = number("layer-number")?;
    let called = text("layer").map_or_else(|| format!("layer {layer}"), |layer| format!("`{layer}`"));
    let Some(feature) = number("feature") else {
        return Some(((layer, OUTSIDE), format!("{called}, outside of its features")));
    };
    let own = ["name", "Name", "NAME"].into_iter().find_map(text);
    let own = own.map_or(String::new(), |name| format!(" ({name})"));
    Some(((layer, feature), format!("{called} feature {}{own}", number("number").unwrap_or(feature))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn features_are_found_by_the_places_that_they_tell() {
        let file = r#"{"type":"FeatureCollection","features":[
            {"type":"Feature","properties":{"layer":"roads","layer-number":0,"feature":2,"number":4,"name":"High Street"},"geometry":null},
            {"type":"Feature","properties":{"layer":"roads","layer-number":0,"feature":1},"geometry":{"type":"Point","coordinates":[0,0]}},
            {"type":"Feature","properties":{"layer":"lakes","layer-number":3,"feature":null,"number":null},"geometry":null},
            {"type":"Feature","properties":{"layer":"fields"},"geometry":null}]}"#;
        let found: Vec<((u32, u32), String)> = names(file.as_bytes()).into_iter().collect();
        let wanted = [
            ((0, 1), "`roads` feature 1"),
            ((0, 2), "`roads` feature 4 (High Street)"),
            ((3, u32::MAX), "`lakes`, outside of its features"),
        ];
        assert_eq!(found, wanted.map(|(place, name)| (place, name.to_owned())));
        assert!(names(b"{}").is_empty());
    }
}
