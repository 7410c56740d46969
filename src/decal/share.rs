//! Pixels as parallelograms of the plan, and the shares of them that items cover.

use crate::math;
use crate::space::{Plan, PlanBox};
use glam::DVec2;

/// What a pixel sees of the plan: its middle, and how that moves by a pixel to the right and down.
#[derive(Debug, Clone, Copy)]
pub struct PlanPixel {
    /// The plan point of its centre.
    pub at: Plan,
    /// By a pixel to the right, and down, metres.
    pub steps: [DVec2; 2],
}

impl PlanPixel {
    /// How far it reaches along a direction of length 1.
    fn width(&self, along: DVec2) -> f64 {
        self.steps.iter().map(|step| step.dot(along).abs()).sum()
    }

    /// The box around it.
    pub(super) fn bounds(&self) -> PlanBox {
        let half = (self.steps[0].abs() + self.steps[1].abs()) * 0.5;
        PlanBox { min: self.at + -half, max: self.at + half }
    }

    /// The share of it on the inner side of a straight border, `depth` metres inside of which it has its middle, of something that is `thick`.
    pub(super) fn share(&self, depth: f64, normal: DVec2, thick: f64) -> f64 {
        let width = self.width(normal);
        if width <= 0.0 || !width.is_finite() {
            return if depth >= 0.0 { 1.0 } else { 0.0 };
        }
        let (low, high) = (math::max(depth - 0.5 * width, 0.0), math::min(depth + 0.5 * width, thick));
        math::min(math::max((high - low) / width, 0.0), 1.0)
    }
}

/// Which share of a pixel each item covers.
#[derive(Debug, Default)]
pub struct Shares {
    /// What is drawn first comes first.
    pub(super) found: Vec<(u32, f64)>,
    /// Areas with an edge near: the owner, the nearest edge's distance, and its normal.
    pub(super) edges: Vec<(u32, f64, DVec2)>,
}

impl Shares {
    /// The items and the shares that they cover, what is drawn first coming first.
    pub fn found(&self) -> &[(u32, f64)] {
        &self.found
    }
}
