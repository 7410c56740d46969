//! The steps on the way to a pixel's colour.

use super::expansion::AreaId;
use crate::resolve::Paint;
use crate::space::Plan;
use std::fmt;

/// A step on the way to a pixel's colour.
#[derive(Debug, Clone, PartialEq)]
pub enum Step {
    /// The pixel's centre sees the sky.
    Sky,
    /// The pixel's centre sees a point of a triangle (3.2).
    Ground {
        /// The triangle.
        triangle: u32,
        /// The plan point.
        plan: Plan,
        /// The terrain's own paint there.
        paint: Paint,
    },
    /// The pixel's quadrilateral in the plan (3.2): self, right, upper right, upper.
    Range([Plan; 4]),
    /// Its quadrilateral means nothing, so that the pixel takes one sample at its own centre.
    Refused(Refusal),
    /// The edges that meet the quadrilateral (3.3).
    NearEdges(Vec<EdgeOf>),
    /// The pixel's class (3.3).
    Class(PixelClass),
    /// The areas that contain all of the pixel, and those with an edge in it (3.5), in draw order.
    Areas {
        /// The former.
        whole: Vec<AreaId>,
        /// The latter.
        partly: Vec<AreaId>,
    },
    /// A sample of a P pixel (3.4), and in which of the areas with an edge in the pixel it was judged to lie (3.5).
    Sample {
        /// Where it is.
        at: Plan,
        /// The areas.
        within: Vec<AreaId>,
    },
    /// The mean of the samples' colours.
    Mean(Paint),
}

/// Why a quadrilateral means nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Refusal {
    /// A corner of it sees the sky.
    Sky,
    /// One of its sides spans a silhouette.
    Silhouette,
}

/// She's classes of pixels (3.3).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PixelClass {
    /// In no area.
    N = 0,
    /// With an edge.
    P = 1,
    /// Wholly in areas.
    F = 2,
}

/// An edge and the area that it bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgeOf {
    /// The area.
    pub area: AreaId,
    /// Where the edge starts.
    pub from: Plan,
    /// Where it ends.
    pub to: Plan,
}

impl crate::technique::Step for Step {
    fn section(&self) -> &'static str {
        match self {
            Self::Sky | Self::Ground { .. } | Self::Range(_) | Self::Refused(_) => "3.2",
            Self::NearEdges(_) | Self::Class(_) => "3.3",
            Self::Areas { .. } => "3.5",
            Self::Sample { .. } => "3.4, 3.5",
            Self::Mean(_) => "3.4",
        }
    }

    fn place(&self) -> Option<Plan> {
        match self {
            Self::Ground { plan, .. } => Some(*plan),
            Self::Sample { at, .. } => Some(*at),
            _ => None,
        }
    }

    fn items(&self) -> Vec<u32> {
        let of = |areas: &[AreaId]| areas.iter().map(|area| area.item()).collect();
        match self {
            Self::NearEdges(edges) => edges.iter().map(|edge| edge.area.item()).collect(),
            Self::Areas { whole, partly } => of(&[&whole[..], partly].concat()),
            Self::Sample { within, .. } => of(within),
            _ => Vec::new(),
        }
    }
}

impl fmt::Display for Step {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Sky => write!(f, "the centre sees the sky"),
            Self::Ground { triangle, plan, paint } => {
                write!(f, "the centre sees triangle {triangle} at {plan:.3}, painted {paint}")
            }
            Self::Range([a, b, c, d]) => {
                write!(f, "the pixel's quadrilateral is {a:.3} {b:.3} {c:.3} {d:.3}")
            }
            Self::Refused(Refusal::Sky) => write!(f, "refused: a corner of the quadrilateral sees the sky"),
            Self::Refused(Refusal::Silhouette) => write!(f, "refused: the quadrilateral spans a silhouette"),
            Self::NearEdges(edges) => {
                write!(f, "{} edges meet it:", edges.len())?;
                edges.iter().try_for_each(|e| write!(f, " {} from {:.3} to {:.3};", e.area, e.from, e.to))
            }
            Self::Class(class) => write!(f, "class {class:?}"),
            Self::Areas { whole, partly } => {
                write!(f, "wholly in {}, partly in {}", Areas(whole), Areas(partly))
            }
            Self::Sample { at, within } => {
                write!(f, "the sample at {at:.3} lies in {} of the latter", Areas(within))
            }
            Self::Mean(paint) => write!(f, "the mean of the samples is {paint}"),
        }
    }
}

/// Some areas as text.
struct Areas<'a>(&'a [AreaId]);

impl fmt::Display for Areas<'_> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Some((first, others)) = self.0.split_first() else { return f.write_str("none") };
        write!(f, "{first}")?;
        others.iter().try_for_each(|area| write!(f, ", {area}"))
    }
}
