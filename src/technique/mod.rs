//! The techniques, each beside its paper, and what they have in common.
//!
//! Input: a [`Stage`] and views of it. Output: a [`Frame`]: the picture, the buffers that were asked for, and counts. A technique is
//! prepared once (structures that do not depend on the view) and then draws frames of any view; neither step looks at a clock,
//! at the number of threads or at another technique. Refuses: scenes that the technique's paper does not cover, with the reason.

pub mod clipmap;
pub mod inverse_projection;
pub mod stencil_volume;

pub use crate::canvas::{Frame, FrameOptions};

use crate::error::{Error, Result};
use crate::space::ViewFrame;
use crate::stage::Stage;
use std::fmt;

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

/// A technique with its structures built.
pub trait Prepared: Sync {
    /// Draws a frame of a view.
    ///
    /// # Errors
    /// When the technique has no room for so large a picture, or a buffer that is asked for cannot be made.
    fn frame(&self, view: &ViewFrame, options: &FrameOptions) -> Result<Frame>;

    /// Decides one pixel of a view's picture again, as a frame does, and keeps the steps; see [`explain`].
    ///
    /// # Errors
    /// As [`Prepared::frame`].
    fn steps(&self, view: &ViewFrame, pixel: [usize; 2]) -> Result<Explanation>;

    /// Bytes of the structures that the technique built (without the terrain's).
    fn structure_bytes(&self) -> usize;

    /// The parameters in use, by their names in the scene file.
    fn parameters(&self) -> Vec<(&'static str, String)>;

    /// The buffers that can be asked for, in the order of the technique's stages: of two that differ from what they should
    /// be, the first is nearer to the cause.
    fn buffer_names(&self) -> &'static [&'static str];
}

/// A step of a technique on the way to a pixel's colour: data of its own that has a short text.
pub trait Step: fmt::Debug + fmt::Display + Send {}

impl<S: fmt::Debug + fmt::Display + Send> Step for S {}

/// Why a pixel has its colour.
#[derive(Debug)]
pub struct Explanation {
    /// What the technique did, in order. Coordinates are scene-local, paints premultiplied in the working space.
    pub steps: Vec<Box<dyn Step>>,
    /// The pixel's code values, those of the frame.
    pub code: [u8; 4],
}

impl Explanation {
    /// Of a technique's own steps.
    fn new<S: Step + 'static>(steps: Vec<S>, code: [u8; 4]) -> Self {
        let boxed = |step| -> Box<dyn Step> { Box::new(step) };
        Self { steps: steps.into_iter().map(boxed).collect(), code }
    }
}

/// Why a pixel (column, row) of a technique's picture has its colour: what draws frames decides this pixel again and keeps its steps.
///
/// # Errors
/// When the picture has no such pixel, or the technique cannot draw it.
pub fn explain(prepared: &dyn Prepared, view: &ViewFrame, pixel: [usize; 2]) -> Result<Explanation> {
    let (width, height) = (view.width(), view.height());
    if pixel[0] >= width || pixel[1] >= height {
        return Err(Error::new(format!(
            "there is no pixel {},{} in a picture of {width} x {height}",
            pixel[0], pixel[1]
        ))
        .help("pixels are counted from 0, columns from the left, rows from the top"));
    }
    prepared.steps(view, pixel)
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
