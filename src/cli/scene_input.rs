//! The scene that a subcommand is called with: a file, stdin, or the built-in one.

use super::bar::Bar;
use super::stop::Stop;
use drapery::measure::Watch;
use drapery::scene_file::{DEFAULT_SCENE, Override, SceneText, decode, text_of};
use drapery::{Error, Opened, Result};
use std::io::Read;
use std::path::Path;

/// What errors call stdin.
const STDIN: &str = "<stdin>";

/// Reads the scene at `path`, from stdin where it is `-`, or the built-in one where there is none.
pub(super) fn read(path: Option<&Path>, overrides: &[String]) -> std::result::Result<SceneText, Stop> {
    // Relative paths of a scene on stdin start at the current folder.
    match path {
        None => built_in(DEFAULT_SCENE, overrides),
        Some(path) if path == Path::new("-") => parse(&from_stdin()?, Some(Path::new(STDIN)), overrides),
        Some(path) => parse(&text_of(path)?, Some(path), overrides),
    }
}

/// A scene that is part of the program.
pub(super) fn built_in(text: &str, overrides: &[String]) -> std::result::Result<SceneText, Stop> {
    parse(text, None, overrides)
}

fn parse(text: &str, path: Option<&Path>, overrides: &[String]) -> std::result::Result<SceneText, Stop> {
    let overrides: Result<Vec<Override>> = overrides.iter().map(|text| Override::parse(text)).collect();
    SceneText::parse(text, path, &overrides?).map_err(|error| refused(error, text))
}

/// Loads what the scene names, and tells the notes on it.
pub(super) fn open(text: &SceneText, bar: &Bar) -> Result<Opened> {
    let scene = Opened::load(text.clone(), &|what| bar.start(what))?;
    scene.notes().iter().for_each(|note| bar.note(note));
    Ok(scene)
}

/// A refusal of what a scene names, shown with the scene's line where that is to blame.
pub(super) fn blame(text: &SceneText, error: Error) -> Stop {
    refused(error, text.text())
}

fn from_stdin() -> Result<String> {
    let mut bytes = Vec::new();
    std::io::stdin().read_to_end(&mut bytes).map_err(|error| Error::io("stdin cannot be read", error))?;
    decode(bytes, Path::new(STDIN))
}

/// A refusal, with the text that it speaks of where nobody can read that again.
fn refused(error: Error, text: &str) -> Stop {
    let in_stdin = error.path() == Some(Path::new(STDIN));
    Stop::Refused { error, text: in_stdin.then(|| text.to_owned()) }
}
