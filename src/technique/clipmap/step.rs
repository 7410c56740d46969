//! The steps on the way to a pixel's colour.

use super::texture::TileKey;
use crate::resolve::Paint;
use crate::space::{Plan, Texel};
use glam::DVec2;
use std::fmt;

/// A step on the way to a pixel's colour.
#[derive(Debug, Clone, PartialEq)]
pub enum Step {
    /// The pixel's centre sees the sky.
    Sky,
    /// The pixel's centre sees a point of a triangle.
    Seen {
        /// The triangle.
        triangle: u32,
        /// The plan point.
        plan: Plan,
    },
    /// Where the pixel reads the texture.
    Probes {
        /// The level that is asked for, between two of them.
        level: f64,
        /// How many probes there are.
        count: u32,
        /// The first one, in the texels of level 0.
        first: Texel,
        /// From a probe to the next.
        step: DVec2,
    },
    /// Texels of one level that are read together: whether a finer level is asked for, and not at hand.
    Level {
        /// The level.
        level: u32,
        /// Whether it is coarser than the one asked for.
        is_fallback: bool,
    },
    /// A texel that is read.
    Texel {
        /// Its tile.
        tile: TileKey,
        /// Its column and row in the tile.
        at: (usize, usize),
        /// The plan point of its centre.
        plan: Plan,
        /// Its weight among all that the pixel reads.
        weight: f64,
        /// What it holds: premultiplied paint.
        value: [f32; 4],
    },
    /// What the pixel reads of the texture in all.
    Texture(Paint),
    /// The terrain's own paint, over which the texture is composed.
    Ground(Paint),
    /// The pixel's paint.
    Composed(Paint),
}

impl crate::technique::Step for Step {
    fn section(&self) -> &'static str {
        match self {
            Self::Texel { .. } => "3, 4",
            _ => "2",
        }
    }

    fn place(&self) -> Option<Plan> {
        match self {
            Self::Seen { plan, .. } | Self::Texel { plan, .. } => Some(*plan),
            _ => None,
        }
    }
}

impl fmt::Display for Step {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Sky => write!(f, "the centre sees the sky"),
            Self::Seen { triangle, plan } => write!(f, "the centre sees triangle {triangle} at {plan:.3}"),
            Self::Probes { level, count, first, step } => {
                write!(
                    f,
                    "{count} probes of level {level:.3} from texel {first:.3}, ({:.3}, {:.3}) apart",
                    step.x, step.y
                )
            }
            Self::Level { level, is_fallback: false } => write!(f, "level {level}"),
            Self::Level { level, is_fallback: true } => write!(f, "level {level}: no finer one is at hand"),
            Self::Texel { tile, at: (x, y), weight, value, .. } => {
                let TileKey { level, row, column } = tile;
                write!(f, "texel {x},{y} of tile {column},{row} of level {level}: {weight:.4} times ")?;
                write!(f, "{}", Paint(value.map(f64::from)))
            }
            Self::Texture(paint) => write!(f, "the texture is {paint}"),
            Self::Ground(paint) => write!(f, "the ground is {paint}"),
            Self::Composed(paint) => write!(f, "together they are {paint}"),
        }
    }
}
