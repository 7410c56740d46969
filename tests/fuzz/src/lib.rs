//! What the targets do with an input: each reader gets any bytes and gives what it reads, or an error in words.
//!
//! An input is the file itself. What may lie beside it follows after lines `=== EXTENSION` ([`files`]). An error of the kind that is
//! a bug, a panic, more than a GiB ([`memory`]) or ten seconds (libFuzzer's own limits, see `run`) is a finding.

mod files;
mod memory;

use drapery::compare::Image;
use drapery::crs::{Crs, PlanSpace};
use drapery::golden::Manifest;
use drapery::scene_file::{Override, SceneFile};
use drapery::source::dem::{self, DemOptions, PngEncoding};
use drapery::source::{load, vector};
use drapery::{Result, Stage};
use files::{Folder, beside};
use glam::DVec2;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Mutex;

/// What is read, or nothing where it was refused: in words, naming the file, and not as a bug.
fn judged<T>(result: Result<T>, names_file: bool) -> Option<T> {
    match result {
        Ok(read) => Some(read),
        Err(error) => {
            assert!(!error.is_internal(), "{error}");
            assert!(!error.what().is_empty());
            assert!(!names_file || error.path().is_some(), "no file is named: {error}");
            None
        }
    }
}

/// A terrain file, read with one of several options and described.
pub fn dem(name: &str, data: &[u8]) {
    beside(name, data, |path| dem_at(path, data.len()));
}

fn dem_at(path: &Path, choice: usize) {
    let options = DemOptions {
        window: [None, Some([1.0, 1.0, 150.0, 250.0])][choice % 2],
        encoding: [Some(PngEncoding::Mapbox), Some(PngEncoding::Terrarium)][choice / 2 % 2],
        bounds: [None, Some([0.0, 0.0, 40.0, 30.0])][choice / 4 % 2],
        ..DemOptions::default()
    };
    if let Some(dem) = judged(dem::read(path, &options), true)
        && let Some(hint) = &dem.crs_hint
        && let Some(crs) = judged(load::crs_of(hint), false)
    {
        maps(&crs);
    }
    judged(dem::describe(path, &options), true);
}

/// An SRTM tile.
pub fn hgt(data: &[u8]) {
    const TILE: usize = 2 * 1201 * 1201;
    let line = data.iter().position(|byte| *byte == b'\n').unwrap_or(data.len());
    let stem = String::from_utf8_lossy(&data[..line]).replace(['/', '\0'], "");
    let stem: String = stem.chars().take(40).collect();
    let content = data.get(line + 1..).filter(|rest| !rest.is_empty()).unwrap_or(b"\0");
    let tile: Vec<u8> = content.iter().copied().cycle().take(TILE).collect();
    Folder::with(|folder| {
        let path = folder.write(&format!("N{stem}.hgt"), &tile);
        dem_at(&path, data.len() & 1);
        folder.clear();
    });
}

/// A vector file, described and read with all its columns.
pub fn vector(name: &str, data: &[u8]) {
    beside(name, data, vector_at);
}

fn vector_at(path: &Path) {
    let Some(summaries) = judged(vector::describe(path), true) else {
        judged(vector::read(path, None), true);
        return;
    };
    for summary in summaries {
        let columns: Vec<String> = summary.columns.iter().take(8).map(|column| column.name.clone()).collect();
        let read = vector::read_columns(path, summary.layer.as_deref(), &columns);
        if let Some(file) = judged(read, true)
            && let Some(crs) = &file.crs
        {
            maps(crs);
        }
    }
}

/// A GeoPackage of one feature with these bytes as its geometry.
pub fn geopackage_geometry(data: &[u8]) {
    /// Files by the length of their geometry, with the place of it.
    static MADE: Mutex<BTreeMap<usize, (Vec<u8>, usize)>> = Mutex::new(BTreeMap::new());
    // Longer ones would go over several pages.
    if data.is_empty() || data.len() > 3000 {
        return;
    }
    let mut made = MADE.lock().expect("no target panics here");
    let (file, at) = made.entry(data.len()).or_insert_with(|| geopackage_around(data.len()));
    file[*at..][..data.len()].copy_from_slice(data);
    Folder::with(|folder| vector_at(&folder.write("a.gpkg", file)));
}

fn geopackage_around(length: usize) -> (Vec<u8>, usize) {
    const MARK: u8 = 0xa7;
    let path = Folder::with(|folder| folder.path("template.gpkg"));
    let db = rusqlite::Connection::open(&path).expect("a new file");
    db.execute_batch(
        "PRAGMA page_size = 4096;
         CREATE TABLE gpkg_contents (table_name TEXT, data_type TEXT);
         CREATE TABLE gpkg_geometry_columns (table_name TEXT, column_name TEXT, srs_id INTEGER);
         CREATE TABLE gpkg_spatial_ref_sys (srs_id INTEGER, organization TEXT, organization_coordsys_id INTEGER, definition TEXT);
         INSERT INTO gpkg_spatial_ref_sys VALUES (32733, 'EPSG', 32733, '');
         CREATE TABLE t (fid INTEGER PRIMARY KEY, geom BLOB);
         INSERT INTO gpkg_contents VALUES ('t', 'features');
         INSERT INTO gpkg_geometry_columns VALUES ('t', 'geom', 32733);",
    )
    .and_then(|()| db.execute("INSERT INTO t (geom) VALUES (?1)", [vec![MARK; length]]))
    .expect("sound statements");
    drop(db);
    let file = std::fs::read(&path).expect("just written");
    std::fs::remove_file(&path).expect("just written");
    // The longest run of marks: short ones may stand elsewhere by chance.
    let at = file.windows(length).rposition(|run| run.iter().all(|byte| *byte == MARK));
    (file, at.expect("a record on one page"))
}

/// The text of a CRS.
pub fn crs(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    if let Some(crs) = judged(Crs::parse(text), false) {
        maps(&crs);
    }
}

/// Maps of places by a CRS, there and back, and by a plan of it.
fn maps(crs: &Crs) {
    assert!(crs.is_same(crs));
    let _ = (crs.name(), crs.note());
    for place in [DVec2::new(15.0, 50.0), DVec2::new(-180.0, -90.0), DVec2::new(179.0, 0.0)] {
        if let Some(native) = judged(crs.native_from_geographic(place), false) {
            assert!(native.is_finite());
            let back = judged(crs.geographic_from_native(native), false);
            assert!(back.is_none_or(DVec2::is_finite));
        }
    }
    for native in [DVec2::ZERO, DVec2::new(500_000.0, 5_000_000.0), DVec2::new(-1e300, 1e300)] {
        let place = judged(crs.geographic_from_native(native), false);
        assert!(place.is_none_or(DVec2::is_finite));
    }
    let space = load::default_plan_space(crs.clone(), [10.0, 40.0, 11.0, 41.0]);
    if let Some(space) = judged(space, false) {
        in_plan(&space);
    }
}

fn in_plan(space: &PlanSpace) {
    let _ = space.describe();
    let plan = judged(space.plan_from_geographic(10.5, 40.5), false);
    assert!(plan.is_none_or(DVec2::is_finite));
}

/// A scene file, its overrides in lines after `=== set`.
pub fn scene_file(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let (text, set) = text.split_once("\n=== set\n").unwrap_or((text, ""));
    let overrides: Vec<Override> =
        set.lines().filter_map(|line| judged(Override::parse(line), false)).collect();
    judged(SceneFile::parse(text, None, &overrides), false);
}

/// The manifest of goldens.
pub fn manifest(data: &[u8]) {
    Folder::with(|folder| {
        let path = folder.write("manifest.toml", data);
        judged(Manifest::read(path.parent().expect("a folder")), true);
    });
}

/// A picture to be compared.
pub fn picture(data: &[u8]) {
    judged(Image::decode(data), false);
}

/// A scene of a small terrain with one layer, loaded until it could be drawn.
pub fn layer(data: &[u8]) {
    const PLANS: [&str; 4] = ["", "crs = 'EPSG:32632'", "crs = 'EPSG:3035'", "crs = 'EPSG:3857'"];
    let plan = PLANS[data.len() % PLANS.len()];
    scene(
        "a.geojson",
        data,
        &format!(
            "schema = 1\n{plan}\n[image]\nwidth = 8\nheight = 8\n\
             [terrain]\nsource = 'd.asc'\ncrs = 'EPSG:4326'\n[[layer]]\nsource = 'a.geojson'\n\
             fill = {{ color = '#102030' }}\nline = {{ color = '#aabbcc', width_m = 4 }}\n"
        ),
    );
}

/// A scene of a small terrain with an image on it.
pub fn imagery(data: &[u8]) {
    scene(
        "a.png",
        data,
        "schema = 1\n[image]\nwidth = 8\nheight = 8\n[terrain]\nsource = 'd.asc'\ncrs = 'EPSG:4326'\n\
         imagery = 'a.png'\n",
    );
}

fn scene(name: &str, data: &[u8], text: &str) {
    const DEM: &str =
        "ncols 4\nnrows 4\nxllcenter 9\nyllcenter 47\ncellsize 0.5\n1 2 3 4\n2 3 4 5\n3 4 5 6\n4 5 6 7\n";
    beside(name, data, |path| {
        Folder::with(|folder| {
            folder.write("d.asc", DEM.as_bytes());
            let file = judged(SceneFile::parse(text, Some(&path.with_file_name("s.toml")), &[]), true);
            let file = file.expect("a sound scene");
            if let Some((scene, surface)) = judged(load::load(&file, &|_| ()), true) {
                judged(Stage::new(scene, surface), false);
            }
        });
    });
}
