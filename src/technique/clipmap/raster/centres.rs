//! Aliased polygons: a texel is covered when its centre is.
//!
//! Each edge changes the winding number of the centres east of it, decided exactly in texel coordinates; a centre on an edge belongs
//! to what lies east of it, so that polygons that share an edge cover each centre once.

use super::exact::RowCoverage;
use super::fixed::{FARTHEST, without_far};
use super::weight::Weight;
use crate::predicate::orient2d;
use crate::space::{Plan, Texel};

/// The winding numbers of a tile's centres.
#[derive(Debug)]
pub(super) struct Centres {
    width: usize,
    height: usize,
    origin: (i64, i64),
    /// Differences along rows.
    windings: Vec<i32>,
    /// First and last column that differs, a row each; empty where first > last.
    spans: Vec<(u32, u32)>,
    rows: (usize, usize),
    ring: Vec<Texel>,
}

const EMPTY: (u32, u32) = (u32::MAX, 0);

impl Centres {
    /// The centres of a tile whose first texel is `origin`.
    pub(super) fn new(origin: (i64, i64), (width, height): (usize, usize)) -> Self {
        Self {
            width,
            height,
            origin,
            windings: vec![0; (width + 1) * height],
            spans: vec![EMPTY; height],
            rows: (height, 0),
            ring: Vec::new(),
        }
    }

    /// Moves to another tile of the same size.
    pub(super) fn move_to(&mut self, origin: (i64, i64)) {
        self.start();
        self.origin = origin;
    }

    /// Starts an item; what is left of the one before is forgotten.
    pub(super) fn start(&mut self) {
        for row in self.rows.0..self.rows.1 {
            self.forget_row(row);
        }
        self.rows = (self.height, 0);
    }

    fn forget_row(&mut self, row: usize) {
        self.windings[row * (self.width + 1)..(row + 1) * (self.width + 1)].fill(0);
        self.spans[row] = EMPTY;
    }

    /// The rows that the item may have a part in.
    pub(super) fn rows(&self) -> std::ops::Range<usize> {
        self.rows.0..self.rows.1
    }

    /// Adds a ring.
    pub(super) fn ring(&mut self, ring: &[Texel]) {
        let mut room = std::mem::take(&mut self.ring);
        let near = without_far(ring, FARTHEST, &mut room);
        for k in 0..near.len() {
            let (from, to) = (near[k], near[(k + 1) % near.len()]);
            if from.y < to.y {
                self.edge(from, to, 1);
            } else if to.y < from.y {
                self.edge(to, from, -1);
            }
        }
        self.ring = room;
    }

    /// An edge from its northern end to its southern.
    fn edge(&mut self, top: Texel, bottom: Texel, sign: i32) {
        // Rows whose centre line it crosses; its southern end is not part of it.
        let north = self.origin.1 as f64 + 0.5;
        let first = (top.y - north).ceil().clamp(0.0, self.height as f64) as usize;
        let end = (bottom.y - north).ceil().clamp(0.0, self.height as f64) as usize;
        let slope = (bottom.x - top.x) / (bottom.y - top.y);
        let doubt = 16.0 * f64::EPSILON * (top.x.abs() + bottom.x.abs() + 1.0);
        for row in first..end {
            let y = north + row as f64;
            let x = top.x + (y - top.y) * slope;
            let column = first_column_east(x, doubt, |centre| {
                let p = |t: Texel| Plan::new(t.x, t.y);
                // With y pointing south, a negative side is east of an edge that runs south.
                orient2d(p(top), p(bottom), Plan::new(centre, y)) <= 0.0
            });
            let column = (column - self.origin.0).clamp(0, self.width as i64) as usize;
            if column < self.width {
                self.windings[row * (self.width + 1) + column] += sign;
                let span = &mut self.spans[row];
                *span = (span.0.min(column as u32), span.1.max(column as u32));
                self.rows = (self.rows.0.min(row), self.rows.1.max(row + 1));
            }
        }
    }

    /// The coverage of a row; what is known of it is used up. False where the item has no part in it.
    pub(super) fn take_row(&mut self, row: usize, weight: Weight, out: &mut RowCoverage) -> bool {
        out.coverage.clear();
        if self.spans[row] == EMPTY {
            return false;
        }
        let (first, last) = (self.spans[row].0 as usize, self.spans[row].1 as usize);
        out.first = first;
        let mut winding = 0;
        let mut known = (0, 0.0);
        let mut coverage = |winding: i32| {
            if winding != known.0 {
                known = (winding, weight.of(winding) as f32);
            }
            known.1
        };
        let start = row * (self.width + 1);
        for column in first..=last {
            winding += self.windings[start + column];
            out.coverage.push(coverage(winding));
        }
        if winding != 0 {
            out.coverage.resize(self.width - first, coverage(winding));
        }
        self.forget_row(row);
        true
    }
}

/// The number of the first texel whose centre is not west of an edge that crosses its row at x, give or take `doubt`.
#[inline(always)]
fn first_column_east(x: f64, doubt: f64, is_east: impl Fn(f64) -> bool) -> i64 {
    let column = (x - 0.5).ceil();
    let (to_next, to_last) = (column + 0.5 - x, x - (column - 0.5));
    if to_next < doubt && !is_east(column + 0.5) {
        return column as i64 + 1;
    }
    if to_last < doubt && is_east(column - 0.5) {
        return column as i64 - 1;
    }
    column as i64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Rule;
    use proptest::prelude::*;

    fn picture(size: usize, rings: &[Vec<[f64; 2]>], weight: Weight) -> Vec<String> {
        let mut centres = Centres::new((0, 0), (size, size));
        centres.start();
        for ring in rings {
            centres.ring(&ring.iter().map(|p| Texel::new(p[0], p[1])).collect::<Vec<_>>());
        }
        let mut row = RowCoverage::default();
        let mut line = |r: usize| {
            let mut text = vec!['.'; size];
            if centres.take_row(r, weight, &mut row) {
                for (k, v) in row.coverage.iter().enumerate() {
                    text[row.first + k] = if *v == 0.0 { '.' } else { char::from(b'0' + *v as u8) };
                }
            }
            text.into_iter().collect::<String>()
        };
        (0..size).map(&mut line).collect()
    }

    #[test]
    fn a_square_covers_the_centres_on_its_northern_and_western_sides_alone() {
        // Counter-clockwise on the map: south along the western side first.
        let square = vec![[0.5, 0.5], [0.5, 3.5], [3.5, 3.5], [3.5, 0.5]];
        assert_eq!(picture(5, &[square], Weight::UNION), ["111..", "111..", "111..", ".....", "....."]);
    }

    #[test]
    fn overlaps_are_counted() {
        let square = |x: f64| vec![[x, 0.0], [x, 2.0], [x + 2.0, 2.0], [x + 2.0, 0.0]];
        let weight = Weight::Layers { alpha: None };
        assert_eq!(picture(4, &[square(0.0), square(1.0)], weight)[0], "121.");
        assert_eq!(picture(4, &[square(0.0), square(1.0)], Weight::Rule(Rule::EvenOdd))[0], "1.1.");
    }

    proptest! {
        #[test]
        fn triangles_around_a_point_cover_every_centre_once(
            x in 0..32i32, y in 0..32i32, turn in 0.0..1.0f64,
        ) {
            // The point lies on a centre, corners on texel corners or centres: many ties.
            let hub = [f64::from(x) / 2.0, f64::from(y) / 2.0];
            let rim = [[-20.0, -20.0], [-20.0, 40.0 * turn], [-20.0, 40.0], [8.5, 40.0], [40.0, 40.0], [40.0, -20.0]];
            let rings: Vec<Vec<[f64; 2]>> =
                (0..6).map(|k| vec![hub, rim[k], rim[(k + 1) % 6]]).collect();
            let rows = picture(16, &rings, Weight::Layers { alpha: None });
            prop_assert!(rows.iter().all(|row| row == &"1".repeat(16)), "{rows:#?}");
        }
    }
}
