//! `drapery hard-cases` as a user or a script calls it: what it says, what it writes, and the exit status.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "helpers of tests are no tests to the lint")]

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

/// The exit status and what a call says on stdout and stderr.
fn hard_cases(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_drapery"));
    command.arg("hard-cases").args(arguments).current_dir(folder).stdin(Stdio::null());
    let output = command.output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

#[test]
fn a_case_is_told_and_written_as_page_numbers_and_text() {
    let folder = tempfile::tempdir().unwrap();
    let (status, said, _) =
        hard_cases(folder.path(), &["--only", "12", "--quick", "-o", "out", "--json", "12.json"]);
    assert_eq!(status, 0);
    assert!(said.starts_with("12 Triangles against bilinear patches (osgearth PR#275)\n"), "{said}");
    assert_eq!(fs::read_to_string(folder.path().join("out/hard-cases.txt")).unwrap(), said);
    let json = fs::read_to_string(folder.path().join("12.json")).unwrap();
    assert_eq!(fs::read_to_string(folder.path().join("out/hard-cases.json")).unwrap(), json);
    assert!(fs::read_to_string(folder.path().join("out/hard-cases.html")).unwrap().contains("case-12"));
}

#[test]
fn a_number_that_no_case_has_writes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let (status, said, error) = hard_cases(folder.path(), &["--only", "0", "-o", "out"]);
    assert_eq!((status, said.as_str()), (2, ""));
    assert!(error.contains("there is no hard case 0"), "{error}");
    assert!(!folder.path().join("out").exists());
}

#[test]
fn curves_are_refused_where_nothing_would_show_them() {
    let folder = tempfile::tempdir().unwrap();
    let (status, said, error) = hard_cases(folder.path(), &["--stability"]);
    assert_eq!((status, said.as_str()), (2, ""));
    assert!(error.contains("-o DIR or --json FILE"), "{error}");
}
