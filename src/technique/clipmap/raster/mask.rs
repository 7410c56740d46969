//! Coverage that is collected texel by texel, the greatest counting.

use super::rows::RowCoverage;

/// The coverage of a tile by one item.
#[derive(Debug)]
pub(super) struct Mask {
    width: usize,
    height: usize,
    coverage: Vec<f32>,
    /// First and last column of each row; empty where first > last.
    spans: Vec<(u32, u32)>,
    rows: (usize, usize),
}

const EMPTY: (u32, u32) = (u32::MAX, 0);

impl Mask {
    /// A mask of nothing.
    pub(super) fn new((width, height): (usize, usize)) -> Self {
        Self {
            width,
            height,
            coverage: vec![0.0; width * height],
            spans: vec![EMPTY; height],
            rows: (height, 0),
        }
    }

    /// Its columns and rows.
    pub(super) fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// The rows that something lies in.
    pub(super) fn rows(&self) -> std::ops::Range<usize> {
        self.rows.0..self.rows.1
    }

    /// Covers a texel at least so much.
    #[inline(always)]
    pub(super) fn raise(&mut self, column: usize, row: usize, coverage: f32) {
        let texel = &mut self.coverage[row * self.width + column];
        if coverage > *texel {
            *texel = coverage;
            let span = &mut self.spans[row];
            *span = (span.0.min(column as u32), span.1.max(column as u32));
            self.rows = (self.rows.0.min(row), self.rows.1.max(row + 1));
        }
    }

    /// Takes a row's coverage; false where there is none. When the last row is taken the mask is empty.
    pub(super) fn take_row(&mut self, row: usize, out: &mut RowCoverage) -> bool {
        out.coverage.clear();
        let (first, last) = std::mem::replace(&mut self.spans[row], EMPTY);
        if row + 1 == self.rows.1 {
            self.rows = (self.height, 0);
        }
        if first > last {
            return false;
        }
        let texels = &mut self.coverage[row * self.width..][first as usize..=last as usize];
        out.first = first as usize;
        out.coverage.extend_from_slice(texels);
        texels.fill(0.0);
        true
    }
}
