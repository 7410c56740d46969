//! The scene that a subcommand is called with: a file, stdin, or the built-in one.

use super::bar::Bar;
use super::refusal::harmless;
use super::stop::Stop;
use drapery::scene_file::{DEFAULT_SCENE, Override, SceneFile, TerrainSource, decode, text_of};
use drapery::stage::Stage;
use drapery::{Error, Result, source};
use std::io::Read;
use std::path::{Path, PathBuf};

/// What errors call stdin.
const STDIN: &str = "<stdin>";

/// A scene file, and its text, which errors may not be able to read again.
pub(super) struct SceneInput {
    pub(super) file: SceneFile,
    text: String,
    path: Option<PathBuf>,
    overrides: Vec<Override>,
}

impl SceneInput {
    /// Reads the scene at `path`, from stdin where it is `-`, or the built-in one where there is none.
    pub(super) fn read(path: Option<&Path>, overrides: &[String]) -> std::result::Result<Self, Stop> {
        // Relative paths of a scene on stdin start at the current folder.
        let (text, path) = match path {
            None => return Self::built_in(DEFAULT_SCENE, overrides),
            Some(path) if path == Path::new("-") => (from_stdin()?, PathBuf::from(STDIN)),
            Some(path) => (text_of(path)?, path.to_owned()),
        };
        Self::parse(text, Some(path), overrides)
    }

    /// A scene that is part of the program.
    pub(super) fn built_in(text: &str, overrides: &[String]) -> std::result::Result<Self, Stop> {
        Self::parse(text.to_owned(), None, overrides)
    }

    fn parse(text: String, path: Option<PathBuf>, overrides: &[String]) -> std::result::Result<Self, Stop> {
        let overrides: Result<Vec<Override>> = overrides.iter().map(|text| Override::parse(text)).collect();
        let overrides = overrides?;
        match SceneFile::parse(&text, path.as_deref(), &overrides) {
            Ok(file) => Ok(Self { file, text, path, overrides }),
            Err(error) => Err(refused(error, text)),
        }
    }

    /// The scene with further changes.
    pub(super) fn changed(&self, changes: &[&str]) -> Result<SceneFile> {
        let more: Result<Vec<Override>> = changes.iter().map(|change| Override::parse(change)).collect();
        SceneFile::parse(&self.text, self.path.as_deref(), &[&self.overrides[..], &more?].concat())
    }

    /// Loads what the scene names, and tells the notes on it.
    pub(super) fn stage(&self, bar: &Bar) -> Result<Stage> {
        let (scene, surface) = source::load::load(&self.file, &|what| bar.start(what))?;
        for note in &scene.notes {
            bar.say(&format!("note: {}", harmless(note)));
        }
        Stage::new(scene, surface).map_err(|error| of_terrain(error, &self.file))
    }

    /// A refusal of what the scene names, shown with the scene's line where that is to blame.
    pub(super) fn blame(&self, error: Error) -> Stop {
        refused(error, self.text.clone())
    }
}

fn from_stdin() -> Result<String> {
    let mut bytes = Vec::new();
    std::io::stdin()
        .read_to_end(&mut bytes)
        .map_err(|error| Error::new(format!("stdin cannot be read: {error}")))?;
    decode(bytes, Path::new(STDIN))
}

/// A refusal, with the text that it speaks of where nobody can read that again.
fn refused(error: Error, text: String) -> Stop {
    let in_stdin = error.path() == Some(Path::new(STDIN));
    Stop::Refused { error, text: in_stdin.then_some(text) }
}

/// An error of the terrain's surface: its file and the line that names it.
fn of_terrain(error: Error, scene: &SceneFile) -> Error {
    let TerrainSource::File(file) = &scene.terrain.source else {
        return error;
    };
    let error = error.in_file(&file.path);
    match file.position {
        Some(position) => error.named_in(scene.path.as_deref(), position),
        None => error,
    }
}
