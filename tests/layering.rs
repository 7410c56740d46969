//! The rooms of `src/` know one another only as `docs/architecture.md` allows, and no files stand on one another in a circle.
//!
//! The code is parsed (`house/`): a path counts wherever it stands and however it is written. What is compiled for tests alone is
//! left out. Each rule is tried on planted violations (`house/planted.rs`), so that the gate is known to close.

mod house;
#[path = "house/planted.rs"]
mod planted;

use house::{Code, House, circles, edges, module_of};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Each room and the rooms that may be known in it, from the bottom up (what anyone may use is not listed: [`ANYONE`]).
const MAY_KNOW: &[(&str, &[&str])] = &[
    ("error", &[]),
    ("math", &[]),
    ("buffer", &[]),
    ("parallel", &[]),
    // For tests alone.
    ("seeds", &[]),
    ("tiling", &[]),
    ("space", &[]),
    ("predicate", &["space"]),
    ("index", &["space", "parallel", "tiling"]),
    ("overlay", &["space", "predicate", "index", "parallel"]),
    ("crs", &["space"]),
    ("parameter", &[]),
    ("scene", &["space", "parameter", "buffer"]),
    ("terrain", &["scene", "space", "index", "parallel"]),
    ("draw_list", &["scene", "space", "overlay", "parallel"]),
    ("stage", &["draw_list", "terrain", "scene", "space"]),
    ("raster", &["terrain", "scene", "space", "predicate", "parallel"]),
    (
        "visibility",
        &["raster", "terrain", "scene", "space", "predicate", "index", "tiling", "parallel", "buffer"],
    ),
    ("resolve", &["terrain", "scene", "space", "buffer"]),
    ("decal", &["draw_list", "resolve", "scene", "space", "predicate", "index", "parallel", "parameter"]),
    // How uncertainty composes, not who decides: judges and what they judge may share it.
    ("certainty", &["resolve", "scene"]),
    (
        "canvas",
        &["visibility", "resolve", "raster", "terrain", "scene", "space", "tiling", "parallel", "buffer"],
    ),
    (
        "technique",
        &[
            "canvas",
            "decal",
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
            "overlay",
            "tiling",
            "parallel",
            "parameter",
            "buffer",
        ],
    ),
    // The techniques for their declarations.
    ("scene_file", &["technique", "scene", "space", "parameter"]),
    ("source", &["scene_file", "scene", "space", "overlay", "crs", "buffer", "parallel"]),
    ("output", &["buffer"]),
    ("interval", &[]),
    ("footprint", &["draw_list", "terrain", "scene", "space", "interval", "predicate", "index", "parallel"]),
    ("holding", &["footprint", "space"]),
    // No technique, and nothing that decides for one: neither `raster`, `visibility` nor `canvas`.
    (
        "truth",
        &[
            "footprint",
            "holding",
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
    ("compare", &["output", "buffer"]),
    // Of techniques their settings and what they refuse, never how they decide; of `canvas` the places of samples.
    (
        "allowed",
        &[
            "technique",
            "decal",
            "canvas",
            "truth",
            "footprint",
            "interval",
            "certainty",
            "resolve",
            "stage",
            "draw_list",
            "terrain",
            "parameter",
            "scene",
            "space",
            "predicate",
            "index",
            "tiling",
            "parallel",
            "compare",
            "buffer",
        ],
    ),
    (
        "golden",
        &[
            "allowed",
            "technique",
            "canvas",
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
            "holding",
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
            "canvas",
            "truth",
            "sampling",
            "visibility",
            "stage",
            "terrain",
            "scene",
            "space",
            "parameter",
            "compare",
            "output",
            "buffer",
        ],
    ),
    // Its tests draw with the imitated machine.
    ("calibrate", &["canvas", "scene", "parameter", "compare", "output", "buffer"]),
    (
        "export",
        &[
            "allowed",
            "measure",
            "technique",
            "canvas",
            "truth",
            "raster",
            // Colours of glTF are linear.
            "resolve",
            // The conformance set is scene files.
            "open",
            "scene_file",
            "stage",
            "draw_list",
            "terrain",
            "scene",
            "space",
            "parameter",
            "compare",
            "output",
            "buffer",
        ],
    ),
    (
        "report",
        &[
            "canvas",
            "open",
            "measure",
            "technique",
            "truth",
            "sampling",
            "resolve",
            "stage",
            "draw_list",
            "terrain",
            "scene_file",
            "scene",
            "space",
            "compare",
            "output",
            "parallel",
            "buffer",
        ],
    ),
    // Single pixels: what is there, as the truth and supersampling see it, and what techniques did.
    (
        "explain",
        &[
            "open",
            "measure",
            "technique",
            "canvas",
            "truth",
            "sampling",
            "holding",
            "footprint",
            "visibility",
            "resolve",
            "stage",
            "draw_list",
            "terrain",
            "scene_file",
            "scene",
            "space",
            "compare",
            "output",
            "parallel",
            "buffer",
        ],
    ),
    // Scenes of its own, drawn by every technique and the truth.
    (
        "figures",
        &[
            "open",
            "measure",
            "technique",
            "canvas",
            "truth",
            "stage",
            "draw_list",
            "terrain",
            "scene_file",
            "space",
            "compare",
            "output",
            "buffer",
        ],
    ),
    // Drafts of scenes, whoever draws and judges them.
    ("reduce", &["scene_file", "scene", "space"]),
    // The judge and what is shown to it: all that draws.
    (
        "judge_test",
        &[
            "technique",
            "canvas",
            "allowed",
            "report",
            "source",
            "scene_file",
            "stage",
            "scene",
            "space",
            "compare",
            "parallel",
            "buffer",
        ],
    ),
    // Scenes, and all that draws.
    (
        "hard_cases",
        &[
            "technique",
            "canvas",
            "truth",
            "source",
            "scene_file",
            // What a geodesic is.
            "crs",
            "stage",
            "scene",
            "space",
            "output",
            "parallel",
            "buffer",
        ],
    ),
    // Text alone.
    ("tutorial", &[]),
];
/// What anyone may use: the rooms at the crate's bottom, and the names that stand in the crate itself.
const ANYONE: &[&str] = &["error", "math", "Error", "Result", "Position"];

/// Files that may stand on one another, and why.
const CIRCLES: &[(&[&str], &str)] = &[];

/// Public functions that nothing in this repository but tests calls, and for whom they are.
const FOR_OTHERS: &[(&str, &str)] =
    &[("from_plane", "who judges buffers of a program of one's own makes pictures of them")];

/// Crates that some rooms alone may use: triangulations of points are the terrain's, those of polygons the room's that cuts polygons.
const OWNED: &[(&str, &[&str])] =
    &[("rayon", &["parallel"]), ("spade", &["terrain", "overlay"]), ("exr", &["compare"])];

/// Ends of paths that only the command line may call: output, an exit, a clock.
const ONLY_THE_COMMAND_LINE: &[&str] = &[
    "print!",
    "println!",
    "eprint!",
    "eprintln!",
    "dbg!",
    "io::stdout",
    "io::stderr",
    "process::exit",
    "process::abort",
    "process::*",
    "Instant::now",
    "SystemTime::now",
];

fn repository() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn house() -> House {
    House::read(repository())
}

/// Runs a rule over all of the crate's own files.
fn everywhere(rule: &dyn Fn(&str, &Code) -> Vec<String>) -> Vec<String> {
    house().files.iter().flat_map(|(file, code)| rule(file, code)).collect()
}

/// Whether something in room `room` may know what is called `name` in the crate.
fn may_know(room: &str, name: &str) -> bool {
    let row = MAY_KNOW.iter().find(|(known, _)| *known == room);
    name == room || ANYONE.contains(&name) || row.is_some_and(|(_, allowed)| allowed.contains(&name))
}

/// The room of a file of the library; none of `lib.rs`, which names all rooms, and of the program, which may know them all.
fn room(file: &str) -> Option<String> {
    let module = module_of(file);
    (module[0] == "drapery").then(|| module.get(1).cloned())?
}

/// The technique whose folder a file is in.
fn technique(file: &str) -> Option<String> {
    match &module_of(file)[..] {
        [krate, room, name, ..] if krate == "drapery" && room == "technique" && is_technique(name) => {
            Some(name.clone())
        }
        _ => None,
    }
}

/// Techniques are the folders in `src/technique/`; files beside them are what they have in common.
fn is_technique(name: &str) -> bool {
    repository().join("src/technique").join(name).is_dir()
}

/// Where a file leads into a room that it may not know.
fn other_rooms(file: &str, code: &Code) -> Vec<String> {
    let Some(room) = room(file) else { return Vec::new() };
    let leads_out = |path: &[String]| match path {
        [own, name, ..] => own == "drapery" && !may_know(&room, name),
        _ => false,
    };
    found(file, code, &leads_out)
}

/// Where a technique leads into another, or into all of them.
fn other_techniques(file: &str, code: &Code) -> Vec<String> {
    let Some(own) = technique(file) else { return Vec::new() };
    let leads_over = |path: &[String]| match path {
        [krate, room, name, ..] if krate == "drapery" && room == "technique" => {
            *name != own && (is_technique(name) || name == "*")
        }
        _ => false,
    };
    found(file, code, &leads_over)
}

/// Where a file calls what is another's alone: output, exits and clocks the command line's, threads and some crates a room's.
fn outside_world(file: &str, code: &Code) -> Vec<String> {
    let room = room(file);
    let is_program = module_of(file)[0] == "main";
    let is_wrong = |path: &[String]| {
        let ends = |end: &&str| {
            let end: Vec<&str> = end.split("::").collect();
            path.len() >= end.len() && path[path.len() - end.len()..] == end[..]
        };
        let owners = OWNED.iter().find(|(name, _)| path[0] == *name).map(|(_, owners)| *owners);
        let is_thread = path.len() > 1 && path[..2] == ["std", "thread"];
        let owners = owners.or(is_thread.then_some(&["parallel"]));
        owners.is_some_and(|owners| !room.as_deref().is_some_and(|room| owners.contains(&room)))
            || (!is_program && ONLY_THE_COMMAND_LINE.iter().any(ends))
    };
    found(file, code, &is_wrong)
}

fn found(file: &str, code: &Code, is_wrong: &dyn Fn(&[String]) -> bool) -> Vec<String> {
    let wrong = code.mentions.iter().filter(|mention| is_wrong(&mention.path));
    wrong.map(|mention| format!("{file}:{} knows {}", mention.line, mention.path.join("::"))).collect()
}

/// Everything that is wrong with a file of this name and text.
fn violations(file: &str, text: &str) -> Vec<String> {
    let code = Code::of(&module_of(file), text).unwrap();
    [other_rooms(file, &code), other_techniques(file, &code), outside_world(file, &code)].concat()
}

#[test]
fn each_room_knows_only_the_rooms_below_it() {
    let wrong = everywhere(&other_rooms);
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn techniques_do_not_know_one_another() {
    let wrong = everywhere(&other_techniques);
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn only_the_command_line_prints_exits_or_reads_a_clock_and_only_parallel_uses_threads() {
    let wrong = everywhere(&outside_world);
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Names that a room passes on from another are followed to where they are defined.
fn stands_on_what_it_may_not_know(file: &str, other: &str) -> bool {
    let (Some(own), Some(known)) = (room(file), room(other)) else { return false };
    let techniques = (technique(file), technique(other));
    !may_know(&own, &known) || matches!(techniques, (Some(own), Some(known)) if own != known)
}

#[test]
fn nothing_is_fetched_through_a_room_that_passes_it_on() {
    let edges = edges(&house());
    let all = edges.iter().flat_map(|(file, others)| others.iter().map(move |other| (file, other)));
    let wrong: Vec<_> = all.filter(|(file, other)| stands_on_what_it_may_not_know(file, other)).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn no_files_stand_on_one_another_but_those_that_have_a_reason() {
    let edges = edges(&house());
    let found = circles(&edges);
    let excused: Vec<&[&str]> = CIRCLES.iter().map(|(files, _)| *files).collect();
    let new: Vec<_> = found.iter().filter(|circle| !excused.iter().any(|files| circle == files)).collect();
    let links = |circle: &Vec<String>| -> Vec<String> {
        let of = |file: &String| {
            let others: Vec<_> = edges[file].iter().filter(|other| circle.contains(other)).collect();
            format!("{file} on {others:?}")
        };
        circle.iter().map(of).collect()
    };
    let told: Vec<_> = new.into_iter().map(links).collect();
    assert!(told.is_empty(), "these files stand on one another: {told:#?}");
    let gone: Vec<_> = excused.iter().filter(|files| !found.iter().any(|circle| circle == *files)).collect();
    assert!(gone.is_empty(), "open by now, take them from the list: {gone:#?}");
}

#[test]
fn every_file_is_a_module_of_the_crate() {
    assert_eq!(house().strays(repository()), [""; 0]);
}

/// Every use of each name in the crate, and in what else is built on it.
fn callers() -> BTreeMap<String, i64> {
    let mut all = BTreeMap::new();
    let mut count = |code: &Code| {
        code.names.iter().for_each(|(name, times)| *all.entry(name.clone()).or_default() += times);
    };
    house().files.values().for_each(&mut count);
    for folder in ["benches", "examples"] {
        let paths =
            std::fs::read_dir(repository().join(folder)).into_iter().flatten().flatten().map(|e| e.path());
        for path in paths.filter(|path| path.extension().is_some_and(|end| end == "rs")) {
            let text = std::fs::read_to_string(path).unwrap();
            count(&Code::of(&["program".into()], &text).unwrap());
        }
    }
    all
}

#[test]
fn every_public_function_has_a_caller() {
    let callers = callers();
    let is_idle = |name: &String| callers.get(name).is_none_or(|times| *times == 0);
    let idle = everywhere(&|file, code| {
        let idle = code.functions.iter().filter(|(name, _)| is_idle(name));
        let unknown = idle.filter(|(name, _)| !FOR_OTHERS.iter().any(|(known, _)| known == name));
        unknown.map(|(name, line)| format!("{file}:{line} {name}")).collect()
    });
    assert!(idle.is_empty(), "nobody calls these: {idle:#?}");
    let called = FOR_OTHERS.iter().filter(|(name, _)| !is_idle(&(*name).to_owned()));
    assert_eq!(called.count(), 0, "take from the list what is called by now");
}

/// The rooms that `src/` has: its folders and files, without the two that the compiler begins with.
fn rooms_of_the_folder() -> BTreeSet<String> {
    let names = std::fs::read_dir(repository().join("src")).unwrap().flatten();
    let stem = |name: std::ffi::OsString| name.to_string_lossy().trim_end_matches(".rs").to_owned();
    names.map(|entry| stem(entry.file_name())).filter(|name| name != "lib" && name != "main").collect()
}

/// The rows of the table in `docs/architecture.md`: rooms, and who may be known.
fn documented_rows() -> Vec<(Vec<String>, String)> {
    let text = std::fs::read_to_string(repository().join("docs/architecture.md")).unwrap();
    let table = text.lines().skip_while(|line| !line.starts_with("| room |")).skip(2);
    let row = |line: &str| {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let names = cells[0].split('`').skip(1).step_by(2);
        let room = |path: &str| path.split('/').next().unwrap().trim_end_matches(".rs").to_owned();
        (names.map(room).collect(), cells[cells.len() - 1].to_owned())
    };
    table.take_while(|line| line.starts_with('|')).map(row).collect()
}

#[test]
fn every_room_has_a_row_in_both_tables_and_no_row_is_without_a_room() {
    let rooms = rooms_of_the_folder();
    let in_the_test = MAY_KNOW.iter().map(|(room, _)| (*room).to_owned());
    // The command line may know everything, and has no row here.
    assert_eq!(in_the_test.chain(["cli".to_owned()]).collect::<BTreeSet<_>>(), rooms);
    let documented = documented_rows().into_iter().flat_map(|(rooms, _)| rooms);
    assert_eq!(documented.collect::<BTreeSet<_>>(), rooms, "docs/architecture.md");
}

#[test]
fn the_table_that_people_read_allows_nothing_that_this_one_forbids() {
    for (rooms, known) in documented_rows() {
        let words = known.split(|sign: char| !sign.is_alphanumeric() && sign != '_');
        for name in words.filter(|word| MAY_KNOW.iter().any(|(room, _)| room == word)) {
            assert!(rooms.iter().all(|room| may_know(room, name)), "{rooms:?} and {name}");
        }
    }
}

#[test]
fn every_room_stands_above_those_that_it_may_know() {
    for (at, (room, known)) in MAY_KNOW.iter().enumerate() {
        let below: Vec<&str> = MAY_KNOW[..at].iter().map(|(room, _)| *room).collect();
        assert!(known.iter().all(|name| below.contains(name)), "{room}");
    }
}
