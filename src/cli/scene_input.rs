//! The scene that a subcommand is called with: a file, stdin, or the built-in one.

use super::stop::Stop;
use drapery::scene::file::{DEFAULT_SCENE, Override, SceneFile, decode};
use drapery::{Error, Result};
use std::io::Read;
use std::path::Path;

/// What errors call stdin.
const STDIN: &str = "<stdin>";

/// A scene file, and its text where errors cannot read it again.
pub(super) struct SceneInput {
    pub(super) file: SceneFile,
    text: Option<String>,
}

impl SceneInput {
    /// Reads the scene at `path`, from stdin where it is `-`, or the built-in one where there is none.
    pub(super) fn read(path: Option<&Path>, overrides: &[String]) -> std::result::Result<Self, Stop> {
        let overrides: Result<Vec<Override>> = overrides.iter().map(|text| Override::parse(text)).collect();
        let overrides = overrides?;
        let file = match path {
            None => SceneFile::parse(DEFAULT_SCENE, None, &overrides)?,
            Some(path) if path == Path::new("-") => return Self::from_stdin(&overrides),
            Some(path) => SceneFile::read(path, &overrides)?,
        };
        Ok(Self { file, text: None })
    }

    /// Relative paths of a scene on stdin start at the current folder.
    fn from_stdin(overrides: &[Override]) -> std::result::Result<Self, Stop> {
        let name = Path::new(STDIN);
        let mut bytes = Vec::new();
        std::io::stdin()
            .read_to_end(&mut bytes)
            .map_err(|error| Error::new(format!("stdin cannot be read: {error}")))?;
        let text = decode(bytes, name)?;
        match SceneFile::parse(&text, Some(name), overrides) {
            Ok(file) => Ok(Self { file, text: Some(text) }),
            Err(error) => Err(Stop::Refused { error, text: Some(text) }),
        }
    }

    /// A refusal of what the scene names, shown with the scene's line where that is to blame.
    pub(super) fn blame(&self, error: Error) -> Stop {
        let in_stdin = error.path() == Some(Path::new(STDIN));
        let text = self.text.clone().filter(|_| in_stdin);
        Stop::Refused { error, text }
    }
}
