//! Vector files in zip archives.

use super::*;
use crate::scene::Attribute;
use crate::source::zip::tests::packed;

const LINE: &str =
    r#"{"type":"Feature","properties":{"n":1},"geometry":{"type":"LineString","coordinates":[[0,0],[1,1]]}}"#;

fn square_shp() -> Vec<u8> {
    shp(5, &[shp_parts(5, &[&SQUARE]), shp_parts(5, &[&SQUARE])])
}

#[test]
#[ignore = "writes the seeds for fuzzing into $DRAPERY_SEEDS"]
fn seeds_for_fuzzing_archives() {
    let shapes = packed(&[("a.shp", &square_shp()), ("a.prj", b"EPSG:32733")]);
    seeds::plant("vector_zip", [shapes, packed(&[("a.geojson", LINE.as_bytes())])]);
    seeds::plant("vector_osm/packed", [osm::town_file(true)]);
}

#[test]
fn a_shapefile_in_an_archive_has_the_files_beside_it() {
    let mut table = super::attributes::dbf(0, &[("A", b'C', 2, 0)], &[b"\xe9 ", b"b "]);
    let second = table.len() - 3;
    table[second] = b'*';
    let files: [(&str, &[u8]); 6] = [
        ("data/Roads.shp", &square_shp()),
        ("data/ROADS.DBF", &table),
        ("data/Roads.prj", b"EPSG:32733"),
        ("data/Roads.cpg", b"ISO-8859-1"),
        ("other/Roads.prj", b"no"),
        ("read me.txt", b"hello"),
    ];
    for name in ["a.zip", "roads.shp.zip"] {
        let (_folder, path) = file(name, &packed(&files));
        let read = read_columns(&path, None, &["A".into()]).unwrap();
        assert_eq!(read.crs.unwrap().epsg(), Some(32733));
        assert_eq!(read.features.len(), 1, "the other row is deleted");
        assert_eq!(read.columns[0].values, [Attribute::Text("é".into())]);
        assert!(is_vector(&path) && describe(&path).unwrap().len() == 1);
    }
}

#[test]
fn the_one_file_of_an_archive_is_read_and_a_description_beside_it_is_not() {
    for (name, content) in
        [("a.geojson", LINE.as_bytes()), ("a.ndjson", LINE.as_bytes()), ("x/a.fgb", &fgb())]
    {
        let bytes = packed(&[("meta.json", b"{}"), (name, content)]);
        assert!(!read_bytes("a.zip", &bytes).unwrap().features.is_empty(), "{name}");
    }
    assert_eq!(read_bytes("a.zip", &packed(&[("a.json", LINE.as_bytes())])).unwrap().features.len(), 1);
}

#[test]
fn an_archive_of_no_vectors_of_several_or_of_damaged_ones_says_so() {
    let several = packed(&[("a.shp", &square_shp()), ("b.shp", &square_shp())]);
    assert!(refusal("a.zip", &several).contains("2 vector files, a.shp and b.shp"));
    let (_folder, path) = file("a.zip", &packed(&[("a.tif", b"II"), ("b.geojson", LINE.as_bytes())]));
    assert!(!is_vector(&path), "a terrain with its outline");
    assert!(refusal("a.zip", &packed(&[("a.tif", b"II")])).contains("no vector file among its 1 files"));
    assert!(refusal("a.zip", &packed(&[("a.kml", b"<kml")])).contains("ogr2ogr a.gpkg a.kml"));
    assert!(refusal("a.kmz", &packed(&[("doc.kml", b"<kml")])).contains("a.kmz"));
    assert!(refusal("a.zip", &packed(&[("a.gpkg", b"SQLite format 3\0")])).contains("unpack it first"));
    let cut = &square_shp()[..150];
    let refused = refusal("a.zip", &packed(&[("d/a.shp", cut)]));
    assert!(refused.contains("a.zip/d/a.shp: feature 0"), "{refused}");
    assert!(refusal("a.zip", &packed(&[("a.shp", b"hello")])).contains("not a shapefile"));
    let (_folder, path) = file("a.zip", &packed(&[("a.shp", &square_shp())]));
    assert!(super::read(&path, Some("x")).unwrap_err().what().contains("has no layers"));
}
