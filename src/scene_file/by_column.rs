//! What a layer says of the attributes of its features: settings that a column tells, conditions, and the draw order.

use crate::scene::{Attribute, Cap, Color, Dash, Join, OutlineMode, Rule};

/// A setting of a style.
#[derive(Debug, Clone, PartialEq)]
pub enum StyleSetting<T> {
    /// The same for all features.
    Constant(T),
    /// Told by a column.
    ByColumn(ByColumn<T>),
}

/// A setting that a column tells.
#[derive(Debug, Clone, PartialEq)]
pub struct ByColumn<T> {
    /// The column.
    pub column: String,
    /// From values to settings.
    pub scale: Scale<T>,
    /// For values that the scale does not have, and for features without a value; `None`: such a feature is refused.
    pub default: Option<T>,
}

/// From a column's values to settings.
#[derive(Debug, Clone, PartialEq)]
pub enum Scale<T> {
    /// Attribute by value, by keys in ascending order. A text is its key; so is `true` or `false`, and any spelling of a number.
    Map(Vec<(String, T)>),
    /// Numbers in ascending order: linear between two of them, the last ones' setting beyond them.
    Stops(Vec<(f64, T)>),
}

impl<T> StyleSetting<T> {
    /// The column that tells it.
    pub fn column(&self) -> Option<&str> {
        match self {
            Self::Constant(_) => None,
            Self::ByColumn(by) => Some(&by.column),
        }
    }
}

/// How features look, as it is written.
#[derive(Debug, Clone, PartialEq)]
pub struct StyleSpec {
    /// The inside of polygons.
    pub fill: Option<FillSpec>,
    /// The border of polygons.
    pub outline: Option<OutlineSpec>,
    /// Lines.
    pub line: Option<LineSpec>,
    /// Points: discs as wide as this.
    pub point: Option<LineSpec>,
}

impl StyleSpec {
    /// The columns that it asks for, possibly several times.
    pub fn columns(&self) -> impl Iterator<Item = &str> {
        let outline = || self.outline.iter().map(|outline| &outline.line);
        let lines = || self.line.iter().chain(outline()).chain(&self.point);
        let paints = self.fill.iter().map(|fill| &fill.paint).chain(lines().map(|line| &line.paint));
        let of_paints = paints.flat_map(|paint| [paint.color.column(), paint.opacity.column()]);
        of_paints.chain(lines().map(|line| line.width.setting().column())).flatten()
    }
}

/// The inside of polygons, as it is written.
#[derive(Debug, Clone, PartialEq)]
pub struct FillSpec {
    /// The colour and its opacity.
    pub paint: PaintSpec,
    /// What is inside.
    pub rule: Rule,
    /// Whether it is not the inside of each polygon that is painted, but what lies outside of all; then no column tells its colour.
    pub is_inverted: bool,
}

/// The border of polygons, as it is written.
#[derive(Debug, Clone, PartialEq)]
pub struct OutlineSpec {
    /// The stroke along the rings.
    pub line: LineSpec,
    /// Which side of the border is drawn.
    pub mode: OutlineMode,
}

/// A stroke, as it is written.
#[derive(Debug, Clone, PartialEq)]
pub struct LineSpec {
    /// The colour and its opacity.
    pub paint: PaintSpec,
    /// How wide.
    pub width: WidthSpec,
    /// How segments meet.
    pub join: Join,
    /// How it ends.
    pub cap: Cap,
    /// Which parts of it are drawn.
    pub dash: Option<Dash>,
}

/// A colour, as it is written.
#[derive(Debug, Clone, PartialEq)]
pub struct PaintSpec {
    /// The colour.
    pub color: StyleSetting<Color>,
    /// What its alpha is multiplied by.
    pub opacity: StyleSetting<f64>,
}

/// A width, as it is written.
#[derive(Debug, Clone, PartialEq)]
pub enum WidthSpec {
    /// Metres in the plan.
    Metres(StyleSetting<f64>),
    /// Pixels on the screen.
    Pixels(StyleSetting<f64>),
}

impl WidthSpec {
    /// The number, whatever its unit.
    pub fn setting(&self) -> &StyleSetting<f64> {
        let (Self::Metres(width) | Self::Pixels(width)) = self;
        width
    }
}

/// What a feature must fulfil to be drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Condition {
    /// The column.
    pub column: String,
    /// What its value must be; a feature without a value never fulfils it.
    pub test: Test,
}

/// What a value must be.
#[derive(Debug, Clone, PartialEq)]
pub enum Test {
    /// One of these.
    OneOf(Vec<Attribute>),
    /// A number within bounds.
    Within(Bounds),
}

/// Bounds of a number; each that is there must hold.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Bounds {
    /// This or more.
    pub min: Option<f64>,
    /// This or less.
    pub max: Option<f64>,
    /// More than this.
    pub above: Option<f64>,
    /// Less than this.
    pub below: Option<f64>,
}

impl Bounds {
    /// Whether a number lies within them.
    pub fn contain(&self, number: f64) -> bool {
        self.min.is_none_or(|min| number >= min)
            && self.max.is_none_or(|max| number <= max)
            && self.above.is_none_or(|above| number > above)
            && self.below.is_none_or(|below| number < below)
    }
}

/// In which order the features of a layer are drawn; of equals, and otherwise, in the file's.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Order {
    /// The file's.
    #[default]
    File,
    /// Larger polygons and longer lines on top, polygons below lines: Zechmeister 2020, 3.2.1 (*Bounding Volume Hierarchies*).
    Size,
    /// By a key.
    By {
        /// By what.
        key: OrderKey,
        /// Whether the greatest is drawn first (below), and not the least.
        descending: bool,
    },
}

/// What features are ordered by.
#[derive(Debug, Clone, PartialEq)]
pub enum OrderKey {
    /// The area of polygons in the plan; of lines it is 0.
    Area,
    /// The length of lines in the plan, of polygons that of their rings.
    Length,
    /// The value in a column; features without one are drawn first whatever the direction.
    Column(String),
}
