//! The scene file: what a person wrote, checked.
//!
//! Input: TOML text and overrides (`path=value`). Output: [`SceneFile`], plain data; no file that it names is opened.
//! Refuses, with line and column or the override to blame: text that is not TOML, unknown keys (with the nearest
//! known one), missing keys, wrong types, numbers out of range, and values that contradict each other.
//!
//! The keys are described once, in `keys`; the check, the JSON Schema and the suggestions read the description.
//!
//! ```
//! use drapery::scene_file::SceneFile;
//! let text = r##"
//! schema = 1
//! [terrain]
//! generate = { kind = "fbm", seed = 7 }
//! [[layer]]
//! features = [{ line = [[-900, 0], [900, 200]] }]
//! line = { color = "#ff7f00", width = 12 }
//! "##;
//! let error = SceneFile::parse(text, None, &[]).unwrap_err();
//! assert_eq!(error.what(), "there is no key `layer.0.line.width`");
//! assert_eq!(error.help_text(), Some("did you mean `width_m`?"));
//! assert_eq!(error.position().map(|at| (at.line, at.column)), Some((7, 29)));
//! ```

mod build;
mod by_column;
mod canon;
mod case_study;
mod check;
mod keys;
mod names;
mod overrides;
mod place;
mod schema;
mod section;
mod spec;
mod suggest;
#[cfg(test)]
mod tests;
mod text;
mod tree;

pub use by_column::{
    Bounds, ByColumn, Condition, FillSpec, LineSpec, Order, OrderKey, OutlineSpec, PaintSpec, Scale,
    StyleSetting, StyleSpec, Test, WidthSpec,
};
pub use case_study::{Amount, DataGroup, Group, Study};
pub use keys::SCHEMA;
pub use overrides::Override;
pub use schema::schema;
pub use spec::{
    CameraSpec, DataFile, Edges, GroundColorsSpec, GroundSpec, HeightEncoding, InlineFeature, LayerSource,
    LayerSpec, PlanKind, SceneFile, Spot, TerrainGenerator, TerrainKind, TerrainSource, TerrainSpec,
    VectorGenerator, VectorKind, ViewSpec,
};
pub(crate) use suggest::{nearest, nearest_or_all};
pub use text::SceneText;

use crate::error::{Error, Result};
use glam::DVec3;
use place::Origin;
use std::path::Path;
use tree::Value;

/// The scene that is drawn where none is named: all of it generated, a start for one's own.
pub const DEFAULT_SCENE: &str = include_str!("../../golden/default/valley.toml");

impl SceneFile {
    /// Reads a scene file's text.
    ///
    /// `path` names the file in errors, and relative paths in the text start at its folder; without it they start at
    /// the current one.
    ///
    /// # Errors
    /// See the module: the first thing that is wrong.
    pub fn parse(text: &str, path: Option<&Path>, overrides: &[Override]) -> Result<SceneFile> {
        let origin = Origin { text, path };
        let mut root = tree::parse(&origin)?;
        overrides::apply(&origin, &mut root, overrides)?;
        if let Value::Table(table) = &root.value {
            check::table(&origin, table, &root.place, &keys::ROOT, "")?;
        }
        let hash = canon::hash(&root);
        build::scene(&origin, root).map(|scene| SceneFile { hash, ..scene })
    }

    /// Reads a scene file.
    ///
    /// # Errors
    /// When it cannot be read, is not UTF-8, or [`SceneFile::parse`] refuses it.
    pub fn read(path: &Path, overrides: &[Override]) -> Result<SceneFile> {
        Self::parse(&text_of(path)?, Some(path), overrides)
    }
}

/// The text of a scene file, for [`SceneFile::parse`].
///
/// # Errors
/// When it cannot be read or is not UTF-8.
pub fn text_of(path: &Path) -> Result<String> {
    let bytes = std::fs::read(path)
        .map_err(|error| Error::io("this scene file cannot be read", error).in_file(path))?;
    decode(bytes, path)
}

/// The bytes of a scene file as text.
///
/// # Errors
/// When they are not UTF-8; says where.
pub fn decode(bytes: Vec<u8>, path: &Path) -> Result<String> {
    String::from_utf8(bytes).map_err(|error| {
        let good = error.utf8_error().valid_up_to();
        let before = String::from_utf8_lossy(&error.as_bytes()[..good]);
        Error::new("a scene file is UTF-8 text; this byte is not")
            .in_file(path)
            .at(place::position(&before, &(good..good + 1)))
    })
}

/// Whether a camera at `eye` that looks at `target` has a picture with `up` upwards: for cameras that are known only
/// once geographic coordinates have become plan coordinates.
///
/// # Errors
/// When the eye is the target, or `up` is zero or parallel to the direction of view.
pub fn check_view(eye: DVec3, target: DVec3, up: DVec3) -> Result<()> {
    build::check_view(eye, target, up)
}
