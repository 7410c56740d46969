//! The scene file against its description, in the order in which it was written: unknown and missing keys, types,
//! ranges. What several values say together is judged in [`super::build`].

use super::keys::SCHEMA;
use super::place::{Origin, Place};
use super::suggest;
use super::tree::{Entry, Node, Table, Value};
use crate::error::{Error, Result};
use crate::parameter::{self, Range, Rule, Shape, TableShape, color, color_names};

/// Judges the table called `path` (empty: the whole file).
pub(super) fn table(
    origin: &Origin<'_>,
    table: &Table,
    place: &Place,
    shape: &'static TableShape,
    path: &str,
) -> Result<()> {
    let check = Check { origin, path };
    for entry in &table.0 {
        check.entry(entry, shape)?;
    }
    check.required(table, place, shape)?;
    shape.rules.iter().try_for_each(|rule| check.rule(*rule, table, place))
}

/// The judge of one table.
struct Check<'a> {
    origin: &'a Origin<'a>,
    path: &'a str,
}

impl Check<'_> {
    fn entry(&self, entry: &Entry, shape: &'static TableShape) -> Result<()> {
        let key = shape.key(&entry.key).ok_or_else(|| self.unknown(entry, shape))?;
        self.value(&entry.node, &key.shape, &self.path_of(key.name))
    }

    fn tables(&self, items: &[Node], shape: &'static TableShape, path: &str) -> Result<()> {
        items.iter().enumerate().try_for_each(|(index, item)| {
            let path = format!("{path}.{index}");
            match &item.value {
                Value::Table(found) => table(self.origin, found, &item.place, shape, &path),
                other => Err(self.mismatch(&item.place, &path, "a table", &other.found())),
            }
        })
    }

    fn value(&self, node: &Node, shape: &Shape, path: &str) -> Result<()> {
        match (shape, &node.value) {
            (Shape::Table(inner) | Shape::OrTable(_, inner), Value::Table(found)) => {
                table(self.origin, found, &node.place, inner, path)
            }
            (Shape::Tables(inner), Value::Array(items)) => self.tables(items, inner, path),
            (Shape::Map(inner), Value::Table(Table(entries))) => entries.iter().try_for_each(|entry| {
                self.no_bare_number(entry, path)?;
                self.value(&entry.node, inner, &format!("{path}.{}", entry.key))
            }),
            (Shape::Stops(inner), Value::Array(items)) if !items.is_empty() => self.stops(items, inner, path),
            (Shape::OrTable(plain, _), _) => self.value(node, plain, path),
            (Shape::Scalars, Value::Array(items)) if !items.is_empty() => {
                self.each(items, &Shape::Scalar, path)
            }
            (Shape::Texts, Value::Array(items)) if !items.is_empty() => self.each(items, &Shape::Text, path),
            (Shape::Numbers(count), Value::Array(items)) if items.len() == *count => {
                self.each(items, &Shape::Number(Range::Finite), path)
            }
            (Shape::Pattern(most, range), Value::Array(items))
                if !items.is_empty() && items.len().is_multiple_of(2) && items.len() <= *most =>
            {
                self.each(items, &Shape::Number(*range), path)
            }
            (Shape::PairOrTriple, Value::Array(items)) if matches!(items.len(), 2 | 3) => {
                self.each(items, &Shape::Number(Range::Finite), path)
            }
            (Shape::Integers(count, low, high), Value::Array(items)) if items.len() == *count => {
                self.each(items, &Shape::Integer(*low, *high), path)
            }
            (Shape::Or(_, inner @ Shape::Numbers(_)), Value::Array(_)) => self.value(node, inner, path),
            (Shape::Paths, Value::Array(items)) => self.paths(items, &node.place, path),
            (shape, value) if fits(shape, value) => Ok(()),
            (shape, value) => Err(self.misfit(node, shape, value, path)),
        }
    }

    fn each(&self, items: &[Node], shape: &Shape, path: &str) -> Result<()> {
        items.iter().enumerate().try_for_each(|(at, item)| self.value(item, shape, &format!("{path}.{at}")))
    }

    /// Refuses `2.5 = ...`, which is a table `2` with a key `5` in TOML.
    fn no_bare_number(&self, entry: &Entry, path: &str) -> Result<()> {
        let is_number = |key: &str| {
            let digits = key.strip_prefix(['-', '+']).unwrap_or(key);
            !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit())
        };
        let inner = match &entry.node.value {
            Value::Table(Table(inner)) if is_number(&entry.key) => inner.first(),
            _ => None,
        };
        inner.filter(|inner| is_number(&inner.key)).map_or(Ok(()), |inner| {
            let number = format!("{}.{}", entry.key, inner.key);
            let what = format!(
                "`{path}`: {number} without quotes is a key `{}` in a table `{}`",
                inner.key, entry.key
            );
            Err(self.origin.error(&entry.key_place, what).help(format!("put it in quotes: \"{number}\"")))
        })
    }

    fn stops(&self, items: &[Node], shape: &Shape, path: &str) -> Result<()> {
        items.iter().enumerate().try_for_each(|(at, item)| {
            let path = format!("{path}.{at}");
            match &item.value {
                Value::Array(pair) if pair.len() == 2 => {
                    self.value(&pair[0], &Shape::Number(Range::Finite), &format!("{path}.0"))?;
                    self.value(&pair[1], shape, &format!("{path}.1"))
                }
                other => {
                    let expected = format!("a pair [number, {}]", shape.words());
                    Err(self.mismatch(&item.place, &path, &expected, &other.found()))
                }
            }
        })
    }

    /// One list of points, or several: told by the depth of the first item.
    fn paths(&self, items: &[Node], place: &Place, path: &str) -> Result<()> {
        if items.is_empty() {
            return Err(self.mismatch(place, path, "at least one point", "none"));
        }
        if !is_nested(items) {
            return self.each(items, &Shape::Numbers(2), path);
        }
        items.iter().enumerate().try_for_each(|(at, item)| {
            let path = format!("{path}.{at}");
            match &item.value {
                Value::Array(points) if !points.is_empty() => self.each(points, &Shape::Numbers(2), &path),
                other => {
                    Err(self.mismatch(&item.place, &path, "a list of points [[x, y], ...]", &other.found()))
                }
            }
        })
    }

    fn required(&self, table: &Table, place: &Place, shape: &'static TableShape) -> Result<()> {
        let missing = shape.keys.iter().find(|key| key.required && table.get(key.name).is_none());
        missing.map_or(Ok(()), |key| {
            let what = format!("`{}` is missing", self.path_of(key.name));
            Err(self.origin.error(place, what).help(format!("{} It must be {}", key.doc, key.shape.words())))
        })
    }

    fn rule(&self, rule: Rule, table: &Table, place: &Place) -> Result<()> {
        let (Rule::One(keys) | Rule::AtMostOne(keys) | Rule::Some(keys)) = rule;
        let present: Vec<&Entry> =
            table.0.iter().filter(|entry| keys.contains(&entry.key.as_str())).collect();
        match (rule, present.as_slice()) {
            (Rule::One(_) | Rule::Some(_), []) => {
                let of = if self.path.is_empty() { "the file" } else { self.path };
                Err(self.origin.error(place, format!("`{of}` needs {}", quoted(keys, " or "))))
            }
            (Rule::One(_) | Rule::AtMostOne(_), [first, second, ..]) => {
                let what = format!("`{}` and `{}` exclude each other", self.path_of(&first.key), second.key);
                Err(self
                    .origin
                    .error(&second.key_place, what)
                    .help(format!("keep one of {}", quoted(keys, ", "))))
            }
            _ => Ok(()),
        }
    }

    fn unknown(&self, entry: &Entry, shape: &TableShape) -> Error {
        let known: Vec<&str> = shape.keys.iter().map(|key| key.name).collect();
        let what = format!("there is no key `{}`", self.path_of(&entry.key));
        self.origin.error(&entry.key_place, what).help(suggest::nearest_or_all(&entry.key, &known, "keys"))
    }

    fn misfit(&self, node: &Node, shape: &Shape, value: &Value, path: &str) -> Error {
        let error = self.mismatch(&node.place, path, &shape.words(), &value.found());
        match (shape, value) {
            (Shape::Integer(SCHEMA, SCHEMA), Value::Integer(_)) => {
                error.help(format!("this program reads schema {SCHEMA}; another needs another version of it"))
            }
            (Shape::Choice(names, _), Value::Text(text)) => with_nearest(error, text, &names()),
            (Shape::Color, Value::Text(text)) => {
                with_nearest(error, text, &color_names().collect::<Vec<_>>())
            }
            (Shape::Or(word, _), Value::Text(text)) => with_nearest(error, text, &[*word]),
            (Shape::Choice(names, _), Value::Flag(flag)) if names().contains(&flag.to_string().as_str()) => {
                error.help("put it in quotes")
            }
            (Shape::Text, Value::Integer(_) | Value::Number(_) | Value::Flag(_) | Value::Date) => {
                error.help("put it in quotes")
            }
            _ => error,
        }
    }

    fn mismatch(&self, place: &Place, path: &str, expected: &str, found: &str) -> Error {
        self.origin.error(place, format!("`{path}` must be {expected}; found {found}"))
    }

    fn path_of(&self, key: &str) -> String {
        if self.path.is_empty() { key.into() } else { format!("{}.{key}", self.path) }
    }
}

/// An error of a word that is not known, with the one that was most likely meant.
fn with_nearest(error: Error, text: &str, known: &[&str]) -> Error {
    match suggest::nearest(text, known) {
        Some(near) => error.help(format!("did you mean {near:?}?")),
        None => error,
    }
}

/// Whether the first item of paths is itself a list of points.
pub(super) fn is_nested(items: &[Node]) -> bool {
    let inner = items.first().map(|item| &item.value);
    matches!(inner, Some(Value::Array(first)) if matches!(first.first().map(|n| &n.value), Some(Value::Array(_))))
}

/// Whether a value that holds no others is of a shape.
fn fits(shape: &Shape, value: &Value) -> bool {
    match (shape, value) {
        (Shape::Text | Shape::Texts, Value::Text(text)) => !text.is_empty(),
        (Shape::Color, Value::Text(text)) => color(text).is_some(),
        (Shape::Flag, Value::Flag(_)) => true,
        (Shape::Scalar | Shape::Scalars, Value::Text(_) | Value::Flag(_)) => true,
        (Shape::Scalar | Shape::Scalars, value) => value.number().is_some_and(f64::is_finite),
        _ => plain(shape, value).is_some(),
    }
}

/// The value of a parameter of this shape; `None` where it is of another.
pub(super) fn plain(shape: &Shape, value: &Value) -> Option<parameter::Value> {
    use parameter::Value::{Integer, Number, Numbers, Word};
    match (shape, value) {
        (Shape::Choice(names, _), Value::Text(text)) => {
            names().into_iter().find(|name| name == text).map(Word)
        }
        (Shape::Integer(low, high), Value::Integer(Some(n))) => {
            i64::try_from(*n).ok().filter(|n| (*low..=*high).contains(n)).map(Integer)
        }
        (Shape::IntegerOf(numbers), Value::Integer(Some(n))) => {
            numbers.iter().copied().find(|known| i128::from(*known) == *n).map(Integer)
        }
        (Shape::Number(range), value) => value.number().filter(|n| range.contains(*n)).map(Number),
        (Shape::Numbers(count), Value::Array(items)) if items.len() == *count => {
            items.iter().map(|item| item.value.number()).collect::<Option<_>>().map(Numbers)
        }
        (Shape::Or(word, _), Value::Text(text)) if text == word => Some(Word(word)),
        (Shape::Or(_, inner), value) => plain(inner, value),
        _ => None,
    }
}

fn quoted(keys: &[&str], between: &str) -> String {
    let quoted: Vec<_> = keys.iter().map(|key| format!("`{key}`")).collect();
    quoted.join(between)
}
