//! A trial as text and as JSON.

use super::bugs::CLASSES;
use super::tally::{Counts, Tightness};
use super::trial::{Shown, Trial};
use crate::error::{Error, Result};
use serde::Serialize;

/// So many pictures that were judged wrong are named.
const NAMED: usize = 40;

#[derive(Serialize)]
struct Told<'t> {
    schema: u32,
    techniques: Vec<OfTechnique<'t>>,
    all: OfTechnique<'t>,
    comparators: Vec<Comparator>,
    without_model: Vec<WithoutModel<'t>>,
    wrong: Vec<Wrong<'t>>,
    idle: Vec<&'static str>,
    faults: Vec<String>,
    loose: Vec<String>,
}

#[derive(Serialize)]
struct OfTechnique<'t> {
    technique: &'t str,
    bugs: Counts,
    classes: Vec<OfClass>,
    variants: usize,
    passed: usize,
    wide: Option<Tightness>,
}

#[derive(Serialize)]
struct OfClass {
    class: &'static str,
    bugs: Counts,
}

#[derive(Serialize)]
struct Comparator {
    name: &'static str,
    sensitivity: f64,
    specificity: f64,
}

#[derive(Serialize)]
struct WithoutModel<'t> {
    technique: &'t str,
    reason: &'t str,
}

#[derive(Serialize)]
struct Wrong<'t> {
    technique: &'t str,
    scene: &'t str,
    name: &'t str,
    is_bug: bool,
    failing: usize,
}

impl<'t> Wrong<'t> {
    fn of(shown: &'t Shown) -> Self {
        Self {
            technique: shown.kind.name(),
            scene: shown.scene,
            name: &shown.name,
            is_bug: shown.bug.is_some(),
            failing: shown.said.map_or(0, |said| said.failing),
        }
    }
}

impl Trial {
    /// A table of the techniques and classes, the usual comparators, and what is not as it should be.
    pub fn text(&self) -> String {
        let told = self.told();
        let mut text = String::from(
            "technique           class        bugs  caught  weak  missed  no change   caught   right    passed  wide, mean  few, mean  worst\n",
        );
        let wide = |of: &Option<Tightness>| {
            of.as_ref().map_or(String::new(), |of| {
                let [mean, few, worst] = [of.mean, of.one_of_few, of.worst].map(|share| share * 100.0);
                format!("{mean:>8.2} %  {few:>7.2} %  {worst:.2} % ({})", of.scene)
            })
        };
        for of in told.techniques.iter().chain([&told.all]) {
            for class in &of.classes {
                text += &format!("{:<20}{:<11}{}\n", of.technique, class.class, row(&class.bugs));
            }
            text += &format!(
                "{:<20}{:<11}{}  {:>6}  {:>8}{}\n",
                of.technique,
                "all",
                row(&of.bugs),
                of.variants,
                share(of.passed, of.variants),
                wide(&of.wide)
            );
        }
        text += "\ncomparator            bugs caught  right pictures passed\n";
        let (all, right) = (told.all.bugs.sensitivity(), share(told.all.passed, told.all.variants));
        text += &format!("{:<20}{:>11.2} %  {:>20}\n", "the judge", all * 100.0, right);
        for of in &told.comparators {
            let (caught, passed) = (of.sensitivity * 100.0, of.specificity * 100.0);
            text += &format!("{:<20}{caught:>11.2} %  {passed:>18.2} %\n", of.name);
        }
        for of in &told.without_model {
            text += &format!("not judged: {}: {}\n", of.technique, of.reason);
        }
        for of in told.wrong.iter().take(NAMED) {
            text += &match of.is_bug {
                true => format!("missed: {}, {}: {}\n", of.technique, of.scene, of.name),
                false => format!(
                    "failed though right: {}, {}: {}: {} pixels\n",
                    of.technique, of.scene, of.name, of.failing
                ),
            };
        }
        if told.wrong.len() > NAMED {
            text += &format!("... and {} more\n", told.wrong.len() - NAMED);
        }
        if !told.idle.is_empty() {
            text += &format!("bugs without effect anywhere: {}\n", told.idle.join(", "));
        }
        told.loose.iter().for_each(|line| text += &format!("loose: {line}\n"));
        told.faults.iter().for_each(|line| text += &format!("FAIL: {line}\n"));
        if told.faults.is_empty() {
            text += "PASS: the judge catches what it should and passes what is right\n";
        }
        text
    }

    /// All of it, for programs.
    ///
    /// # Errors
    /// When that fails, which is a bug.
    pub fn json(&self) -> Result<String> {
        let text = serde_json::to_string_pretty(&self.told());
        text.map(|text| text + "\n")
            .map_err(|error| Error::internal("the trial cannot be written as JSON").caused_by(error))
    }

    fn told(&self) -> Told<'_> {
        Told {
            schema: 1,
            techniques: self.judged().into_iter().map(|kind| self.of(kind.name(), Some(kind))).collect(),
            all: self.of("all", None),
            comparators: self
                .comparators()
                .into_iter()
                .map(|(name, sensitivity, specificity)| Comparator { name, sensitivity, specificity })
                .collect(),
            without_model: self
                .without_model
                .iter()
                .map(|(kind, reason)| WithoutModel { technique: kind.name(), reason })
                .collect(),
            wrong: self.wrong().map(Wrong::of).collect(),
            idle: self.idle(),
            faults: self.faults(),
            loose: self.loose(),
        }
    }

    fn of<'t>(&self, technique: &'t str, kind: Option<crate::technique::Kind>) -> OfTechnique<'t> {
        let classes =
            CLASSES.iter().map(|(class, name)| OfClass { class: name, bugs: self.bugs(kind, Some(*class)) });
        let (variants, passed) = self.variants(kind);
        OfTechnique {
            technique,
            bugs: self.bugs(kind, None),
            classes: classes.filter(|of| of.bugs != Counts::default()).collect(),
            variants,
            passed,
            wide: self.tightness(kind),
        }
    }
}

fn row(of: &Counts) -> String {
    format!(
        "{:>6}{:>8}{:>6}{:>8}{:>11}  {:>7.2} %",
        of.changed,
        of.caught,
        of.weak,
        of.missed,
        of.equivalent,
        of.sensitivity() * 100.0
    )
}

fn share(part: usize, whole: usize) -> String {
    if whole == 0 { String::from("-") } else { format!("{:.2} %", part as f64 / whole as f64 * 100.0) }
}
