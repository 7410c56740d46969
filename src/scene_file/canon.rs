//! A scene file's hash: of its tree in a fixed order and spelling.
//!
//! The tree and not [`super::SceneFile`] is hashed, so that a scene keeps its hash when a version of drapery knows more
//! keys.

use super::tree::{Node, Table, Value};
use std::fmt::Write;

/// Integers up to here are doubles too, and written the same with and without a point.
const EXACT: f64 = 9_007_199_254_740_992.0;

/// BLAKE3 of the canonical text, in hexadecimal.
pub(super) fn hash(root: &Node) -> String {
    let mut out = String::new();
    write_value(&mut out, &root.value, Names::Left);
    blake3::hash(out.as_bytes()).to_hex().to_string()
}

/// What is done with the key `name` of a table: names of scenes and layers decide nothing.
#[derive(Clone, Copy, PartialEq)]
enum Names {
    Left,
    Kept,
}

fn write_value(out: &mut String, value: &Value, names: Names) {
    match value {
        Value::Text(text) => out.push_str(&serde_json::Value::from(text.as_str()).to_string()),
        Value::Integer(Some(number)) => push(out, number),
        Value::Number(number) if number.floor() == *number && number.abs() <= EXACT => {
            push(out, *number as i64);
        }
        Value::Number(number) => push(out, number),
        Value::Flag(flag) => push(out, flag),
        Value::Array(items) => {
            out.push('[');
            for item in items {
                write_value(out, &item.value, names);
                out.push(',');
            }
            out.push(']');
        }
        Value::Table(table) => write_table(out, table, names),
        // No key takes these: the file is refused.
        Value::Integer(None) | Value::Date => {}
    }
}

/// Writes the entries by key; an empty table says nothing.
fn write_table(out: &mut String, table: &Table, names: Names) {
    let mut entries: Vec<_> = table.0.iter().collect();
    entries.sort_by(|a, b| a.key.cmp(&b.key));
    out.push('{');
    for entry in entries {
        let is_name = names == Names::Left && entry.key == "name";
        let is_empty = matches!(&entry.node.value, Value::Table(Table(inner)) if inner.is_empty());
        if is_name || is_empty {
            continue;
        }
        out.push_str(&serde_json::Value::from(entry.key.as_str()).to_string());
        out.push(':');
        let inner = if entry.key == "layer" { names } else { Names::Kept };
        write_value(out, &entry.node.value, inner);
        out.push(',');
    }
    out.push('}');
}

fn push(out: &mut String, number: impl std::fmt::Display) {
    // Writing into a string cannot fail.
    let _ = write!(out, "{number}");
}

#[cfg(test)]
mod tests {
    use crate::scene_file::{Override, SceneFile};
    use std::path::Path;

    const TEXT: &str = "
schema = 1
name = \"a\"
[image]
width = 64
height = 48
[terrain]
generate = { kind = \"plane\", height_m = 30.0, cell_m = 0.5 }
[[layer]]
name = \"roads\"
features = [{ line = [[-9, 0], [9, 1e3]] }]
line = { color = \"#ff7f00\", width_m = 12.0 }
";

    fn hash(text: &str, path: Option<&str>, overrides: &[&str]) -> String {
        let overrides: Vec<_> = overrides.iter().map(|o| Override::parse(o).unwrap()).collect();
        SceneFile::parse(text, path.map(Path::new), &overrides).unwrap().hash
    }

    #[test]
    fn a_scene_keeps_its_hash_from_version_to_version() {
        let known = "1f1c002c5fc82eaba1091cd598b31e6d422f24173a1ff056fe491e2d50dc7758";
        assert_eq!(hash(TEXT, None, &[]), known);
    }

    #[test]
    fn layout_comments_names_and_the_files_place_do_not_matter() {
        let other = "
name = \"b\" # another name
schema = 1
terrain.generate = { cell_m = 5e-1, height_m = 30, kind = 'plane' }
image = { height = 48, width = 64 }
layer = [{ line = { width_m = 12, color = \"#ff7f00\" }, features = [{ line = [[-9.0, 0], [9, 1000]] }] }]
[device]
";
        assert_eq!(hash(other, Some("some/where.toml"), &[]), hash(TEXT, None, &[]));
    }

    #[test]
    fn an_override_counts_as_if_it_were_written() {
        let written = TEXT.replace("64", "65");
        assert_eq!(hash(TEXT, None, &["image.width=65"]), hash(&written, None, &[]));
    }

    #[test]
    fn every_value_matters() {
        let known = hash(TEXT, None, &[]);
        for change in [
            "image.width=65",
            "terrain.generate.cell_m=0.25",
            "layer.roads.line.color=\"#ff7f01\"",
            "layer.roads.features=[{line=[[-9, 0], [9, 0]]}]",
            "device.precision=f32",
        ] {
            assert_ne!(hash(TEXT, None, &[change]), known, "{change}");
        }
    }
}
