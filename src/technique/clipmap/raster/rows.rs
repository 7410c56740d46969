//! What items leave in the rows of a tile.

use super::weight::Weight;
use std::ops::Range;

/// An item's coverage of the texels of one row.
#[derive(Debug, Clone, Default)]
pub(super) struct RowCoverage {
    /// The first texel's column.
    pub(super) first: usize,
    /// How much of each texel is covered; where it is covered several times, how much once would be the same (see [`Weight`]).
    pub(super) coverage: Vec<f32>,
}

/// Takes the covered texels of a row from the west to the east.
///
/// Not a closure: what is compiled for wide vectors must be part of what calls it, which only functions can be told.
pub(super) trait Runs {
    /// Columns that are covered alike.
    fn alike(&mut self, columns: Range<usize>, coverage: f32);

    /// Four columns from one that is a multiple of four; the last may lie beyond the tile.
    fn four(&mut self, first: usize, coverage: &[f32; FOUR]);
}

/// Texels of a vector.
pub(super) const FOUR: usize = 1 << FOUR_BITS;
pub(super) const FOUR_BITS: u32 = 2;

/// An item that has been collected, row by row.
pub(super) trait ByRows {
    /// Columns of a row.
    fn width(&self) -> usize;

    /// The rows that the item may have a part in.
    fn rows(&self) -> Range<usize>;

    /// Hands what is covered of a row to `to`; what is known of the row is used up.
    fn take_row(&mut self, row: usize, weight: Weight, to: &mut impl Runs);

    /// The coverage of a row; what is known of it is used up. False where the item has no part in it.
    fn take_coverage(&mut self, row: usize, weight: Weight, out: &mut RowCoverage) -> bool {
        out.coverage.clear();
        self.take_row(row, weight, &mut Collect { width: self.width(), out });
        !out.coverage.is_empty()
    }
}

/// Collects the coverage of a row.
struct Collect<'a> {
    width: usize,
    out: &'a mut RowCoverage,
}

impl Collect<'_> {
    fn skip_to(&mut self, column: usize) {
        if self.out.coverage.is_empty() {
            self.out.first = column;
        }
        self.out.coverage.resize(column - self.out.first, 0.0);
    }
}

impl Runs for Collect<'_> {
    fn alike(&mut self, columns: Range<usize>, coverage: f32) {
        self.skip_to(columns.start);
        self.out.coverage.resize(columns.end - self.out.first, coverage);
    }

    fn four(&mut self, first: usize, coverage: &[f32; FOUR]) {
        self.skip_to(first);
        self.out.coverage.extend_from_slice(&coverage[..FOUR.min(self.width - first)]);
    }
}
