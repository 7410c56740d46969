//! A folder for as long as it is needed.

use drapery::{Error, Result};
use std::path::{Path, PathBuf};

/// A folder of this run alone, which goes with what is in it when this is dropped.
#[derive(Debug)]
pub(super) struct Folder(PathBuf);

impl Folder {
    /// Makes one among the system's temporary files.
    ///
    /// # Errors
    /// When nothing can be written there.
    pub(super) fn new() -> Result<Self> {
        let place = std::env::temp_dir().join(format!("drapery-reduce-{}", std::process::id()));
        std::fs::create_dir_all(&place)
            .map_err(|error| Error::io("this temporary folder cannot be made", error).in_file(&place))?;
        Ok(Self(place))
    }

    pub(super) fn path(&self) -> &Path {
        &self.0
    }

    /// An empty folder in it.
    ///
    /// # Errors
    /// When it cannot be cleared or made.
    pub(super) fn empty(&self, name: &str) -> Result<PathBuf> {
        let path = self.0.join(name);
        let cleared = if path.exists() { std::fs::remove_dir_all(&path) } else { Ok(()) };
        cleared
            .and_then(|()| std::fs::create_dir_all(&path))
            .map_err(|error| Error::io("this temporary folder cannot be made", error).in_file(&path))?;
        Ok(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // What cannot be removed is the system's to clear.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}
