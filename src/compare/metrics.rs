//! The numbers of a comparison.

use super::difference::{Difference, is_over};
use super::image::{Samples, ValuePlace};
use crate::math;

/// The side of the window in which failing pixels are counted.
pub const WINDOW: usize = 16;

/// One step of an 8-bit code.
const ONE_CODE_VALUE: f64 = 1.0 / 255.0;

/// How far a picture is from what is expected. Distances are in units of 1; values are those of all channels, alpha too.
#[derive(Debug, Clone, PartialEq)]
pub struct Metrics {
    /// The largest distance.
    pub max: f64,
    /// The first value that has it, where it is not 0.
    pub worst: Option<ValuePlace>,
    /// The mean over all values.
    pub mean: f64,
    /// The root of the mean square over all values.
    pub rmse: f64,
    /// What 99 of 100 values do not exceed.
    pub p99: f64,
    /// The largest distance of each channel.
    pub channel_max: Vec<f64>,
    /// The share (0..=1) of pixels with a value off by more than 1/255.
    pub over_one_code_value: f64,
    /// The number of pixels with a value over the tolerance.
    pub failing: usize,
    /// Where most of them are.
    pub densest: Option<Window>,
}

/// A window of [`WINDOW`] x [`WINDOW`] pixels, or of the whole picture's width or height where that is less.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub struct Window {
    /// Its first column.
    pub x: usize,
    /// Its first row.
    pub y: usize,
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// The failing pixels in it.
    pub failing: usize,
}

impl Metrics {
    /// Those of a picture whose failing pixels are known, by their distances: all others are as expected. `pixels` is how many there are,
    /// `width` how many in a row, `densest` where most fail.
    pub(super) fn of_few<const N: usize>(
        failing: &[(usize, [f64; N])],
        (pixels, width): (usize, usize),
        densest: Option<Window>,
    ) -> Self {
        let mut channel_max = vec![0.0; N];
        let (mut max, mut worst, mut over_one) = (0.0, None, 0);
        for (pixel, distances) in failing {
            let mut largest = 0.0;
            for (channel, distance) in distances.iter().copied().enumerate() {
                if distance > max {
                    max = distance;
                    worst = Some(ValuePlace { x: pixel % width, y: pixel / width, channel });
                }
                channel_max[channel] = math::max(channel_max[channel], distance);
                largest = math::max(largest, distance);
            }
            over_one += usize::from(is_over(largest, ONE_CODE_VALUE));
        }
        let values = || failing.iter().flat_map(|(_, distances)| distances).copied();
        let n = pixels * N;
        // A sum of nothing is -0 to the standard library.
        let sum = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |sum, value| sum + value);
        Self {
            max,
            worst,
            mean: sum(&mut values()) / n as f64,
            rmse: (sum(&mut values().map(|d| d * d)) / n as f64).sqrt(),
            p99: p99(values().filter(|d| *d > 0.0).collect(), n),
            channel_max,
            over_one_code_value: over_one as f64 / pixels as f64,
            failing: failing.len(),
            densest,
        }
    }
}

impl Difference {
    /// The numbers of the comparison. A pixel fails when one of its values is over the tolerance.
    pub fn metrics(&self, tolerance: f64) -> Metrics {
        let distances = self.distances();
        let (channels, n) = (distances.channels(), distances.values().len());
        let (channel_max, Sums { mean, rmse, p99 }) = match distances.samples() {
            Samples::Codes8(codes) => (channel_max(codes, channels, 255.0), Sums::of_codes::<256, _>(codes)),
            Samples::Codes16(codes) => {
                (channel_max(codes, channels, 65535.0), Sums::of_codes::<65536, _>(codes))
            }
            Samples::Reals(values) => (channel_max(values, channels, 1.0), Sums::of_reals(values)),
        };
        let max = channel_max.iter().copied().fold(0.0, math::max);
        let worst = if max > 0.0 { distances.values().position(|d| d == max) } else { None };
        let over_one = self.of_pixels(|d| is_over(d, ONE_CODE_VALUE));
        let failing = self.of_pixels(|d| is_over(d, tolerance));
        let count = |which: &[bool]| which.iter().filter(|is_meant| **is_meant).count();
        Metrics {
            max,
            worst: worst.map(|index| distances.place(index)),
            mean,
            rmse,
            p99,
            channel_max,
            over_one_code_value: count(&over_one) as f64 / (n / channels) as f64,
            failing: count(&failing),
            densest: densest(&failing, distances.width(), distances.height()),
        }
    }

    /// The windows with most failing pixels ([`windows`]).
    pub(super) fn windows(&self, tolerance: f64) -> Vec<Window> {
        let failing = self.of_pixels(|d| is_over(d, tolerance));
        windows(failing, self.distances().width(), self.distances().height())
    }
}

/// The numbers that all values have a part in.
struct Sums {
    mean: f64,
    rmse: f64,
    p99: f64,
}

impl Sums {
    fn of_reals(values: &[f64]) -> Self {
        let n = values.len() as f64;
        Self {
            mean: values.iter().sum::<f64>() / n,
            rmse: (values.iter().map(|d| d * d).sum::<f64>() / n).sqrt(),
            p99: p99(values.iter().copied().filter(|d| *d > 0.0).collect(), values.len()),
        }
    }

    /// Of codes of which there are so many, by how often each occurs: sums of whole numbers are exact.
    fn of_codes<const CODES: usize, T: Copy + Into<usize>>(codes: &[T]) -> Self {
        // As a rule neighbours are equal: counted in one place, each would wait for the one before it.
        let mut counts = vec![[0_u64; 4]; CODES];
        let (fours, rest) = codes.as_chunks::<4>();
        for four in fours {
            (0..4).for_each(|k| counts[four[k].into()][k] += 1);
        }
        rest.iter().for_each(|code| counts[(*code).into()][0] += 1);
        let counts: Vec<u64> = counts.iter().map(|four| four.iter().sum()).collect();
        let sum =
            |power: u32| (0..).zip(&counts).map(|(code, count)| count * u64::pow(code, power)).sum::<u64>();
        let (one, n) = ((CODES - 1) as f64, codes.len() as f64);
        let mut left = (codes.len() * 99).div_ceil(100) as u64;
        let p99 = counts.iter().take_while(|count| {
            let is_below = **count < left;
            left = left.saturating_sub(**count);
            is_below
        });
        Self {
            p99: p99.count() as f64 / one,
            mean: sum(1) as f64 / n / one,
            rmse: (sum(2) as f64 / n).sqrt() / one,
        }
    }
}

/// The windows with most failing pixels, none of which counts a pixel of another; most first, a few at most.
pub(super) fn windows(mut failing: Vec<bool>, width: usize, height: usize) -> Vec<Window> {
    const MOST: usize = 8;
    let mut windows = Vec::new();
    while windows.len() < MOST {
        let Some(window) = densest(&failing, width, height) else { break };
        for y in window.y..window.y + window.height {
            failing[y * width + window.x..][..window.width].fill(false);
        }
        windows.push(window);
    }
    windows
}

/// The largest distance of each channel, of values in parts of `one`.
fn channel_max<T: Copy + PartialOrd + Default + Into<f64>>(
    values: &[T],
    channels: usize,
    one: f64,
) -> Vec<f64> {
    let mut most = vec![T::default(); channels];
    for pixel in values.chunks_exact(channels) {
        most.iter_mut().zip(pixel).for_each(|(most, d)| *most = if *d > *most { *d } else { *most });
    }
    most.into_iter().map(|most| most.into() / one).collect()
}

/// The smallest value that at least 99 of 100 of `n` values do not exceed; `off` are those that are not 0.
fn p99(mut off: Vec<f64>, n: usize) -> f64 {
    let rank = (n * 99).div_ceil(100);
    match rank.checked_sub(n - off.len() + 1) {
        Some(among_off) => *off.select_nth_unstable_by(among_off, f64::total_cmp).1,
        None => 0.0,
    }
}

/// The window with most failing pixels, the uppermost and then leftmost of several.
pub(super) fn densest(failing: &[bool], width: usize, height: usize) -> Option<Window> {
    let (columns, rows) = (WINDOW.min(width), WINDOW.min(height));
    // Failing pixels of each column in the window's rows: a row enters below, another leaves above.
    let mut in_column = vec![0; width];
    let mut best: Option<Window> = None;
    for bottom in 0..height {
        for (x, count) in in_column.iter_mut().enumerate() {
            *count += usize::from(failing[bottom * width + x]);
            if bottom >= rows {
                *count -= usize::from(failing[(bottom - rows) * width + x]);
            }
        }
        let Some(y) = (bottom + 1).checked_sub(rows) else { continue };
        let mut count: usize = in_column[..columns].iter().sum();
        for x in 0..=width - columns {
            if x > 0 {
                count = count + in_column[x + columns - 1] - in_column[x - 1];
            }
            if count > best.map_or(0, |best| best.failing) {
                best = Some(Window { x, y, width: columns, height: rows, failing: count });
            }
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::{Expected, Image};

    /// The metrics of a picture of these values against black.
    fn of(width: usize, height: usize, channels: usize, values: Vec<f64>, tolerance: f64) -> Metrics {
        let black = Image::new(width, height, channels, vec![0.0; values.len()]).unwrap();
        let actual = Image::new(width, height, channels, values).unwrap();
        Difference::of(&Expected::exactly(black), &actual).unwrap().metrics(tolerance)
    }

    #[test]
    fn an_equal_picture_has_no_distance_and_no_worst_pixel() {
        let metrics = of(3, 2, 4, vec![0.0; 24], 0.0);
        assert_eq!((metrics.max, metrics.mean, metrics.rmse, metrics.p99), (0.0, 0.0, 0.0, 0.0));
        assert_eq!((metrics.worst, metrics.failing, metrics.densest), (None, 0, None));
    }

    #[test]
    fn without_failing_pixels_all_numbers_are_0_and_none_is_below() {
        let metrics = Metrics::of_few::<4>(&[], (6, 3), None);
        assert_eq!(metrics, of(3, 2, 4, vec![0.0; 24], 0.0));
        assert!(metrics.mean.is_sign_positive() && metrics.rmse.is_sign_positive());
    }

    #[test]
    fn the_worst_value_is_told_with_its_pixel_and_channel() {
        let mut values = vec![0.0; 2 * 3 * 4];
        values[(2 * 2 + 1) * 4 + 3] = 0.5;
        values[4] = 0.25;
        let metrics = of(2, 3, 4, values, 0.25);
        assert_eq!(metrics.worst, Some(ValuePlace { x: 1, y: 2, channel: 3 }));
        assert_eq!((metrics.max, metrics.mean), (0.5, 0.75 / 24.0));
        assert_eq!(metrics.rmse, (0.3125_f64 / 24.0).sqrt());
        assert_eq!(metrics.channel_max, [0.25, 0.0, 0.0, 0.5]);
        assert_eq!((metrics.failing, metrics.over_one_code_value), (1, 2.0 / 6.0));
    }

    #[test]
    fn codes_have_the_numbers_of_their_values() {
        let mut state = 7_u32;
        let mut codes = || -> Vec<u8> {
            let mut next = || {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                (state >> 24) as u8 / if state & 0x300 == 0 { 1 } else { 100 }
            };
            (0..40 * 30 * 3).map(|_| next()).collect()
        };
        let (expected, actual) = (codes(), codes());
        let eight = |codes: &[u8]| Image::of(40, 30, 3, Samples::Codes8(codes.to_vec())).unwrap();
        let sixteen = |codes: &[u8]| {
            let codes = codes.iter().map(|code| 257 * u16::from(*code)).collect();
            Image::of(40, 30, 3, Samples::Codes16(codes)).unwrap()
        };
        let reals = |codes: &[u8]| eight(codes).map(|value| value);
        let tolerance = 20.0 / 255.0;
        let on = |expected: Image, actual: Image| {
            Difference::of(&Expected::exactly(expected), &actual).unwrap().metrics(tolerance)
        };
        let of_codes = on(eight(&expected), eight(&actual));
        assert_eq!(of_codes, on(sixteen(&expected), eight(&actual)));
        let of_reals = on(reals(&expected), eight(&actual));
        assert_eq!((of_codes.failing, of_codes.densest), (of_reals.failing, of_reals.densest));
        assert_eq!(of_codes.over_one_code_value, of_reals.over_one_code_value);
        assert!(of_codes.p99 > 0.0 && of_codes.p99 < of_codes.max);
        let numbers = |m: &Metrics| [&[m.max, m.mean, m.rmse, m.p99][..], &m.channel_max].concat();
        for (code, real) in numbers(&of_codes).into_iter().zip(numbers(&of_reals)) {
            assert!((code - real).abs() < 1e-14, "{code} is not {real}");
        }
    }

    #[test]
    fn the_99th_percentile_is_what_one_value_of_a_hundred_exceeds() {
        let values = |n: usize| (1..=n).map(|v| v as f64).collect::<Vec<_>>();
        assert_eq!(p99(values(100), 100), 99.0);
        assert_eq!(p99(values(1000), 1000), 990.0);
        assert_eq!(p99(values(101), 101), 100.0);
        assert_eq!(p99(values(1), 1), 1.0);
        assert_eq!((p99(vec![0.5; 1], 100), p99(vec![0.5; 2], 100)), (0.0, 0.5));
    }

    #[test]
    fn the_densest_window_is_that_of_every_place() {
        let (width, height) = (41, 29);
        let mut state = 1_u32;
        let mut failing = vec![false; width * height];
        for pixel in &mut failing {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            *pixel = state >> 30 == 0;
        }
        let mut slow: Option<Window> = None;
        for (y, x) in (0..=height - WINDOW).flat_map(|y| (0..=width - WINDOW).map(move |x| (y, x))) {
            let inside = (0..WINDOW * WINDOW).map(|i| (y + i / WINDOW) * width + x + i % WINDOW);
            let count = inside.filter(|pixel| failing[*pixel]).count();
            if count > slow.map_or(0, |best| best.failing) {
                slow = Some(Window { x, y, width: WINDOW, height: WINDOW, failing: count });
            }
        }
        assert_eq!(densest(&failing, width, height), slow);
    }

    #[test]
    fn the_window_of_a_small_picture_is_the_picture() {
        let metrics = of(3, 2, 1, vec![0.0, 0.5, 0.0, 0.0, 0.0, 1.0], 0.0);
        assert_eq!(metrics.densest, Some(Window { x: 0, y: 0, width: 3, height: 2, failing: 2 }));
    }
}
