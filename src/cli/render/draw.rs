//! One technique's run: timed, and its files staged.

use super::techniques::Buffers;
use crate::cli::bar::Bar;
use drapery::buffer::{Buffer, Plane};
use drapery::compare::{Difference, Expected, Image};
use drapery::output::{Batch, BufferResult, ByName, ErrorResult, ImageResult, Npy, RunResult};
use drapery::output::{absolute, look, write_png};
use drapery::scene::Device;
use drapery::scene::file::Named;
use drapery::technique::{self, Frame, FrameOptions, Kind, Prepared, Stage};
use drapery::truth::{self, Budget, Truth};
use drapery::visibility::TILE;
use drapery::{Error, Result, report};
use serde_json::Value;
use std::time::Instant;

/// The buffers that hold plan coordinates: scene-local in memory, absolute in files.
const IN_PLAN: [&str; 2] = ["plan", "quad"];

/// What is wanted of each technique.
pub(super) struct Wish {
    pub(super) buffers: Buffers,
    /// How many runs to time.
    pub(super) repeat: u32,
}

/// Draws a stage into a batch of files.
pub(super) struct Drawing<'a> {
    pub(super) stage: &'a Stage,
    pub(super) certified: &'a Certified,
    pub(super) batch: &'a mut Batch,
    pub(super) bar: &'a Bar,
}

/// The truth of a stage, and what it took.
pub(super) struct Certified {
    truth: Truth,
    expected: Expected,
    budget: Budget,
    frame_ms: f64,
}

impl Certified {
    /// Computes the truth so many times.
    pub(super) fn of(stage: &Stage, budget: &Budget, repeat: u32, bar: &Bar) -> Result<Self> {
        bar.start(truth::NAME);
        let once =
            || truth::certify(&stage.scene, &stage.mesh, &stage.view, budget, &|share| bar.done(share));
        let (mut truth, first) = timed(|| Ok(once()))?;
        let mut times = vec![first];
        for _ in 1..repeat {
            let (again, ms) = timed(|| Ok(once()))?;
            if again.low != truth.low || again.high != truth.high {
                return Err(Error::internal("two truths of the same scene differ"));
            }
            (truth, _) = (again, times.push(ms));
        }
        let expected = report::expected(&truth)?;
        Ok(Self { truth, expected, budget: *budget, frame_ms: median(times) })
    }

    /// How far a picture is from the truth.
    fn error(&self, image: &Buffer<[u8; 4]>) -> Result<ErrorResult> {
        let difference = Difference::of(&self.expected, &Image::from_rgba8(image)?);
        let difference = difference.map_err(|what| Error::internal(format!("against the truth: {what}")))?;
        let metrics = difference.metrics(0.0);
        Ok(ErrorResult {
            max: Some(metrics.max),
            mean: Some(metrics.mean),
            rmse: Some(metrics.rmse),
            p99: Some(metrics.p99),
            over_one_code_value: Some(metrics.over_one_code_value),
            reference_width_max: Some(self.truth.widest()),
        })
    }
}

impl Drawing<'_> {
    /// Stages the truth's files.
    pub(super) fn truth(&mut self, wish: &Wish) -> Result<RunResult> {
        let Certified { truth, budget, frame_ms, .. } = self.certified;
        let image = truth.image();
        let path = format!("{}.png", truth::NAME);
        self.batch.stage(&path, |to| write_png(&image, to))?;
        let names = Truth::BUFFERS.iter().filter(|name| wish.buffers.wants(name));
        let planes: Vec<Plane> = names.filter_map(|name| truth.plane(name)).collect();
        let buffers: Result<_> = planes.iter().map(|plane| self.stage_plane(truth::NAME, plane)).collect();
        let counts = [
            ("triangles", truth.tally.triangles),
            ("fragments", truth.tally.fragments),
            ("pieces", truth.tally.pieces),
            ("wide_pixels", truth.tally.wide_pixels),
        ];
        Ok(RunResult {
            technique: truth::NAME.into(),
            parameters: ByName::from_pairs([
                ("width", Value::from(budget.width)),
                ("depth", Value::from(budget.depth)),
            ]),
            device: device_words(&Device::default()),
            image: ImageResult { path, width: image.width(), height: image.height(), hash: image.hash() },
            prepare_ms: 0.0,
            frame_ms: *frame_ms,
            structure_bytes: truth.structure_bytes,
            counts: ByName::from_pairs(counts),
            error: self.certified.error(&image)?,
            buffers: buffers?,
        })
    }

    /// Runs a technique and stages its files.
    pub(super) fn run(&mut self, kind: Kind, wish: &Wish) -> Result<RunResult> {
        let drawn = self.draw(kind, wish)?;
        let name = kind.name();
        let path = format!("{name}.png");
        self.batch.stage(&path, |to| write_png(&drawn.frame.image, to))?;
        let planes = drawn.frame.planes.iter();
        let buffers: Result<_> = planes.map(|plane| self.stage_plane(name, plane)).collect();
        let image = &drawn.frame.image;
        Ok(RunResult {
            technique: name.into(),
            parameters: drawn.parameters,
            device: device_words(&self.stage.scene.device),
            image: ImageResult { path, width: image.width(), height: image.height(), hash: image.hash() },
            prepare_ms: drawn.prepare_ms,
            frame_ms: drawn.frame_ms,
            structure_bytes: drawn.structure_bytes,
            counts: ByName::from_pairs(drawn.frame.counts.iter().copied()),
            error: self.certified.error(image)?,
            buffers: buffers?,
        })
    }

    /// Prepares and draws as often as is asked for; then once more where there are buffers to make, which cost time
    /// that is not the technique's.
    fn draw(&self, kind: Kind, wish: &Wish) -> Result<Drawn> {
        self.bar.start(kind.name());
        let (mut prepare_ms, mut frame_ms) = (Vec::new(), Vec::new());
        let mut drawn: Option<Drawn> = None;
        for turn in 1..=wish.repeat {
            let (prepared, ms) = timed(|| technique::prepare(kind, self.stage))?;
            prepare_ms.push(ms);
            let (mut frame, ms) = timed(|| self.frame(&*prepared, &[]))?;
            frame_ms.push(ms);
            if drawn.as_ref().is_some_and(|before| before.frame.image != frame.image) {
                return Err(unequal(kind));
            }
            let buffers = buffers_of(&*prepared, &wish.buffers);
            if turn == wish.repeat && !buffers.is_empty() {
                let with_buffers = self.frame(&*prepared, &buffers)?;
                if with_buffers.image != frame.image {
                    return Err(unequal(kind));
                }
                frame = with_buffers;
            }
            drawn = Some(Drawn {
                frame,
                parameters: ByName::from_texts(prepared.parameters()),
                structure_bytes: prepared.structure_bytes(),
                prepare_ms: 0.0,
                frame_ms: 0.0,
            });
        }
        let drawn = drawn.ok_or_else(|| Error::internal("no frame was asked for"))?;
        Ok(Drawn { prepare_ms: median(prepare_ms), frame_ms: median(frame_ms), ..drawn })
    }

    fn frame(&self, prepared: &dyn Prepared, buffers: &[String]) -> Result<Frame> {
        prepared.frame(&FrameOptions { tile: TILE, buffers, progress: &|share| self.bar.done(share) })
    }

    /// Stages a buffer's values and, where it has one, its picture.
    fn stage_plane(&mut self, technique: &str, plane: &Plane) -> Result<BufferResult> {
        let file = |extension: &str| format!("{technique}.{}.{extension}", plane.name);
        let checked = Npy::new(plane)?;
        if IN_PLAN.contains(&plane.name) {
            let moved = absolute(plane, self.stage.scene.origin);
            let moved = Npy::new(&moved)?;
            self.batch.stage(&file("npy"), |to| moved.write(to))?;
        } else {
            self.batch.stage(&file("npy"), |to| checked.write(to))?;
        }
        if let Some(picture) = look(checked) {
            self.batch.stage(&file("png"), |to| write_png(&picture, to))?;
        }
        Ok(BufferResult { name: plane.name.into(), path: file("npy"), hash: plane.hash() })
    }
}

/// A technique's last frame and what is told of all.
struct Drawn {
    frame: Frame,
    parameters: ByName,
    structure_bytes: usize,
    prepare_ms: f64,
    frame_ms: f64,
}

/// The names to ask a technique for.
fn buffers_of(prepared: &dyn Prepared, wanted: &Buffers) -> Vec<String> {
    let names = prepared.buffer_names().iter().filter(|name| wanted.wants(name));
    names.map(|name| (*name).to_owned()).collect()
}

/// A device as a scene file writes it under `[device]`.
fn device_words(device: &Device) -> ByName {
    ByName::from_pairs([
        ("precision", Value::from(device.precision.word())),
        ("subpixel_bits", device.subpixel_bits.into()),
        ("depth", device.depth.word().into()),
        ("stencil_bits", device.stencil_bits.into()),
        ("max_line_width_px", device.max_line_width_px.into()),
    ])
}

fn unequal(kind: Kind) -> Error {
    Error::internal(format!("two frames of {} of the same scene differ", kind.name()))
}

/// What `f` returns, and the milliseconds it took.
fn timed<T>(f: impl FnOnce() -> Result<T>) -> Result<(T, f64)> {
    let start = Instant::now();
    let done = f()?;
    Ok((done, start.elapsed().as_secs_f64() * 1000.0))
}

/// The median to the microsecond; of two in the middle, the mean.
fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    let (low, high) = (times.len().saturating_sub(1) / 2, times.len() / 2);
    let middle = |at: usize| times.get(at).copied().unwrap_or(0.0);
    ((middle(low) + middle(high)) * 500.0).round() / 1000.0
}

#[cfg(test)]
mod tests {
    use super::median;

    #[test]
    fn a_median_is_not_moved_by_one_slow_run() {
        assert_eq!(median(vec![3.0]), 3.0);
        assert_eq!(median(vec![900.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(vec![900.0, 1.0, 2.0, 2.5]), 2.25);
    }
}
