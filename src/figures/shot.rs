//! A scene of a figure, and what it is drawn by.

use super::figure::Scale;
use crate::buffer::{Buffer, Plane, Values};
use crate::error::{Error, Result};
use crate::open::Opened;
use crate::scene_file::{Override, SceneText};
use crate::space::{Plan, ViewFrame, World};
use crate::stage::Stage;
use crate::technique::{self, Frame, FrameOptions, Kind};
use crate::truth::{Budget, Truth};

/// An opened scene.
pub(super) struct Shot {
    /// The scene.
    pub(super) stage: Stage,
    /// Its camera's view.
    pub(super) view: ViewFrame,
}

impl Shot {
    /// A scene's text with changes (`path=value`), its picture in the size that the text says.
    pub(super) fn of(text: &str, changes: &[&str]) -> Result<Self> {
        Self::scaled(text, changes, Scale::Full)
    }

    /// The same with the picture's size by the scale.
    pub(super) fn scaled(text: &str, changes: &[&str], scale: Scale) -> Result<Self> {
        let changes: Vec<Override> =
            changes.iter().map(|change| Override::parse(change)).collect::<Result<_>>()?;
        let mut stage = Opened::load(SceneText::parse(text, None, &changes)?, &|_| {})?.stage;
        stage.scene.image.width /= scale.divisor();
        stage.scene.image.height /= scale.divisor();
        let view = stage.view()?;
        Ok(Self { stage, view })
    }

    /// A technique's picture.
    pub(super) fn by(&self, kind: Kind) -> Result<Buffer<[u8; 4]>> {
        Ok(kind.draw(&self.stage)?.image)
    }

    /// The truth's picture.
    pub(super) fn truth(&self) -> Result<Buffer<[u8; 4]>> {
        Ok(Truth::of(&self.stage, &Budget::default())?.image())
    }

    /// A technique's frame with buffers.
    pub(super) fn frame(&self, kind: Kind, buffers: &[&str]) -> Result<Tables> {
        let names: Vec<String> = buffers.iter().map(|name| (*name).to_owned()).collect();
        let options = FrameOptions { buffers: &names, ..FrameOptions::default() };
        Ok(Tables(technique::prepare(kind, &self.stage)?.frame(&self.view, &options)?))
    }

    /// Where a point of the plan lies on the terrain.
    pub(super) fn on_ground(&self, at: Plan) -> World {
        let height = self.stage.mesh_for(&self.view).height_at(at);
        World::new(at.x, at.y, height.unwrap_or(0.0))
    }
}

/// A frame, its buffers by their names.
pub(super) struct Tables(Frame);

impl Tables {
    /// The picture.
    pub(super) fn image(&self) -> &Buffer<[u8; 4]> {
        &self.0.image
    }

    /// What was counted by this name.
    pub(super) fn count(&self, name: &str) -> u64 {
        let found = self.0.counts.iter().find(|(counted, _)| *counted == name);
        found.map_or(0, |(_, count)| *count)
    }

    /// A buffer that was asked for.
    pub(super) fn plane(&self, name: &str) -> Result<&Plane> {
        let found = self.0.planes.iter().find(|plane| plane.name == name);
        found.ok_or_else(|| Error::internal(format!("a figure has no buffer `{name}`")))
    }

    /// Rows of `N` whole numbers.
    pub(super) fn whole<const N: usize>(&self, name: &str) -> Result<Vec<[u32; N]>> {
        match &self.plane(name)?.values {
            Values::U32(values) => Ok(values.as_chunks().0.to_vec()),
            Values::U16(values) => {
                let values: Vec<u32> = values.iter().map(|value| u32::from(*value)).collect();
                Ok(values.as_chunks().0.to_vec())
            }
            Values::U8(values) => {
                let values: Vec<u32> = values.iter().map(|value| u32::from(*value)).collect();
                Ok(values.as_chunks().0.to_vec())
            }
            _ => Err(Error::internal(format!("buffer `{name}` of a figure has no whole numbers"))),
        }
    }

    /// Rows of `N` numbers.
    pub(super) fn real<const N: usize>(&self, name: &str) -> Result<Vec<[f64; N]>> {
        match &self.plane(name)?.values {
            Values::F64(values) => Ok(values.as_chunks().0.to_vec()),
            _ => Err(Error::internal(format!("buffer `{name}` of a figure has no doubles"))),
        }
    }
}
