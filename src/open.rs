//! A scene file opened: read, checked, and all that it names loaded.
//!
//! Input: the path or the text of a scene file. Output: [`Opened`], a [`Stage`] with the scene file it was made of. Refuses: what the
//! scene file and the readers of its data refuse.

use crate::error::{Error, Result};
use crate::scene_file::{LayerSource, SceneFile, SceneText};
use crate::source::load;
use crate::space::ViewFrame;
use crate::stage::Stage;
use std::path::Path;

/// A scene, ready to be drawn, and the scene file that says so.
#[derive(Debug)]
pub struct Opened {
    /// What the scene file says.
    pub text: SceneText,
    /// What it names, loaded.
    pub stage: Stage,
}

/// Opens a scene file: reads it, and the terrain and vectors that it names.
///
/// ```no_run
/// let scene = drapery::open("scene.toml")?;
/// for note in scene.notes() {
///     eprintln!("note: {note}");
/// }
/// # Ok::<(), drapery::Error>(())
/// ```
///
/// # Errors
/// When the file cannot be read or something in it is wrong; when a data file is missing, damaged or of a kind that is not read; when the
/// terrain has no triangle. The error names the file and the line to blame.
pub fn open(path: impl AsRef<Path>) -> Result<Opened> {
    Opened::load(SceneText::read(path.as_ref(), &[])?, &|_| {})
}

impl Opened {
    /// Opens a scene file's text; relative paths in it start at the current folder.
    ///
    /// # Errors
    /// As [`open`].
    pub fn parse(text: &str) -> Result<Self> {
        Self::load(SceneText::parse(text, None, &[])?, &|_| {})
    }

    /// Loads what a scene file names. `progress` is told what is being read or made.
    ///
    /// # Errors
    /// When a data file cannot be read or understood, or the terrain has no triangle.
    pub fn load(text: SceneText, progress: &dyn Fn(&str)) -> Result<Self> {
        let (scene, surface) = load::load(&text.file, progress)?;
        progress("making the surface");
        let stage = Stage::new(scene, surface).map_err(|error| blamed(error, &text.file))?;
        Ok(Self { text, stage })
    }

    /// What the user should know about the input: a layer in another CRS, points that were left out.
    pub fn notes(&self) -> &[String] {
        &self.stage.scene.notes
    }

    /// The view of the scene's camera.
    ///
    /// # Errors
    /// When the camera shows nothing.
    pub fn view(&self) -> Result<ViewFrame> {
        self.stage.view()
    }
}

/// An error of what was loaded, with the file that it was read from and the line that names it: that of the layer to blame, or else of the
/// terrain.
fn blamed(error: Error, scene: &SceneFile) -> Error {
    let file = match error.layer() {
        None => scene.terrain.source.files().first(),
        Some(number) => match scene.layers.get(number).map(|layer| &layer.source) {
            Some(LayerSource::File { file, .. }) => Some(file),
            _ => None,
        },
    };
    let Some(file) = file else { return error };
    let error = error.in_file(&file.path);
    match file.position {
        Some(position) => error.named_in(scene.path.as_deref(), position),
        None => error,
    }
}
