//! What a pixel and its surroundings see, as polygons on the screen and in the plan: of the terrain's triangles, and of items' borders on them.

use super::bench::{Bench, Near, twice_area};
use crate::footprint::{BorderPart, HalfPlane, Primitive};
use crate::math;
use crate::space::{Plan, PlanBox, Screen};
use crate::terrain::SKY;
use crate::truth::SeenPiece;
use glam::DVec2;
use serde::Serialize;

/// Corners of what stands for a disc.
const DISC: usize = 48;

/// The most parts of borders on one piece.
const MOST_PARTS: usize = 256;

/// What a pixel and its surroundings see. Screen coordinates are pixels of the picture.
#[derive(Debug, Clone, PartialEq, Serialize, Default)]
pub struct Scenery {
    /// Convex pieces that see one triangle, or the sky; those of the pixel first.
    pub pieces: Vec<Piece>,
    /// What bounds items there.
    pub shapes: Vec<Shape>,
}

/// A piece that sees one triangle.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Piece {
    /// The triangle's number; none: the sky.
    pub triangle: Option<u32>,
    /// Its corners on the screen.
    pub screen: Vec<[f64; 2]>,
    /// Its corners in the plan; none in the sky.
    pub plan: Vec<[f64; 2]>,
    /// The share of the pixel that it takes; 0: it lies in another pixel.
    pub share: f64,
}

/// A part of an item on a piece.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Shape {
    /// The item's number in the draw list.
    pub item: u32,
    /// Whether it is a part of the item's stroke; else a border of its area.
    pub is_area: bool,
    /// Its corners on the screen, or both ends.
    pub screen: Vec<[f64; 2]>,
    /// Its corners in the plan.
    pub plan: Vec<[f64; 2]>,
}

impl Scenery {
    pub(super) fn of(bench: &Bench, near: &Near) -> Self {
        let mut all = Self::default();
        for piece in &near.pieces {
            let middle = middle_of(&piece.corners);
            let is_own = [middle.x, middle.y].map(|v| v.floor() as usize) == near.pixel;
            let plan = plan_of(bench, piece);
            if let Some(plan) = &plan {
                add_shapes(bench, (piece.triangle, plan), &mut all.shapes);
            }
            all.pieces.push(Piece {
                triangle: (piece.triangle != SKY).then_some(piece.triangle),
                screen: piece.corners.iter().map(|at| [at.x, at.y]).collect(),
                plan: plan.unwrap_or_default().iter().map(|at| bench.absolute(*at)).collect(),
                share: if is_own { 0.5 * twice_area(&piece.corners).abs() } else { 0.0 },
            });
        }
        all
    }
}

fn middle_of(corners: &[Screen]) -> Screen {
    let sum = corners.iter().fold(DVec2::ZERO, |sum, at| sum + at.to_vec());
    Screen::from(sum / corners.len().max(1) as f64)
}

/// The corners of a piece in the plan; `None`: the sky, or a triangle that is seen edge-on.
fn plan_of(bench: &Bench, piece: &SeenPiece) -> Option<Vec<Plan>> {
    let corners = piece.corners.iter();
    corners.map(|at| bench.on_triangle(piece.triangle, *at).map(|seen| seen.hit.plan)).collect()
}

/// Adds the parts of items' borders on a piece.
fn add_shapes(bench: &Bench, (triangle, piece): (u32, &[Plan]), shapes: &mut Vec<Shape>) {
    let (mut parts, mut room) = (Vec::<BorderPart>::new(), Vec::new());
    bench.footprints.parts_near(&PlanBox::around(piece.iter().copied()), |part| {
        parts.push(part);
        parts.len() < MOST_PARTS
    });
    parts.sort_unstable();
    parts.dedup();
    for part in parts {
        room.clear();
        bench.footprints.primitives(part, &mut room);
        for primitive in &room {
            let (is_area, plan) = cut(bench, primitive, (triangle, piece));
            let screen: Option<Vec<Screen>> =
                plan.iter().map(|at| bench.screen_over(triangle, *at)).collect();
            if let Some(screen) = screen.filter(|screen| screen.len() > 1) {
                shapes.push(Shape {
                    item: part.item,
                    is_area,
                    screen: screen.iter().map(|at| [at.x, at.y]).collect(),
                    plan: plan.iter().map(|at| bench.absolute(*at)).collect(),
                });
            }
        }
    }
}

/// What a piece has of a primitive: whether that is an area, and its corners.
fn cut(bench: &Bench, primitive: &Primitive, (triangle, piece): (u32, &[Plan])) -> (bool, Vec<Plan>) {
    let lines = |shape: &[HalfPlane]| shape.iter().map(line_of).collect::<Vec<Line>>();
    match primitive {
        Primitive::Edge { from, to } => (false, segment_in(*from, *to, piece)),
        Primitive::Convex(shape) | Primitive::Perhaps(shape) => (true, clipped(piece, &lines(shape.sides()))),
        Primitive::Near { from, to, scale, reach, growth } => {
            let from_eye = bench.eye_distance_over(triangle, middle_of_plan(piece)).unwrap_or(0.0);
            (true, clipped(piece, &capsule([*from, *to], *scale, reach + growth * from_eye)))
        }
    }
}

fn middle_of_plan(piece: &[Plan]) -> Plan {
    let sum = piece.iter().fold(DVec2::ZERO, |sum, at| sum + at.to_vec());
    Plan::from(sum / piece.len().max(1) as f64)
}

/// A line: what is inside of it is where `normal . (p - at) + offset` is not negative.
#[derive(Debug, Clone, Copy)]
struct Line {
    at: Plan,
    normal: DVec2,
    offset: f64,
}

impl Line {
    fn inside(&self, at: Plan) -> f64 {
        self.normal.dot(at - self.at) + self.offset
    }
}

fn line_of(side: &HalfPlane) -> Line {
    Line { at: side.at, normal: DVec2::new(side.normal[0].mid, side.normal[1].mid), offset: side.offset.mid }
}

/// The sides of a polygon around all within `radius` of a segment.
fn capsule([from, to]: [Plan; 2], scale: DVec2, radius: f64) -> Vec<Line> {
    let sides = (0..DISC).map(|k| {
        let angle = std::f64::consts::TAU * k as f64 / DISC as f64;
        let out = DVec2::new(math::cos(angle), math::sin(angle));
        let normal = out * scale;
        let at = if normal.dot(to - from) > 0.0 { to } else { from };
        Line { at, normal: -normal, offset: radius }
    });
    sides.collect()
}

/// What of a convex polygon lies inside of some lines.
fn clipped(polygon: &[Plan], lines: &[Line]) -> Vec<Plan> {
    let mut rest = polygon.to_vec();
    for line in lines {
        let mut kept = Vec::with_capacity(rest.len() + 1);
        for (a, b) in rest.iter().zip(rest.iter().cycle().skip(1)) {
            let (of_a, of_b) = (line.inside(*a), line.inside(*b));
            if of_a >= 0.0 {
                kept.push(*a);
            }
            if (of_a >= 0.0) != (of_b >= 0.0) {
                kept.push(*a + (*b - *a) * (of_a / (of_a - of_b)));
            }
        }
        rest = kept;
    }
    if rest.len() > 2 { rest } else { Vec::new() }
}

/// What of a segment lies in a convex polygon.
fn segment_in(from: Plan, to: Plan, polygon: &[Plan]) -> Vec<Plan> {
    let turn =
        polygon.windows(2).map(|pair| (pair[0] - polygon[0]).perp_dot(pair[1] - polygon[0])).sum::<f64>();
    let (mut low, mut high) = (0.0, 1.0);
    for (a, b) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
        let normal = (*b - *a).perp() * turn.signum();
        let (of_from, of_to) = (normal.dot(from - *a), normal.dot(to - *a));
        match (of_from >= 0.0, of_to >= 0.0) {
            (false, false) => return Vec::new(),
            (true, true) => {}
            (true, false) => high = math::min(of_from / (of_from - of_to), high),
            (false, true) => low = math::max(of_from / (of_from - of_to), low),
        }
    }
    if low < high { vec![from + (to - from) * low, from + (to - from) * high] } else { Vec::new() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> Vec<Plan> {
        [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)].map(|(x, y)| Plan::new(x, y)).to_vec()
    }

    #[test]
    fn a_segment_is_cut_to_a_polygon_whichever_way_that_turns() {
        let mut turned = square();
        turned.reverse();
        for polygon in [square(), turned] {
            let across = segment_in(Plan::new(-2.0, 1.0), Plan::new(6.0, 3.0), &polygon);
            assert_eq!(across, [Plan::new(0.0, 1.5), Plan::new(4.0, 2.5)]);
            assert!(segment_in(Plan::new(5.0, 0.0), Plan::new(5.0, 4.0), &polygon).is_empty());
        }
    }

    #[test]
    fn a_capsule_has_the_area_of_its_segment_and_disc() {
        let wide = [(-50.0, -50.0), (50.0, -50.0), (50.0, 50.0), (-50.0, 50.0)].map(|(x, y)| Plan::new(x, y));
        let shape = clipped(&wide, &capsule([Plan::new(0.0, 0.0), Plan::new(10.0, 0.0)], DVec2::ONE, 2.0));
        let area: f64 =
            shape.windows(2).map(|p| (p[0] - shape[0]).perp_dot(p[1] - shape[0])).sum::<f64>() / 2.0;
        let exact = 40.0 + std::f64::consts::PI * 4.0;
        assert!(area >= exact && area < 1.003 * exact, "{area} {exact}");
    }
}
