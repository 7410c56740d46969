//! What the picture of texture reads says: how many bits weights have.

use super::drawing::{STEP, told};
use super::pictures::{BAND, BAND_STEPS, SIDE};
use super::sheet::Sheet;
use crate::error::Result;

/// The fractional bits of weights, by two bands of reads; 0: no steps were seen.
///
/// # Errors
/// When no number of bits explains them.
pub(super) fn bits(sheet: &Sheet, first_band: usize) -> Result<u32> {
    let reads: Vec<(f64, f64)> = (0..2)
        .flat_map(|k| {
            let row = (first_band + k) * BAND + BAND / 2;
            (0..SIDE).map(move |column| (column as f64 * BAND_STEPS[k], [column, row]))
        })
        .map(|(weight, at)| (weight, told(sheet.at(at))))
        .collect();
    let fits = |bits: &u32| {
        let steps = f64::from(1u32 << bits);
        reads.iter().all(|(weight, read)| {
            let is_multiple = (read * steps - (read * steps).round()).abs() <= 2.0 * STEP * steps;
            is_multiple && (weight - read).abs() <= 1.0 / steps + 2.0 * STEP
        })
    };
    // Fewer bits fit only where all are multiples of a coarser step.
    match (1..=12).find(fits) {
        Some(12) => Ok(0),
        Some(bits) => Ok(bits),
        None if reads.iter().all(|(weight, read)| (weight - read).abs() <= 4.0 * STEP) => Ok(0),
        None => {
            Err(sheet.contradiction("no number of fractional bits explains the weights of texture reads"))
        }
    }
}
