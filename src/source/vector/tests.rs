mod archive;
mod attributes;
#[cfg(feature = "gpkg")]
mod curves;
mod geojson;
mod kinds;
mod osm;
mod shapefile;

use super::*;
use crate::scene::Shape;
use crate::seeds;
use crate::space::Plan;
use proptest::prelude::*;
use std::path::PathBuf;

/// A file with these bytes, in a folder that goes when it is dropped.
fn file(name: &str, bytes: &[u8]) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    (folder, path)
}

fn read_bytes(name: &str, bytes: &[u8]) -> Result<VectorFile> {
    let (_folder, path) = file(name, bytes);
    read(&path, None)
}

fn refusal(name: &str, bytes: &[u8]) -> String {
    let error = read_bytes(name, bytes).expect_err("must be refused");
    assert!(error.path().is_some() && !error.is_internal(), "{error}");
    assert!(error.help_text().is_some(), "{error}");
    error.to_string()
}

const SQUARE: [(f64, f64); 5] = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0), (0.0, 0.0)];

/// A shapefile of one kind with the given contents of records.
pub(super) fn shp(kind: u32, records: &[Vec<u8>]) -> Vec<u8> {
    let body: usize = records.iter().map(|r| r.len() + 8).sum();
    let mut out = vec![0; 100];
    out[..4].copy_from_slice(&9994_u32.to_be_bytes());
    out[24..28].copy_from_slice(&((body as u32 + 100) / 2).to_be_bytes());
    out[28..32].copy_from_slice(&1000_u32.to_le_bytes());
    out[32..36].copy_from_slice(&kind.to_le_bytes());
    for (i, record) in records.iter().enumerate() {
        out.extend((i as u32 + 1).to_be_bytes());
        out.extend((record.len() as u32 / 2).to_be_bytes());
        out.extend(record);
    }
    out
}

fn shp_parts(kind: u32, parts: &[&[(f64, f64)]]) -> Vec<u8> {
    let mut out = kind.to_le_bytes().to_vec();
    out.extend([0; 32]);
    let points: usize = parts.iter().map(|p| p.len()).sum();
    out.extend((parts.len() as u32).to_le_bytes());
    out.extend((points as u32).to_le_bytes());
    let mut start = 0_u32;
    for part in parts {
        out.extend(start.to_le_bytes());
        start += part.len() as u32;
    }
    for (x, y) in parts.iter().copied().flatten() {
        out.extend(x.to_le_bytes());
        out.extend(y.to_le_bytes());
    }
    out
}

fn wkb_polygon() -> Vec<u8> {
    let mut out = vec![b'G', b'P', 0, 1, 0, 0, 0, 0];
    out.extend([1]);
    out.extend(3_u32.to_le_bytes());
    out.extend(1_u32.to_le_bytes());
    out.extend(5_u32.to_le_bytes());
    for (x, y) in SQUARE {
        out.extend(x.to_le_bytes());
        out.extend(y.to_le_bytes());
    }
    out
}

/// A GeoPackage with these layers, each with one geometry.
#[cfg(feature = "gpkg")]
fn gpkg(layers: &[&str], blob: &[u8]) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("made.gpkg");
    let db = rusqlite::Connection::open(&path).unwrap();
    db.execute_batch(
        "PRAGMA page_size = 512;
         CREATE TABLE gpkg_contents (table_name TEXT, data_type TEXT);
         CREATE TABLE gpkg_geometry_columns (table_name TEXT, column_name TEXT, srs_id INTEGER);
         CREATE TABLE gpkg_spatial_ref_sys (srs_id INTEGER, organization TEXT, organization_coordsys_id INTEGER, definition TEXT);
         INSERT INTO gpkg_spatial_ref_sys VALUES (32733, 'EPSG', 32733, '');",
    )
    .unwrap();
    for layer in layers {
        let double = layer.replace('"', "\"\"");
        db.execute_batch(&format!(
            "CREATE TABLE \"{double}\" (fid INTEGER PRIMARY KEY, geom BLOB);
             INSERT INTO gpkg_contents VALUES ('{layer}', 'features');
             INSERT INTO gpkg_geometry_columns VALUES ('{layer}', 'geom', 32733);"
        ))
        .unwrap();
        db.execute(&format!("INSERT INTO \"{double}\" (geom) VALUES (?1)"), [blob]).unwrap();
    }
    drop(db);
    std::fs::read(&path).unwrap()
}

fn fgb() -> Vec<u8> {
    fgb_of(::flatgeobuf::GeometryType::Polygon, |writer| {
        for shift in [0.0, 10.0, 20.0] {
            let rings = SQUARE.map(|(x, y)| format!("[{},{}]", x + shift, y)).join(",");
            let json = format!(r#"{{"type":"Polygon","coordinates":[[{rings}]]}}"#);
            add_json(writer, &json);
        }
    })
}

/// A FlatGeobuf whose header says this type.
fn fgb_of(stated: ::flatgeobuf::GeometryType, add: impl FnOnce(&mut ::flatgeobuf::FgbWriter<'_>)) -> Vec<u8> {
    use ::flatgeobuf::{FgbCrs, FgbWriter, FgbWriterOptions};
    let options = FgbWriterOptions {
        crs: FgbCrs { code: 32733, ..Default::default() },
        detect_type: false,
        promote_to_multi: false,
        ..Default::default()
    };
    let mut writer = FgbWriter::create_with_options("made", stated, options).unwrap();
    add(&mut writer);
    let mut out = Vec::new();
    writer.write(&mut out).unwrap();
    out
}

/// Draws a polygon's ring into a writer by hand: the feature that reads GeoJSON is off.
fn add_json(writer: &mut ::flatgeobuf::FgbWriter<'_>, json: &str) {
    let value: serde_json::Value = serde_json::from_str(json).unwrap();
    let ring: Vec<(f64, f64)> = value["coordinates"][0]
        .as_array()
        .unwrap()
        .iter()
        .map(|p| (p[0].as_f64().unwrap(), p[1].as_f64().unwrap()))
        .collect();
    let mut wkb = vec![1];
    wkb.extend(3_u32.to_le_bytes());
    wkb.extend(1_u32.to_le_bytes());
    wkb.extend((ring.len() as u32).to_le_bytes());
    for (x, y) in ring {
        wkb.extend(x.to_le_bytes());
        wkb.extend(y.to_le_bytes());
    }
    writer.add_feature_geom(geozero::wkb::Wkb(wkb), |_| {}).unwrap();
}

const JSON: &str = r#"{"bbox":[0,0,1,1],"type":"FeatureCollection","features":[
 {"type":"Feature","properties":{"a":[1,{"b":2}]},"geometry":{"type":"Polygon","coordinates":[[[0,0,9],[4,0,9],[4,4,9],[0,0,9]],[[1,1],[2,1],[2,2],[1,1]]]}},
 {"type":"Feature","geometry":{"coordinates":[1,2],"type":"Point"},"properties":null},
 {"type":"Feature","geometry":null,"properties":{}},
 {"type":"Feature","geometry":{"type":"GeometryCollection","geometries":[
   {"type":"LineString","coordinates":[[0,0],[1,1]]},{"type":"MultiPolygon","coordinates":[[[[0,0],[1,0],[0,1],[0,0]]],[[[5,5],[6,5],[5,6],[5,5]]]]}]}}
]}"#;

fn polygon_of(file: &VectorFile, at: usize) -> &[Vec<Plan>] {
    match &file.features[at].shape {
        Shape::Polygon(rings) => rings,
        _ => panic!("no polygon"),
    }
}

/// How many vertices each ring of each member of a feature has.
fn members_of(file: &VectorFile, at: usize) -> Vec<Vec<usize>> {
    match &file.features[at].shape {
        Shape::MultiPolygon(members) => {
            members.iter().map(|rings| rings.iter().map(Vec::len).collect()).collect()
        }
        other => panic!("no multi-polygon: {other:?}"),
    }
}

#[test]
fn geojson_keeps_order_and_indices_and_tells_what_it_leaves_out() {
    let read = read_bytes("a.geojson", JSON.as_bytes()).unwrap();
    let indices: Vec<usize> = read.features.iter().map(|f| f.index).collect();
    assert_eq!(indices, [0, 1, 3, 3]);
    assert!(matches!(&read.features[1].shape, Shape::Points(points) if points.len() == 1));
    assert_eq!(polygon_of(&read, 0).iter().map(Vec::len).collect::<Vec<_>>(), [3, 3]);
    assert_eq!(members_of(&read, 3), [[3], [3]]);
    assert!(matches!(&read.features[2].shape, Shape::Line(parts) if parts[0].len() == 2));
    assert_eq!(read.notes, ["1 geometry without coordinates left out"]);
    assert!(read.crs.unwrap().is_geographic());
}

#[test]
fn rings_that_enclose_nothing_are_told() {
    let text = r#"{"type":"MultiPolygon","coordinates":[[[[0,0]]],[[[0,0],[1,1],[0,0]]],[[[0,0],[1,0],[0,1],[0,0]]]]}"#;
    let read = read_bytes("a.geojson", text.as_bytes()).unwrap();
    assert_eq!(read.notes, ["2 rings of fewer than 3 vertices: nothing lies in them"]);
    let text = r#"{"type":"Polygon","coordinates":[[[0,0]]]}"#;
    let read = read_bytes("a.geojson", text.as_bytes()).unwrap();
    assert_eq!(read.notes, ["1 ring of fewer than 3 vertices: nothing lies in it"]);
}

#[test]
fn geojson_may_be_a_feature_or_a_bare_geometry() {
    for text in [
        r#"{"type":"Feature","geometry":{"type":"LineString","coordinates":[[0,0],[1,1e0]]}}"#,
        "\u{feff}{\"coordinates\":[[0,0],[1,1]],\"type\":\"LineString\"}",
        r#"{"type":"GeometryCollection","geometries":[{"type":"MultiLineString","coordinates":[[],[[0,0],[1,1]]]}]}"#,
    ] {
        let read = read_bytes("a.json", text.as_bytes()).unwrap();
        assert_eq!(read.features.len(), 1, "{text}");
    }
}

#[test]
fn geojson_honours_the_old_crs_member_wherever_it_stands() {
    for (crs, expected) in [
        (
            r#"{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::32733"}}"#,
            Some("EPSG:32733 (WGS 84 / UTM zone 33S)"),
        ),
        ("null", None),
    ] {
        let text = format!(r#"{{"type":"FeatureCollection","features":[],"crs":{crs}}}"#);
        let read = read_bytes("a.json", text.as_bytes()).unwrap();
        assert_eq!(read.crs.as_ref().map(Crs::name), expected);
    }
}

#[test]
fn geojson_errors_tell_line_and_feature() {
    let text = JSON.replace("[4,0,9]", "[4,NaN]");
    let refused = refusal("a.geojson", text.as_bytes());
    assert!(refused.contains("a.geojson:2:") && refused.contains("feature 0"), "{refused}");
    let refused = refusal("a.geojson", JSON.replace("[[0,0],[1,1]]", "[[[0,0],[1,1]]]").as_bytes());
    assert!(refused.contains("feature 3"), "{refused}");
    for bad in [
        r#"{"type":"Topology"}"#,
        r#"{"type":"FeatureCollection"}"#,
        "{",
        r#"{"type":"Polygon","coordinates":[[[0,0],[1,1e999]]]}"#,
        r#"{"type":"LineString","coordinates":[[0,0],[1]]}"#,
        r#"{"type":"Circle"}"#,
        r#"{"type":"LineString","coordinates":[[0,0],null]}"#,
    ] {
        let _ = refusal("a.json", bad.as_bytes());
    }
}

#[test]
fn json_nested_ten_thousand_deep_is_refused() {
    let deep = format!("{{\"type\":\"Polygon\",\"coordinates\":{}", "[".repeat(10_000));
    let _ = refusal("a.json", deep.as_bytes());
    let deep = format!("{{\"x\":{}", "{\"x\":".repeat(10_000));
    let _ = refusal("a.json", deep.as_bytes());
    let deep = r#"{"type":"GeometryCollection","geometries":["#.repeat(10_000);
    let _ = refusal("a.json", deep.as_bytes());
}

#[test]
fn polygons_of_a_collection_are_members_of_one_feature_and_its_lines_one_line() {
    let square = "[[[0,0],[4,0],[4,4],[0,0]]]";
    let text = format!(
        r#"{{"type":"GeometryCollection","geometries":[{{"type":"Polygon","coordinates":{square}}},
        {{"type":"LineString","coordinates":[[0,0],[1,1]]}},{{"type":"MultiPolygon","coordinates":[{square},{square}]}},
        {{"type":"GeometryCollection","geometries":[{{"type":"LineString","coordinates":[[2,2],[3,3],[4,4]]}}]}}]}}"#
    );
    let read = read_bytes("a.geojson", text.as_bytes()).unwrap();
    assert_eq!(read.features.iter().map(|f| f.index).collect::<Vec<_>>(), [0, 0]);
    assert_eq!(members_of(&read, 0), [[3], [3], [3]]);
    assert!(matches!(&read.features[1].shape, Shape::Line(parts) if parts.len() == 2 && parts[1].len() == 3));
}

/// A square's ring, closed; `clockwise`: an outer one of a shapefile.
fn square_ring(x: f64, half: f64, clockwise: bool) -> Vec<(f64, f64)> {
    let mut ring =
        vec![(x - half, -half), (x + half, -half), (x + half, half), (x - half, half), (x - half, -half)];
    if clockwise {
        ring.reverse();
    }
    ring
}

#[test]
fn rings_of_a_shapefile_that_turn_clockwise_are_members_and_the_others_holes_in_the_smallest_around_them() {
    let members = |rings: &[Vec<(f64, f64)>]| {
        let rings: Vec<&[(f64, f64)]> = rings.iter().map(Vec::as_slice).collect();
        let read = read_bytes("a.shp", &shp(5, &[shp_parts(5, &rings)])).unwrap();
        match &read.features[0].shape {
            Shape::MultiPolygon(members) => members.iter().map(Vec::len).collect(),
            Shape::Polygon(rings) => vec![rings.len()],
            _ => panic!("no polygon"),
        }
    };
    // A hole before its ring, an island in the hole with a hole of its own, and a ring beside them.
    let rings = [
        square_ring(0.0, 3.0, false),
        square_ring(0.0, 4.0, true),
        square_ring(0.0, 2.0, true),
        square_ring(0.0, 1.0, false),
        square_ring(9.0, 1.0, true),
    ];
    assert_eq!(members(&rings), [2, 2, 1]);
    let overlapping = [square_ring(0.0, 2.0, true), square_ring(0.0, 1.0, true)];
    assert_eq!(members(&overlapping), [1, 1]);
    // Both outer rings are around both holes: each hole is of the ring before it.
    let holed = [
        square_ring(0.0, 4.0, true),
        square_ring(0.0, 1.0, false),
        square_ring(0.0, 5.0, true),
        square_ring(0.0, 2.0, false),
    ];
    assert_eq!(members(&holed), [2, 2]);
    // Without a clockwise ring beside another nothing is told by turns.
    assert_eq!(members(&[square_ring(0.0, 2.0, false), square_ring(0.0, 1.0, false)]), [2]);
    assert_eq!(members(&[square_ring(0.0, 2.0, true), square_ring(5.0, 1.0, false)]), [2]);
}

#[test]
fn shapefile_parts_become_rings_without_closing_vertices() {
    let bytes = shp(
        5,
        &[shp_parts(5, &[&SQUARE, &[(1.0, 1.0), (2.0, 1.0), (1.0, 1.0)]]), 0_u32.to_le_bytes().to_vec()],
    );
    let read = read_bytes("a.shp", &bytes).unwrap();
    assert_eq!(polygon_of(&read, 0).iter().map(Vec::len).collect::<Vec<_>>(), [4, 2]);
    assert_eq!(
        read.notes,
        [
            "there is no .prj beside the file, so its CRS is not known",
            "1 geometry without coordinates left out",
            "1 ring of fewer than 3 vertices: nothing lies in it",
        ]
    );
}

#[test]
fn shapefiles_with_absurd_counts_are_refused_by_feature() {
    let good = shp_parts(5, &[&SQUARE]);
    for at in [36, 40, 44] {
        let mut bad = good.clone();
        bad[at..at + 4].copy_from_slice(&u32::MAX.to_le_bytes());
        let refused = refusal("a.shp", &shp(5, &[good.clone(), bad]));
        assert!(refused.contains("feature 1"), "{refused}");
    }
    let mut nan = good.clone();
    let end = nan.len();
    nan[end - 8..].copy_from_slice(&f64::NAN.to_le_bytes());
    assert!(refusal("a.shp", &shp(5, &[nan])).contains("feature 0"));
    assert!(refusal("a.shp", &shp(31, &[31_u32.to_le_bytes().to_vec()])).contains("multipatch"));
    let whole = shp(5, &[good.clone(), good]);
    for cut in 0..whole.len() {
        let _ = refusal("a.shp", &whole[..cut]);
    }
}

#[test]
fn a_shapefile_index_that_points_elsewhere_is_noted_by_feature() {
    let (_folder, path) = file("a.shp", &shp(5, &[shp_parts(5, &[&SQUARE]), shp_parts(5, &[&SQUARE])]));
    let mut index = vec![0; 100];
    for words in [50_u32, 64, 118, 64] {
        index.extend(words.to_be_bytes());
    }
    for (index, wrong_from) in [(&index, None), (&index[..108].to_vec(), Some("feature 1 on"))] {
        std::fs::write(path.with_extension("shx"), index).unwrap();
        let notes = super::read(&path, None).unwrap().notes;
        assert_eq!(
            wrong_from.is_some(),
            notes.iter().any(|n| n.contains(wrong_from.unwrap_or(".shx"))),
            "{notes:?}"
        );
    }
}

#[test]
fn flatgeobuf_is_read_with_its_crs() {
    let read = read_bytes("a.fgb", &fgb()).unwrap();
    assert_eq!(read.features.len(), 3);
    assert_eq!(polygon_of(&read, 0)[0].len(), 4);
    assert_eq!(read.crs.unwrap().epsg(), Some(32733));
}

#[test]
fn features_of_a_flatgeobuf_of_another_type_than_its_header_says_are_read_as_what_they_are() {
    use ::flatgeobuf::GeometryType;
    let wkb = |kind: u32, count: u32, content: &[u8]| {
        geozero::wkb::Wkb([&[1][..], &kind.to_le_bytes(), &count.to_le_bytes(), content].concat())
    };
    let ring: Vec<u8> =
        SQUARE.iter().flat_map(|(x, y)| [x.to_le_bytes(), y.to_le_bytes()].concat()).collect();
    let polygon = [&5_u32.to_le_bytes()[..], &ring].concat();
    let mixed = fgb_of(GeometryType::Unknown, |writer| {
        writer.add_feature_geom(wkb(6, 1, &wkb(3, 1, &polygon).0), |_| {}).unwrap();
        writer.add_feature_geom(wkb(3, 1, &polygon), |_| {}).unwrap();
        writer.add_feature_geom(wkb(2, 5, &ring), |_| {}).unwrap();
    });
    let header = |bytes: &[u8]| 12 + u32::from_le_bytes(bytes[8..12].try_into().unwrap()) as usize;
    for (stated, kind, content) in [
        (GeometryType::Polygon, 3, polygon.clone()),
        (GeometryType::MultiPolygon, 6, wkb(3, 1, &polygon).0),
        (GeometryType::LineString, 2, ring.clone()),
    ] {
        let of_one_type = fgb_of(stated, |writer| {
            let count = if kind == 2 { 5 } else { 1 };
            (0..3).for_each(|_| writer.add_feature_geom(wkb(kind, count, &content), |_| {}).unwrap());
        });
        // The writer refuses to mix types under one: its header, and the features of another file.
        let bytes = [&of_one_type[..header(&of_one_type)], &mixed[header(&mixed)..]].concat();
        let read = read_bytes("a.fgb", &bytes).unwrap();
        let areas =
            read.features.iter().filter(|f| matches!(&f.shape, Shape::Polygon(rings) if rings[0].len() == 4));
        assert_eq!((read.features.len(), areas.count()), (3, 2), "{stated:?}");
        assert!(
            read.notes.iter().any(|n| n.contains("another type than the header says")),
            "{:?}",
            read.notes
        );
    }
}

#[test]
fn a_line_of_one_vertex_is_left_out_and_a_file_of_such_holds_nothing_that_is_drawn() {
    let dot = r#"{"type":"MultiLineString","coordinates":[[[0,0]],[[5,5]]]}"#;
    let (_folder, path) = file("a.geojson", dot.as_bytes());
    let one = describe(&path).unwrap().remove(0);
    assert_eq!(
        (one.lines, one.polygons, one.notes),
        (0, 0, vec!["2 lines of a single vertex left out".into()])
    );
    let ring = r#"{"type":"Polygon","coordinates":[[[0,0],[5,5],[0,0]]]}"#;
    let (_folder, path) = file("a.geojson", ring.as_bytes());
    assert_eq!(describe(&path).unwrap()[0].polygons, 0, "a ring that bounds nothing");
    let both = dot.replace("[[5,5]]", "[[5,5],[6,6]]");
    let read = read_bytes("a.geojson", both.as_bytes()).unwrap();
    assert!(matches!(&read.features[0].shape, Shape::Line(parts) if parts.len() == 1));
}

#[test]
fn a_truncated_flatgeobuf_is_refused() {
    let whole = fgb();
    for cut in 0..whole.len() {
        let _ = refusal("a.fgb", &whole[..cut]);
    }
}

#[cfg(feature = "gpkg")]
#[test]
fn geopackage_reads_its_only_layer_and_asks_which_of_several() {
    let one = gpkg(&["lakes"], &wkb_polygon());
    let read = read_bytes("a b#?%.gpkg", &one).unwrap();
    assert_eq!(polygon_of(&read, 0)[0].len(), 4);
    assert_eq!(read.crs.unwrap().epsg(), Some(32733));
    let (folder, path) = file("two.gpkg", &gpkg(&["a\"b", "lakes"], &wkb_polygon()));
    let refused = super::read(&path, None).unwrap_err().to_string();
    assert!(refused.contains("'lakes'") && refused.contains("several"), "{refused}");
    assert!(super::read(&path, Some("rivers")).unwrap_err().to_string().contains("'lakes'"));
    assert_eq!(super::read(&path, Some("a\"b")).unwrap().features.len(), 1);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "nothing is written beside the data");
    assert_eq!(describe(&path).unwrap().len(), 2);
}

#[cfg(feature = "gpkg")]
#[test]
fn damaged_geometries_in_a_geopackage_are_refused_by_feature() {
    let good = wkb_polygon();
    for cut in 0..good.len() {
        let refused = refusal("a.gpkg", &gpkg(&["x"], &good[..cut]));
        assert!(refused.contains("feature 0"), "{refused}");
        if cut > 20 {
            break;
        }
    }
    let mut absurd = good.clone();
    absurd[17..21].copy_from_slice(&u32::MAX.to_le_bytes());
    let _ = refusal("a.gpkg", &gpkg(&["x"], &absurd));
    let mut deep = vec![b'G', b'P', 0, 1, 0, 0, 0, 0];
    for _ in 0..5000 {
        deep.extend([1, 7, 0, 0, 0, 1, 0, 0, 0]);
    }
    assert!(refusal("a.gpkg", &gpkg(&["x"], &deep)).contains("deep"));
}

#[cfg(not(feature = "gpkg"))]
#[test]
fn a_build_without_geopackages_says_which_feature_it_lacks() {
    let (_folder, path) = file("a.gpkg", b"SQLite format 3\0 and so on");
    for refused in [super::read(&path, None).unwrap_err(), describe(&path).unwrap_err()] {
        assert_eq!(refused.kind(), crate::ErrorKind::Unsupported, "{refused}");
        assert!(refused.what().contains("feature `gpkg`"), "{refused}");
        assert!(refused.help_text().is_some_and(|help| help.contains("--features gpkg")), "{refused}");
    }
}

#[test]
fn what_is_no_vector_file_is_refused_in_words() {
    for name in ["a.geojson", "a.json", "a.shp", "a.fgb", "a.gpkg", "a.txt", "a"] {
        assert!(refusal(name, b"").contains("empty"));
        let _ = refusal(name, b"hello");
        let _ = refusal(name, &[0; 1000]);
    }
    assert!(refusal("a.shp", JSON.as_bytes()).contains("GeoJSON"));
    assert!(read(Path::new("/no/such.shp"), None).unwrap_err().to_string().contains("such.shp"));
    assert!(read(tempfile::tempdir().unwrap().path(), None).unwrap_err().to_string().contains("folder"));
    let (_folder, path) = file("a.geojson", JSON.as_bytes());
    assert!(read(&path, Some("lakes")).is_err());
}

#[test]
fn the_content_tells_the_format_where_the_name_does_not() {
    assert_eq!(read_bytes("noname", JSON.as_bytes()).unwrap().features.len(), 4);
    assert_eq!(read_bytes("noname", &fgb()).unwrap().features.len(), 3);
}

#[test]
fn a_description_counts_as_the_file_stores() {
    let (_folder, path) = file("a.geojson", JSON.as_bytes());
    let all = describe(&path).unwrap();
    let [one] = all.as_slice() else { panic!("one layer") };
    assert_eq!((one.features, one.polygons, one.lines, one.points), (4, 2, 1, 1));
    assert_eq!((one.parts, one.vertices), (6, 19));
    assert_eq!(one.bounds.max, Plan::new(6.0, 6.0));
    assert_eq!(one.format.to_string(), "GeoJSON");
}

/// Changes, cuts or repeats some bytes.
fn mutated(mut bytes: Vec<u8>, changes: &[(usize, u8)], cut: usize) -> Vec<u8> {
    for (at, value) in changes {
        let at = at % bytes.len();
        bytes[at] = *value;
    }
    bytes.truncate(bytes.len() - cut % bytes.len());
    bytes
}

fn changes() -> impl Strategy<Value = (Vec<(usize, u8)>, usize)> {
    let value = prop_oneof![any::<u8>(), Just(0), Just(255), Just(127), Just(128)];
    let cut = prop_oneof![3 => Just(0_usize), 1 => any::<usize>()];
    (prop::collection::vec((any::<usize>(), value), 0..12), cut)
}

fn samples() -> &'static [(&'static str, Vec<u8>)] {
    static ALL: std::sync::OnceLock<Vec<(&'static str, Vec<u8>)>> = std::sync::OnceLock::new();
    ALL.get_or_init(|| {
        vec![
            ("a.geojson", JSON.as_bytes().to_vec()),
            ("a.shp", shp(5, &[shp_parts(5, &[&SQUARE]), shp_parts(3, &[&SQUARE, &SQUARE])])),
            ("a.fgb", fgb()),
            ("a.osm.pbf", osm::town_file(false)),
            #[cfg(feature = "gpkg")]
            ("a.gpkg", gpkg(&["lakes"], &wkb_polygon())),
        ]
    })
}

#[test]
#[ignore = "writes the seeds for fuzzing into $DRAPERY_SEEDS"]
fn seeds_for_fuzzing_vectors() {
    for (name, bytes) in samples() {
        let target = match name.split_once('.') {
            Some((_, "geojson")) => "vector_geojson",
            Some((_, "shp")) => "vector_shapefile",
            Some((_, "fgb")) => "vector_flatgeobuf",
            Some((_, "osm.pbf")) => "vector_osm",
            _ => "vector_geopackage",
        };
        seeds::plant(target, [bytes]);
    }
    seeds::plant("layer", [JSON]);
    #[cfg(feature = "gpkg")]
    seeds::plant("vector_geopackage_geometry", [wkb_polygon()]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn any_damage_gives_features_or_words(sample in 0..samples().len(), (changes, cut) in changes()) {
        let (name, bytes) = &samples()[sample];
        if let Ok(read) = read_bytes(name, &mutated(bytes.clone(), &changes, cut)) {
            prop_assert!(read.features.iter().flat_map(|f| f.shape.parts()).flatten().all(|p| p.is_finite()));
        }
    }

    #[test]
    fn any_bytes_after_a_magic_give_features_or_words(sample in 0..samples().len(), tail in prop::collection::vec(any::<u8>(), 0..400)) {
        let (name, bytes) = &samples()[sample];
        let magic = [1, 36, 12, 40, 100][sample];
        let _ = read_bytes(name, &[&bytes[..magic], &tail].concat());
    }
}
