//! What a column of attributes holds, for people.

use crate::math::{max, min};
use crate::scene::Attribute;
use std::collections::BTreeMap;
use std::fmt;

/// The most different values that are told one by one.
const MOST_DISTINCT: usize = 12;
/// The most different values that are counted.
const MOST_COUNTED: usize = 256;
/// How many values are told as examples.
const EXAMPLES: usize = 3;

/// What a column of a vector file holds.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct ColumnSummary {
    /// Its name.
    pub name: String,
    /// What its values are.
    pub kind: ColumnKind,
    /// How many features have a value, those that are not drawn counted.
    pub values: usize,
    /// The least and the greatest number.
    pub range: Option<[f64; 2]>,
    /// Every different value in ascending order, and how many features have it; `None` where there are more than 12.
    pub distinct: Option<Vec<(Attribute, usize)>>,
    /// The most frequent values, at most 12, and how many features have each, the most frequent first; of more than 256 different
    /// values those are counted that the file has first.
    pub frequent: Vec<(Attribute, usize)>,
    /// The first different values in file order, at most 3.
    pub examples: Vec<Attribute>,
}

/// What the values of a column are, those that are there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColumnKind {
    /// There are none.
    Empty,
    /// Yes or no.
    Boolean,
    /// Whole numbers.
    Integer,
    /// Numbers, not all of them whole.
    Number,
    /// Texts.
    Text,
    /// Several kinds.
    Mixed,
}

impl fmt::Display for ColumnKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Empty => "no values",
            Self::Boolean => "true or false",
            Self::Integer => "whole numbers",
            Self::Number => "numbers",
            Self::Text => "text",
            Self::Mixed => "values of several kinds",
        })
    }
}

impl ColumnKind {
    fn of(value: &Attribute) -> Self {
        match value {
            Attribute::Null => Self::Empty,
            Attribute::Boolean(_) => Self::Boolean,
            Attribute::Integer(_) => Self::Integer,
            Attribute::Number(_) => Self::Number,
            Attribute::Text(_) => Self::Text,
        }
    }

    /// The kind of values of both kinds.
    fn with(self, other: Self) -> Self {
        match (self, other) {
            (a, b) if a == b => a,
            (Self::Empty, kind) | (kind, Self::Empty) => kind,
            (Self::Integer, Self::Number) | (Self::Number, Self::Integer) => Self::Number,
            _ => Self::Mixed,
        }
    }
}

/// A summary in the making: a bounded number of values, however long the column.
#[derive(Debug)]
pub(super) struct Tally {
    kind: ColumnKind,
    values: usize,
    range: Option<[f64; 2]>,
    counted: BTreeMap<Attribute, usize>,
    examples: Vec<Attribute>,
    /// The value of the feature that is being read: another may take its place.
    last: Option<(usize, Attribute)>,
}

impl Default for Tally {
    fn default() -> Self {
        Self {
            kind: ColumnKind::Empty,
            values: 0,
            range: None,
            counted: BTreeMap::new(),
            examples: Vec::new(),
            last: None,
        }
    }
}

impl Tally {
    /// A feature's value; of several the last one counts.
    pub(super) fn put(&mut self, feature: usize, value: Attribute) {
        if let Some((earlier, counted)) = self.last.replace((feature, value))
            && earlier != feature
        {
            self.count(counted);
        }
    }

    fn count(&mut self, value: Attribute) {
        if value.is_null() {
            return;
        }
        self.values += 1;
        self.kind = self.kind.with(ColumnKind::of(&value));
        if let Some(number) = value.number() {
            let [low, high] = self.range.unwrap_or([number; 2]);
            self.range = Some([min(low, number), max(high, number)]);
        }
        if self.examples.len() < EXAMPLES && !self.examples.contains(&value) {
            self.examples.push(value.clone());
        }
        if let Some(count) = self.counted.get_mut(&value) {
            *count += 1;
        } else if self.counted.len() < MOST_COUNTED {
            self.counted.insert(value, 1);
        }
    }

    pub(super) fn finish(mut self, name: String) -> ColumnSummary {
        if let Some((_, value)) = self.last.take() {
            self.count(value);
        }
        let Self { kind, values, range, counted, examples, last: _ } = self;
        let mut frequent: Vec<(Attribute, usize)> = counted.into_iter().collect();
        let distinct = (frequent.len() <= MOST_DISTINCT).then(|| frequent.clone());
        frequent.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        frequent.truncate(MOST_DISTINCT);
        ColumnSummary { name, kind, values, range, distinct, frequent, examples }
    }
}
