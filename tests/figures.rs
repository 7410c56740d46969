//! The papers' figures: what can be named, what is written, and that it has the same bits everywhere.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "helpers of tests are no tests to the lint")]

use drapery::figures::{self, Content, Figure, Scale, UNMADE};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::process::{Command, Output};

/// Calls the program in a folder.
fn called(folder: &std::path::Path, arguments: &[&str]) -> Output {
    let program = env!("CARGO_BIN_EXE_drapery");
    Command::new(program).arg("figures").args(arguments).current_dir(folder).output().unwrap()
}

fn figure(name: &str) -> &'static Figure {
    figures::chosen(&[name.to_owned()]).unwrap()[0]
}

#[test]
fn every_figure_has_a_name_of_its_own_that_begins_with_its_paper() {
    let names: BTreeSet<&str> = figures::all().map(|figure| figure.name).collect();
    assert_eq!(names.len(), figures::all().count());
    assert!(figures::all().all(|figure| figure.name.starts_with(figure.paper.name())));
    let told = |text: &str| text.ends_with('.') && !text.contains("  ");
    let silent: Vec<_> = figures::all().filter(|one| !told(one.caption) || !told(one.look_for)).collect();
    assert!(silent.is_empty(), "{:?}", silent.iter().map(|one| one.name).collect::<Vec<_>>());
    assert!(UNMADE.iter().all(|one| !one.what.is_empty() && !one.why.is_empty()));
}

#[test]
fn a_paper_is_all_of_its_figures_and_another_name_is_refused_with_the_nearest() {
    let she = figures::chosen(&["she".to_owned()]).unwrap();
    assert!(she.len() > 5 && she.iter().all(|figure| figure.name.starts_with("she-")));
    let error = figures::chosen(&["sh-13".to_owned()]).unwrap_err();
    assert!(error.to_string().contains("`sh-13`"));
    assert!(error.help_text().unwrap().contains("`she-13`"), "{error:?}");
}

/// Drawings of structures, a panel of pixels and a small landscape, with the hashes of their panels.
const KNOWN: [(&str, &[&str]); 6] = [
    ("taibo-8", &["8528052e6a680884", "2900a044af8fe646", "43dc30996d355857", "2e772ce1e2d33019"]),
    ("she-9", &["5f9d1836377e350b", "24dddf4b62bfe566", "ad4b865625d8b213"]),
    ("wartell-1", &["167fa93619a9ce77", "37d4e4eb2296cfa1", "7beb8f3618434ad1"]),
    ("schneider-klein-3", &["bbdcf9ecfe8ea8bf"]),
    ("zechmeister-2.14", &["3b84c554beb7e659", "88f73ccd9d5d27cd", "bceb394f4d746983", "e6c4dc2affda9409"]),
    ("she-13", &["0e5f224685a300f1", "0ed6d3ecfbf9fabe", "301794d679026f67", "77e86bea34287d07"]),
];

#[test]
fn small_figures_have_the_same_bits_on_every_machine() {
    for (name, hashes) in KNOWN {
        let panels = figure(name).panels(Scale::Small).unwrap();
        let found: Vec<String> = panels.iter().map(figures::hash).collect();
        let short: Vec<&str> = found.iter().map(|hash| &hash[..16]).collect();
        assert_eq!(short, hashes, "{name}");
    }
}

#[test]
fn drawings_are_whole_documents_without_numbers_that_are_none() {
    for name in ["taibo-8", "she-9", "she-5", "wartell-2", "schneider-klein-2", "zechmeister-2.12"] {
        for panel in figure(name).panels(Scale::Small).unwrap() {
            let Content::Drawing(svg) = &panel.content else { continue };
            assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"), "{name}");
            assert!(!svg.contains("NaN") && !svg.contains("inf "), "{name}: {}", panel.caption);
        }
    }
}

#[test]
fn figures_are_written_with_a_page_that_fetches_nothing_and_their_hashes() {
    let folder = tempfile::tempdir().unwrap();
    let output = called(folder.path(), &["taibo-4", "she-8", "-o", "out"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let read = |name: &str| fs::read_to_string(folder.path().join("out").join(name)).unwrap();
    let json: Value = serde_json::from_str(&read("figures.json")).unwrap();
    let panels = json["figures"].as_array().unwrap().iter().flat_map(|one| one["panels"].as_array().unwrap());
    let files: Vec<&str> = panels.map(|panel| panel["file"].as_str().unwrap()).collect();
    assert_eq!(files, ["taibo-4.svg", "she-8-a.svg", "she-8-b.svg"]);
    assert!(files.iter().all(|file| read(file).starts_with("<svg")));
    assert!(!json["unmade"].as_array().unwrap().is_empty());
    let page = read("figures.html");
    assert!(!page.contains("src=\"http") && !page.contains("<link") && !page.contains("<script"));
    assert!(page.contains("id=\"taibo-4\"") && page.contains("Look for: "));
}

#[test]
fn the_list_tells_what_there_is_and_what_is_not_made_and_a_wrong_name_writes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let output = called(folder.path(), &["taibo", "--list"]);
    let list = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success() && list.contains("taibo-8") && !list.contains("she-13"));
    assert!(list.contains("not made: taibo Figs. 11, 12"), "{list}");
    let output = called(folder.path(), &["she-99", "-o", "out"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(!folder.path().join("out").exists());
}
