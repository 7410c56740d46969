//! A scene file that can be changed again.

use super::place::Origin;
use super::tree::{self, Value};
use super::{Override, SceneFile, overrides, text_of};
use crate::error::{Error, Result};
use std::path::{Path, PathBuf};

/// A scene file, checked, with the text that it was and the overrides that were made: what a sweep over settings, or a message
/// that shows the line to blame, goes back to.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneText {
    /// What it says, overrides made.
    pub file: SceneFile,
    text: String,
    path: Option<PathBuf>,
    overrides: Vec<Override>,
}

impl SceneText {
    /// Checks a text, as [`SceneFile::parse`] does.
    ///
    /// # Errors
    /// The first thing that is wrong.
    pub fn parse(text: &str, path: Option<&Path>, overrides: &[Override]) -> Result<Self> {
        let file = SceneFile::parse(text, path, overrides)?;
        Ok(Self {
            file,
            text: text.to_owned(),
            path: path.map(Path::to_path_buf),
            overrides: overrides.to_vec(),
        })
    }

    /// Reads a scene file.
    ///
    /// # Errors
    /// When it cannot be read, is not UTF-8, or something in it is wrong.
    pub fn read(path: &Path, overrides: &[Override]) -> Result<Self> {
        Self::parse(&text_of(path)?, Some(path), overrides)
    }

    /// The text, without the overrides.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// What the text says, overrides made, as TOML's own tables.
    ///
    /// # Errors
    /// When it has a number that TOML has none for.
    pub fn table(&self) -> Result<toml::Table> {
        let origin = Origin { text: &self.text, path: self.path.as_deref() };
        let mut root = tree::parse(&origin)?;
        overrides::apply(&origin, &mut root, &self.overrides)?;
        match plain(root.value) {
            Some(toml::Value::Table(table)) => Ok(table),
            _ => Err(Error::internal("a scene file that is no table")),
        }
    }

    /// What it says with further changes, each `path=value`.
    ///
    /// # Errors
    /// When a change is none, or one of the scene with it.
    pub fn changed(&self, changes: &[&str]) -> Result<SceneFile> {
        let more: Result<Vec<Override>> = changes.iter().map(|change| Override::parse(change)).collect();
        SceneFile::parse(&self.text, self.path.as_deref(), &[&self.overrides[..], &more?].concat())
    }
}

/// A value without its place; `None`: TOML has none such.
fn plain(value: Value) -> Option<toml::Value> {
    Some(match value {
        Value::Text(text) => toml::Value::String(text),
        Value::Integer(number) => toml::Value::Integer(number?.try_into().ok()?),
        Value::Number(number) => toml::Value::Float(number),
        Value::Flag(flag) => toml::Value::Boolean(flag),
        Value::Date => return None,
        Value::Array(items) => {
            let items: Option<Vec<_>> = items.into_iter().map(|item| plain(item.value)).collect();
            toml::Value::Array(items?)
        }
        Value::Table(table) => {
            let entries = table.0.into_iter().map(|entry| Some((entry.key, plain(entry.node.value)?)));
            toml::Value::Table(entries.collect::<Option<toml::Table>>()?)
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_has_what_is_written_and_what_is_overridden() {
        let text = "schema = 1\n[terrain]\ngenerate = { kind = \"plane\", posts = [3, 3], height_m = 2.5 }\n";
        let change = Override::parse("terrain.generate.height_m=7").unwrap();
        let table = SceneText::parse(text, None, &[change]).unwrap().table().unwrap();
        let made = &table["terrain"]["generate"];
        assert_eq!((made["height_m"].as_integer(), made["posts"][1].as_integer()), (Some(7), Some(3)));
    }
}
