//! A run that is killed or interrupted at any moment leaves nothing that the next run to the same place does not clear.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "helpers of tests are no tests to the lint")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
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

/// On Unix: SIGKILL, which nothing can answer. The run may have ended.
fn kill(run: &mut Child) {
    run.kill().unwrap();
}

/// Stops runs at moments from their begin to their end, into one place, then lets one run to its end. What stopped runs end with. In
/// `deep/er/out` there is nothing or everything, whenever.
#[allow(clippy::disallowed_methods, reason = "a run is stopped at shares of the time that it takes")]
fn stop_then_run(arguments: &[&str], stop: fn(&mut Child)) -> Vec<ExitStatus> {
    let sound = place();
    let begin = Instant::now();
    let ended = call(sound.path(), arguments).status().unwrap();
    assert!(ended.code().is_some_and(|code| code < 2), "{arguments:?} {ended:?}");
    let whole = begin.elapsed();
    let all = all_below(sound.path());
    // But for what waits in a part, until it is whole.
    let made = |all: &BTreeSet<PathBuf>| -> Vec<PathBuf> {
        let out = all.iter().filter(|path| path.starts_with("deep/er/out"));
        out.filter(|path| !path.to_string_lossy().contains(".part")).cloned().collect()
    };

    let stopped = place();
    let end_at = |moment: u32| {
        let mut run = call(stopped.path(), arguments).spawn().unwrap();
        std::thread::sleep(whole * moment / MOMENTS);
        stop(&mut run);
        let ended = run.wait().unwrap();
        let there = made(&all_below(stopped.path()));
        assert!(there.is_empty() || there == made(&all), "{arguments:?} {there:?}");
        ended
    };
    let ended = (1..=MOMENTS).map(end_at).collect();
    call(stopped.path(), arguments).status().unwrap();
    assert_eq!(all_below(stopped.path()), all, "{arguments:?}");
    ended
}

const RENDER: [&str; 4] = ["render", "scene.toml", "-o", "deep/er/out"];
const EXPORT: [&str; 6] = ["export", "scene.toml", "-t", "clipmap", "-o", "deep/er/out"];
const REPORT: [&str; 6] = ["report", "scene.toml", "--repeat", "1", "-o", "deep/er/out"];

#[test]
fn render() {
    stop_then_run(&RENDER, kill);
}

#[test]
fn export() {
    stop_then_run(&EXPORT, kill);
}

#[test]
fn report() {
    stop_then_run(&REPORT, kill);
}

#[test]
fn golden_bless() {
    stop_then_run(&["golden", "bless"], kill);
}

/// Ctrl-C is the end of a run at once, by the signal itself: who waits for it (a shell, make) knows that it was interrupted.
#[cfg(unix)]
#[test]
fn interrupted() {
    use std::os::unix::process::ExitStatusExt;
    const SIGINT: i32 = 2;
    let interrupt = |run: &mut Child| {
        let sent = Command::new("kill").args(["-INT", &run.id().to_string()]).stderr(Stdio::null()).status();
        sent.unwrap();
    };
    let mut idle = Command::new("sleep").arg("2").spawn().unwrap();
    interrupt(&mut idle);
    if idle.wait().unwrap().signal() != Some(SIGINT) {
        // What runs in the background of a script ignores the signal, and so does what it starts.
        return eprintln!("skipped: interrupts are ignored here");
    }
    for arguments in [&RENDER[..], &EXPORT, &REPORT] {
        let ended = stop_then_run(arguments, interrupt);
        assert!(ended.iter().any(|ended| ended.signal() == Some(SIGINT)), "{arguments:?} {ended:?}");
        let is_one = |ended: &ExitStatus| ended.success() || ended.signal() == Some(SIGINT);
        assert!(ended.iter().all(is_one), "{arguments:?} {ended:?}");
    }
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
