//! The vocabulary in which [`super::keys`] describes the scene file.

use crate::scene::file::names::Named;

/// What a value must look like.
#[derive(Debug, Clone, Copy)]
pub(super) enum Shape {
    /// Any string but the empty one.
    Text,
    /// `"#rrggbb"` or `"#rrggbbaa"`.
    Color,
    /// One of some words.
    Choice(fn() -> Vec<&'static str>),
    /// A whole number in a range, both ends included.
    Integer(i64, i64),
    /// One of some whole numbers.
    IntegerOf(&'static [i64]),
    /// So many whole numbers in a range, both ends included.
    Integers(usize, i64, i64),
    /// A finite number in a range.
    Number(Range),
    /// So many finite numbers.
    Numbers(usize),
    /// One list of points `[[x, y], ...]`, or a list of such lists.
    Paths,
    /// A table.
    Table(&'static TableShape),
    /// Any number of tables.
    Tables(&'static TableShape),
}

/// The seed of something generated.
pub(super) const SEED: Shape = Shape::Integer(0, i64::MAX);
/// A length, a width, a distance.
pub(super) const POSITIVE: Shape = Shape::Number(Range::Positive);
/// An opacity.
pub(super) const SHARE: Shape = Shape::Number(Range::Share);

/// What a table may hold.
#[derive(Debug)]
pub(super) struct TableShape {
    pub(super) keys: &'static [Key],
    pub(super) rules: &'static [Rule],
}

/// One key of a table.
#[derive(Debug, Clone, Copy)]
pub(super) struct Key {
    pub(super) name: &'static str,
    pub(super) shape: Shape,
    pub(super) required: bool,
    pub(super) doc: &'static str,
}

/// Which keys of a table go together.
#[derive(Debug, Clone, Copy)]
pub(super) enum Rule {
    /// Exactly one of them.
    One(&'static [&'static str]),
    /// None or one of them.
    AtMostOne(&'static [&'static str]),
    /// One of them or more.
    Some(&'static [&'static str]),
}

/// A range of numbers.
#[derive(Debug, Clone, Copy)]
pub(super) enum Range {
    /// Any finite number.
    Finite,
    /// Greater than 0.
    Positive,
    /// From 0 on.
    NotNegative,
    /// From 1 on.
    FromOne,
    /// 0..=1.
    Share,
    /// Between two numbers, both excluded.
    Between(f64, f64),
}

impl Range {
    /// Whether it contains the number.
    pub(super) fn contains(self, number: f64) -> bool {
        number.is_finite()
            && match self {
                Range::Finite => true,
                Range::Positive => number > 0.0,
                Range::NotNegative => number >= 0.0,
                Range::FromOne => number >= 1.0,
                Range::Share => (0.0..=1.0).contains(&number),
                Range::Between(low, high) => low < number && number < high,
            }
    }

    /// The range in words, to follow "must be".
    pub(super) fn words(self) -> String {
        match self {
            Range::Finite => "a finite number".into(),
            Range::Positive => "a finite number greater than 0".into(),
            Range::NotNegative => "a finite number, 0 or more".into(),
            Range::FromOne => "a finite number, 1 or more".into(),
            Range::Share => "a number from 0 to 1".into(),
            Range::Between(low, high) => format!("a number between {low} and {high}, both excluded"),
        }
    }
}

impl Shape {
    /// The shape in words, to follow "must be".
    pub(super) fn words(&self) -> String {
        match self {
            Shape::Text => "a string that is not empty".into(),
            Shape::Color => "a colour \"#rrggbb\" or \"#rrggbbaa\"".into(),
            Shape::Choice(names) => choice_words(&names()),
            Shape::Integer(low, high) if low == high => format!("{low}"),
            Shape::Integer(low, high) => format!("a whole number from {low} to {high}"),
            Shape::IntegerOf(numbers) => format!("one of {numbers:?}"),
            Shape::Integers(count, low, high) => {
                format!("an array of {count} whole numbers from {low} to {high}")
            }
            Shape::Number(range) => range.words(),
            Shape::Numbers(count) => format!("an array of {count} finite numbers"),
            Shape::Paths => "a list of points [[x, y], ...] or a list of such lists".into(),
            Shape::Table(_) => "a table".into(),
            Shape::Tables(_) => "an array of tables".into(),
        }
    }
}

fn choice_words(names: &[&str]) -> String {
    let quoted: Vec<_> = names.iter().map(|name| format!("{name:?}")).collect();
    quoted.join(" or ")
}

/// A word for a value of `T`.
pub(super) const fn choice<T: Named>() -> Shape {
    Shape::Choice(|| T::NAMES.iter().map(|(name, _)| *name).collect())
}

/// A key that may be left out.
pub(super) const fn key(name: &'static str, shape: Shape, doc: &'static str) -> Key {
    Key { name, shape, required: false, doc }
}

impl Key {
    /// The key that may not be left out.
    pub(super) const fn required(self) -> Self {
        Self { required: true, ..self }
    }
}

impl TableShape {
    pub(super) fn key(&self, name: &str) -> Option<&'static Key> {
        self.keys.iter().find(|key| key.name == name)
    }
}

/// The four code values of a colour.
pub(super) fn color(text: &str) -> Option<[u8; 4]> {
    let digits = text.strip_prefix('#').filter(|digits| digits.bytes().all(|b| b.is_ascii_hexdigit()))?;
    let code = |at: usize| u8::from_str_radix(digits.get(at..at + 2)?, 16).ok();
    match digits.len() {
        6 => Some([code(0)?, code(2)?, code(4)?, 255]),
        8 => Some([code(0)?, code(2)?, code(4)?, code(6)?]),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_have_six_or_eight_digits() {
        assert_eq!(color("#ff8000"), Some([255, 128, 0, 255]));
        assert_eq!(color("#FF800040"), Some([255, 128, 0, 64]));
        for wrong in ["", "#", "#fff", "ff8000", "#ff80zz", "#ff80001", "#üüü", "#+f+f+f"] {
            assert_eq!(color(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn no_range_contains_nan_or_infinity() {
        for range in [Range::Finite, Range::Positive, Range::NotNegative, Range::FromOne, Range::Share] {
            assert!(!range.contains(f64::NAN) && !range.contains(f64::INFINITY), "{range:?}");
        }
    }
}
