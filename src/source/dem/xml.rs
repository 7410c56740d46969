//! Small XML files beside rasters, and in their tags: bounded, as a tree.

use crate::error::{Error, Result};
use roxmltree::{Document, Node, ParsingOptions};

/// The most nodes of a file that are held.
const MOST_NODES: u32 = 1 << 20;

/// The tree of a text.
pub(super) fn parse(text: &str) -> Result<Document<'_>> {
    let options = ParsingOptions { allow_dtd: false, nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    Document::parse_with_options(text.trim_start_matches('\u{feff}').trim_start(), options)
        .map_err(|error| Error::new(format!("the XML cannot be read: {error}")).caused_by(error))
}

/// The text of the first child of a name.
pub(super) fn text_of<'a>(node: Node<'a, '_>, name: &str) -> Option<&'a str> {
    child(node, name)?.text().map(str::trim)
}

/// The first child of a name.
pub(super) fn child<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
    node.children().find(|n| n.has_tag_name(name))
}

/// The number that the first child of a name holds.
pub(super) fn number_of(node: Node<'_, '_>, name: &str) -> Result<Option<f64>> {
    let Some(text) = text_of(node, name) else {
        return Ok(None);
    };
    finite(text).map(Some).ok_or_else(|| Error::new(format!("<{name}> holds `{text}`, which is no number")))
}

/// The finite number that a text spells.
pub(super) fn finite(text: &str) -> Option<f64> {
    text.trim().parse().ok().filter(|number: &f64| number.is_finite())
}
