//! The techniques, each beside its paper, and what they have in common.
//!
//! Input: a [`Stage`] and views of it. Output: a [`Frame`]: the picture, the buffers that were asked for, and counts. A technique is
//! prepared once (structures that do not depend on the view) and then draws frames of any view; neither step looks at a clock,
//! at the number of threads or at another technique. Refuses: scenes that the technique's paper does not cover, with the reason.

pub mod clipmap;
mod contract;
pub mod inverse_projection;
pub mod stencil_volume;

pub use contract::{Frame, FrameOptions, Prepared};

use crate::error::Result;
use crate::stage::Stage;

/// A technique's name in the contract.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// Taibo et al. 2014.
    Clipmap,
    /// Schneider & Klein 2007.
    StencilVolume,
    /// She 2016.
    InverseProjection,
}

impl Kind {
    /// Every technique that is built.
    pub const ALL: [Self; 3] = [Self::Clipmap, Self::StencilVolume, Self::InverseProjection];

    /// The name on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Clipmap => "clipmap",
            Self::StencilVolume => "stencil-volume",
            Self::InverseProjection => "inverse-projection",
        }
    }
}

/// Builds a technique's structures.
///
/// # Errors
/// When the technique does not draw such a scene.
pub fn prepare(kind: Kind, stage: &Stage) -> Result<Box<dyn Prepared + '_>> {
    match kind {
        Kind::Clipmap => Ok(Box::new(clipmap::Prepare::new(stage)?)),
        Kind::StencilVolume => Ok(Box::new(stencil_volume::Prepare::new(stage)?)),
        Kind::InverseProjection => Ok(Box::new(inverse_projection::Prepare::new(stage)?)),
    }
}

/// Whether a technique draws such a scene.
///
/// # Errors
/// The reason why it does not.
pub fn applies(kind: Kind, stage: &Stage) -> Result<()> {
    match kind {
        Kind::Clipmap => clipmap::applies(stage),
        Kind::StencilVolume => stencil_volume::applies(stage),
        Kind::InverseProjection => inverse_projection::applies(stage),
    }
}
