//! `manifest.json`: which files a bundle has, and their hashes.

use super::file::{document, unreadable};
use crate::error::{Error, Result};
use serde::Deserialize;
use std::fs::File;
use std::io;
use std::path::{Component, Path, PathBuf};

const SCHEMA: u64 = 1;
const NAME: &str = "manifest.json";

#[derive(Debug, Deserialize)]
struct Document {
    kind: String,
    files: Vec<Entry>,
}

/// A file of a bundle, as it was written.
#[derive(Debug, Deserialize)]
struct Entry {
    name: String,
    bytes: u64,
    blake3: String,
}

/// A bundle's folder.
///
/// # Guarantees
/// Its files were there as its manifest says when it was read.
#[derive(Debug)]
pub(super) struct Manifest {
    folder: PathBuf,
    files: Vec<Entry>,
}

impl Manifest {
    /// Reads a bundle's manifest and looks at all of its files.
    ///
    /// # Errors
    /// When there is none or it is of another schema, or a file is missing or another than it says.
    pub(super) fn read(folder: &Path) -> Result<Self> {
        let path = folder.join(NAME);
        let bytes = std::fs::read(&path).map_err(|error| {
            unreadable(error, &path)
                .help("every bundle has one: write it with `drapery export SCENE --technique T -o DIR`")
        })?;
        let Document { kind, files } = document(&bytes, &path, SCHEMA)?;
        if kind != "bundle" {
            return Err(Error::new(format!("this folder is a `{kind}` and no bundle")).in_file(&path));
        }
        for entry in &files {
            entry.check(folder, &path)?;
        }
        Ok(Self { folder: folder.into(), files })
    }

    /// The bytes of a file, and its path.
    ///
    /// # Errors
    /// When the manifest does not name it, or it cannot be read.
    pub(super) fn file(&self, name: &str) -> Result<(Vec<u8>, PathBuf)> {
        let path = self.path(name);
        if !self.has(name) {
            return Err(Error::new(format!("`{name}` is needed, and {NAME} does not name it"))
                .in_file(&self.folder.join(NAME))
                .help("export the bundle again"));
        }
        let bytes = std::fs::read(&path).map_err(|error| unreadable(error, &path))?;
        Ok((bytes, path))
    }

    /// The path of a file.
    pub(super) fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Whether the manifest names a file.
    pub(super) fn has(&self, name: &str) -> bool {
        self.files.iter().any(|entry| entry.name == name)
    }

    /// The paths of all files.
    pub(super) fn paths(&self) -> impl Iterator<Item = PathBuf> {
        self.files.iter().map(|entry| self.folder.join(&entry.name))
    }
}

impl Entry {
    /// Refuses a file that is not the one that was written.
    fn check(&self, folder: &Path, manifest: &Path) -> Result<()> {
        let parts = || Path::new(&self.name).components();
        if self.name.is_empty() || !parts().all(|part| matches!(part, Component::Normal(_))) {
            return Err(
                Error::new(format!("`{}` is no name of a file in a bundle", self.name)).in_file(manifest)
            );
        }
        let path = folder.join(&self.name);
        let refuse = |error: io::Error| {
            unreadable(error, &path)
                .help("the bundle's manifest names it: export the bundle again, or copy all of it")
        };
        let found = std::fs::metadata(&path).map_err(refuse)?;
        if !found.is_file() {
            return Err(refuse(io::Error::other("it is no file")));
        }
        let is_same = found.len() == self.bytes && {
            let mut hasher = blake3::Hasher::new();
            hasher.update_reader(File::open(&path).map_err(refuse)?).map_err(refuse)?;
            hasher.finalize().to_hex().as_str() == self.blake3
        };
        if is_same {
            return Ok(());
        }
        Err(Error::new(format!(
            "this file is not the one that the bundle was written with: {NAME} has another hash of it"
        ))
        .in_file(&path)
        .help("export the bundle again; one that was edited, or copied in part, judges nothing"))
    }
}
