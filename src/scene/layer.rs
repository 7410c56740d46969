//! Vector layers and their styles.

use super::{Color, Dash};
use crate::parameter::{Named, words};
use crate::space::Plan;

/// Features of one source, drawn together.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// The layer's name.
    pub name: String,
    /// How its features look: each names one of these.
    pub styles: Vec<Style>,
    /// Its features in draw order.
    pub features: Vec<Feature>,
    /// How much of the layer as a whole is drawn, 0..=1: where its features lie on one another, they do not add up.
    pub opacity: f64,
    /// What all of the terrain that lies outside of every one of its polygons is painted with, once and below its features (an inverted
    /// fill). Of an outline's polygon its rule says what is inside where the style has no fill.
    pub outside: Option<Fill>,
}

/// Items that are composed with one another before they are drawn over what lies below: those of a layer with an opacity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Group {
    /// The layer's number in the scene.
    pub layer: u32,
    /// How much of it is drawn, from 0 and less than 1.
    pub opacity: f64,
}

impl Layer {
    /// A layer whose features all look alike.
    pub fn uniform(name: impl Into<String>, style: Style, features: Vec<Feature>) -> Self {
        Self { name: name.into(), styles: vec![style], features, opacity: 1.0, outside: None }
    }

    /// Whether a line or an outline is so many pixels wide: its footprint then depends on the view.
    pub fn has_width_in_pixels(&self) -> bool {
        let lines = |style: &Style| [style.line, style.point, style.outline.map(|outline| outline.line)];
        let mut lines = self.styles.iter().flat_map(lines).flatten();
        lines.any(|line| matches!(line.width, Width::Pixels(_)))
    }

    /// How one of its features looks.
    ///
    /// # Panics
    /// When the feature is of another layer, with more styles.
    pub fn style_of(&self, feature: &Feature) -> &Style {
        &self.styles[feature.style as usize]
    }
}

/// One feature: a road, a lake.
#[derive(Debug, Clone, PartialEq)]
pub struct Feature {
    /// Its number in the file, from 0.
    pub index: usize,
    /// Which of its layer's styles it has.
    pub style: u32,
    /// Its geometry.
    pub shape: Shape,
}

/// A feature's geometry (scene-local plan coordinates in a [`super::Scene`], the file's own when a source returns it).
///
/// # Guarantees (kept by the sources)
/// Every coordinate is finite. Rings are stored without the closing vertex. Anything may be degenerate: rings of one
/// point, segments of no length, overlaps.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// The rings of a polygon; the layer's rule says what is inside.
    Polygon(Vec<Vec<Plan>>),
    /// The rings of each member of a multi-polygon: the rule says what is inside a member, and what is inside any of them is inside.
    MultiPolygon(Vec<Vec<Vec<Plan>>>),
    /// The polylines of a (multi-)line.
    Line(Vec<Vec<Plan>>),
    /// The points of a (multi-)point.
    Points(Vec<Plan>),
    /// What a stroke covers on a globe: the rings of its members, and the lines (of rings closed ones) that it is along.
    Swath {
        /// Its area, as that of a multi-polygon.
        members: Vec<Vec<Vec<Plan>>>,
        /// Its centre lines.
        lines: Vec<Vec<Plan>>,
    },
}

impl Shape {
    /// Whether it bounds an area.
    pub fn is_area(&self) -> bool {
        matches!(self, Self::Polygon(_) | Self::MultiPolygon(_) | Self::Swath { .. })
    }

    /// Its rings or polylines, those of all members one after the other; all points of points. Of a swath its rings alone.
    pub fn parts(&self) -> impl Iterator<Item = &Vec<Plan>> + Clone {
        let (own, members): (&[Vec<Plan>], &[Vec<Vec<Plan>>]) = match self {
            Self::Polygon(parts) | Self::Line(parts) => (parts, &[]),
            Self::Points(points) => (std::slice::from_ref(points), &[]),
            Self::MultiPolygon(members) | Self::Swath { members, .. } => (&[], members),
        };
        own.iter().chain(members.iter().flatten())
    }
}

/// How a layer's features look. Polygons take `fill` and `outline`, lines take `line`, points take `point`, swaths take `fill`, and have `swath`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Style {
    /// The inside of polygons.
    pub fill: Option<Fill>,
    /// The border of polygons, drawn over the fill.
    pub outline: Option<Outline>,
    /// Lines.
    pub line: Option<Line>,
    /// Points: a disc around each, as wide as this line. (It is one of no length with round caps, whatever its join and cap.)
    pub point: Option<Line>,
    /// What stroke a swath is.
    pub swath: Option<Swath>,
    /// Which parts of outlines are drawn; all of them where there is no pattern.
    pub outline_dash: Option<Dash>,
    /// Which parts of lines are drawn.
    pub line_dash: Option<Dash>,
}

/// What stroke a swath is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Swath {
    /// Its width, metres on the ground.
    pub width_m: f64,
    /// Whether it is one of points.
    pub is_of_points: bool,
}

/// The inside of polygons.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fill {
    /// The colour; its alpha has already been multiplied by the opacity.
    pub color: Color,
    /// What is inside.
    pub rule: Rule,
}

words! {
    /// Which points rings enclose.
    #[derive(Default)]
    pub enum Rule {
        /// Points enclosed an odd number of times.
        #[default]
        EvenOdd = "even-odd",
        /// Points with a winding number other than zero.
        NonZero = "nonzero",
    }
}

impl Rule {
    /// Whether a point around which the rings turn so often is inside.
    #[inline(always)]
    pub fn contains(self, turns: i32) -> bool {
        match self {
            Self::EvenOdd => turns % 2 != 0,
            Self::NonZero => turns != 0,
        }
    }
}

/// The border of polygons.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outline {
    /// The stroke along the rings.
    pub line: Line,
    /// Which side of the border is drawn.
    pub mode: OutlineMode,
}

words! {
    /// Which part of an outline's stroke is drawn.
    #[derive(Default)]
    pub enum OutlineMode {
        /// Its intersection with the inside.
        Inset = "inset",
        /// All of it.
        #[default]
        Normal = "normal",
        /// Its intersection with the outside.
        Offset = "offset",
    }
}

/// A stroke along a polyline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// The colour; its alpha has already been multiplied by the opacity.
    pub color: Color,
    /// How wide.
    pub width: Width,
    /// How segments meet.
    pub join: Join,
    /// How the line ends.
    pub cap: Cap,
}

/// A line's width: whole, not half.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Width {
    /// Metres in the plan (static).
    Metres(f64),
    /// Pixels on the screen (dynamic).
    Pixels(f64),
}

/// How segments meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Join {
    /// A disc of the width's diameter.
    Round,
    /// The strokes' edges run on until they meet, unless farther than `limit` half-widths: then as bevel.
    Miter {
        /// The largest ratio of miter length to width (at least 1).
        limit: f64,
    },
    /// The triangle between the strokes' corners.
    Bevel,
}

/// What is drawn of a stroke's corners and ends, which need not be what its style says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrokeForm {
    /// Between two segments: a word of the style; `miter-round`: a disc where a miter would be longer than its limit; `none`; or a
    /// technique's own word.
    pub join: &'static str,
    /// The longest miter, in half widths.
    pub miter_limit: Option<f64>,
    /// At the ends: a word of the style.
    pub cap: &'static str,
}

impl StrokeForm {
    /// A disc everywhere.
    pub const ROUND: Self = Self { join: "round", miter_limit: None, cap: "round" };

    /// That of a line's style.
    pub fn of_style(line: &Line) -> Self {
        let (join, miter_limit) = match line.join {
            Join::Round => ("round", None),
            Join::Bevel => ("bevel", None),
            Join::Miter { limit } => ("miter", Some(limit)),
        };
        Self { join, miter_limit, cap: line.cap.word() }
    }
}

words! {
    /// How a line ends.
    #[derive(Default)]
    pub enum Cap {
        /// At the end point.
        #[default]
        Butt = "butt",
        /// Half a width on.
        Square = "square",
        /// A half disc.
        Round = "round",
    }
}
