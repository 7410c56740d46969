//! Pages that need no network: a pixel, or a picture in which one chooses.

mod drawing;
mod fragment;
mod whole;

pub use whole::{of_picture, of_pixel};
