//! A technique's picture, timed.

use super::{Times, Watch, timed, unequal};
use crate::error::{Error, Result};
use crate::output::ByName;
use crate::space::ViewFrame;
use crate::stage::Stage;
use crate::technique::{self, Frame, FrameOptions, Kind, Prepared};
use crate::visibility::TILE;

/// The techniques that draw a scene; of the others the watch is told.
///
/// # Errors
/// Internal errors only.
pub fn applicable(stage: &Stage, watch: &dyn Watch) -> Result<Vec<Kind>> {
    let mut kinds = Vec::new();
    for kind in Kind::ALL {
        match technique::applies(kind, stage) {
            Ok(()) => kinds.push(kind),
            Err(error) if error.is_internal() => return Err(error),
            Err(error) => watch.note(&format!("{} is left out: {}", kind.name(), error.what())),
        }
    }
    Ok(kinds)
}

/// A technique's last frame and what is told of all.
#[derive(Debug)]
pub struct Drawn {
    /// The frame, with the buffers that were wanted.
    pub frame: Frame,
    /// The parameters in use, by their names in the scene file.
    pub parameters: ByName,
    /// Bytes of the technique's structures.
    pub structure_bytes: usize,
    /// How long it took to build what does not depend on the view.
    pub prepare: Times,
    /// How long a frame took, without buffers.
    pub draw: Times,
}

impl Drawn {
    /// Prepares and draws `repeat` times (at least once); then once more where there are buffers to make, which cost time that is not
    /// the technique's.
    ///
    /// # Errors
    /// When the technique does not draw such a scene; an internal error where two frames differ.
    pub fn by(
        kind: Kind,
        (stage, view): (&Stage, &ViewFrame),
        (repeat, wants_buffer): (u32, &dyn Fn(&str) -> bool),
        watch: &dyn Watch,
    ) -> Result<Self> {
        let (mut prepare_ms, mut frame_ms) = (Vec::new(), Vec::new());
        let mut drawn: Option<Self> = None;
        for turn in 1..=repeat {
            watch.part("preparing");
            let progress = |share: f64| watch.done(share);
            let (prepared, ms) = timed(watch, || technique::prepare_telling(kind, stage, &progress))?;
            prepare_ms.push(ms);
            watch.part("drawing");
            let (mut frame, ms) = timed(watch, || frame((&*prepared, view), &[], watch))?;
            frame_ms.push(ms);
            if drawn.as_ref().is_some_and(|before| before.frame.image != frame.image) {
                return Err(unequal(kind.name()));
            }
            let buffers = buffers_of(kind, wants_buffer);
            if turn == repeat && !buffers.is_empty() {
                watch.part("buffers");
                let with_buffers = self::frame((&*prepared, view), &buffers, watch)?;
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
        let drawn = drawn.ok_or_else(|| Error::usage("no frame was asked for"))?;
        Ok(Self { prepare: Times::of(prepare_ms), draw: Times::of(frame_ms), ..drawn })
    }
}

/// What is told of one of several views of one preparation.
#[derive(Debug)]
pub struct Seen {
    /// How long a frame took.
    pub draw: Times,
    /// What was done in it.
    pub counts: Vec<(&'static str, u64)>,
    /// Bytes of the technique's structures after it.
    pub structure_bytes: usize,
}

/// Prepares once and draws each view `repeat` times (at least once), without buffers; also returns how long preparing took.
///
/// # Errors
/// When the technique does not draw such a scene.
pub fn flight(
    kind: Kind,
    (stage, views): (&Stage, &[ViewFrame]),
    repeat: u32,
    watch: &dyn Watch,
) -> Result<(Times, Vec<Seen>)> {
    watch.part("preparing");
    let (prepared, ms) = timed(watch, || technique::prepare(kind, stage))?;
    watch.part("drawing");
    let mut seen = Vec::with_capacity(views.len());
    for view in views {
        let (mut times, mut counts) = (Vec::new(), Vec::new());
        for _ in 0..repeat.max(1) {
            let (frame, ms) = timed(watch, || frame((&*prepared, view), &[], watch))?;
            times.push(ms);
            counts = frame.counts;
        }
        seen.push(Seen { draw: Times::of(times), counts, structure_bytes: prepared.structure_bytes() });
    }
    Ok((Times::of(vec![ms]), seen))
}

fn frame(
    (prepared, view): (&dyn Prepared, &ViewFrame),
    buffers: &[String],
    watch: &dyn Watch,
) -> Result<Frame> {
    prepared.frame(view, &FrameOptions { tile: TILE, buffers, progress: &|share| watch.done(share) })
}

/// The names to ask a technique for.
fn buffers_of(kind: Kind, wants: &dyn Fn(&str) -> bool) -> Vec<String> {
    kind.buffer_names().into_iter().filter(|name| wants(name)).collect()
}
