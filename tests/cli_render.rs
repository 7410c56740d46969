//! `drapery render` as a user or a script calls it: what it writes, where, and what it leaves when it fails.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "helpers of tests are no tests to the lint")]

use drapery::technique::Kind;
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

/// A small scene that every technique draws; the terrain is far from the plan's zero point.
const SCENE: &str = r##"
schema = 1
name = "small"
[image]
width = 96
height = 64
[camera]
eye = [500000.0, 6998200.0, 1500.0]
target = [500000.0, 7000000.0, 100.0]
[terrain]
generate = { kind = "fbm", seed = 3, posts = [65, 65], cell_m = 40.0, height_m = 300.0, wavelength_m = 900.0, octaves = 4 }
offset = [500000.0, 7000000.0]
[[layer]]
name = "lake"
features = [{ polygon = [[499700, 6999600], [500300, 6999600], [500300, 7000200], [499700, 7000200]] }]
fill = { color = "#3388ff", opacity = 0.6 }
[[layer]]
name = "road"
features = [{ line = [[499200, 6999500], [500800, 7000300]] }]
line = { color = "#ff7f00", width_m = 30.0, join = "round", cap = "round" }
"##;

/// A folder with the scene, in which the program is called.
struct Place(tempfile::TempDir);

impl Place {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("small.toml"), SCENE).unwrap();
        Self(folder)
    }

    fn path(&self) -> &Path {
        self.0.path()
    }

    fn render(&self, arguments: &[&str]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_drapery"))
            .args(["render", "small.toml"])
            .args(arguments)
            .current_dir(self.path())
            .stdin(Stdio::null())
            .output()
            .unwrap()
    }

    /// What a good call says on stderr; its stdout is empty.
    fn rendered(&self, arguments: &[&str]) -> String {
        let output = self.render(arguments);
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(0), "{said}");
        assert!(output.stdout.is_empty());
        said
    }

    /// What a refused call says on stderr.
    fn refused(&self, arguments: &[&str]) -> String {
        let output = self.render(arguments);
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(output.stdout.is_empty());
        said
    }

    fn names(&self, folder: &str) -> Vec<String> {
        let entries = fs::read_dir(self.path().join(folder)).unwrap();
        let mut names: Vec<String> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    fn result(&self, folder: &str) -> Value {
        let text = fs::read_to_string(self.path().join(folder).join("result.json")).unwrap();
        serde_json::from_str(&text).unwrap()
    }
}

/// The truth and the techniques that draw the scene: it has no widths in pixels.
fn names_of_all() -> Vec<&'static str> {
    let techniques = Kind::ALL.iter().filter(|kind| **kind != Kind::DynamicLine).map(|kind| kind.name());
    std::iter::once(drapery::truth::NAME).chain(techniques).collect()
}

/// The hashes of all pictures and buffers of a run.
fn hashes(result: &Value) -> Vec<(String, String)> {
    let of = |value: &Value| {
        let text = |key: &str| value[key].as_str().unwrap().to_owned();
        (text("path"), text("hash"))
    };
    let runs = result["runs"].as_array().unwrap();
    let each = |run: &Value| {
        let buffers = run["buffers"].as_array().unwrap();
        let all = [&run["image"]].into_iter().chain(buffers);
        all.map(of).collect::<Vec<_>>()
    };
    runs.iter().flat_map(each).collect()
}

/// The shape of an .npy file as it is written there, and its doubles.
fn doubles(path: &Path) -> (String, Vec<f64>) {
    let file = fs::read(path).unwrap();
    let values = 10 + usize::from(u16::from_le_bytes([file[8], file[9]]));
    let head = String::from_utf8_lossy(&file[10..values]).into_owned();
    assert!(head.contains("'descr': '<f8'"), "{head}");
    let shape = &head[head.find("'shape': (").unwrap() + 10..];
    let shape = shape[..shape.find(')').unwrap()].to_owned();
    let (bytes, rest) = file[values..].as_chunks();
    assert!(rest.is_empty());
    (shape, bytes.iter().map(|b| f64::from_le_bytes(*b)).collect())
}

#[test]
fn every_technique_gets_a_picture_and_a_line_for_people() {
    let place = Place::new();
    let said = place.rendered(&[]);
    let mut expected: Vec<String> = names_of_all().iter().map(|name| format!("{name}.png")).collect();
    expected.push("result.json".into());
    expected.sort();
    assert_eq!(place.names("out"), expected);
    for name in names_of_all() {
        let picture = image::open(place.path().join("out").join(format!("{name}.png"))).unwrap();
        assert_eq!((picture.width(), picture.height()), (96, 64));
        let line = said.lines().find(|line| line.starts_with(&format!("{name} "))).unwrap();
        assert!(line.contains(" ms  frame ") && line.contains("out/"), "{line}");
    }
    assert!(!said.contains('\x1b'), "no bar and no colour where there is no terminal");
}

#[test]
fn the_result_has_every_field_of_the_contract_and_no_path_of_the_machine() {
    let place = Place::new();
    place.rendered(&["--repeat", "2"]);
    let result = place.result("out");
    assert_eq!(result["schema"], 1);
    assert_eq!(result["scene"]["name"], "small");
    assert_eq!(result["scene"]["hash"].as_str().unwrap().len(), 64);
    assert_eq!(result["scene"]["origin"], serde_json::json!([500_000.0, 7_000_000.0]));
    assert!(result["notes"].is_array());
    let runs = result["runs"].as_array().unwrap();
    assert_eq!(runs.len(), names_of_all().len());
    for run in runs {
        for key in ["technique", "parameters", "device", "image", "prepare_ms", "frame_ms", "structure_bytes"]
        {
            assert!(!run[key].is_null(), "{key}");
        }
        for key in ["max", "mean", "rmse", "p99", "over_one_code_value", "reference_width_max"] {
            assert!(run["error"][key].is_f64(), "{key}");
        }
        assert!(run["counts"].is_object());
        let device = serde_json::json!({
            "precision": "f64",
            "position": "local",
            "subpixel_bits": 0,
            "interpolation": "snapped",
            "depth": "f32-reversed",
            "stencil_bits": 8,
            "max_line_width_px": 10.0,
            "filter_bits": 0,
            "level_bits": 0
        });
        assert_eq!(run["device"], device);
        assert_eq!((&run["image"]["width"], &run["image"]["height"]), (&96.into(), &64.into()));
        assert!(run["frame_ms"].as_f64().unwrap() > 0.0);
    }
    let text = fs::read_to_string(place.path().join("out/result.json")).unwrap();
    assert!(!text.contains(place.path().to_str().unwrap()));
}

#[test]
fn a_technique_alone_is_drawn_without_the_truth_and_errors_are_told_when_they_are_asked_for() {
    let place = Place::new();
    let line = |said: &str| said.lines().find(|line| line.starts_with("clipmap ")).unwrap().to_owned();
    let alone = place.rendered(&["-t", "clipmap", "-o", "alone"]);
    assert!(!line(&alone).contains("error"), "{alone}");
    let judged = place.rendered(&["-t", "clipmap", "--errors", "-o", "judged"]);
    assert!(line(&judged).contains("error max "), "{judged}");
    place.rendered(&["-t", "clipmap", "-t", "truth", "-o", "both"]);
    let runs =
        ["alone", "judged", "both"].map(|folder| place.result(folder)["runs"].as_array().unwrap().clone());
    assert_eq!(runs.each_ref().map(Vec::len), [1, 1, 2], "--errors writes no picture of the truth");
    assert!(runs[0][0].get("error").is_none());
    assert_eq!(runs[1][0]["error"], runs[2][1]["error"]);
    assert!(runs[1][0]["error"]["rmse"].is_f64());
    assert_eq!(runs[0][0]["image"], runs[1][0]["image"]);
}

#[test]
fn how_exact_a_truth_is_that_nobody_asked_for_is_told_to_mean_nothing() {
    let place = Place::new();
    let said = place.rendered(&["-t", "clipmap", "--truth-width", "0.01"]);
    assert!(said.contains("note: the truth is not computed"), "{said}");
    let said = place.rendered(&["-t", "clipmap", "--truth-width", "0.01", "--errors"]);
    assert!(!said.contains("not computed"), "{said}");
}

#[test]
fn the_hash_of_an_image_is_of_its_pixels() {
    let place = Place::new();
    place.rendered(&[]);
    for run in place.result("out")["runs"].as_array().unwrap() {
        let path = place.path().join("out").join(run["image"]["path"].as_str().unwrap());
        let pixels = image::open(path).unwrap().into_rgba8();
        assert_eq!(run["image"]["hash"], blake3::hash(pixels.as_raw()).to_hex().to_string());
    }
}

#[test]
fn pictures_and_buffers_are_the_same_with_one_thread_and_with_three() {
    let place = Place::new();
    place.rendered(&["--threads", "1", "--buffers", "all", "-o", "one"]);
    place.rendered(&["--threads", "3", "--buffers", "all", "-o", "three"]);
    assert_eq!(hashes(&place.result("one")), hashes(&place.result("three")));
    for name in place.names("one") {
        if name != "result.json" {
            let [one, three] = ["one", "three"].map(|f| fs::read(place.path().join(f).join(&name)).unwrap());
            assert!(one == three, "{name}");
        }
    }
}

#[test]
fn a_scene_that_is_moved_keeps_its_hashes_and_moves_its_coordinates() {
    let place = Place::new();
    place.rendered(&["--buffers", "all", "-o", "here"]);
    place.rendered(&[
        "--buffers",
        "all",
        "-o",
        "there",
        "--set",
        "terrain.offset=[0, 0]",
        "--set",
        "camera.eye=[0, -1800, 1500]",
        "--set",
        "camera.target=[0, 0, 100]",
        "--set",
        "layer.lake.features=[{polygon=[[-300, -400], [300, -400], [300, 200], [-300, 200]]}]",
        "--set",
        "layer.road.features=[{line=[[-800, -500], [800, 300]]}]",
    ]);
    let (here, there) = (place.result("here"), place.result("there"));
    assert_eq!(hashes(&here), hashes(&there));
    assert_ne!(here["scene"]["hash"], there["scene"]["hash"]);
    let plan = |folder: &str| doubles(&place.path().join(folder).join("inverse-projection.plan.npy"));
    let ((shape, here), (_, there)) = (plan("here"), plan("there"));
    assert_eq!((shape.as_str(), here.len()), ("64, 96, 2", 64 * 96 * 2));
    let origin = [500_000.0, 7_000_000.0].into_iter().cycle();
    let moved = there.iter().zip(origin).map(|(v, origin)| v + origin);
    assert!(here.iter().copied().eq(moved));
}

#[test]
fn the_buffers_that_are_asked_for_are_written_and_no_others() {
    let place = Place::new();
    place.rendered(&["-t", "inverse-projection", "--buffers", "depth,class"]);
    assert_eq!(
        place.names("out"),
        [
            "inverse-projection.class.npy",
            "inverse-projection.class.png",
            "inverse-projection.depth.npy",
            "inverse-projection.depth.png",
            "inverse-projection.png",
            "result.json"
        ]
    );
    let (shape, depth) = doubles(&place.path().join("out/inverse-projection.depth.npy"));
    assert_eq!(shape, "64, 96");
    assert!(depth.iter().all(|d| *d >= 1.0) && depth.contains(&f64::INFINITY), "the sky is infinitely far");
    let buffers = place.result("out")["runs"][0]["buffers"].clone();
    let mut names: Vec<&str> =
        buffers.as_array().unwrap().iter().map(|b| b["name"].as_str().unwrap()).collect();
    names.sort_unstable();
    assert_eq!(names, ["class", "depth"]);
}

#[test]
fn buffers_do_not_change_the_picture() {
    let place = Place::new();
    place.rendered(&["-o", "without"]);
    place.rendered(&["-o", "with", "--buffers", "all"]);
    let picture = |folder: &str| place.result(folder)["runs"][0]["image"].clone();
    assert_eq!(picture("without"), picture("with"));
}

#[test]
fn a_buffer_that_no_technique_has_is_refused_with_the_names_and_nothing_is_left() {
    let place = Place::new();
    let said = place.refused(&["--buffers", "depth,nonsense"]);
    assert!(said.contains("there is no buffer `nonsense`") && said.contains("depth"), "{said}");
    assert_eq!(place.names("."), ["small.toml"]);
}

#[test]
fn a_technique_that_does_not_exist_is_refused_by_name() {
    let place = Place::new();
    let said = place.refused(&["-t", "analytics"]);
    assert!(said.contains("analytics") && said.contains("similar") && said.contains("'analytic'"), "{said}");
    assert_eq!(place.names("."), ["small.toml"]);
}

#[test]
fn a_technique_that_does_not_apply_is_refused_by_name_with_the_reason() {
    let place = Place::new();
    let dynamic = ["--set", "layer.road.line={color=\"#ff7f00\", width_px=3.0}"];
    let said = place.refused(&[&["-t", "inverse-projection"][..], &dynamic].concat());
    assert!(said.contains("width_px"), "{said}");
    assert_eq!(place.names("."), ["small.toml"]);
}

#[test]
fn a_place_that_is_no_folder_is_refused() {
    let place = Place::new();
    fs::write(place.path().join("file"), "before").unwrap();
    for wrong in ["file", "file/below"] {
        let said = place.refused(&["-o", wrong]);
        assert!(said.contains("this output folder cannot be written"), "{said}");
    }
    assert_eq!(place.names("."), ["file", "small.toml"]);
}

#[test]
fn a_file_that_cannot_be_written_leaves_none_of_the_others() {
    let place = Place::new();
    fs::create_dir_all(place.path().join("out/result.json")).unwrap();
    let said = place.refused(&[]);
    assert!(said.contains("result.json: this file cannot be written: a folder has this name"), "{said}");
    assert_eq!(place.names("out"), ["result.json"]);
}

#[test]
fn what_a_run_does_not_write_stays() {
    let place = Place::new();
    place.rendered(&["--buffers", "depth"]);
    let before = place.names("out");
    place.rendered(&[]);
    assert_eq!(place.names("out"), before);
}

#[test]
fn shapes_that_can_not_be_drawn_are_refused_with_their_place() {
    let place = Place::new();
    for shape in ["polygon = [[1, 2]]", "polygon = [[1, 2], [3, 4]]", "line = [[1, 2]]"] {
        let scene = SCENE.replace("line = [[499200, 6999500], [500800, 7000300]]", shape);
        fs::write(place.path().join("small.toml"), scene).unwrap();
        let said = place.refused(&[]);
        assert!(said.contains("small.toml") && said.contains("layer.road.features.0"), "{shape}: {said}");
    }
}

#[test]
fn a_layer_file_in_which_nothing_can_be_drawn_is_refused_with_what_it_holds() {
    let place = Place::new();
    let scene = SCENE
        .replace("features = [{ line = [[499200, 6999500], [500800, 7000300]] }]", "source = \"it.geojson\"");
    fs::write(place.path().join("small.toml"), scene).unwrap();
    for (geometry, told) in [
        (r#"{ "type": "Point", "coordinates": [1, 2] }"#, "point"),
        (r#"{ "type": "Polygon", "coordinates": [] }"#, "without coordinates"),
        (r#"{ "type": "Polygon", "coordinates": [[[1, 2]]] }"#, "ring"),
    ] {
        let text = format!(r#"{{ "type": "Feature", "properties": {{}}, "geometry": {geometry} }}"#);
        fs::write(place.path().join("it.geojson"), text).unwrap();
        let said = place.refused(&[]);
        assert!(said.contains("it.geojson") && said.contains(told), "{geometry}: {said}");
    }
}

#[test]
fn a_pixel_is_asked_about_and_told_by_the_truth_and_techniques_without_further_files() {
    let place = Place::new();
    let output = place.render(&["-t", "truth", "-t", "static-decal", "-t", "clipmap", "--pick", "46,32"]);
    assert_eq!(output.status.code(), Some(0));
    let told = String::from_utf8(output.stdout).unwrap();
    let lines: Vec<&str> = told.lines().collect();
    let [pixel, truth, road, lake, ..] = lines[..] else { panic!("{told}") };
    assert_eq!((pixel, truth), ("pixel 46,32", "truth"));
    assert!(road.starts_with("  road: line of feature 0, covers 66.9"), "{told}");
    assert!(road.ends_with("%, topmost at the middle"), "{told}");
    assert_eq!(lake, "  lake: fill of feature 0, covers 100.00 % to 100.00 %");
    assert!(
        told.contains("static-decal\n  road: line of feature 0, topmost at the middle\n  lake: "),
        "{told}"
    );
    assert!(told.ends_with("clipmap\n  cannot tell which features there are\n"), "{told}");
    assert_eq!(place.names("out"), ["clipmap.png", "result.json", "static-decal.png", "truth.png"]);
    let result = place.result("out");
    assert_eq!(result["pick"]["pixel"], serde_json::json!([46, 32]));
    let runs = result["pick"]["runs"].as_array().unwrap();
    let topmost: Vec<Option<u64>> = runs.iter().map(|run| run["topmost"].as_u64()).collect();
    assert_eq!(topmost, [Some(1), Some(1), None]);
    assert_eq!(runs[1]["items"], serde_json::json!([{ "item": 1 }, { "item": 0 }]));
    assert_eq!(runs[2]["items"], Value::Null);
    assert_eq!(result["items"][1]["layer_name"], "road");
    let refused = place.refused(&["--pick", "96,0"]);
    assert!(refused.contains("there is no pixel 96,0 in a picture of 96 x 64"), "{refused}");
}
