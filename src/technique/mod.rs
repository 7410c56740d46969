//! The techniques, each beside its paper, and what they have in common.
//!
//! Input: a [`Stage`] and views of it. Output: a [`Frame`]: the picture, the buffers that were asked for, and counts. A technique is
//! prepared once (structures that do not depend on the view) and then draws frames of any view; neither step looks at a clock,
//! at the number of threads or at another technique. Refuses: scenes that the technique's paper does not cover, with the reason.
//!
//! To add a technique: a folder with its [`Declaration`], and its line in the list below. The scene file with its check and schema, the
//! command line, goldens, reports and bundles go by the list.

pub mod analytic;
pub mod clipmap;
mod declaration;
pub mod dynamic_line;
pub mod geometry_overlay;
pub mod inverse_projection;
pub mod static_decal;
pub mod stencil_volume;
pub mod sweep;

pub use declaration::{Contradiction, Declaration, Parameters};

pub use crate::canvas::{Frame, FrameOptions};

use crate::error::{Error, Result};
use crate::space::{Plan, ViewFrame};
use crate::stage::Stage;
use std::fmt;

declaration::techniques! {
    Clipmap is clipmap,
    StencilVolume is stencil_volume,
    InverseProjection is inverse_projection,
    StaticDecal is static_decal,
    DynamicLine is dynamic_line,
    GeometryOverlay is geometry_overlay,
    Analytic is analytic,
}

impl Kind {
    /// Draws a stage once, from its scene's own camera. ([`prepare`] once and [`Prepared::frame`] draw many views.)
    ///
    /// # Errors
    /// When the technique does not draw such a scene, or the camera shows nothing.
    pub fn draw(self, stage: &Stage) -> Result<Frame> {
        prepare(self, stage)?.frame(&stage.view()?, &FrameOptions::default())
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

    /// As [`Prepared::steps`], of several pixels: where a view takes a while to set up, that is done once.
    ///
    /// # Errors
    /// As [`Prepared::frame`].
    fn steps_of_all(&self, view: &ViewFrame, pixels: &[[usize; 2]]) -> Result<Vec<Explanation>> {
        pixels.iter().map(|pixel| self.steps(view, *pixel)).collect()
    }

    /// Bytes of the structures that the technique built (without the terrain's).
    fn structure_bytes(&self) -> usize;
}

/// A step of a technique on the way to a pixel's colour: data of its own that has a short text.
pub trait Step: fmt::Debug + fmt::Display + Send + Sync {
    /// Where the technique's paper says so: section, figure, equation or algorithm.
    fn section(&self) -> &'static str;

    /// The plan point that is decided about, scene-local, where it is about one.
    fn place(&self) -> Option<Plan> {
        None
    }

    /// The items of the draw list that it is about.
    fn items(&self) -> Vec<u32> {
        Vec::new()
    }
}

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

    /// Of a technique's own steps at several pixels.
    fn all<S: Step + 'static>(all: Vec<(Vec<S>, [u8; 4])>) -> Vec<Self> {
        all.into_iter().map(|(steps, code)| Self::new(steps, code)).collect()
    }
}

/// Why a pixel (column, row) of a technique's picture has its colour: what draws frames decides this pixel again and keeps its steps.
///
/// # Errors
/// When the picture has no such pixel, or the technique cannot draw it.
pub fn explain(prepared: &dyn Prepared, view: &ViewFrame, pixel: [usize; 2]) -> Result<Explanation> {
    let (width, height) = (view.width(), view.height());
    if pixel[0] >= width || pixel[1] >= height {
        return Err(no_such_pixel(pixel, [width, height]));
    }
    prepared.steps(view, pixel)
}

/// The refusal of a pixel (column, row) that a picture of a size does not have.
pub fn no_such_pixel([column, row]: [usize; 2], [width, height]: [usize; 2]) -> Error {
    Error::new(format!("there is no pixel {column},{row} in a picture of {width} x {height}"))
        .help("pixels are counted from 0, columns from the left, rows from the top")
}

/// Builds a technique's structures.
///
/// # Errors
/// When the technique does not draw such a scene.
pub fn prepare(kind: Kind, stage: &Stage) -> Result<Box<dyn Prepared + '_>> {
    prepare_telling(kind, stage, &|_| {})
}

/// As [`prepare`]; `progress` is told the share that is done (0..=1) where that takes long, from any thread.
///
/// # Errors
/// When the technique does not draw such a scene.
pub fn prepare_telling<'s>(
    kind: Kind,
    stage: &'s Stage,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Box<dyn Prepared + 's>> {
    (kind.declaration().prepare)(stage, progress)
}

/// Whether a technique draws such a scene.
///
/// # Errors
/// The reason why it does not.
pub fn applies(kind: Kind, stage: &Stage) -> Result<()> {
    (kind.declaration().applies)(stage)
}
