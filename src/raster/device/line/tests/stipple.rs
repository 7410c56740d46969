use super::drawing::{Ends, aliased, fragments, line, picture, plain, smooth};
use crate::raster::device::{LineStyle, Stipple};

/// The columns of a level line's fragments from column 0 on.
fn columns(style: &LineStyle, counter: u64) -> Vec<usize> {
    let all = fragments([[0.5, 4.5], [9.5, 4.5]], style, counter, &picture());
    let mut columns: Vec<usize> = all.iter().map(|f| f.column).collect();
    columns.dedup();
    columns
}

#[test]
fn the_lowest_bit_comes_first_and_each_stands_for_a_factor_of_fragments() {
    let style = |pattern: u16, factor: u32| aliased(1.0, Stipple { pattern, factor });
    assert_eq!(columns(&style(0b1011, 1), 0), [0, 1, 3]);
    assert_eq!(columns(&style(0b1011, 2), 0), [0, 1, 2, 3, 6, 7]);
    assert_eq!(columns(&style(0b1011, 0), 0), [0, 1, 3], "a factor below 1 is 1");
    // The counter goes on, and comes round after 16 bits.
    assert_eq!(columns(&style(0b1011, 1), 2), [1]);
    assert_eq!(columns(&style(0b1011, 1), 13), [3, 4, 6]);
    assert_eq!(columns(&style(0b1011, 2), 31), [1, 2, 3, 4, 7, 8]);
    assert_eq!(columns(&style(1, 300), 255), [0], "a factor above 256 is 256");
    assert_eq!(columns(&style(1, 300), 256), [0; 0]);
}

#[test]
fn a_wide_line_s_columns_are_drawn_as_a_whole_or_not_at_all() {
    let style = aliased(3.0, Stipple { pattern: 0b101, factor: 1 });
    let all = fragments([[0.5, 4.5], [9.5, 4.5]], &style, 0, &picture());
    let places: Vec<_> = all.iter().map(|f| (f.column, f.row)).collect();
    assert_eq!(places, [(0, 3), (0, 4), (0, 5), (2, 3), (2, 4), (2, 5)]);
}

#[test]
fn a_strip_that_goes_on_counting_has_the_gaps_of_the_whole_line() {
    let stipple = Stipple { pattern: 0b0110_1011_0010_1101, factor: 1 };
    let style = aliased(1.0, stipple);
    let at = |k: usize| [0.25 + 1.5 * k as f64, 1.75 + k as f64];
    let whole = fragments([at(0), at(6)], &style, 3, &picture());
    let (mut counter, mut strip) = (3, Vec::new());
    for k in 0..6 {
        let part: Ends = [at(k), at(k + 1)];
        strip.extend(fragments(part, &style, counter, &picture()));
        counter += line::<f64>(part).steps(&style);
    }
    let places =
        |all: &[crate::raster::device::Fragment]| all.iter().map(|f| (f.column, f.row)).collect::<Vec<_>>();
    assert_eq!(places(&strip), places(&whole));
    assert_eq!(counter - 3, fragments([at(0), at(6)], &plain(), 0, &picture()).len() as u64);
    assert_ne!(whole.len() as u64, counter - 3, "the pattern has gaps");
}

#[test]
fn what_lies_outside_the_picture_counts() {
    let style = aliased(1.0, Stipple { pattern: 0b1, factor: 1 });
    let columns = |ends: Ends| -> Vec<usize> {
        fragments(ends, &style, 0, &picture()).iter().map(|f| f.column).collect()
    };
    assert_eq!(columns([[-13.5, 2.5], [20.5, 2.5]]), [2]);
    assert_eq!(columns([[20.5, 2.5], [-13.5, 2.5]]), [4]);
    assert_eq!(line::<f64>([[20.5, 2.5], [-13.5, 2.5]]).steps(&style), 34);
    assert_eq!(line::<f64>([[2.5, 2.5], [2.5, 2.5]]).steps(&style), 0);
}

#[test]
fn an_anti_aliased_line_s_dashes_are_as_long_as_pixels() {
    let stipple = Stipple { pattern: 0b1_0110, factor: 1 };
    let ends = [[1.25, 4.5], [8.0, 4.5]];
    let all = fragments(ends, &smooth(1.0, stipple), 0, &picture());
    let found: Vec<_> = all.iter().map(|f| (f.column, f.coverage)).collect();
    // Bits 1 and 2: from 2.25 to 4.25; bit 4: from 5.25 to 6.25.
    assert_eq!(found, [(2, 0.75), (3, 1.0), (4, 0.25), (5, 0.75), (6, 0.25)]);
    assert_eq!(line::<f64>(ends).steps(&smooth(1.0, stipple)), 7, "the last one is shorter");
    // Two dashes in one pixel's square cover it apart.
    let dotted = fragments(
        [[0.5, 4.5], [9.5, 4.5]],
        &smooth(1.0, Stipple { pattern: 0x5555, factor: 1 }),
        0,
        &picture(),
    );
    assert!(dotted.iter().all(|f| f.coverage == 0.5) && dotted.len() == 10);
}
