//! Strokes as convex pieces of the plan.
use crate::scene::Line;
use crate::space::{Plan, PlanBox};
use glam::DVec2;
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Segment {
    pub before: Option<Plan>,
    pub from: Plan,
    pub to: Plan,
    pub is_last: bool,
}
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct HalfWidth {
    pub at: Plan,
    pub half: f64,
    pub gradient: DVec2,
}
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Near {
    pub plan: PlanBox,
    pub sagitta: f64,
}
#[derive(Debug, Default)]
pub(super) struct Pieces {
    corners: Vec<Plan>,
    ends: Vec<usize>,
}
impl Pieces {
    pub fn clear(&mut self) {
        self.corners.clear();
        self.ends.clear();
    }
    pub fn rings(&self) -> impl Iterator<Item = &[Plan]> {
        let mut first = 0;
        self.ends.iter().map(move |end| {
            let ring = &self.corners[first..*end];
            first = *end;
            ring
        })
    }
}
pub(super) fn stroke_pieces(s: &Segment, _: &Line, half: HalfWidth, _: &Near, out: &mut Pieces) {
    let along = (s.to - s.from).try_normalize().unwrap_or(DVec2::X);
    let n = along.perp() * half.half;
    out.corners.extend([s.from + -n, s.to + -n, s.to + n, s.from + n]);
    out.ends.push(out.corners.len());
}
pub(super) fn segment_box(s: &Segment, _: &Line, most: f64) -> PlanBox {
    PlanBox::around([s.from, s.to]).grown(3.0 * most)
}
