//! Tables of a bundle -> rows that can be relied on: sorted, within the picture, the right way up.

use crate::compare::allowed::{Choice, Extremes, FeatureRun};
use crate::compare::read::Array;
use crate::error::{Error, Result};

/// A row: pixel, four channels, four channels.
type Row = [u32; 9];
/// The same, read: a pixel and two colours.
type Colors = (u32, [u16; 4], [u16; 4]);

/// The pixels of a picture of a size.
#[derive(Debug, Clone, Copy)]
pub(super) struct Size {
    pub width: usize,
    pub height: usize,
}

impl Size {
    fn holds(self, pixel: u32) -> bool {
        (pixel as usize) < self.width * self.height
    }
}

pub(super) fn choices(bytes: &[u8], size: Size) -> Result<Vec<Choice>> {
    let choices = rows(bytes, size)?.into_iter();
    let choices: Vec<Choice> = choices.map(|(pixel, lo, hi)| Choice { pixel, lo, hi }).collect();
    let is_upright = |choice: &Choice| choice.lo.iter().zip(choice.hi).all(|(lo, hi)| *lo <= hi);
    match choices.iter().find(|choice| !is_upright(choice)) {
        Some(wrong) => Err(Error::new(format!("a choice of pixel {} is upside down", wrong.pixel))),
        None => Ok(choices),
    }
}

pub(super) fn extremes(bytes: &[u8], size: Size) -> Result<Vec<Extremes>> {
    let extremes = rows(bytes, size)?.into_iter();
    let extremes: Vec<Extremes> =
        extremes.map(|(pixel, least, most)| Extremes { pixel, least, most }).collect();
    match extremes.windows(2).find(|pair| pair[0].pixel == pair[1].pixel) {
        Some(pair) => Err(Error::new(format!("pixel {} has its two ends twice", pair[0].pixel))),
        None => Ok(extremes),
    }
}

fn rows(bytes: &[u8], size: Size) -> Result<Vec<Colors>> {
    let rows = Array::of(bytes)?.whole_rows::<9>()?;
    check_pixels(rows.iter().map(|row| row[0]), size)?;
    let read = |row: &Row| {
        let codes = |from: usize| -> Option<[u16; 4]> {
            let mut codes = [0; 4];
            for (code, value) in codes.iter_mut().zip(&row[from..]) {
                *code = u16::try_from(*value).ok()?;
            }
            Some(codes)
        };
        let wrong = || Error::new(format!("a colour of pixel {} is beyond 65535", row[0]));
        Ok((row[0], codes(1).ok_or_else(wrong)?, codes(5).ok_or_else(wrong)?))
    };
    rows.iter().map(read).collect()
}

/// Places in a buffer, which may be finer than the picture, and their values.
pub(super) fn one_of(bytes: &[u8]) -> Result<Vec<(u32, f64)>> {
    let rows = Array::of(bytes)?.real_rows::<2>()?;
    if let Some([pixel, value]) =
        rows.iter().find(|[pixel, value]| f64::from(*pixel as u32) != *pixel || value.is_nan())
    {
        return Err(Error::new(format!("a row of the pixel {pixel} and the value {value} is none")));
    }
    // A cast keeps a whole number.
    let rows: Vec<(u32, f64)> = rows.into_iter().map(|[pixel, value]| (pixel as u32, value)).collect();
    check_sorted(rows.iter().map(|(pixel, _)| *pixel))?;
    Ok(rows)
}

pub(super) fn runs(bytes: &[u8], size: Size) -> Result<Vec<FeatureRun>> {
    let rows = Array::of(bytes)?.whole_rows::<5>()?;
    let run = |[row, first, last, layer, feature]: [u32; 5]| FeatureRun { row, first, last, layer, feature };
    let runs: Vec<FeatureRun> = rows.into_iter().map(run).collect();
    let is_inside = |run: &FeatureRun| {
        (run.row as usize) < size.height && run.first <= run.last && (run.last as usize) < size.width
    };
    match runs.iter().find(|run| !is_inside(run)) {
        Some(FeatureRun { row, first, last, .. }) => {
            Err(Error::new(format!("row {row} has no pixels from {first} to {last}")))
        }
        None => Ok(runs),
    }
}

fn check_pixels(pixels: impl Iterator<Item = u32> + Clone, size: Size) -> Result<()> {
    if let Some(outside) = pixels.clone().find(|pixel| !size.holds(*pixel)) {
        return Err(Error::new(format!("the picture has no pixel {outside}")));
    }
    check_sorted(pixels)
}

fn check_sorted(pixels: impl Iterator<Item = u32>) -> Result<()> {
    if !pixels.is_sorted() {
        return Err(Error::new("its rows are not sorted by pixel"));
    }
    Ok(())
}
