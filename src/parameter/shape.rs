//! The vocabulary in which the keys of the scene file are described, those of settings among them.

use super::{Named, Value};

/// What a value must look like.
#[derive(Debug, Clone, Copy)]
pub enum Shape {
    /// Any string but the empty one.
    Text,
    /// A text, or a list of at least one.
    Texts,
    /// A colour as CSS writes it: `"#rrggbb"`, a name, `"rgb(...)"`.
    Color,
    /// `true` or `false`.
    Flag,
    /// One of some words, and what each of them means.
    Choice(fn() -> Vec<&'static str>, &'static [&'static str]),
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
    /// An even count of numbers in a range, at most so many.
    Pattern(usize, Range),
    /// A word for "none", or the shape of what there may be.
    Or(&'static str, &'static Shape),
    /// Two finite numbers, or three.
    PairOrTriple,
    /// One list of points `[[x, y], ...]`, or a list of such lists.
    Paths,
    /// A string, a finite number, `true` or `false`.
    Scalar,
    /// A scalar, or a list of at least one.
    Scalars,
    /// At least one pair of a finite number and a value.
    Stops(&'static Shape),
    /// A table.
    Table(&'static TableShape),
    /// Any number of tables.
    Tables(&'static TableShape),
    /// A table of whatever keys, its values all of one shape.
    Map(&'static Shape),
    /// A value of a shape that is no table, or a table.
    OrTable(&'static Shape, &'static TableShape),
}

/// What a table may hold.
#[derive(Debug)]
pub struct TableShape {
    /// Its keys.
    pub keys: &'static [Key],
    /// Which of them go together.
    pub rules: &'static [Rule],
}

/// One key of a table.
#[derive(Debug, Clone, Copy)]
pub struct Key {
    /// The key.
    pub name: &'static str,
    /// What its value must look like.
    pub shape: Shape,
    /// Whether it may not be left out.
    pub required: bool,
    /// What it means: a sentence or a few.
    pub doc: &'static str,
    /// Of a technique's parameter: where its paper speaks of it.
    pub section: Option<&'static str>,
    /// Of a parameter: what holds where it is left out. (Defaults of other keys depend on more; `doc` tells them.)
    pub default: Option<fn() -> Value>,
}

/// Which keys of a table go together.
#[derive(Debug, Clone, Copy)]
pub enum Rule {
    /// Exactly one of them.
    One(&'static [&'static str]),
    /// None or one of them.
    AtMostOne(&'static [&'static str]),
    /// One of them or more.
    Some(&'static [&'static str]),
}

/// A range of numbers.
#[derive(Debug, Clone, Copy)]
pub enum Range {
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
    /// Greater than 0, up to a number.
    UpTo(f64),
    /// Between two numbers, both excluded.
    Between(f64, f64),
}

impl Range {
    /// Whether it contains the number.
    pub fn contains(self, number: f64) -> bool {
        number.is_finite()
            && match self {
                Range::Finite => true,
                Range::Positive => number > 0.0,
                Range::NotNegative => number >= 0.0,
                Range::FromOne => number >= 1.0,
                Range::Share => (0.0..=1.0).contains(&number),
                Range::UpTo(most) => number > 0.0 && number <= most,
                Range::Between(low, high) => low < number && number < high,
            }
    }

    /// The range in words, to follow "must be".
    pub fn words(self) -> String {
        match self {
            Range::Finite => "a finite number".into(),
            Range::Positive => "a finite number greater than 0".into(),
            Range::NotNegative => "a finite number, 0 or more".into(),
            Range::FromOne => "a finite number, 1 or more".into(),
            Range::Share => "a number from 0 to 1".into(),
            Range::UpTo(most) => format!("a number greater than 0, {most} at most"),
            Range::Between(low, high) => format!("a number between {low} and {high}, both excluded"),
        }
    }
}

impl Shape {
    /// The words of this shape, where it is one of words.
    pub fn choices(&self) -> Vec<&'static str> {
        if let Shape::Choice(names, _) = self { names() } else { Vec::new() }
    }

    /// What a word of this shape means.
    pub fn meaning(&self, word: &str) -> Option<&'static str> {
        let Shape::Choice(names, meanings) = self else { return None };
        let at = names().into_iter().position(|name| name == word)?;
        meanings.get(at).copied()
    }

    /// The shape in words, to follow "must be".
    pub fn words(&self) -> String {
        match self {
            Shape::Text => "a string that is not empty".into(),
            Shape::Texts => "a string that is not empty, or a list of these".into(),
            Shape::Color => {
                "a colour of CSS (\"#rrggbb\", \"#rrggbbaa\", \"#rgb\", a name, rgb(), hsl())".into()
            }
            Shape::Flag => "true or false".into(),
            Shape::Choice(names, _) => choice_words(&names()),
            Shape::Integer(low, high) if low == high => format!("{low}"),
            Shape::Integer(low, high) => format!("a whole number from {low} to {high}"),
            Shape::IntegerOf(numbers) => format!("one of {numbers:?}"),
            Shape::Integers(count, low, high) => {
                format!("an array of {count} whole numbers from {low} to {high}")
            }
            Shape::Number(range) => range.words(),
            Shape::Numbers(count) => format!("an array of {count} finite numbers"),
            Shape::Pattern(most, range) => {
                format!("an array of 2, 4, ... or {most} numbers, each {}", range.words())
            }
            Shape::Or(word, shape) => format!("{} or {word:?}", shape.words()),
            Shape::PairOrTriple => "an array of 2 or 3 finite numbers".into(),
            Shape::Paths => "a list of points [[x, y], ...] or a list of such lists".into(),
            Shape::Scalar => "a string, a finite number, true or false".into(),
            Shape::Scalars => "a string, a finite number, true or false, or a list of these".into(),
            Shape::Stops(shape) => format!("a list of pairs [number, {}]", shape.words()),
            Shape::OrTable(shape, _) => format!("{} or a table", shape.words()),
            Shape::Table(_) | Shape::Map(_) => "a table".into(),
            Shape::Tables(_) => "an array of tables".into(),
        }
    }
}

fn choice_words(names: &[&str]) -> String {
    let quoted: Vec<_> = names.iter().map(|name| format!("{name:?}")).collect();
    quoted.join(" or ")
}

/// A word for a value of `T`.
pub const fn choice<T: Named>() -> Shape {
    Shape::Choice(|| T::NAMES.iter().map(|(name, _)| *name).collect(), T::MEANINGS)
}

/// A key that may be left out.
pub const fn key(name: &'static str, shape: Shape, doc: &'static str) -> Key {
    Key { name, shape, required: false, doc, section: None, default: None }
}

impl Key {
    /// The key that may not be left out.
    #[must_use]
    pub const fn required(self) -> Self {
        Self { required: true, ..self }
    }

    /// What it means, where the paper speaks of it, and the default: text for people.
    pub fn description(&self) -> String {
        let section = self.section.map(|section| format!(" {section}."));
        let default = self.default.map(|default| format!(" Default: {}.", default()));
        [self.doc, &section.unwrap_or_default(), &default.unwrap_or_default()].concat()
    }
}

impl TableShape {
    /// The key of this name.
    pub fn key(&self, name: &str) -> Option<&'static Key> {
        self.keys.iter().find(|key| key.name == name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_range_contains_nan_or_infinity() {
        for range in [Range::Finite, Range::Positive, Range::NotNegative, Range::FromOne, Range::Share] {
            assert!(!range.contains(f64::NAN) && !range.contains(f64::INFINITY), "{range:?}");
        }
    }
}
