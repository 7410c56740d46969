//! The steps on the way to a pixel's colour.

use crate::resolve::Paint;
use crate::space::Plan;
use crate::terrain::lod::RightTriangle;
use std::fmt;

/// A step on the way to a pixel's colour. Depths are those of the depth buffer, 0..=1.
#[derive(Debug, Clone, PartialEq)]
pub enum Step {
    /// The pixel's centre sees the sky.
    Sky,
    /// It sees a triangle of the mesh in use.
    Surface {
        /// The triangle.
        triangle: u32,
        /// How often halves of halves are smaller; `None`: the mesh has one level.
        layer: Option<u32>,
        /// The plan point.
        plan: Plan,
        /// The depth that is stored for it, moved back by the polygon offset.
        depth: f64,
    },
    /// A segment of a line or a piece of a fill makes a fragment here.
    Fragment {
        /// The item.
        item: u32,
        /// Whether it is a piece of a fill.
        is_of_fill: bool,
        /// The triangle on which it lies.
        triangle: RightTriangle,
        /// Its depth.
        depth: f64,
        /// The share of the pixel that it covers.
        share: f64,
        /// Whether it is nearer than the surface.
        is_drawn: bool,
    },
    /// What was composed.
    Color(Paint),
}

impl crate::technique::Step for Step {
    fn section(&self) -> &'static str {
        match self {
            Self::Fragment { .. } => "3.2.1, Algorithm 1",
            _ => "3.2.1",
        }
    }

    fn place(&self) -> Option<Plan> {
        if let Self::Surface { plan, .. } = self { Some(*plan) } else { None }
    }

    fn items(&self) -> Vec<u32> {
        if let Self::Fragment { item, .. } = self { vec![*item] } else { Vec::new() }
    }
}

impl fmt::Display for Step {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Sky => f.write_str("the pixel's centre sees the sky"),
            Self::Surface { triangle, layer, plan, depth } => {
                write!(f, "its centre sees ({:.3}, {:.3}) of triangle {triangle}", plan.x, plan.y)?;
                if let Some(layer) = layer {
                    write!(f, " in layer {layer}")?;
                }
                write!(f, ", depth {depth:.9} (moved back)")
            }
            Self::Fragment { item, is_of_fill, triangle, depth, share, is_drawn } => {
                let [i, j] = triangle.apex;
                write!(
                    f,
                    "item {item} covers {:.1} % with a {} on the triangle at post {i}, {j} of layer {}, depth {depth:.9}: {}",
                    100.0 * share,
                    if *is_of_fill { "piece of its fill" } else { "segment" },
                    triangle.layer(),
                    if *is_drawn { "drawn" } else { "behind the surface" }
                )
            }
            Self::Color(paint) => write!(f, "together they make {paint}"),
        }
    }
}
