//! A case drawn anew.

use super::case::Case;
use super::manifest::{BufferHash, Entry};
use crate::allowed;
use crate::buffer::{Buffer, Plane};
use crate::compare::{Gates, Image, Judgement, Submitted};
use crate::error::Result;
use crate::scene_file::{Override, SceneFile};
use crate::source::load;
use crate::space::ViewFrame;
use crate::stage::Stage;
use crate::technique::{self, FrameOptions, Kind};
use crate::truth::{self, Budget, Truth};
use crate::visibility::TILE;
use std::path::PathBuf;

/// The picture's name among the buffers.
pub const IMAGE: &str = "image";

/// How the names begin of what is no buffer of a frame, but what the judge allows of it.
const OF_THE_JUDGE: &str = "allowed-";

/// Whether a hash is of what the judge allows.
pub(super) fn is_of_the_judge(name: &str) -> bool {
    name.starts_with(OF_THE_JUDGE)
}

/// What a technique draws of a case.
#[derive(Debug, Clone, PartialEq)]
pub struct Replay {
    /// The technique's name.
    pub technique: &'static str,
    /// The picture.
    pub image: Buffer<[u8; 4]>,
    /// The hashes of the buffers, from the first stage to the last, the picture; of a case that is judged those of what is allowed, too.
    pub hashes: Vec<BufferHash>,
    /// What the judge says of the picture, where it is not allowed.
    pub refusal: Option<String>,
}

impl Replay {
    /// What the manifest says when this is right.
    pub fn entry(&self, case: &str) -> Entry {
        Entry {
            case: case.to_owned(),
            technique: self.technique.to_owned(),
            size: (self.image.width(), self.image.height()),
            hashes: self.hashes.clone(),
        }
    }
}

/// How a frame is cut; no pixel depends on it.
#[derive(Debug, Clone, Copy)]
pub(super) enum Cut {
    /// As `render` does.
    Usual,
    /// Into tiles that do not fit.
    Small,
}

/// Draws a case, changed by `more`: the truth, and every technique that applies.
pub(super) fn replay(case: &Case, more: &[Override], cut: Cut) -> Result<Vec<Replay>> {
    let overrides = [&case.set[..], more].concat();
    let file = SceneFile::read(&case.scene, &overrides)?;
    let (scene, surface) = load::load(&file, &|_| {})?;
    let stage = Stage::new(scene, surface).map_err(|error| error.in_file(&case.scene))?;
    let view = stage.view().map_err(|error| error.in_file(&case.scene))?;
    let mut replays = vec![certified(&stage, &view)];
    for kind in Kind::ALL {
        match technique::applies(kind, &stage) {
            Ok(()) => {
                let mut replay = draw(kind, (&stage, &view), cut)?;
                // Variants are held against the same pictures: what is allowed of them is known.
                if case.is_judged && more.is_empty() && matches!(cut, Cut::Usual) {
                    judge(kind, (&stage, &view), &mut replay)?;
                }
                replays.push(replay);
            }
            Err(error) if error.is_internal() => return Err(error),
            Err(_) => {}
        }
    }
    Ok(replays)
}

/// The truth of a stage; it is always cut alike, and only threads can differ.
fn certified(stage: &Stage, view: &ViewFrame) -> Replay {
    let truth = truth::certify(stage, view, &Budget::default(), &|_| {});
    let planes = Truth::PLANES.iter().filter_map(|kind| truth.plane(kind.name));
    let mut hashes: Vec<BufferHash> =
        planes.map(|plane| BufferHash { buffer: plane.name.to_owned(), blake3: plane.hash() }).collect();
    let image = truth.image();
    hashes.push(BufferHash { buffer: IMAGE.to_owned(), blake3: image.hash() });
    Replay { technique: truth::NAME, image, hashes, refusal: None }
}

fn draw(kind: Kind, (stage, view): (&Stage, &ViewFrame), cut: Cut) -> Result<Replay> {
    let prepared = technique::prepare(kind, stage)?;
    let planes = kind.declaration().planes.iter().filter(|plane| !plane.is_structure && !plane.is_pick());
    let names: Vec<String> = planes.map(|plane| plane.name.to_owned()).collect();
    let tile = match cut {
        Cut::Usual => TILE,
        Cut::Small => 24,
    };
    let frame = prepared.frame(view, &FrameOptions { tile, buffers: &names, progress: &|_| {} })?;
    let plane = |name: &String| frame.planes.iter().find(|plane| plane.name == name);
    let hash = |plane: &Plane| BufferHash { buffer: plane.name.to_owned(), blake3: plane.hash() };
    let mut hashes: Vec<BufferHash> = names.iter().filter_map(plane).map(hash).collect();
    hashes.push(BufferHash { buffer: IMAGE.to_owned(), blake3: frame.image.hash() });
    Ok(Replay { technique: kind.name(), image: frame.image, hashes, refusal: None })
}

/// Adds what right programs may draw, and what the judge says of the picture; nothing for a technique that nobody can judge.
fn judge(kind: Kind, (stage, view): (&Stage, &ViewFrame), replay: &mut Replay) -> Result<()> {
    let all = match allowed::allowed(kind, (stage, view), &|_| {}) {
        Ok(all) => all,
        Err(error) if error.is_internal() => return Err(error),
        Err(_) => return Ok(()),
    };
    for hypothesis in &all.hypotheses {
        for (end, codes) in [("lo", &hypothesis.lo), ("hi", &hypothesis.hi)] {
            let codes = Buffer::from_values(all.width, all.height, codes.clone());
            let buffer = format!("{OF_THE_JUDGE}{}-{end}", hypothesis.name);
            replay.hashes.push(BufferHash { buffer, blake3: codes.hash() });
        }
    }
    let picture = Submitted::picture(Image::from_rgba8(&replay.image)?, PathBuf::new());
    let judgement = Judgement::on(&all, &picture, Gates::default());
    replay.refusal = (!judgement.passed()).then(|| judgement.to_string());
    Ok(())
}

/// The first buffer in which two replays or entries differ, of those that are `wanted`: one that only one of them has
/// differs too.
pub(super) fn first_difference(
    expected: &[BufferHash],
    actual: &[BufferHash],
    wanted: impl Fn(&str) -> bool,
) -> Option<String> {
    let differs = |one: &&BufferHash, others: &[BufferHash]| wanted(&one.buffer) && !others.contains(one);
    let new = actual.iter().find(|hash| differs(hash, expected));
    let lost = expected.iter().find(|hash| differs(hash, actual));
    new.or(lost).map(|hash| hash.buffer.clone())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hashes(of: &[(&str, &str)]) -> Vec<BufferHash> {
        of.iter()
            .map(|(buffer, blake3)| BufferHash { buffer: (*buffer).into(), blake3: (*blake3).into() })
            .collect()
    }

    #[test]
    fn the_first_stage_that_differs_is_told() {
        let known = hashes(&[("depth", "0"), ("class", "1"), ("image", "2")]);
        let first = |actual: &[(&str, &str)]| first_difference(&known, &hashes(actual), |_| true);
        assert_eq!(first(&[("depth", "0"), ("class", "1"), ("image", "2")]), None);
        assert_eq!(first(&[("depth", "0"), ("class", "x"), ("image", "y")]), Some("class".into()));
        assert_eq!(first(&[("depth", "0"), ("class", "1"), ("image", "y")]), Some("image".into()));
        assert_eq!(first(&[("depth", "0"), ("image", "2")]), Some("class".into()), "a buffer that is gone");
        let more = [("depth", "0"), ("class", "1"), ("edges", "3"), ("image", "2")];
        assert_eq!(first(&more), Some("edges".into()), "a buffer that is new");
        let other = hashes(&[("depth", "x"), ("class", "1"), ("image", "2")]);
        assert_eq!(first_difference(&known, &other, |name| name == "image"), None);
    }
}
