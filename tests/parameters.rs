//! What is declared of techniques, parameters and buffers holds wherever it is used: the scene file, its schema, `result.json`, frames,
//! the contract.
#![cfg(feature = "cli")]

mod drawing;

use drapery::output::{Npy, look};
use drapery::parameter::{Key, Shape, Value};
use drapery::scene::TechniqueSettings;
use drapery::scene_file::{Override, SceneFile, schema};
use drapery::technique::Kind;
use drawing::{frame_of, kinds_for, scene, stage};
use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

const TERRAIN: &str = "kind = \"cone\", posts = [17, 17], cell_m = 20, height_m = 60";
const CAMERA: &str = "eye = [0, -300, 200], target = [0, 0, 20]";
const LINES: &str = "[[layer]]\nfeatures = [{ line = [[-150, -90], [0, 20], [140, 60]] }]\nline = { color = \"#ff8000\", width_px = 3 }\n";
const LAYERS: &str = "[[layer]]\nfeatures = [{ polygon = [[-90, -60], [80, -70], [10, 90]] }, { line = [[-150, -90], [0, 20], [140, 60]] }]\n\
     fill = { color = \"#208040\" }\nline = { color = \"#ff8000\", width_m = 9 }\n";

/// Every parameter of every technique.
fn parameters() -> Vec<(Kind, &'static Key)> {
    let of = |kind: Kind| kind.declaration().parameters.table.keys.iter().map(move |key| (kind, key));
    Kind::ALL.into_iter().flat_map(of).collect()
}

/// Values of a shape, its extremes among them; numbers are large enough for a cache of tiles.
fn examples(shape: &Shape) -> Vec<Value> {
    match shape {
        Shape::Choice(names, _) => {
            assert_eq!(
                names().into_iter().collect::<BTreeSet<_>>().len(),
                names().len(),
                "a word is there twice"
            );
            names().into_iter().map(Value::Word).collect()
        }
        Shape::Integer(low, high) => [*low, (low + high) / 2, *high].map(Value::Integer).to_vec(),
        Shape::IntegerOf(numbers) => numbers.iter().copied().map(Value::Integer).collect(),
        Shape::Number(range) => {
            let numbers = [-7.25, 0.0, 1.0, 1.1, 2.0 / 3.0 + 1.0, 15.5, 64.0, 1e300];
            numbers.into_iter().filter(|n| range.contains(*n)).map(Value::Number).collect()
        }
        Shape::Numbers(count) => vec![Value::Numbers(vec![-12.5; *count]), Value::Numbers(vec![3.0; *count])],
        Shape::Or(word, inner) => [vec![Value::Word(word)], examples(inner)].concat(),
        other => panic!("no technique has a parameter of the shape {other:?} yet: say its examples here"),
    }
}

fn set(kind: Kind, key: &Key, value: &Value) -> SceneFile {
    let change = format!("technique.{}.{}={value}", kind.name(), key.name);
    let change = Override::parse(&change).unwrap();
    SceneFile::parse(&scene(TERRAIN, CAMERA, ""), None, &[change]).unwrap_or_else(|error| panic!("{error}"))
}

fn said(kind: Kind, key: &Key, settings: &TechniqueSettings) -> Value {
    let mut values = kind.parameters(settings).into_iter();
    values.find(|(name, _)| *name == key.name).unwrap().1
}

#[test]
fn every_parameter_has_a_default_a_text_and_a_section() {
    for (kind, key) in parameters() {
        let name = format!("{}.{}", kind.name(), key.name);
        let default = key.default.map(|default| default());
        assert_eq!(default, Some(said(kind, key, &TechniqueSettings::default())), "{name}");
        assert!(key.doc.ends_with('.') && !key.doc.contains("  "), "{name}: {}", key.doc);
        assert!(key.section.is_some_and(|section| !section.is_empty()), "{name}");
        assert!(!key.required, "{name}");
    }
}

#[test]
fn what_is_said_of_a_parameter_is_what_set_understands() {
    for (kind, key) in parameters() {
        for value in examples(&key.shape).iter().chain(&key.default.map(|default| default())) {
            let settings = set(kind, key, value).technique;
            assert_eq!(said(kind, key, &settings), *value, "technique.{}.{}", kind.name(), key.name);
            let others = kind.parameters(&settings).into_iter().filter(|(name, _)| *name != key.name);
            let defaults = kind.parameters(&TechniqueSettings::default());
            assert!(others.into_iter().all(|other| defaults.contains(&other)), "{}", key.name);
        }
    }
}

#[test]
fn a_default_that_is_said_is_the_same_setting() {
    for (kind, key) in parameters() {
        let default = key.default.map(|default| default()).unwrap();
        assert_eq!(set(kind, key, &default).technique, TechniqueSettings::default(), "{}", key.name);
    }
}

#[test]
fn the_schema_has_every_parameter_with_its_text_section_and_default() {
    let schema = schema();
    let tables = &schema["properties"]["technique"]["properties"];
    for (kind, key) in parameters() {
        let described = &tables[kind.name()]["properties"][key.name]["description"];
        let (section, default) = (key.section.unwrap(), key.default.map(|default| default()).unwrap());
        assert_eq!(*described, format!("{} {section}. Default: {default}.", key.doc), "{}", key.name);
    }
}

/// Calls the program in a folder; its `result.json`.
fn render(folder: &Path, changes: &[String]) -> serde_json::Value {
    let mut call = Command::new(env!("CARGO_BIN_EXE_drapery"));
    call.args(["render", "scene.toml", "--truth-width", "0.1"]).current_dir(folder);
    call.args(changes.iter().flat_map(|change| ["--set", change]));
    let output = call.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&std::fs::read(folder.join("out/result.json")).unwrap()).unwrap()
}

#[test]
fn what_result_json_says_draws_the_same_picture_again() {
    let in_metres = [
        "clipmap.virtual_size=1024",
        "clipmap.center=[12.5,-40]",
        "clipmap.clip_size=256",
        "clipmap.polygons=exact",
        "clipmap.level_bias=-0.25",
        "stencil-volume.samples=2",
        "stencil-volume.joins=style",
        "inverse-projection.corners=\"true\"",
        "inverse-projection.samples=2",
    ];
    let in_pixels =
        ["dynamic-line.l_max=17.5", "dynamic-line.antialiasing=analytic", "clipmap.level_bias=0.5"];
    let drawn = [check_drawn_again(LAYERS, &in_metres), check_drawn_again(LINES, &in_pixels)].concat();
    assert!(Kind::ALL.iter().all(|kind| drawn.contains(kind)), "{drawn:?}");
}

/// Whether a scene is drawn again by what its result says of its settings; returns who draws it.
fn check_drawn_again(layers: &str, own: &[&str]) -> Vec<Kind> {
    let folder = tempfile::tempdir().unwrap();
    let text = scene(TERRAIN, CAMERA, layers);
    std::fs::write(folder.path().join("scene.toml"), text).unwrap();
    let own_changes: Vec<String> = own.iter().map(|change| format!("technique.{change}")).collect();
    let first = render(folder.path(), &own_changes);
    let runs = first["runs"].as_array().unwrap().iter();
    let runs: Vec<_> = runs.filter(|run| run["technique"] != "truth").collect();
    let kinds: Vec<Kind> = kinds_for(&stage(&scene(TERRAIN, CAMERA, layers), &[]));
    assert_eq!(runs.len(), kinds.len());

    let mut changes = Vec::new();
    for (kind, run) in kinds.iter().zip(&runs) {
        assert_eq!(run["technique"], kind.name());
        let parameters = run["parameters"].as_object().unwrap();
        let declared = kind.declaration().parameters.table.keys.iter().map(|key| key.name);
        assert_eq!(
            parameters.keys().collect::<BTreeSet<_>>(),
            declared.map(str::to_owned).collect::<BTreeSet<_>>().iter().collect()
        );
        changes.extend(
            parameters.iter().map(|(name, value)| format!("technique.{}.{name}={value}", kind.name())),
        );
    }
    let again = render(folder.path(), &changes);
    for (before, after) in first["runs"].as_array().unwrap().iter().zip(again["runs"].as_array().unwrap()) {
        assert_eq!(before["parameters"], after["parameters"]);
        assert_eq!(before["image"], after["image"], "{}", before["technique"]);
    }
    let plain = render(folder.path(), &[]);
    for (run, plain) in runs.iter().zip(&plain["runs"].as_array().unwrap()[1..]) {
        let is_changed = own.iter().any(|change| run["technique"] == change.split('.').next().unwrap());
        assert_eq!(run["image"] != plain["image"], is_changed, "{}", run["technique"]);
    }
    kinds
}

#[test]
fn a_frame_has_the_planes_that_are_declared_and_each_looks_as_it_should() {
    let in_metres = stage(&scene(TERRAIN, CAMERA, LAYERS), &[]);
    let in_pixels = stage(&scene(TERRAIN, CAMERA, LINES), &[]);
    for kind in Kind::ALL {
        let stage = if kind == Kind::DynamicLine { &in_pixels } else { &in_metres };
        let planes = kind.declaration().planes;
        let names: Vec<&str> = planes.iter().map(|plane| plane.name).collect();
        let frame = frame_of(kind, stage, &names);
        let drawn: BTreeSet<&str> = frame.planes.iter().map(|plane| plane.name).collect();
        assert_eq!(drawn, names.iter().copied().collect(), "{}", kind.name());
        for declared in planes {
            let plane = frame.planes.iter().find(|plane| plane.name == declared.name).unwrap();
            let is_seen = look(Npy::new(plane).unwrap(), declared.look).is_some();
            let is_table = declared.look == drapery::buffer::Look::Table;
            assert_ne!(is_seen, is_table, "{} {}", kind.name(), declared.name);
        }
    }
}

#[test]
fn techniques_have_names_of_their_own() {
    let names = BTreeSet::from(Kind::ALL.map(Kind::name));
    assert_eq!(names.len(), Kind::ALL.len());
    assert!(!names.contains("truth"));
}

#[test]
fn the_contract_names_every_technique_parameter_and_buffer() {
    let contract = std::fs::read_to_string("docs/contract.md").unwrap();
    let readme = std::fs::read_to_string("README.md").unwrap();
    for kind in Kind::ALL {
        let heading = format!("[technique.{}]", kind.name());
        let table =
            contract.split(&heading).nth(1).and_then(|rest| rest.split("\n[").next()).unwrap_or_default();
        for key in kind.declaration().parameters.table.keys {
            let is_line = |line: &str| line.trim_start_matches("# ").starts_with(&format!("{} =", key.name));
            assert!(table.lines().any(is_line), "{heading} {}", key.name);
        }
        for plane in kind.declaration().planes {
            assert!(contract.contains(&format!("`{}`", plane.name)), "{}", plane.name);
        }
        assert!(readme.contains(&format!("`{}`", kind.name())), "{}", kind.name());
    }
}
