//! What `render` and `report` measure: the truth of a stage, a technique's picture, and the times of both.

use super::bar::Bar;
use drapery::buffer::Buffer;
use drapery::compare::{Difference, Expected, Image, Metrics};
use drapery::output::{ByName, SceneResult};
use drapery::parameter::{Settings, Value};
use drapery::report::{self, TRUTH, Times};
use drapery::scene::Device;
use drapery::scene_file::SceneFile;
use drapery::space::ViewFrame;
use drapery::stage::Stage;
use drapery::technique::{self, Frame, FrameOptions, Kind, Prepared};
use drapery::truth::{self, Budget, Truth};
use drapery::visibility::TILE;
use drapery::{Error, Result};
use serde_json::Value as Json;
use std::time::Instant;

/// How exact the truth is; every run's error is its distance from it.
#[derive(Debug, Clone, Copy, clap::Args)]
pub(super) struct TruthArguments {
    /// Refine each pixel of the truth until no channel's interval is wider than this (units of 1, not of 255).
    #[arg(long = "truth-width", value_name = "W", default_value_t = Budget::default().width)]
    width: f64,
    /// Cut a pixel of the truth into at most 2^D pieces; what is open then stays in the interval.
    #[arg(long = "truth-depth", value_name = "D", default_value_t = Budget::default().depth)]
    depth: u32,
}

impl TruthArguments {
    pub(super) fn budget(&self) -> Result<Budget> {
        Budget::new(self.width, self.depth)
    }
}

/// The truth of a stage, and what it took.
pub(super) struct Certified {
    pub(super) truth: Truth,
    pub(super) budget: Budget,
    pub(super) times: Times,
    expected: Expected,
}

impl Certified {
    /// Computes the truth so many times.
    pub(super) fn of(
        (stage, view): (&Stage, &ViewFrame),
        budget: &Budget,
        repeat: u32,
        bar: &Bar,
    ) -> Result<Self> {
        bar.start(TRUTH);
        let once = || truth::certify(stage, view, budget, &|share| bar.done(share));
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
        Ok(Self { truth, budget: *budget, times: Times::of(times), expected })
    }

    /// How far the values of a picture are from the truth.
    pub(super) fn difference(&self, image: &Image) -> Result<Difference> {
        let difference = Difference::of(&self.expected, image);
        difference.map_err(|what| Error::internal(format!("against the truth: {what}")))
    }

    /// How far a picture is from the truth.
    pub(super) fn metrics(&self, image: &Buffer<[u8; 4]>) -> Result<Metrics> {
        Ok(self.difference(&Image::from_rgba8(image)?)?.metrics(0.0))
    }

    /// The budget by the names of [`TruthArguments`].
    pub(super) fn parameters(&self) -> ByName {
        let Budget { width, depth, .. } = self.budget;
        ByName::from_pairs([("width", Json::from(width)), ("depth", Json::from(depth))])
    }

    /// What was done.
    pub(super) fn counts(&self) -> ByName {
        let tally = &self.truth.tally;
        ByName::from_pairs([
            ("triangles", tally.triangles),
            ("fragments", tally.fragments),
            ("pieces", tally.pieces),
            ("wide_pixels", tally.wide_pixels),
        ])
    }
}

/// The techniques that draw a scene; the others are told of.
pub(super) fn applicable(stage: &Stage, bar: &Bar) -> Result<Vec<Kind>> {
    let mut kinds = Vec::new();
    for kind in Kind::ALL {
        match technique::applies(kind, stage) {
            Ok(()) => kinds.push(kind),
            Err(error) if error.is_internal() => return Err(error),
            Err(error) => bar.say(&format!("note: {} is left out: {}", kind.name(), error.what())),
        }
    }
    Ok(kinds)
}

/// A technique's last frame and what is told of all.
pub(super) struct Drawn {
    pub(super) frame: Frame,
    pub(super) parameters: ByName,
    pub(super) structure_bytes: usize,
    pub(super) prepare: Times,
    pub(super) draw: Times,
}

impl Drawn {
    /// Prepares and draws as often as is asked for; then once more where there are buffers to make, which cost time
    /// that is not the technique's.
    pub(super) fn by(
        kind: Kind,
        (stage, view): (&Stage, &ViewFrame),
        (repeat, wants_buffer): (u32, &dyn Fn(&str) -> bool),
        bar: &Bar,
    ) -> Result<Self> {
        let (mut prepare_ms, mut frame_ms) = (Vec::new(), Vec::new());
        let mut drawn: Option<Self> = None;
        for turn in 1..=repeat {
            let (prepared, ms) = timed(|| technique::prepare(kind, stage))?;
            prepare_ms.push(ms);
            let (mut frame, ms) = timed(|| frame((&*prepared, view), &[], bar))?;
            frame_ms.push(ms);
            if drawn.as_ref().is_some_and(|before| before.frame.image != frame.image) {
                return Err(unequal(kind.name()));
            }
            let buffers = buffers_of(kind, wants_buffer);
            if turn == repeat && !buffers.is_empty() {
                let with_buffers = self::frame((&*prepared, view), &buffers, bar)?;
                if with_buffers.image != frame.image {
                    return Err(unequal(kind.name()));
                }
                frame = with_buffers;
            }
            drawn = Some(Self {
                frame,
                parameters: ByName::from_pairs(kind.parameters(&stage.scene.technique)),
                structure_bytes: prepared.structure_bytes(),
                prepare: Times::of(Vec::new()),
                draw: Times::of(Vec::new()),
            });
        }
        let drawn = drawn.ok_or_else(|| Error::internal("no frame was asked for"))?;
        Ok(Self { prepare: Times::of(prepare_ms), draw: Times::of(frame_ms), ..drawn })
    }
}

fn frame((prepared, view): (&dyn Prepared, &ViewFrame), buffers: &[String], bar: &Bar) -> Result<Frame> {
    prepared.frame(view, &FrameOptions { tile: TILE, buffers, progress: &|share| bar.done(share) })
}

/// The names to ask a technique for.
fn buffers_of(kind: Kind, wants: &dyn Fn(&str) -> bool) -> Vec<String> {
    kind.buffer_names().into_iter().filter(|name| wants(name)).collect()
}

/// A device as a scene file writes it under `[device]`.
pub(super) fn device_words(device: &Device) -> ByName {
    // Its numbers have always had a point in files.
    let spelt = |value| if let Value::Number(number) = value { number.into() } else { Json::from(value) };
    ByName::from_pairs(device.values().into_iter().map(|(name, value)| (name, spelt(value))))
}

/// What is told of a scene.
pub(super) fn scene_result(stage: &Stage, file: &SceneFile) -> SceneResult {
    let scene = &stage.scene;
    SceneResult {
        name: scene.name.clone(),
        hash: file.hash.clone(),
        plan_space: scene.plan_space.clone(),
        origin: scene.origin.truncate().to_array(),
        origin_height: scene.origin.z,
    }
}

/// Two pictures of one scene that should be the same are not.
pub(super) fn unequal(what: &str) -> Error {
    Error::internal(format!("two frames of {what} of the same scene differ"))
}

/// What `f` returns, and the milliseconds it took.
pub(super) fn timed<T>(f: impl FnOnce() -> Result<T>) -> Result<(T, f64)> {
    let start = Instant::now();
    let done = f()?;
    Ok((done, start.elapsed().as_secs_f64() * 1000.0))
}
