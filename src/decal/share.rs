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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_share_is_what_of_the_pixels_width_across_the_border_lies_inside() {
        // 4 m to the right, 2 m down.
        let pixel =
            PlanPixel { at: Plan::new(10.0, 10.0), steps: [DVec2::new(4.0, 0.0), DVec2::new(0.0, -2.0)] };
        let share = |depth: f64, normal: [f64; 2], thick: f64| pixel.share(depth, normal.into(), thick);
        let far = f64::INFINITY;
        assert_eq!(
            [-1.0, -0.5, 0.0, 0.5, 1.0, 9.0].map(|depth| share(depth, [0.0, 1.0], far)),
            [0.0, 0.25, 0.5, 0.75, 1.0, 1.0]
        );
        // Something 1 m thick, of which the other side counts, too.
        assert_eq!([0.0, 0.5, 1.0, 1.5].map(|depth| share(depth, [0.0, 1.0], 1.0)), [0.5, 0.5, 0.5, 0.25]);
        // Across (0.6, 0.8) it is as wide as its parallelogram: 2.4 m and 1.6 m.
        assert!((share(1.0, [0.6, 0.8], far) - 0.75).abs() < 1e-15);
        // Without a width its middle tells.
        for step in [0.0, f64::INFINITY] {
            let pixel = PlanPixel { at: Plan::new(0.0, 0.0), steps: [DVec2::new(step, 0.0); 2] };
            assert_eq!([-0.1, 0.0, 0.1].map(|depth| pixel.share(depth, DVec2::X, far)), [0.0, 1.0, 1.0]);
        }
    }

    #[test]
    fn the_box_around_a_pixel_has_its_four_corners() {
        let pixel =
            PlanPixel { at: Plan::new(10.0, 10.0), steps: [DVec2::new(4.0, 1.0), DVec2::new(-1.0, 2.0)] };
        let bounds = pixel.bounds();
        assert_eq!((bounds.min, bounds.max), (Plan::new(7.5, 8.5), Plan::new(12.5, 11.5)));
    }
}
