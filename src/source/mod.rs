//! Files and generators -> the data of a scene.

pub mod dem;
pub mod generate;
pub mod load;
mod packed;
pub mod vector;
mod zip;
