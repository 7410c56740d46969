//! The files of one run, staged: its picture and its buffers.

use super::Buffers;
use crate::buffer::{Buffer, Plane, PlaneKind};
use crate::error::{Error, Result};
use crate::measure::{Certified, Drawn, Watch, device_words};
use crate::output::{Batch, BufferResult, ByName, ErrorResult, ImageResult, Npy, RunResult};
use crate::output::{absolute, look, write_png};
use crate::scene::Device;
use crate::space::ViewFrame;
use crate::stage::Stage;
use crate::technique::{Frame, Kind};
use crate::truth::{self, Truth};

/// Draws a stage into a batch of files.
pub(super) struct RunFiles<'a> {
    pub(super) stage: &'a Stage,
    pub(super) view: &'a ViewFrame,
    /// The truth, where distances from it are to be told.
    pub(super) certified: Option<&'a Certified>,
    pub(super) buffers: &'a Buffers,
    /// Whether a buffer is written by others, in another way.
    pub(super) is_elsewhere: &'a dyn Fn(&str) -> bool,
    pub(super) batch: &'a mut Batch,
    pub(super) watch: &'a dyn Watch,
}

impl RunFiles<'_> {
    /// Stages the truth's files, with some more buffers.
    pub(super) fn truth(&mut self, certified: &Certified, more: &[Plane]) -> Result<RunResult> {
        let truth = &certified.truth;
        let image = truth.image();
        let path = format!("{}.png", truth::NAME);
        self.batch.stage(&path, |to| write_png(&image, to))?;
        let kinds = Truth::PLANES.iter().filter(|kind| self.buffers.wants(kind.name));
        let planes = kinds.filter_map(|kind| truth.plane(kind.name));
        let planes: Vec<Plane> = planes.chain(more.iter().cloned()).collect();
        let kinds: Vec<PlaneKind> = Truth::PLANES.iter().chain(&PlaneKind::PICKS).copied().collect();
        let buffers = self.stage_planes((truth::NAME, &kinds), &planes);
        Ok(RunResult {
            technique: truth::NAME.into(),
            parameters: certified.parameters(),
            device: device_words(&Device::default()),
            image: ImageResult { path, width: image.width(), height: image.height(), hash: image.hash() },
            prepare_ms: 0.0,
            frame_ms: certified.times.median,
            structure_bytes: truth.structure_bytes,
            counts: certified.counts(),
            error: self.error(&image)?,
            buffers: buffers?,
        })
    }

    /// Runs a technique `repeat` times and stages its files; what is told of it, and its frame.
    pub(super) fn technique(&mut self, kind: Kind, repeat: u32) -> Result<(RunResult, Frame)> {
        self.watch.start(kind.name());
        let wants_buffer = |name: &str| self.buffers.wants(name);
        let drawn = Drawn::by(kind, (self.stage, self.view), (repeat, &wants_buffer), self.watch)?;
        let name = kind.name();
        let path = format!("{name}.png");
        self.batch.stage(&path, |to| write_png(&drawn.frame.image, to))?;
        let buffers = self.stage_planes((name, kind.declaration().planes), &drawn.frame.planes);
        let image = &drawn.frame.image;
        let run = RunResult {
            technique: name.into(),
            parameters: drawn.parameters,
            device: device_words(&self.stage.scene.device),
            image: ImageResult { path, width: image.width(), height: image.height(), hash: image.hash() },
            prepare_ms: drawn.prepare.median,
            frame_ms: drawn.draw.median,
            structure_bytes: drawn.structure_bytes,
            counts: ByName::from_pairs(drawn.frame.counts.iter().copied()),
            error: self.error(image)?,
            buffers: buffers?,
        };
        Ok((run, drawn.frame))
    }

    /// How far a picture is from the truth; `None` where that was not computed.
    fn error(&self, image: &Buffer<[u8; 4]>) -> Result<Option<ErrorResult>> {
        let Some(certified) = self.certified else { return Ok(None) };
        let metrics = certified.metrics(image)?;
        Ok(Some(ErrorResult {
            max: metrics.max,
            mean: metrics.mean,
            rmse: metrics.rmse,
            p99: metrics.p99,
            over_one_code_value: metrics.over_one_code_value,
            reference_width_max: certified.truth.widest(),
        }))
    }

    /// Stages buffers of a technique that has such.
    fn stage_planes(
        &mut self,
        (technique, kinds): (&str, &[PlaneKind]),
        planes: &[Plane],
    ) -> Result<Vec<BufferResult>> {
        let undeclared = |plane: &Plane| Error::internal(format!("{technique} declares no `{}`", plane.name));
        let is_elsewhere = self.is_elsewhere;
        let stage = |plane: &Plane| {
            let kind = kinds.iter().find(|kind| kind.name == plane.name);
            self.stage_plane(technique, kind.ok_or_else(|| undeclared(plane))?, plane)
        };
        planes.iter().filter(|plane| !is_elsewhere(plane.name)).map(stage).collect()
    }

    /// Stages a buffer's values and, where it has one, its picture.
    fn stage_plane(&mut self, technique: &str, kind: &PlaneKind, plane: &Plane) -> Result<BufferResult> {
        let file = |extension: &str| format!("{technique}.{}.{extension}", plane.name);
        let checked = Npy::new(plane)?;
        let moved = kind.is_in_plan.then(|| absolute(plane, self.stage.scene.origin.truncate()));
        let written = moved.as_ref().unwrap_or(plane);
        let npy = Npy::new(written)?;
        self.batch.stage(&file("npy"), |to| npy.write(to))?;
        if let Some(picture) = look(checked, kind.look) {
            self.batch.stage(&file("png"), |to| write_png(&picture, to))?;
        }
        let bytes = written.values.bytes();
        Ok(BufferResult { name: plane.name.into(), path: file("npy"), bytes, hash: plane.hash() })
    }
}
