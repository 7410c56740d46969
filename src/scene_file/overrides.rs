//! Changes to a scene file that are given beside it: `path=value`.

use super::build::default_name;
use super::place::{Origin, Place};
use super::suggest;
use super::tree::{self, Entry, Node, Table, Value};
use crate::error::{Error, Result};

/// One change to a scene file.
///
/// The path walks tables by key and arrays by number (from 0) or, for layers, by name; the value is TOML, or a bare
/// word that is taken as a string; no value removes the key.
///
/// ```
/// use drapery::scene_file::{Override, SceneFile};
/// let text = "schema = 1\n[terrain]\ngenerate = { kind = \"plane\" }\n[image]\nwidth = 64\nheight = 48\n";
/// let change = Override::parse("image.width=32").unwrap();
/// let scene = SceneFile::parse(text, None, &[change]).unwrap();
/// assert_eq!((scene.image.width, scene.image.height), (32, 48));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Override {
    text: String,
    path: Vec<String>,
    /// TOML or a bare word; empty: remove.
    value: String,
}

impl Override {
    /// Reads `path=value`.
    ///
    /// # Errors
    /// When there is no `=`, or the path is not a dotted key. Whether the path exists is judged with the scene.
    pub fn parse(text: &str) -> Result<Self> {
        let refuse = |what: &str| {
            Error::new(format!("override `{text}`: {what}"))
                .help("write path=value, such as camera.eye=[0,-5000,2000] or layer.roads.line.width_m=8")
        };
        let (path, value) = text.split_once('=').ok_or_else(|| refuse("there is no `=`"))?;
        let path =
            dotted_key(path.trim()).ok_or_else(|| refuse("the part before `=` is not a dotted path"))?;
        Ok(Self { text: text.into(), path, value: value.trim().into() })
    }
}

/// The segments of `a.b."c d"`.
fn dotted_key(path: &str) -> Option<Vec<String>> {
    let document = format!("{path} = 0");
    let origin = Origin { text: &document, path: None };
    let mut node = tree::parse(&origin).ok().filter(|_| !path.contains('\n'))?;
    let mut segments = Vec::new();
    while let Value::Table(Table(mut entries)) = node.value {
        let entry = entries.pop().filter(|_| entries.is_empty())?;
        segments.push(entry.key);
        node = entry.node;
    }
    Some(segments)
}

/// The value, or `None` to remove the key.
fn bare_or_toml(text: &str, place: &Place) -> Option<Node> {
    let bare = || Node { value: Value::Text(text.into()), place: place.clone() };
    (!text.is_empty()).then(|| tree::parse_value(text, place).unwrap_or_else(bare))
}

/// Makes all changes, in order.
pub(super) fn apply(origin: &Origin<'_>, root: &mut Node, changes: &[Override]) -> Result<()> {
    for change in changes {
        let place = Place::Override(change.text.clone());
        let value = bare_or_toml(&change.value, &place);
        Walk { origin, place }.set(root, &change.path, value)?;
    }
    Ok(())
}

/// One override on its way down the tree.
struct Walk<'a> {
    origin: &'a Origin<'a>,
    place: Place,
}

impl Walk<'_> {
    fn set(&self, node: &mut Node, path: &[String], value: Option<Node>) -> Result<()> {
        let Some((segment, rest)) = path.split_first() else {
            return value.map_or(Ok(()), |value| {
                *node = value;
                Ok(())
            });
        };
        match &mut node.value {
            Value::Table(table) => self.set_in_table(table, segment, rest, value),
            Value::Array(items) => self.set_in_array(items, segment, rest, value),
            other => Err(self.error(format!("{} has no part `{segment}`", other.found()))),
        }
    }

    fn set_in_table(&self, table: &mut Table, key: &str, rest: &[String], value: Option<Node>) -> Result<()> {
        let found = table.0.iter().position(|entry| entry.key == key);
        if rest.is_empty() && value.is_none() {
            return found
                .map(|at| drop(table.0.remove(at)))
                .ok_or_else(|| self.error(format!("there is no `{key}` to remove")));
        }
        let at = found.unwrap_or_else(|| {
            table.0.push(self.empty_entry(key));
            table.0.len() - 1
        });
        self.set(&mut table.0[at].node, rest, value)
    }

    fn empty_entry(&self, key: &str) -> Entry {
        let node = Node { value: Value::Table(Table::default()), place: self.place.clone() };
        Entry { key: key.into(), key_place: self.place.clone(), node }
    }

    fn set_in_array(
        &self,
        items: &mut Vec<Node>,
        segment: &str,
        rest: &[String],
        value: Option<Node>,
    ) -> Result<()> {
        let at = self.index_of(items, segment)?;
        if rest.is_empty() && value.is_none() {
            items.remove(at);
            return Ok(());
        }
        self.set(&mut items[at], rest, value)
    }

    fn index_of(&self, items: &[Node], segment: &str) -> Result<usize> {
        if let Ok(number) = segment.parse::<usize>() {
            let refusal = || {
                self.error(format!("there is no number {number}: there are {}, counted from 0", items.len()))
            };
            return (number < items.len()).then_some(number).ok_or_else(refusal);
        }
        let names: Vec<String> = items.iter().enumerate().map(|(at, item)| name(item, at)).collect();
        names.iter().position(|name| name == segment).ok_or_else(|| {
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            self.error(format!("nothing here is called `{segment}`"))
                .help(suggest::nearest_or_all(segment, &names, "names"))
        })
    }

    fn error(&self, what: String) -> Error {
        self.origin.error(&self.place, what)
    }
}

/// What a layer is called (things that are no layers have no name and are called by their number).
fn name(node: &Node, index: usize) -> String {
    let text = |key: &str| match &node.value {
        Value::Table(table) => table.get(key).and_then(|node| node.value.text()),
        _ => None,
    };
    text("name").map_or_else(|| default_name(text("source"), text("layer"), index), Into::into)
}
