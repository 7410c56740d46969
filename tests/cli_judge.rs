//! `drapery compare BUNDLE FRAME` as the author of a renderer calls it.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "helpers of tests are no tests to the lint")]

mod judge;

use drapery::buffer::{Buffer, Values};
use judge::bundle::{FEW, RANGE, SIZE, depth, drawn, write_picture, write_plane};
use judge::calls::{called_in, json_of, judged, place, refused, with_frame};
use serde_json::{Value, json};
use std::process::Command;

#[test]
fn the_references_own_picture_drawn_by_another_program_passes() {
    let folder = with_frame(0, |_, _, _| {});
    let said = judged(&called_in(folder.path(), &["bundle", "frame.png"]), 0);
    assert!(said.starts_with("PASS: 0 of 1200 pixels are outside of what is allowed (0 may be)\n"), "{said}");
    assert!(said.contains("hypothesis as-set: blue is as-set"), "{said}");
    assert!(said.contains("others     other-blue 1200 failing"), "{said}");
}

#[test]
fn one_code_value_of_one_pixel_fails_and_its_feature_is_named() {
    let folder = with_frame(0, |x, y, pixel| {
        if (x, y) == (4, FEW) {
            pixel[1] += 1;
        }
    });
    let said = judged(&called_in(folder.path(), &["bundle", "frame.png"]), 1);
    assert!(said.starts_with("FAIL: 1 of 1200 pixels are outside of what is allowed (0 may be)\n"), "{said}");
    assert!(said.contains("`roads` feature 3 (Main Street) in 1 failing pixels"), "{said}");
    assert!(said.contains("1 failing in 16 x 16 pixels from 0,0"), "{said}");
    judged(&called_in(folder.path(), &["bundle", "frame.png", "--allow", "1"]), 0);
    let json = json_of(folder.path(), &[], 1);
    assert_eq!((&json["verdict"], &json["failure"]["name"]), (&json!("fail"), &json!("outside")));
    assert_eq!(
        json["features"],
        json!([{ "layer": 0, "feature": 0, "name": "`roads` feature 3 (Main Street)", "pixels": 1 }])
    );
    assert_eq!(
        (&json["metrics"]["failing"], &json["metrics"]["worst"]["channel"]),
        (&json!(1), &json!("green"))
    );
}

#[test]
fn a_colour_between_two_that_are_allowed_fails_and_within_a_range_passes() {
    let between = |row: usize| {
        with_frame(0, move |x, y, pixel| {
            if (x, y) == (7, row) {
                pixel[0] = 125;
            }
        })
    };
    judged(&called_in(between(FEW).path(), &["bundle", "frame.png"]), 1);
    judged(&called_in(between(RANGE).path(), &["bundle", "frame.png"]), 0);
}

#[test]
fn the_hypothesis_that_fits_the_whole_picture_is_named_and_two_are_never_mixed() {
    let other = with_frame(1, |_, _, _| {});
    let json = json_of(other.path(), &[], 0);
    assert_eq!((&json["hypothesis"], &json["verdict"]), (&json!("other-blue"), &json!("pass")));
    assert_eq!(json["hypotheses"][0], json!({ "name": "as-set", "says": "blue is as-set", "failing": 1200 }));
    let mixed = with_frame(1, |_, y, pixel| {
        if y < 10 {
            pixel[2] = 9;
        }
    });
    let json = json_of(mixed.path(), &[], 1);
    assert_eq!((&json["hypothesis"], &json["metrics"]["failing"]), (&json!("other-blue"), &json!(400)));
}

#[test]
fn open_pixels_that_all_go_one_way_pass_weakly_and_fail_where_that_is_asked() {
    for (red_few, red_range, side) in [(200, 210, "drawn"), (50, 60, "out")] {
        let folder = with_frame(0, |_, y, pixel| match y {
            FEW => pixel[0] = red_few,
            RANGE => pixel[0] = red_range,
            _ => {}
        });
        let output = called_in(folder.path(), &["bundle", "frame.png"]);
        let said = judged(&output, 0);
        assert!(said.starts_with("WEAK PASS: 0 of 1200"), "{said}");
        assert!(said.contains("80 of 80 open pixels"), "{said}");
        assert!(String::from_utf8_lossy(&output.stderr).contains("weak pass"));
        let json = json_of(folder.path(), &[], 0);
        assert_eq!((&json["verdict"], &json["weak"]["side"]), (&json!("weak-pass"), &json!(side)));
        assert_eq!(json["failure"], Value::Null);
        let json = json_of(folder.path(), &["--strict"], 1);
        assert_eq!((&json["verdict"], &json["failure"]["name"]), (&json!("fail"), &json!("lopsided")));
    }
}

#[test]
fn a_cluster_of_failing_pixels_fails_though_so_many_are_allowed() {
    let scattered = |x: usize, y: usize| y == 5 && x.is_multiple_of(8);
    let dense = |x: usize, y: usize| y == 5 && (10..15).contains(&x);
    let folder = |is_wrong: fn(usize, usize) -> bool| {
        with_frame(0, move |x, y, pixel| pixel[1] += u8::from(is_wrong(x, y)))
    };
    judged(&called_in(folder(scattered).path(), &["bundle", "frame.png", "--allow", "5"]), 0);
    let dense = folder(dense);
    let said = judged(&called_in(dense.path(), &["bundle", "frame.png", "--allow", "5"]), 1);
    assert!(
        said.starts_with("FAIL: 5 pixels outside of what is allowed lie in one window (4 may be)"),
        "{said}"
    );
    judged(&called_in(dense.path(), &["bundle", "frame.png", "--allow", "0.5%", "--densest", "5"]), 0);
}

#[test]
fn the_first_buffer_that_differs_is_named() {
    let folder = place();
    let frames = folder.path().join("frames");
    write_picture(&frames.join("clipmap.png"), &drawn(0, |_, _, _| {}));
    let mut wrong = depth();
    wrong[41] += 1.0;
    write_plane(&frames.join("clipmap.depth.npy"), SIZE.0, Values::F64(wrong));
    let mut triangles = vec![3; SIZE.0 * SIZE.1];
    (triangles[0], triangles[41]) = (8, u32::MAX);
    write_plane(&frames.join("clipmap.triangle.npy"), SIZE.0, Values::U32(triangles.clone()));
    let json = |status| -> Value {
        let output = called_in(folder.path(), &["bundle", "frames", "--json", "-"]);
        serde_json::from_str(&judged(&output, status)).unwrap()
    };
    // A table that nobody judges by may be what it likes.
    std::fs::write(frames.join("clipmap.strips.npy"), "no rows").unwrap();
    let found = json(0);
    assert_eq!(found["first_stage"], "depth");
    let strict = json_of_frames(folder.path(), &["--strict"]);
    assert_eq!((&strict["verdict"], &strict["failure"]["name"]), (&json!("fail"), &json!("stage")));
    assert_eq!(
        found["stages"][0],
        json!({ "buffer": "depth", "found": "differs", "pixels": 1, "first": { "x": 1, "y": 1 } })
    );
    assert_eq!(found["stages"][1], json!({ "buffer": "triangle", "found": "fits" }));
    write_plane(&frames.join("clipmap.depth.npy"), SIZE.0, Values::F64(depth()));
    triangles[0] = 9;
    write_plane(&frames.join("clipmap.triangle.npy"), SIZE.0, Values::U32(triangles));
    assert_eq!(json(0)["first_stage"], "triangle");
    write_plane(&frames.join("clipmap.triangle.npy"), SIZE.0, Values::U32(vec![3; SIZE.0]));
    assert_eq!(json(0)["stages"][1]["found"], "another-size");
    std::fs::remove_file(frames.join("clipmap.triangle.npy")).unwrap();
    assert_eq!(json(0)["stages"][1], json!({ "buffer": "triangle", "found": "not-given" }));
}

fn json_of_frames(folder: &std::path::Path, more: &[&str]) -> Value {
    let output = called_in(folder, &[&["bundle", "frames", "--json", "-"], more].concat());
    serde_json::from_str(&judged(&output, 1)).unwrap()
}

#[test]
fn another_size_a_nan_and_other_channels_are_failures_of_their_own() {
    let folder = place();
    write_picture(&folder.path().join("frame.png"), &Buffer::from_values(2, 2, vec![[0; 4]; 4]));
    assert_eq!(json_of(folder.path(), &["--allow", "9999"], 1)["failure"]["name"], "another-size");
    write_plane(&folder.path().join("frame.png"), SIZE.0, Values::F64(depth()));
    assert_eq!(json_of(folder.path(), &["--allow", "9999"], 1)["failure"]["name"], "other-channels");
}

#[test]
fn a_frame_on_stdin_is_judged() {
    let folder = with_frame(0, |_, _, _| {});
    let called = |file: &str| {
        let stdin = std::fs::File::open(folder.path().join(file)).unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_drapery"));
        command.args(["compare", "bundle", "-"]).current_dir(folder.path()).stdin(stdin).output().unwrap()
    };
    judged(&called("frame.png"), 0);
    #[cfg(unix)]
    assert!(refused(&called("bundle/clipmap.png")).contains("the same file twice"));
}

#[test]
fn the_page_is_one_file_that_fetches_nothing() {
    let folder = with_frame(0, |x, y, pixel| pixel[1] += u8::from((x, y) == (4, FEW)));
    judged(&called_in(folder.path(), &["bundle", "frame.png", "--html", "page.html"]), 1);
    let page = std::fs::read_to_string(folder.path().join("page.html")).unwrap();
    assert!(page.contains("FAIL: 1 of 1200 pixels") && page.contains("Main Street"), "{page}");
    assert_eq!(page.matches("src=\"data:image/png;base64,").count(), 3);
    assert!(page.contains("data-window=\"0,0,16,16\""), "{page}");
    for outside in ["http:", "https:", "src=\"/", "@import", "<link"] {
        assert!(!page.contains(outside), "{outside}");
    }
}

#[test]
fn ignored_pixels_of_a_bundle_are_not_looked_at() {
    let folder = with_frame(0, |x, y, pixel| pixel[1] += u8::from((x, y) == (4, 3)));
    let mask = |at: (usize, usize)| {
        let picture =
            drawn(0, |x, y, pixel| *pixel = if (x, y) == at { [0, 0, 1, 255] } else { [0, 0, 0, 255] });
        write_picture(&folder.path().join("mask.png"), &picture);
    };
    let call = ["bundle", "frame.png", "--ignore", "mask.png"];
    mask((4, 3));
    judged(&called_in(folder.path(), &call), 0);
    mask((5, 3));
    judged(&called_in(folder.path(), &call), 1);
}
