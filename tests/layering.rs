//! The rooms of `src/` know one another only as `docs/architecture.md` allows, and no files stand on one another in a circle.
//!
//! The code is parsed (`house/`): a path counts wherever it stands and however it is written. What is compiled for tests alone is
//! left out. Each rule is tried on planted violations (`planted` below), so that the gate is known to close.

mod house;

use house::{Code, House, circles, edges, module_of};
use std::collections::BTreeSet;
use std::path::Path;

/// Each room and the rooms that may be known in it, from the bottom up (what anyone may use is not listed: [`ANYONE`]).
const MAY_KNOW: &[(&str, &[&str])] = &[
    ("error", &[]),
    ("math", &[]),
    ("buffer", &[]),
    ("parallel", &[]),
    ("space", &[]),
    ("predicate", &["space"]),
    ("crs", &["space"]),
    ("scene", &["space", "buffer"]),
    ("source", &["scene", "space", "crs", "buffer", "parallel"]),
    ("terrain", &["scene", "space", "parallel"]),
    ("stage", &["terrain", "scene", "space"]),
    ("raster", &["terrain", "scene", "space", "predicate", "parallel"]),
    ("visibility", &["raster", "terrain", "scene", "space", "predicate", "parallel", "buffer"]),
    ("resolve", &["terrain", "scene", "space", "buffer"]),
    (
        "technique",
        &[
            "visibility",
            "resolve",
            "raster",
            "stage",
            "terrain",
            "scene",
            "space",
            "predicate",
            "parallel",
            "buffer",
        ],
    ),
    ("output", &["buffer"]),
    ("interval", &[]),
    ("footprint", &["scene", "space", "interval", "predicate", "parallel"]),
    // No technique, and nothing that decides for one: neither `raster` nor `visibility`.
    (
        "truth",
        &[
            "footprint",
            "interval",
            "resolve",
            "stage",
            "terrain",
            "scene",
            "space",
            "predicate",
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
            "visibility",
            "footprint",
            "resolve",
            "raster",
            "stage",
            "terrain",
            "scene",
            "space",
            "parallel",
            "buffer",
        ],
    ),
    ("export", &["raster", "terrain", "scene", "space", "output", "buffer"]),
    ("report", &["truth", "technique", "compare", "output", "buffer"]),
];
/// What anyone may use: the rooms at the crate's bottom, and the names that stand in the crate itself.
const ANYONE: &[&str] = &["error", "math", "Error", "Result", "Position"];

/// Files that may stand on one another, and why.
const CIRCLES: &[(&[&str], &str)] = &[
    (
        &["src/crs/mod.rs", "src/crs/wkt.rs"],
        "`Crs::parse` reads WKT, and WKT may name a code or hold a PROJ string, which `Crs` reads",
    ),
    (
        &[
            "src/technique/stencil_volume/frame.rs",
            "src/technique/stencil_volume/tile.rs",
            "src/technique/stencil_volume/tile/fragments.rs",
            "src/technique/stencil_volume/tile/points.rs",
        ],
        "is opened with the room for a frame's tiles",
    ),
];

/// Crates that one room alone may use.
const OWNED: &[(&str, &str)] = &[("rayon", "parallel"), ("spade", "terrain"), ("exr", "compare")];

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
    let module = module_of(file);
    (module[..2] == ["drapery", "technique"]).then(|| module.get(2).cloned())?.filter(|name| is_technique(name))
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
        let owner = OWNED.iter().find(|(name, _)| path[0] == *name).map(|(_, owner)| *owner);
        let is_thread = path.len() > 1 && path[..2] == ["std", "thread"];
        let owner = owner.or(is_thread.then_some("parallel"));
        owner.is_some_and(|owner| room.as_deref() != Some(owner))
            || (!is_program && ONLY_THE_COMMAND_LINE.iter().any(|end| ends(end)))
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
    let found = circles(&edges(&house()));
    let excused: Vec<&[&str]> = CIRCLES.iter().map(|(files, _)| *files).collect();
    let new: Vec<_> = found.iter().filter(|circle| !excused.iter().any(|files| circle == files)).collect();
    assert!(new.is_empty(), "circles of files: {new:#?}");
    let gone: Vec<_> = excused.iter().filter(|files| !found.iter().any(|circle| circle == *files)).collect();
    assert!(gone.is_empty(), "open by now, take them from the list: {gone:#?}");
}

#[test]
fn every_file_is_a_module_of_the_crate() {
    assert_eq!(house().strays(repository()), [""; 0]);
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

/// Violations that are planted, and texts that look like one.
mod planted {
    use super::{House, circles, edges, stands_on_what_it_may_not_know, violations};

    /// What [`violations`] finds in a file of `visibility`, which may not know `truth`.
    fn in_visibility(text: &str) -> Vec<String> {
        violations("src/visibility/sight.rs", text)
    }

    #[track_caller]
    fn finds(text: &str, wanted: &str) {
        let found = in_visibility(text);
        assert!(found.iter().any(|line| line.ends_with(wanted)), "{found:?} in {text}");
    }

    #[track_caller]
    fn finds_nothing(text: &str) {
        assert_eq!(in_visibility(text), [""; 0], "{text}");
    }

    #[test]
    fn a_forbidden_import_is_found_and_its_line_told() {
        let found = in_visibility("//! Text.\n\nuse crate::truth::Budget;\n");
        assert_eq!(found, ["src/visibility/sight.rs:3 knows drapery::truth::Budget"]);
    }

    #[test]
    fn a_forbidden_import_is_found_after_a_module_of_tests() {
        finds("#[cfg(test)]\nmod tests { use super::*; }\nuse crate::truth::Budget;", "drapery::truth::Budget");
        finds("#[cfg(test)]\nmod tests;\nfn f() { crate::truth::certify(); }", "drapery::truth::certify");
    }

    #[test]
    fn a_forbidden_import_is_found_in_groups_and_under_other_names() {
        finds("use crate::{math, truth};", "drapery::truth");
        finds("use crate::{math::{self, max}, truth::{Budget, color::Mean}};", "drapery::truth::color::Mean");
        finds("use crate::truth as scene;", "drapery::truth");
        finds("use crate::truth::{self as scene};", "drapery::truth");
        finds("use crate::truth::*;", "drapery::truth::*");
        finds("pub use crate::truth::Truth;", "drapery::truth::Truth");
        finds("use crate::*;", "drapery::*");
        finds("use super::super::*;", "drapery::*");
    }

    #[test]
    fn a_forbidden_room_is_found_behind_a_name_for_the_crate() {
        finds("use crate as house; use house::truth::Budget;", "drapery::truth::Budget");
        finds("use crate::{self as house}; fn f() { house::truth::certify(); }", "drapery::truth::certify");
        finds("use super::super as up; type T = up::truth::Truth;", "drapery::truth::Truth");
        finds("extern crate self as drapery; use drapery::truth::Truth;", "drapery::truth::Truth");
    }

    #[test]
    fn a_forbidden_room_is_found_by_way_of_super() {
        finds("use super::super::truth::Budget;", "drapery::truth::Budget");
        finds("use self::super::super::truth::Budget;", "drapery::truth::Budget");
        finds("mod inner { use super::super::super::truth::Budget; }", "drapery::truth::Budget");
        let found = violations("src/visibility/mod.rs", "use super::truth::Budget;");
        assert_eq!(found, ["src/visibility/mod.rs:1 knows drapery::truth::Budget"]);
        let found = violations("src/visibility/device/deep.rs", "use super::super::super::truth::Budget;");
        assert_eq!(found.len(), 1);
    }

    #[test]
    fn a_forbidden_room_is_found_in_expressions_types_and_patterns() {
        finds("fn f() -> u32 { crate::truth::NAME.len() as u32 }", "drapery::truth::NAME");
        finds("struct S { t: Vec<Option<crate::truth::Truth>> }", "drapery::truth::Truth");
        finds("impl crate::truth::Judge for S {}", "drapery::truth::Judge");
        finds("fn f(x: &dyn Fn(crate::truth::Truth)) {}", "drapery::truth::Truth");
        finds("fn f() { <crate::truth::Truth>::new() }", "drapery::truth::Truth");
        finds("fn f() { <u8 as crate::truth::Judge>::judge() }", "drapery::truth::Judge::judge");
        finds("fn f(x: X) { let crate::truth::Tally { .. } = x; }", "drapery::truth::Tally");
        finds("fn f() { use crate::truth::Budget; }", "drapery::truth::Budget");
    }

    #[test]
    fn a_forbidden_room_is_found_in_macros_and_attributes() {
        finds("fn f() { format!(\"{}\", crate::truth::NAME) }", "drapery::truth::NAME");
        finds("fn f() { vec![(1, super::super::truth::certify())] }", "drapery::truth::certify");
        finds("macro_rules! m { ($t:ty) => { impl $t { fn f() { crate::truth::certify() } } }; }", "::certify");
        finds("macro_rules! m { () => { use crate::{math, truth::{Budget, Truth}}; }; }", "drapery::truth::Truth");
        finds("macro_rules! m { () => { $crate::truth::certify() }; }", "drapery::truth::certify");
        finds("#[derive(crate::truth::Certified)] struct S;", "drapery::truth::Certified");
        finds("crate::truth::declare! { a }", "drapery::truth::declare!");
        finds("fn f() { for x in crate::truth::all() { g!(for y in (in crate::truth::some())) } }", "::some");
    }

    #[test]
    fn what_only_looks_like_an_import_is_harmless() {
        finds_nothing("// use crate::truth::Budget;\n/* crate::truth */ use crate::math::max;");
        finds_nothing("//! [`Truth`]: crate::truth::Truth\n\n/// As [`crate::truth::certify`].\nfn f() {}");
        finds_nothing("const A: &str = \"use crate::truth::Budget;\"; const B: &str = r#\"crate::truth::x\"#;");
        finds_nothing("fn f() { format!(\"crate::truth::{}\", 1) }");
        finds_nothing("pub(in crate::truth) fn f() {}\nmacro_rules! m { () => { pub(in crate::truth) fn g() {} }; }");
        finds_nothing("use crate::{Error, Result}; fn f() -> crate::Result<()> { Err(crate::Error::new(\"\")) }");
        finds_nothing("use crate::scene::{self, Layer}; use super::hit; fn f() { scene::all(); super::hit::new() }");
        finds_nothing("mod truth { pub fn f() {} } fn g() { truth::f(); self::truth::f() }");
    }

    #[test]
    fn what_only_tests_are_made_of_may_know_anything() {
        finds_nothing("#[cfg(test)]\nmod tests { use crate::truth::Budget; fn f() { println!(); } }");
        finds_nothing("#[cfg(test)]\nuse crate::truth::Budget;\n#[cfg(test)]\nfn f() { crate::truth::f() }");
        finds_nothing("impl S { #[cfg(test)] fn f() { crate::truth::f() } }");
        finds_nothing("#[cfg(all(test, unix))]\nmod tests { use crate::truth::Budget; }");
        finds_nothing("#![cfg(test)]\nuse crate::truth::Budget;");
        finds("#[cfg(any(test, unix))]\nuse crate::truth::Budget;", "drapery::truth::Budget");
        finds("#[cfg(not(test))]\nuse crate::truth::Budget;", "drapery::truth::Budget");
    }

    #[test]
    fn a_technique_that_knows_another_is_found() {
        let in_clipmap = |text: &str| violations("src/technique/clipmap/frame.rs", text);
        for text in [
            "use super::super::inverse_projection;",
            "use crate::technique::{Frame, inverse_projection::Prepare};",
            "fn f() { crate::technique::stencil_volume::applies(stage) }",
            "use super::super as techniques; fn f() { techniques::stencil_volume::applies(stage) }",
            "use crate::technique::*;",
        ] {
            assert_eq!(in_clipmap(text).len(), 1, "{text}");
        }
        let beside = violations("src/technique/clipmap/mod.rs", "use super::stencil_volume::Prepare;");
        assert_eq!(beside.len(), 1);
        for text in ["use crate::technique::{Frame, clipmap::tile};", "use super::tile::Tile;"] {
            assert_eq!(in_clipmap(text), [""; 0], "{text}");
        }
    }

    #[test]
    fn output_exits_clocks_threads_and_crates_of_one_room_are_found() {
        finds("fn f() { println!(\"a\") }", "println!");
        finds("fn f() { m!(a, { eprintln!(\"a\") }) }", "eprintln!");
        finds("fn f() { std::process::exit(1) }", "std::process::exit");
        finds("use std::process::exit as leave; fn f() { leave(1) }", "std::process::exit");
        finds("use std::process; fn f() { process::abort() }", "std::process::abort");
        finds("use std::time::Instant as Watch; fn f() { Watch::now(); }", "std::time::Instant::now");
        finds("use rayon::prelude::*;", "rayon::prelude::*");
        finds("fn f() { std::thread::spawn(|| ()) }", "std::thread::spawn");
        finds("use spade::Triangulation;", "spade::Triangulation");
        finds_nothing("// println!(a)\nfn f() { let _ = \"process::exit println! rayon::\"; }");
        finds_nothing("use std::process::ExitCode; use std::time::Duration; fn f(print: u8) -> bool { print != (1) }");
        assert_eq!(violations("src/cli/info.rs", "fn f() { println!(); std::process::exit(1) }"), [""; 0]);
        assert_eq!(violations("src/parallel.rs", "use rayon::prelude::*;"), [""; 0]);
    }

    fn house(files: &[(&str, &str)]) -> House {
        House::of(&|name| files.iter().find(|(file, _)| *file == name).map(|(_, text)| (*text).to_owned()))
    }

    #[track_caller]
    fn has_circles(files: &[(&str, &str)], wanted: &[&[&str]]) {
        assert_eq!(circles(&edges(&house(files))), wanted);
    }

    const ROOTS: [(&str, &str); 2] = [("src/lib.rs", "mod a;"), ("src/main.rs", "fn main() {}")];

    #[test]
    fn files_that_stand_on_one_another_are_found() {
        let [lib, main] = ROOTS;
        let head = ("src/a/mod.rs", "mod b; mod c; mod d;");
        let d = ("src/a/d.rs", "use super::b::B; fn d() -> B { B }");
        let b = ("src/a/b.rs", "use super::c::c; pub struct B; fn b() { c() }");
        has_circles(
            &[lib, main, head, b, d, ("src/a/c.rs", "pub fn c() { super::b::B; }")],
            &[&["src/a/b.rs", "src/a/c.rs"]],
        );
        has_circles(
            &[lib, main, head, b, d, ("src/a/c.rs", "pub fn c() { m!(super::d::d()) }")],
            &[&["src/a/b.rs", "src/a/c.rs", "src/a/d.rs"]],
        );
        has_circles(&[lib, main, head, b, d, ("src/a/c.rs", "pub fn c() {}")], &[]);
    }

    #[test]
    fn a_file_that_takes_what_is_defined_in_the_head_of_its_folder_stands_on_it() {
        let [lib, main] = ROOTS;
        let head = ("src/a/mod.rs", "mod b; pub struct A; fn a() { b::b(A) }");
        has_circles(
            &[lib, main, head, ("src/a/b.rs", "use super::A; pub fn b(a: A) {}")],
            &[&["src/a/b.rs", "src/a/mod.rs"]],
        );
        has_circles(&[lib, main, head, ("src/a/b.rs", "pub fn b(a: u8) {}")], &[]);
    }

    #[test]
    fn a_head_that_only_passes_names_on_is_in_no_circle_and_names_are_followed_through_it() {
        let [lib, main] = ROOTS;
        let head = ("src/a/mod.rs", "mod b; mod c; pub use b::B; pub use c::*;");
        let b = ("src/a/b.rs", "pub struct B; fn b() { super::C::new() }");
        has_circles(
            &[lib, main, head, b, ("src/a/c.rs", "use super::B; pub struct C; fn c(b: B) {}")],
            &[&["src/a/b.rs", "src/a/c.rs"]],
        );
        has_circles(&[lib, main, head, b, ("src/a/c.rs", "pub struct C;")], &[]);
    }

    #[test]
    fn tests_close_no_circle() {
        let [lib, main] = ROOTS;
        let head = ("src/a/mod.rs", "mod b; mod c; #[cfg(test)] mod tests;");
        let c = ("src/a/c.rs", "pub fn c() {} #[cfg(test)] mod tests { use super::super::b::b; }");
        let tests = ("src/a/tests.rs", "use super::b; mod deeper;");
        let deeper = ("src/a/tests/deeper.rs", "fn f() { crate::a::b::b() }");
        let b = ("src/a/b.rs", "pub fn b() { super::c::c() }");
        let files = [lib, main, head, b, c, tests, deeper];
        has_circles(&files, &[]);
        let is_test: Vec<_> = house(&files).tests.into_iter().collect();
        assert_eq!(is_test, ["src/a/tests.rs", "src/a/tests/deeper.rs"]);
    }

    #[test]
    fn a_name_that_is_fetched_through_another_room_is_found() {
        let files = [
            ("src/lib.rs", "mod scene; mod truth; mod visibility;"),
            ("src/main.rs", "fn main() {}"),
            ("src/scene.rs", "pub use crate::truth::Truth;"),
            ("src/truth.rs", "pub struct Truth;"),
            ("src/visibility.rs", "use crate::scene::Truth; fn f(t: Truth) {}"),
        ];
        let edges = edges(&house(&files));
        let known = &edges["src/visibility.rs"];
        assert!(known.iter().any(|other| stands_on_what_it_may_not_know("src/visibility.rs", other)), "{known:?}");
    }
}
