//! The steps on the way to a pixel's colour.

use crate::resolve::Paint;
use crate::space::Plan;
use std::fmt;

/// A step on the way to a pixel's colour. Samples are numbered as the pattern has them.
#[derive(Debug, Clone, PartialEq)]
pub enum Step {
    /// A sample sees the sky.
    Sky {
        /// The sample.
        sample: usize,
    },
    /// A sample sees a point of the terrain, which lies in a cell of the decal grid (Eqs. 4.3, 4.4).
    Sample {
        /// The sample.
        sample: usize,
        /// The triangle that it sees.
        triangle: u32,
        /// The plan point.
        plan: Plan,
        /// The cell; `None`: outside the grid.
        cell: Option<u32>,
        /// The terrain's own paint there.
        ground: Paint,
    },
    /// What the search did for some samples together (Algorithm 3.5).
    Search {
        /// Nodes of the cells' trees that were looked at.
        nodes: u32,
        /// Segments and polygons that samples were compared with.
        leaves: u32,
        /// Nodes of polygons' quadtrees.
        quadtree_nodes: u64,
        /// Edges of polygons.
        edges: u64,
    },
    /// An item holds samples; what is drawn last comes first. What lies below something opaque is not searched for.
    Hit {
        /// The item.
        item: u32,
        /// The samples.
        samples: Vec<usize>,
    },
    /// An item covers a share of the pixel (`edges = "analytic"`); what is drawn first comes first.
    Share {
        /// The item.
        item: u32,
        /// The share.
        share: f64,
    },
    /// The mean of the samples' paints.
    Mean(Paint),
}

impl crate::technique::Step for Step {
    fn section(&self) -> &'static str {
        match self {
            Self::Sky { .. } | Self::Hit { .. } => "4.4.1",
            Self::Sample { .. } => "4.4.1, Eqs. 4.3, 4.4",
            Self::Search { .. } => "3.4.1, Algorithm 3.5",
            Self::Share { .. } | Self::Mean(_) => "4.5",
        }
    }

    fn place(&self) -> Option<Plan> {
        if let Self::Sample { plan, .. } = self { Some(*plan) } else { None }
    }

    fn items(&self) -> Vec<u32> {
        match self {
            Self::Hit { item, .. } | Self::Share { item, .. } => vec![*item],
            _ => Vec::new(),
        }
    }
}

impl fmt::Display for Step {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Sky { sample } => write!(f, "sample {sample} sees the sky"),
            Self::Sample { sample, triangle, plan, cell, ground } => {
                write!(f, "sample {sample} sees ({:.3}, {:.3}) of triangle {triangle}, ", plan.x, plan.y)?;
                match cell {
                    Some(cell) => write!(f, "in cell {cell}, ")?,
                    None => f.write_str("outside the grid, ")?,
                }
                write!(f, "over the ground's {ground}")
            }
            Self::Search { nodes, leaves, quadtree_nodes, edges } => {
                write!(
                    f,
                    "{nodes} nodes, {leaves} leaves, {quadtree_nodes} nodes of quadtrees and {edges} edges were looked at"
                )
            }
            Self::Hit { item, samples } => {
                let samples: Vec<String> = samples.iter().map(usize::to_string).collect();
                write!(f, "item {item} holds samples {}", samples.join(", "))
            }
            Self::Share { item, share } => {
                write!(f, "item {item} covers {:.1} % of the pixel", 100.0 * share)
            }
            Self::Mean(paint) => write!(f, "the mean of the samples is {paint}"),
        }
    }
}
