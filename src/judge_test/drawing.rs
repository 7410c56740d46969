//! Scenes drawn with edits.

use super::edit::{Change, Edit, Picture};
use super::{picture, target};
use crate::buffer::Buffer;
use crate::error::Result;
use crate::math;
use crate::scene::{Projection, Scene, Surface};
use crate::scene_file::{SceneFile, SceneText};
use crate::source::load;
use crate::stage::Stage;
use crate::technique::{self, FrameOptions, Kind};

/// A scene of the corpus with keys that all of its pictures have: those of a machine.
#[derive(Clone, Copy)]
pub(super) struct Subject<'a> {
    pub(super) text: &'a SceneText,
    pub(super) kind: Kind,
    pub(super) machine: &'a [&'a str],
}

impl Subject<'_> {
    /// The stage without any edit.
    ///
    /// # Errors
    /// When the scene cannot be loaded.
    pub(super) fn stage(&self) -> Result<Stage> {
        let (scene, surface) = self.loaded(&[])?;
        Stage::new(scene, surface)
    }

    /// The right picture.
    ///
    /// # Errors
    /// When the technique does not draw the scene.
    pub(super) fn right(&self) -> Result<Picture> {
        draw(self.kind, &self.stage()?, None)
    }

    /// The picture with an edit; `None`: the edit has nothing to change here, or makes what the technique does not draw. `right` is
    /// the picture without it.
    ///
    /// # Errors
    /// When the scene without the edit is refused.
    pub(super) fn edited(&self, edit: &Edit, right: &Picture) -> Result<Option<Picture>> {
        match *edit {
            Edit::Keys(keys) => Ok(self.with_keys(keys)),
            Edit::Scene(change) => self.changed(change),
            Edit::HalfPixels(x, y) => self.beside(x, y).map(Some),
            Edit::Picture(change) => Ok(Some(change(right))),
            Edit::Tile(of) => {
                let other = self.edited(of, right)?;
                Ok(other.and_then(|other| picture::most_changed_tile(right, &other)))
            }
            Edit::Target => {
                let (scene, surface) = self.loaded(&[])?;
                let draw = |scene| draw(self.kind, &Stage::new(scene, surface.clone())?, None);
                target::blended(&scene, &draw)
            }
            Edit::Tiles(side) => draw(self.kind, &self.stage()?, Some(side)).map(Some),
        }
    }

    fn loaded(&self, keys: &[&str]) -> Result<(Scene, Surface)> {
        load::load(&self.file(keys)?, &|_| {})
    }

    fn file(&self, keys: &[&str]) -> Result<SceneFile> {
        self.text.changed(&[self.machine, keys].concat())
    }

    fn with_keys(&self, keys: &[&str]) -> Option<Picture> {
        let (plain, other) = (self.file(&[]).ok()?, self.file(keys).ok()?);
        // A default that is written out is no change.
        if (SceneFile { hash: plain.hash.clone(), ..other.clone() }) == plain {
            return None;
        }
        let (scene, surface) = load::load(&other, &|_| {}).ok()?;
        draw(self.kind, &Stage::new(scene, surface).ok()?, None).ok()
    }

    fn changed(&self, change: Change) -> Result<Option<Picture>> {
        let (mut scene, mut surface) = self.loaded(&[])?;
        if !change(&mut scene, &mut surface) {
            return Ok(None);
        }
        Ok(Stage::new(scene, surface).and_then(|stage| draw(self.kind, &stage, None)).ok())
    }

    /// The picture whose samples lie half a pixel to the right, so many times, and down: a larger one has its middle there.
    fn beside(&self, columns: usize, rows: usize) -> Result<Picture> {
        let (mut scene, surface) = self.loaded(&[])?;
        let (width, height) = (scene.image.width, scene.image.height);
        (scene.image.width, scene.image.height) = (width + columns, height + rows);
        let share = (height + rows) as f64 / height as f64;
        scene.camera.projection = match scene.camera.projection {
            Projection::Perspective { fov_y_deg } => {
                let half = math::tan(fov_y_deg.to_radians() / 2.0) * share;
                Projection::Perspective { fov_y_deg: 2.0 * math::atan2(half, 1.0).to_degrees() }
            }
            Projection::Orthographic { height_m } => Projection::Orthographic { height_m: height_m * share },
        };
        let large = draw(self.kind, &Stage::new(scene, surface)?, None)?;
        let kept = (0..height).flat_map(|y| large.row(y + rows)[columns..].iter().copied());
        Ok(Buffer::from_values(width, height, kept.collect()))
    }
}

/// A picture of a stage, in tiles of a size.
fn draw(kind: Kind, stage: &Stage, tile: Option<usize>) -> Result<Picture> {
    let mut options = FrameOptions::default();
    options.tile = tile.unwrap_or(options.tile);
    Ok(technique::prepare(kind, stage)?.frame(&stage.view()?, &options)?.image)
}
