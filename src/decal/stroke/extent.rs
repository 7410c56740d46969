//! Where a segment may hold points: a box around it, and whether it meets a cell.

use super::exact::{self, Parts};
use super::kind::{Corner, End};
use super::rules::left;
use super::segment::{Segment, TOLERANCE};
use crate::math::{max, min};
use crate::space::{Plan, PlanBox};
use glam::DVec2;

impl Segment {
    /// A box around all points that it holds: the smallest but for rounding.
    pub fn bounds(&self) -> PlanBox {
        let half = self.parts.half;
        let mut all = PlanBox::EMPTY;
        if let Some(corners) = self.rectangle() {
            corners.into_iter().for_each(|p| all.include(p));
        }
        for (at, end) in [self.parts.from, self.parts.to].into_iter().zip(self.parts.ends) {
            if end == End::Round {
                all.include_box(&PlanBox::around([at]).grown(half));
            }
        }
        let wedge = self.wedge();
        if let Some(corners) = wedge {
            corners.into_iter().for_each(|p| all.include(p));
        }
        if all.is_empty() { all } else { all.grown(self.slack(&all, &wedge)) }
    }

    /// Whether it may hold a point of a cell: accurate but for rounding, never false where it holds one. "The segment rectangles and
    /// quadrilaterals are intersected with the cell squares" (4.2.1): each part by separating axes.
    pub fn may_meet(&self, cell: &PlanBox) -> bool {
        let wedge = self.wedge();
        let slack = self.slack(cell, &wedge);
        if self.rectangle().is_some_and(|corners| {
            let n = left(self.unit);
            meets(&corners, &[self.unit, n], cell, slack)
        }) {
            return true;
        }
        for (at, end) in [self.parts.from, self.parts.to].into_iter().zip(self.parts.ends) {
            let nearest =
                Plan::new(between(at.x, cell.min.x, cell.max.x), between(at.y, cell.min.y, cell.max.y));
            if end == End::Round && (nearest - at).length() <= self.parts.half + slack {
                return true;
            }
        }
        wedge.is_some_and(|corners| {
            let [a, b, tip, c] = corners;
            let across = |p: Plan, q: Plan| left(q - p).normalize_or_zero();
            meets(&corners, &[across(a, b), across(b, tip), across(tip, c), across(c, a)], cell, slack)
        })
    }

    /// What rounding may do to its corners and to those of a box. A tip is good to twice the tolerance, of its reach.
    fn slack(&self, plan: &PlanBox, wedge: &Option<[Plan; 4]>) -> f64 {
        let reach =
            wedge.map_or(self.parts.half, |[at, _, third, _]| max((third - at).length(), self.parts.half));
        let size = |p: Plan| max(p.x.abs(), p.y.abs());
        let coordinates = max(max(size(plan.min), size(plan.max)), size(self.parts.from));
        4.0 * TOLERANCE * (coordinates + self.length + reach)
    }

    /// The corners of its rectangle, if it has one.
    fn rectangle(&self) -> Option<[Plan; 4]> {
        let [start, end] = self.span.map(|along| self.parts.from + self.unit * along);
        let aside = left(self.unit) * self.parts.half;
        (self.span[0] <= self.span[1]).then(|| [start + aside, start + -aside, end + -aside, end + aside])
    }

    /// The corners of what closes the gap at its start, its vertex first: of a miter the third is the tip, of a bevel it is on the chord.
    fn wedge(&self) -> Option<[Plan; 4]> {
        let (half, at) = (self.parts.half, self.parts.from);
        let [n1, n2] = [self.into, self.unit].map(|d| left(d) * self.parts.outer);
        let third = match self.parts.corner {
            Corner::Miter => self.tip(n1 + n2),
            Corner::Bevel => (n1 + n2) * (half / 2.0),
            _ => return None,
        };
        Some([at, at + n1 * half, at + third, at + n2 * half])
    }

    /// Where the sides of a miter meet, from its vertex; `middle` is the sum of their unit normals.
    fn tip(&self, middle: DVec2) -> DVec2 {
        let half = self.parts.half;
        let square = middle.length_squared();
        if square > 0.25 {
            return middle * (2.0 * half / square);
        }
        // Sharp: the sum has lost its digits, and so has the sine of the units.
        let Parts { before, from, to, .. } = self.parts;
        let sine = exact::area_doubled(before, from, to).abs() / ((from - before).length() * self.length);
        (self.into - self.unit) * (half / sine)
    }
}

/// Whether a convex polygon may meet a box: no axis of either, of which the polygon's are unit vectors, has them apart by more than `slack`.
fn meets(corners: &[Plan; 4], axes: &[DVec2], cell: &PlanBox, slack: f64) -> bool {
    let own = PlanBox::around(*corners).grown(slack);
    // From a corner of the polygon, so that nothing large cancels.
    let origin = corners[0];
    let is_apart = |axis: &DVec2| {
        let along = corners.map(|p| axis.dot(p - origin));
        let (low, high) = along.into_iter().fold((0.0, 0.0), |(low, high), v| (min(low, v), max(high, v)));
        let pick = |is_upper: bool| {
            let of =
                |component: f64, low: f64, high: f64| if (component > 0.0) == is_upper { high } else { low };
            Plan::new(of(axis.x, cell.min.x, cell.max.x), of(axis.y, cell.min.y, cell.max.y)) - origin
        };
        axis.dot(pick(true)) < low - slack || axis.dot(pick(false)) > high + slack
    };
    own.meets(cell) && !axes.iter().any(is_apart)
}

fn between(v: f64, low: f64, high: f64) -> f64 {
    min(max(v, low), high)
}
