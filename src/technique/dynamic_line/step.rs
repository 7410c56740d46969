//! The steps on the way to a pixel's colour.

use crate::resolve::Paint;
use crate::space::Plan;
use std::fmt;

/// A step on the way to a pixel's colour.
#[derive(Debug, Clone, PartialEq)]
pub enum Step {
    /// The pixel's centre sees the sky.
    Sky,
    /// The pixel's centre sees a point of a triangle.
    Ground {
        /// The triangle.
        triangle: u32,
        /// The plan point.
        plan: Plan,
        /// The size of a pixel there, metres (Eqs. 4.1, 4.2).
        pixel_m: f64,
        /// The terrain's own paint there.
        paint: Paint,
    },
    /// The box of a segment covers the pixel, and its point was tested (4.3.2).
    Tested {
        /// The line's item.
        item: u32,
        /// Where the segment starts.
        from: Plan,
        /// Where it ends.
        to: Plan,
        /// How far the point is from it, metres.
        distance: f64,
        /// Half the line's width there, metres.
        half_width: f64,
        /// What came of it.
        verdict: Verdict,
    },
    /// The list of the pixel as it was composed, from the top: items, and how much of the pixel each covers (4.4.2).
    Composed(Vec<(u32, f64)>),
    /// The composed paint.
    Paint(Paint),
    /// What the filter over the finished picture made of it: encoded, straight alpha (3.5).
    Smoothed([f64; 4]),
}

/// What came of a point-in-line test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Verdict {
    /// The point is not in the line.
    Outside,
    /// So much of the pixel is in the line.
    Inside(f64),
    /// The point is not in the line, but the pixel is near the segment's picture (4.5).
    Thin,
}

impl crate::technique::Step for Step {
    fn section(&self) -> &'static str {
        match self {
            Self::Sky | Self::Paint(_) => "4.4.2",
            Self::Ground { .. } => "4.3.2, Eqs. 4.1, 4.2",
            Self::Tested { verdict: Verdict::Thin, .. } => "4.5",
            Self::Tested { .. } => "4.3.2",
            Self::Composed(_) => "4.3.3, 4.4.2",
            Self::Smoothed(_) => "3.5, 4.5",
        }
    }

    fn place(&self) -> Option<Plan> {
        if let Self::Ground { plan, .. } = self { Some(*plan) } else { None }
    }

    fn items(&self) -> Vec<u32> {
        match self {
            Self::Tested { item, .. } => vec![*item],
            Self::Composed(items) => items.iter().map(|(item, _)| *item).collect(),
            _ => Vec::new(),
        }
    }
}

impl fmt::Display for Step {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Sky => write!(f, "the centre sees the sky"),
            Self::Ground { triangle, plan, pixel_m, paint } => {
                write!(
                    f,
                    "the centre sees triangle {triangle} at {plan:.3}, where a pixel is {pixel_m:.4} m, painted {paint}"
                )
            }
            Self::Tested { item, from, to, distance, half_width, verdict } => {
                let verdict = match verdict {
                    Verdict::Outside => "not in the line".into(),
                    Verdict::Inside(share) => format!("{share} of the pixel is in the line"),
                    Verdict::Thin => "near enough to its picture for a thin line".into(),
                };
                write!(
                    f,
                    "item {item}, segment from {from:.3} to {to:.3}: {distance:.4} m away, half as wide as {half_width:.4} m: {verdict}"
                )
            }
            Self::Composed(items) if items.is_empty() => write!(f, "no line covers it"),
            Self::Composed(items) => {
                write!(f, "from the top:")?;
                items.iter().try_for_each(|(item, share)| write!(f, " item {item} by {share};"))
            }
            Self::Paint(paint) => write!(f, "composed to {paint}"),
            Self::Smoothed([r, g, b, a]) => write!(f, "smoothed to [{r:.4} {g:.4} {b:.4} {a:.4}]"),
        }
    }
}
