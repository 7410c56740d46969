//! A case: where it comes from, what is right, who is concerned, and how it is measured.

use super::artifact::{Artifact, Variant};
use super::figure::Figure;
use super::hand::Hand;
use super::machine::{F64, Machine};
use super::setup::Setup;
use crate::error::Result;
use crate::technique::Kind;
use serde::Serialize;

/// The techniques that draw footprints of metres, fills and strokes alike.
pub(super) const FILLS: &[Kind] =
    &[Kind::Clipmap, Kind::StencilVolume, Kind::InverseProjection, Kind::StaticDecal, Kind::Analytic];

/// Where edges meet.
pub(super) const EDGE_NORMALS: &[Artifact] = &[Artifact::of(
    Kind::InverseProjection,
    "Codes A and B sum what the normals of the pixel's edges say: \"valid in most cases\", not where edges meet or cross (She 2016, 3.5 and Fig. 10).",
)];
/// Instead of normals.
pub(super) const BY_WINDING: &[Variant] =
    &[Variant::right(Kind::InverseProjection, &["technique.inverse-projection.point_in_polygon=winding"])];

/// Draws a case by whoever is asked, and says what was found.
pub(super) type Measure = fn(&Hand) -> Result<Vec<Figure>>;

/// A hard case.
#[derive(Debug, Clone, Copy)]
pub struct Case {
    /// Its number in the list.
    pub number: u32,
    /// What happens, in a few words.
    pub title: &'static str,
    /// The public reports that it comes from.
    pub reports: &'static str,
    /// The known answer.
    pub answer: &'static str,
    /// The techniques that it concerns.
    pub(super) concerns: &'static [Kind],
    /// The machines that it is drawn on.
    pub(super) machines: &'static [Machine],
    /// Where techniques are known not to give the answer, by their papers.
    pub(super) artifacts: &'static [Artifact],
    /// Other settings that are tried.
    pub(super) variants: &'static [Variant],
    /// The scene that is shown of it.
    pub(super) shown: fn() -> Setup,
    /// Draws it and says what was found.
    pub(super) measure: Measure,
}

/// How a technique on a machine did.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// As it should be.
    Pass,
    /// Not the answer, and the technique's paper says why.
    Artifact,
    /// The technique refuses such scenes.
    Refused,
    /// Not the answer.
    Fail,
}

impl Verdict {
    /// In a word.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Artifact => "known artifact",
            Self::Refused => "refused",
            Self::Fail => "FAIL",
        }
    }
}

/// A technique on a machine.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Row {
    /// The technique's name, or the truth's.
    pub technique: &'static str,
    /// The machine's.
    pub machine: &'static str,
    /// The settings that differ from the defaults.
    pub settings: &'static [&'static str],
    /// What was found.
    pub figures: Vec<Figure>,
    /// How it did.
    pub verdict: Verdict,
    /// Why it is refused, or where the paper says that the artifact is one.
    pub note: String,
}

impl Case {
    /// A case about some techniques on the usual machines, with no known artifacts.
    pub(super) const fn new(
        number: u32,
        title: &'static str,
        concerns: &'static [Kind],
        (shown, measure): (fn() -> Setup, Measure),
    ) -> Self {
        Self {
            number,
            title,
            reports: "",
            answer: "",
            concerns,
            machines: super::machine::MACHINES,
            artifacts: &[],
            variants: &[],
            shown,
            measure,
        }
    }

    /// Where it comes from, and what is right.
    pub(super) const fn told(self, reports: &'static str, answer: &'static str) -> Self {
        Self { reports, answer, ..self }
    }

    /// On other machines.
    pub(super) const fn on(self, machines: &'static [Machine]) -> Self {
        Self { machines, ..self }
    }

    /// With known artifacts.
    pub(super) const fn known(self, artifacts: &'static [Artifact]) -> Self {
        Self { artifacts, ..self }
    }

    /// With other settings, too.
    pub(super) const fn trying(self, variants: &'static [Variant]) -> Self {
        Self { variants, ..self }
    }

    /// Where a paper says that a technique on a machine does not give the answer.
    pub(super) fn artifact_of(&self, kind: Kind, machine: Machine) -> Option<&'static str> {
        let is_it =
            |artifact: &&Artifact| artifact.kind == kind && (!artifact.is_of_machines || machine != F64);
        self.artifacts.iter().find(is_it).map(|artifact| artifact.says)
    }
}
