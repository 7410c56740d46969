//! Logarithmic axes: range, ticks and the words at them.

use crate::math;

/// A logarithmic axis.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct LogAxis {
    low: f64,
    high: f64,
    has_zero: bool,
}

/// A grid line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Tick {
    /// Where.
    pub(super) value: f64,
    /// Whether it has a word.
    pub(super) is_labelled: bool,
    /// Whether it is a power of ten.
    pub(super) is_decade: bool,
}

/// How much farther than its values an axis reaches at least.
const ROOM: f64 = 1.12;

/// The share of an axis that is kept for zeros, which have no logarithm.
const ZERO_BAND: f64 = 0.08;

impl LogAxis {
    /// An axis that holds all values with some room around them; zeros get a place of their own below.
    pub(super) fn around(values: &[f64]) -> Self {
        let positive = || values.iter().copied().filter(|v| *v > 0.0 && v.is_finite());
        let least = positive().fold(f64::INFINITY, math::min);
        let most = positive().fold(0.0, math::max);
        let has_zero = values.contains(&0.0);
        if most == 0.0 {
            return Self { low: 0.1, high: 1.0, has_zero };
        }
        Self { low: round_down(least / ROOM), high: round_up(most * ROOM), has_zero }
    }

    /// The place of a value, 0 to 1.
    pub(super) fn place(&self, value: f64) -> f64 {
        let start = if self.has_zero { ZERO_BAND } else { 0.0 };
        if value <= 0.0 {
            return 0.0;
        }
        let share = math::ln(value / self.low) / math::ln(self.high / self.low);
        start + (1.0 - start) * math::min(math::max(share, 0.0), 1.0)
    }

    /// Whether zeros have a place.
    pub(super) fn has_zero(&self) -> bool {
        self.has_zero
    }

    /// Whether a value lies on the axis.
    pub(super) fn holds(&self, value: f64) -> bool {
        value > self.low && value < self.high
    }

    /// The grid lines: 1 to 9 times each power of ten. Words are at as many of them as stay `room` apart, a share of the axis: at powers of
    /// ten before others, then at 5 and 2 times them.
    pub(super) fn ticks(&self, room: f64) -> Vec<Tick> {
        let decades = exponent_below(self.low)..=exponent_below(self.high);
        let all = decades.flat_map(|exponent| (1..=9).map(move |digit| (digit, decimal(digit, exponent))));
        let all: Vec<(u32, f64)> =
            all.filter(|(_, value)| *value >= self.low && *value <= self.high).collect();
        let mut worded: Vec<f64> = Vec::new();
        for digit in [1, 5, 2, 3, 7, 4, 6, 8, 9] {
            for (_, value) in all.iter().filter(|(of, _)| *of == digit) {
                let is_apart = |other: &f64| (self.place(*value) - self.place(*other)).abs() >= room;
                if worded.iter().all(is_apart) {
                    worded.push(*value);
                }
            }
        }
        let tick =
            |(digit, value)| Tick { value, is_labelled: worded.contains(&value), is_decade: digit == 1 };
        all.into_iter().map(tick).collect()
    }
}

/// `digit` times ten to the power of `exponent`, correctly rounded.
fn decimal(digit: u32, exponent: i32) -> f64 {
    format!("{digit}e{exponent}").parse().unwrap_or(0.0)
}

/// The exponent of the power of ten at or below a positive value.
fn exponent_below(value: f64) -> i32 {
    let mut exponent = (math::ln(value) / std::f64::consts::LN_10).floor() as i32;
    // The quotient of logarithms may be off by a rounding.
    while decimal(1, exponent + 1) <= value {
        exponent += 1;
    }
    while decimal(1, exponent) > value {
        exponent -= 1;
    }
    exponent
}

/// The largest 1 to 9 times a power of ten at or below a value.
fn round_down(value: f64) -> f64 {
    let exponent = exponent_below(value);
    (1..=9).rev().map(|digit| decimal(digit, exponent)).find(|c| *c <= value).unwrap_or(value)
}

/// The smallest 1 to 10 times a power of ten at or above a value.
fn round_up(value: f64) -> f64 {
    let exponent = exponent_below(value);
    (1..=10).map(|digit| decimal(digit, exponent)).find(|c| *c >= value).unwrap_or(value)
}

/// Milliseconds in words: `20 ms`, `5 s`.
pub(super) fn duration(ms: f64) -> String {
    match ms {
        _ if ms >= 1000.0 => format!("{} s", short(ms / 1000.0)),
        _ if ms >= 1.0 || ms == 0.0 => format!("{} ms", short(ms)),
        _ => format!("{} µs", short(ms * 1000.0)),
    }
}

/// A number of up to three digits that count.
pub(super) fn short(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    let exponent = exponent_below(value.abs());
    if exponent < -4 {
        return format!("{value:.1e}");
    }
    let digits = (2 - exponent).max(0) as usize;
    let text = format!("{value:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_begins_and_ends_at_a_grid_line() {
        let axis = LogAxis::around(&[0.0031, 0.4]);
        assert_eq!((axis.low, axis.high, axis.has_zero), (0.002, 0.5, false));
        assert_eq!((axis.place(0.002), axis.place(0.5)), (0.0, 1.0));
        assert!((axis.place(0.1_f64.sqrt() / 10.0) - 0.5).abs() < 1e-12);
    }

    #[test]
    fn powers_of_ten_are_exact_and_labelled() {
        let axis = LogAxis::around(&[0.002, 700.0]);
        let words: Vec<f64> = axis.ticks(0.09).iter().filter(|t| t.is_labelled).map(|t| t.value).collect();
        assert_eq!(words, [0.001, 0.01, 0.1, 1.0, 10.0, 100.0, 500.0]);
        let first: Vec<f64> = axis.ticks(0.09).iter().take(3).map(|t| t.value).collect();
        assert_eq!(first, [0.001, 0.002, 0.003]);
    }

    #[test]
    fn a_short_axis_has_words_at_more_and_never_nearer_than_there_is_room() {
        let ticks = LogAxis::around(&[3.0, 30.0]).ticks(0.09);
        let words: Vec<f64> = ticks.iter().filter(|t| t.is_labelled).map(|t| t.value).collect();
        assert_eq!(words, [2.0, 3.0, 5.0, 7.0, 10.0, 20.0, 30.0, 40.0]);
        let ticks = LogAxis::around(&[0.35, 0.5]).ticks(0.09);
        assert_eq!(ticks.iter().filter(|t| t.is_labelled).count(), ticks.len());
    }

    #[test]
    fn zeros_have_a_place_below_everything() {
        let axis = LogAxis::around(&[0.0, 0.01, 0.1]);
        assert!(axis.has_zero());
        assert_eq!(axis.place(0.0), 0.0);
        assert!(axis.place(0.01) > ZERO_BAND);
        assert_eq!(LogAxis::around(&[0.0]).place(0.0), 0.0);
    }

    #[test]
    fn a_power_of_ten_has_its_own_exponent_whatever_its_logarithm_is_rounded_to() {
        assert!((-30..=30).all(|k| exponent_below(decimal(1, k)) == k && exponent_below(decimal(9, k)) == k));
    }

    #[test]
    fn numbers_are_short() {
        let words = [0.0, 0.001, 0.012345, 1.5, 20.0, 123.45, 98765.4, 0.0000123].map(short);
        assert_eq!(words, ["0", "0.001", "0.0123", "1.5", "20", "123", "98765", "1.2e-5"]);
        assert_eq!([0.2, 20.0, 5000.0].map(duration), ["200 µs", "20 ms", "5 s"]);
    }
}
