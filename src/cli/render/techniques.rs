//! Which techniques a call asks for, and which buffers of theirs.

use crate::cli::bar::Bar;
use crate::cli::measure::applicable;
use clap::ValueEnum;
use clap::builder::PossibleValue;
use drapery::report::TRUTH;
use drapery::stage::Stage;
use drapery::technique::{self, Kind, PLANNED};
use drapery::truth::Truth;
use drapery::{Error, Result};

/// Every buffer that a technique has.
const ALL: &str = "all";

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
    /// Whether the truth's own picture is written. (It is computed in any case: errors are distances from it.)
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
            Err(Error::new(refusal).help(format!("it has truth, {}", has())))
        }
        Name::Truth => Err(Error::internal("the truth is no technique")),
    }
}

/// The techniques to run: those that are asked for, or all that apply.
///
/// # Errors
/// When one that is asked for does not apply.
pub(super) fn applying(asked: &Asked, stage: &Stage, bar: &Bar) -> Result<Vec<Kind>> {
    if let Some(kinds) = &asked.kinds {
        kinds.iter().try_for_each(|kind| technique::applies(*kind, stage))?;
        return Ok(kinds.clone());
    }
    applicable(stage, bar)
}

/// The buffers to make.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::cli) enum Buffers {
    /// All that a technique has.
    All,
    /// Those of these names that a technique has.
    Named(Vec<String>),
}

impl Buffers {
    /// Whether one of this name is asked for.
    pub(in crate::cli) fn wants(&self, name: &str) -> bool {
        match self {
            Self::All => true,
            Self::Named(names) => names.iter().any(|wanted| wanted == name),
        }
    }
}

/// The buffers that are asked for.
///
/// # Errors
/// When neither the truth (if its picture is asked for) nor a technique has one of them: known before anything is drawn.
pub(super) fn buffers(asked: &[String], truth: bool, kinds: &[Kind]) -> Result<Buffers> {
    let of_truth = if truth { &Truth::PLANES[..] } else { &[] };
    let planes = of_truth.iter().chain(kinds.iter().flat_map(|kind| kind.declaration().planes));
    let mut offered: Vec<&str> = Vec::new();
    planes.for_each(|plane| {
        if !offered.contains(&plane.name) {
            offered.push(plane.name)
        }
    });
    let unknown = asked.iter().find(|name| *name != ALL && !offered.contains(&name.as_str()));
    if let Some(name) = unknown {
        return Err(Error::new(format!("there is no buffer `{name}`"))
            .help(format!("buffers here: {}, or {ALL}", offered.join(", "))));
    }
    Ok(if asked.iter().any(|name| name == ALL) { Buffers::All } else { Buffers::Named(asked.to_vec()) })
}
