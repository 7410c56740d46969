//! Violations that are planted, and texts that look like one.

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
    finds(
        "macro_rules! m { () => { use crate::{math, truth::{Budget, Truth}}; }; }",
        "drapery::truth::Truth",
    );
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
    finds_nothing(
        "pub(in crate::truth) fn f() {}\nmacro_rules! m { () => { pub(in crate::truth) fn g() {} }; }",
    );
    finds_nothing("use crate::{Error, Result}; fn f() -> crate::Result<()> { Err(crate::Error::new(\"\")) }");
    finds_nothing(
        "use crate::scene::{self, Layer}; use super::hit; fn f() { scene::all(); super::hit::new() }",
    );
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
    finds_nothing(
        "use std::process::ExitCode; use std::time::Duration; fn f(print: u8) -> bool { print != (1) }",
    );
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
fn a_head_and_the_files_of_its_folder_are_read_together_but_not_with_those_of_another() {
    let [lib, main] = ROOTS;
    let head = ("src/a/mod.rs", "mod b; pub struct A; fn a() { b::b(A) }");
    has_circles(&[lib, main, head, ("src/a/b.rs", "use super::A; pub fn b(a: A) {}")], &[]);
    let inner = ("src/a/b/mod.rs", "mod c; pub struct B; fn b() { super::d::d() }");
    let c = ("src/a/b/c.rs", "fn c() {}");
    let outer = ("src/a/mod.rs", "mod b; mod d;");
    has_circles(
        &[lib, main, outer, inner, c, ("src/a/d.rs", "use super::b::B; pub fn d() { B }")],
        &[&["src/a/b/mod.rs", "src/a/d.rs"]],
    );
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
    assert!(
        known.iter().any(|other| stands_on_what_it_may_not_know("src/visibility.rs", other)),
        "{known:?}"
    );
}
