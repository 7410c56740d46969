//! Triangles -> which of them each sample of a tile sees, exactly.
//!
//! Input: triangles of a [`Mesh`](crate::terrain::Mesh) by number, a [`Lattice`] of samples, a tile of it. Output: a [`Tile`] with the nearest
//! triangle and a depth key of each sample. A fast filter (single precision for small triangles, double for all others)
//! with a proven bound decides nearly every sample; `crate::predicate` decides the rest. So the result depends on
//! neither the order of the triangles nor the cut into tiles. Refuses: nothing; a triangle that is seen edge-on covers
//! no sample, one behind the near plane is not seen.

pub mod device;
mod facet;
mod lattice;
mod outcode;
mod pictures;
mod strip;
#[cfg(test)]
mod tests;
mod tile;

pub use facet::Facet;
pub use lattice::{Lattice, TileView};
pub use outcode::{MISSING, outcodes};
pub use strip::{LANES, Patch};
pub use tile::{Counts, Samples, Tile};

/// The relative error that a stored depth key may have: keys nearer to each other than twice this are compared exactly.
///
/// 2^-17 is 64 roundings of single precision: large enough for the interpolation of nearly every triangle, small enough
/// (a hundred-thousandth of the distance) that few samples need the exact comparison.
pub const KEY_ERROR: f64 = 1.0 / 131_072.0;
