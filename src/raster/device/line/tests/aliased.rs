use super::drawing::{Ends, SIZE, aliased, fragments, line, picture, pixels, plain};
use super::specification;
use crate::raster::device::{LineStyle, Stipple, Window};
use crate::scene::Device;
use proptest::prelude::*;
use std::collections::BTreeSet;

/// Places at which diamonds touch, places beside those by the last digit, multiples of a device's step, and any.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => (-4..24i32).prop_map(|k| f64::from(k) / 2.0),
        3 => (-8..48i32).prop_map(|k| f64::from(k) / 4.0),
        2 => (-8..48i32, any::<bool>()).prop_map(|(k, is_up)| {
            let at = f64::from(k) / 4.0;
            if at == 0.0 { f64::EPSILON } else if is_up { at.next_up() } else { at.next_down() }
        }),
        2 => (-512..3072i32).prop_map(|k| f64::from(k) / 256.0),
        1 => -2.0..12.0f64,
    ]
}

/// Any segments, level, upright and diagonal ones, and ones shorter than a pixel.
fn ends() -> impl Strategy<Value = Ends> {
    let place = || (coordinate(), coordinate()).prop_map(|(x, y)| [x, y]);
    let kinds = (place(), place(), 0..6u8, -1.0..1.0f64);
    kinds.prop_map(|(a, b, kind, small)| {
        let to = match kind {
            0 => [b[0], a[1]],
            1 => [a[0], b[1]],
            2 => [b[0], a[1] + (b[0] - a[0])],
            3 => [b[0], a[1] - (b[0] - a[0])],
            4 => [a[0] + (small * 8.0).round() / 8.0, a[1] + (b[1] - a[1]) / 16.0],
            _ => b,
        };
        [a, to]
    })
}

fn set(pixels: impl IntoIterator<Item = [usize; 2]>) -> BTreeSet<[usize; 2]> {
    pixels.into_iter().collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn the_fragments_are_those_whose_diamond_the_line_leaves(ends in ends()) {
        let drawn = pixels(ends, &plain());
        prop_assert_eq!(set(drawn.iter().copied()), specification::fragments(ends, 1));
        prop_assert_eq!(set(drawn.iter().copied()).len(), drawn.len(), "one is drawn twice");
    }

    #[test]
    fn a_wide_line_is_replicated_from_the_moved_line_s_lowest_fragment_on(ends in ends(), width in 2..6i64) {
        let drawn = pixels(ends, &aliased(width as f64, Stipple::SOLID));
        prop_assert_eq!(set(drawn.iter().copied()), specification::fragments(ends, width));
        prop_assert_eq!(set(drawn.iter().copied()).len(), drawn.len(), "one is drawn twice");
    }

    #[test]
    fn fragments_come_in_order_from_the_start(ends in ends()) {
        let [a, b] = ends;
        let drawn = pixels(ends, &plain());
        let along = |p: &[usize; 2]| {
            let [x, y] = [0, 1].map(|k| (p[k] as f64 - a[k]) * (b[k] - a[k]));
            x + y
        };
        prop_assert!(drawn.is_sorted_by(|p, q| along(p) < along(q)), "{:?}", drawn);
    }

    #[test]
    fn windows_cut_what_is_drawn_and_change_nothing_else(ends in ends(), width in 1..4u8, x in 0..10usize, y in 0..10usize) {
        let style = aliased(f64::from(width), Stipple { pattern: 0x5a3c, factor: 2 });
        let whole = fragments(ends, &style, 5, &picture());
        let mut parts = Vec::new();
        for columns in [0..x, x..SIZE] {
            for rows in [0..y, y..SIZE] {
                let window = Window { columns: columns.clone(), rows };
                let part = fragments(ends, &style, 5, &window);
                let reached = line::<f64>(ends).window(&style, &window);
                let is_reached = |f: &crate::raster::device::Fragment| {
                    reached.as_ref().is_some_and(|w| w.columns.contains(&f.column) && w.rows.contains(&f.row))
                };
                prop_assert!(part.iter().all(is_reached), "{:?} {:?}", part, reached);
                parts.extend(part);
            }
        }
        let sorted = |mut all: Vec<crate::raster::device::Fragment>| {
            all.sort_by_key(|f| (f.column, f.row));
            all
        };
        prop_assert_eq!(sorted(parts), sorted(whole));
    }

    #[test]
    fn single_precision_has_the_fragments_of_its_own_ends(ends in ends()) {
        let rounded = ends.map(|end| end.map(|v| f64::from(v as f32)));
        let mut drawn = Vec::new();
        line::<f32>(ends).draw(&plain(), 0, &picture(), &mut |f| drawn.push([f.column, f.row]));
        prop_assert_eq!(drawn, pixels(rounded, &plain()));
    }

    #[test]
    fn parts_of_a_straight_line_draw_each_of_its_fragments_once(
        a in (-32..192i32, -32..192i32), step in (-40..40i32, -40..40i32), count in 1..7i32
    ) {
        // Multiples of a 16th: the vertices between lie on the line exactly.
        let at = |k: i32| [a.0 + k * step.0, a.1 + k * step.1].map(|v| f64::from(v) / 16.0);
        let parts = (0..count).flat_map(|k| pixels([at(k), at(k + 1)], &plain()));
        prop_assert_eq!(parts.collect::<Vec<_>>(), pixels([at(0), at(count)], &plain()));
    }

    #[test]
    fn a_line_that_bends_but_keeps_its_octant_has_one_fragment_in_each_column(
        start in (coordinate(), coordinate()),
        steps in prop::collection::vec((0.0..4.0f64, -1.0..1.0f64), 1..9),
        turn in 0..4u8
    ) {
        let turned = |[x, y]: [f64; 2]| match turn {
            0 => [x, y],
            1 => [-x, y],
            2 => [y, x],
            _ => [y, -x],
        };
        let mut vertices = vec![[start.0, start.1]];
        for (dx, slope) in steps {
            let [x, y] = vertices[vertices.len() - 1];
            vertices.push([x + dx, y + dx * slope]);
        }
        // Far from the borders, whichever way it runs.
        let far = |p: [f64; 2]| turned(p).map(|v| v + 64.0);
        let window = Window { columns: 0..200, rows: 0..200 };
        let strip = vertices.windows(2).flat_map(|pair| {
            fragments([far(pair[0]), far(pair[1])], &plain(), 0, &window)
        });
        let columns: Vec<usize> = strip.map(|f| if turn < 2 { f.column } else { f.row }).collect();
        let is_next = |pair: &[usize]| if turn % 2 == 1 { pair[0] == pair[1] + 1 } else { pair[1] == pair[0] + 1 };
        prop_assert!(columns.windows(2).all(is_next), "{:?}", columns);
        let [first, last] = [vertices[0], vertices[vertices.len() - 1]].map(|p| p[0]);
        prop_assert!((columns.len() as f64 - (last - first)).abs() <= 1.5);
    }

    #[test]
    fn a_line_without_ties_draws_the_same_in_all_octants(
        a in (0.0..10.0f64, 0.0..10.0f64), b in (0.0..10.0f64, 0.0..10.0f64)
    ) {
        // (Numbers of 53 random bits.)
        let size = SIZE as f64;
        let (last, ends) = (SIZE - 1, [[a.0, a.1], [b.0, b.1]]);
        let drawn = |of: &dyn Fn([f64; 2]) -> [f64; 2], back: &dyn Fn([usize; 2]) -> [usize; 2]| {
            pixels(ends.map(of), &plain()).into_iter().map(back).collect::<Vec<_>>()
        };
        let plain = drawn(&|p| p, &|p| p);
        prop_assert_eq!(&drawn(&|[x, y]| [y, x], &|[x, y]| [y, x]), &plain);
        prop_assert_eq!(&drawn(&|[x, y]| [size - x, y], &|[x, y]| [last - x, y]), &plain);
        prop_assert_eq!(&drawn(&|[x, y]| [x, size - y], &|[x, y]| [x, last - y]), &plain);
    }
}

#[test]
fn a_line_between_centres_is_bresenham_s_without_its_last_pixel() {
    let row =
        |columns: std::ops::Range<usize>, row: usize| columns.map(move |c| [c, row]).collect::<Vec<_>>();
    assert_eq!(pixels([[1.5, 2.5], [5.5, 2.5]], &plain()), row(1..5, 2));
    assert_eq!(pixels([[1.5, 1.5], [4.5, 4.5]], &plain()), [[1, 1], [2, 2], [3, 3]]);
    assert_eq!(pixels([[2.5, 5.5], [2.5, 2.5]], &plain()), [[2, 5], [2, 4], [2, 3]]);
    // Half a pixel in y for each in x: at the tips between rows the slope decides.
    assert_eq!(pixels([[0.5, 0.5], [4.5, 2.5]], &plain()), [[0, 0], [1, 1], [2, 1], [3, 2]]);
    assert_eq!(pixels([[0.5, 2.5], [4.5, 0.5]], &plain()), [[0, 2], [1, 1], [2, 1], [3, 0]]);
}

#[test]
fn what_leaves_no_diamond_draws_nothing() {
    for at in [[2.5, 2.5], [2.0, 2.5], [2.0, 2.0], [3.0, 2.5], [2.25, 2.25], [2.5, 3.0]] {
        assert!(pixels([at, at], &plain()).is_empty(), "no length, at {at:?}");
    }
    assert!(pixels([[2.3, 2.6], [2.7, 2.45]], &plain()).is_empty(), "within a diamond");
    assert!(pixels([[1.9, 1.9], [2.1, 2.05]], &plain()).is_empty(), "between the diamonds");
}

#[test]
fn a_line_along_the_tips_has_one_row_or_column() {
    // A level line goes down, an upright one to the left.
    assert_eq!(pixels([[1.0, 3.0], [4.0, 3.0]], &plain()), [[1, 3], [2, 3], [3, 3]]);
    assert_eq!(pixels([[3.0, 1.0], [3.0, 4.0]], &plain()), [[2, 1], [2, 2], [2, 3]]);
}

#[test]
fn a_strip_that_turns_between_the_diamonds_may_come_back_into_one() {
    // The rule's own: both parts leave the diamond of (2, 2).
    let strip = [[[1.75, 2.25], [2.875, 2.25]], [[2.875, 2.25], [3.0, 4.0]]];
    assert_eq!(strip.map(|part| pixels(part, &plain())), [vec![[1, 2], [2, 2]], vec![[2, 2], [2, 3]]]);
}

#[test]
fn widths_are_rounded_and_end_where_the_device_s_do() {
    let device = Device { max_line_width_px: 3.4, ..Device::default() };
    for (width, rows) in [(0.2, 1), (1.4, 1), (1.5, 2), (2.5, 3), (3.4, 3), (9.0, 3)] {
        let style = LineStyle::new(width, Stipple::SOLID, false, &device);
        assert_eq!(pixels([[2.5, 5.5], [3.5, 5.5]], &style).len(), rows, "{width}");
    }
}

#[test]
fn depth_is_that_of_the_centre_projected_on_the_line() {
    // From 0.25 to 0.75 over 5 pixels' length in the direction (4, 3): 0.1 a pixel.
    let all = fragments([[1.5, 1.5], [5.5, 4.5]], &plain(), 0, &picture());
    for f in &all {
        let along = ((f.column as f64 - 1.0) * 4.0 + (f.row as f64 - 1.0) * 3.0) / 5.0;
        assert!((f.depth - (0.25 + 0.1 * along)).abs() < 1e-15, "{f:?}");
    }
    assert_eq!(all.len(), 4);
    // Replicated fragments have their own centres' depths: three pixels down are 3 * 3 / 5 along.
    let wide = fragments([[1.5, 1.5], [5.5, 4.5]], &aliased(4.0, Stipple::SOLID), 0, &picture());
    let in_column: Vec<_> = wide.iter().filter(|f| f.column == 3).collect();
    assert!((in_column[3].depth - in_column[0].depth - 0.18).abs() < 1e-15);
    // A centre that lies before the start has a depth before it: 0.25 px of 0.125 a pixel.
    let level = fragments([[2.25, 2.5], [6.25, 2.5]], &plain(), 0, &picture());
    assert_eq!((level[0].column, level[0].depth), (2, 0.25 + 0.125 * 0.25));
    let late = fragments([[2.75, 2.5], [6.75, 2.5]], &plain(), 0, &picture());
    assert_eq!((late[0].column, late[0].depth), (2, 0.25 - 0.125 * 0.25));
}

#[test]
fn rounding_decides_no_tie() {
    // 49 * (1 / 49) is below 1 in doubles: but the line goes through the tip between the rows, and down.
    let window = Window { columns: 0..100, rows: 0..3 };
    let row_at = |ends: Ends| {
        let all = fragments(ends, &plain(), 0, &window);
        all.iter().find(|f| f.column == 49).unwrap().row
    };
    assert_eq!(row_at([[0.5, 0.0], [98.5, 2.0]]), 1);
    assert_eq!(row_at([[98.5, 0.0], [0.5, 2.0]]), 0, "upwards it goes above");
}

#[test]
fn the_longest_lines_that_the_guard_band_leaves_are_decided_exactly() {
    // From far left to far right through the tip between rows 3 and 4 at column 5, or beside it by less than single precision sees.
    let ends = |hair: f64| [[-65_530.5, 4.0 - 65_536.0 / 65_536.0 + hair], [65_541.5, 5.0 + hair]];
    let row_at = |hair: f64| pixels(ends(hair), &plain()).into_iter().find(|p| p[0] == 5).unwrap()[1];
    assert_eq!([row_at(0.0), row_at(1e-12), row_at(-1e-12)], [4, 4, 3]);
}
