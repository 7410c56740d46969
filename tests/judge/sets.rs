//! Conformance sets, and what machines that run tests read of them.

use super::bundle::{drawn, write_bundle, write_picture};
use super::calls::{called_in, judged, refused};
use serde_json::{Value, json};
use std::process::Command;

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
