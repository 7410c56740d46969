//! The judgement on a frame.

use super::fit::{Fit, Picture};
use super::gates::Gates;
use super::involved::{Involved, involved};
use super::lean::{Lean, Lopsided};
use super::otherwise::{Otherwise, otherwise};
use super::stages::{StageFound, stages};
use crate::buffer::Buffer;
use crate::compare::allowed::Allowed;
use crate::compare::difference::Difference;
use crate::compare::expected::{Mismatch, Side};
use crate::compare::image::{Image, Samples};
use crate::compare::metrics::{Metrics, Window, densest, windows};
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
    /// Of a picture that fails, the other choices by which fewer pixels would, fewest first.
    pub otherwise: Vec<Otherwise>,
    /// Of each pixel, whether it fails.
    fails: Vec<bool>,
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
        } else if strict && fitted.first_stage().is_some() {
            Some("stage")
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
        let pixels = fitted.fails.len();
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
                    "FAIL: {} pixels outside of what is allowed lie in one window ({densest} may be){}",
                    fitted.in_window(),
                    fitted.instead()
                )
            }
            (_, Some("lopsided")) => write!(f, "FAIL: {}", lean()),
            (_, Some("stage")) => {
                let buffer = fitted.first_stage().map_or("", |stage| &stage.buffer);
                write!(f, "FAIL: {outside}, but the buffer `{buffer}` is not as allowed")
            }
            (_, Some(_)) => write!(f, "FAIL: {outside}{}", fitted.instead()),
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

    /// The windows with most failing pixels, none of which counts a pixel of another; most first, a few at most.
    pub fn windows(&self) -> Vec<Window> {
        let picture = self.difference.distances();
        windows(self.fails.clone(), picture.width(), picture.height())
    }

    /// By which other choice the picture would pass, after the verdict's sentence; empty: by none that is known.
    fn instead(&self) -> String {
        let first = self.otherwise.first().filter(|of| of.passes);
        first.map_or_else(String::new, |of| format!("; by {} it would pass", of.choice))
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
    // As a rule there is none, and this is quick to see.
    picture.first_nan()?;
    let is_wrong = |(index, value): (usize, f64)| value.is_nan() && counts(index / picture.channels());
    let index = picture.values().enumerate().position(is_wrong)?;
    Some(Mismatch::NotANumber { side: Side::Actual, place: picture.place(index) })
}

/// A hypothesis on a picture.
struct Candidate {
    at: usize,
    fit: Fit,
    densest: Option<Window>,
    lean: Lean,
    /// Less is better: passed, passed but leaning, failed; then by failing pixels where it failed.
    rank: (Ruling, usize),
}

impl Candidate {
    fn of(allowed: &Allowed, at: usize, picture: &Picture, gates: Gates) -> Self {
        let hypothesis = &allowed.hypotheses[at];
        let fit = Fit::of(hypothesis, picture);
        let densest = (fit.failing > 0).then(|| densest(&fit.fails, allowed.width, allowed.height)).flatten();
        let lean = Lean::of(hypothesis, picture, &fit);
        let in_window = densest.map_or(0, |window| window.failing);
        let rank = if fit.failing > gates.allow || in_window > gates.densest {
            (Ruling::Fail, fit.failing)
        } else if lean.lopsided().is_some() {
            (Ruling::Weak, 0)
        } else {
            (Ruling::Pass, 0)
        };
        Self { at, fit, densest, lean, rank }
    }
}

fn fitted(allowed: &Allowed, frame: &Submitted, gates: Gates) -> Fitted {
    let ignored = frame.ignored.as_deref();
    let picture = Picture::of(&frame.picture, ignored);
    let (width, height) = (allowed.width, allowed.height);
    let mut best = Candidate::of(allowed, 0, &picture, gates);
    let mut failing = vec![best.fit.failing];
    for at in 1..allowed.hypotheses.len() {
        let candidate = Candidate::of(allowed, at, &picture, gates);
        failing.push(candidate.fit.failing);
        if candidate.rank < best.rank {
            best = candidate;
        }
    }
    let distances = best.fit.distances(&allowed.hypotheses[best.at], &picture);
    let otherwise = match best.rank {
        (Ruling::Fail, failing) => otherwise(allowed, &picture, gates, failing),
        _ => Vec::new(),
    };
    let tried = allowed.hypotheses.iter().zip(failing);
    Fitted {
        tried: tried.map(|(hypothesis, failing)| Tried { name: hypothesis.name.clone(), failing }).collect(),
        best: best.at,
        metrics: Metrics::of_few(&distances, (width * height, width), best.densest),
        difference: difference(&distances, (width, height)),
        lean: best.lean,
        stages: stages(&allowed.stages, (width, height), &frame.buffers, ignored),
        features: involved(&allowed.features, &best.fit.fails, width),
        otherwise,
        fails: best.fit.fails,
    }
}

/// A picture of the distances of failing pixels.
fn difference(distances: &[(usize, [f64; 4])], (width, height): (usize, usize)) -> Difference {
    let mut values = vec![0.0; 4 * width * height];
    for (pixel, distances) in distances {
        values[4 * pixel..4 * pixel + 4].copy_from_slice(distances);
    }
    Difference::known(Image::filled(width, height, 4, Samples::Reals(values)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::allowed::{Alternative, Extremes, Hypothesis, Stage, StageRange};

    const WHITE: [u16; 4] = [u16::MAX; 4];

    /// A hypothesis that allows one grey in all pixels.
    fn grey(name: &str, codes: [u16; 2], pixels: usize) -> Hypothesis {
        let [lo, hi] = codes.map(|code| vec![[code, code, code, u16::MAX]; pixels]);
        Hypothesis { name: name.into(), lo, hi, ..Hypothesis::default() }
    }

    fn allowed(width: usize, hypotheses: Vec<Hypothesis>) -> Allowed {
        Allowed { width, height: 1, hypotheses, ..Allowed::default() }
    }

    fn frame(codes: &[u16]) -> Submitted {
        let values =
            codes.iter().flat_map(|code| [*code, *code, *code].map(|code| f64::from(code) / 65535.0));
        Submitted::picture(Image::new(codes.len(), 1, 3, values.collect()).unwrap(), "frame.png".into())
    }

    fn best(judgement: &Judgement) -> (&str, Ruling) {
        let fitted = judgement.outcome.as_ref().unwrap();
        (&fitted.tried[fitted.best].name, judgement.ruling())
    }

    #[test]
    fn the_first_hypothesis_that_passes_is_named_else_the_one_with_the_fewest_failing_pixels() {
        let three = ["a", "b", "c"].iter().zip([[0, 10], [20, 30], [25, 40]]);
        let all = allowed(4, three.map(|(name, codes)| grey(name, codes, 4)).collect());
        let on = |codes: &[u16]| Judgement::on(&all, &frame(codes), Gates::default());
        assert_eq!(best(&on(&[25, 27, 30, 28])), ("b", Ruling::Pass));
        assert_eq!(best(&on(&[21, 5, 35, 36])), ("c", Ruling::Fail));
        let failing: Vec<usize> =
            on(&[21, 5, 35, 36]).outcome.unwrap().tried.iter().map(|t| t.failing).collect();
        assert_eq!(failing, [3, 3, 2]);
    }

    #[test]
    fn a_hypothesis_that_passes_is_before_one_that_passes_weakly() {
        let extremes = |pixel| Extremes { pixel, least: [0; 4], most: WHITE };
        let leaning = Hypothesis { extremes: (0..40).map(extremes).collect(), ..grey("a", [0, 10], 40) };
        let on = |others: &[Hypothesis]| {
            let all = allowed(40, [std::slice::from_ref(&leaning), others].concat());
            Judgement::on(&all, &frame(&[5; 40]), Gates::default())
        };
        assert_eq!(best(&on(&[])), ("a", Ruling::Weak));
        assert_eq!(best(&on(&[grey("b", [0, 10], 40)])), ("b", Ruling::Pass));
        let strict = Gates { strict: true, ..Gates::default() };
        let judgement = Judgement::on(&allowed(40, vec![leaning.clone()]), &frame(&[5; 40]), strict);
        assert_eq!((judgement.ruling(), judgement.failure()), (Ruling::Fail, Some("lopsided")));
    }

    #[test]
    fn a_picture_that_fails_is_tried_by_other_choices_which_never_let_it_pass() {
        let other =
            |choice: &str, codes| Alternative { choice: choice.into(), hypothesis: grey("with", codes, 4) };
        let all = Allowed {
            alternatives: vec![other("a=1", [25, 40]), other("b=2", [0, 90]), other("c=3", [1, 2])],
            ..allowed(4, vec![grey("own", [0, 10], 4)])
        };
        let on = |codes: &[u16]| Judgement::on(&all, &frame(codes), Gates::default());
        let failed = on(&[5, 30, 30, 50]);
        assert_eq!(failed.failure(), Some("outside"));
        assert!(failed.to_string().ends_with("; by b=2 it would pass"), "{failed}");
        let otherwise = failed.outcome.unwrap().otherwise;
        let told: Vec<_> = otherwise.iter().map(|of| (&of.choice[..], of.failing, of.passes)).collect();
        assert_eq!(told, [("b=2", 0, true), ("a=1", 2, false)]);
        let passed = on(&[5; 4]);
        assert!(passed.passed() && passed.outcome.unwrap().otherwise.is_empty());
    }

    #[test]
    fn a_buffer_that_is_not_as_allowed_fails_a_frame_only_where_one_is_strict() {
        let range = StageRange::Between { components: 1, lo: vec![1.0; 2], hi: vec![2.0; 2] };
        let stages = vec![Stage { buffer: "depth".into(), range }];
        let all = Allowed { stages, ..allowed(2, vec![grey("a", [0, 10], 2)]) };
        let on = |depth: f64, strict: bool| {
            let mut frame = frame(&[5, 5]);
            frame.buffers.insert("depth".into(), Image::new(2, 1, 1, vec![1.5, depth]).unwrap());
            Judgement::on(&all, &frame, Gates { strict, ..Gates::default() })
        };
        assert!(on(9.0, false).passed() && on(1.5, true).passed());
        let failed = on(9.0, true);
        assert_eq!((failed.ruling(), failed.failure()), (Ruling::Fail, Some("stage")));
        assert!(failed.to_string().contains("the buffer `depth` is not as allowed"), "{failed}");
    }

    #[test]
    fn the_numbers_of_few_failing_pixels_are_those_of_the_whole_picture() {
        let all = allowed(300, vec![grey("a", [1000, 2000], 300)]);
        let codes: Vec<u16> = (0..300).map(|k| if k % 7 == 3 { 2000 + 100 * k } else { 1500 }).collect();
        let judged = Judgement::on(&all, &frame(&codes), Gates { allow: 300, densest: 300, strict: false });
        assert!(judged.passed() && judged.heat_map().unwrap().width() == 300);
        let fitted = judged.outcome.unwrap();
        assert_eq!(fitted.metrics, fitted.difference.metrics(0.0));
        assert_eq!(fitted.windows(), fitted.difference.windows(0.0));
        assert!(fitted.metrics.failing == 43 && fitted.metrics.p99 > 0.0);
    }

    #[test]
    fn a_nan_counts_only_where_one_looks() {
        let all = allowed(2, vec![grey("a", [0, 10], 2)]);
        let mut wrong = frame(&[5, 5]);
        wrong.picture = Image::new(2, 1, 3, vec![0.0, 0.0, 0.0, 0.0, f64::NAN, 0.0]).unwrap();
        assert_eq!(Judgement::on(&all, &wrong, Gates::default()).failure(), Some("not-a-number"));
        wrong.ignored = Some(vec![false, true]);
        assert_eq!(Judgement::on(&all, &wrong, Gates::default()).failure(), None);
    }
}
