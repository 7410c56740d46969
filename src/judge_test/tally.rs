//! What was said, counted; and whether that is good enough.

use super::bugs::{self, Bug, CLASSES, Class};
use super::contrast;
use super::trial::{Shown, Trial};
use crate::compare::Ruling;
use crate::technique::Kind;
use serde::Serialize;

/// The least share of bugs that has to be caught, of all and of each class.
const SENSITIVITY: f64 = 0.99;
const SENSITIVITY_OF_A_CLASS: f64 = 0.95;

/// The most pixels that may be more than two code values apart, in a range: on average, and in any scene.
const WIDE: f64 = 0.01;
const WIDE_IN_A_SCENE: f64 = 0.05;

/// Bugs of a technique, a class or both.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct Counts {
    /// Whose picture is another than the right one.
    pub changed: usize,
    /// Whose picture is the right one bit for bit: no bugs there.
    pub equivalent: usize,
    /// That the judge failed.
    pub caught: usize,
    /// That it let pass with a doubt: all that is open was decided one way.
    pub weak: usize,
    /// That it let pass.
    pub missed: usize,
}

/// How narrow what is allowed of a technique is.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Tightness {
    /// The mean share of pixels that may be more than two code values apart.
    pub mean: f64,
    /// The mean share of those that may be as far apart, but have to be one of a few colours.
    pub one_of_few: f64,
    /// The largest share in a scene.
    pub worst: f64,
    /// That scene.
    pub scene: &'static str,
    /// Each scene's shares.
    pub scenes: Vec<OfScene>,
}

/// How narrow what is allowed of a scene is.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct OfScene {
    /// Its name.
    pub scene: &'static str,
    /// The share of pixels that may be more than two code values apart, in a range.
    pub wide: f64,
    /// The share of those that have to be one of a few colours.
    pub one_of_few: f64,
}

impl Counts {
    fn of<'s>(shown: impl Iterator<Item = &'s Shown>) -> Self {
        let mut counts = Self::default();
        for of in shown {
            let Some(said) = of.said else {
                counts.equivalent += 1;
                continue;
            };
            counts.changed += 1;
            match said.ruling {
                Ruling::Fail => counts.caught += 1,
                Ruling::Weak => counts.weak += 1,
                Ruling::Pass => counts.missed += 1,
            }
        }
        counts
    }

    /// The share of bugs that is caught; 1 where there are none.
    pub fn sensitivity(&self) -> f64 {
        if self.changed == 0 { 1.0 } else { self.caught as f64 / self.changed as f64 }
    }
}

impl Trial {
    /// The bugs of a technique and a class, or of all.
    pub(super) fn bugs(&self, kind: Option<Kind>, class: Option<Class>) -> Counts {
        let is_asked = |shown: &&Shown| {
            shown.bug.is_some_and(|of| class.is_none_or(|class| class == of))
                && kind.is_none_or(|kind| kind == shown.kind)
        };
        Counts::of(self.shown.iter().filter(is_asked))
    }

    /// Variants of a technique, or of all: how many there are, and how many are let pass.
    pub(super) fn variants(&self, kind: Option<Kind>) -> (usize, usize) {
        let variants = self.shown.iter().filter(|shown| shown.bug.is_none());
        let variants = variants.filter(|shown| kind.is_none_or(|kind| kind == shown.kind));
        variants.fold((0, 0), |(all, passed), shown| {
            (all + 1, passed + usize::from(shown.ruling() != Some(Ruling::Fail)))
        })
    }

    /// How narrow what is allowed is, of a technique or of all; `None`: nothing was judged.
    pub(super) fn tightness(&self, kind: Option<Kind>) -> Option<Tightness> {
        let subjects: Vec<_> =
            self.subjects.iter().filter(|of| kind.is_none_or(|kind| kind == of.kind)).collect();
        let of = |of: &&super::trial::Judged| OfScene {
            scene: of.scene,
            wide: of.narrowness.wide,
            one_of_few: of.narrowness.one_of_few,
        };
        let scenes: Vec<OfScene> = subjects.iter().map(of).collect();
        let worst = scenes.iter().max_by(|a, b| a.wide.total_cmp(&b.wide))?;
        let mean = |of: &dyn Fn(&OfScene) -> f64| scenes.iter().map(of).sum::<f64>() / scenes.len() as f64;
        Some(Tightness {
            mean: mean(&|of| of.wide),
            one_of_few: mean(&|of| of.one_of_few),
            worst: worst.wide,
            scene: worst.scene,
            scenes,
        })
    }

    /// Of each usual comparator its name, the share of bugs that it fails, and the share of variants that it lets pass.
    pub(super) fn comparators(&self) -> Vec<(&'static str, f64, f64)> {
        let share = |shown: &mut dyn Iterator<Item = &Shown>, k: usize, passes: bool| {
            let (all, so) =
                shown.fold((0, 0), |(all, so), of| (all + 1, so + usize::from(of.contrast[k] == passes)));
            if all == 0 { 1.0 } else { f64::from(so as u32) / f64::from(all) }
        };
        let of = |(k, name): (usize, &&'static str)| {
            let bugs = self.shown.iter().filter(|shown| shown.bug.is_some() && shown.said.is_some());
            let variants = self.shown.iter().filter(|shown| shown.bug.is_none());
            (*name, share(&mut { bugs }, k, false), share(&mut { variants }, k, true))
        };
        contrast::NAMES.iter().enumerate().map(of).collect()
    }

    /// The techniques that were judged.
    pub(super) fn judged(&self) -> Vec<Kind> {
        Kind::ALL.iter().copied().filter(|kind| self.subjects.iter().any(|of| of.kind == *kind)).collect()
    }

    /// Bugs that were let pass, and variants that were not.
    pub(super) fn wrong(&self) -> impl Iterator<Item = &Shown> {
        self.shown.iter().filter(|shown| match shown.bug {
            Some(_) => matches!(shown.ruling(), Some(Ruling::Pass | Ruling::Weak)),
            None => shown.ruling() == Some(Ruling::Fail),
        })
    }

    /// Bugs of the judged techniques that change no picture of the whole corpus: they test nothing.
    pub(super) fn idle(&self) -> Vec<&'static str> {
        if !self.is_whole {
            return Vec::new();
        }
        let judged = self.judged();
        let asked = bugs::all().into_iter().filter(|bug| judged.iter().any(|kind| bug.can_be_of(*kind)));
        let changes = |bug: &&&Bug| {
            self.shown
                .iter()
                .any(|shown| shown.bug.is_some() && shown.said.is_some() && shown.name == bug.name)
        };
        asked.filter(|bug| !changes(&bug)).map(|bug| bug.name).collect()
    }

    /// The goals that are missed, each in a sentence; none: the judge can be trusted.
    pub fn faults(&self) -> Vec<String> {
        let mut faults = Vec::new();
        let percent = |share: f64| share * 100.0;
        let all = self.bugs(None, None);
        if all.changed == 0 {
            faults.push("no bug was shown to the judge".to_owned());
        }
        if all.sensitivity() < SENSITIVITY {
            faults.push(format!(
                "{:.2} % of all bugs are caught, and it should be {} %",
                percent(all.sensitivity()),
                percent(SENSITIVITY)
            ));
        }
        for (class, name) in CLASSES {
            let of = self.bugs(None, Some(class)).sensitivity();
            if of < SENSITIVITY_OF_A_CLASS {
                faults.push(format!(
                    "{:.2} % of the bugs of {name} are caught, and it should be {} %",
                    percent(of),
                    percent(SENSITIVITY_OF_A_CLASS)
                ));
            }
        }
        let (variants, passed) = self.variants(None);
        if passed < variants {
            faults.push(format!("{} of {variants} right pictures are failed", variants - passed));
        }
        faults
    }

    /// Where more is allowed than should be, each in a sentence: no fault of the judge's verdicts.
    pub(super) fn loose(&self) -> Vec<String> {
        let mut loose = Vec::new();
        for kind in self.judged() {
            let Some(of) = self.tightness(Some(kind)) else { continue };
            let percent = |share: f64| share * 100.0;
            let name = kind.name();
            if of.mean > WIDE {
                loose.push(format!(
                    "{name}: {:.2} % of all pixels are wide, more than {} %",
                    percent(of.mean),
                    percent(WIDE)
                ));
            }
            for of in of.scenes.iter().filter(|of| of.wide > WIDE_IN_A_SCENE) {
                loose.push(format!(
                    "{} by {name}: {:.2} % of its pixels are wide, and {:.2} % one of few colours",
                    of.scene,
                    percent(of.wide),
                    percent(of.one_of_few)
                ));
            }
        }
        loose
    }
}
