//! Clipmap.

pub mod raster;
