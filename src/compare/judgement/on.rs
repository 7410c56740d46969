//! The judgement on a frame.

use super::fit::{Fit, Picture};
use super::gates::Gates;
use super::involved::{Involved, involved};
use super::lean::{Lean, Lopsided};
use super::stages::{StageFound, stages};
use crate::buffer::Buffer;
use crate::compare::allowed::Allowed;
use crate::compare::difference::Difference;
use crate::compare::expected::{Mismatch, Side};
use crate::compare::image::Image;
use crate::compare::metrics::{Metrics, densest};
use crate::compare::submitted::Submitted;
use std::fmt;

/// A frame, judged by what is allowed.
#[derive(Debug, Clone, PartialEq)]
pub struct Judgement {
    /// What it may have wrong.
    pub gates: Gates,
    /// What was found, or why nothing can be.
    pub outcome: std::result::Result<Fitted, Mismatch>,
}

/// What was found of a frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Fitted {
    /// The hypotheses in their order, all of them.
    pub tried: Vec<Tried>,
    /// The one that fits best, by its place: the first that passes, else the first that passes weakly, else the one with the fewest
    /// failing pixels. What follows is by it.
    pub best: usize,
    /// How far each value lies outside.
    pub difference: Difference,
    /// In numbers. A pixel fails when any of its values lies outside.
    pub metrics: Metrics,
    /// To which side the open pixels lean.
    pub lean: Lean,
    /// The buffers, in the order of the stages.
    pub stages: Vec<StageFound>,
    /// The features that have a say in failing pixels, most first.
    pub features: Vec<Involved>,
}

/// A hypothesis that was tried.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Tried {
    /// Its name.
    pub name: String,
    /// The pixels that lie outside.
    pub failing: usize,
}

/// The verdict, from the best to the worst.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Ruling {
    /// All is as it may be.
    Pass,
    /// Inside of what is allowed, but what is open was decided one way.
    Weak,
    /// Not allowed.
    Fail,
}

impl Judgement {
    /// Judges a frame: each hypothesis is tried on the whole picture.
    ///
    /// # Panics
    /// When there is no hypothesis, or what is allowed does not fill the picture.
    pub fn on(allowed: &Allowed, frame: &Submitted, gates: Gates) -> Self {
        let outcome = match mismatch(allowed, frame) {
            Some(mismatch) => Err(mismatch),
            None => Ok(fitted(allowed, frame, gates)),
        };
        Self { gates, outcome }
    }

    /// The verdict.
    pub fn ruling(&self) -> Ruling {
        match &self.outcome {
            _ if self.failure().is_some() => Ruling::Fail,
            Ok(fitted) if fitted.lean.lopsided().is_some() => Ruling::Weak,
            _ => Ruling::Pass,
        }
    }

    /// Whether it passed, by whatever margin.
    pub fn passed(&self) -> bool {
        self.failure().is_none()
    }

    /// The name of the failure in reports, where it failed.
    pub fn failure(&self) -> Option<&'static str> {
        let fitted = match &self.outcome {
            Ok(fitted) => fitted,
            Err(mismatch) => return Some(mismatch.name()),
        };
        let Gates { allow, strict, .. } = self.gates;
        if fitted.metrics.failing > allow {
            Some("outside")
        } else if fitted.in_window() > self.gates.densest {
            Some("dense")
        } else if strict && fitted.lean.lopsided().is_some() {
            Some("lopsided")
        } else {
            None
        }
    }

    /// Where and how far it is off, as a picture.
    pub fn heat_map(&self) -> Option<Buffer<[u8; 4]>> {
        Some(self.outcome.as_ref().ok()?.difference.heat_map(0.0))
    }
}

/// The judgement in a line.
impl fmt::Display for Judgement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let fitted = match &self.outcome {
            Ok(fitted) => fitted,
            Err(mismatch) => return write!(f, "FAIL: {mismatch}"),
        };
        let Gates { allow, densest, .. } = self.gates;
        let failing = fitted.metrics.failing;
        let pixels = fitted.difference.distances().values().len() / 4;
        let outside = format!("{failing} of {pixels} pixels are outside of what is allowed ({allow} may be)");
        let lean = || match fitted.lean.lopsided() {
            Some(Lopsided { pixels, of, to_drawn, .. }) => {
                let side = if to_drawn { "more" } else { "less" };
                format!("{pixels} of {of} open pixels were decided one way, so that {side} is drawn")
            }
            None => String::new(),
        };
        match (self.ruling(), self.failure()) {
            (_, Some("dense")) => {
                write!(
                    f,
                    "FAIL: {} pixels outside of what is allowed lie in one window ({densest} may be)",
                    fitted.in_window()
                )
            }
            (_, Some("lopsided")) => write!(f, "FAIL: {}", lean()),
            (_, Some(_)) => write!(f, "FAIL: {outside}"),
            (Ruling::Weak, _) => write!(f, "WEAK PASS: {outside}, but {}", lean()),
            _ => write!(f, "PASS: {outside}"),
        }
    }
}

impl Fitted {
    /// The failing pixels in the densest window.
    fn in_window(&self) -> usize {
        self.metrics.densest.map_or(0, |window| window.failing)
    }

    /// The first stage whose buffer differs.
    pub fn first_stage(&self) -> Option<&StageFound> {
        self.stages.iter().find(|stage| stage.differs())
    }
}

/// Why a frame cannot be judged.
fn mismatch(allowed: &Allowed, frame: &Submitted) -> Option<Mismatch> {
    let picture = &frame.picture;
    let (expected, actual) = ((allowed.width, allowed.height), (picture.width(), picture.height()));
    if expected != actual {
        return Some(Mismatch::Size { expected, actual });
    }
    if ![3, 4].contains(&picture.channels()) {
        return Some(Mismatch::Channels { expected: 4, actual: picture.channels() });
    }
    let counts = |pixel: usize| frame.ignored.as_ref().is_none_or(|ignored| !ignored[pixel]);
    let is_wrong = |(index, value): (usize, &f64)| value.is_nan() && counts(index / picture.channels());
    let index = picture.values().iter().enumerate().position(is_wrong)?;
    Some(Mismatch::NotANumber { side: Side::Actual, place: picture.place(index) })
}

/// A hypothesis on a picture.
struct Candidate {
    at: usize,
    fit: Fit,
    lean: Lean,
    /// Less is better: passed, passed but leaning, failed; then by failing pixels where it failed.
    rank: (Ruling, usize),
}

impl Candidate {
    fn of(allowed: &Allowed, at: usize, picture: &Picture, gates: Gates) -> Self {
        let hypothesis = &allowed.hypotheses[at];
        let fit = Fit::of(hypothesis, picture);
        let in_window = match fit.failing > gates.densest {
            true => densest(&fit.fails, allowed.width, allowed.height).map_or(0, |window| window.failing),
            false => fit.failing,
        };
        let lean = Lean::of(hypothesis, picture, &fit);
        let rank = if fit.failing > gates.allow || in_window > gates.densest {
            (Ruling::Fail, fit.failing)
        } else if lean.lopsided().is_some() {
            (Ruling::Weak, 0)
        } else {
            (Ruling::Pass, 0)
        };
        Self { at, fit, lean, rank }
    }
}

fn fitted(allowed: &Allowed, frame: &Submitted, gates: Gates) -> Fitted {
    let ignored = frame.ignored.as_deref();
    let picture = Picture::of(&frame.picture, ignored);
    let (width, height) = (allowed.width, allowed.height);
    let mut tried = vec![];
    let mut best = Candidate::of(allowed, 0, &picture, gates);
    for (at, hypothesis) in allowed.hypotheses.iter().enumerate() {
        let candidate = (at > 0).then(|| Candidate::of(allowed, at, &picture, gates));
        let failing = candidate.as_ref().unwrap_or(&best).fit.failing;
        tried.push(Tried { name: hypothesis.name.clone(), failing });
        if let Some(better) = candidate.filter(|candidate| candidate.rank < best.rank) {
            best = better;
        }
    }
    let distances = best.fit.distances(&allowed.hypotheses[best.at], &picture);
    let difference = Difference::known(Image::filled(width, height, 4, distances));
    let metrics = if best.fit.failing == 0 { Metrics::of_no_distance(4) } else { difference.metrics(0.0) };
    Fitted {
        tried,
        best: best.at,
        difference,
        metrics,
        lean: best.lean,
        stages: stages(&allowed.stages, (width, height), &frame.buffers, ignored),
        features: involved(&allowed.features, &best.fit.fails, width),
    }
}
