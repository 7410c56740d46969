//! Round borders: discs, and strokes that are all points near a segment.

use super::plane::Plane;
use super::strips::{BEND, CHORD, Off};
use crate::allowed::polygon::diameter;
use crate::math;
use crate::space::{Plan, PlanBox, ViewFrame};
use glam::DVec2;

/// All points within `reach + growth * r` of a segment, r their distance from the eye, metres; of a disc both ends are its centre.
#[derive(Debug, Clone, Copy)]
pub(super) struct Round {
    pub(super) ends: [Plan; 2],
    pub(super) reach: f64,
    pub(super) growth: f64,
}

/// What is round on the screen is no more so than in a plane's tangent map, but for so much.
const TURN: f64 = 1.05;

impl Round {
    /// How long its border is at most in a convex part of the screen that sees a triangle's plane in a box of the plan, and how far it may stray there where
    /// straight ones stray by `straight`; `None`: it does not run there.
    pub(super) fn border(
        &self,
        (frame, plane): (&ViewFrame, &Plane),
        plan: &PlanBox,
        shape: &[DVec2],
        straight: Off,
    ) -> Option<(f64, Off)> {
        let [from, to] = self.ends;
        let half = (plan.max - plan.min) * 0.5;
        let (middle, radius) = (plan.min + half, half.length());
        let along = to - from;
        let length = along.length();
        // How far along the segment the middle lies.
        let foot = if length > 0.0 { (middle - from).dot(along) / length } else { 0.0 };
        let nearest = if length > 0.0 { from + along * (foot.clamp(0.0, length) / length) } else { from };
        let distance = (middle - nearest).length();
        let (low, high, bend) = self.reach_in(frame, plane, plan);
        if distance - radius > high || distance + radius < low {
            return None;
        }
        let (across, around) = (diameter(shape), perimeter(shape));
        if foot - radius >= 0.0 && foot + radius <= length {
            // Beside the segment, or on both of its sides.
            let sides = if distance < radius { 2.0 } else { 1.0 };
            return Some((math::min(TURN * sides * across, around), Off(straight.0 + bend)));
        }
        let end = if foot < 0.5 * length { from } else { to };
        let turn = turn(plane, frame, (middle, radius), middle - end);
        let arc = match turn {
            Some(turn) if turn < 3.0 => across * TURN * bulge(TURN * turn),
            _ => around,
        };
        Some((math::min(arc, around), Off(straight.0 + CHORD + bend)))
    }

    /// How far it reaches in a box, at least and at most, and how far from linear that is, pixels.
    fn reach_in(&self, frame: &ViewFrame, plane: &Plane, plan: &PlanBox) -> (f64, f64, f64) {
        let slack = 1e-9 * self.reach;
        if self.growth == 0.0 {
            return (self.reach - slack, self.reach + slack, 0.0);
        }
        let [low, high] = [plan.min, plan.max];
        let corners = [low, Plan::new(high.x, low.y), high, Plan::new(low.x, high.y)].map(|at| plane.see(at));
        let span = math::max((corners[2] - corners[0]).length(), (corners[3] - corners[1]).length());
        let farthest = corners.iter().map(|at| (*at - frame.eye()).length()).fold(0.0, math::max);
        let nearest = math::max(farthest - span, 0.0);
        // A distance is off its tangent by half the square of the way over itself, at most. On a steep slope, or beside the view's axis, a metre of the plan
        // is more pixels than one that faces the eye: four times as many, and what is more is promised.
        let share = span / nearest;
        let bend = math::min(2.0 * share * share * self.growth / frame.lens().pixel(), BEND);
        let of = |distance: f64| self.reach + self.growth * distance;
        (of(nearest) - slack, of(farthest) + slack, if bend.is_nan() { BEND } else { bend })
    }
}

/// How far a circle turns on the screen within so far of a place that lies so from its middle; `None`: any way.
fn turn(plane: &Plane, frame: &ViewFrame, (at, radius): (Plan, f64), out: DVec2) -> Option<f64> {
    let distance = out.length();
    if distance <= TURN * radius {
        return None;
    }
    let half = math::asin(radius / distance);
    let tangent = out.perp() / distance * radius;
    let (sine, cosine) = (math::sin(half), math::cos(half));
    let on_screen = |by: f64| {
        let way = tangent * cosine + tangent.perp() * by;
        let [a, b] = [-1.0, 1.0].map(|sign| frame.screen_from_world(plane.see(at + way * sign)));
        Some(b? - a?)
    };
    let (first, last) = (on_screen(-sine)?, on_screen(sine)?);
    Some(math::atan2(first.perp_dot(last).abs(), first.dot(last)))
}

/// How much longer than its chord an arc is at most that turns so far.
fn bulge(turn: f64) -> f64 {
    let half = 0.5 * turn;
    if half < 1e-6 { 1.0 } else { half / math::sin(half) }
}

fn perimeter(shape: &[DVec2]) -> f64 {
    let ends = shape.iter().cycle().skip(1);
    shape.iter().zip(ends).map(|(a, b)| (*a - *b).length()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::{Viewpoint, World};
    use crate::terrain::SurfaceTriangle;
    use glam::DVec3;

    /// A pixel a metre, seen from straight above.
    fn map() -> (ViewFrame, Plane) {
        let (eye, target) = (World::new(0.0, 0.0, 90.0), World::new(0.0, 0.0, 0.0));
        let view = Viewpoint { eye, target, up: DVec3::Y, near: 1.0, far: 200.0 };
        let frame = ViewFrame::orthographic(&view, 64.0, (64, 64)).unwrap();
        let corners = [[-40.0, -40.0], [90.0, -40.0], [-40.0, 90.0]].map(|[x, y]| World::new(x, y, 0.0));
        let plane = Plane::of(&frame, &SurfaceTriangle::vertical(corners)).unwrap();
        (frame, plane)
    }

    /// The border in a metre's square with its corner at a place.
    fn border(round: &Round, corner: [f64; 2]) -> Option<(f64, Off)> {
        let (frame, plane) = map();
        let min = Plan::new(corner[0], corner[1]);
        let plan = PlanBox { min, max: min + DVec2::ONE };
        let shape: Vec<DVec2> =
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(DVec2::from_array).into();
        round.border((&frame, &plane), &plan, &shape, Off(0.001))
    }

    #[test]
    fn a_border_runs_only_where_the_reach_ends() {
        let disc = Round { ends: [Plan::new(0.0, 0.0); 2], reach: 10.0, growth: 0.0 };
        assert_eq!([border(&disc, [0.0, 0.0]), border(&disc, [12.0, 0.0])], [None, None]);
        let (length, off) = border(&disc, [9.4, 0.0]).unwrap();
        assert!(length > 1.41 && length < 1.6, "{length}");
        assert_eq!(off, Off(0.001 + CHORD));
    }

    #[test]
    fn beside_a_segment_a_border_is_straight_and_a_thin_line_has_two() {
        let line = |reach| Round { ends: [Plan::new(-20.0, 0.5), Plan::new(20.0, 0.5)], reach, growth: 0.0 };
        let (one, off) = border(&line(3.0), [4.0, 3.0]).unwrap();
        let (both, _) = border(&line(0.2), [4.0, 0.0]).unwrap();
        assert!(one < 1.5 && both > 2.8 && off == Off(0.001), "{one} {both} {off:?}");
        assert!(border(&line(3.0), [4.0, 0.0]).is_none());
    }
}
