//! The steps on the way to a pixel's colour.

use crate::resolve::Paint;
use crate::space::Plan;
use std::fmt;

/// A step on the way to a pixel's colour. Samples are counted in the pixel: column and row of n x n. Passes, volumes: as the technique
/// numbers them, in draw order.
#[derive(Debug, Clone, PartialEq)]
pub enum Step {
    /// A face of a volume crosses a sample's line of sight (4.2.1).
    Crossing {
        /// The sample.
        sample: [usize; 2],
        /// The pass that the volume belongs to.
        pass: u32,
        /// The item that is extruded to it.
        item: u32,
        /// The volume.
        volume: u32,
        /// Whether faces behind the surface are counted (z-fail), for the eye may be in it; else those before it (z-pass).
        is_z_fail: bool,
        /// Whether the volume is entered there.
        is_front: bool,
        /// Whether the face lies behind the surface point: the depth test fails.
        is_behind: bool,
        /// What it does to the count: 1, 0 or -1.
        step: i32,
        /// The count after it.
        count: i32,
    },
    /// The polygon that an outline is cut to has been counted.
    Cut {
        /// The sample.
        sample: [usize; 2],
        /// The count.
        value: u16,
        /// Whether the sample lies in the polygon.
        is_inside: bool,
    },
    /// A pass's mask is applied where its count is not zero (4.2.2).
    Mask {
        /// The sample.
        sample: [usize; 2],
        /// The pass.
        pass: u32,
        /// The items that share it.
        items: Vec<u32>,
        /// The count, which becomes zero.
        value: u16,
        /// What the sample is painted with; `None`: the stencil test fails, or the outline is cut off here.
        paint: Option<Paint>,
    },
    /// A sample is done.
    Sample {
        /// The sample.
        sample: [usize; 2],
        /// The triangle that it sees; `None`: the sky.
        triangle: Option<u32>,
        /// The plan point that it sees.
        plan: Option<Plan>,
        /// Its paint.
        paint: Paint,
    },
    /// The mean of the samples' paints.
    Mean(Paint),
}

impl crate::technique::Step for Step {
    fn section(&self) -> &'static str {
        match self {
            Self::Crossing { .. } => "3.1, 4.2.1",
            Self::Cut { .. } => "4.1",
            Self::Mask { .. } => "4.2.2",
            Self::Sample { .. } | Self::Mean(_) => "4.2.2",
        }
    }

    fn place(&self) -> Option<Plan> {
        if let Self::Sample { plan, .. } = self { *plan } else { None }
    }

    fn items(&self) -> Vec<u32> {
        match self {
            Self::Crossing { item, .. } => vec![*item],
            Self::Mask { items, .. } => items.clone(),
            _ => Vec::new(),
        }
    }
}

impl fmt::Display for Step {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Crossing {
                sample: [x, y],
                pass,
                volume,
                is_z_fail,
                is_front,
                is_behind,
                step,
                count,
                ..
            } => {
                let face = if *is_front { "front" } else { "back" };
                let place = if *is_behind { "behind" } else { "before" };
                write!(
                    f,
                    "sample {x},{y}: pass {pass}: a {face} face of volume {volume} lies {place} the surface: "
                )?;
                let method = if *is_z_fail { "z-fail" } else { "z-pass" };
                write!(f, "{step:+} by {method}, the count is {count}")
            }
            Self::Cut { sample: [x, y], value, is_inside } => {
                let place = if *is_inside { "inside" } else { "outside" };
                write!(f, "sample {x},{y}: {place} the outline's polygon, whose count is {value}")
            }
            Self::Mask { sample: [x, y], pass, value, paint, .. } => {
                write!(f, "sample {x},{y}: the mask of pass {pass} is {value}: ")?;
                match paint {
                    Some(paint) => write!(f, "painted with {paint}"),
                    None => f.write_str("not painted"),
                }
            }
            Self::Sample { sample: [x, y], triangle: Some(triangle), paint, .. } => {
                write!(f, "sample {x},{y} of triangle {triangle} is {paint}")
            }
            Self::Sample { sample: [x, y], triangle: None, paint, .. } => {
                write!(f, "sample {x},{y} of the sky is {paint}")
            }
            Self::Mean(paint) => write!(f, "the mean of the samples is {paint}"),
        }
    }
}
