//! Which techniques a call asks for, and which buffers of theirs.

use crate::cli::bar::Bar;
use crate::cli::measure::applicable;
use clap::ValueEnum;
use drapery::stage::Stage;
use drapery::technique::{self, Kind};
use drapery::truth::Truth;
use drapery::{Error, Result};

/// Every buffer that a technique has.
const ALL: &str = "all";

/// The techniques of the contract.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum Name {
    /// The right picture, as certified intervals.
    Truth,
    /// Clipmap texture (Taibo).
    Clipmap,
    /// Geometry overlay (Wartell).
    GeometryOverlay,
    /// Stencil volumes (Schneider & Klein).
    StencilVolume,
    /// Inverse projection (She).
    InverseProjection,
    /// Static decals (Zechmeister, after Thöny and Frasson).
    StaticDecal,
    /// Dynamic lines (Zechmeister).
    DynamicLine,
    /// Hierarchical classification and closed-form coverage (ours).
    Analytic,
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
    let value = name.to_possible_value();
    let name = value.as_ref().map_or("", |value| value.get_name());
    let has: Vec<&str> = Kind::ALL.iter().map(|kind| kind.name()).collect();
    let refuse = || {
        Error::new(format!("this version of drapery does not have the technique `{name}` yet"))
            .help(format!("it has truth, {}", has.join(", ")))
    };
    Kind::ALL.into_iter().find(|kind| kind.name() == name).ok_or_else(refuse)
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
pub(super) fn buffers(asked: &[String], truth: bool, kinds: &[Kind], stage: &Stage) -> Result<Buffers> {
    let mut unknown: Vec<&str> = asked.iter().map(String::as_str).filter(|name| *name != ALL).collect();
    let mut offered: Vec<&str> = if truth { Truth::BUFFERS.to_vec() } else { Vec::new() };
    unknown.retain(|name| !offered.contains(name));
    for kind in kinds {
        if unknown.is_empty() {
            break;
        }
        let names = technique::prepare(*kind, stage)?.buffer_names();
        unknown.retain(|name| !names.contains(name));
        offered.extend(names.iter().filter(|name| !offered.contains(name)).collect::<Vec<_>>());
    }
    if let Some(name) = unknown.first() {
        return Err(Error::new(format!("there is no buffer `{name}`"))
            .help(format!("buffers here: {}, or {ALL}", offered.join(", "))));
    }
    Ok(if asked.iter().any(|name| name == ALL) { Buffers::All } else { Buffers::Named(asked.to_vec()) })
}
