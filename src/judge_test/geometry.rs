//! Edits of loaded scenes: features, strokes, styles, terrain. Each says whether there was something to change.

mod features;
mod styles;
mod terrain;

pub(super) use features::*;
pub(super) use styles::*;
pub(super) use terrain::*;
