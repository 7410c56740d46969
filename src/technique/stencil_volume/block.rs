//! Blocks of samples, and the kernel that counts a face's fragments in one.
//!
//! Input: [`Face`]s, the surface points of [`COLUMNS`] x [`ROWS`] samples. Output: for each sample whether the face is crossed, and on which
//! side of the surface point. Plain loops over 16 samples, compiled for the widest vectors at hand. Refuses: nothing; what
//! the filter cannot tell is marked [`OPEN`].

use super::face::Face;
use crate::math::{max_f32, min_f32};
use crate::space::World;

/// Samples a row of a block: a vector.
pub const COLUMNS: usize = 16;
/// Rows of a block.
pub const ROWS: usize = 8;
/// Samples of a block.
pub const SIZE: usize = COLUMNS * ROWS;

/// A sample that the face does not cover.
pub const NONE: i32 = 0;
/// The face lies behind the surface point.
pub const BEHIND: i32 = 1;
/// The face lies before the surface point.
pub const BEFORE: i32 = 2;
/// To be decided exactly.
pub const OPEN: i32 = 3;

/// The states of a row of a block.
pub type Row = [i32; COLUMNS];

/// Samples of a tile with the surface points that they see.
#[derive(Debug, Clone)]
pub struct Block {
    /// Column of the first sample in the tile.
    pub column: usize,
    /// Row of the first sample in the tile.
    pub row: usize,
    /// Columns that lie in the tile.
    pub columns: usize,
    /// Rows that lie in the tile.
    pub rows: usize,
    /// Surface points relative to the tile's origin; NaN for the sky.
    x: [f32; SIZE],
    y: [f32; SIZE],
    z: [f32; SIZE],
    /// The least and the greatest coordinates of the points; inverted where all is sky.
    low: [f32; 3],
    high: [f32; 3],
}

impl Block {
    /// A block that sees the sky.
    pub fn new((column, row): (usize, usize), (width, height): (usize, usize)) -> Self {
        Self {
            column,
            row,
            columns: COLUMNS.min(width - column),
            rows: ROWS.min(height - row),
            x: [f32::NAN; SIZE],
            y: [f32::NAN; SIZE],
            z: [f32::NAN; SIZE],
            low: [f32::INFINITY; 3],
            high: [f32::NEG_INFINITY; 3],
        }
    }

    /// Takes the surface points of row `r`, infinite where the sky is seen.
    #[inline(always)]
    pub fn set_row(&mut self, r: usize, points: &[World], origin: World) {
        let start = r * COLUMNS;
        let known = |v: f64| if v.abs() < f64::INFINITY { v as f32 } else { f32::NAN };
        for (lane, p) in points.iter().enumerate() {
            self.x[start + lane] = known(p.x - origin.x);
            self.y[start + lane] = known(p.y - origin.y);
            self.z[start + lane] = known(p.z - origin.z);
        }
    }

    /// Finds how far the points reach, when all rows are known.
    #[inline(always)]
    pub fn close(&mut self) {
        for (k, values) in [&self.x, &self.y, &self.z].into_iter().enumerate() {
            let (mut low, mut high) = ([f32::INFINITY; COLUMNS], [f32::NEG_INFINITY; COLUMNS]);
            for row in values.as_chunks::<COLUMNS>().0 {
                for lane in 0..COLUMNS {
                    // NaN changes nothing.
                    low[lane] = min_f32(row[lane], low[lane]);
                    high[lane] = max_f32(row[lane], high[lane]);
                }
            }
            self.low[k] = low.into_iter().fold(f32::INFINITY, min_f32);
            self.high[k] = high.into_iter().fold(f32::NEG_INFINITY, max_f32);
        }
    }

    /// The largest coordinate of a point; 0 where all is sky.
    pub fn reach(&self) -> f32 {
        let ends = self.low.iter().chain(&self.high).map(|v| v.abs());
        ends.filter(|v| v.is_finite()).fold(0.0, max_f32)
    }

    /// The least and the greatest coordinates of its points; inverted where all is sky.
    #[inline(always)]
    pub fn reaches(&self) -> ([f32; 3], [f32; 3]) {
        (self.low, self.high)
    }

    /// The coordinates of the points of row `r`, NaN for the sky and beyond the tile.
    #[inline(always)]
    pub fn points(&self, r: usize) -> Option<[&[f32; COLUMNS]; 3]> {
        let start = r * COLUMNS;
        Some([self.x[start..].first_chunk()?, self.y[start..].first_chunk()?, self.z[start..].first_chunk()?])
    }

    /// Whether a point of the block may lie in a box (relative to the tile's origin) that is `slack` larger.
    #[inline(always)]
    pub fn meets(&self, low: &[f64; 3], high: &[f64; 3], slack: f64) -> bool {
        (0..3).all(|k| f64::from(self.low[k]) <= high[k] + slack && f64::from(self.high[k]) >= low[k] - slack)
    }

    /// The rows of the block that a face's picture can touch, and whether there are any; `first` are the tile coordinates of
    /// the tile's first sample.
    #[inline(always)]
    pub fn rows_of(&self, face: &Face, first: (f64, f64)) -> Option<(usize, usize)> {
        let last = (self.column + self.columns - 1, self.row + self.rows - 1);
        if face.columns.0 > last.0
            || face.columns.1 < self.column
            || face.rows.0 > last.1
            || face.rows.1 < self.row
        {
            return None;
        }
        let (x, y) = (first.0 + self.column as f64, first.1 + self.row as f64);
        let limit = -f64::from(face.doubt);
        let reaches = |e: &glam::DVec3| {
            // The greatest value at the block's corners.
            let across = if e.x > 0.0 { e.x * (COLUMNS - 1) as f64 } else { 0.0 };
            let down = if e.y > 0.0 { e.y * (ROWS - 1) as f64 } else { 0.0 };
            e.x * x + e.y * y + e.z + across + down >= limit
        };
        face.edges
            .iter()
            .all(reaches)
            .then_some((face.rows.0.max(self.row) - self.row, face.rows.1.min(last.1) - self.row))
    }

    /// The states of row `r` of the block under a face; false: none of them is open.
    #[inline(always)]
    pub fn classify(&self, face: &Face, first: (f64, f64), r: usize, states: &mut Row) -> bool {
        let (x, y) = (first.0 + self.column as f64, first.1 + (self.row + r) as f64);
        let at = |e: &glam::DVec3| ((e.x * x + e.y * y + e.z) as f32, e.x as f32);
        let [(e0, d0), (e1, d1), (e2, d2), (e3, d3)] =
            [at(&face.edges[0]), at(&face.edges[1]), at(&face.edges[2]), at(&face.edges[3])];
        let [sx, sy, sz, constant] = face.side;
        let (doubt, slack, columns) = (face.doubt, face.slack, self.columns as f32);
        let Some([px, py, pz]) = self.points(r) else { return false };
        let mut any = 0;
        for lane in 0..COLUMNS {
            let l = lane as f32;
            let least = min_f32(min_f32(e0 + d0 * l, e1 + d1 * l), min_f32(e2 + d2 * l, e3 + d3 * l));
            let side = sx * px[lane] + sy * py[lane] + sz * pz[lane] + constant;
            let possible = (least >= -doubt) & (l < columns);
            let near = side.abs() <= slack;
            let is_open = possible & ((least <= doubt) | near);
            // The sky's side is NaN: every face lies before it.
            let state = if side > slack { BEHIND } else { BEFORE };
            let state = if is_open { OPEN } else { state };
            states[lane] = if possible { state } else { NONE };
            any |= i32::from(is_open);
        }
        any != 0
    }
}
