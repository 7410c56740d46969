//! The parts of an edge in several rows or columns at once.
//!
//! A steep edge meets at most two texels of a row, a shallow one at most two of a column, so that neither needs a branch. All numbers
//! are whole (units of 2^-16 texel, areas in units of 2^-16 texel too) and exact as doubles; plain loops over arrays become
//! vectors. Nothing depends on the tile: its origin only shifts what is whole.

use super::fixed::{BITS, Edge, ONE};

/// Rows or columns at once.
pub(super) const LANES: usize = 8;

/// A texel, as a double.
const TEXEL: f64 = ONE as f64;
/// Texels a unit.
const UNIT: f64 = 1.0 / TEXEL;
/// Adding and taking away this rounds to the nearest whole number (the even one of two), up to 2^51; its lowest bits hold it.
const SHIFT: f64 = 6_755_399_441_055_744.0;

type Row<T> = [T; LANES];

/// Parts of a steep edge: in row k it meets the texels of two columns.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct SteepParts {
    /// The western column.
    pub(super) column: Row<i32>,
    /// The column of the part's eastern end.
    pub(super) last: Row<i32>,
    /// What is added to the differences of the western texel and of the two east of it.
    pub(super) adds: [Row<i32>; 3],
}

/// Parts of a shallow edge: in column k it meets the texels of two rows.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ShallowParts {
    /// The northern row.
    pub(super) row: Row<i32>,
    /// The heights of both parts.
    pub(super) heights: [Row<i32>; 2],
    /// What is added to the differences of the texels in both rows; the rest of a height belongs to the texel east of it.
    pub(super) adds: [Row<i32>; 2],
}

/// An edge's numbers as doubles.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line {
    top: [f64; 2],
    bottom: [f64; 2],
    slope: f64,
    inverse: f64,
    sign: f64,
}

#[inline(always)]
fn round(v: f64) -> f64 {
    (v + SHIFT) - SHIFT
}

#[inline(always)]
fn low(v: f64) -> i32 {
    (v + SHIFT).to_bits() as i32
}

#[inline(always)]
fn least(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

#[inline(always)]
fn most(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The largest whole number that is not above v.
#[inline(always)]
fn floor(v: f64) -> f64 {
    let near = round(v);
    if near > v { near - 1.0 } else { near }
}

/// The area east of a part of an edge in its texel: its height, and the sum of its ends' distances from the eastern side.
#[inline(always)]
fn area_east(height: f64, doubled_x: f64) -> f64 {
    height * doubled_x * (0.5 * UNIT)
}

impl Line {
    #[inline(always)]
    pub(super) fn new(edge: &Edge) -> Self {
        let point = |p: super::fixed::Fixed| [p.x as f64, p.y as f64];
        let (slope, inverse) = edge.slopes();
        Self { top: point(edge.top), bottom: point(edge.bottom), slope, inverse, sign: f64::from(edge.sign) }
    }

    #[inline(always)]
    fn x_at(&self, y: f64) -> f64 {
        self.top[0] + round((y - self.top[1]) * self.slope)
    }

    #[inline(always)]
    fn y_at(&self, x: f64) -> f64 {
        self.top[1] + round((x - self.top[0]) * self.inverse)
    }

    /// The parts in the rows from `first` on; those beyond the edge's end mean nothing.
    #[inline(always)]
    pub(super) fn steep_parts(&self, first: i64) -> SteepParts {
        let mut parts = SteepParts::default();
        for k in 0..LANES {
            let row = (first + k as i64) as f64 * TEXEL;
            let (north, south) = (most(row, self.top[1]), least(row + TEXEL, self.bottom[1]));
            let (x_north, x_south) = (self.x_at(north), self.x_at(south));
            let runs_east = x_north < x_south;
            let (west, east) = if runs_east { (x_north, x_south) } else { (x_south, x_north) };
            let (y_west, y_east) = if runs_east { (north, south) } else { (south, north) };

            // Cut at the column's eastern side.
            let column = floor(west * UNIT);
            let side = (column + 1.0) * TEXEL;
            let y = least(most(self.y_at(side), north), south);
            let is_cut = east > side;
            let (x_cut, y_cut) = if is_cut { (side, y) } else { (east, y_east) };

            let (height, rest) = ((y_cut - y_west).abs(), (y_east - y_cut).abs());
            let here = low(self.sign * area_east(height, (side - west) + (side - x_cut)));
            let there = low(self.sign * area_east(rest, 2.0 * TEXEL - (east - side)));
            parts.column[k] = low(column);
            parts.last[k] = parts.column[k] + i32::from(is_cut);
            parts.adds[0][k] = here;
            parts.adds[1][k] = low(self.sign * height) - here + there;
            parts.adds[2][k] = low(self.sign * rest) - there;
        }
        parts
    }

    /// The parts in the columns from `first` on; those beyond the edge's eastern end mean nothing.
    #[inline(always)]
    pub(super) fn shallow_parts(&self, first: i64) -> ShallowParts {
        let mut parts = ShallowParts::default();
        let (west_end, east_end) = (least(self.top[0], self.bottom[0]), most(self.top[0], self.bottom[0]));
        for k in 0..LANES {
            let column = (first + k as i64) as f64 * TEXEL;
            let (west, east) = (most(column, west_end), least(column + TEXEL, east_end));
            let (y_west, y_east) = (self.y_at(west), self.y_at(east));
            let runs_south = y_west < y_east;
            let (north, south) = if runs_south { (y_west, y_east) } else { (y_east, y_west) };
            let (x_north, x_south) = if runs_south { (west, east) } else { (east, west) };

            // Cut at the row's southern side.
            let row = floor(north * UNIT);
            let border = (row + 1.0) * TEXEL;
            let x = least(most(self.x_at(border), west), east);
            let is_cut = south > border;
            let (x_cut, y_cut) = if is_cut { (x, border) } else { (x_south, south) };

            let (height, rest) = (y_cut - north, south - y_cut);
            let side = column + TEXEL;
            let here = area_east(height, (side - x_north) + (side - x_cut));
            let there = area_east(rest, (side - x_cut) + (side - x_south));
            parts.row[k] = low(row);
            parts.heights[0][k] = low(height);
            parts.heights[1][k] = low(rest);
            parts.adds[0][k] = low(self.sign * here);
            parts.adds[1][k] = low(self.sign * there);
        }
        parts
    }

    /// The heights between which the part west (or east) of a meridian lies.
    #[inline(always)]
    pub(super) fn heights_beside(&self, x: i64, is_west: bool) -> (i64, i64) {
        let end = if (self.top[0] < self.bottom[0]) == is_west { self.top[1] } else { self.bottom[1] };
        let cut = self.y_at(x as f64);
        let whole = |v: f64| v as i64;
        if end < cut { (whole(end), whole(cut)) } else { (whole(cut), whole(end)) }
    }
}

/// The column or row of a coordinate.
#[inline(always)]
pub(super) fn texel_of(v: i64) -> i64 {
    v >> BITS
}
