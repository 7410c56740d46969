//! Which techniques a call asks for.

use clap::ValueEnum;
use clap::builder::PossibleValue;
use drapery::Result;
use drapery::measure::{Watch, applicable};
use drapery::report::TRUTH;
use drapery::stage::Stage;
use drapery::technique::{self, Kind};

/// What can be named.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::cli) enum Name {
    Truth,
    Technique(Kind),
}

impl Name {
    const ALL: [Self; 1 + Kind::ALL.len()] = {
        let mut all = [Self::Truth; _];
        let mut at = 0;
        while at < Kind::ALL.len() {
            all[1 + at] = Self::Technique(Kind::ALL[at]);
            at += 1;
        }
        all
    };

    /// The technique that is named; `None`: the truth.
    pub(in crate::cli) fn kind(self) -> Option<Kind> {
        match self {
            Self::Technique(kind) => Some(kind),
            Self::Truth => None,
        }
    }
}

impl ValueEnum for Name {
    fn value_variants<'a>() -> &'a [Self] {
        &Self::ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(match self {
            Self::Truth => PossibleValue::new(TRUTH).help("The right picture, as certified intervals"),
            Self::Technique(kind) => PossibleValue::new(kind.name()).help(kind.declaration().title),
        })
    }
}

/// What a call asks for by name.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::cli) struct Asked {
    /// Whether the truth's own picture is written.
    pub(super) truth: bool,
    /// The techniques, each once; `None`: all that apply.
    pub(in crate::cli) kinds: Option<Vec<Kind>>,
}

/// What is asked for by name; without names, the truth and all techniques that apply.
pub(in crate::cli) fn asked(names: &[Name]) -> Asked {
    if names.is_empty() {
        return Asked { truth: true, kinds: None };
    }
    let mut kinds = Vec::new();
    for kind in names.iter().filter_map(|name| name.kind()) {
        if !kinds.contains(&kind) {
            kinds.push(kind);
        }
    }
    Asked { truth: names.contains(&Name::Truth), kinds: Some(kinds) }
}

/// The techniques to run: those that are asked for, or all that apply.
///
/// # Errors
/// When one that is asked for does not apply.
pub(super) fn applying(asked: &Asked, stage: &Stage, watch: &dyn Watch) -> Result<Vec<Kind>> {
    if let Some(kinds) = &asked.kinds {
        kinds.iter().try_for_each(|kind| technique::applies(*kind, stage))?;
        return Ok(kinds.clone());
    }
    applicable(stage, watch)
}
