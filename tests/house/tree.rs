//! The files of the crate as its modules: what the compiler reads, from `lib.rs` and `main.rs` on.

use super::code::Code;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The files below `src/`, by their paths from the repository on (`src/raster/strip.rs`).
#[derive(Default)]
pub struct House {
    /// What the library and the program are made of.
    pub files: BTreeMap<String, Code>,
    /// What only tests are made of.
    pub tests: BTreeSet<String>,
}

impl House {
    /// Reads all of `src/`.
    pub fn read(repository: &Path) -> Self {
        Self::of(&|file| std::fs::read_to_string(repository.join(file)).ok())
    }

    /// Reads the files that `text` has.
    pub fn of(text: &dyn Fn(&str) -> Option<String>) -> Self {
        let mut house = Self::default();
        house.add("src/lib.rs", false, text);
        house.add("src/main.rs", false, text);
        house
    }

    /// Adds a file and those of the modules that it declares.
    fn add(&mut self, file: &str, is_test: bool, text: &dyn Fn(&str) -> Option<String>) {
        let read = text(file).unwrap_or_else(|| panic!("there is no {file}"));
        let code = Code::of(&module_of(file), &read).unwrap_or_else(|error| panic!("{file}: {error}"));
        for (child, child_is_test) in &code.modules {
            let [beside, below] = files_of(child);
            let child = if text(&beside).is_some() { beside } else { below };
            self.add(&child, is_test || *child_is_test, text);
        }
        if is_test {
            self.tests.insert(file.into());
        } else {
            self.files.insert(file.into(), code);
        }
    }

    /// Every file below `src/` that no module declares.
    pub fn strays(&self, repository: &Path) -> Vec<String> {
        let all = all_files(&repository.join("src"));
        let name = |path: &PathBuf| path.strip_prefix(repository).unwrap().to_string_lossy().into_owned();
        let is_stray = |file: &String| !self.files.contains_key(file) && !self.tests.contains(file);
        all.iter().map(name).filter(is_stray).collect()
    }
}

/// The module of a file: `src/raster/mod.rs` is `drapery::raster`.
pub fn module_of(file: &str) -> Vec<String> {
    let below = file.strip_prefix("src/").unwrap_or(file);
    let mut parts: Vec<String> = below.trim_end_matches(".rs").split('/').map(Into::into).collect();
    if parts.last().is_some_and(|last| ["mod", "lib", "main"].contains(&last.as_str())) {
        parts.pop();
    }
    // The program is a crate of its own: `main.rs` and `cli/`.
    let is_program = below == "main.rs" || below.starts_with("cli");
    parts.insert(0, if is_program { "main" } else { "drapery" }.into());
    parts
}

/// Where a module's file may be.
fn files_of(module: &[String]) -> [String; 2] {
    let stem = format!("src/{}", module[1..].join("/"));
    [format!("{stem}.rs"), format!("{stem}/mod.rs")]
}

fn all_files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap().flatten() {
        let path = entry.path();
        if path.is_dir() {
            found.extend(all_files(&path));
        } else if path.extension().is_some_and(|end| end == "rs") {
            found.push(path);
        }
    }
    found
}
