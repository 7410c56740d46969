//! What can be done to a scene, a view or a picture.

use crate::buffer::Buffer;
use crate::scene::{Scene, Surface};

/// A picture: straight alpha, 8-bit code values.
pub(super) type Picture = Buffer<[u8; 4]>;

/// A change of a loaded scene; whether there was something to change.
pub(super) type Change = fn(&mut Scene, &mut Surface) -> bool;

/// What is done otherwise.
#[derive(Clone, Copy)]
pub(super) enum Edit {
    /// Keys of the scene file, `path=value`.
    Keys(&'static [&'static str]),
    /// The loaded scene.
    Scene(Change),
    /// Samples lie half a pixel beside their places, so many times to the right and down.
    HalfPixels(usize, usize),
    /// The finished picture.
    Picture(fn(&Picture) -> Picture),
    /// As by another edit, but only in the tile (8 x 8 pixels) where that changes most.
    Tile(&'static Edit),
    /// Items are blended into a target of 8-bit codes, one by one.
    Target,
    /// The same picture in tiles of another size.
    Tiles(usize),
}
