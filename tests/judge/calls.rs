//! Calls of the command line, and the frames that they judge.

use super::bundle::{drawn, write_bundle, write_picture};
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output, Stdio};

pub fn called_in(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_drapery"));
    command.arg("compare").args(arguments).current_dir(folder).stdin(Stdio::null());
    command.env_remove("GITHUB_STEP_SUMMARY").output().unwrap()
}

/// What a call that judges says on stdout.
pub fn judged(output: &Output, status: i32) -> String {
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(status), "{said}{}", String::from_utf8_lossy(&output.stdout));
    String::from_utf8(output.stdout.clone()).unwrap()
}

/// What a call that judges nothing says on stderr; its stdout is empty.
pub fn refused(output: &Output) -> String {
    let said = String::from_utf8(output.stderr.clone()).unwrap();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(output.stdout.is_empty());
    said
}

/// A folder with a bundle.
pub fn place() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    write_bundle(&folder.path().join("bundle"));
    folder
}

/// The place, and a frame there as `frame.png`: the reference's picture by a hypothesis, changed.
pub fn with_frame(hypothesis: usize, change: impl Fn(usize, usize, &mut [u8; 4])) -> tempfile::TempDir {
    let folder = place();
    write_picture(&folder.path().join("frame.png"), &drawn(hypothesis, change));
    folder
}

pub fn json_of(folder: &Path, arguments: &[&str], status: i32) -> Value {
    let call = [&["bundle", "frame.png", "--json", "-"], arguments].concat();
    serde_json::from_str(&judged(&called_in(folder, &call), status)).unwrap()
}
