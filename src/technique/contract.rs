//! What every technique gives: frames of what it has prepared.

use crate::buffer::{Buffer, Plane};
use crate::error::Result;
use crate::space::ViewFrame;

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

    /// The parameters in use, by their names in the scene file.
    fn parameters(&self) -> Vec<(&'static str, String)>;

    /// The buffers that can be asked for, in the order of the technique's stages: of two that differ from what they should
    /// be, the first is nearer to the cause.
    fn buffer_names(&self) -> &'static [&'static str];
}
