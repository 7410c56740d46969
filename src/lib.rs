//! Drapery: the reference renderer for 2D vector data draped over 3D terrain.

pub mod buffer;
pub mod crs;
mod error;
pub mod math;
pub mod output;
pub mod parallel;
pub mod scene;
pub mod source;
pub mod space;

pub use error::{Error, Position, Result};
