//! Sets of plan points that a ray may end in, as far as straight lines can tell.

use crate::math;
use crate::space::{Plan, PlanBox};
use glam::DVec2;

/// The least and the greatest of a number.
pub(super) type Range = [f64; 2];

pub(super) const NOWHERE: Range = [f64::INFINITY, f64::NEG_INFINITY];

/// Around two ranges.
pub(super) fn around(a: Range, b: Range) -> Range {
    [math::min(a[0], b[0]), math::max(a[1], b[1])]
}

/// A piece of a [`Place`]: the hull of some points, and of what is in the box and, if they are known, between corners.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Patch {
    pub(super) plan: PlanBox,
    /// Corners around it; none: the box's.
    pub(super) corners: Option<[Plan; 4]>,
    /// Places of it that may lie beyond.
    pub(super) others: Vec<Plan>,
}

impl Patch {
    fn ends(&self, from: Plan, way: DVec2) -> Range {
        let at = |p: &Plan| way.dot(*p - from);
        let of = |points: &[Plan]| {
            points.iter().map(at).fold(NOWHERE, |all, v| [math::min(v, all[0]), math::max(v, all[1])])
        };
        let (min, max) = (self.plan.min, self.plan.max);
        let boxed = of(&[min, max, Plan::new(min.x, max.y), Plan::new(max.x, min.y)]);
        let within = self.corners.map_or(boxed, |corners| {
            let hull = of(&corners);
            [math::max(boxed[0], hull[0]), math::min(boxed[1], hull[1])]
        });
        // Both hold all of it: only rounding leaves nothing.
        let within = if within[0] <= within[1] { within } else { boxed };
        around(within, of(&self.others))
    }

    /// A box around it.
    pub(super) fn bounds(&self) -> PlanBox {
        let mut all = self.plan;
        self.others.iter().for_each(|p| all.include(*p));
        all
    }
}

/// A set of plan points.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Place(pub(super) Vec<Patch>);

impl Place {
    /// How far its points lie along a way from a point.
    pub(super) fn along(&self, from: Plan, way: DVec2) -> Range {
        self.0.iter().fold(NOWHERE, |all, patch| around(all, patch.ends(from, way)))
    }

    /// A point of it.
    pub(super) fn point(&self) -> Plan {
        let Some(patch) = self.0.first() else { return Plan::default() };
        let PlanBox { min, max } = patch.plan;
        patch.others.first().copied().unwrap_or_else(|| min + (max - min) * 0.5)
    }

    /// A box around it.
    pub(super) fn bounds(&self) -> PlanBox {
        let mut all = PlanBox::EMPTY;
        self.0.iter().for_each(|patch| all.include_box(&patch.bounds()));
        all
    }
}

/// The least and the greatest distance of a point of one box from a point of another.
pub(super) fn distances(a: &PlanBox, b: &PlanBox) -> Range {
    let gap = |low: f64, high: f64| math::max(math::max(low, high), 0.0);
    let apart =
        DVec2::new(gap(a.min.x - b.max.x, b.min.x - a.max.x), gap(a.min.y - b.max.y, b.min.y - a.max.y));
    let reach = DVec2::new(
        math::max(a.max.x - b.min.x, b.max.x - a.min.x),
        math::max(a.max.y - b.min.y, b.max.y - a.min.y),
    );
    [apart.length(), reach.length()]
}

/// What a number may be that is the bilinear mean, at (u, v), of numbers at a quadrilateral's corners: self, right, upper right, upper.
pub(super) fn bilinear([a, b, c, d]: &[Range; 4], u: f64, v: f64) -> Range {
    [0, 1].map(|end| (a[end] * (1.0 - u) + b[end] * u) * (1.0 - v) + (d[end] * (1.0 - u) + c[end] * u) * v)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slanted_patch_is_narrower_across_than_its_box() {
        let corners = [(0.0, 0.0), (0.1, -0.1), (2.1, 1.9), (2.0, 2.0)].map(|(x, y)| Plan::new(x, y));
        let patch = Patch { plan: PlanBox::around(corners), corners: Some(corners), others: Vec::new() };
        let across = DVec2::new(1.0, -1.0).normalize();
        let [low, high] = Place(vec![patch]).along(Plan::default(), across);
        assert!(low.abs() < 1e-12 && (high - 0.2 / 2f64.sqrt()).abs() < 1e-12, "{low} {high}");
    }

    #[test]
    fn boxes_are_as_far_apart_as_their_nearest_and_farthest_points() {
        let a = PlanBox { min: Plan::new(0.0, 0.0), max: Plan::new(1.0, 1.0) };
        let b = PlanBox { min: Plan::new(4.0, 5.0), max: Plan::new(5.0, 7.0) };
        assert_eq!(distances(&a, &b), [5.0, (25.0f64 + 49.0).sqrt()]);
        assert_eq!(distances(&a, &a)[0], 0.0);
    }
}
