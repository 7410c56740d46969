//! GeoJSON that is not quite as the standard has it, and sequences of it.

use super::*;
use crate::scene::Attribute;

const LINE: &str = r#"{"type":"LineString","coordinates":[[0,0],[1,1]]}"#;

/// A feature with a line and the property `n`.
fn feature(n: u32) -> String {
    format!(r#"{{"type":"Feature","properties":{{"n":{n}}},"geometry":{LINE}}}"#)
}

fn collection(members: &[String]) -> String {
    format!(r#"{{"type":"FeatureCollection","features":[{}]}}"#, members.join(","))
}

/// The column `n` of each feature that is drawn, and the notes.
fn numbers(name: &str, text: &str) -> (Vec<Attribute>, Vec<String>) {
    let (_folder, path) = file(name, text.as_bytes());
    let read = read_columns(&path, None, &["n".into()]).unwrap_or_else(|e| panic!("{text}: {e}"));
    let value = |f: &crate::scene::Feature| read.columns[0].value(f.index).clone();
    (read.features.iter().map(value).collect(), read.notes)
}

fn counted(upto: u32) -> Vec<Attribute> {
    (1..=upto).map(|n| Attribute::Integer(n.into())).collect()
}

#[test]
fn a_collection_in_the_place_of_a_feature_is_read_and_that_is_said() {
    let inner =
        collection(&[feature(2), collection(&[feature(3)])]).replacen('{', r#"{"properties":{"n":9},"#, 1);
    let (values, notes) = numbers("a.geojson", &collection(&[feature(1), inner, feature(4)]));
    assert_eq!(values, counted(4));
    assert_eq!(notes, ["2 x FeatureCollection in the place of a feature: its features are read"]);
    let deep = (0..200).fold(feature(1), |inner, _| collection(&[inner]));
    assert!(refusal("a.geojson", deep.as_bytes()).contains("recursion limit"));
}

#[test]
fn a_null_and_a_bare_geometry_in_the_place_of_a_feature_are_told() {
    let (values, notes) =
        numbers("a.geojson", &collection(&[feature(1), "null".into(), LINE.into(), feature(2)]));
    assert_eq!(values, [Attribute::Integer(1), Attribute::Null, Attribute::Integer(2)]);
    assert_eq!(
        notes,
        [
            "1 x `null` in the place of a feature: left out",
            "1 x geometry in the place of a feature: read as one without properties"
        ]
    );
    assert!(refusal("a.geojson", collection(&["7".into()]).as_bytes()).contains("expected a feature"));
}

#[test]
fn a_feature_has_its_members_in_any_order_and_may_lack_its_type() {
    let backwards = format!(r#"{{"properties":{{"n":1}},"geometry":{LINE},"type":"Feature"}}"#);
    let untyped = format!(r#"{{"geometry":{LINE},"properties":{{"n":2}}}}"#);
    let odd = feature(3).replacen("\"type\":\"Feature\",", "\"type\":\"Feature\",\"features\":7,", 1);
    assert_eq!(numbers("a.geojson", &collection(&[backwards, untyped, odd])).0, counted(3));
}

#[test]
#[ignore = "writes the seeds for fuzzing into $DRAPERY_SEEDS"]
fn seeds_for_fuzzing_sequences() {
    let texts = [feature(1), collection(&[feature(2), feature(3)])];
    seeds::plant("vector_geojson/sequence", [texts.join("\n"), format!("\u{1e}{}", texts.join("\n\u{1e}"))]);
}

#[test]
fn texts_one_after_the_other_are_one_file_whatever_parts_them() {
    let texts = [feature(1), collection(&[feature(2), feature(3)]), feature(4)];
    for (name, text) in [
        ("a.geojsonl", texts.join("\n")),
        ("a.ndjson", texts.join("\r\n") + "\r\n"),
        ("a.geojsons", texts.iter().map(|text| format!("\u{1e}{text}\n")).collect()),
        ("a.json", texts.concat()),
        ("a.geojson", texts.join("\n\n")),
        ("noname", format!("\u{feff}\u{1e}{}", texts.join("\u{1e}"))),
    ] {
        let (values, notes) = numbers(name, &text);
        assert_eq!((values, notes.len()), (counted(4), 0), "{name}");
    }
    let (_folder, path) = file("a.geojsonl", texts.join("\n").as_bytes());
    assert_eq!(describe(&path).unwrap()[0].features, 4);
}

#[test]
fn a_text_of_a_sequence_that_is_broken_is_refused_by_line_and_feature() {
    let text = format!("{}\n{}\n{{\"type\":\"Feature\",", feature(1), feature(2));
    let refused = refusal("a.geojsonl", text.as_bytes());
    assert!(refused.contains("a.geojsonl:3:") && refused.contains("feature 2"), "{refused}");
    let other = feature(2).replacen('{', r#"{"crs":null,"#, 1);
    let refused = refusal("a.geojsonl", format!("{}\n{other}", feature(1)).as_bytes());
    assert!(refused.contains("different reference systems") && refused.contains("feature 1"), "{refused}");
}
