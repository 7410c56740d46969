//! Clipmap.

pub mod raster;
#[cfg(test)]
mod rational;
pub mod tessellation;
