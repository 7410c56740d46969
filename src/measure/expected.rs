//! The truth as something to compare with.

use crate::buffer::Buffer;
use crate::compare::{Expected, Image};
use crate::error::Result;
use crate::truth::Truth;

/// An interval that is no wider is that of one number.
const ROUNDING: f64 = 1e-12;

/// The truth as what is expected of a picture: each value between its bounds.
///
/// # Errors
/// Internal errors only.
pub fn expected(truth: &Truth) -> Result<Expected> {
    Expected::between(image(&truth.low)?, image(&truth.high)?)
}

/// Colours that were not rounded, as a picture to measure.
///
/// # Errors
/// When it has no pixel.
pub fn image(colors: &Buffer<[f64; 4]>) -> Result<Image> {
    Image::new(colors.width(), colors.height(), 4, colors.values().as_flattened().to_vec())
}

/// How far the truth's estimate may be from the right picture: half of each interval's width. What only allows for the rounding
/// of sums counts as nothing.
///
/// # Errors
/// When it has no pixel.
pub fn half_widths(truth: &Truth) -> Result<Image> {
    let bounds = truth.low.values().as_flattened().iter().zip(truth.high.values().as_flattened());
    let half = |width: f64| if width > ROUNDING { 0.5 * width } else { 0.0 };
    let halves = bounds.map(|(low, high)| half(high - low)).collect();
    Image::new(truth.low.width(), truth.low.height(), 4, halves)
}
