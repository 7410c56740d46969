//! Which techniques a call asks for, and which buffers of theirs.

use crate::cli::bar::Bar;
use clap::ValueEnum;
use drapery::technique::{self, Kind, Stage};
use drapery::{Error, Result};

/// Every buffer that a technique has.
const ALL: &str = "all";

/// The techniques of the contract.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Name {
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

/// The techniques that are asked for by name, each once.
///
/// # Errors
/// When this version does not have one.
pub(super) fn asked(names: &[Name]) -> Result<Vec<Kind>> {
    let mut kinds = Vec::new();
    for name in names {
        let kind = built(*name)?;
        if !kinds.contains(&kind) {
            kinds.push(kind);
        }
    }
    Ok(kinds)
}

fn built(name: Name) -> Result<Kind> {
    let value = name.to_possible_value();
    let name = value.as_ref().map_or("", |value| value.get_name());
    let has: Vec<&str> = Kind::ALL.iter().map(|kind| kind.name()).collect();
    let refuse = || {
        Error::new(format!("this version of drapery does not have the technique `{name}` yet"))
            .help(format!("it has {}", has.join(", ")))
    };
    Kind::ALL.into_iter().find(|kind| kind.name() == name).ok_or_else(refuse)
}

/// The techniques to run: those that are asked for, or all that apply.
///
/// # Errors
/// When one that is asked for does not apply, or none does.
pub(super) fn applying(asked: &[Kind], stage: &Stage, bar: &Bar) -> Result<Vec<Kind>> {
    if !asked.is_empty() {
        asked.iter().try_for_each(|kind| technique::applies(*kind, stage))?;
        return Ok(asked.to_vec());
    }
    let mut kinds = Vec::new();
    for kind in Kind::ALL {
        match technique::applies(kind, stage) {
            Ok(()) => kinds.push(kind),
            Err(error) if error.is_internal() => return Err(error),
            Err(error) => bar.say(&format!("note: {} is left out: {}", kind.name(), error.what())),
        }
    }
    if kinds.is_empty() {
        return Err(Error::new("no technique applies to this scene").help("the notes say why"));
    }
    Ok(kinds)
}

/// The buffers to make.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Buffers {
    /// All that a technique has.
    All,
    /// Those of these names that a technique has.
    Named(Vec<String>),
}

/// The buffers that are asked for.
///
/// # Errors
/// When none of the techniques has one of them: known before anything is drawn.
pub(super) fn buffers(asked: &[String], kinds: &[Kind], stage: &Stage) -> Result<Buffers> {
    let mut unknown: Vec<&str> = asked.iter().map(String::as_str).filter(|name| *name != ALL).collect();
    let mut offered: Vec<&str> = Vec::new();
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
