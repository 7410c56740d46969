//! A run that is killed at any moment leaves nothing that the next run to the same place does not clear.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "helpers of tests are no tests to the lint")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

const SCENE: &str = r##"
schema = 1
image = { width = 24, height = 20 }
camera = { eye = [0, -300, 200], target = [0, 0, 10] }
terrain.generate = { kind = "cone", posts = [9, 9], cell_m = 30.0, height_m = 60.0 }
[[layer]]
features = [{ line = [[-100, -80], [0, 0], [110, 40]] }]
line = { color = "#ff7f00", width_m = 20 }
"##;

/// How many moments of a run it is killed at.
const MOMENTS: u32 = 8;

/// A folder with a scene, and goldens of it that have not been blessed.
fn place() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir_all(folder.path().join("golden/a")).unwrap();
    fs::write(folder.path().join("golden/a/one.toml"), SCENE).unwrap();
    fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
    folder
}

fn call(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_drapery"));
    command.args(arguments).current_dir(folder).stdin(Stdio::null());
    command.stdout(Stdio::null()).stderr(Stdio::null());
    command
}

/// The files and folders below a folder.
fn all_below(folder: &Path) -> BTreeSet<PathBuf> {
    let mut found = BTreeSet::new();
    let mut open = vec![folder.to_owned()];
    while let Some(next) = open.pop() {
        for entry in fs::read_dir(&next).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path.clone());
            }
            found.insert(path.strip_prefix(folder).unwrap().to_owned());
        }
    }
    found
}

/// Kills runs at moments from their begin to their end, into one place, then lets one run to its end.
#[allow(clippy::disallowed_methods, reason = "a run is killed at shares of the time that it takes")]
fn kill_then_run(arguments: &[&str]) {
    let sound = place();
    let begin = Instant::now();
    call(sound.path(), arguments).status().unwrap();
    let whole = begin.elapsed();

    let killed = place();
    for moment in 1..=MOMENTS {
        let mut run = call(killed.path(), arguments).spawn().unwrap();
        std::thread::sleep(whole * moment / MOMENTS);
        // On Unix: SIGKILL, which nothing can answer. It may have ended.
        run.kill().unwrap();
        run.wait().unwrap();
    }
    call(killed.path(), arguments).status().unwrap();
    assert_eq!(all_below(killed.path()), all_below(sound.path()), "{arguments:?}");
}

#[test]
fn render() {
    kill_then_run(&["render", "scene.toml", "-o", "deep/er/out"]);
}

#[test]
fn export() {
    kill_then_run(&["export", "scene.toml", "-t", "clipmap", "-o", "deep/er/out"]);
}

#[test]
fn report() {
    kill_then_run(&["report", "scene.toml", "-t", "inverse-projection", "-o", "deep/er/out"]);
}

#[test]
fn golden_bless() {
    kill_then_run(&["golden", "bless"]);
}

/// The moment between two calls of the system, which no sleep meets: what stands there then is made by hand.
#[test]
fn what_is_left_at_the_worst_moments_is_cleared() {
    let folder = place();
    for left in ["deep/er/.out.3.part/files/half", ".out.0.part/files", "deep/.out.1.part"] {
        fs::create_dir_all(folder.path().join(left)).unwrap();
        let part =
            folder.path().join(left).ancestors().find(|path| path.extension().is_some()).unwrap().to_owned();
        fs::write(part.join("lock"), "").unwrap();
    }
    let ended = call(folder.path(), &["render", "scene.toml", "-o", "deep/er/out"]).status().unwrap();
    assert!(ended.success());
    let hidden = all_below(folder.path()).into_iter().filter(|path| path.to_string_lossy().contains(".part"));
    assert_eq!(hidden.count(), 0);
}
