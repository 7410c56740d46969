//! Which techniques a call asks for.

use clap::ValueEnum;
use clap::builder::PossibleValue;
use drapery::measure::{Watch, applicable};
use drapery::report::TRUTH;
use drapery::stage::Stage;
use drapery::technique::{self, Kind, PLANNED};
use drapery::{Error, Result};

/// What can be named.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::cli) enum Name {
    Truth,
    Technique(Kind),
    /// A technique that is not built yet: its name and what it is.
    Planned(&'static str, &'static str),
}

impl Name {
    const ALL: [Self; 1 + Kind::ALL.len() + PLANNED.len()] = {
        let mut all = [Self::Truth; _];
        let mut at = 0;
        while at < Kind::ALL.len() {
            all[1 + at] = Self::Technique(Kind::ALL[at]);
            at += 1;
        }
        while at < Kind::ALL.len() + PLANNED.len() {
            let (name, title) = PLANNED[at - Kind::ALL.len()];
            all[1 + at] = Self::Planned(name, title);
            at += 1;
        }
        all
    };
}

impl ValueEnum for Name {
    fn value_variants<'a>() -> &'a [Self] {
        &Self::ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(match self {
            Self::Truth => PossibleValue::new(TRUTH).help("The right picture, as certified intervals"),
            Self::Technique(kind) => PossibleValue::new(kind.name()).help(kind.declaration().title),
            Self::Planned(name, title) => PossibleValue::new(*name).help(format!("{title}: not built yet")),
        })
    }
}

/// What a call asks for by name.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Asked {
    /// Whether the truth's own picture is written.
    pub(super) truth: bool,
    /// The techniques, each once; `None`: all that apply.
    pub(super) kinds: Option<Vec<Kind>>,
}

/// What is asked for by name; without names, the truth and all techniques that apply.
///
/// # Errors
/// When this version does not have one.
pub(super) fn asked(names: &[Name]) -> Result<Asked> {
    if names.is_empty() {
        return Ok(Asked { truth: true, kinds: None });
    }
    let mut kinds = Vec::new();
    for name in names.iter().filter(|name| **name != Name::Truth) {
        let kind = built(*name)?;
        if !kinds.contains(&kind) {
            kinds.push(kind);
        }
    }
    Ok(Asked { truth: names.contains(&Name::Truth), kinds: Some(kinds) })
}

/// The technique of a name.
///
/// # Errors
/// When this version does not have it.
pub(in crate::cli) fn built(name: Name) -> Result<Kind> {
    let has = || Kind::ALL.map(Kind::name).join(", ");
    match name {
        Name::Technique(kind) => Ok(kind),
        Name::Planned(name, _) => {
            let refusal = format!("this version of drapery does not have the technique `{name}` yet");
            Err(Error::unsupported(refusal).help(format!("it has truth, {}", has())))
        }
        Name::Truth => Err(Error::internal("the truth is no technique")),
    }
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
