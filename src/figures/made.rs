//! Figures that were made, and what their panels are called.

use super::figure::{Content, Figure, Panel};

/// A figure and its panels.
pub(super) struct Made {
    pub(super) figure: &'static Figure,
    pub(super) panels: Vec<Panel>,
}

impl Made {
    /// The name of a panel's file.
    pub(super) fn file(&self, panel: usize) -> String {
        let ending = match self.panels[panel].content {
            Content::Picture(_) => "png",
            Content::Drawing(_) => "svg",
        };
        match self.panels.len() {
            1 => format!("{}.{ending}", self.figure.name),
            _ => format!("{}-{}.{ending}", self.figure.name, letter(panel)),
        }
    }
}

/// The letter of a panel: a, b, ...
pub(super) fn letter(panel: usize) -> char {
    u8::try_from(panel).map_or('z', |k| char::from(b'a' + k.min(25)))
}

/// The hash of what a panel shows: of a picture's pixels, of a drawing's text.
pub fn hash(panel: &Panel) -> String {
    match &panel.content {
        Content::Picture(picture) => picture.hash(),
        Content::Drawing(svg) => blake3::hash(svg.as_bytes()).to_hex().to_string(),
    }
}
