//! `drapery reduce`: the smallest scene that a program still draws wrong. The program is this one, with a scene changed behind its back.
#![cfg(all(feature = "cli", unix))]
#![allow(clippy::unwrap_used, reason = "helpers of tests are no tests to the lint")]

use drapery::scene_file::{LayerSource, SceneFile};
use std::path::Path;
use std::process::{Command, Output};

const DRAPERY: &str = env!("CARGO_BIN_EXE_drapery");

/// Two lakes, a wood and three roads over a slope.
const SCENE: &str = r##"schema = 1
image = { width = 56, height = 40, background = "#ffffff" }
camera = { eye = [0, -300, 260], target = [0, 0, 20] }
terrain = { generate = { kind = "ramp", slope_deg = 5.0, posts = [9, 9], cell_m = 50.0, height_m = 0.0 }, color = "#eeeeee" }
device = { subpixel_bits = 8 }
[[layer]]
name = "lakes"
features = [{ polygon = [[-150, -120], [-60, -130], [-50, -40], [-140, -30]] }, { polygon = [[60, 40], [150, 30], [140, 120], [70, 130]] }]
fill = { color = "#3388ff", opacity = 0.6 }
[[layer]]
name = "roads"
features = [{ line = [[-180, -150], [-60, 40], [20, -20], [180, 150]] }, { line = [[-180, 150], [180, 100]] }, { line = [[40, -180], [100, 180]] }]
line = { color = "#ff7f00", width_m = 14.0 }
[[layer]]
name = "woods"
features = [{ polygon = [[20, -140], [120, -150], [130, -60], [30, -50]] }]
fill = { color = "#225522" }
"##;

/// A program that draws a bundle's scene with a change.
fn client(change: &str) -> String {
    format!("'{DRAPERY}' render {{}}/scene.inline.toml -t stencil-volume --set '{change}' -o {{out}}")
}

fn reduce(folder: &Path, with: &str, more: &[&str]) -> Output {
    std::fs::write(folder.join("scene.toml"), SCENE).unwrap();
    let mut command = Command::new(DRAPERY);
    command.current_dir(folder).args(["reduce", "scene.toml", "-t", "stencil-volume", "--with", with]);
    command.args(more).output().unwrap()
}

#[test]
fn what_is_left_is_the_feature_that_is_drawn_wrong() {
    let folder = tempfile::tempdir().unwrap();
    let output = reduce(folder.path(), &client("layer.roads.line.width_m=17"), &["--tries", "90"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{said}");
    let left = SceneFile::read(&folder.path().join("reduced.toml"), &[]).unwrap();
    let [roads] = &left.layers[..] else { panic!("{} layers", left.layers.len()) };
    let LayerSource::Inline(features) = &roads.source else { panic!("{:?}", roads.source) };
    assert_eq!((roads.name.as_str(), features.len()), ("roads", 1));
    assert!(features[0].shape.parts().map(Vec::len).sum::<usize>() <= 3);
    assert!(left.image.width <= 32 && left.image.height <= 32, "{:?}", left.image);
}

#[test]
fn a_right_program_leaves_nothing_to_reduce() {
    let folder = tempfile::tempdir().unwrap();
    let output = reduce(folder.path(), &client("device.precision=f32"), &[]);
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stdout).contains("nothing to reduce"));
    assert!(!folder.path().join("reduced.toml").exists());
}

#[test]
fn a_program_that_fails_hangs_or_draws_nothing_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let said = |with: &str, more: &[&str]| {
        let output = reduce(folder.path(), with, more);
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{said}");
        said
    };
    let failed = said("echo no such device >&2; false", &[]);
    assert!(failed.contains("no such device") && failed.contains("status: 1"), "{failed}");
    let hangs = said("sleep 600; true", &["--timeout", "0.3"]);
    assert!(hangs.contains("did not end in 0.3 s") && hangs.contains("--timeout"), "{hangs}");
    let nothing = said("true", &[]);
    assert!(nothing.contains("stencil-volume.png"), "{nothing}");
}

#[test]
fn a_scene_file_needs_a_technique_and_a_bundle_its_scene() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
    std::fs::create_dir(folder.path().join("bundle")).unwrap();
    let call = |input: &str| {
        let mut command = Command::new(DRAPERY);
        let output =
            command.current_dir(folder.path()).args(["reduce", input, "--with", "true"]).output().unwrap();
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    let (status, said) = call("scene.toml");
    assert!(status == Some(2) && said.contains("-t clipmap"), "{said}");
    let (status, said) = call("bundle");
    assert!(status == Some(2) && said.contains("scene.inline.toml"), "{said}");
}
