//! `conformance.json`: bundles that each expose a mistake, judged together.

use super::file::{document, unreadable};
use crate::error::{Error, Result};
use serde::Deserialize;
use std::collections::BTreeSet;
use std::path::{Component, Path, PathBuf};

const NAME: &str = "conformance.json";
const SCHEMA: u64 = 1;

/// Bundles in a folder.
#[derive(Debug)]
pub struct ConformanceSet {
    folder: PathBuf,
    /// In their order.
    pub cases: Vec<ConformanceCase>,
}

/// One of them.
#[derive(Debug, Deserialize)]
pub struct ConformanceCase {
    /// Its name: that of its frames too.
    pub name: String,
    /// Its folder in the set's, which may be in others.
    bundle: String,
    /// What it is there for, in a sentence.
    pub exposes: String,
}

#[derive(Debug, Deserialize)]
struct Document {
    cases: Vec<ConformanceCase>,
}

impl ConformanceSet {
    /// Whether a folder is one.
    pub fn is_one(folder: &Path) -> bool {
        folder.join(NAME).exists()
    }

    /// Reads which bundles there are.
    ///
    /// # Errors
    /// When its list cannot be read, is empty, or has a name that is none or is there twice.
    pub fn read(folder: &Path) -> Result<Self> {
        let path = folder.join(NAME);
        let bytes = std::fs::read(&path).map_err(|error| unreadable(error, &path))?;
        let Document { cases } = document(&bytes, &path, SCHEMA)?;
        let refuse = |what: String| Err(Error::new(what).in_file(&path));
        if cases.is_empty() {
            return refuse("it has no case".into());
        }
        let mut names = BTreeSet::new();
        for case in &cases {
            let inner = |name: &str| {
                let mut parts = Path::new(name).components();
                !name.is_empty() && parts.all(|part| matches!(part, Component::Normal(_)))
            };
            if let Some(name) = [&case.name, &case.bundle].into_iter().find(|name| !inner(name)) {
                return refuse(format!("`{name}` is no name of a folder"));
            }
            if !names.insert(&case.name) {
                return refuse(format!("the case `{}` is there twice", case.name));
            }
        }
        Ok(Self { folder: folder.into(), cases })
    }

    /// The folder of a case's bundle.
    pub fn bundle(&self, case: &ConformanceCase) -> PathBuf {
        self.folder.join(&case.bundle)
    }

    /// Where a case's frame is among those that were drawn: a folder or a picture of its name, or of its bundle's place in the set.
    ///
    /// # Errors
    /// When there is none of these.
    pub fn frame(&self, case: &ConformanceCase, frames: &Path) -> Result<PathBuf> {
        let ends = ["", ".png", ".exr", ".npy"];
        let mut names =
            [&case.name, &case.bundle].into_iter().flat_map(|name| ends.map(|end| format!("{name}{end}")));
        names.find(|name| frames.join(name).exists()).map(|name| frames.join(name)).ok_or_else(|| {
            Error::new(format!("no frame of the case `{}`: neither a folder {0} nor {0}.png", case.name))
                .in_file(frames)
        })
    }
}
