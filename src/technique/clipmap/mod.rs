//! Clipmap.

mod quadtree;
pub mod raster;
#[cfg(test)]
mod rational;
mod simple;
pub mod tessellation;
pub mod texture;
