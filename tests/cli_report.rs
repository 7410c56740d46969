//! `drapery report` as a user or a script calls it: what it writes, what it says, and what it leaves when it fails.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "helpers of tests are no tests to the lint")]

use drapery::report::sweep;
use drapery::technique::Kind;
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

/// A small scene that every technique draws.
const SCENE: &str = r##"
schema = 1
name = "tiny"
image = { width = 48, height = 32 }
camera = { eye = [0, -1800, 1500], target = [0, 0, 100] }
terrain.generate = { kind = "fbm", seed = 3, posts = [33, 33], cell_m = 60.0, height_m = 200.0 }
[[layer]]
name = "lake"
features = [{ polygon = [[-300, -400], [300, -400], [300, 200], [-300, 200]] }]
fill = { color = "#3388ff", opacity = 0.6 }
[[layer]]
name = "road"
features = [{ line = [[-800, -500], [800, 300]] }]
line = { color = "#ff7f00", width_m = 60.0 }
"##;

/// Columns and keys that hold times, or what follows from them.
const OF_TIME: [&str; 7] = [
    "frame_ms",
    "frame_ms_min",
    "frame_ms_max",
    "prepare_ms",
    "prepare_ms_min",
    "prepare_ms_max",
    "on_front",
];

/// A folder with the scene, in which the program is called.
struct Place(tempfile::TempDir);

impl Place {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("tiny.toml"), SCENE).unwrap();
        Self(folder)
    }

    fn path(&self) -> &Path {
        self.0.path()
    }

    fn report(&self, arguments: &[&str]) -> Output {
        let program = env!("CARGO_BIN_EXE_drapery");
        Command::new(program).arg("report").args(arguments).current_dir(self.path()).output().unwrap()
    }

    /// A report that has to succeed.
    fn reported(&self, arguments: &[&str]) -> String {
        let output = self.report(arguments);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{said}");
        assert!(output.stdout.is_empty());
        said
    }

    /// A report that has to be refused.
    fn refused(&self, arguments: &[&str]) -> String {
        let output = self.report(arguments);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(!self.path().join("report").exists());
        said
    }

    fn text(&self, name: &str) -> String {
        fs::read_to_string(self.path().join(name)).unwrap()
    }

    fn names(&self, folder: &str) -> Vec<String> {
        let entries = fs::read_dir(self.path().join(folder)).unwrap();
        let mut names: Vec<String> =
            entries.map(|e| e.unwrap().file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    /// The rows of a CSV file as maps from columns to cells (no cell here holds a comma).
    fn rows(&self, name: &str) -> Vec<Vec<(String, String)>> {
        let text = self.text(name);
        let mut lines = text.lines();
        let heads: Vec<&str> = lines.next().unwrap().split(',').collect();
        let row = |line: &str| {
            let cells: Vec<&str> = line.split(',').collect();
            assert_eq!(cells.len(), heads.len(), "{line}");
            heads.iter().zip(cells).map(|(h, c)| ((*h).to_owned(), c.to_owned())).collect()
        };
        lines.map(row).collect()
    }
}

/// The runs of a report's first scene.
fn runs(text: &str) -> Vec<Value> {
    let value: Value = serde_json::from_str(text).unwrap();
    value["scenes"][0]["runs"].as_array().unwrap().clone()
}

#[test]
fn a_report_has_all_its_files_and_a_row_for_every_setting() {
    let place = Place::new();
    let said = place.reported(&["tiny.toml", "--repeat", "1"]);
    assert!(said.contains("report.html") && said.contains("tiny: "), "{said}");
    let metrics = ["feature-rmse", "max", "mean", "over-one", "p99", "rmse"];
    let plots = metrics.iter().flat_map(|m| [format!("tiny-{m}-techniques.svg"), format!("tiny-{m}.svg")]);
    let pages = ["report.csv", "report.html", "report.json"].map(String::from);
    let expected: Vec<String> = pages.into_iter().chain(plots).collect();
    assert_eq!(place.names("report"), expected);

    let runs = runs(&place.text("report/report.json"));
    let of = |name: &str| runs.iter().filter(|run| run["technique"] == name).count();
    assert_eq!((of("truth"), of("supersampling")), (3, 7), "the truth at its own and two narrower widths");
    assert_eq!(of(Kind::DynamicLine.name()), 0, "no width is in pixels");
    for kind in Kind::ALL.into_iter().filter(|kind| *kind != Kind::DynamicLine) {
        // The scene's own settings are on a line, and in one row.
        let tried = sweep::variations(&kind.declaration().sweep).len();
        assert!(of(kind.name()) + 1 >= tried, "{} of {tried}", of(kind.name()));
        let own = runs.iter().filter(|run| run["technique"] == kind.name() && run["is_own"] == true);
        assert_eq!(own.count(), 1);
    }
    assert_eq!(place.rows("report/report.csv").len(), runs.len());
}

#[test]
fn a_scene_without_features_in_view_says_so_and_scores_nothing() {
    let place = Place::new();
    let off = SCENE.replace(
        "eye = [0, -1800, 1500], target = [0, 0, 100]",
        "eye = [850, -850, 600], target = [850, -849, 0]",
    );
    fs::write(place.path().join("off.toml"), off).unwrap();
    let said = place.reported(&["off.toml", "--repeat", "1"]);
    assert!(said.contains("tiny: no feature of a layer is in view"), "{said}");
    assert_eq!(place.names("report"), ["report.csv", "report.html", "report.json"]);
    let value: Value = serde_json::from_str(&place.text("report/report.json")).unwrap();
    let scene = &value["scenes"][0];
    assert_eq!((scene["runs"].as_array().unwrap().len(), &scene["feature_pixels"]), (0, &0.into()));
    let page = place.text("report/report.html");
    assert!(
        page.contains("no feature of a layer is in view")
            && page.contains("data:image/png")
            && !page.contains("<svg")
    );
}

#[test]
fn a_scene_without_layers_scores_nothing_either() {
    let place = Place::new();
    fs::write(place.path().join("bare.toml"), SCENE.split("[[layer]]").next().unwrap()).unwrap();
    let said = place.reported(&["bare.toml", "--repeat", "1"]);
    assert!(said.contains("tiny: no feature of a layer is in view"), "{said}");
}

#[test]
fn errors_on_features_are_of_the_pixels_that_they_touch() {
    let place = Place::new();
    // A hillshade of many small triangles: its aliasing is in all pixels, the road in few.
    let scene = SCENE.replace("height_m = 200.0 }", "height_m = 200.0 }\nterrain.shade = \"hillshade\"");
    let scene = scene.split("[[layer]]\nname = \"lake\"").next().unwrap().to_owned()
        + "[[layer]]\nname = \"road\"\n"
        + scene.split("name = \"road\"\n").nth(1).unwrap();
    fs::write(place.path().join("road.toml"), scene).unwrap();
    place.reported(&["road.toml", "--repeat", "1", "--truth-width", "0.01"]);
    let value: Value = serde_json::from_str(&place.text("report/report.json")).unwrap();
    let scene = &value["scenes"][0];
    let count = scene["feature_pixels"].as_u64().unwrap();
    assert!((20..300).contains(&count), "{count} of 1536 pixels");
    for run in scene["runs"].as_array().unwrap().iter().filter(|run| run["is_own"] == true) {
        let [whole, touched] = ["error", "error_on_features"].map(|key| run[key]["mean"].as_f64().unwrap());
        // The mean over all has the touched pixels in it.
        assert!(
            touched > whole && touched * count as f64 <= whole * 1536.0,
            "{}: {whole} {touched}",
            run["technique"]
        );
    }
    let row = &place.rows("report/report.csv")[0];
    assert!(row.iter().any(|(head, cell)| head == "feature_pixels" && *cell == count.to_string()), "{row:?}");
}

#[test]
fn everything_but_times_is_the_same_in_every_run() {
    let place = Place::new();
    place.reported(&["tiny.toml", "--repeat", "1", "-o", "a", "--threads", "1"]);
    place.reported(&["tiny.toml", "--repeat", "2", "-o", "b", "--threads", "2"]);
    let timeless = |name: &str| {
        let mut rows = place.rows(name);
        rows.iter_mut().for_each(|row| row.retain(|(head, _)| !OF_TIME.contains(&head.as_str())));
        rows
    };
    assert_eq!(timeless("a/report.csv"), timeless("b/report.csv"));
    let timeless = |name: &str| {
        let mut runs = runs(&place.text(name));
        for run in &mut runs {
            OF_TIME.iter().for_each(|key| drop(run.as_object_mut().unwrap().remove(*key)));
        }
        runs
    };
    assert_eq!(timeless("a/report.json"), timeless("b/report.json"));
}

#[test]
fn more_samples_are_nearer_to_the_truth_and_the_best_is_on_the_front() {
    let place = Place::new();
    place.reported(&["tiny.toml", "--repeat", "1"]);
    let runs = runs(&place.text("report/report.json"));
    let rmse = |run: &Value| run["error"]["rmse"].as_f64().unwrap();
    let errors: Vec<f64> = runs.iter().filter(|r| r["technique"] == "supersampling").map(rmse).collect();
    assert!(errors[0] > 4.0 * errors[2] && errors[2] > 4.0 * errors[4], "{errors:?}");
    // Of several that are as right (narrow truths of a simple scene) the fastest is on the front.
    let best = runs.iter().map(rmse).fold(f64::INFINITY, drapery::math::min);
    assert!(runs.iter().any(|run| rmse(run) == best && run["on_front"] == true));
}

#[test]
fn the_page_needs_no_network_and_knows_no_machine() {
    let place = Place::new();
    place.reported(&["tiny.toml", "--repeat", "1", "--set", "name=\"a <b> & c\""]);
    let folder = place.path().to_string_lossy().into_owned();
    for name in place.names("report") {
        let text = place.text(&format!("report/{name}"));
        let rest = text.replace("http://www.w3.org/2000/svg", "");
        assert!(!rest.contains("http") && !rest.contains("//fonts"), "{name}");
        assert!(!text.contains(&folder), "{name} names the folder it was made in");
    }
    let page = place.text("report/report.html");
    assert!(page.contains("a &lt;b&gt; &amp; c") && !page.contains("a <b>"));
    assert!(page.contains("data:image/png;base64,iVBOR"));
    assert!(!page.contains("src=\"/") && !page.contains("<link"));
}

#[test]
fn a_setting_of_the_scene_is_the_one_that_is_marked() {
    let place = Place::new();
    let set = "technique.inverse-projection.samples=5";
    place.reported(&["tiny.toml", "--repeat", "1", "--set", set, "--truth-width", "0.1"]);
    let runs = runs(&place.text("report/report.json"));
    let own: Vec<&Value> =
        runs.iter().filter(|r| r["technique"] == "inverse-projection" && r["is_own"] == true).collect();
    assert_eq!(own.len(), 1);
    assert_eq!(
        (&own[0]["parameters"]["samples"], &own[0]["device"]["precision"]),
        (&5.into(), &"f64".into())
    );
    let alone = |r: &&Value| r["varied"][0] == "point_in_polygon=winding";
    assert_eq!(runs.iter().find(alone).unwrap()["parameters"]["samples"], 5);
}

#[test]
fn two_scenes_are_one_report() {
    let place = Place::new();
    fs::write(place.path().join("other.toml"), SCENE.replace("\"tiny\"", "\"other\"")).unwrap();
    place.reported(&["tiny.toml", "other.toml", "--repeat", "1", "--truth-width", "0.5"]);
    let value: Value = serde_json::from_str(&place.text("report/report.json")).unwrap();
    let names: Vec<&str> =
        value["scenes"].as_array().unwrap().iter().map(|s| s["scene"]["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["tiny", "other"]);
    assert!(place.names("report").contains(&"other-rmse.svg".to_owned()));
    let page = place.text("report/report.html");
    assert!(page.contains("<h2>tiny</h2>") && page.contains("<h2>other</h2>"));
}

#[test]
fn a_scene_that_cannot_be_loaded_is_refused_and_nothing_is_written() {
    let place = Place::new();
    fs::write(place.path().join("bad.toml"), SCENE.replace("width_m", "widht_m")).unwrap();
    let said = place.refused(&["tiny.toml", "bad.toml"]);
    assert!(said.contains("bad.toml") && said.contains("widht_m"), "{said}");
    let said = place.refused(&["missing.toml"]);
    assert!(said.contains("missing.toml"), "{said}");
    let said = place.refused(&["tiny.toml", "--set", "terrain={ source = \"missing.tif\" }"]);
    assert!(said.contains("missing.tif"), "{said}");
    let said = place.refused(&["tiny.toml", "--truth-width", "7"]);
    assert!(said.contains("width"), "{said}");
}

#[test]
fn the_papers_tables_have_a_row_for_each_solution_and_compare_memory_with_the_first() {
    let place = Place::new();
    let told = place.reported(&["--tables", "tiny.toml", "--repeat", "1", "-o", "tables"]);
    assert!(told.contains("tiny: 1 segments"), "{told}");
    assert_eq!(place.names("tables"), ["tables.csv", "tables.html", "tables.json"]);
    let tables: Value = serde_json::from_str(&place.text("tables/tables.json")).unwrap();
    let set = &tables["data_sets"][0];
    assert_eq!((&set["features"], &set["segments"], &set["vertices"]), (&1.into(), &1.into(), &2.into()));
    let bytes = |solution: &str| {
        let rows = set["solutions"].as_array().unwrap();
        rows.iter().find(|row| row["solution"] == solution).unwrap()["geometry_bytes"].as_u64().unwrap()
    };
    // Fig. 10: both versions take most, polygons as wireframe as much as polygons, adjacency hardly more than lines.
    assert!(bytes("3a-both") > bytes("3b-wireframe") && bytes("3b-wireframe") > bytes("4a-adjacency"));
    assert!(bytes("4a-adjacency") >= bytes("1-lines"));
    assert_eq!(set["width_changes"].as_array().unwrap().len(), 3);
    assert!(place.text("tables/tables.html").contains("Fig. 10"));
}

#[test]
fn zechmeisters_tables_measure_each_part_of_a_scene_and_tell_trends() {
    let place = Place::new();
    let small =
        ["--set", "image.width=12", "--set", "image.height=8", "--set", "technique.static-decal.grid=4"];
    let arguments =
        [&["--tables=zechmeister", "tiny.toml", "--repeat", "1", "-o", "tables"][..], &small].concat();
    let told = place.reported(&arguments);
    assert!(told.contains("Quad-tree depth"), "{told}");
    assert_eq!(place.names("tables"), ["tables.csv", "tables.html", "tables.json"]);
    let tables: Value = serde_json::from_str(&place.text("tables/tables.json")).unwrap();
    assert_eq!((&tables["schema"], &tables["paper"]), (&1.into(), &"zechmeister".into()));
    let set = &tables["data_sets"][0];
    assert_eq!(
        (&set["amounts"]["exterior"]["vertices"], &set["amounts"]["lines"]["decals"]),
        (&4.into(), &1.into())
    );
    assert_eq!(
        (&set["groups"]["areas"], &set["groups"]["lines"], &set["thesis"]),
        (&1.into(), &1.into(), &Value::Null)
    );
    let rows = set["rows"].as_array().unwrap();
    let of = |figure: &str, decals: &str| {
        let is = |row: &&Value| row["figure"] == figure && row["decals"] == decals;
        rows.iter().filter(is).cloned().collect::<Vec<Value>>()
    };
    for (figure, decals, count) in [
        ("5.5", "stencil volumes", 1),
        ("5.6", "exterior polygons", 1),
        ("5.8", "dynamic lines", 30),
        ("5.10", "static decals", 3),
        ("5.13", "polygons", 4),
        ("5.14", "static lines", 9),
        ("5.15", "dynamic lines", 12),
        ("5.17", "dynamic lines", 4),
    ] {
        assert_eq!(of(figure, decals).len(), count, "{figure} {decals}");
    }
    // Wider dynamic lines are in more lists, and those are memory (Fig. 5.15a).
    let bytes = |width: f64| {
        let wide = of("5.15", "dynamic lines").into_iter().find(|row| row["factors"]["width"] == width);
        wide.unwrap()["memory_bytes"].as_u64().unwrap()
    };
    assert!(bytes(16.0) > bytes(1.0));
    assert_eq!(tables["trends"].as_array().unwrap().len(), 15);
    assert_eq!(place.text("tables/tables.csv").lines().count(), 1 + rows.len());
    assert!(place.text("tables/tables.html").contains("Two slips"));
}

/// Lines over a terrain with levels of detail.
const BORDERS: &str = r##"
schema = 1
name = "borders"
image = { width = 24, height = 16 }
camera = { eye = [0, -1800, 1500], target = [0, 0, 100] }
terrain = { generate = { kind = "fbm", seed = 3, posts = [140, 131], cell_m = 12.0, height_m = 200.0 }, diagonal = "alternating", lod = { error_px = 1.0 } }
[[layer]]
features = [{ line = [[-700, -500], [20, 31], [700, 300]] }, { polygon = [[-300, -400], [300, -400], [300, 200]] }]
line = { color = "#ff7f00", width_px = 1 }
outline = { color = "#ff7f00", width_px = 1 }
"##;

#[test]
fn wartells_tables_have_the_papers_table_storage_and_sweeps() {
    let place = Place::new();
    fs::write(place.path().join("borders.toml"), BORDERS).unwrap();
    let told = place.reported(&["--tables=wartell", "borders.toml", "--repeat", "1", "-o", "tables"]);
    assert!(told.contains("borders: 2 polylines, 7 points"), "{told}");
    assert_eq!(place.names("tables"), ["tables.csv", "tables.html", "tables.json"]);
    let tables: Value = serde_json::from_str(&place.text("tables/tables.json")).unwrap();
    assert_eq!((&tables["schema"], &tables["paper"]), (&1.into(), &"wartell".into()));
    let set = &tables["data_sets"][0];
    assert_eq!((&set["posts"], &set["points"]), (&serde_json::json!([140, 131]), &7.into()));
    assert_eq!(set["storage"]["covering_triangles"], 15);
    let varied =
        |name: &str| set["rows"].as_array().unwrap().iter().filter(|row| row["varied"] == name).count();
    let counts = ["polylines", "error_px", "borrow", "offset", "tolerance_px"].map(varied);
    assert_eq!(counts, [2, 5, 5, 7, 5]);
    assert_eq!(place.text("tables/tables.csv").lines().count(), 1 + counts.iter().sum::<usize>());
    assert!(place.text("tables/tables.html").contains("Storage (3.3)"));
}

#[test]
fn wartells_tables_of_a_scene_without_levels_are_refused() {
    let place = Place::new();
    let told = place.refused(&["--tables=wartell", "tiny.toml", "-o", "tables"]);
    assert!(told.contains("no level-of-detail mesh") && told.contains("terrain.lod"), "{told}");
    assert!(!place.path().join("tables").exists());
}

#[test]
fn a_paper_that_has_no_tables_is_refused() {
    let told = Place::new().refused(&["--tables=schneider-klein", "tiny.toml"]);
    assert!(told.contains("taibo, zechmeister, wartell, she"), "{told}");
}

#[test]
fn a_paper_after_a_space_is_told_from_a_scene() {
    let told = Place::new().refused(&["--tables", "she"]);
    assert!(told.contains("say --tables=she"), "{told}");
}

#[test]
fn tables_of_a_scene_without_lines_are_refused() {
    let place = Place::new();
    let areas = SCENE.split("[[layer]]\nname = \"road\"").next().unwrap();
    fs::write(place.path().join("areas.toml"), areas).unwrap();
    let told = place.refused(&["--tables", "areas.toml", "-o", "tables"]);
    assert!(told.contains("there are no lines and no outlines"), "{told}");
    assert!(!place.path().join("tables").exists());
}
