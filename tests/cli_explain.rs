//! `drapery explain` as a user or a script calls it.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "helpers of tests are no tests to the lint")]

use std::process::{Command, Output, Stdio};

const SCENE: &str = "schema = 1\nimage = { width = 24, height = 16 }\nterrain = { generate = { kind = \"plane\", posts = [9, 9], cell_m = 50.0 } }\n\
    camera = { eye = [0, 0, 500], target = [0, 0, 0], up = [0, 1, 0], projection = \"orthographic\", height_m = 160.0 }\n\
    layer = [{ name = \"field\", features = [{ polygon = [[-90, -90], [3, -90], [3, 90], [-90, 90]] }], fill = { color = \"#000000\" } }]\n";

/// Calls the program in a folder that has the scene.
fn call(folder: &tempfile::TempDir, arguments: &[&str]) -> Output {
    std::fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_drapery"));
    let command = command.args(arguments).current_dir(folder.path()).stdin(Stdio::null());
    command.env_remove("NO_COLOR").env_remove("CLICOLOR_FORCE").output().unwrap()
}

#[test]
fn a_pixel_is_told_as_text_as_json_and_as_a_page() {
    let folder = tempfile::tempdir().unwrap();
    let told = |arguments: &[&str]| {
        let output = call(
            &folder,
            &[&["explain", "scene.toml", "--pixel", "12,7", "-t", "static-decal"], arguments].concat(),
        );
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap()
    };
    let text = told(&["--html", "why.html"]);
    assert!(text.starts_with("pixel 12,7\n") && text.contains("field 0 (fill) covers 30.00 %"), "{text}");
    assert!(std::fs::read_to_string(folder.path().join("why.html")).unwrap().starts_with("<!DOCTYPE html>"));
    let json: serde_json::Value = serde_json::from_str(&told(&["--json", "-"])).unwrap();
    assert_eq!((&json["schema"], &json["kind"]), (&1.into(), &"explanation".into()));
    assert_eq!(json["techniques"][0]["technique"], "static-decal");
    assert!(told(&["--html", "-"]).starts_with("<!DOCTYPE html>"), "and nothing else is on stdout");
    assert!((json["covering"][0]["low"].as_f64().unwrap() - 0.3).abs() < 1e-9, "{json}");
}

#[test]
fn calls_that_ask_for_nothing_that_can_be_told_exit_with_2() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |arguments: &[&str]| {
        let output = call(&folder, &[&["explain", "scene.toml"], arguments].concat());
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(output.stdout.is_empty());
        said
    };
    assert!(refused(&[]).contains("--pixel"));
    assert!(refused(&["--pixel", "12"]).contains("a pixel is its column and its row, such as 640,420"));
    assert!(refused(&["--pixel", "-1,3"]).contains("from 0 at the upper left"));
    assert!(refused(&["--html", "why.html", "--feature", "field"]).contains("--pixel"));
    assert!(refused(&["--pixel", "24,7"]).contains("there is no pixel 24,7 in a picture of 24 x 16"));
    assert!(refused(&["--pixel", "1,7", "-t", "dynamic-line"]).contains("width in pixels"));
    assert!(
        refused(&["--pixel", "1,7", "--feature", "feild", "--html", "why.html"])
            .contains("did you mean `field`?")
    );
    assert!(refused(&["--pixel", "1,7", "--html", "one", "--json", "one"]).contains("name the same file"));
    assert!(refused(&["--pixel", "1,7", "--html", "gone/why.html"]).contains("its folder is not there"));
    assert!(!folder.path().join("why.html").exists());
}
