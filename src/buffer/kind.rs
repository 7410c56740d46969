//! What is said of a plane: its name, the space of its numbers, how it looks.

/// A plane that can be asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PlaneKind {
    /// Its name in the contract.
    pub name: &'static str,
    /// Whether it holds plan coordinates: scene-local in memory, absolute in files.
    pub is_in_plan: bool,
    /// Its picture.
    pub look: Look,
    /// Whether it is a structure of the scene, the same in each frame: goldens, which are of pictures and what leads to them, leave it out.
    pub is_structure: bool,
}

/// How a plane's numbers become a picture for people.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Look {
    /// Not at all: it is a table.
    Table,
    /// Grey, dark where least, by the logarithm where all are positive: depths.
    Grey,
    /// A colour for each of some things that have numbers: triangles, tiles.
    Number,
    /// How many there are: dark to light by the logarithm of count + 1.
    Count,
    /// N, P and F pixels (She 2016).
    Class,
    /// The level of a texture: a hue each, mixed between two of them.
    Level,
    /// Plan points, x in red and y in green, repeated. Of several points the middle counts.
    Place,
    /// Colours 0..=1 as themselves.
    Color,
    /// Code values as themselves.
    CodeValues,
}

impl PlaneKind {
    /// View depth in metres, +inf in the sky.
    pub const DEPTH: Self = Self::new("depth", Look::Grey);
    /// Numbers of triangles, `u32::MAX` in the sky.
    pub const TRIANGLE: Self = Self::new("triangle", Look::Number);
    /// Plan points.
    pub const PLAN: Self = Self::new("plan", Look::Place).in_plan();
    /// RGBA, straight alpha.
    pub const COLOR: Self = Self::new("color", Look::Color);

    /// The topmost item at a pixel's middle, `u32::MAX` for none.
    pub const ID: Self = Self::new("id", Look::Number);
    /// Where the rows of each pixel begin in [`Self::IDS`], and after all the number of rows.
    pub const ID_STARTS: Self = Self::new("id-starts", Look::Table);
    /// The items that touch pixels, pixel by pixel, the topmost first.
    pub const IDS: Self = Self::new("ids", Look::Table);
    /// The buffers that say which items touch pixels. Goldens leave them out: they follow from what makes the picture.
    pub const PICKS: [Self; 3] = [Self::ID, Self::ID_STARTS, Self::IDS];

    /// A plane whose numbers are no plan coordinates.
    pub const fn new(name: &'static str, look: Look) -> Self {
        Self { name, is_in_plan: false, look, is_structure: false }
    }

    /// A table of a structure.
    pub const fn structure(name: &'static str) -> Self {
        Self { is_structure: true, ..Self::new(name, Look::Table) }
    }

    /// Whether it is one of [`Self::PICKS`].
    pub fn is_pick(&self) -> bool {
        Self::PICKS.iter().any(|kind| kind.name == self.name)
    }

    /// The same of plan coordinates.
    #[must_use]
    pub const fn in_plan(self) -> Self {
        Self { is_in_plan: true, ..self }
    }
}
