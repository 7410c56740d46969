//! A bundle's folder -> what it allows, and the frames that a program drew from it.
//!
//! Nothing in a bundle is believed: its files have to be those that its manifest names, by their hashes; its tables have to be
//! sorted, within the picture and the right way up.

mod document;
mod file;
mod judge;
mod manifest;
mod names;
mod set;
mod table;

pub use judge::Judge;
pub use set::{ConformanceCase, ConformanceSet};
