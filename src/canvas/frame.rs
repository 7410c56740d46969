//! What is asked of a frame, and what it is.

use crate::buffer::{Buffer, Plane, PlaneKind, Touches, Values};
use crate::visibility::TILE;

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

impl FrameOptions<'_> {
    /// Whether a buffer is wanted.
    pub fn wants(&self, name: &str) -> bool {
        self.buffers.iter().any(|wanted| wanted == name)
    }

    /// Room for the items that touch pixels of a picture that is so wide, where one of their buffers is wanted.
    pub fn touches(&self, width: usize) -> Touches {
        Touches::new(width, PlaneKind::PICKS.iter().any(|kind| self.wants(kind.name)))
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

/// Values of some pixels in order, made and kept only where someone asked for them.
#[derive(Debug)]
pub struct Kept<T>(Option<Vec<T>>);

impl<T> Kept<T> {
    /// No values yet; none will be kept unless they are wanted.
    pub fn new(is_wanted: bool) -> Self {
        Self(is_wanted.then(Vec::new))
    }

    /// Adds a pixel's value.
    #[inline(always)]
    pub fn push(&mut self, value: impl FnOnce() -> T) {
        if let Some(values) = &mut self.0 {
            values.push(value());
        }
    }

    /// The values that were kept.
    pub fn values(&self) -> &[T] {
        self.0.as_deref().unwrap_or(&[])
    }
}

/// The values of all parts, one after another.
pub fn joined<'p, T: Copy + 'p>(parts: impl Iterator<Item = &'p [T]>) -> Vec<T> {
    let parts: Vec<&[T]> = parts.collect();
    parts.concat()
}

/// A buffer with `components` numbers for each pixel of a picture.
pub fn picture_plane(
    name: &'static str,
    [width, height]: [usize; 2],
    components: usize,
    values: Values,
) -> Plane {
    Plane { name, width, height, components, values }
}

/// A buffer that is a table of N columns, taken out of where its rows are; `values` says what its numbers are.
pub fn table<const N: usize, T>(
    name: &'static str,
    rows: &mut Vec<[T; N]>,
    values: fn(Vec<T>) -> Values,
) -> Plane {
    let rows = std::mem::take(rows);
    picture_plane(name, [N, rows.len()], 1, values(rows.into_flattened()))
}
