//! Pictures against the truth: what a report is made of.
//!
//! Input: a [`Truth`] and the pictures of techniques. Output: distances from the certified intervals. Refuses: nothing.

use crate::buffer::Buffer;
use crate::compare::{Expected, Image};
use crate::error::Result;
use crate::truth::Truth;

/// The truth as what is expected of a picture: each value between its bounds.
///
/// # Errors
/// Internal errors only.
pub fn expected(truth: &Truth) -> Result<Expected> {
    let image = |bounds: &Buffer<[f64; 4]>| {
        Image::new(bounds.width(), bounds.height(), 4, bounds.values().as_flattened().to_vec())
    };
    Expected::between(image(&truth.low)?, image(&truth.high)?)
}
