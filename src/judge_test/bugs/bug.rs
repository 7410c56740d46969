//! What a bug is.

use super::super::edit::Edit;
use crate::technique::Kind;

/// What a bug is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(in super::super) enum Class {
    /// Where features are, and their strokes.
    Geometry,
    /// How volumes are counted.
    Stencil,
    /// Which surface is seen, and from where.
    Visibility,
    /// Where and how often a pixel looks, and how it reads textures.
    Sampling,
    /// Blending and encoding.
    Colour,
    /// Lists, cells and tiles.
    Lists,
}

/// All of them, with their names.
pub(in super::super) const CLASSES: [(Class, &str); 6] = [
    (Class::Geometry, "geometry"),
    (Class::Stencil, "stencil"),
    (Class::Visibility, "visibility"),
    (Class::Sampling, "sampling"),
    (Class::Colour, "colour"),
    (Class::Lists, "lists"),
];

/// A bug.
pub(in super::super) struct Bug {
    /// Its name.
    pub(in super::super) name: &'static str,
    pub(in super::super) class: Class,
    /// Which techniques can have it; none: all.
    pub(in super::super) kinds: &'static [Kind],
    /// What goes wrong.
    pub(in super::super) edit: Edit,
}

impl Bug {
    /// One that any technique can have.
    pub(super) const fn any(class: Class, name: &'static str, edit: Edit) -> Self {
        Self { name, class, kinds: &[], edit }
    }

    /// One of some techniques.
    pub(super) const fn of(kinds: &'static [Kind], class: Class, name: &'static str, edit: Edit) -> Self {
        Self { name, class, kinds, edit }
    }

    /// Whether a technique can have it.
    pub(in super::super) fn can_be_of(&self, kind: Kind) -> bool {
        self.kinds.is_empty() || self.kinds.contains(&kind)
    }
}
