//! Which items hold a plan point, in plain doubles where borders are not straight: for point samples.
//!
//! Input: footprints, plan points that lie near one another. Output: the items near them, and of each point which of them hold it. Refuses: nothing; where
//! too much is near, [`Nearby::find`] says so.

use crate::footprint::{BorderPart, Footprints, HalfPlane, Primitive};
use crate::space::{Plan, PlanBox};
use std::ops::Range;

/// Where more parts than this are near a pixel's samples, each sample is asked about alone.
const MOST_PARTS: usize = 64;

/// The items whose boundary is near, or that may hold a whole box of the plan.
#[derive(Debug, Default)]
pub(crate) struct Nearby {
    parts: Vec<BorderPart>,
    strokes: Vec<Primitive>,
    items: Vec<NearItem>,
}

/// An item that some of the points may lie in.
#[derive(Debug)]
pub(crate) struct NearItem {
    /// Its number.
    pub(crate) number: u32,
    polygon: Polygon,
    /// The parts of its stroke that are near.
    strokes: Range<usize>,
}

/// What is known of an item's polygon.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Polygon {
    /// All the points are where the item wants them, or it has no polygon.
    Right,
    /// An edge is near: each point is asked about.
    Open,
    /// None is where the item wants it.
    Wrong,
}

impl Nearby {
    /// Finds the items near some points. False: so much is near that nothing was found out.
    pub(crate) fn find(&mut self, footprints: &Footprints, mut points: impl Iterator<Item = Plan>) -> bool {
        self.parts.clear();
        self.items.clear();
        self.strokes.clear();
        let Some(first) = points.next() else { return true };
        let mut plan = PlanBox::around([first]);
        points.for_each(|p| plan.include(p));
        let found = footprints.parts_near(&plan, |part| {
            self.parts.push(part);
            self.parts.len() < MOST_PARTS
        });
        if found {
            self.fill(footprints, &plan, first);
        }
        found
    }

    /// Finds the items near one point, however many they are.
    pub(crate) fn find_all(&mut self, footprints: &Footprints, at: Plan) {
        self.parts.clear();
        self.items.clear();
        self.strokes.clear();
        if at.is_finite() {
            let plan = PlanBox::around([at]);
            footprints.parts_near(&plan, |part| {
                self.parts.push(part);
                true
            });
            self.fill(footprints, &plan, at);
        }
    }

    /// The items in draw order.
    pub(crate) fn items(&self) -> &[NearItem] {
        &self.items
    }

    /// The items of the parts, and those whose polygon may hold the box; `inside` is one of the points.
    fn fill(&mut self, footprints: &Footprints, plan: &PlanBox, inside: Plan) {
        let mut numbers: Vec<u32> = self.parts.iter().map(|part| part.item).collect();
        footprints.areas_near(plan, |item| numbers.push(item));
        numbers.sort_unstable();
        numbers.dedup();
        self.parts.sort_unstable();
        self.parts.dedup();
        let mut parts = self.parts.iter().peekable();
        for number in numbers {
            let (start, mut has_edge) = (self.strokes.len(), false);
            while let Some(part) = parts.next_if(|part| part.item == number) {
                footprints.primitives(*part, &mut self.strokes);
            }
            let mut end = start;
            for k in start..self.strokes.len() {
                match self.strokes[k] {
                    Primitive::Edge { .. } => has_edge = true,
                    _ => (self.strokes[end], end) = (self.strokes[k], end + 1),
                }
            }
            self.strokes.truncate(end);
            let polygon = match footprints.wants_polygon(number) {
                None => Polygon::Right,
                Some(_) if has_edge => Polygon::Open,
                Some(wanted) if footprints.polygon_holds(number, inside) == wanted => Polygon::Right,
                Some(_) => Polygon::Wrong,
            };
            if polygon != Polygon::Wrong && (end > start || !footprints.wants_stroke(number)) {
                self.items.push(NearItem { number, polygon, strokes: start..end });
            }
        }
    }

    /// Whether an item holds a point; `from_eye` is the distance of its surface point from the eye.
    pub(crate) fn holds(
        &self,
        footprints: &Footprints,
        item: &NearItem,
        (at, from_eye): (Plan, &dyn Fn() -> f64),
    ) -> bool {
        let is_stroked = || self.strokes[item.strokes.clone()].iter().any(|p| is_in(p, at, from_eye));
        if !item.strokes.is_empty() && !is_stroked() {
            return false;
        }
        let wanted = || footprints.wants_polygon(item.number);
        item.polygon == Polygon::Right
            || wanted().is_none_or(|wanted| footprints.polygon_holds(item.number, at) == wanted)
    }
}

/// Whether a part of a stroke holds a point.
fn is_in(part: &Primitive, at: Plan, from_eye: &dyn Fn() -> f64) -> bool {
    match part {
        Primitive::Edge { .. } => false,
        Primitive::Convex(shape) | Primitive::Perhaps(shape) => {
            shape.sides().iter().all(|side| is_inside(side, at))
        }
        Primitive::Near { from, to, scale, reach, growth } => {
            let reach = if *growth == 0.0 { *reach } else { reach + growth * from_eye() };
            distance([at, *from, *to].map(|p| Plan::from(p.to_vec() * *scale))) <= reach
        }
    }
}

fn is_inside(side: &HalfPlane, at: Plan) -> bool {
    let d = at - side.at;
    side.normal[0].mid * d.x + side.normal[1].mid * d.y + side.offset.mid >= 0.0
}

/// The distance of a point from a segment.
fn distance([at, from, to]: [Plan; 3]) -> f64 {
    let (along, d) = (to - from, at - from);
    let length = along.length_squared();
    let t = if length > 0.0 { (d.dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
    (d - along * t).length()
}
