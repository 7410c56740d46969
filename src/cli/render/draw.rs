//! One technique's run, its files staged.

use super::techniques::Buffers;
use crate::cli::bar::Bar;
use crate::cli::measure::{Certified, Drawn, device_words};
use drapery::buffer::{Buffer, Plane, PlaneKind};
use drapery::output::{Batch, BufferResult, ByName, ErrorResult, ImageResult, Npy, RunResult};
use drapery::output::{absolute, look, write_png};
use drapery::report::TRUTH;
use drapery::scene::Device;
use drapery::space::ViewFrame;
use drapery::stage::Stage;
use drapery::technique::{Frame, Kind};
use drapery::truth::Truth;
use drapery::{Error, Result};

/// What is wanted of each technique.
pub(in crate::cli) struct Wish {
    pub(in crate::cli) buffers: Buffers,
    /// How many runs to time.
    pub(in crate::cli) repeat: u32,
}

/// Draws a stage into a batch of files.
pub(in crate::cli) struct Drawing<'a> {
    pub(in crate::cli) stage: &'a Stage,
    pub(in crate::cli) view: &'a ViewFrame,
    pub(in crate::cli) certified: &'a Certified,
    pub(in crate::cli) batch: &'a mut Batch,
    pub(in crate::cli) bar: &'a Bar,
}

impl Drawing<'_> {
    /// Stages the truth's files.
    pub(in crate::cli) fn truth(&mut self, wish: &Wish) -> Result<RunResult> {
        let certified = self.certified;
        let truth = &certified.truth;
        let image = truth.image();
        let path = format!("{TRUTH}.png");
        self.batch.stage(&path, |to| write_png(&image, to))?;
        let kinds = Truth::PLANES.iter().filter(|kind| wish.buffers.wants(kind.name));
        let planes: Vec<Plane> = kinds.filter_map(|kind| truth.plane(kind.name)).collect();
        let buffers = self.stage_planes((TRUTH, &Truth::PLANES), &planes);
        Ok(RunResult {
            technique: TRUTH.into(),
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

    /// Runs a technique and stages its files; what is told of it, and its frame.
    pub(in crate::cli) fn run(&mut self, kind: Kind, wish: &Wish) -> Result<(RunResult, Frame)> {
        self.bar.start(kind.name());
        let wants_buffer = |name: &str| wish.buffers.wants(name);
        let drawn = Drawn::by(kind, (self.stage, self.view), (wish.repeat, &wants_buffer), self.bar)?;
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

    /// How far a picture is from the truth.
    fn error(&self, image: &Buffer<[u8; 4]>) -> Result<ErrorResult> {
        let metrics = self.certified.metrics(image)?;
        Ok(ErrorResult {
            max: Some(metrics.max),
            mean: Some(metrics.mean),
            rmse: Some(metrics.rmse),
            p99: Some(metrics.p99),
            over_one_code_value: Some(metrics.over_one_code_value),
            reference_width_max: Some(self.certified.truth.widest()),
        })
    }

    /// Stages buffers of a technique that has such.
    fn stage_planes(
        &mut self,
        (technique, kinds): (&str, &[PlaneKind]),
        planes: &[Plane],
    ) -> Result<Vec<BufferResult>> {
        let undeclared = |plane: &Plane| Error::internal(format!("{technique} declares no `{}`", plane.name));
        let stage = |plane: &Plane| {
            let kind = kinds.iter().find(|kind| kind.name == plane.name);
            self.stage_plane(technique, kind.ok_or_else(|| undeclared(plane))?, plane)
        };
        planes.iter().map(stage).collect()
    }

    /// Stages a buffer's values and, where it has one, its picture.
    fn stage_plane(&mut self, technique: &str, kind: &PlaneKind, plane: &Plane) -> Result<BufferResult> {
        let file = |extension: &str| format!("{technique}.{}.{extension}", plane.name);
        let checked = Npy::new(plane)?;
        if kind.is_in_plan {
            let moved = absolute(plane, self.stage.scene.origin.truncate());
            let moved = Npy::new(&moved)?;
            self.batch.stage(&file("npy"), |to| moved.write(to))?;
        } else {
            self.batch.stage(&file("npy"), |to| checked.write(to))?;
        }
        if let Some(picture) = look(checked, kind.look) {
            self.batch.stage(&file("png"), |to| write_png(&picture, to))?;
        }
        Ok(BufferResult { name: plane.name.into(), path: file("npy"), hash: plane.hash() })
    }
}
