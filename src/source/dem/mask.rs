//! Which posts of a part are masked: a bit each.

use super::frame::PostRange;
use super::grid::{GridFile, RowSink};
use crate::error::{Error, Result};

/// The most posts that a mask is held of (512 MiB).
const MOST: u64 = 1 << 32;

/// A bit for each post of a part: set where it is masked.
pub(super) struct Mask {
    part: PostRange,
    bits: Vec<u64>,
}

impl Mask {
    /// Reads the masks of a part: a post whose sample is 0 in any of them is masked.
    pub(super) fn read(masks: &mut [Box<dyn GridFile>], part: &PostRange) -> Result<Option<Self>> {
        if masks.is_empty() {
            return Ok(None);
        }
        let of_mask = |error: Error| error.reworded(|what| format!("its mask: {what}"));
        for file in &mut *masks {
            file.check_promise(part).map_err(of_mask)?;
        }
        let mut mask = Self::new(part)?;
        for file in masks {
            file.scan(part, &mut mask).map_err(of_mask)?;
        }
        Ok(Some(mask))
    }

    fn new(part: &PostRange) -> Result<Self> {
        let refuse = || {
            Error::unsupported(format!("a mask of {} x {} posts is too large", part.columns, part.rows))
                .help("read a part of it (`window = [x0, y0, x1, y1]`)")
        };
        let count = part.columns.checked_mul(part.rows).filter(|n| *n as u64 <= MOST).ok_or_else(refuse)?;
        let mut bits = Vec::new();
        bits.try_reserve_exact(count.div_ceil(64)).map_err(|_| refuse())?;
        bits.resize(count.div_ceil(64), 0);
        Ok(Self { part: *part, bits })
    }

    fn index(&self, row: usize, column: usize) -> usize {
        (row - self.part.row) * self.part.columns + column - self.part.column
    }

    /// Takes the heights of masked posts away; all of the run must lie in the part.
    pub(super) fn apply(&self, row: usize, column: usize, heights: &mut [f64]) {
        let first = self.index(row, column);
        for (at, height) in (first..).zip(heights) {
            if self.bits[at / 64] >> (at % 64) & 1 == 1 {
                *height = f64::NAN;
            }
        }
    }
}

impl RowSink for Mask {
    fn take(&mut self, row: usize, column: usize, samples: &[f64]) {
        let (column, samples) = self.part.clip(row, column, samples);
        if samples.is_empty() {
            return;
        }
        let first = self.index(row, column);
        for (at, sample) in (first..).zip(samples) {
            if *sample == 0.0 || sample.is_nan() {
                self.bits[at / 64] |= 1 << (at % 64);
            }
        }
    }
}
