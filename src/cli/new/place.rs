//! Where a scene file will lie, and how it names files from there.

use crate::cli::written::quoted_text;
use drapery::{Error, Result};
use std::path::{Component, Path, PathBuf, absolute};

/// The folder that a scene's paths start at.
pub(super) struct Place {
    /// `None`: the current one.
    folder: Option<PathBuf>,
}

impl Place {
    /// The current folder: paths stay as they are.
    pub(super) fn here() -> Self {
        Self { folder: None }
    }

    /// The folder of a file.
    pub(super) fn beside(file: &Path) -> Result<Self> {
        let refuse = |error| Error::io("this file has no place", error).in_file(file);
        let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
        // Links are followed: `..` leads out of the folder that a link leads to.
        let folder = folder.map(|folder| std::fs::canonicalize(folder).map_err(refuse)).transpose()?;
        let current = std::env::current_dir().and_then(std::fs::canonicalize).map_err(refuse)?;
        Ok(Self { folder: folder.filter(|folder| *folder != current) })
    }

    /// A path as the scene file writes it.
    pub(super) fn quoted(&self, path: &Path) -> Result<String> {
        let refuse = || {
            Error::new("a scene file is UTF-8 text and cannot name this path")
                .in_file(path)
                .help("rename the file")
        };
        let written = match &self.folder {
            Some(folder) if path.is_relative() => from_there(folder, path)?,
            _ => path.to_owned(),
        };
        written.to_str().map(quoted_text).ok_or_else(refuse)
    }
}

/// A path from a folder to a file.
fn from_there(folder: &Path, path: &Path) -> Result<PathBuf> {
    let refuse = |error| Error::io("this file has no place", error).in_file(path);
    let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let parent = std::fs::canonicalize(parent).map_err(refuse)?;
    let whole = parent.join(absolute(path).map_err(refuse)?.file_name().unwrap_or_default());
    let (from, to): (Vec<Component<'_>>, Vec<Component<'_>>) =
        (folder.components().collect(), whole.components().collect());
    let shared = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    if shared == 0 {
        // Another drive: there is no way from there.
        return Ok(whole);
    }
    let up = from[shared..].iter().map(|_| Component::ParentDir);
    Ok(up.chain(to[shared..].iter().copied()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_leads_from_the_scene_to_the_file() {
        let folder = tempfile::tempdir().unwrap();
        let root = std::fs::canonicalize(folder.path()).unwrap();
        for inner in ["a/b", "c"] {
            std::fs::create_dir_all(root.join(inner)).unwrap();
        }
        let way = |from: &str, to: &str| from_there(&root.join(from), &root.join(to)).unwrap();
        assert_eq!(way("a/b", "c/d.tif"), Path::new("../../c/d.tif"));
        assert_eq!(way("a", "a/b/d.tif"), Path::new("b/d.tif"));
        assert_eq!(way("a", "a/d.tif"), Path::new("d.tif"));
    }
}
