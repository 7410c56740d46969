//! How much of each pixel a triangle covers, and where its sides run: no polygon is cut.
//!
//! Each side adds to the pixels that it crosses what lies east of it (as rasterizers of glyphs do), row by row; sums along the rows are areas.
//! What two triangles have as a common side they walk over in the same way, from its lower end to its upper one, by the same bits. So numbers
//! made of the sides' ends, taken once with each sign, cancel in every pixel where a surface goes on from triangle to triangle, and remain
//! where it ends or folds.

use crate::math;
use glam::DVec2;
use std::ops::Range;

/// The pixels of a triangle; memory that is used again.
#[derive(Debug, Default)]
pub(super) struct Cells {
    columns: Range<usize>,
    rows: Range<usize>,
    /// How the covered share changes from each pixel to the next one in the row; one more than there are columns.
    changes: Vec<f64>,
    /// The sum of the numbers of the sides that run through a pixel.
    borders: Vec<u64>,
}

impl Cells {
    /// Measures a triangle in some columns and rows, which are all that it reaches of a tile.
    pub(super) fn set(&mut self, corners: &[DVec2; 3], [columns, rows]: [Range<usize>; 2]) {
        let count = (columns.len() + 1) * rows.len();
        (self.columns, self.rows) = (columns, rows);
        self.changes.clear();
        self.changes.resize(count, 0.0);
        self.borders.clear();
        self.borders.resize(count, 0);
        for (low, high, sign, border) in sides(corners) {
            self.side(low, high, sign, border);
        }
    }

    /// Calls `visit` with each pixel that the triangle covers or touches, the share that it covers, and the numbers of its sides there.
    pub(super) fn each(&self, mut visit: impl FnMut([usize; 2], f64, u64)) {
        let width = self.columns.len() + 1;
        for (row, y) in self.rows.clone().enumerate() {
            let of_row = row * width..row * width + self.columns.len();
            let mut covered = 0.0;
            for ((x, change), border) in
                self.columns.clone().zip(&self.changes[of_row.clone()]).zip(&self.borders[of_row])
            {
                covered += change;
                if covered != 0.0 || *border != 0 {
                    visit([x, y], covered, *border);
                }
            }
        }
    }

    /// Adds a side from its lower end (the smaller y) to its upper one.
    fn side(&mut self, low: DVec2, high: DVec2, sign: f64, border: u64) {
        let (top, bottom) = (self.rows.start as f64, self.rows.end as f64);
        if high.y < top || low.y >= bottom {
            return;
        }
        let slope = if high.y > low.y { (high.x - low.x) / (high.y - low.y) } else { 0.0 };
        let (left, right) = if low.x < high.x { (low.x, high.x) } else { (high.x, low.x) };
        let x_at = |y: f64| (low.x + (y - low.y) * slope).clamp(left, right);
        let (mut y, mut x) = if low.y < top { (top, x_at(top)) } else { (low.y, low.x) };
        let (last, end) = if high.y > bottom { (bottom, x_at(bottom)) } else { (high.y, high.x) };
        let mut row = (y as usize).min(self.rows.end - 1);
        loop {
            let next = (row + 1) as f64;
            if next >= last || row + 1 == self.rows.end {
                self.part((row, [x, end]), sign * (last - y), border);
                return;
            }
            let there = x_at(next);
            self.part((row, [x, there]), sign * (next - y), border);
            (y, x, row) = (next, there, row + 1);
        }
    }

    /// Adds the part of a side that lies in one row; `rise` is its height with the side's sign.
    #[inline(always)]
    fn part(&mut self, (row, [x, there]): (usize, [f64; 2]), mut rise: f64, border: u64) {
        let (mut low, mut high) = if x < there { (x, there) } else { (there, x) };
        let (start, end) = (self.columns.start as f64, self.columns.end as f64);
        let first = (row - self.rows.start) * (self.columns.len() + 1);
        if high < start {
            self.changes[first] += rise;
            return;
        }
        if low >= end {
            return;
        }
        if low < start {
            let beside = rise * ((start - low) / (high - low));
            self.changes[first] += beside;
            (low, rise) = (start, rise - beside);
        }
        if high > end {
            rise *= (end - low) / (high - low);
            high = end;
        }
        let from = low as usize;
        let to = (high as usize).min(self.columns.end - 1);
        let at = first + from - self.columns.start;
        if from == to {
            let east = rise * (0.5 * (low + high) - from as f64);
            self.changes[at] += rise - east;
            self.changes[at + 1] += east;
            self.borders[at] = self.borders[at].wrapping_add(border);
            return;
        }
        let each = rise / (high - low);
        let mut place = low;
        for (k, column) in (from..=to).enumerate() {
            let next = math::min((column + 1) as f64, high);
            let rise = each * (next - place);
            let east = rise * (0.5 * (place + next) - column as f64);
            self.changes[at + k] += rise - east;
            self.changes[at + k + 1] += east;
            self.borders[at + k] = self.borders[at + k].wrapping_add(border);
            place = next;
        }
    }
}

/// The area of a triangle that lies in one pixel, and the sum of its sides' numbers.
pub(super) fn inside_of_a_pixel(corners: &[DVec2; 3]) -> (f64, u64) {
    let [a, b, c] = *corners;
    let border = sides(corners).into_iter().fold(0_u64, |sum, (.., border)| sum.wrapping_add(border));
    (0.5 * (b - a).perp_dot(c - a).abs(), border)
}

/// A triangle's sides: the lower end (the smaller y), the upper one, the sign of what is east of it, its number with its sign.
fn sides(corners: &[DVec2; 3]) -> [(DVec2, DVec2, f64, u64); 3] {
    let [a, b, c] = *corners;
    let turn = if (b - a).perp_dot(c - a) < 0.0 { -1.0 } else { 1.0 };
    let marks = corners.map(mark);
    [(0, 1), (1, 2), (2, 0)].map(|(from, to)| {
        let (p, q) = (corners[from], corners[to]);
        // Which end is lower does not depend on the triangle.
        let (low, high, sign) = if (p.y, p.x) < (q.y, q.x) { (from, to, -turn) } else { (to, from, turn) };
        let number = number_of(marks[low], marks[high]);
        let border = if sign < 0.0 { number.wrapping_neg() } else { number };
        (corners[low], corners[high], sign, border)
    })
}

/// Bits of a place, well mixed (the constants of Steele et al. 2014, "Fast splittable pseudorandom number generators").
fn mark(p: DVec2) -> u64 {
    let x = p.x.to_bits().wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let y = p.y.to_bits().wrapping_mul(0xbf58_476d_1ce4_e5b9);
    (x ^ x >> 29) ^ (y ^ y >> 31).rotate_left(21)
}

/// A number of a side that no sum of other sides' numbers is likely to be.
fn number_of(low: u64, high: u64) -> u64 {
    let mixed = (low ^ high.rotate_left(32)).wrapping_mul(0x94d0_49bb_1331_11eb);
    let mixed = (mixed ^ mixed >> 32).wrapping_add(low).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    mixed ^ mixed >> 29
}

#[cfg(test)]
mod tests {
    use super::super::convex::{Side, area, cut};
    use super::*;
    use proptest::prelude::*;

    const SIDE: usize = 8;

    fn cells(corners: &[DVec2; 3]) -> Vec<(f64, u64)> {
        let mut all = vec![(0.0, 0); SIDE * SIDE];
        let low = corners[0].min(corners[1]).min(corners[2]);
        let high = corners[0].max(corners[1]).max(corners[2]);
        // Casts saturate.
        let range = |from: f64, to: f64| from as usize..(to as usize + 1).min(SIDE);
        let mut cells = Cells::default();
        let ranges = [range(low.x, high.x), range(low.y, high.y)];
        if high.x < 0.0 || high.y < 0.0 || ranges.iter().any(Range::is_empty) {
            return all;
        }
        cells.set(corners, ranges);
        cells.each(|[x, y], area, border| all[y * SIDE + x] = (area, border));
        all
    }

    /// Which pixels a side runs through.
    fn crossed(p: DVec2, q: DVec2) -> Vec<bool> {
        let (low, high) = if (p.y, p.x) < (q.y, q.x) { (p, q) } else { (q, p) };
        let mut cells = Cells { columns: 0..SIDE, rows: 0..SIDE, ..Cells::default() };
        cells.changes.resize((SIDE + 1) * SIDE, 0.0);
        cells.borders.resize((SIDE + 1) * SIDE, 0);
        cells.side(low, high, 1.0, 1);
        (0..SIDE * SIDE).map(|k| cells.borders[k / SIDE * (SIDE + 1) + k % SIDE] != 0).collect()
    }

    fn clipped(corners: &[DVec2; 3], [x, y]: [f64; 2]) -> f64 {
        let mut now =
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[u, v]| DVec2::new(x + u, y + v)).to_vec();
        let mut corners = *corners;
        if area(&corners) < 0.0 {
            corners.reverse();
        }
        for k in 0..3 {
            let mut next = Vec::new();
            cut(&now, &Side::between(corners[k], corners[(k + 1) % 3]), &mut next);
            now = next;
        }
        area(&now)
    }

    /// Places of a coarse lattice, so that corners and sides lie on pixels' borders, and any others.
    fn place() -> impl Strategy<Value = DVec2> {
        let one = || prop_oneof![(-6..20_i32).prop_map(|k| f64::from(k) * 0.5), -3.0..11.0_f64];
        [one(), one()].prop_map(DVec2::from_array)
    }

    proptest! {
        #[test]
        fn shares_are_the_areas_of_the_triangle_cut_to_pixels(corners in [place(), place(), place()]) {
            for (k, (share, _)) in cells(&corners).into_iter().enumerate() {
                let off = share - clipped(&corners, [(k % SIDE) as f64, (k / SIDE) as f64]);
                prop_assert!(off.abs() < 1e-12, "{off} {k}");
            }
        }

        #[test]
        fn sides_of_neighbours_cancel_and_those_of_a_fold_do_not(
            [a, b, c, d] in [place(), place(), place(), place()],
        ) {
            let turns = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p);
            prop_assume!(turns(a, b, c).abs() > 1e-3 && turns(a, d, b).abs() > 1e-3);
            let is_fold = (turns(a, b, c) > 0.0) != (turns(a, d, b) > 0.0);
            let (one, other) = (cells(&[a, b, c]), cells(&[a, d, b]));
            let (common, rest) = (crossed(a, b), [crossed(b, c), crossed(c, a), crossed(a, d), crossed(d, b)]);
            // Where the common side runs alone, nothing is left of it, or it is there twice.
            for k in 0..SIDE * SIDE {
                if common[k] && !rest.iter().any(|of| of[k]) {
                    let left = one[k].1.wrapping_add(other[k].1);
                    prop_assert_eq!(left != 0, is_fold);
                }
            }
        }
    }
}
