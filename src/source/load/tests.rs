//! The loader on data made for the purpose.

#![allow(clippy::unwrap_used, reason = "helpers of tests are no tests to the lint")]

mod attributes;
mod globe;
mod ground_curve;
mod on_a_globe;
mod terrains;

use super::load;
use crate::crs::{Crs, PlanSpace};
use crate::error::{Error, Result};
use crate::scene::{Feature, Posts, Scene, Surface};
use crate::scene_file::SceneFile;
use crate::space::Plan;
use glam::{DVec2, DVec3};
use std::path::Path;

/// A folder with a scene and its data.
struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn with(self, name: &str, content: impl AsRef<[u8]>) -> Self {
        std::fs::write(self.path(name), content).unwrap();
        self
    }

    fn path(&self, name: &str) -> std::path::PathBuf {
        self.0.path().join(name)
    }

    fn load(&self, text: &str) -> Result<(Scene, Surface)> {
        std::fs::write(self.path("s.toml"), format!("schema = 1\n{text}")).unwrap();
        load(&SceneFile::read(&self.path("s.toml"), &[])?, &|_| ())
    }

    fn refused(&self, text: &str) -> Error {
        self.load(text).unwrap_err()
    }
}

/// An Esri grid with its south-west post at a place.
fn grid(
    (columns, rows): (usize, usize),
    (x, y): (f64, f64),
    cell: f64,
    z: impl Fn(f64, f64) -> f64,
) -> String {
    let mut text = format!(
        "ncols {columns}\nnrows {rows}\nxllcenter {x}\nyllcenter {y}\ncellsize {cell}\nNODATA_value -9999\n"
    );
    for j in (0..rows).rev() {
        for i in 0..columns {
            text += &format!("{} ", z(x + i as f64 * cell, y + j as f64 * cell));
        }
        text.push('\n');
    }
    text
}

fn hills(x: f64, y: f64) -> f64 {
    500.0 + ((x * 7.0 + y * 3.0) as i64 % 97) as f64
}

fn posts(surface: Surface) -> Posts {
    match surface {
        Surface::Grid(posts) => posts,
        Surface::Points(_) | Surface::Globe(_) => panic!("points, not a grid"),
    }
}

fn vertices(features: &[Feature]) -> Vec<Plan> {
    features.iter().flat_map(|f| f.shape.parts().flatten().copied()).collect()
}

/// All that a picture depends on, in words.
fn local(scene: &Scene, surface: &Surface) -> String {
    format!("{:?} {:?} {:?}", scene.layers, scene.camera, surface)
}

#[test]
fn generated_terrain_without_offset_has_its_origin_at_zero() {
    let (scene, surface) = Folder::new()
        .load(
            "terrain = { generate = { kind = \"plane\", posts = [5, 5], cell_m = 10.0 } }\n\
             [[layer]]\nfeatures = [{ line = [[-7.3, 1.1], [3.7, 2.9]] }]\nline = { color = \"#000000\", width_m = 2.0 }",
        )
        .unwrap();
    assert_eq!(scene.origin, DVec3::ZERO);
    assert_eq!(posts(surface).first, Plan::new(-20.0, -20.0));
    assert_eq!(vertices(&scene.layers[0].features)[0], Plan::new(-7.3, 1.1));
}

#[test]
fn posts_do_not_depend_on_the_offset() {
    let folder = Folder::new().with("d.asc", grid((9, 7), (412_345.678, 5_123_456.789), 4.997_678, hills));
    let load = |offset: &str| {
        folder.load(&format!("terrain = {{ source = \"d.asc\", offset = {offset} }}")).unwrap()
    };
    let (still, before) = load("[0, 0]");
    let (moved, after) = load("[5e6, -31.7]");
    assert_eq!(posts(before), posts(after));
    assert_eq!(moved.origin, still.origin + DVec3::new(5e6, -31.7, 0.0));
    assert_eq!((still.camera, still.origin.fract()), (moved.camera, DVec3::ZERO));
}

#[test]
fn a_scene_moved_with_all_its_data_keeps_every_bit() {
    let line = r#"{"type":"LineString","coordinates":[[412360.7031,5123460.123],[412370.1,5123480.3]]}"#;
    let folder = Folder::new()
        .with("d.asc", grid((9, 7), (412_345.67, 5_123_456.78), 5.0, hills))
        .with("l.geojson", line);
    let scene = |d: f64| {
        let at = |x: f64, y: f64| format!("{}, {}", x + d, y + d);
        folder
            .load(&format!(
                "camera = {{ eye = [{eye}, {above}], target = [{target}, {level}] }}
                terrain = {{ source = \"d.asc\", offset = [{d}, {d}, {d}], crs = \"EPSG:32633\" }}
                [[layer]]\nsource = \"l.geojson\"\ncrs = \"EPSG:32633\"\noffset = [{d}, {d}]
                line = {{ color = \"#000000\", width_m = 1.0 }}
                [[layer]]\nfeatures = [{{ polygon = [[[{a}], [{b}], [{c}]]] }}]\nfill = {{ color = \"#ff0000\" }}
                [[layer]]\nname = \"g\"\ngenerate = {{ kind = \"mosaic\", count = 9, window = [{low}, {high}] }}
                fill = {{ color = \"#00ff00\" }}
                [[layer]]\nname = \"r\"\ngenerate = {{ kind = \"roads\", count = 9 }}
                line = {{ color = \"#00ff00\", width_m = 1.0 }}",
                eye = at(412_300.25, 5_123_300.5),
                above = 900.5 + d,
                level = 500.25 + d,
                target = at(412_366.75, 5_123_470.0),
                a = at(412_350.25, 5_123_460.5),
                b = at(412_361.0, 5_123_461.75),
                c = at(412_359.5, 5_123_470.25),
                low = at(412_350.5, 5_123_460.0),
                high = at(412_380.5, 5_123_480.0),
            ))
            .unwrap()
    };
    let (still, before) = scene(0.0);
    let (moved, after) = scene(5e6);
    assert_eq!(moved.origin - still.origin, DVec3::splat(5e6));
    assert_eq!(still.layers.iter().map(|l| l.features.len()).collect::<Vec<_>>()[..3], [1, 1, 9]);
    assert_eq!(local(&still, &before), local(&moved, &after));
}

#[test]
fn local_coordinates_are_plan_coordinates_less_the_origin() {
    let folder = Folder::new().with("d.asc", grid((9, 7), (412_344.25, 5_123_456.5), 5.0, hills));
    let (scene, surface) = folder
        .load(
            "camera = { eye = [412300.5, 5123300.0, 900.0], target = [412366.0, 5123470.0, 500.0] }
            terrain = { source = \"d.asc\", vertical_scale = 2.0 }
            [[layer]]\nfeatures = [{ line = [[412350.25, 5123460.5], [412361, 5123461.75]] }]\noffset = [1, 2]
            line = { color = \"#000000\", width_m = 1.0 }",
        )
        .unwrap();
    let absolute = |p: Plan| p + scene.origin.truncate();
    assert_eq!(absolute(vertices(&scene.layers[0].features)[0]), Plan::new(412_351.25, 5_123_462.5));
    assert_eq!(absolute(scene.camera.eye.plan()), Plan::new(412_300.5, 5_123_300.0));
    let posts = posts(surface);
    assert_eq!(absolute(posts.plan(0, 0)), Plan::new(412_344.25, 5_123_456.5));
    assert_eq!(posts.world(0, 0).z, 2.0 * hills(412_344.25, 5_123_456.5));
    assert!(scene.notes.iter().any(|n| n.contains("no CRS is known")), "{:?}", scene.notes);
}

#[test]
fn a_terrain_in_degrees_stays_a_grid_on_the_local_plane() {
    let folder = Folder::new()
        .with("d.asc", grid((41, 31), (10.0, 46.0), 0.001, hills))
        .with("l.geojson", r#"{"type":"LineString","coordinates":[[10.02,46.015],[10.03,46.02]]}"#);
    let (scene, surface) = folder
        .load(
            "camera = { eye_geo = [10.02, 46.015, 900.0], target_geo = [10.021, 46.02, 500.0] }
            terrain = { source = \"d.asc\", crs = \"EPSG:4326\" }
            [[layer]]\nsource = \"l.geojson\"\nline = { color = \"#000000\", width_m = 9.0 }",
        )
        .unwrap();
    let posts = posts(surface);
    assert_eq!((scene.origin, posts.columns(), posts.rows()), (DVec3::ZERO, 41, 31));
    assert!(posts.plan(20, 15).to_vec().length() < 1e-6, "the middle post stands at the centre");
    // Metres in a degree at 46 north, from the ellipsoid's formulas.
    assert!(
        (posts.east().x - 77.442_364).abs() < 1e-6 && (posts.north().y - 111.151_612).abs() < 1e-6,
        "{}",
        posts.north()
    );
    let line = vertices(&scene.layers[0].features);
    assert!(line[0].to_vec().length() < 1e-6);
    assert!((line[1] - posts.plan(30, 20)).length() < 1e-6);
    assert!((scene.camera.eye.plan() - line[0]).length() < 1e-6);
    assert!(scene.plan_space.starts_with("local plane at longitude 10.02, latitude 46.015"));
    assert!(scene.notes.iter().any(|n| n.contains("% off")), "{:?}", scene.notes);
}

/// A surface that is flat in the plan of a CRS, sampled on a grid of another.
fn tilted(plan: &PlanSpace, other: &Crs) -> impl Fn(f64, f64) -> f64 + use<> {
    let map = plan.plan_from(other).unwrap();
    move |x, y| {
        let p = map.apply(DVec2::new(x, y)).unwrap();
        0.1 * (p.x - 500_000.0) - 0.05 * (p.y - 5_100_000.0)
    }
}

#[test]
fn a_plane_resampled_from_another_crs_is_the_same_plane() {
    let utm = Crs::parse("EPSG:32632").unwrap();
    let plan = PlanSpace::projected(utm).unwrap();
    let flat = tilted(&plan, &Crs::parse("EPSG:4326").unwrap());
    let folder = Folder::new().with("d.asc", grid((81, 61), (9.5, 46.0), 0.0005, flat));
    let load = || {
        folder.load("crs = \"EPSG:32632\"\nterrain = { source = \"d.asc\", crs = \"EPSG:4326\" }").unwrap()
    };
    let (scene, surface) = load();
    let first = posts(surface);
    let mut seen = 0;
    for j in 0..first.rows() {
        for i in 0..first.columns() {
            let p = first.world(i, j);
            let q = p.plan() + scene.origin.truncate();
            if !p.z.is_nan() {
                seen += 1;
                let truth = 0.1 * (q.x - 500_000.0) - 0.05 * (q.y - 5_100_000.0);
                assert!((p.z - truth).abs() < 1e-3, "{q:?}: {} instead of {truth}", p.z);
            }
        }
    }
    assert!(seen > 80 * 60 * 9 / 10, "{seen} of {} posts hold data", first.heights().len());
    assert!((first.east().x - 38.7).abs() < 0.2 && (first.north().y - 55.6).abs() < 0.2);
    assert!(scene.notes.iter().any(|n| n.contains("resampled (bilinear)")), "{:?}", scene.notes);
    let bits = |p: &Posts| p.heights().iter().map(|z| z.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&first), bits(&posts(load().1)));
}

#[test]
fn resampling_takes_no_height_from_beside_a_hole() {
    let hole = |x: f64, y: f64| {
        let at = |v: f64, post: f64| (v - post).abs() < 1e-9;
        if at(x, 9.51) && at(y, 46.01) { -9999.0 } else { 700.0 }
    };
    let folder = Folder::new().with("d.asc", grid((41, 41), (9.5, 46.0), 0.0005, hole));
    let text = "crs = \"EPSG:32632\"\nterrain = { source = \"d.asc\", crs = \"EPSG:4326\" }";
    let posts = posts(folder.load(text).unwrap().1);
    assert!(posts.heights().iter().all(|z| z.is_nan() || (z - 700.0).abs() < 1e-9));
    let middle = |i: usize, j: usize| {
        let inside = |at: usize, of: usize| at > 3 && at + 4 < of;
        inside(i, posts.columns()) && inside(j, posts.rows())
    };
    let holes = (0..posts.heights().len())
        .filter(|k| posts.heights()[*k].is_nan() && middle(k % posts.columns(), k / posts.columns()));
    assert!((2..=6).contains(&holes.count()), "the four cells around the hole");
}

#[test]
fn points_are_placed_like_posts() {
    let folder =
        Folder::new().with("p.xyz", "412345.5 5123456.25 10\n412355 5123456 20\n412350 5123470 30\n");
    let (scene, surface) = folder.load("terrain = { source = \"p.xyz\" }").unwrap();
    let Surface::Points(points) = surface else { panic!("a grid") };
    assert_eq!(scene.origin.fract(), DVec3::ZERO);
    assert_eq!(points[0].plan() + scene.origin.truncate(), Plan::new(412_345.5, 5_123_456.25));
}

#[test]
fn features_off_the_terrain_are_left_out_and_the_others_keep_their_numbers() {
    let (scene, _) = Folder::new()
        .load(
            "terrain = { generate = { kind = \"plane\", posts = [5, 5], cell_m = 10.0 } }
            [[layer]]\nname = \"a\"\nline = { color = \"#000000\", width_m = 4.0 }
            features = [{ line = [[90, 0], [91, 0]] }, { line = [[21.5, 0], [30, 0]] }, { line = [[0, 0], [1, 1]] }]
            [[layer]]\nname = \"b\"\nline = { color = \"#000000\", width_px = 4.0 }\nfeatures = [{ line = [[90, 0], [91, 0]] }]",
        )
        .unwrap();
    let numbers = |k: usize| scene.layers[k].features.iter().map(|f| f.index).collect::<Vec<_>>();
    assert_eq!((numbers(0), numbers(1)), (vec![1, 2], vec![0]));
    assert_eq!(scene.notes, ["layer `a`: 1 of 3 features lie off the terrain and are left out"]);
}

#[test]
fn without_a_camera_the_view_frames_the_layers_on_the_terrain() {
    let text = |line: &str| {
        format!(
            "terrain = {{ generate = {{ kind = \"plane\", posts = [101, 101], cell_m = 10.0, height_m = 50.0 }} }}
            [[layer]]\nfeatures = [{{ line = {line} }}]\nline = {{ color = \"#000000\", width_m = 4.0 }}"
        )
    };
    let target = |line: &str| Folder::new().load(&text(line)).unwrap().0.camera.target;
    let near = target("[[100, 100], [300, 200]]");
    assert_eq!((near.x, near.y, near.z), (200.0, 150.0, 50.0));
    let across = target("[[400, 0], [90000, 100]]");
    assert_eq!((across.x, across.y), (450.0, 50.0));
    let off = target("[[9000, 0], [90000, 100]]");
    assert_eq!((off.x, off.y), (0.0, 0.0));
}

#[test]
fn a_missing_file_is_shown_in_the_scene_with_what_was_meant() {
    let folder = Folder::new().with("dem.asc", "").with("roads.geojson", "");
    let error = folder.refused("terrain = { source = \"den.asc\" }");
    assert_eq!(error.what(), "there is no file `den.asc`");
    assert_eq!(error.help_text(), Some("did you mean `dem.asc`?"));
    assert_eq!((error.position().unwrap().line, error.path()), (2, Some(&*folder.path("s.toml"))));
    let far = folder.refused("terrain = { source = \"nothing/like/it.tif\" }");
    assert!(far.help_text().unwrap().contains("relative to the scene file"), "{far}");
}

#[test]
fn an_error_in_a_data_file_names_the_file_the_feature_and_the_scene_line() {
    let line = r#"{"type":"FeatureCollection","features":[
        {"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[9.5,46],[9.6,46]]}},
        {"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[9.5,46],[9.6,5000000]]}}]}"#;
    let folder = Folder::new()
        .with("d.asc", grid((5, 5), (500_000.0, 5_100_000.0), 100.0, hills))
        .with("l.geojson", line);
    let said = folder
        .refused(
            "terrain = { source = \"d.asc\", crs = \"EPSG:32632\" }\n[[layer]]\nsource = \"l.geojson\"\nline = { color = \"#000000\", width_m = 4.0 }",
        )
        .to_string();
    assert!(said.contains("l.geojson: feature 1: (9.6, 5000000) is not a place in"), "{said}");
    assert!(said.contains(&format!("named in {}:4:10", folder.path("s.toml").display())), "{said}");
}

#[test]
fn what_is_out_of_reach_is_refused_with_its_file_or_key() {
    let ascii = "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3 4e30\n";
    let folder = Folder::new().with("d.asc", ascii).with("p.xyz", "0 0 1\n1e30 0 2\n0 1e30 3\n");
    let said = folder.refused("terrain = { source = \"d.asc\" }").to_string();
    assert!(said.contains("d.asc: the terrain reaches 4e30 m, beyond 1e12 m"), "{said}");
    let said = folder.refused("terrain = { source = \"p.xyz\" }").to_string();
    assert!(said.contains("p.xyz: the terrain reaches"), "{said}");
    let plane = "generate = { kind = \"plane\", posts = [5, 5], cell_m = 10.0 }";
    let said = folder.refused(&format!("terrain = {{ {plane}, offset = [1e300, 0] }}")).to_string();
    assert!(said.contains("`terrain`: the terrain reaches 1e300 m"), "{said}");
    let none = "generate = { kind = \"plane\", posts = [5, 5], cell_m = 1e-300 }";
    let said = folder.refused(&format!("terrain = {{ {none} }}")).to_string();
    assert!(said.contains("`terrain.generate`: the grid's rows and columns do not span the plan"), "{said}");
    let camera = "camera = { eye = [0, 0, 1e200], target = [0, 1, 0], up = [0, 1, 0] }";
    let said = folder.refused(&format!("{camera}\nterrain = {{ {plane} }}")).to_string();
    assert!(said.contains("`camera.eye`: a place more than 1e12 m from the terrain"), "{said}");
}

#[test]
fn an_unknown_crs_is_blamed_on_its_key() {
    let folder = Folder::new().with("d.asc", grid((5, 5), (0.0, 0.0), 100.0, hills));
    let said = folder.refused("crs = \"EPSG:99\"\nterrain = { source = \"d.asc\" }").to_string();
    assert!(said.contains("s.toml: `crs`: EPSG:99 is not a CRS known here"), "{said}");
    let said = folder.refused("crs = \"EPSG:4326\"\nterrain = { source = \"d.asc\" }").to_string();
    assert!(said.contains("in degrees, not a plane"), "{said}");
    let said = folder.refused("terrain = { source = \"d.asc\", crs = \"nonsense\" }").to_string();
    assert!(said.contains("`terrain.crs`: 'nonsense' does not name a CRS"), "{said}");
}

#[test]
fn geographic_cameras_need_a_plan_with_a_crs() {
    let text = "camera = { eye_geo = [9, 46, 900], target_geo = [9, 47, 0] }\nterrain = { generate = { kind = \"plane\" } }";
    let said = Folder::new().refused(text).to_string();
    assert!(said.contains("`camera.eye_geo`: longitude and latitude have no place"), "{said}");
    let placed = Folder::new().load(&format!("crs = \"EPSG:32632\"\n{text}")).unwrap().0;
    assert!((placed.camera.eye.x - 500_000.0).abs() < 1e-3);
}

#[test]
fn a_layer_in_another_crs_is_reprojected_with_a_note() {
    let folder = Folder::new()
        .with("d.asc", grid((5, 5), (500_000.0, 5_099_600.0), 100.0, hills))
        .with("l.geojson", r#"{"type":"LineString","coordinates":[[9.001,46.0515],[9.004,46.0525]]}"#);
    let (scene, _) = folder
        .load(
            "terrain = { source = \"d.asc\", crs = \"EPSG:32632\" }\n[[layer]]\nsource = \"l.geojson\"\nline = { color = \"#000000\", width_m = 4.0 }",
        )
        .unwrap();
    let at = vertices(&scene.layers[0].features)[0] + scene.origin.truncate();
    // PROJ 9.5 says 500077.3604, 5099769.5216.
    assert!((at - Plan::new(500_077.360_4, 5_099_769.521_6)).length() < 1e-3, "{at:?}");
    assert!(
        scene.notes.iter().any(|n| n.starts_with("layer `l`: reprojected from OGC:CRS84")),
        "{:?}",
        scene.notes
    );
}

/// The notes of a scene with a layer in a CRS of its own over a terrain in another.
fn notes_of_crs(scene: &str, terrain: &str, layer: &str) -> Vec<String> {
    let line = r#"{"type":"LineString","coordinates":[[9.001,46.0515],[9.004,46.0525]]}"#;
    let folder = Folder::new()
        .with("d.asc", grid((5, 5), (500_000.0, 5_099_600.0), 100.0, hills))
        .with("l.geojson", line);
    let text = format!(
        "{scene}\nterrain = {{ source = \"d.asc\", crs = \"{terrain}\" }}\n[[layer]]\nsource = \"l.geojson\"\ncrs = \"{layer}\"\nline = {{ color = \"#000000\", width_m = 4.0 }}",
    );
    folder.load(&text).unwrap().0.notes
}

#[test]
fn a_layer_in_a_crs_that_cannot_be_used_is_refused_unless_the_scene_says_its_own() {
    let unusable = r#"{"type":"LineString","crs":{"type":"name","properties":{"name":"EPSG:27200"}},"coordinates":[[500010.0,5099700.0],[500300.0,5099800.0]]}"#;
    let folder = Folder::new()
        .with("d.asc", grid((5, 5), (500_000.0, 5_099_600.0), 100.0, hills))
        .with("l.geojson", unusable);
    let text = |terrain: &str, layer: &str| {
        format!(
            "terrain = {{ source = \"d.asc\"{terrain} }}\n[[layer]]\nsource = \"l.geojson\"\n{layer}\nline = {{ color = \"#000000\", width_m = 4.0 }}"
        )
    };
    let placed = ", crs = \"EPSG:32632\"";
    let refused = folder.refused(&text(placed, "")).to_string();
    for words in ["l.geojson", "the CRS in the crs member cannot be used: EPSG:27200", "`crs`", "reproject"] {
        assert!(refused.contains(words), "{words}: {refused}");
    }
    // The scene knows better, and no terrain without a CRS can tell where anything lies.
    for (terrain, layer) in [(placed, "crs = \"EPSG:32632\""), ("", "")] {
        let notes = folder.load(&text(terrain, layer)).unwrap().0.notes;
        assert!(notes.iter().any(|note| note.contains("EPSG:27200")), "{notes:?}");
    }
}

#[test]
fn an_unknown_datum_is_told_however_the_crs_was_given() {
    const UNKNOWN: &str = "+proj=longlat +ellps=bessel";
    const UNKNOWN_UTM: &str = "+proj=utm +zone=32 +ellps=bessel";
    for (scene, terrain, layer, by) in [
        ("", "EPSG:32632", UNKNOWN, "layer `l`: "),
        ("", UNKNOWN_UTM, "EPSG:4326", "terrain: "),
        ("crs = \"+proj=utm +zone=32 +ellps=bessel\"", "EPSG:32632", "EPSG:4326", "crs: "),
    ] {
        let notes = notes_of_crs(scene, terrain, layer);
        let expected = format!("{by}no datum shift is known for +");
        let told = notes.iter().filter(|note| note.starts_with(&expected)).count();
        assert_eq!(told, 1, "{by} {notes:?}");
    }
    let notes = notes_of_crs("", "EPSG:32632", "EPSG:4326");
    assert!(!notes.iter().any(|note| note.contains("datum")), "{notes:?}");
}

#[test]
fn metres_that_a_scene_says_are_metres_are_not_told_off_the_globe() {
    let folder = Folder::new()
        .with("d.asc", grid((5, 5), (500_000.0, 5_099_600.0), 100.0, hills))
        .with("l.geojson", r#"{"type":"LineString","coordinates":[[500100,5099700],[500200,5099900]]}"#);
    let notes = |crs: &str| {
        let text = format!(
            "terrain = {{ source = \"d.asc\", crs = \"EPSG:32632\" }}\n[[layer]]\nsource = \"l.geojson\"\n{crs}\nline = {{ color = \"#000000\", width_m = 4.0 }}",
        );
        folder.load(&text).map(|(scene, _)| scene.notes)
    };
    assert_eq!(notes("crs = \"EPSG:32632\"").unwrap(), [""; 0]);
}

#[test]
fn a_projection_of_another_library_is_told_where_it_places_anything() {
    const CASSINI: &str = "+proj=cass +lat_0=46 +lon_0=9 +ellps=WGS84";
    let told = |scene: &str, terrain: &str, layer: &str| {
        let notes = notes_of_crs(scene, terrain, layer);
        let told = notes.iter().filter(|note| note.contains("2^-20 m between processors"));
        told.map(|note| note.split(':').next().unwrap_or("").to_owned()).collect::<Vec<_>>()
    };
    let asked = format!("crs = \"{CASSINI}\"");
    assert_eq!(told(&asked, "EPSG:32632", "EPSG:4326"), ["terrain", "layer `l`"]);
    assert_eq!(told("", CASSINI, "EPSG:4326"), ["layer `l`"]);
    assert_eq!(told("", CASSINI, CASSINI), [""; 0]);
    assert_eq!(told("", "EPSG:3035", "EPSG:2056"), [""; 0]);
}

#[test]
fn imagery_covers_the_terrain_or_what_its_world_file_says() {
    let mut png = std::io::Cursor::new(Vec::new());
    let pixels = image::RgbImage::from_raw(2, 2, vec![255, 0, 0, 0, 0, 51, 9, 9, 9, 9, 9, 9]).unwrap();
    pixels.write_to(&mut png, image::ImageFormat::Png).unwrap();
    let folder = Folder::new()
        .with("d.asc", grid((5, 5), (1000.0, 2000.0), 10.0, hills))
        .with("o.png", png.into_inner());
    let read =
        || folder.load("terrain = { source = \"d.asc\", imagery = \"o.png\" }").map(|(scene, _)| scene);
    let load = || match read().unwrap().ground.colors {
        crate::scene::GroundColors::Imagery(imagery) => imagery,
        other => panic!("{other:?}"),
    };
    let is_stretched =
        || read().unwrap().notes.iter().any(|n| n.contains("imagery: ") && n.contains("stretched"));
    let imagery = load();
    assert!(is_stretched());
    assert_eq!(imagery.texels.at(1, 0).0, [0.0, 0.0, 0.2, 1.0]);
    assert_eq!((imagery.extent.min, imagery.extent.max), (Plan::new(-20.0, -20.0), Plan::new(20.0, 20.0)));
    std::fs::write(folder.path("o.pgw"), "20\n0\n0\n-15\n1010\n2022.5\n").unwrap();
    let extent = load().extent;
    assert_eq!((extent.min, extent.max), (Plan::new(-20.0, -20.0), Plan::new(20.0, 10.0)));
    assert!(!is_stretched());
    let aux = |place: &str, srs: &str| {
        let text = format!("<PAMDataset><SRS>{srs}</SRS><GeoTransform>{place}</GeoTransform></PAMDataset>");
        std::fs::write(folder.path("o.png.aux.xml"), text).unwrap();
    };
    // As of a terrain, what GDAL says counts before a world file.
    aux("1010, 5, 0, 2030, 0, -5", "");
    let extent = load().extent;
    assert_eq!((extent.min, extent.max), (Plan::new(-10.0, 0.0), Plan::new(0.0, 10.0)));
    assert!(!is_stretched());
    for (place, what) in [("1010, 5, 1, 2030, 0, -5", "turns"), ("here", "six numbers")] {
        aux(place, "");
        let message = read().unwrap_err().to_string();
        assert!(message.contains(what) && message.contains("o.png"), "{message}");
    }
}

#[test]
fn imagery_in_another_crs_than_the_plan_is_refused() {
    let mut png = std::io::Cursor::new(Vec::new());
    image::RgbImage::new(2, 2).write_to(&mut png, image::ImageFormat::Png).unwrap();
    let folder = Folder::new()
        .with("d.asc", grid((5, 5), (500_000.0, 5_000_000.0), 10.0, hills))
        .with("o.png", png.into_inner());
    let read = |srs: &str| {
        let text = format!(
            "<PAMDataset><SRS>{srs}</SRS><GeoTransform>500000, 5, 0, 5000030, 0, -5</GeoTransform></PAMDataset>"
        );
        std::fs::write(folder.path("o.png.aux.xml"), text).unwrap();
        let scene = "terrain = { source = \"d.asc\", imagery = \"o.png\", crs = \"EPSG:32632\" }\ncrs = \"EPSG:32632\"";
        folder.load(scene).map(|(scene, _)| scene.notes)
    };
    for same in ["EPSG:32632", "+proj=utm +zone=32 +datum=WGS84"] {
        let notes = read(same).unwrap();
        assert!(!notes.iter().any(|n| n.starts_with("imagery")) || same.starts_with('+'), "{notes:?}");
    }
    let message = read("EPSG:32633").unwrap_err().to_string();
    assert!(message.contains("another CRS") && message.contains("gdalwarp -t_srs"), "{message}");
    assert!(read("LOCAL_CS[]").unwrap().iter().any(|n| n.contains("is not followed")));
}

#[test]
fn the_scene_that_is_built_in_loads() {
    let file = SceneFile::parse(crate::scene_file::DEFAULT_SCENE, None::<&Path>, &[]).unwrap();
    let (scene, surface) = load(&file, &|_| ()).unwrap();
    assert_eq!((scene.layers.len(), scene.origin), (8, DVec3::ZERO));
    assert_eq!(posts(surface).columns(), 513);
}

#[test]
fn points_are_drawn_where_a_layer_says_how_and_left_out_with_a_word_where_not() {
    let point =
        r#"{"type":"Feature","properties":{},"geometry":{"type":"MultiPoint","coordinates":[[0,0],[9,9]]}}"#;
    let line =
        r#"{"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[0,0],[9,9]]}}"#;
    let both = format!(r#"{{"type":"FeatureCollection","features":[{point},{line}]}}"#);
    let folder = Folder::new().with("points.json", point).with("both.json", both);
    let layer = |file: &str, style: &str| {
        format!(
            "terrain = {{ generate = {{ kind = \"plane\" }} }}\n[[layer]]\nsource = \"{file}\"\n{style}\n"
        )
    };
    let (point, line) =
        ("point = { color = \"#ff0000\", width_px = 5 }", "line = { color = \"#ff0000\", width_m = 5 }");
    let kept = |text: &str| folder.load(text).unwrap().0.layers[0].features.len();
    assert_eq!(kept(&layer("both.json", &format!("{point}\n{line}"))), 2);
    assert_eq!(kept(&layer("points.json", point)), 1);
    let (scene, _) = folder.load(&layer("both.json", line)).unwrap();
    assert_eq!(scene.layers[0].features.len(), 1);
    assert!(
        scene.notes.iter().any(|note| note.contains("2 points left out: the layer has no `point`")),
        "{:?}",
        scene.notes
    );
    let refused = folder.refused(&layer("points.json", line)).to_string();
    assert!(refused.contains("nothing in this layer can be drawn: 2 points left out"), "{refused}");
    let inline = layer("points.json", point)
        .replace("source = \"points.json\"", "features = [{ points = [[1, 2], [3, 4]] }]");
    assert_eq!(kept(&inline), 1);
}

#[test]
fn a_shapefile_whose_crs_the_scene_says_is_not_told_off_for_lacking_one() {
    let point = |at: f64| {
        let place = [at.to_le_bytes(), at.to_le_bytes()].concat();
        [&1_u32.to_be_bytes()[..], &10_u32.to_be_bytes(), &1_u32.to_le_bytes(), &place].concat()
    };
    let mut shp =
        [&9994_u32.to_be_bytes()[..], &[0; 20], &64_u32.to_be_bytes(), &1000_u32.to_le_bytes()].concat();
    shp.extend(1_u32.to_le_bytes());
    shp.extend([0; 64]);
    shp.extend(point(20.0));
    let folder = Folder::new().with("d.asc", grid((5, 5), (0.0, 0.0), 10.0, hills)).with("l.shp", shp);
    let says = |crs: &str| {
        let text = format!(
            "terrain = {{ source = \"d.asc\", crs = \"EPSG:32632\" }}\n[[layer]]\nsource = \"l.shp\"\n{crs}\npoint = {{ color = \"#000000\", width_m = 4.0 }}"
        );
        folder.load(&text).unwrap().0.notes.iter().any(|note| note.contains("no .prj"))
    };
    assert!(says("") && !says("crs = \"EPSG:32632\""));
}
