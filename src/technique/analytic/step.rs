//! The steps on the way to a pixel's colour.

use super::coverage::Class;
use crate::resolve::Paint;
use std::fmt;

/// A step on the way to a pixel's colour.
#[derive(Debug, Clone, PartialEq)]
pub enum Step {
    /// A part of the pixel sees a part of a triangle, over which the ground has one paint.
    Fragment {
        /// The triangle.
        triangle: u32,
        /// Its share of the pixel.
        area: f64,
        /// Its corners on the screen, pixels.
        corners: Vec<[f64; 2]>,
        /// The terrain's own paint there.
        ground: Paint,
    },
    /// No border of an item lies in the pixel: the mean of the ground that it sees is enough.
    Ground {
        /// How many parts of triangles it sees.
        triangles: u32,
        /// Their share of the pixel.
        area: f64,
        /// Their mean paint.
        ground: Paint,
    },
    /// What cuts the fragment before.
    Edges {
        /// How many parts of edges.
        edges: usize,
        /// The closed form that is taken.
        class: Class,
    },
    /// A set of items covers a share of the fragment before.
    Covered {
        /// The items, in draw order.
        items: Vec<u32>,
        /// The share of the fragment.
        share: f64,
    },
    /// The pixel is sampled.
    Sampled {
        /// Why.
        why: Fallback,
        /// How many samples.
        samples: usize,
    },
    /// A part of the pixel sees the sky.
    Sky {
        /// Its share of the pixel.
        area: f64,
    },
    /// The mean of the pixel's parts.
    Mean(Paint),
}

/// Why a pixel is sampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fallback {
    /// More parts of triangles, or of an image's texels, than `fragments`.
    Fragments,
    /// More parts of edges than `crowd`, or more items than a set has bits.
    Crowd,
    /// A border of a stroke cuts it whose width in pixels is not linear enough in the plan there.
    Width,
}

impl crate::technique::Step for Step {
    fn section(&self) -> &'static str {
        "ours, semantics 7"
    }

    fn items(&self) -> Vec<u32> {
        if let Self::Covered { items, .. } = self { items.clone() } else { Vec::new() }
    }
}

impl fmt::Display for Step {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Fragment { triangle, area, corners, ground } => {
                write!(
                    f,
                    "{:.2} % of the pixel see triangle {triangle}, ground {ground}, between",
                    100.0 * area
                )?;
                corners.iter().try_for_each(|[x, y]| write!(f, " ({x:.4}, {y:.4})"))
            }
            Self::Ground { triangles, area, ground } => {
                let parts = if *triangles == 1 { "part of a triangle" } else { "parts of triangles" };
                let share = 100.0 * area;
                write!(
                    f,
                    "no border lies in the pixel: {share:.2} % of it see {triangles} {parts}, ground {ground}"
                )
            }
            Self::Edges { edges, class } => {
                let form = match class {
                    Class::Point => "a point tells for all of it",
                    Class::Half => "one line cuts it",
                    Class::Band => "two lines cut it that do not cross",
                    Class::Slabs => "it is cut into trapezoids",
                };
                write!(f, "{edges} parts of edges lie in it: {form}")
            }
            Self::Covered { items, share } => {
                let items: Vec<String> = items.iter().map(u32::to_string).collect();
                let items = if items.is_empty() {
                    "the ground alone".into()
                } else {
                    format!("items {}", items.join(", "))
                };
                write!(f, "{:.2} % of it: {items}", 100.0 * share)
            }
            Self::Sampled { why, samples } => {
                let what = match why {
                    Fallback::Fragments => "too many parts of triangles",
                    Fallback::Crowd => "too many parts of edges",
                    Fallback::Width => "a width in pixels bends or grows too fast",
                };
                write!(f, "{what}: {samples} samples tell instead")
            }
            Self::Sky { area } => write!(f, "{:.2} % of the pixel see the sky", 100.0 * area),
            Self::Mean(paint) => write!(f, "the mean of the parts is {paint}"),
        }
    }
}
