//! The techniques, each beside its paper, and what they have in common.
//!
//! Input: a [`Stage`] and views of it. Output: a [`Frame`]: the picture, the buffers that were asked for, and counts. A technique is
//! prepared once (structures that do not depend on the view) and then draws frames of any view; neither step looks at a clock,
//! at the number of threads or at another technique. Refuses: scenes that the technique's paper does not cover, with the reason.
//!
//! To add a technique: a folder with its [`Declaration`], and its line in the list below. The scene file with its check and schema, the
//! command line, goldens, reports and bundles go by the list.

pub mod clipmap;
mod declaration;
pub mod inverse_projection;
pub mod stencil_volume;
pub mod sweep;

pub use declaration::{Contradiction, Declaration, Parameters};

use crate::buffer::{Buffer, Plane};
use crate::error::Result;
use crate::space::ViewFrame;
use crate::stage::Stage;
use crate::visibility::TILE;

declaration::techniques! {
    Clipmap is clipmap,
    StencilVolume is stencil_volume,
    InverseProjection is inverse_projection,
}

/// Techniques that are known and not built yet: their names, and what they are in a line.
pub const PLANNED: [(&str, &str); 4] = [
    ("geometry-overlay", "Geometry overlay (Wartell)"),
    ("static-decal", "Static decals (Zechmeister, after Thöny and Frasson)"),
    ("dynamic-line", "Dynamic lines (Zechmeister)"),
    ("analytic", "Hierarchical classification and closed-form coverage (ours)"),
];

impl Kind {
    /// Draws a stage once, from its scene's own camera. ([`prepare`] once and [`Prepared::frame`] draw many views.)
    ///
    /// # Errors
    /// When the technique does not draw such a scene, or the camera shows nothing.
    pub fn draw(self, stage: &Stage) -> Result<Frame> {
        prepare(self, stage)?.frame(&stage.view()?, &FrameOptions::default())
    }
}

/// How a frame is drawn; nothing here changes a pixel.
#[derive(Clone, Copy)]
pub struct FrameOptions<'a> {
    /// Side of a tile in pixels.
    pub tile: usize,
    /// The names of the buffers that are wanted.
    pub buffers: &'a [String],
    /// Called with the share of the frame that is done (0..=1), from any thread.
    pub progress: &'a (dyn Fn(f64) + Sync),
}

impl Default for FrameOptions<'_> {
    /// The picture alone, in tiles of the usual size.
    fn default() -> Self {
        Self { tile: TILE, buffers: &[], progress: &|_| {} }
    }
}

/// What a technique draws.
#[derive(Debug)]
pub struct Frame {
    /// The picture: RGBA, straight alpha, 8-bit code values.
    pub image: Buffer<[u8; 4]>,
    /// The buffers that were asked for and exist. Coordinates in them are scene-local.
    pub planes: Vec<Plane>,
    /// What was counted, by name.
    pub counts: Vec<(&'static str, u64)>,
}

/// A technique with its structures built.
pub trait Prepared: Sync {
    /// Draws a frame of a view.
    ///
    /// # Errors
    /// When the technique has no room for so large a picture, or a buffer that is asked for cannot be made.
    fn frame(&self, view: &ViewFrame, options: &FrameOptions) -> Result<Frame>;

    /// Bytes of the structures that the technique built (without the terrain's).
    fn structure_bytes(&self) -> usize;
}

/// Builds a technique's structures.
///
/// # Errors
/// When the technique does not draw such a scene.
pub fn prepare(kind: Kind, stage: &Stage) -> Result<Box<dyn Prepared + '_>> {
    (kind.declaration().prepare)(stage)
}

/// Whether a technique draws such a scene.
///
/// # Errors
/// The reason why it does not.
pub fn applies(kind: Kind, stage: &Stage) -> Result<()> {
    (kind.declaration().applies)(stage)
}
