//! Drapery: the reference renderer for 2D vector data draped over 3D terrain.

pub mod buffer;
pub mod crs;
mod error;
pub mod math;
pub mod output;
pub mod parallel;
pub mod predicate;
pub mod raster;
pub mod resolve;
pub mod scene;
pub mod source;
pub mod space;
pub mod technique;
pub mod terrain;
pub mod visibility;

pub use error::{Error, Position, Result};
