//! Lines -> the convex pieces of the plan that their volumes stand on (4.1: "each line segment separately").
//!
//! Input: polylines, a width, what joins are asked for. Output: rings of the corners of pieces, counter-clockwise, rounded to
//! doubles: *these* corners are the stroke's footprint. A piece is the rectangle of a segment and, where `joins = "style"`
//! asks for it, the triangle of a bevel, the quadrilateral of a miter or the disc of a round join or cap (a polygon of
//! [`DISC_CORNERS`](crate::space::DISC_CORNERS) corners). The union of the pieces is the stroke. Refuses: nothing; pieces without area are left out.

use crate::predicate::orient2d;
use crate::scene::{Cap, Join, Line, Width};
use crate::space::{Plan, disc_corners};
use crate::technique::stencil_volume::VolumeJoins;
use glam::DVec2;

/// Takes the rings of pieces.
pub type Emit<'a> = dyn FnMut(&[Plan]) + 'a;

/// How a line is drawn.
#[derive(Debug, Clone, Copy)]
pub struct Stroke {
    half: f64,
    joins: VolumeJoins,
    join: Join,
    cap: Cap,
}

impl Stroke {
    /// A line's stroke; `None` for a width on the screen, which the technique refuses beforehand.
    pub fn new(line: &Line, joins: VolumeJoins) -> Option<Self> {
        match line.width {
            Width::Metres(width) => Some(Self { half: width / 2.0, joins, join: line.join, cap: line.cap }),
            Width::Pixels(_) => None,
        }
    }

    /// The pieces of a chain's path, whose consecutive points are distinct; `is_closed`: the last one is the first one.
    pub fn pieces(&self, path: &[Plan], is_closed: bool, emit: &mut Emit) {
        match path {
            [only] => self.dot(*only, emit),
            _ => self.chain(path, is_closed, emit),
        }
    }

    fn chain(&self, points: &[Plan], is_closed: bool, emit: &mut Emit) {
        let last = points.len().saturating_sub(2);
        for (k, pair) in points.windows(2).enumerate() {
            let (a, b) = (pair[0], pair[1]);
            let Some(along) = (b - a).try_normalize().map(|d| d * self.half) else { continue };
            let is_square = self.cap == Cap::Square && !is_closed;
            let a = if is_square && k == 0 { a + -along } else { a };
            let b = if is_square && k == last { b + along } else { b };
            let left = DVec2::new(-along.y, along.x);
            convex(&[a + -left, b + -left, b + left, a + left], emit);
        }
        if self.joins == VolumeJoins::Style {
            points.windows(3).for_each(|p| self.join([p[0], p[1], p[2]], emit));
            if let (true, [first, second, .., before, _]) = (is_closed, points) {
                self.join([*before, *first, *second], emit);
            }
            if let (true, [first, second, _]) = (is_closed, points) {
                self.join([*second, *first, *second], emit);
            }
            if let (false, Cap::Round, [first, .., end]) = (is_closed, self.cap, points) {
                self.disc(*first, emit);
                self.disc(*end, emit);
            }
        }
    }

    /// What lies between the ends of two segments.
    fn join(&self, [before, at, after]: [Plan; 3], emit: &mut Emit) {
        let directions = ((at - before).try_normalize(), (after - at).try_normalize());
        let (Some(into), Some(out)) = directions else { return };
        let turn = into.perp_dot(out);
        // The outer corners lie right of a left turn.
        let outer = if turn > 0.0 { -self.half } else { self.half };
        let corner = |d: DVec2| at + DVec2::new(-d.y, d.x) * outer;
        let (first, second) = (corner(into), corner(out));
        let bevel = [at, first, second];
        match self.join {
            Join::Round => self.disc(at, emit),
            Join::Bevel => convex(&bevel, emit),
            Join::Miter { limit } => {
                // The miter's length is 1 / cos(half the turn) half-widths: 2 / (1 + cos) is its square.
                let cosine = into.dot(out);
                if 2.0 > limit * limit * (1.0 + cosine) {
                    return convex(&bevel, emit);
                }
                let tip = at + ((first - at) + (second - at)) / (1.0 + cosine);
                convex(&[at, first, tip, second], emit);
            }
        }
    }

    /// A line without length: a dot by its cap (only where the style is asked for).
    fn dot(&self, at: Plan, emit: &mut Emit) {
        let h = self.half;
        match (self.joins, self.cap) {
            (VolumeJoins::Style, Cap::Round) => self.disc(at, emit),
            (VolumeJoins::Style, Cap::Square) => {
                let corner = |x: f64, y: f64| at + DVec2::new(x, y);
                convex(&[corner(-h, -h), corner(h, -h), corner(h, h), corner(-h, h)], emit);
            }
            _ => {}
        }
    }

    fn disc(&self, at: Plan, emit: &mut Emit) {
        convex(&disc_corners(at, self.half), emit);
    }
}

/// Emits a convex ring counter-clockwise; one without area, or whose corners rounding has put out of order, not at all.
fn convex(ring: &[Plan], emit: &mut Emit) {
    let turns = || (0..ring.len()).map(|k| orient2d(ring[k], at(ring, k + 1), at(ring, k + 2)));
    if turns().all(|turn| turn > 0.0) {
        emit(ring);
    } else if turns().all(|turn| turn < 0.0) {
        emit(&ring.iter().rev().copied().collect::<Vec<_>>());
    }
}

fn at(ring: &[Plan], k: usize) -> Plan {
    ring[k % ring.len()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Color;

    fn pieces(points: &[(f64, f64)], join: Join, cap: Cap, joins: VolumeJoins) -> Vec<Vec<(f64, f64)>> {
        let line = Line { color: Color([1.0; 4]), width: Width::Metres(2.0), join, cap };
        let points: Vec<Plan> = points.iter().map(|&(x, y)| Plan::new(x, y)).collect();
        let mut out = Vec::new();
        let mut emit = |ring: &[Plan]| out.push(ring.iter().map(|p| (p.x, p.y)).collect());
        Stroke::new(&line, joins).unwrap().pieces(&points, false, &mut emit);
        out
    }

    #[test]
    fn a_segment_is_a_rectangle_that_runs_counter_clockwise() {
        let out = pieces(&[(0.0, 0.0), (4.0, 0.0)], Join::Round, Cap::Butt, VolumeJoins::None);
        assert_eq!(out, [[(0.0, -1.0), (4.0, -1.0), (4.0, 1.0), (0.0, 1.0)]]);
    }

    #[test]
    fn a_right_angle_has_no_join_unless_it_is_asked_for() {
        let corner = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0)];
        let by = |join, joins| pieces(&corner, join, Cap::Butt, joins);
        assert_eq!(by(Join::Bevel, VolumeJoins::None).len(), 2);
        let miter = Join::Miter { limit: 4.0 };
        assert_eq!(by(Join::Bevel, VolumeJoins::Style)[2], [(4.0, 0.0), (4.0, -1.0), (5.0, 0.0)]);
        assert_eq!(by(miter, VolumeJoins::Style)[2], [(4.0, 0.0), (4.0, -1.0), (5.0, -1.0), (5.0, 0.0)]);
        assert_eq!(by(Join::Miter { limit: 1.2 }, VolumeJoins::Style)[2].len(), 3, "over the limit: bevel");
        assert_eq!(by(Join::Round, VolumeJoins::Style)[2].len(), crate::space::DISC_CORNERS);
    }

    #[test]
    fn a_line_that_turns_back_keeps_its_pieces_finite() {
        let back = [(0.0, 0.0), (10.0, 0.0), (2.0, 0.0)];
        let out = pieces(&back, Join::Miter { limit: 4.0 }, Cap::Butt, VolumeJoins::Style);
        assert!(out.iter().flatten().all(|p| p.0.abs() <= 10.0 && p.1.abs() <= 1.0), "{out:?}");
    }

    #[test]
    fn square_caps_reach_half_a_width_on_and_points_without_length_have_none() {
        let out = pieces(&[(0.0, 0.0), (4.0, 0.0)], Join::Bevel, Cap::Square, VolumeJoins::None);
        assert_eq!(out[0][0], (-1.0, -1.0));
        assert!(pieces(&[(1.0, 1.0), (1.0, 1.0)], Join::Bevel, Cap::Square, VolumeJoins::None).is_empty());
        assert_eq!(pieces(&[(1.0, 1.0)], Join::Bevel, Cap::Round, VolumeJoins::Style).len(), 1);
    }
}
