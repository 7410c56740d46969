//! Aliased polygons: a texel is covered when its centre is.
//!
//! Each edge changes the winding number of the centres east of it, decided exactly in texel coordinates; a centre on an edge belongs
//! to what lies east of it, so that polygons that share an edge cover each centre once.

use super::fixed::{FARTHEST, without_far};
use super::rows::{ByRows, Runs};
use super::weight::Weight;
use crate::predicate::orient2d;
use crate::space::{Plan, Texel};
use std::ops::Range;

/// The winding numbers of a tile's centres.
#[derive(Debug)]
pub(super) struct Centres {
    width: usize,
    height: usize,
    origin: (i64, i64),
    /// Differences along rows.
    windings: Vec<i32>,
    /// Which of them an edge has changed: words of 64 columns, so many a row.
    touched: Vec<u64>,
    words: usize,
    rows: (usize, usize),
    ring: Vec<Texel>,
    arch: pulp::Arch,
}

impl Centres {
    /// The centres of a tile whose first texel is `origin`.
    pub(super) fn new(origin: (i64, i64), (width, height): (usize, usize)) -> Self {
        let words = width.div_ceil(64);
        Self {
            width,
            height,
            origin,
            windings: vec![0; width * height],
            touched: vec![0; words * height],
            words,
            rows: (height, 0),
            ring: Vec::new(),
            arch: pulp::Arch::new(),
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
            self.windings[row * self.width..(row + 1) * self.width].fill(0);
            self.touched[row * self.words..(row + 1) * self.words].fill(0);
        }
        self.rows = (self.height, 0);
    }

    /// Adds a ring.
    pub(super) fn ring(&mut self, ring: &[Texel]) {
        let arch = self.arch;
        let mut room = std::mem::take(&mut self.ring);
        arch.dispatch(AddRing { ring: without_far(ring, FARTHEST, &mut room), to: self });
        self.ring = room;
    }

    /// An edge from its northern end to its southern.
    #[inline(always)]
    fn edge(&mut self, top: Texel, bottom: Texel, sign: i32) {
        // Rows whose centre line it crosses; its southern end is not part of it.
        let north = self.origin.1 as f64 + 0.5;
        let first = (top.y - north).ceil().clamp(0.0, self.height as f64) as usize;
        let end = (bottom.y - north).ceil().clamp(0.0, self.height as f64) as usize;
        if first >= end {
            return;
        }
        let slope = (bottom.x - top.x) / (bottom.y - top.y);
        let doubt = 16.0 * f64::EPSILON * (top.x.abs() + bottom.x.abs() + 1.0);
        self.rows = (self.rows.0.min(first), self.rows.1.max(end));
        for row in first..end {
            let y = north + row as f64;
            let x = top.x + (y - top.y) * slope;
            let column = first_column_east(x, doubt, |centre| {
                let p = |t: Texel| Plan::new(t.x, t.y);
                // With y pointing south, a negative side is east of an edge that runs south.
                orient2d(p(top), p(bottom), Plan::new(centre, y)) <= 0.0
            });
            let column = (column - self.origin.0).max(0) as usize;
            if column < self.width {
                self.windings[row * self.width + column] += sign;
                self.touched[row * self.words + column / 64] |= 1 << (column % 64);
            }
        }
    }
}

impl ByRows for Centres {
    fn width(&self) -> usize {
        self.width
    }

    fn rows(&self) -> Range<usize> {
        self.rows.0..self.rows.1
    }

    #[inline(always)]
    fn take_row(&mut self, row: usize, weight: Weight, to: &mut impl Runs) {
        let (mut winding, mut from) = (0, 0);
        let mut run = |columns: Range<usize>, winding: i32| {
            let coverage = weight.of(winding);
            if coverage != 0.0 && !columns.is_empty() {
                to.alike(columns, coverage as f32);
            }
        };
        for word in 0..self.words {
            let mut touched = std::mem::take(&mut self.touched[row * self.words + word]);
            while touched != 0 {
                let column = word * 64 + touched.trailing_zeros() as usize;
                touched &= touched - 1;
                let change = std::mem::take(&mut self.windings[row * self.width + column]);
                if change != 0 {
                    run(from..column, winding);
                    (winding, from) = (winding + change, column);
                }
            }
        }
        run(from..self.width, winding);
    }
}

/// Adds the edges of a ring; compiled for the widest vectors of the machine at hand, which have instructions for rounding.
struct AddRing<'a> {
    to: &'a mut Centres,
    ring: &'a [Texel],
}

impl pulp::WithSimd for AddRing<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { to, ring } = self;
        let Some(&last) = ring.last() else { return };
        let mut from = last;
        for &at in ring {
            if from.y < at.y {
                to.edge(from, at, 1);
            } else if at.y < from.y {
                to.edge(at, from, -1);
            }
            from = at;
        }
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
    use super::super::rows::RowCoverage;
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
            if centres.take_coverage(r, weight, &mut row) {
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
