//! `drapery compare BUNDLE FRAME` as the author of a renderer calls it.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "helpers of tests are no tests to the lint")]

mod judge;

use drapery::buffer::{Buffer, Values};
use judge::{FEW, RANGE, SIZE, depth, drawn, sign, write_bundle, write_picture, write_plane};
use serde_json::{Value, json};
use std::path::Path;
use std::process::{Command, Output, Stdio};

fn called_in(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_drapery"));
    command.arg("compare").args(arguments).current_dir(folder).stdin(Stdio::null());
    command.env_remove("GITHUB_STEP_SUMMARY").output().unwrap()
}

/// What a call that judges says on stdout.
fn judged(output: &Output, status: i32) -> String {
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(status), "{said}{}", String::from_utf8_lossy(&output.stdout));
    String::from_utf8(output.stdout.clone()).unwrap()
}

/// What a call that judges nothing says on stderr; its stdout is empty.
fn refused(output: &Output) -> String {
    let said = String::from_utf8(output.stderr.clone()).unwrap();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(output.stdout.is_empty());
    said
}

/// A folder with a bundle.
fn place() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    write_bundle(&folder.path().join("bundle"));
    folder
}

/// The place, and a frame there as `frame.png`: the reference's picture by a hypothesis, changed.
fn with_frame(hypothesis: usize, change: impl Fn(usize, usize, &mut [u8; 4])) -> tempfile::TempDir {
    let folder = place();
    write_picture(&folder.path().join("frame.png"), &drawn(hypothesis, change));
    folder
}

fn json_of(folder: &Path, arguments: &[&str], status: i32) -> Value {
    let call = [&["bundle", "frame.png", "--json", "-"], arguments].concat();
    serde_json::from_str(&judged(&called_in(folder, &call), status)).unwrap()
}

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
    let found = json(0);
    assert_eq!(found["first_stage"], "depth");
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

#[test]
fn another_size_a_nan_and_other_channels_are_failures_of_their_own() {
    let folder = place();
    write_picture(&folder.path().join("frame.png"), &Buffer::from_values(2, 2, vec![[0; 4]; 4]));
    assert_eq!(json_of(folder.path(), &["--allow", "9999"], 1)["failure"]["name"], "another-size");
    write_plane(&folder.path().join("frame.png"), SIZE.0, Values::F64(depth()));
    assert_eq!(json_of(folder.path(), &["--allow", "9999"], 1)["failure"]["name"], "other-channels");
}

#[test]
fn a_folder_without_the_picture_and_a_damaged_picture_judge_nothing() {
    let folder = with_frame(0, |_, _, _| {});
    std::fs::create_dir(folder.path().join("frames")).unwrap();
    let said = refused(&called_in(folder.path(), &["bundle", "frames"]));
    assert!(said.contains("this folder has no picture clipmap.png"), "{said}");
    let whole = std::fs::read(folder.path().join("frame.png")).unwrap();
    std::fs::write(folder.path().join("frame.png"), &whole[..whole.len() / 2]).unwrap();
    let said = refused(&called_in(folder.path(), &["bundle", "frame.png"]));
    assert!(said.contains("frame.png: this PNG cannot be read"), "{said}");
    assert!(refused(&called_in(folder.path(), &["bundle", "none.png"])).contains("this picture is missing"));
}

#[test]
fn the_bundles_own_pictures_are_refused_by_every_name() {
    let folder = place();
    std::fs::hard_link(folder.path().join("bundle/clipmap.png"), folder.path().join("hard.png")).unwrap();
    for own in ["bundle/clipmap.png", "bundle", "bundle/allowed/as-set.lo.png", "hard.png"] {
        let said = refused(&called_in(folder.path(), &["bundle", own]));
        assert!(said.contains("the same file twice"), "{own}: {said}");
    }
}

#[test]
fn nothing_of_a_bundle_is_written_over() {
    let folder = with_frame(0, |_, _, _| {});
    for output in ["bundle/allowed.json", "bundle/clipmap.png", "frame.png"] {
        let before = std::fs::read(folder.path().join(output)).unwrap();
        let said = refused(&called_in(folder.path(), &["bundle", "frame.png", "--json", output]));
        assert!(said.contains("would be written over"), "{said}");
        assert_eq!(std::fs::read(folder.path().join(output)).unwrap(), before);
    }
}

#[test]
fn a_bundle_that_is_not_as_it_was_written_judges_nothing() {
    let refusal = |spoil: &dyn Fn(&Path)| {
        let folder = with_frame(0, |_, _, _| {});
        spoil(&folder.path().join("bundle"));
        refused(&called_in(folder.path(), &["bundle", "frame.png"]))
    };
    let missing = refusal(&|bundle| std::fs::remove_file(bundle.join("allowed/as-set.hi.png")).unwrap());
    assert!(
        missing.contains("as-set.hi.png: this file is missing") && missing.contains("export"),
        "{missing}"
    );
    let none = refusal(&|bundle| std::fs::remove_file(bundle.join("manifest.json")).unwrap());
    assert!(
        none.contains("manifest.json: this file is missing") && none.contains("drapery export"),
        "{none}"
    );
    let edited = refusal(&|bundle| {
        let path = bundle.join("allowed.json");
        let text = std::fs::read_to_string(&path).unwrap();
        std::fs::write(&path, text.replace("blue is as-set", "blue is as-get")).unwrap();
    });
    assert!(edited.contains("allowed.json: this file is not the one"), "{edited}");
    for file in ["manifest.json", "allowed.json"] {
        let newer = refusal(&|bundle| {
            let path = bundle.join(file);
            let text = std::fs::read_to_string(&path).unwrap();
            std::fs::write(&path, text.replace("\"schema\":1", "\"schema\":2")).unwrap();
            if file != "manifest.json" {
                sign(bundle);
            }
        });
        assert!(newer.contains(&format!("{file}: it has the schema 2")), "{newer}");
        let half = refusal(&|bundle| {
            let path = bundle.join(file);
            let text = std::fs::read_to_string(&path).unwrap();
            std::fs::write(&path, &text[..text.len() / 2]).unwrap();
            if file != "manifest.json" {
                sign(bundle);
            }
        });
        assert!(half.contains(&format!("{file}: this is not what a bundle has here")), "{half}");
    }
}

/// Changes `allowed.json` and signs the bundle again.
fn rewrite(bundle: &Path, change: impl Fn(&mut Value)) {
    let path = bundle.join("allowed.json");
    let mut document = serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
    change(&mut document);
    std::fs::write(&path, document.to_string()).unwrap();
    sign(bundle);
}

#[test]
fn hostile_documents_and_tables_are_refused() {
    let refusal = |spoil: &dyn Fn(&Path)| {
        let folder = with_frame(0, |_, _, _| {});
        let bundle = folder.path().join("bundle");
        spoil(&bundle);
        refused(&called_in(folder.path(), &["bundle", "frame.png"]))
    };
    let table = |name: &'static str, columns: usize, values: Vec<u32>| {
        refusal(&|bundle: &Path| {
            write_plane(&bundle.join("allowed").join(name), columns, Values::U32(values.clone()));
            sign(bundle);
        })
    };
    let choices = "as-set.choices.npy";
    let row = |pixel: u32, lo: u32, hi: u32| vec![pixel, lo, lo, lo, lo, hi, hi, hi, hi];
    assert!(table(choices, 9, row(1200, 0, 9)).contains("as-set.choices.npy: the picture has no pixel 1200"));
    assert!(table(choices, 9, [row(3, 0, 9), row(2, 0, 9)].concat()).contains("not sorted by pixel"));
    assert!(table(choices, 9, row(3, 9, 0)).contains("a choice of pixel 3 is upside down"));
    assert!(table(choices, 9, row(3, 0, 65536)).contains("beyond 65535"));
    assert!(table(choices, 3, vec![1, 2, 3]).contains("no table of 9 columns"));
    let twice = [row(3, 0, 9), row(3, 0, 9)].concat();
    assert!(table("as-set.extremes.npy", 9, twice).contains("pixel 3 has its two ends twice"));
    assert!(table("features.npy", 5, vec![0, 39, 40, 0, 0]).contains("row 0 has no pixels from 39 to 40"));
    assert!(table("features.npy", 5, vec![30, 0, 0, 0, 0]).contains("row 30 has no pixels"));
    let document = |change: &dyn Fn(&mut Value)| refusal(&|bundle| rewrite(bundle, change));
    let huge = document(&|document| document["width"] = json!(u64::MAX));
    assert!(huge.contains("as-set.lo.png: it has 40 x 30 pixels"), "{huge}");
    assert!(document(&|document| document["hypotheses"] = json!([])).contains("no hypothesis"));
    assert!(document(&|document| document["features"] = json!("../frame.png")).contains("does not name it"));
    assert!(
        document(&|document| document["stages"][0] = json!({ "buffer": "depth" }))
            .contains("neither `lo` and `hi`")
    );
    let swapped = document(&|document| {
        let ends = document["hypotheses"][0].clone();
        (document["hypotheses"][0]["lo"], document["hypotheses"][0]["hi"]) =
            (ends["hi"].clone(), ends["lo"].clone());
    });
    assert!(swapped.contains("upside down"), "{swapped}");
    let outside = refusal(&|bundle| {
        let manifest = bundle.join("manifest.json");
        let text = std::fs::read_to_string(&manifest).unwrap();
        std::fs::write(&manifest, text.replace("\"name\":\"clipmap.png\"", "\"name\":\"../frame.png\""))
            .unwrap();
    });
    assert!(outside.contains("`../frame.png` is no name of a file in a bundle"), "{outside}");
}

#[test]
fn options_of_pictures_are_refused_for_bundles() {
    let folder = with_frame(0, |_, _, _| {});
    for option in [["--tolerance", "1/255"], ["--relative", "0.1"]] {
        let said = refused(&called_in(folder.path(), &[&["bundle", "frame.png"], &option[..]].concat()));
        assert!(said.contains("is of pictures"), "{said}");
    }
}

/// A set of two cases whose frames are there: the first as it should be, the second with a wrong pixel; and a third without a frame.
fn with_set() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let case = |(name, bundle): (&str, &str)| {
        write_bundle(&at("set").join(bundle));
        json!({ "name": name, "bundle": bundle, "exposes": format!("a mistake with <{name}>") })
    };
    let cases = [("caps", "caps"), ("order", "order"), ("origin", "far/origin")].map(case);
    let document = json!({ "schema": 1, "cases": cases });
    std::fs::write(at("set/conformance.json"), document.to_string()).unwrap();
    write_picture(&at("frames/caps/clipmap.png"), &drawn(1, |_, _, _| {}));
    let wrong = drawn(0, |x, y, pixel| pixel[1] += u8::from((x, y) == (30, 2)));
    write_picture(&at("frames/order.png"), &wrong);
    folder
}

#[test]
fn a_conformance_set_gives_one_table_and_one_verdict() {
    let folder = with_set();
    let said = judged(&called_in(folder.path(), &["set", "frames"]), 1);
    let table = "\
FAIL: 2 of 3 cases fail
  case    verdict  failing  densest  hypothesis
  caps    PASS           0        0  other-blue
  order   FAIL           1        1  as-set
  origin  FAIL           -        -  -
";
    assert!(said.starts_with(table), "{said}");
    assert!(said.contains("exposes    a mistake with <order>"), "{said}");
    assert!(said.contains("no frame of the case `origin`"), "{said}");
    write_picture(&folder.path().join("frames/order.png"), &drawn(0, |_, _, _| {}));
    write_picture(&folder.path().join("frames/far/origin/clipmap.png"), &drawn(0, |_, _, _| {}));
    let output = called_in(folder.path(), &["set", "frames", "--json", "-"]);
    let json: Value = serde_json::from_str(&judged(&output, 0)).unwrap();
    assert_eq!(
        (&json["kind"], &json["verdict"], &json["cases"][1]["name"]),
        (&json!("set"), &json!("pass"), &json!("order"))
    );
}

#[test]
fn a_set_without_any_frame_or_with_a_broken_bundle_judges_nothing() {
    let folder = with_set();
    std::fs::create_dir(folder.path().join("empty")).unwrap();
    let said = refused(&called_in(folder.path(), &["set", "empty"]));
    assert!(said.contains("none of the 3 cases has a frame here") && said.contains("`caps`"), "{said}");
    assert!(refused(&called_in(folder.path(), &["set", "frames/order.png"])).contains("are in a folder"));
    std::fs::remove_file(folder.path().join("set/far/origin/allowed.json")).unwrap();
    assert!(
        refused(&called_in(folder.path(), &["set", "frames"])).contains("allowed.json: this file is missing")
    );
    let conformance = folder.path().join("set/conformance.json");
    for (cases, why) in [
        (json!([]), "no case"),
        (
            json!([{ "name": "a", "bundle": "../bundle", "exposes": "" }]),
            "`../bundle` is no name of a folder",
        ),
        (json!([{ "name": "/", "bundle": "a", "exposes": "" }]), "`/` is no name of a folder"),
    ] {
        std::fs::write(&conformance, json!({ "schema": 1, "cases": cases }).to_string()).unwrap();
        let said = refused(&called_in(folder.path(), &["set", "frames"]));
        assert!(said.contains(why), "{said}");
    }
}

#[test]
fn junit_has_a_case_each_with_its_failure_and_its_attachments() {
    let folder = with_set();
    let call = ["set", "frames", "--junit", "j.xml", "--heatmap", "heat", "--html", "page.html"];
    judged(&called_in(folder.path(), &call), 1);
    let xml = std::fs::read_to_string(folder.path().join("j.xml")).unwrap();
    let suite = "<testsuite name=\"set\" tests=\"3\" failures=\"2\" errors=\"0\" skipped=\"0\">";
    assert!(xml.starts_with("<?xml version=\"1.0\"") && xml.contains(suite), "{xml}");
    assert!(
        xml.contains("name=\"order\">\n      <failure type=\"outside\" message=\"1 of 1200 pixels"),
        "{xml}"
    );
    assert!(xml.contains("<failure type=\"no-frame\""), "{xml}");
    assert!(xml.contains("a mistake with &lt;order&gt;") && !xml.contains("<order>"), "{xml}");
    for file in ["frames/order.png", "frames/caps/clipmap.png", "heat/order.heat.png", "page.html"] {
        assert!(xml.contains(&format!("[[ATTACHMENT|{file}]]")), "{file}: {xml}");
        assert!(folder.path().join(file).is_file());
    }
    assert!(!xml.contains("[[ATTACHMENT|heat/origin.heat.png]]"));
    roxmltree::Document::parse(&xml).unwrap();
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
fn github_gets_annotations_and_a_summary_that_keeps_what_was_there() {
    let folder = with_set();
    let summary = folder.path().join("summary.md");
    std::fs::write(&summary, "# before\n").unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_drapery"));
    command.args(["compare", "set", "frames", "--github"]).current_dir(folder.path());
    let said = judged(&command.env("GITHUB_STEP_SUMMARY", &summary).output().unwrap(), 1);
    let lines: Vec<&str> = said.lines().filter(|line| line.starts_with("::")).collect();
    assert_eq!(lines.len(), 2, "{said}");
    assert!(
        lines[0].starts_with("::error file=set/order,title=drapery compare%3A order::FAIL: 1 of 1200"),
        "{said}"
    );
    assert!(lines[0].contains("%0A  expected"), "{said}");
    let text = std::fs::read_to_string(&summary).unwrap();
    assert!(text.starts_with("# before\n## FAIL: 2 of 3 cases fail\n"), "{text}");
    assert!(text.contains("| order | FAIL | 1 | 1 | as-set |"), "{text}");
    let full = "x".repeat((1 << 20) - 1030);
    std::fs::write(&summary, &full).unwrap();
    judged(&command.output().unwrap(), 1);
    assert_eq!(std::fs::read_to_string(&summary).unwrap(), full, "what does not fit is left out");
    let output = called_in(folder.path(), &["set", "frames", "--github", "--json", "-"]);
    serde_json::from_str::<Value>(&judged(&output, 1)).unwrap();
    assert!(String::from_utf8_lossy(&output.stderr).contains("::error file=set/order"));
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

#[cfg(unix)]
#[test]
fn a_report_that_cannot_be_written_is_no_verdict() {
    let folder = with_frame(0, |_, _, _| {});
    for option in ["--json", "--html", "--junit", "--heatmap"] {
        for output in ["no/such/file", "/dev/full"] {
            let said = refused(&called_in(folder.path(), &["bundle", "frame.png", option, output]));
            assert!(said.contains(&format!("{output}: this file cannot be written")), "{option}: {said}");
        }
    }
}
