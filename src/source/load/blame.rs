//! Whom an error blames: the data file, and the line of the scene that names it.

use crate::error::{Error, Result};
use crate::scene_file::{DataFile, SceneFile};
use std::path::Path;

/// A data file and the scene that names it.
#[derive(Clone, Copy)]
pub(super) struct Named<'a> {
    pub(super) file: &'a DataFile,
    scene: Option<&'a Path>,
}

impl<'a> Named<'a> {
    pub(super) fn new(scene: &'a SceneFile, file: &'a DataFile) -> Self {
        Self { file, scene: scene.path.as_deref() }
    }

    /// The path to open.
    pub(super) fn path(&self) -> &'a Path {
        &self.file.path
    }

    /// Puts file and line into an error of a reader.
    pub(super) fn blame(&self, error: Error) -> Error {
        let error = error.in_file(&self.file.path);
        match self.file.position {
            Some(position) => error.named_in(self.scene, position),
            None => error,
        }
    }

    /// Refuses a path where there is nothing: that is the scene's fault, so its line is shown.
    pub(super) fn require(&self) -> Result<()> {
        let missing =
            std::fs::metadata(self.path()).is_err_and(|error| error.kind() == std::io::ErrorKind::NotFound);
        if !missing {
            return Ok(());
        }
        let help = match self.nearest() {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!(
                "it was looked for at {}; paths are relative to the scene file",
                self.path().display()
            ),
        };
        let error = Error::new(format!("there is no file `{}`", self.file.written)).help(help);
        Err(match (self.file.position, self.scene) {
            (Some(position), Some(scene)) => error.in_file(scene).at(position),
            (Some(position), None) => error.at(position),
            (None, _) => error,
        })
    }

    /// The file of the same folder that was most likely meant, written as the scene would.
    fn nearest(&self) -> Option<String> {
        let given = self.path().file_name()?.to_str()?;
        let folder = self.path().parent()?;
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        let names =
            std::fs::read_dir(folder).ok()?.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
        let cost = |name: &str| strsim::osa_distance(&given.to_lowercase(), &name.to_lowercase());
        let (cost, name) = names.map(|name| (cost(&name), name)).min()?;
        let near = cost <= (given.chars().count() / 3).min(3);
        near.then(|| self.file.written[..self.file.written.len() - given.len()].to_owned() + &name)
    }
}

/// An error of a value that a key of the scene states.
#[expect(clippy::needless_pass_by_value, reason = "fits map_err")]
pub(super) fn of_key(scene: &SceneFile, key: &str, error: Error) -> Error {
    let mut placed = Error::new(format!("`{key}`: {}", error.what()));
    if let Some(help) = error.help_text() {
        placed = placed.help(help);
    }
    match &scene.path {
        Some(path) => placed.in_file(path),
        None => placed,
    }
}
