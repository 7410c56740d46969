//! `drapery compare` as a user or a script calls it: each failure by its name, and the exit status.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "helpers of tests are no tests to the lint")]

use drapery::buffer::{Buffer, Plane, Values};
use drapery::output::{Npy, write_png};
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output, Stdio};

fn called_in(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_drapery"));
    command.arg("compare").args(arguments).current_dir(folder).stdin(Stdio::null()).output().unwrap()
}

/// What a call that judges says on stdout.
fn judged(output: Output, status: i32) -> String {
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(status), "{said}");
    String::from_utf8(output.stdout).unwrap()
}

/// What a call that is wrong says on stderr; its stdout is empty.
fn refused(output: Output) -> String {
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(output.stdout.is_empty());
    said
}

fn picture(change: impl Fn(&mut [[u8; 4]])) -> Buffer<[u8; 4]> {
    let mut values: Vec<[u8; 4]> = (0..40 * 30u32).map(|v| [v as u8, (v / 7) as u8, 9, 255]).collect();
    change(&mut values);
    Buffer::from_values(40, 30, values)
}

fn write(folder: &Path, name: &str, picture: &Buffer<[u8; 4]>) {
    let mut file = Vec::new();
    write_png(picture, &mut file).unwrap();
    std::fs::write(folder.join(name), file).unwrap();
}

fn write_npy(folder: &Path, name: &str, values: Vec<f32>) {
    let mut file = Vec::new();
    let bits = values.iter().map(|v| v.to_bits()).collect();
    // Written as integers and renamed to floats, so that a NaN can be written.
    let plane = Plane { name: "depth", width: 2, height: 2, components: 1, values: Values::U32(bits) };
    Npy::new(&plane).unwrap().write(&mut file).unwrap();
    let at = file.windows(3).position(|word| word == b"<u4").unwrap();
    file[at + 1] = b'f';
    std::fs::write(folder.join(name), file).unwrap();
}

/// A picture, an equal one, and one with a pixel that is off by 3 codes in green and another that is off in alpha.
fn pictures() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "a.png", &picture(|_| {}));
    write(folder.path(), "equal.png", &picture(|_| {}));
    let off = picture(|v| {
        v[41] = [41, 5 + 3, 9, 255];
        v[29 * 40 + 39][3] = 254;
    });
    write(folder.path(), "off.png", &off);
    folder
}

#[test]
fn two_files_of_equal_pixels_pass() {
    let folder = pictures();
    let said = judged(called_in(folder.path(), &["a.png", "equal.png"]), 0);
    assert!(said.starts_with("PASS: 0 of 1200 pixels are over the tolerance 0 (0 allowed)\n"), "{said}");
}

#[test]
fn one_code_of_one_pixel_fails_and_a_tolerance_or_an_allowance_passes_it() {
    let folder = pictures();
    let said = judged(called_in(folder.path(), &["a.png", "off.png"]), 1);
    assert!(said.starts_with("FAIL: 2 of 1200 pixels"), "{said}");
    assert!(said.contains("(3/255), first at pixel 1,1, green"), "{said}");
    assert!(said.contains("densest   1 failing in 16 x 16 pixels from 0,0"), "{said}");
    judged(called_in(folder.path(), &["a.png", "off.png", "--tolerance", "1/255"]), 1);
    judged(called_in(folder.path(), &["a.png", "off.png", "--tolerance", "1/255", "--allow", "1"]), 0);
    judged(called_in(folder.path(), &["a.png", "off.png", "--tolerance", "2/255"]), 1);
    judged(called_in(folder.path(), &["a.png", "off.png", "--tolerance", "3/255"]), 0);
    judged(called_in(folder.path(), &["a.png", "off.png", "--allow", "1"]), 1);
    judged(called_in(folder.path(), &["a.png", "off.png", "--allow", "2"]), 0);
}

#[test]
fn alpha_alone_fails() {
    let folder = pictures();
    write(folder.path(), "clear.png", &picture(|v| v[7][3] = 0));
    let said = judged(called_in(folder.path(), &["a.png", "clear.png"]), 1);
    assert!(said.contains("max       1 (255/255), first at pixel 7,0, alpha"), "{said}");
}

#[test]
fn another_size_is_a_failure_of_its_own() {
    let folder = pictures();
    write(folder.path(), "small.png", &Buffer::from_values(2, 2, vec![[0; 4]; 4]));
    let said = judged(called_in(folder.path(), &["a.png", "small.png", "--allow", "99999"]), 1);
    assert!(
        said.starts_with("FAIL: another size: 40 x 30 pixels are expected, the picture has 2 x 2"),
        "{said}"
    );
}

#[test]
fn a_nan_is_a_failure_of_its_own_on_either_side_and_writes_no_heat_map() {
    let folder = pictures();
    write_npy(folder.path(), "good.npy", vec![0.5, 1.0, f32::INFINITY, 0.0]);
    write_npy(folder.path(), "nan.npy", vec![0.5, 1.0, f32::INFINITY, f32::NAN]);
    let call =
        ["good.npy", "nan.npy", "--tolerance", "9e9", "--allow", "9", "--heatmap", "h.png", "--json", "j"];
    let said = judged(called_in(folder.path(), &call), 1);
    assert!(said.starts_with("FAIL: not a number: the picture has a NaN at pixel 1,1, channel 0"), "{said}");
    assert!(!folder.path().join("h.png").exists());
    let json: Value = serde_json::from_slice(&std::fs::read(folder.path().join("j")).unwrap()).unwrap();
    assert_eq!((&json["verdict"], &json["failure"]["name"]), (&"fail".into(), &"not-a-number".into()));
    let said = judged(called_in(folder.path(), &["nan.npy", "good.npy"]), 1);
    assert!(said.contains("the expected picture has a NaN"), "{said}");
    std::fs::copy(folder.path().join("nan.npy"), folder.path().join("nan2.npy")).unwrap();
    judged(called_in(folder.path(), &["nan.npy", "nan2.npy"]), 1);
    std::fs::copy(folder.path().join("good.npy"), folder.path().join("good2.npy")).unwrap();
    judged(called_in(folder.path(), &["good.npy", "good2.npy"]), 0);
}

#[test]
fn the_same_file_twice_is_refused_by_every_name() {
    let folder = pictures();
    std::fs::hard_link(folder.path().join("a.png"), folder.path().join("hard.png")).unwrap();
    for other in ["a.png", "./a.png", "hard.png"] {
        let said = refused(called_in(folder.path(), &["a.png", other]));
        assert!(said.starts_with("error: the same file twice"), "{said}");
    }
    assert!(refused(called_in(folder.path(), &["-", "-"])).contains("the same file twice"));
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("a.png", folder.path().join("soft.png")).unwrap();
        assert!(refused(called_in(folder.path(), &["soft.png", "a.png"])).contains("the same file twice"));
        let mut command = Command::new(env!("CARGO_BIN_EXE_drapery"));
        let stdin = std::fs::File::open(folder.path().join("a.png")).unwrap();
        command.args(["compare", "a.png", "-"]).current_dir(folder.path()).stdin(stdin);
        assert!(refused(command.output().unwrap()).contains("the same file twice"));
    }
}

#[test]
fn a_missing_or_a_foreign_file_is_no_verdict() {
    let folder = pictures();
    std::fs::write(folder.path().join("text.png"), "no picture").unwrap();
    for (call, said) in [
        (["a.png", "none.png"], "error: none.png: this picture is missing"),
        (["none.png", "a.png"], "error: none.png: this picture is missing"),
        (["a.png", "text.png"], "error: text.png: this is no picture that can be compared"),
        (["a.png", "."], "error: .: this picture cannot be read"),
    ] {
        let refusal = refused(called_in(folder.path(), &[&call[..], &["--json", "j"]].concat()));
        assert!(refusal.starts_with(said), "{refusal}");
        assert!(!folder.path().join("j").exists());
    }
    assert!(
        refused(called_in(folder.path(), &["a.png", "off.png", "--tolerance", "nan"])).contains("tolerance")
    );
}

#[test]
fn the_report_goes_where_it_is_wanted() {
    let folder = pictures();
    let call = ["a.png", "off.png", "--json", "-", "--heatmap", "heat.png"];
    let json: Value = serde_json::from_str(&judged(called_in(folder.path(), &call), 1)).unwrap();
    assert_eq!((&json["expected"], &json["actual"]), (&"a.png".into(), &"off.png".into()));
    assert_eq!((&json["metrics"]["failing"], &json["tolerance"]), (&2.into(), &0.0.into()));
    let map = drapery::compare::Image::read(&folder.path().join("heat.png")).unwrap();
    assert_eq!((map.width(), map.height()), (40, 30));
    let red = |x: usize, y: usize| map.value((y * 40 + x) * 4);
    assert!(red(1, 1) == 1.0 && red(39, 29) == 1.0 && red(2, 1) < 0.1, "failing pixels are hot");
}

#[test]
fn a_compared_picture_is_not_written_over() {
    let folder = pictures();
    let before = std::fs::read(folder.path().join("off.png")).unwrap();
    let said = refused(called_in(folder.path(), &["a.png", "off.png", "--heatmap", "./off.png"]));
    assert!(said.contains("this picture is compared, and would be written over"), "{said}");
    assert_eq!(std::fs::read(folder.path().join("off.png")).unwrap(), before);
    let said = refused(called_in(folder.path(), &["a.png", "off.png", "--heatmap", "x", "--json", "x"]));
    assert!(said.contains("the same file"), "{said}");
}

#[test]
fn a_failure_that_nobody_reads_is_still_a_failure() {
    let folder = pictures();
    let mut command = Command::new(env!("CARGO_BIN_EXE_drapery"));
    command.args(["compare", "a.png", "off.png"]).current_dir(folder.path()).stdin(Stdio::null());
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    assert_eq!(child.wait().unwrap().code(), Some(1));
}

#[test]
fn a_picture_on_stdin_is_judged() {
    let folder = pictures();
    let mut command = Command::new(env!("CARGO_BIN_EXE_drapery"));
    command.args(["compare", "a.png", "-"]).current_dir(folder.path());
    let stdin = std::fs::File::open(folder.path().join("equal.png")).unwrap();
    judged(command.stdin(stdin).output().unwrap(), 0);
}

#[test]
fn a_share_of_the_pixels_is_allowed() {
    let folder = pictures();
    judged(called_in(folder.path(), &["a.png", "off.png", "--allow", "0.2%"]), 0);
    judged(called_in(folder.path(), &["a.png", "off.png", "--allow", "0.1%"]), 1);
    let said =
        judged(called_in(folder.path(), &["a.png", "off.png", "--allow", "0.2%", "--densest", "0"]), 1);
    assert!(said.starts_with("FAIL: 1 pixels over the tolerance lie in one window (0 allowed)"), "{said}");
    assert!(
        refused(called_in(folder.path(), &["a.png", "off.png", "--allow", "200%"])).contains("0% to 100%")
    );
}

#[test]
fn ignored_regions_are_not_compared_and_a_mask_has_the_pictures_size() {
    let folder = pictures();
    let black = |v: &mut [[u8; 4]]| v.iter_mut().for_each(|pixel| *pixel = [0, 0, 0, 255]);
    let mask = |name: &str, white: &[usize]| {
        let marked = picture(|v| {
            black(v);
            white.iter().for_each(|at| v[*at] = [255; 4]);
        });
        write(folder.path(), name, &marked);
    };
    mask("both.png", &[41, 29 * 40 + 39]);
    mask("one.png", &[41]);
    mask("all.png", &(0..1200).collect::<Vec<_>>());
    judged(called_in(folder.path(), &["a.png", "off.png", "--ignore", "both.png"]), 0);
    let said = judged(called_in(folder.path(), &["a.png", "off.png", "--ignore", "one.png"]), 1);
    assert!(said.starts_with("FAIL: 1 of 1200 pixels"), "{said}");
    write(folder.path(), "small.png", &Buffer::from_values(2, 2, vec![[0; 4]; 4]));
    let said = refused(called_in(folder.path(), &["a.png", "off.png", "--ignore", "small.png"]));
    assert!(said.contains("this mask has 2 x 2 pixels, and 40 x 30 are expected"), "{said}");
    let said = refused(called_in(folder.path(), &["a.png", "off.png", "--ignore", "all.png"]));
    assert!(said.contains("leaves no pixel to judge"), "{said}");
    let said = judged(called_in(folder.path(), &["a.png", "small.png", "--ignore", "both.png"]), 1);
    assert!(said.starts_with("FAIL: another size"), "{said}");
}

#[test]
fn depth_is_judged_relative_to_what_is_expected() {
    let folder = pictures();
    write_npy(folder.path(), "depth.npy", vec![1000.0, 10.0, f32::INFINITY, 1.0]);
    write_npy(folder.path(), "off.npy", vec![1000.5, 10.005, f32::INFINITY, 1.0005]);
    judged(called_in(folder.path(), &["depth.npy", "off.npy", "--tolerance", "0.01"]), 1);
    judged(called_in(folder.path(), &["depth.npy", "off.npy", "--relative", "0.001"]), 0);
    let said = judged(called_in(folder.path(), &["depth.npy", "off.npy", "--relative", "0.0004"]), 1);
    assert!(
        said.starts_with("FAIL: 3 of 4 pixels are over the tolerance 0 and 0.0004 of what is expected"),
        "{said}"
    );
    assert!(
        refused(called_in(folder.path(), &["depth.npy", "off.npy", "--relative=-1"])).contains("relative")
    );
}

#[test]
fn two_pictures_of_any_program_are_the_ends_of_what_is_allowed() {
    let folder = pictures();
    write(folder.path(), "lo.png", &picture(|v| v[41][1] = 3));
    write(folder.path(), "hi.png", &picture(|v| v[41][1] = 8));
    let ends = ["--lo", "lo.png", "--hi", "hi.png"];
    let called = |actual: &[&str]| called_in(folder.path(), &[&ends[..], actual].concat());
    judged(called(&["a.png"]), 0);
    let said = judged(called(&["off.png"]), 1);
    assert!(
        said.starts_with("FAIL: 1 of 1200 pixels") && said.contains("expected  lo.png to hi.png"),
        "{said}"
    );
    assert!(refused(called(&["lo.png"])).contains("the same file twice"));
    assert!(
        refused(called_in(folder.path(), &["--lo", "hi.png", "--hi", "lo.png", "a.png"]))
            .contains("upside down")
    );
    assert!(refused(called_in(folder.path(), &["--lo", "lo.png", "a.png"])).contains("--hi"));
    refused(called(&["a.png", "off.png"]));
    assert!(refused(called_in(folder.path(), &["a.png"])).contains("required"));
}

#[test]
fn pictures_have_the_reports_of_bundles_too() {
    let folder = pictures();
    let call = ["a.png", "off.png", "--junit", "j.xml", "--html", "p.html", "--heatmap", "h.png", "--github"];
    let said = judged(called_in(folder.path(), &call), 1);
    assert!(said.contains("::error file=a.png,title=drapery compare%3A off.png::FAIL: 2 of 1200"), "{said}");
    let xml = std::fs::read_to_string(folder.path().join("j.xml")).unwrap();
    for file in ["off.png", "h.png", "p.html"] {
        assert!(xml.contains(&format!("[[ATTACHMENT|{file}]]")), "{xml}");
    }
    let page = std::fs::read_to_string(folder.path().join("p.html")).unwrap();
    assert_eq!(page.matches("data-window=").count(), 2);
}
