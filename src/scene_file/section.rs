//! A checked table, taken apart key by key.

use super::check::{is_nested, plain};
use super::place::{Origin, Place};
use super::tree::{Entry, Node, Table, Value as Found};
use crate::error::{Error, Result};
use crate::parameter::{Key, Named, Settings, Value, color};
use crate::scene::{Attribute, Color};
use crate::space::Plan;
use glam::DVec3;
use std::collections::BTreeMap;

/// A table whose keys are taken one by one. The check has been here before: a value that does not fit, or a key that
/// nobody takes, is a bug of ours.
pub(super) struct Section<'a> {
    origin: &'a Origin<'a>,
    place: Place,
    entries: Vec<Entry>,
}

/// Pairs of a number and a value.
pub(super) type Stops<T> = Vec<(f64, T)>;

/// A key that was taken: where its value was written.
pub(super) struct Taken<T> {
    pub(super) value: T,
    pub(super) place: Place,
}

impl<'a> Section<'a> {
    /// Reads a whole table with `read`, and makes sure that it left nothing.
    pub(super) fn read<T>(
        origin: &'a Origin<'a>,
        node: Node,
        read: impl FnOnce(&mut Section<'a>) -> Result<T>,
    ) -> Result<T> {
        let Found::Table(Table(entries)) = node.value else {
            return Err(bug("a table"));
        };
        let mut section = Section { origin, place: node.place, entries };
        let built = read(&mut section)?;
        match section.entries.first() {
            Some(left) => Err(bug(&format!("a use for `{}`", left.key))),
            None => Ok(built),
        }
    }

    /// An empty table where none was written.
    pub(super) fn take_or_empty(&mut self, key: &str) -> Node {
        let empty = Node { value: Found::Table(Table::default()), place: self.place.clone() };
        self.take(key).unwrap_or(empty)
    }

    pub(super) fn take(&mut self, key: &str) -> Option<Node> {
        let at = self.entries.iter().position(|entry| entry.key == key)?;
        Some(self.entries.remove(at).node)
    }

    fn taken<T>(&mut self, key: &str, convert: impl FnOnce(Found) -> Option<T>) -> Result<Option<Taken<T>>> {
        let Some(Node { value, place }) = self.take(key) else {
            return Ok(None);
        };
        let value = convert(value).ok_or_else(|| bug(key))?;
        Ok(Some(Taken { value, place }))
    }

    fn plain<T>(&mut self, key: &str, convert: impl FnOnce(Found) -> Option<T>) -> Result<Option<T>> {
        Ok(self.taken(key, convert)?.map(|taken| taken.value))
    }

    pub(super) fn text(&mut self, key: &str) -> Result<Option<String>> {
        Ok(self.text_at(key)?.map(|taken| taken.value))
    }

    pub(super) fn text_at(&mut self, key: &str) -> Result<Option<Taken<String>>> {
        self.taken(key, |value| if let Found::Text(text) = value { Some(text) } else { None })
    }

    /// A text, or each text of a list, with its own place.
    pub(super) fn texts_at(&mut self, key: &str) -> Result<Vec<Taken<String>>> {
        let Some(Node { value, place }) = self.take(key) else {
            return Ok(Vec::new());
        };
        let nodes = match value {
            Found::Array(items) => items,
            value => vec![Node { value, place }],
        };
        let text = |node: Node| match node.value {
            Found::Text(value) => Ok(Taken { value, place: node.place }),
            _ => Err(bug(key)),
        };
        nodes.into_iter().map(text).collect()
    }

    pub(super) fn number(&mut self, key: &str) -> Result<Option<f64>> {
        self.plain(key, |value| value.number())
    }

    pub(super) fn flag(&mut self, key: &str) -> Result<Option<bool>> {
        self.plain(key, |value| if let Found::Flag(flag) = value { Some(flag) } else { None })
    }

    pub(super) fn number_at(&mut self, key: &str) -> Result<Option<Taken<f64>>> {
        self.taken(key, |value| value.number())
    }

    pub(super) fn integer<T: TryFrom<i128>>(&mut self, key: &str) -> Result<Option<T>> {
        Ok(self.integer_at(key)?.map(|taken| taken.value))
    }

    pub(super) fn integer_at<T: TryFrom<i128>>(&mut self, key: &str) -> Result<Option<Taken<T>>> {
        self.taken(key, integer)
    }

    pub(super) fn integers_at(&mut self, key: &str) -> Result<Option<Taken<[usize; 2]>>> {
        self.taken(key, |value| items(value, integer))
    }

    pub(super) fn numbers<const N: usize>(&mut self, key: &str) -> Result<Option<[f64; N]>> {
        Ok(self.numbers_at(key)?.map(|taken| taken.value))
    }

    pub(super) fn numbers_at<const N: usize>(&mut self, key: &str) -> Result<Option<Taken<[f64; N]>>> {
        self.taken(key, |value| items(value, |item| item.number()))
    }

    /// Numbers, however many.
    pub(super) fn numbers_of_any_count(&mut self, key: &str) -> Result<Option<Vec<f64>>> {
        self.plain(key, |value| {
            let Found::Array(items) = value else { return None };
            items.into_iter().map(|item| item.value.number()).collect()
        })
    }

    /// Two or three numbers; the third is 0 where it was not written.
    pub(super) fn displacement(&mut self, key: &str) -> Result<Option<DVec3>> {
        self.plain(key, |value| {
            let Found::Array(items) = value else { return None };
            let numbers: Option<Vec<f64>> = items.into_iter().map(|item| item.value.number()).collect();
            match numbers?[..] {
                [x, y] => Some(DVec3::new(x, y, 0.0)),
                [x, y, z] => Some(DVec3::new(x, y, z)),
                _ => None,
            }
        })
    }

    pub(super) fn name<T: Named>(&mut self, key: &str) -> Result<Option<T>> {
        self.plain(key, |value| if let Found::Text(text) = value { T::from_name(&text) } else { None })
    }

    /// The value of a parameter.
    pub(super) fn value_at(&mut self, key: &Key) -> Result<Option<Taken<Value>>> {
        self.taken(key.name, |found| plain(&key.shape, &found))
    }

    /// The settings of a table of this one.
    pub(super) fn settings<S: Settings>(&mut self) -> Result<S> {
        let node = self.take_or_empty(S::NAME);
        Section::read(self.origin, node, |table| {
            let mut said = BTreeMap::new();
            for key in S::TABLE.keys {
                if let Some(Taken { value, .. }) = table.value_at(key)? {
                    said.insert(key.name, value);
                }
            }
            Ok(S::from_values(&|name| said.get(name).cloned()))
        })
    }

    pub(super) fn color(&mut self, key: &str) -> Result<Option<Color>> {
        self.plain(key, as_color)
    }

    /// A table of whatever keys, which each become something with their value; by keys in ascending order.
    pub(super) fn map<T>(
        &mut self,
        key: &str,
        convert: impl Fn(Node) -> Result<T>,
    ) -> Result<Option<Vec<(String, T)>>> {
        let Some(Node { value, .. }) = self.take(key) else {
            return Ok(None);
        };
        let Found::Table(Table(mut entries)) = value else {
            return Err(bug(key));
        };
        entries.sort_by(|a, b| a.key.cmp(&b.key));
        let each = |entry: Entry| Ok((entry.key, convert(entry.node)?));
        entries.into_iter().map(each).collect::<Result<_>>().map(Some)
    }

    /// A list of stops.
    pub(super) fn stops<T>(
        &mut self,
        key: &str,
        convert: impl Fn(Found) -> Option<T>,
    ) -> Result<Option<Taken<Stops<T>>>> {
        let pair = |item: Node| {
            let Found::Array(pair) = item.value else { return None };
            let [number, value] = <[Node; 2]>::try_from(pair).ok()?;
            Some((number.value.number()?, convert(value.value)?))
        };
        self.taken(key, |value| {
            if let Found::Array(items) = value { items.into_iter().map(pair).collect() } else { None }
        })
    }

    pub(super) fn paths(&mut self, key: &str) -> Result<Option<Vec<Vec<Plan>>>> {
        self.plain(key, paths)
    }

    /// The tables of an array.
    pub(super) fn tables(&mut self, key: &str) -> Result<Option<Vec<Node>>> {
        self.plain(key, |value| if let Found::Array(items) = value { Some(items) } else { None })
    }

    /// The key that is still there, and where it was written.
    pub(super) fn first_of(&self, keys: &[&str]) -> Option<(&str, &Place)> {
        let entry = self.entries.iter().find(|entry| keys.contains(&entry.key.as_str()))?;
        Some((&entry.key, &entry.key_place))
    }

    pub(super) fn origin(&self) -> &'a Origin<'a> {
        self.origin
    }

    /// Where the table was written.
    pub(super) fn place(&self) -> &Place {
        &self.place
    }

    /// A refusal of the whole table.
    pub(super) fn error(&self, what: impl Into<String>) -> Error {
        self.origin.error(&self.place, what)
    }

    /// A refusal of what is written at `place`.
    pub(super) fn error_at(&self, place: &Place, what: impl Into<String>) -> Error {
        self.origin.error(place, what)
    }
}

/// A colour's text as a colour.
pub(super) fn as_color(value: Found) -> Option<Color> {
    value.text().and_then(color).map(Color::from_rgba8)
}

/// A scalar as the value of an attribute.
pub(super) fn as_scalar(value: Found) -> Option<Attribute> {
    match value {
        Found::Text(text) => Some(Attribute::Text(text)),
        Found::Flag(flag) => Some(Attribute::Boolean(flag)),
        Found::Integer(Some(number)) => {
            Some(i64::try_from(number).map_or(Attribute::Number(number as f64), Attribute::Integer))
        }
        Found::Number(number) => Some(Attribute::of_number(number)),
        Found::Integer(None) | Found::Date | Found::Array(_) | Found::Table(_) => None,
    }
}

pub(super) fn bug(expected: &str) -> Error {
    Error::internal(format!("a scene file passed its check without {expected}"))
}

fn integer<T: TryFrom<i128>>(value: Found) -> Option<T> {
    match value {
        Found::Integer(Some(number)) => T::try_from(number).ok(),
        _ => None,
    }
}

fn items<T, const N: usize>(value: Found, convert: impl Fn(Found) -> Option<T>) -> Option<[T; N]> {
    let Found::Array(items) = value else { return None };
    let converted: Option<Vec<T>> = items.into_iter().map(|item| convert(item.value)).collect();
    converted?.try_into().ok()
}

fn paths(value: Found) -> Option<Vec<Vec<Plan>>> {
    let Found::Array(items) = value else { return None };
    if !is_nested(&items) {
        return Some(vec![points(Found::Array(items))?]);
    }
    items.into_iter().map(|item| points(item.value)).collect()
}

fn points(value: Found) -> Option<Vec<Plan>> {
    let Found::Array(list) = value else { return None };
    let point = |item: Node| items(item.value, |number| number.number()).map(|[x, y]| Plan::new(x, y));
    list.into_iter().map(point).collect()
}
