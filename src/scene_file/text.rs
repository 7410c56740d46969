//! A scene file that can be changed again.

use super::{Override, SceneFile, text_of};
use crate::error::Result;
use std::path::{Path, PathBuf};

/// A scene file, checked, with the text that it was and the overrides that were made: what a sweep over settings, or a message
/// that shows the line to blame, goes back to.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneText {
    /// What it says, overrides made.
    pub file: SceneFile,
    text: String,
    path: Option<PathBuf>,
    overrides: Vec<Override>,
}

impl SceneText {
    /// Checks a text, as [`SceneFile::parse`] does.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn parse(text: &str, path: Option<&Path>, overrides: &[Override]) -> Result<Self> {
        let file = SceneFile::parse(text, path, overrides)?;
        Ok(Self {
            file,
            text: text.to_owned(),
            path: path.map(Path::to_path_buf),
            overrides: overrides.to_vec(),
        })
    }

    /// Reads a scene file.
    ///
    /// # Errors
    /// When it cannot be read, is not UTF-8, or something in it is wrong.
    pub fn read(path: &Path, overrides: &[Override]) -> Result<Self> {
        Self::parse(&text_of(path)?, Some(path), overrides)
    }

    /// The text, without the overrides.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// What it says with further changes, each `path=value`.
    ///
    /// # Errors
    /// When a change is none, or one of the scene with it.
    pub fn changed(&self, changes: &[&str]) -> Result<SceneFile> {
        let more: Result<Vec<Override>> = changes.iter().map(|change| Override::parse(change)).collect();
        SceneFile::parse(&self.text, self.path.as_deref(), &[&self.overrides[..], &more?].concat())
    }
}
