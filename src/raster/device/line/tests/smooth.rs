use super::drawing::{Ends, SIZE, fragments, picture, smooth};
use crate::raster::device::{Fragment, Stipple, Window};
use dashu::rational::{RBig, Relaxed};
use proptest::prelude::*;
use std::collections::BTreeMap;

type R = Relaxed;

fn exact(v: f64) -> R {
    RBig::try_from(v).unwrap().relax()
}

/// The area that a polygon, given by its corners, has in a pixel: cut at the pixel's sides, in rational arithmetic.
fn area_in(polygon: &[[R; 2]], column: usize, row: usize) -> f64 {
    let mut polygon = polygon.to_vec();
    for (axis, limit, is_low) in
        [(0, column, true), (0, column + 1, false), (1, row, true), (1, row + 1, false)]
    {
        let inside = |p: &[R; 2]| {
            let beyond = p[axis].clone() - exact(limit as f64);
            if is_low { beyond } else { R::ZERO - beyond }
        };
        let mut cut = Vec::new();
        for (k, p) in polygon.iter().enumerate() {
            let q = &polygon[(k + 1) % polygon.len()];
            let (at_p, at_q) = (inside(p), inside(q));
            if at_p >= R::ZERO {
                cut.push(p.clone());
            }
            if (at_p >= R::ZERO) != (at_q >= R::ZERO) {
                let t = at_p.clone() / (at_p - at_q);
                let between = |k: usize| p[k].clone() + (q[k].clone() - p[k].clone()) * t.clone();
                cut.push([between(0), between(1)]);
            }
        }
        polygon = cut;
    }
    let count = polygon.len();
    let twice = (0..count).fold(R::ZERO, |sum, k| {
        let (p, q) = (&polygon[k], &polygon[(k + 1) % count]);
        sum + p[0].clone() * q[1].clone() - p[1].clone() * q[0].clone()
    });
    (twice / R::from(2)).canonicalize().to_f64().value().abs()
}

fn coverage(all: &[Fragment]) -> BTreeMap<(usize, usize), f64> {
    let mut sums = BTreeMap::new();
    all.iter().for_each(|f| *sums.entry((f.column, f.row)).or_default() += f.coverage);
    sums
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn coverage_is_the_area_of_the_rectangle_in_the_pixel(
        a in (-16..96i32, -16..96i32), n in -12..12i32, direction in 0..8usize, width in 1..40u8
    ) {
        // Directions of a rational length: the rectangle's corners are rational.
        let [dx, dy, length] = [
            [1, 0, 1], [0, 1, 1], [3, 4, 5], [4, -3, 5], [5, 12, 13], [-12, 5, 13], [8, 15, 17], [15, -8, 17],
        ][direction];
        let start = [a.0, a.1].map(|v| f64::from(v) / 8.0);
        let end = [start[0] + f64::from(n * dx) / 8.0, start[1] + f64::from(n * dy) / 8.0];
        let width = f64::from(width) / 8.0;
        let half = |v: i32| exact(width) * exact(f64::from(v)) / exact(f64::from(2 * length));
        let corner = |p: [f64; 2], sign: i32| [exact(p[0]) - half(dy * sign), exact(p[1]) + half(dx * sign)];
        let corners = [corner(start, -1), corner(end, -1), corner(end, 1), corner(start, 1)];
        let all = fragments([start, end], &smooth(width, Stipple::SOLID), 0, &picture());
        let found = coverage(&all);
        prop_assert_eq!(found.len(), all.len(), "a pixel is visited twice");
        for column in 0..SIZE {
            for row in 0..SIZE {
                let (area, expected) = (found.get(&(column, row)).copied(), area_in(&corners, column, row));
                let error = (area.unwrap_or(0.0) - expected).abs();
                prop_assert!(error < 1e-12, "{column} {row}: {area:?}, not {expected}");
                prop_assert!(area.is_none_or(|a| a > 0.0 && a <= 1.0));
            }
        }
    }

    #[test]
    fn all_pixels_together_have_the_rectangle_s_area_whatever_the_dashes(
        a in (40.0..60.0f64, 40.0..60.0f64), b in (40.0..60.0f64, 40.0..60.0f64), width in 0.05..9.0f64, pattern: u16
    ) {
        let ends = [[a.0, a.1], [b.0, b.1]];
        let window = Window { columns: 0..100, rows: 0..100 };
        let sum = |pattern: u16| -> f64 {
            let style = smooth(width, Stipple { pattern, factor: 1 });
            fragments(ends, &style, 0, &window).iter().map(|f| f.coverage).sum()
        };
        let length = ((b.0 - a.0) * (b.0 - a.0) + (b.1 - a.1) * (b.1 - a.1)).sqrt();
        prop_assert!((sum(0xffff) - length * width).abs() < 1e-10);
        prop_assert!((sum(pattern) + sum(!pattern) - length * width).abs() < 1e-10);
    }

    #[test]
    fn windows_cut_an_anti_aliased_line_and_change_no_coverage(
        a in (-300.0..300.0f64, -300.0..300.0f64), b in (-30.0..30.0f64, -30.0..30.0f64), x in 0..10usize, y in 0..10usize
    ) {
        let ends = [[a.0, a.1], [b.0, b.1]];
        let style = smooth(2.5, Stipple { pattern: 0x0ff3, factor: 3 });
        let mut parts = Vec::new();
        for columns in [0..x, x..SIZE] {
            for rows in [0..y, y..SIZE] {
                parts.extend(fragments(ends, &style, 7, &Window { columns: columns.clone(), rows }));
            }
        }
        prop_assert_eq!(coverage(&parts), coverage(&fragments(ends, &style, 7, &picture())));
    }
}

#[test]
fn a_line_of_one_pixel_s_width_covers_what_one_sees_at_once() {
    let found = |ends: Ends| -> Vec<_> {
        let all = fragments(ends, &smooth(1.0, Stipple::SOLID), 0, &picture());
        all.iter().map(|f| (f.column, f.row, f.coverage)).collect()
    };
    assert_eq!(found([[1.0, 2.5], [3.0, 2.5]]), [(1, 2, 1.0), (2, 2, 1.0)]);
    assert_eq!(found([[1.0, 2.25], [2.0, 2.25]]), [(1, 1, 0.25), (1, 2, 0.75)]);
    assert_eq!(found([[4.5, 3.5], [4.5, 2.0]]), [(4, 2, 1.0), (4, 3, 0.5)]);
    assert_eq!(found([[4.5, 3.5], [4.5, 3.5]]), []);
}

#[test]
fn the_longest_lines_that_the_guard_band_leaves_have_their_coverage() {
    let all = fragments([[-65_536.0, 4.25], [65_536.0, 4.25]], &smooth(1.0, Stipple::SOLID), 0, &picture());
    assert_eq!(all.len(), 20);
    for f in all {
        let expected = if f.row == 3 { 0.25 } else { 0.75 };
        assert!((f.coverage - expected).abs() < 1e-9, "{f:?}");
    }
}
