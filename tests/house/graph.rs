//! Which file stands on which.

use super::tree::House;
use std::collections::{BTreeMap, BTreeSet};

/// For each file, the files that define what it names.
///
/// A name that a module passes on (`pub use`) is followed to the file that defines it. A folder and its head, its `mod.rs`, are read
/// together: what the head defines for the files below it is no edge, so that a circle is one of files that stand side by side, or in
/// different folders. What a type's methods call is not followed: the types say enough.
pub fn edges(house: &House) -> BTreeMap<String, BTreeSet<String>> {
    let names = Names::of(house);
    let of = |file: &String| -> BTreeSet<String> {
        let mentions = house.files[file].mentions.iter().filter(|mention| !mention.is_only_passed_on);
        let known = mentions.filter_map(|mention| names.definition(&mention.path, 0));
        known.filter(|other| other != file && !is_head_of(other, file)).collect()
    };
    house.files.keys().map(|file| (file.clone(), of(file))).collect()
}

/// Whether a file is the head of a folder that another lies in.
fn is_head_of(head: &str, file: &str) -> bool {
    head.strip_suffix("mod.rs").is_some_and(|folder| file.starts_with(folder))
}

/// Where each name of the crate is defined.
struct Names {
    /// The file in which a module's text stands.
    modules: BTreeMap<Vec<String>, String>,
    items: BTreeSet<(Vec<String>, String)>,
    bindings: BTreeMap<(Vec<String>, String), Vec<String>>,
}

impl Names {
    fn of(house: &House) -> Self {
        let mut names = Self { modules: BTreeMap::new(), items: BTreeSet::new(), bindings: BTreeMap::new() };
        for (file, code) in &house.files {
            names.modules.extend(code.inline.iter().map(|module| (module.clone(), file.clone())));
            names.items.extend(code.items.iter().cloned());
            names.bindings.extend(code.bindings.clone());
        }
        names
    }

    /// The file that defines what a path names; none for modules and for what is another crate's.
    fn definition(&self, path: &[String], depth: usize) -> Option<String> {
        let mut module = path[..1].to_vec();
        for (at, name) in path.iter().enumerate().skip(1) {
            let file = self.modules.get(&module)?;
            let key = (module.clone(), name.trim_end_matches('!').to_owned());
            let child = [module.as_slice(), std::slice::from_ref(name)].concat();
            let is_last = at + 1 == path.len();
            let is_module = self.modules.contains_key(&child);
            if self.items.contains(&key) && (is_last || !is_module) {
                return Some(file.clone());
            }
            if let Some(target) = self.bindings.get(&key)
                && (is_last || !is_module)
                && depth < 8
            {
                return self.definition(&[target, &path[at + 1..]].concat(), depth + 1);
            }
            if !is_module {
                // A name of a glob, or made by a macro: the module that it is asked of answers for it.
                return Some(self.through_globs(&module, &path[at..], depth).unwrap_or_else(|| file.clone()));
            }
            module = child;
        }
        None
    }

    /// The file that defines a name which a module has by `use ..::*`.
    fn through_globs(&self, module: &[String], rest: &[String], depth: usize) -> Option<String> {
        let from = (module.to_vec(), "*".to_owned());
        let mut globs =
            self.bindings.range(from..).take_while(|(key, _)| key.0 == module && key.1.starts_with('*'));
        globs.find_map(|(_, target)| {
            let source = &target[..target.len() - 1];
            let key = (source.to_vec(), rest[0].clone());
            let has = self.items.contains(&key) || self.bindings.contains_key(&key);
            (has && depth < 8).then(|| self.definition(&[source, rest].concat(), depth + 1))?
        })
    }
}
