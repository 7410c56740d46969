//! Bundles, frames and calls of which nothing comes.

use super::bundle::{sign, write_plane};
use super::calls::{called_in, place, refused, with_frame};
use drapery::buffer::Values;
use serde_json::{Value, json};
use std::path::Path;

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
