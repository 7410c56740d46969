//! What a file is, and what is said of one that is not read.

use super::*;

/// What to do about a file that is refused.
fn help(name: &str, bytes: &[u8]) -> String {
    let error = read_bytes(name, bytes).expect_err(name);
    error.help_text().unwrap().to_owned()
}

#[test]
fn files_of_other_kinds_are_refused_with_the_command_that_converts_them() {
    for (name, bytes, made) in [
        ("a.kml", "<?xml version='1.0'?><kml>", "a.gpkg"),
        ("noname", "<?xml version='1.0'?>\n<gpx version='1.1'>", "noname.gpkg"),
        ("a.osm", "<osm version='0.6'>", "a.gpkg"),
        ("a.topojson", "{ \"type\" : \"Topology\"}", "a.gpkg"),
        ("a.json", "{\n  \"type\": \"Topology\"}", "a.gpkg"),
        ("a.csv", "x,y\n1,2\n", "a.fgb"),
    ] {
        let (_folder, path) = file(name, bytes.as_bytes());
        assert!(is_vector(&path), "{name}");
        let error = super::read(&path, None).unwrap_err();
        assert_eq!(error.kind(), crate::ErrorKind::Unsupported, "{error}");
        let help = error.help_text().unwrap();
        let command = format!("ogr2ogr {} {}", path.with_file_name(made).display(), path.display());
        assert!(help.contains(&command), "{help}");
    }
    assert!(help("a.dbf", b"\x03").contains("name the .shp"));
    let (folder, _) = file("a.txt", b"x");
    let gdb = folder.path().join("a.gdb");
    std::fs::create_dir(&gdb).unwrap();
    assert!(super::read(&gdb, None).unwrap_err().help_text().unwrap().contains("ogr2ogr"));
    assert!(help("a.json", br#"{"geometryType":"esriGeometryPolygon","features":[]}"#).contains("ogr2ogr"));
    assert!(refusal("a.geojson", b"\xff\xfe{\0").contains("UTF-16"));
}

#[test]
fn the_name_tells_terrain_from_vectors_and_the_content_where_it_says_nothing() {
    for (name, bytes, is) in [
        ("a.tif", "II*", false),
        ("a.asc", "{", false),
        ("a.shp", "", true),
        ("a.GEOJSONL", "", true),
        ("a.kmz", "PK", true),
        ("noname", "{\"type\":", true),
        ("a.dat", "hello", false),
    ] {
        let (_folder, path) = file(name, bytes.as_bytes());
        assert_eq!(is_vector(&path), is, "{name}");
    }
    assert!(!is_vector(Path::new("/no/such")));
}

#[cfg(feature = "gpkg")]
#[test]
fn a_geopackage_without_features_says_what_it_holds() {
    let (_folder, path) = file("a.gpkg", &gpkg(&[], &[]));
    let db = rusqlite::Connection::open(&path).unwrap();
    let refused = || [super::read(&path, None).unwrap_err(), describe(&path).unwrap_err()];
    for error in refused() {
        assert_eq!(error.what(), "the GeoPackage has no layer of features");
    }
    db.execute_batch(
        "INSERT INTO gpkg_contents VALUES ('people', 'attributes'), ('map', 'tiles'), ('dem', '2d-gridded-coverage');",
    )
    .unwrap();
    for error in refused() {
        assert!(
            error.what().ends_with(
                "it holds tables without shapes `people` and tiles (pictures or heights) `dem`, `map`"
            ),
            "{error}"
        );
        assert!(error.help_text().unwrap().contains("gdal_translate"), "{error}");
    }
}

#[test]
fn parts_of_a_shapefile_and_packed_files_are_told_for_what_they_are() {
    let index = [&9994_u32.to_be_bytes()[..], &[0; 96]].concat();
    assert!(help("a.shx", &index).contains("name the .shp"));
    for (name, bytes, tool) in [
        ("a.geojson.gz", &b"\x1f\x8b\x08\0"[..], "gunzip"),
        ("a.osm.bz2", b"BZh91AY", "bunzip2"),
        ("a", b"\xfd7zXZ\0", "xz"),
    ] {
        assert!(help(name, bytes).contains(tool), "{name}");
    }
    let esri = br#"{"displayFieldName":"","fieldAliases":{},"features":[]}"#;
    assert!(help("a.json", esri).contains("ogr2ogr"));
}

#[test]
fn null_in_a_sequence_is_left_out_with_a_note_wherever_it_stands() {
    let point = r#"{"type":"Feature","properties":null,"geometry":{"type":"Point","coordinates":[1,2]}}"#;
    for text in [
        format!("{point}\nnull\n{point}\n"),
        format!("null\n{point}\n{point}"),
        format!("{point}\n{point}\nnull"),
    ] {
        let read = read_bytes("a.geojsonl", text.as_bytes()).unwrap();
        assert_eq!(read.features.len(), 2, "{text}");
        assert!(read.notes.iter().any(|note| note.starts_with("1 x `null`")), "{:?}", read.notes);
    }
}
