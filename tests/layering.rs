//! The rooms of `src/` know one another only as `docs/architecture.md` allows.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Each room and the rooms whose names may stand in its `use crate::` lines (rooms at the crate's bottom that anyone may
/// use are not listed: `error`, `math`, `Result`, `Error`, `Position`).
const MAY_KNOW: &[(&str, &[&str])] = &[
    ("error", &[]),
    ("math", &[]),
    ("buffer", &[]),
    ("parallel", &[]),
    ("tiling", &[]),
    ("space", &[]),
    ("predicate", &["space"]),
    ("index", &["space", "parallel", "tiling"]),
    ("crs", &["space"]),
    ("parameter", &[]),
    ("scene", &["space", "parameter", "buffer"]),
    // The techniques for their declarations.
    ("scene_file", &["technique", "scene", "space", "parameter"]),
    ("source", &["scene_file", "scene", "space", "crs", "buffer", "parallel"]),
    ("terrain", &["scene", "space", "index", "parallel"]),
    ("draw_list", &["scene", "space", "parallel"]),
    ("stage", &["draw_list", "terrain", "scene", "space"]),
    ("raster", &["terrain", "scene", "space", "predicate", "parallel"]),
    (
        "visibility",
        &["raster", "terrain", "scene", "space", "predicate", "index", "tiling", "parallel", "buffer"],
    ),
    ("resolve", &["terrain", "scene", "space", "buffer"]),
    // How uncertainty composes, not who decides: judges and what they judge may share it.
    ("certainty", &["resolve", "scene"]),
    ("canvas", &["visibility", "resolve", "raster", "terrain", "scene", "space", "parallel", "buffer"]),
    (
        "technique",
        &[
            "canvas",
            "visibility",
            "resolve",
            "raster",
            "stage",
            "draw_list",
            "terrain",
            "scene",
            "space",
            "predicate",
            "index",
            "tiling",
            "parallel",
            "parameter",
            "buffer",
        ],
    ),
    ("output", &["buffer"]),
    ("interval", &[]),
    ("footprint", &["draw_list", "terrain", "scene", "space", "interval", "predicate", "index", "parallel"]),
    // No technique, and nothing that decides for one: neither `raster`, `visibility` nor `canvas`.
    (
        "truth",
        &[
            "footprint",
            "interval",
            "certainty",
            "resolve",
            "stage",
            "draw_list",
            "terrain",
            "scene",
            "space",
            "predicate",
            "index",
            "tiling",
            "parallel",
            "buffer",
        ],
    ),
    ("compare", &["buffer"]),
    (
        "golden",
        &[
            "technique",
            "truth",
            "visibility",
            "source",
            "scene_file",
            "stage",
            "scene",
            "space",
            "compare",
            "output",
            "parallel",
            "buffer",
        ],
    ),
    (
        "sampling",
        &[
            "canvas",
            "visibility",
            "footprint",
            "resolve",
            "raster",
            "stage",
            "draw_list",
            "terrain",
            "scene",
            "space",
            "tiling",
            "parallel",
            "buffer",
        ],
    ),
    ("open", &["source", "scene_file", "stage", "space"]),
    (
        "measure",
        &[
            "technique",
            "truth",
            "sampling",
            "visibility",
            "stage",
            "scene",
            "space",
            "parameter",
            "compare",
            "output",
            "buffer",
        ],
    ),
    (
        "export",
        &[
            "measure",
            "technique",
            "truth",
            "raster",
            "stage",
            "draw_list",
            "terrain",
            "scene",
            "space",
            "parameter",
            "output",
            "buffer",
        ],
    ),
    (
        "report",
        &[
            "open",
            "measure",
            "technique",
            "truth",
            "sampling",
            "resolve",
            "stage",
            "draw_list",
            "scene_file",
            "scene",
            "space",
            "compare",
            "output",
            "buffer",
        ],
    ),
    ("tutorial", &[]),
];
const ANYONE: &[&str] = &["error", "math", "Error", "Result", "Position"];

fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap().flatten() {
        let path = entry.path();
        if path.is_dir() {
            found.extend(files(&path));
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
    found
}

/// The room of a file: the first part of its path below `src/`.
fn room(path: &Path, source: &Path) -> String {
    let first = path.strip_prefix(source).unwrap().iter().next().unwrap();
    Path::new(first).file_stem().unwrap().to_string_lossy().into_owned()
}

/// The first names after `crate::` anywhere in the code (tests excepted).
fn known(text: &str) -> BTreeSet<String> {
    let code = text.split("#[cfg(test)]\nmod ").next().unwrap();
    let lines = code.lines().filter(|l| !l.trim_start().starts_with("//"));
    let mut names = BTreeSet::new();
    for line in lines {
        for rest in line.split("crate::").skip(1) {
            let name: String = rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
            names.insert(name);
        }
    }
    names.remove("");
    names
}

#[test]
fn each_room_knows_only_the_rooms_below_it() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut wrong = Vec::new();
    for file in files(&source) {
        let room = room(&file, &source);
        if ["lib", "main", "cli"].contains(&room.as_str()) || file.ends_with("tests.rs") {
            continue;
        }
        let Some((_, allowed)) = MAY_KNOW.iter().find(|(name, _)| *name == room) else {
            wrong.push(format!("src/{room} is in no row of the table"));
            continue;
        };
        for name in known(&std::fs::read_to_string(&file).unwrap()) {
            if name != room && !allowed.contains(&name.as_str()) && !ANYONE.contains(&name.as_str()) {
                wrong.push(format!("{} knows crate::{name}", file.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn techniques_do_not_know_one_another() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/technique");
    for file in files(&source).into_iter().filter(|f| f.parent() != Some(&source)) {
        let own = room(&file, &source);
        let text = std::fs::read_to_string(&file).unwrap();
        for rest in text.split("technique::").skip(1) {
            let name: String = rest.chars().take_while(|c| c.is_lowercase() || *c == '_').collect();
            let is_technique = source.join(&name).is_dir() && !name.is_empty();
            assert!(!is_technique || name == own, "{} knows {name}", file.display());
        }
    }
}

#[test]
fn only_the_command_line_prints_exits_or_reads_a_clock_and_only_parallel_uses_threads() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    for file in files(&source) {
        let room = room(&file, &source);
        let text = std::fs::read_to_string(&file).unwrap();
        let code: String = text.lines().filter(|l| !l.trim_start().starts_with("//")).collect();
        let is_command_line = ["cli", "main"].contains(&room.as_str());
        for word in ["process::exit", "println!", "Instant::now"] {
            assert!(is_command_line || !code.contains(word), "{} uses {word}", file.display());
        }
        assert!(room == "parallel" || !code.contains("rayon::"), "{} uses rayon", file.display());
    }
}
