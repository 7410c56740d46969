//! What lies far outside a window is cut off: rings keep their windings inside, lines become the parts that are near.
//!
//! J. D. Foley, A. van Dam, S. K. Feiner, J. F. Hughes, *Computer Graphics: Principles and Practice* (1990), 3.14: Sutherland and
//! Hodgman's algorithm, side by side of the window. A new vertex depends on its edge alone, not on the edge's direction, so that
//! neighbours still share their edges.

use crate::space::{Plan, PlanBox};
use glam::DVec2;

/// What is kept: points on one side of a line along an axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Side {
    /// Whether the line is one of constant y, else of constant x.
    pub(super) is_level: bool,
    /// Its coordinate.
    pub(super) at: f64,
    /// Whether what lies above is kept.
    pub(super) above: bool,
}

impl Side {
    fn keeps(&self, p: Plan) -> bool {
        let v = self.coordinate(p);
        if self.above { v >= self.at } else { v <= self.at }
    }

    fn coordinate(&self, p: Plan) -> f64 {
        if self.is_level { p.y } else { p.x }
    }

    /// Where an edge crosses the line.
    fn crossing(&self, a: Plan, b: Plan) -> Plan {
        let (a, b) = if (a.x, a.y) <= (b.x, b.y) { (a, b) } else { (b, a) };
        let (from, to) = (self.coordinate(a), self.coordinate(b));
        let t = (self.at - from) / (to - from);
        if self.is_level {
            Plan::new(a.x + (b.x - a.x) * t, self.at)
        } else {
            Plan::new(self.at, a.y + (b.y - a.y) * t)
        }
    }
}

fn sides(window: &PlanBox) -> [Side; 4] {
    let side = |is_level, at, above| Side { is_level, at, above };
    [
        side(false, window.min.x, true),
        side(false, window.max.x, false),
        side(true, window.min.y, true),
        side(true, window.max.y, false),
    ]
}

/// A ring inside a window; empty where nothing of it is. Along the window's border it may run back on itself.
pub(super) fn ring(ring: Vec<Plan>, window: &PlanBox) -> Vec<Plan> {
    sides(window).into_iter().fold(ring, |ring, side| ring_beside(&ring, 0.0, side))
}

/// The part of a ring on one side. Its closing edge leads to its first vertex moved east by `around` (a ring around a pole, unrolled).
pub(super) fn ring_beside(ring: &[Plan], around: f64, side: Side) -> Vec<Plan> {
    let mut kept = Vec::with_capacity(ring.len());
    for (k, &to) in ring.iter().enumerate() {
        let from = match k {
            0 => ring[ring.len() - 1] + DVec2::new(-around, 0.0),
            k => ring[k - 1],
        };
        if side.keeps(from) != side.keeps(to) {
            kept.push(side.crossing(from, to));
        }
        if side.keeps(to) {
            kept.push(to);
        }
    }
    kept
}

/// The parts of a line inside a window.
pub(super) fn line(line: Vec<Plan>, window: &PlanBox) -> Vec<Vec<Plan>> {
    let within = |parts: Vec<Vec<Plan>>, side: Side| {
        parts.iter().flat_map(|part| line_beside(part, side)).collect::<Vec<_>>()
    };
    sides(window).into_iter().fold(vec![line], within)
}

/// The parts of a line on one side.
pub(super) fn line_beside(line: &[Plan], side: Side) -> Vec<Vec<Plan>> {
    let mut parts = Vec::new();
    let mut open: Vec<Plan> = Vec::new();
    for (k, &to) in line.iter().enumerate() {
        if k > 0 && side.keeps(line[k - 1]) != side.keeps(to) {
            open.push(side.crossing(line[k - 1], to));
        }
        match side.keeps(to) {
            true => open.push(to),
            false => parts.extend(Some(std::mem::take(&mut open)).filter(|part| part.len() > 1)),
        }
    }
    parts.extend(Some(open).filter(|open| open.len() > 1));
    parts
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn window() -> PlanBox {
        PlanBox { min: Plan::new(-2.0, -1.0), max: Plan::new(3.0, 2.0) }
    }

    fn plan(points: &[(i32, i32)]) -> Vec<Plan> {
        points.iter().map(|&(x, y)| Plan::new(f64::from(x), f64::from(y))).collect()
    }

    fn winding(ring: &[Plan], at: Plan) -> i32 {
        (0..ring.len())
            .map(|k| (ring[k], ring[(k + 1) % ring.len()]))
            .map(|(a, b)| {
                let side = crate::predicate::orient2d(a, b, at);
                match (a.y <= at.y, b.y <= at.y) {
                    (true, false) if side > 0.0 => 1,
                    (false, true) if side < 0.0 => -1,
                    _ => 0,
                }
            })
            .sum()
    }

    proptest! {
        #[test]
        fn windings_inside_the_window_stay(
            points in prop::collection::vec((-9i32..9, -9i32..9), 3..20),
            x in -1.9..2.9f64, y in -0.9..1.9f64,
        ) {
            let whole = plan(&points);
            let cut = ring(whole.clone(), &window());
            let at = Plan::new(x, y);
            prop_assert_eq!(winding(&cut, at), winding(&whole, at));
            prop_assert!(cut.iter().all(|p| window().grown(1e-12).contains(&PlanBox::around([*p]))));
        }

        #[test]
        fn parts_of_a_line_are_what_lies_inside(
            points in prop::collection::vec((-9i32..9, -9i32..9), 2..20),
        ) {
            let whole = plan(&points);
            let length = |line: &[Plan]| line.windows(2).map(|w| (w[1] - w[0]).length()).sum::<f64>();
            let inside: f64 = whole.windows(2).map(|w| {
                const N: usize = 4000;
                let step = (w[1] - w[0]) / N as f64;
                let at = |k: usize| w[0] + step * (k as f64 + 0.5);
                let held = (0..N).filter(|k| window().contains(&PlanBox::around([at(*k)]))).count();
                held as f64 * step.length()
            }).sum();
            let parts = line(whole, &window());
            let sum: f64 = parts.iter().map(|part| length(part)).sum();
            prop_assert!((sum - inside).abs() < 0.2, "{} {}", sum, inside);
        }
    }

    #[test]
    fn neighbours_share_the_vertices_of_the_cut() {
        let (a, b) = (Plan::new(-5.0, 0.3), Plan::new(1.7, 0.9));
        let one = ring(vec![a, b, Plan::new(0.0, 5.0)], &window());
        let other = ring(vec![b, a, Plan::new(0.0, -5.0)], &window());
        let on_side = |ring: &[Plan]| ring.iter().copied().find(|p| p.x == -2.0 && p.y > 0.0 && p.y < 1.0);
        assert_eq!(on_side(&one), on_side(&other));
        assert!(on_side(&one).is_some());
    }

    #[test]
    fn a_ring_around_a_pole_is_cut_along_a_parallel_the_way_it_runs() {
        // Out at 10, back in at 350: the parallel is followed eastwards, over the ring's own end.
        let ring = [Plan::new(0.0, 80.0), Plan::new(20.0, 60.0), Plan::new(340.0, 60.0)];
        let side = Side { is_level: true, at: 70.0, above: true };
        let kept = ring_beside(&ring, 360.0, side);
        let expected = [Plan::new(-10.0, 70.0), Plan::new(0.0, 80.0), Plan::new(10.0, 70.0)];
        assert_eq!(kept, expected);
    }
}
