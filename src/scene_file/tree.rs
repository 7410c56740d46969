//! The scene file as a tree of values that know where they were written.

use super::place::{Origin, Place};
use crate::error::Result;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A value and where it was written.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Node {
    pub(super) value: Value,
    pub(super) place: Place,
}

/// A TOML value.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    Text(String),
    /// `None`: beyond 128 bits.
    Integer(Option<i128>),
    Number(f64),
    Flag(bool),
    Date,
    Array(Vec<Node>),
    Table(Table),
}

/// A table in the order in which it was written.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Table(pub(super) Vec<Entry>);

/// A key and its value.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Entry {
    pub(super) key: String,
    pub(super) key_place: Place,
    pub(super) node: Node,
}

impl Table {
    pub(super) fn get(&self, key: &str) -> Option<&Node> {
        self.0.iter().find(|entry| entry.key == key).map(|entry| &entry.node)
    }
}

impl Value {
    /// What it is, for "found ...".
    pub(super) fn found(&self) -> String {
        match self {
            Value::Text(text) => format!("the string {text:?}"),
            Value::Integer(Some(number)) => format!("{number}"),
            Value::Integer(None) => "a number beyond measure".into(),
            Value::Number(number) => format!("{number:?}"),
            Value::Flag(flag) => format!("{flag}"),
            Value::Date => "a date".into(),
            Value::Array(items) => format!("an array of {}", items.len()),
            Value::Table(_) => "a table".into(),
        }
    }

    /// The string.
    pub(super) fn text(&self) -> Option<&str> {
        match self {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    /// The number, written with or without a point.
    pub(super) fn number(&self) -> Option<f64> {
        match self {
            Value::Number(number) => Some(*number),
            Value::Integer(number) => number.map(|n| n as f64),
            _ => None,
        }
    }
}

/// Parses a whole file.
pub(super) fn parse(origin: &Origin<'_>) -> Result<Node> {
    // A slip early in the file may cause others: the first one is told.
    let (root, errors) = DeTable::parse_recoverable(origin.text);
    let start = |error: &toml::de::Error| error.span().map_or(0, |span| span.start);
    if let Some(error) = errors.iter().min_by_key(|error| start(error)) {
        let place = Place::File(error.span().unwrap_or(0..0));
        return Err(origin.error(&place, format!("this is not TOML: {}", error.message())));
    }
    Ok(Node { value: Value::Table(table(root.get_ref(), None)), place: Place::File(0..0) })
}

/// Parses one value of an override.
pub(super) fn parse_value(text: &str, place: &Place) -> Option<Node> {
    let value = DeValue::parse(text).ok()?;
    Some(node(&value, Some(place)))
}

/// `place` is where everything was written; `None`: at its span in the file.
fn node(from: &Spanned<DeValue<'_>>, place: Option<&Place>) -> Node {
    let value = match from.get_ref() {
        DeValue::String(text) => Value::Text(text.to_string()),
        DeValue::Integer(number) => {
            Value::Integer(i128::from_str_radix(number.as_str(), number.radix()).ok())
        }
        DeValue::Float(number) => Value::Number(number.as_str().parse().unwrap_or(f64::NAN)),
        DeValue::Boolean(flag) => Value::Flag(*flag),
        DeValue::Datetime(_) => Value::Date,
        DeValue::Array(items) => Value::Array(items.iter().map(|item| node(item, place)).collect()),
        DeValue::Table(entries) => Value::Table(table(entries, place)),
    };
    Node { value, place: place_or(place, from.span()) }
}

fn table(from: &DeTable<'_>, place: Option<&Place>) -> Table {
    let mut entries: Vec<_> = from.iter().collect();
    entries.sort_by_key(|(key, _)| key.span().start);
    let entry = |(key, value): (&Spanned<_>, _)| Entry {
        key: ToString::to_string(key.get_ref()),
        key_place: place_or(place, key.span()),
        node: node(value, place),
    };
    Table(entries.into_iter().map(entry).collect())
}

fn place_or(place: Option<&Place>, span: std::ops::Range<usize>) -> Place {
    place.cloned().unwrap_or(Place::File(span))
}
