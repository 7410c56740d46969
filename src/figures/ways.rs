//! One scene drawn in several ways.

use super::figure::{Panel, Scale};
use super::pictures::{Part, enlarged};
use super::shot::Shot;
use crate::error::Result;
use crate::technique::Kind;

/// A way to draw a scene.
pub(super) struct Way {
    /// By which technique; `None`: the truth.
    pub(super) kind: Option<Kind>,
    /// Changes of the scene (`path=value`).
    pub(super) settings: &'static [&'static str],
    /// The panel's caption.
    pub(super) caption: &'static str,
}

impl Way {
    /// By a technique.
    pub(super) const fn by(kind: Kind, settings: &'static [&'static str], caption: &'static str) -> Self {
        Self { kind: Some(kind), settings, caption }
    }

    /// The truth.
    pub(super) const fn truth(settings: &'static [&'static str], caption: &'static str) -> Self {
        Self { kind: None, settings, caption }
    }
}

/// A panel each: a part of the picture, its pixels so many times as large.
pub(super) fn drawn_in(
    ways: &[Way],
    text: &str,
    (part, times): (Part, usize),
    scale: Scale,
) -> Result<Vec<Panel>> {
    let panel = |way: &Way| {
        let shot = Shot::scaled(text, way.settings, scale)?;
        let picture = match way.kind {
            Some(kind) => shot.by(kind)?,
            None => shot.truth()?,
        };
        Ok(Panel::picture(way.caption, enlarged(&picture, part, times)))
    };
    ways.iter().map(panel).collect()
}

/// All of a picture, as it is.
pub(super) const WHOLE: (Part, usize) = ([0.0, 0.0, 1.0, 1.0], 1);
