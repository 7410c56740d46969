//! Errors as a program meets them: what it can match on, and what led to them.
#![cfg(feature = "render")]

use drapery::golden::Manifest;
use drapery::output::{Batch, write_whole};
use drapery::scene_file::SceneFile;
use drapery::source::{dem, load, vector};
use drapery::{Error, ErrorKind, compare::Image};
use std::error::Error as _;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A folder with a file.
fn file(name: &str, content: &[u8]) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, content).unwrap();
    (folder, path)
}

/// Whether an error is of this kind, was led to by a `T`, and still tells that error's words (`tells`: not replaced by our own).
fn check<T: std::error::Error + 'static>(error: &Error, kind: ErrorKind, tells: bool) {
    assert_eq!(error.kind(), kind, "{error}");
    let source = error.source().unwrap_or_else(|| panic!("no source: {error}"));
    assert!(source.is::<T>(), "{error}: {source:?}");
    let first_words = source.to_string().chars().take(12).collect::<String>();
    assert_eq!(error.to_string().contains(&first_words), tells, "{error} of {source}");
}

#[test]
fn a_file_that_is_missing_is_the_systems_refusal() {
    let missing = Path::new("no/such/file");
    let dem = dem::read(&missing.with_extension("tif"), &dem::DemOptions::default()).unwrap_err();
    check::<std::io::Error>(&dem, ErrorKind::Io, true);
    let vectors = vector::read(&missing.with_extension("shp"), None).unwrap_err();
    check::<std::io::Error>(&vectors, ErrorKind::Io, true);
    let scene = SceneFile::read(missing, &[]).unwrap_err();
    check::<std::io::Error>(&scene, ErrorKind::Io, true);
    let picture = Image::read(missing).unwrap_err();
    check::<std::io::Error>(&picture, ErrorKind::Io, false);
    let named = SceneFile::parse("schema = 1\nterrain.source = \"no/such.tif\"\n", None, &[]).unwrap();
    let named = load::load(&named, &|_| {}).unwrap_err();
    check::<std::io::Error>(&named, ErrorKind::Io, false);
}

#[test]
fn what_cannot_be_written_is_the_systems_refusal() {
    let (_folder, path) = file("a", b"");
    check::<std::io::Error>(&Batch::into(&path).unwrap_err(), ErrorKind::Io, true);
    let refused = write_whole(&path.join("below"), |_| Ok(())).unwrap_err();
    check::<std::io::Error>(&refused, ErrorKind::Io, true);
}

#[test]
fn a_damaged_file_is_an_input_with_the_readers_error_as_its_source() {
    let (folder, json) = file("a.geojson", b"{\"type\": nonsense}");
    check::<serde_json::Error>(&vector::read(&json, None).unwrap_err(), ErrorKind::Input, true);
    let cut = Image::decode(b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR").unwrap_err();
    assert_eq!((cut.kind(), cut.source().is_some()), (ErrorKind::Input, true), "{cut}");
    let cut = Image::decode(b"\x76\x2f\x31\x01").unwrap_err();
    assert_eq!((cut.kind(), cut.source().is_some()), (ErrorKind::Input, true), "{cut}");
    let (tile, short) = (folder.path().join("N00E000.hgt"), vec![0; 2 * 1201 * 1201 - 2]);
    std::fs::write(&tile, short).unwrap();
    let error = dem::read(&tile, &dem::DemOptions::default()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Input, "{error}");
    let scene = SceneFile::parse("schema = = 1", None, &[]).unwrap_err();
    assert_eq!((scene.kind(), scene.source().is_some()), (ErrorKind::Input, true), "{scene}");
    std::fs::write(folder.path().join("manifest.toml"), "schema = = 1").unwrap();
    let manifest = Manifest::read(folder.path()).unwrap_err();
    assert_eq!((manifest.kind(), manifest.source().is_some()), (ErrorKind::Input, true), "{manifest}");
}

#[test]
fn what_is_sound_but_not_done_here_is_unsupported() {
    let (_folder, gz) = file("a.gz", b"\x1f\x8b\x08 and so on");
    let gz = dem::read(&gz, &dem::DemOptions::default()).unwrap_err();
    assert_eq!(gz.kind(), ErrorKind::Unsupported, "{gz}");
    let crs = drapery::crs::Crs::parse("EPSG:1").unwrap_err();
    assert_eq!(crs.kind(), ErrorKind::Unsupported, "{crs}");
}

#[test]
fn an_error_of_a_key_keeps_its_kind() {
    let text = "schema = 1\ncrs = \"EPSG:1\"\nterrain.generate = { kind = \"plane\" }\n";
    let scene = SceneFile::parse(text, None, &[]).unwrap();
    let error = load::load(&scene, &|_| {}).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Unsupported, "{error}");
    assert!(error.what().starts_with("`crs`: ") && error.help_text().is_some(), "{error}");
}

/// A comb of upright bars as a ring of GeoJSON, or of bars that lie.
fn comb(bars: usize, is_upright: bool) -> String {
    let length = (2 * bars + 1) as f64;
    let bar = |k: usize| {
        let at = 2.0 * k as f64 + 0.25;
        [(at, 0.0), (at, length), (at + 1.0, length), (at + 1.0, 0.0)]
    };
    let ring = (0..bars).flat_map(bar).chain([(length, -1.0), (0.25, -1.0), (0.25, 0.0)]);
    let places = ring.map(|(x, y)| if is_upright { format!("[{x},{y}]") } else { format!("[{y},{x}]") });
    format!("[[{}]]", places.collect::<Vec<_>>().join(","))
}

#[test]
fn members_that_cannot_be_united_are_blamed_on_their_layer_its_file_and_the_feature_and_not_on_the_terrain() {
    let (folder, path) = file(
        "s.toml",
        b"schema = 1\nimage = { width = 8, height = 8 }\nterrain = { source = \"d.asc\", crs = \"EPSG:32632\" }\n\
          camera = { eye = [0, 0, 100], target = [0, 0, 0], up = [0, 1, 0] }\n\
          [[layer]]\nname = \"combs\"\nsource = \"c.geojson\"\ncrs = \"EPSG:32632\"\nfill = { color = \"#000000\" }\n",
    );
    let grid = "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1000\n1 2\n3 4\n";
    std::fs::write(folder.path().join("d.asc"), grid).unwrap();
    let feature = |kind: &str, places: &str| {
        format!(
            r#"{{"type":"Feature","properties":{{}},"geometry":{{"type":"{kind}","coordinates":{places}}}}}"#
        )
    };
    let features = [
        feature("Polygon", "[[[0,0],[9,0],[9,9],[0,0]]]"),
        feature("MultiPolygon", &format!("[{},{}]", comb(800, true), comb(800, false))),
    ];
    let vectors = format!(r#"{{"type":"FeatureCollection","features":[{}]}}"#, features.join(","));
    std::fs::write(folder.path().join("c.geojson"), vectors).unwrap();
    let error = drapery::open(&path).unwrap_err();
    let said = error.to_string();
    assert!(
        said.contains("c.geojson: layer `combs`: feature 1: these polygons lie over one another"),
        "{said}"
    );
    assert!(said.contains("s.toml:7:10") && !said.contains("d.asc"), "{said}");
    assert_eq!((error.layer(), error.kind()), (Some(0), ErrorKind::Unsupported));
    assert!(error.help_text().is_some_and(|help| help.contains("ST_UnaryUnion")), "{said}");
}
