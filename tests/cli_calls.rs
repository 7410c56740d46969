//! The command line as a user or a script calls it: what goes where, and the exit status.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "helpers of tests are no tests to the lint")]

use std::io::Write;
use std::process::{Command, Output, Stdio};

fn drapery(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_drapery"));
    command.args(arguments).env_remove("NO_COLOR").env_remove("CLICOLOR_FORCE").stdin(Stdio::null());
    command
}

fn call(arguments: &[&str]) -> Output {
    drapery(arguments).output().unwrap()
}

/// What a failing call says on stderr; its stdout is empty.
fn refused(output: Output, status: i32) -> String {
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(status), "{said}");
    assert!(output.stdout.is_empty(), "data and a refusal together");
    said
}

fn done(output: Output) -> String {
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(output.stderr.is_empty());
    String::from_utf8(output.stdout).unwrap()
}

/// A call that reads `text` on stdin.
fn piped(arguments: &[&str], text: &[u8]) -> Output {
    let mut command = drapery(arguments);
    let mut child =
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(text).unwrap();
    child.wait_with_output().unwrap()
}

#[test]
fn version_and_help_go_to_stdout() {
    assert!(done(call(&["--version"])).starts_with("drapery 0."));
    let long = done(call(&["--help"]));
    assert!(long.contains("Examples:") && long.contains("drapery new dem.tif"), "{long}");
    assert!(done(call(&["render", "--help"])).contains("--set layer.roads.line.width_m=20"));
    assert!(done(call(&["-h"])).len() < long.len());
}

#[test]
fn a_wrong_call_exits_with_2_and_a_hint() {
    let said = refused(call(&["rendr"]), 2);
    assert!(said.contains("render"), "{said}");
    refused(call(&["render", "--nonsense"]), 2);
    refused(call(&["render", "--repeat", "0"]), 2);
    refused(call(&["completions", "no-shell"]), 2);
    refused(call(&[]), 2);
}

#[test]
fn the_schema_is_json_that_names_the_keys() {
    let schema: serde_json::Value = serde_json::from_str(&done(call(&["schema"]))).unwrap();
    assert_eq!(schema["properties"]["schema"]["minimum"], 1);
    let line = &schema["properties"]["layer"]["items"]["properties"]["line"];
    assert_eq!(line["properties"]["cap"]["enum"], serde_json::json!(["butt", "square", "round"]));
    assert_eq!(schema["additionalProperties"], false);
}

#[test]
fn every_shell_gets_completions() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        assert!(done(call(&["completions", shell])).contains("drapery"), "{shell}");
    }
}

#[test]
fn a_pipe_that_nobody_reads_is_a_quiet_end() {
    for arguments in [&["schema"][..], &["completions", "bash"], &["--help"]] {
        let mut command = drapery(arguments);
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(0));
        assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
    }
}

#[test]
fn a_wrong_scene_is_shown_with_its_line_and_a_caret() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), "schema = 1\n[image]\nwidht = 3\n").unwrap();
    let said = refused(drapery(&["render", "s.toml"]).current_dir(folder.path()).output().unwrap(), 2);
    assert_eq!(
        said,
        "error: s.toml:3:1: there is no key `image.widht`\n3 | widht = 3\n  | ^^^^^\nhelp: did you mean `width`?\n"
    );
}

#[test]
fn a_scene_on_stdin_is_shown_in_the_same_way() {
    let said = refused(piped(&["render", "-"], b"schema = 1\nlayer = 5"), 2);
    assert!(
        said.starts_with("error: <stdin>:2:9: `layer` must be an array of tables; found 5\n2 | layer = 5\n"),
        "{said}"
    );
    let said = refused(piped(&["render", "-"], b"schema = 1\n\xff\xfe"), 2);
    assert!(said.contains("<stdin>:2:1: a scene file is UTF-8 text"), "{said}");
}

#[test]
fn what_is_no_scene_file_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    for wrong in [path, "no/such/scene.toml"] {
        let said = refused(call(&["render", wrong]), 2);
        assert!(said.starts_with(&format!("error: {wrong}: this scene file cannot be read")), "{said}");
    }
}

#[test]
fn an_override_is_blamed_by_its_own_text() {
    let said = refused(call(&["render", "--set", "image.width=0"]), 2);
    assert!(said.starts_with("error: override `image.width=0`: `image.width` must be"), "{said}");
    let said = refused(call(&["render", "--set", "image"]), 2);
    assert!(said.contains("there is no `=`") && said.contains("help: write path=value"), "{said}");
}

#[test]
fn colours_come_only_where_they_are_wanted() {
    let escape = '\x1b';
    let arguments = ["render", "no.toml"];
    assert!(!refused(call(&arguments), 2).contains(escape), "a pipe is no terminal");
    assert!(refused(call(&["--color", "always", "render", "no.toml"]), 2).contains(escape));
    assert!(refused(call(&["--color=always", "render", "--nonsense"]), 2).contains(escape));
    let forced = drapery(&arguments).env("CLICOLOR_FORCE", "1").env("NO_COLOR", "1").output().unwrap();
    assert!(!refused(forced, 2).contains(escape), "NO_COLOR is honoured");
}

/// A folder with a small terrain and a road in another file.
fn valley() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write(
        "dem.asc",
        "ncols 3\nnrows 2\nxllcenter 9\nyllcenter 46\ncellsize 0.01\nNODATA_value -9999\n1 2 3\n4 5 -9999\n",
    );
    write(
        "dem.prj",
        "GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433],AUTHORITY[\"EPSG\",\"4326\"]]",
    );
    write("road.geojson", r#"{"type":"LineString","coordinates":[[9.001,46.002],[9.012,46.007]]}"#);
    folder
}

fn called_in(folder: &tempfile::TempDir, arguments: &[&str]) -> Output {
    drapery(arguments).current_dir(folder.path()).output().unwrap()
}

#[test]
fn a_starter_scene_names_the_files_as_given_and_loads() {
    let folder = valley();
    let output = called_in(&folder, &["new", "dem.asc", "road.geojson"]);
    assert_eq!(output.status.code(), Some(0));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("source = \"dem.asc\"") && text.starts_with("# A scene for drapery."), "{text}");
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, &text).unwrap();
    let scene = drapery::scene_file::SceneFile::read(&path, &[]).unwrap();
    let (scene, _) = drapery::source::load::load(&scene, &|_| ()).unwrap();
    assert_eq!((scene.layers.len(), scene.layers[0].features.len()), (1, 1));
    assert!(done(called_in(&folder, &["info", "scene.toml"])).contains("layer       road (road.geojson)"));
}

#[test]
fn a_starter_scene_goes_where_it_is_told_with_its_notes_on_stderr() {
    let folder = valley();
    let output = called_in(&folder, &["new", "road.geojson", "dem.asc", "-o", "scene.toml"]);
    let said = String::from_utf8(output.stderr.clone()).unwrap();
    assert!(output.status.success() && output.stdout.is_empty(), "{said}");
    assert!(said.contains("scene.toml: a scene; next: drapery render scene.toml"), "{said}");
    drapery::open(folder.path().join("scene.toml")).unwrap();
    let said = refused(called_in(&folder, &["new", "dem.asc", "-o", "dem.asc"]), 2);
    assert!(said.contains("would be written over a file that it is to show"), "{said}");
}

#[test]
fn points_that_span_no_triangle_are_refused_with_their_file() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("p.xyz"), "0 0 1\n1 1 2\n2 2 3\n").unwrap();
    std::fs::write(folder.path().join("s.toml"), "schema = 1\nterrain = { source = \"p.xyz\" }\n").unwrap();
    let said = refused(called_in(&folder, &["render", "s.toml"]), 2);
    assert!(said.contains("p.xyz: the points span no triangle") && said.contains("s.toml:2:"), "{said}");
}

#[test]
fn info_says_what_a_terrain_holds_in_aligned_lines() {
    let folder = valley();
    let text = done(called_in(&folder, &["info", "dem.asc"]));
    for line in [
        "dem.asc: terrain, Esri ASCII grid",
        "  posts       3 x 2 (6)",
        "  heights     1 to 5",
        "  no data     -9999; 1 post (16.7 %) without data",
    ] {
        assert!(text.lines().any(|l| l == line), "{line}: {text}");
    }
    let text = done(called_in(&folder, &["info", "road.geojson"]));
    assert!(text.contains("  features    1 (1 line)\n  parts       1\n  vertices    2\n"), "{text}");
}

#[test]
fn info_says_of_a_crs_that_is_stated_and_cannot_be_used_why() {
    let folder = valley();
    let road = std::fs::read_to_string(folder.path().join("road.geojson")).unwrap();
    let odd = road.replacen('{', r#"{"crs":{"type":"name","properties":{"name":"EPSG:6200"}},"#, 1);
    std::fs::write(folder.path().join("odd.geojson"), odd).unwrap();
    let projected = r#"PROJCS["x",GEOGCS["y",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]]],PROJECTION["Barsoom"]]"#;
    std::fs::write(folder.path().join("dem.prj"), projected).unwrap();
    for (file, why) in [("odd.geojson", "EPSG:6200"), ("dem.asc", "'Barsoom'")] {
        let text = done(called_in(&folder, &["info", file]));
        let row = text.lines().find(|line| line.starts_with("  CRS ")).unwrap();
        assert!(
            row.contains("cannot be used") && row.contains(why) && row.contains("say in the scene"),
            "{text}"
        );
        assert!(!text.contains("not stated"), "{text}");
    }
}

#[test]
fn info_on_what_is_no_data_file_exits_with_2() {
    let folder = valley();
    let said = refused(called_in(&folder, &["info", "dom.asc"]), 2);
    assert!(said.starts_with("error: dom.asc: this file cannot be read"), "{said}");
    let said = refused(called_in(&folder, &["info", "dem.prj"]), 2);
    assert!(said.contains("name the .shp beside it"), "{said}");
}

#[test]
fn a_starter_scene_for_files_that_are_not_there_is_refused() {
    let said = refused(call(&["new", "no-dem.tif"]), 2);
    assert!(said.starts_with("error: no-dem.tif: this file cannot be read"), "{said}");
}
