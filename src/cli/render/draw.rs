//! One technique's run: timed, and its files staged.

use super::techniques::Buffers;
use crate::cli::bar::Bar;
use drapery::buffer::Plane;
use drapery::output::{Batch, BufferResult, ByName, ErrorResult, ImageResult, Npy, RunResult};
use drapery::output::{absolute, look, write_png};
use drapery::scene::Device;
use drapery::scene::file::Named;
use drapery::technique::{self, Frame, FrameOptions, Kind, Prepared, Stage};
use drapery::visibility::TILE;
use drapery::{Error, Result};
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
    pub(super) batch: &'a mut Batch,
    pub(super) bar: &'a Bar,
}

impl Drawing<'_> {
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
            error: ErrorResult::default(),
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
    let is_wanted = |name: &&&str| match wanted {
        Buffers::All => true,
        Buffers::Named(names) => names.iter().any(|wanted| wanted == **name),
    };
    let names = prepared.buffer_names().iter().filter(is_wanted);
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
