//! `drapery golden` as a user or a script calls it: what it says, what it writes, and the exit status.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "helpers of tests are no tests to the lint")]

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

const SCENE: &str = r##"
schema = 1
image = { width = 24, height = 20 }
camera = { eye = [0, -300, 200], target = [0, 0, 10] }
terrain.generate = { kind = "cone", posts = [9, 9], cell_m = 30.0, height_m = 60.0 }
[[layer]]
features = [{ line = [[-100, -80], [0, 0], [110, 40]] }]
line = { color = "#ff7f00", width_m = 20 }
"##;

/// The exit status and what a call says on stdout and stderr.
fn golden(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_drapery"));
    let output =
        command.arg("golden").args(arguments).current_dir(folder).stdin(Stdio::null()).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

fn goldens() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir_all(folder.path().join("golden/a")).unwrap();
    for name in ["one", "two", "three"] {
        fs::write(folder.path().join(format!("golden/a/{name}.toml")), SCENE).unwrap();
    }
    folder
}

#[test]
fn blessing_exits_with_1_when_it_changes_something_and_with_0_when_not() {
    let folder = goldens();
    assert_eq!(golden(folder.path(), &["check"]).0, 1, "nothing is blessed yet");
    let (status, said, _) = golden(folder.path(), &["bless"]);
    assert_eq!(status, 1);
    assert!(said.contains("added: a/one by inverse-projection\n"), "{said}");
    let (status, said, _) = golden(folder.path(), &["bless"]);
    assert_eq!((status, said.contains("nothing has changed: ")), (0, true), "{said}");
    let (status, said, _) = golden(folder.path(), &["check"]);
    assert_eq!((status, said.starts_with("PASS: ")), (0, true), "{said}");
}

#[test]
fn a_golden_that_differs_is_told_and_shown() {
    let folder = goldens();
    golden(folder.path(), &["bless"]);
    fs::write(folder.path().join("golden/a/two.toml"), SCENE.replace("width_m = 20", "width_m = 24"))
        .unwrap();
    let (status, said, _) = golden(folder.path(), &["check", "-o", "out"]);
    assert_eq!(status, 1);
    let first =
        "FAIL: a/two by inverse-projection: differs: the first buffer that differs is `class`; the picture: ";
    assert!(said.contains(first), "{said}");
    for what in ["actual", "heat"] {
        let path = folder.path().join(format!("out/a/two.inverse-projection.{what}.png"));
        assert_eq!(image::open(path).unwrap().into_rgba8().dimensions(), (24, 20));
    }
    assert_eq!(golden(folder.path(), &["check", "--only", "*o?e"]).0, 0);
    assert_eq!(golden(folder.path(), &["check", "--only", "a/two"]).0, 1);
    let parts = ["1/3", "2/3", "3/3"].map(|part| golden(folder.path(), &["check", "--partition", part]).0);
    assert_eq!(parts.iter().sum::<i32>(), 1, "one part has the golden that differs");
}

#[test]
fn the_list_has_a_line_for_each_picture() {
    let folder = goldens();
    golden(folder.path(), &["bless", "--only", "a/t*"]);
    let (status, said, _) = golden(folder.path(), &["list"]);
    assert_eq!(status, 0);
    assert!(said.starts_with("a/one  not blessed\n"), "{said}");
    let three = said.lines().find(|line| line.starts_with("a/three  inverse-projection  24 x 20  ")).unwrap();
    assert_eq!(three.rsplit(' ').next().unwrap().len(), 64);
    assert_eq!(golden(folder.path(), &["list", "--only", "a/one"]).1, "a/one  not blessed\n");
}

#[test]
fn a_wrong_call_or_folder_exits_with_2_and_says_why() {
    let folder = goldens();
    for (arguments, why) in [
        (&["check", "--dir", "none"][..], "none: this golden folder cannot be read"),
        (&["check", "--only", "b/*"], "no golden is selected"),
        (&["check", "--partition", "3/2"], "there is no part 3 of 2"),
        (&["bless", "--only", "x"], "no golden is selected"),
    ] {
        let (status, said, refused) = golden(folder.path(), arguments);
        assert_eq!((status, &*said), (2, ""), "{refused}");
        assert!(refused.contains(why), "{refused}");
    }
    fs::write(folder.path().join("golden/manifest.toml"), "schema = 1\n[[golden]]\ncase = 3\n").unwrap();
    let (status, _, refused) = golden(folder.path(), &["check"]);
    assert!(status == 2 && refused.contains("golden/manifest.toml"), "{refused}");
}

#[test]
fn without_a_folder_of_goldens_it_says_where_there_is_one() {
    let folder = tempfile::tempdir().unwrap();
    for action in ["check", "list"] {
        let (status, _, said) = golden(folder.path(), &[action]);
        assert_eq!(status, 2, "{said}");
        assert!(said.contains("drapery's repository") && said.contains("--dir"), "{said}");
    }
}
