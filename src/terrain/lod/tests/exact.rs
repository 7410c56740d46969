//! Errors against exact arithmetic: heights are whole multiples of a power of two.

use super::super::deviation::{Slope, Window, deviation};
use super::super::errors::Errors;
use super::super::extent::Extent;
use super::super::places::{Heights, Places};
use super::super::tile::{MIXED, Measure, NOTHING, rounded_up};
use super::{Dice, for_each_below, globe, grid, hills, posts_in, with_holes};
use crate::math;
use crate::scene::{Diagonal, Posts};
use crate::space::Plan;
use crate::terrain::lod::{Post, RightTriangle};
use crate::terrain::{Grid, Lattice};
use glam::DVec2;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Heights are multiples of 2^-32 metres: all 53 bits of a double are used, and sums of them round.
const UNIT: f64 = 1.0 / 4_294_967_296.0;

/// A grid of whole numbers, `None`: no data.
struct Whole {
    columns: u32,
    rows: u32,
    heights: Vec<Option<i64>>,
}

impl Whole {
    fn new(columns: u32, rows: u32, height: &mut dyn FnMut(Post) -> Option<i64>) -> Self {
        let heights = (0..columns * rows).map(|k| height([k % columns, k / columns])).collect();
        Self { columns, rows, heights }
    }

    fn at(&self, [i, j]: Post) -> Option<i64> {
        (i < self.columns && j < self.rows).then(|| self.heights[(j * self.columns + i) as usize])?
    }

    fn posts(&self) -> Posts {
        let metres = self.heights.iter().map(|height| height.map_or(f64::NAN, |whole| whole as f64 * UNIT));
        let size = (self.columns as usize, self.rows as usize);
        Posts::new(size, Plan::default(), (DVec2::X, DVec2::Y), metres.collect()).unwrap()
    }

    /// Twice the triangle's area in cells, and the largest distance of a post in it times that, in units; `None` where a post is missing.
    fn deviation(&self, triangle: &RightTriangle) -> Option<(i128, i128)> {
        let cross = |a: [i128; 2], b: [i128; 2], p: [i128; 2]| {
            (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
        };
        let corners = triangle.corners();
        let [a, b, c] = corners.map(|post| post.map(i128::from));
        let [za, zb, zc] = corners.map(|post| self.at(post).map(i128::from));
        let area = cross(a, b, c);
        let mut most = 0;
        for post in posts_in(triangle) {
            let (height, p) = (i128::from(self.at(post)?), post.map(i128::from));
            let plane = zc? * cross(a, b, p) + za? * cross(b, c, p) + zb? * cross(c, a, p);
            most = most.max((plane - height * area).abs());
        }
        Some((area, most))
    }

    fn has_some(&self, triangle: &RightTriangle) -> bool {
        posts_in(triangle).into_iter().any(|post| self.at(post).is_some())
    }
}

/// Checks what is stored of triangles from a layer on: the exact largest distances of themselves and of all below them. How many have a distance, are
/// mixed, and have no post.
fn check(whole: &Whole, least: u32) -> [usize; 3] {
    let lattice = Lattice::Plane(Arc::new(Grid::new(whole.posts(), Diagonal::Alternating).unwrap()));
    let heights = whole.heights.iter().flatten().map(|whole| *whole as f64 * UNIT);
    let largest = heights.map(f64::abs).fold(0.0, math::max);
    let (errors, extent) = (Errors::new(&lattice), Extent::of(&lattice));
    let errors = errors.in_view();
    let mut exact: BTreeMap<RightTriangle, f64> = BTreeMap::new();
    let mut all = Vec::new();
    for root in extent.root().roots() {
        for_each_below(root, &mut |triangle| {
            if triangle.layer() >= least && extent.holds(triangle) {
                all.push(*triangle);
            }
        });
    }
    all.sort_by_key(RightTriangle::layer);
    let mut seen = [0; 3];
    for triangle in all {
        let stored = errors.of(&triangle);
        let Some((area, most)) = whole.deviation(&triangle) else {
            let (kind, expected) = if whole.has_some(&triangle) { (1, MIXED) } else { (2, NOTHING) };
            assert_eq!(stored, expected, "{triangle:?}");
            seen[kind] += 1;
            continue;
        };
        let halves = triangle.halves().into_iter().flatten();
        let below = halves.filter(|half| half.layer() > 0);
        let below = below.map(|half| exact.get(&half).copied().unwrap_or_else(|| errors.of(&half).into()));
        let below = below.fold(0.0, math::max);
        // An exact quotient by a power of two, rounded once.
        let own = most as f64 / area as f64 * UNIT;
        let error = math::max(own, below);
        exact.insert(triangle, error);
        let scaled = f64::from(stored) / UNIT * area as f64;
        assert!(stored.is_finite() && scaled as i128 >= most, "{triangle:?}: {stored} < {own}");
        assert!(f64::from(stored) >= error, "{triangle:?}: {stored} < {error} of what is below");
        let most_stored = error * (1.0 + f64::from(f32::EPSILON)) + 64.0 * f64::EPSILON * largest;
        assert!(f64::from(stored) <= most_stored, "{triangle:?}: {stored} > {error}");
        seen[0] += 1;
    }
    seen
}

#[test]
fn an_error_is_the_largest_distance_of_a_post_from_the_triangle_or_what_it_is_split_into_rounded_up() {
    let mut dice = Dice(1);
    for (columns, rows) in [(17, 17), (25, 20), (5, 40)] {
        let mut height = |_: Post| Some(dice.below(1 << 45) as i64 - (1 << 44));
        let seen = check(&Whole::new(columns, rows, &mut height), 1);
        assert!(seen[0] > 100 && seen[1] > 0, "{seen:?}");
    }
}

#[test]
fn triangles_larger_than_a_quad_have_exact_errors_too() {
    let mut dice = Dice(2);
    let seen = check(&Whole::new(257, 257, &mut |_| Some(dice.below(1 << 44) as i64)), 14);
    assert_eq!(seen, [14, 0, 0], "8 halves of quads, 4 quarters and 2 halves of the largest square");
}

#[test]
fn a_triangle_with_a_missing_post_is_mixed_and_one_without_any_is_nothing() {
    let mut dice = Dice(3);
    let mut height = |[i, j]: Post| {
        let is_hole = dice.below(40) == 0 || (20..30).contains(&i) && (3..19).contains(&j);
        (!is_hole).then(|| dice.below(1 << 40) as i64)
    };
    let seen = check(&Whole::new(50, 34, &mut height), 1);
    assert!(seen.iter().all(|count| *count > 20), "{seen:?}");
}

/// The errors of all triangles, each post looked at, and how far roundings may take them.
fn of_measure(measure: &impl Measure, extent: Extent) -> (BTreeMap<RightTriangle, f32>, f64) {
    let window =
        Window::new([[0, 0], extent.last], Vec::new(), |row, ends, to| measure.append(row, ends, to));
    let mut all = Vec::new();
    for root in extent.root().roots() {
        for_each_below(root, &mut |triangle| {
            if triangle.layer() > 0 && extent.holds(triangle) {
                all.push(*triangle);
            }
        });
    }
    all.sort_by_key(RightTriangle::layer);
    let mut errors = BTreeMap::new();
    for triangle in all {
        let corners = triangle.corners();
        let is_inside = corners.iter().all(|post| window.contains(*post));
        let at = corners.map(|post| measure.at(post));
        let slope = is_inside.then(|| Slope::of(&triangle, at));
        let mut found = deviation(&window, &triangle, slope.as_ref());
        if is_inside {
            found.most = math::max(found.most, measure.least(&triangle, at));
        }
        let own = rounded_up(found, measure.slack());
        let below = triangle.halves().into_iter().flatten().filter_map(|half| errors.get(&half).copied());
        errors.insert(triangle, below.fold(own, math::max_f32));
    }
    (errors, measure.slack())
}

#[test]
fn what_is_found_by_a_search_and_tile_by_tile_is_what_looking_at_every_post_finds() {
    let level = |_: u32, _: u32| 7.25;
    let slope = |i: u32, j: u32| 0.1 * f64::from(i) - 0.7 * f64::from(j);
    let steps = |i: u32, j: u32| f64::from((i / 30) * (j / 17) % 5);
    let around =
        |height: &dyn Fn(u32, u32) -> f64| Lattice::Globe(globe::world([256, 149], 1.0, height, true));
    let lattices = [
        grid(257, 257, hills),
        grid(257, 257, steps),
        grid(140, 131, level),
        grid(140, 131, slope),
        grid(300, 140, with_holes),
        around(&hills),
        around(&with_holes),
    ];
    for lattice in lattices {
        let extent = Extent::of(&lattice);
        let (expected, slack) = match &lattice {
            Lattice::Plane(grid) => of_measure(&Heights::new(grid), extent),
            Lattice::Globe(globe) => of_measure(&Places::new(globe), extent),
        };
        // But for roundings.
        let is_as_expected = |found: f32, expected: f32| {
            found == expected
                || f64::from((found - expected).abs()) <= 4.0 * slack + 3e-7 * f64::from(expected)
        };
        // With all tiles kept, and none but those that were looked into.
        for most_kept in [100, 0] {
            let errors = Errors::keeping(&lattice, most_kept);
            for _ in 0..2 {
                let errors = errors.in_view();
                for (triangle, error) in &expected {
                    let found = errors.of(triangle);
                    assert!(is_as_expected(found, *error), "{triangle:?}: {found} {error}");
                }
                errors.keep();
            }
        }
    }
}
