//! What the pages say of files and commands is so.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// `README.md` and the pages of `docs/`, with their texts.
fn pages() -> Vec<(PathBuf, String)> {
    let docs = std::fs::read_dir(root().join("docs")).unwrap().map(|entry| entry.unwrap().path());
    let pages =
        docs.filter(|path| path.extension().is_some_and(|e| e == "md")).chain([root().join("README.md")]);
    pages.map(|path| (path.clone(), std::fs::read_to_string(&path).unwrap())).collect()
}

/// The targets of `[words](target)` and `![words](target)`.
fn links(text: &str) -> Vec<&str> {
    text.split("](").skip(1).filter_map(|rest| rest.split(')').next()).collect()
}

/// The anchors of a page: its headings as web pages have them.
fn anchors(text: &str) -> BTreeSet<String> {
    let headings =
        text.lines().filter(|line| line.starts_with('#')).map(|line| line.trim_start_matches('#').trim());
    let kept = |c: char| c.is_alphanumeric() || c == '-' || c == ' ' || c == '_';
    headings
        .map(|h| h.to_lowercase().chars().filter(|c| kept(*c)).collect::<String>().replace(' ', "-"))
        .collect()
}

/// The relative links of a page that lead nowhere.
fn broken(page: &Path, text: &str) -> Vec<String> {
    let leads = |link: &&str| {
        let (path, anchor) = link.split_once('#').unwrap_or((link, ""));
        let target = if path.is_empty() { page.to_owned() } else { page.parent().unwrap().join(path) };
        let has_anchor = || anchors(&std::fs::read_to_string(&target).unwrap_or_default()).contains(anchor);
        target.exists() && (anchor.is_empty() || has_anchor())
    };
    let relative = links(text).into_iter().filter(|link| !link.contains("://"));
    relative.filter(|link| !leads(link)).map(|link| format!("{}: {link}", page.display())).collect()
}

/// The paths of this repository that a text names between backticks, up to a file's extension or a folder's slash.
fn named_paths(text: &str) -> Vec<&str> {
    let folders = ["src/", "tests/", "benches/", "examples/", "docs/", "golden/"];
    let quoted = text.split('`').skip(1).step_by(2);
    let plain = |word: &&str| word.chars().all(|c| c.is_alphanumeric() || "/._-".contains(c));
    quoted.filter(|word| folders.iter().any(|folder| word.starts_with(folder))).filter(plain).collect()
}

#[test]
fn every_relative_link_leads_somewhere() {
    let all: Vec<String> = pages().iter().flat_map(|(page, text)| broken(page, text)).collect();
    assert!(all.is_empty(), "{all:#?}");
}

#[test]
fn a_link_that_leads_nowhere_is_found() {
    let page = root().join("README.md");
    let text = "[a](docs/semantics.md#terrain) [b](docs/none.md) ![c](docs/valley.png) [d](#none) [e](https://example.org/x)";
    let found: Vec<String> =
        broken(&page, text).iter().map(|s| s.rsplit(": ").next().unwrap().to_owned()).collect();
    assert_eq!(found, ["docs/none.md", "#none"]);
}

#[test]
fn every_file_of_the_repository_that_a_page_names_is_there() {
    let missing = |(page, text): &(PathBuf, String)| {
        let lost = named_paths(text).into_iter().filter(|path| !root().join(path).exists());
        lost.map(|path| format!("{}: {path}", page.display())).collect::<Vec<_>>()
    };
    let all: Vec<String> = pages().iter().flat_map(missing).collect();
    assert!(all.is_empty(), "{all:#?}");
    assert_eq!(named_paths("`src/lib.rs` and `x` in `golden/<topic>/` or `docs/`"), ["src/lib.rs", "docs/"]);
}

/// The commands of a page's table of commands that are built: the words after `drapery` in its first column.
#[cfg(feature = "cli")]
fn commands(text: &str) -> BTreeSet<String> {
    let rows = text
        .lines()
        .filter_map(|line| line.strip_prefix("| "))
        .filter(|row| !row.starts_with("*not built yet"));
    let cells = rows.filter_map(|row| row.split(" | ").next());
    let named = cells.flat_map(|cell| cell.split("`drapery ").skip(1));
    named.filter_map(|rest| rest.split([' ', '`']).next().map(str::to_owned)).collect()
}

#[cfg(feature = "cli")]
#[test]
fn the_tables_of_commands_are_what_help_lists() {
    let help = std::process::Command::new(env!("CARGO_BIN_EXE_drapery")).arg("--help").output().unwrap();
    let help = String::from_utf8(help.stdout).unwrap();
    let listed =
        help.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
    // A command's line is indented by two spaces, what continues its text by more.
    let names = listed.filter_map(|line| line.strip_prefix("  ").filter(|rest| !rest.starts_with(' ')));
    let mut names: BTreeSet<String> =
        names.filter_map(|rest| Some(rest.split(' ').next()?.to_owned())).collect();
    assert!(names.remove("help"), "{help}");
    for page in ["README.md", "docs/contract.md"] {
        let text = std::fs::read_to_string(root().join(page)).unwrap();
        assert_eq!(commands(&text), names, "{page}");
    }
}
