//! Whether a polygon is simple: then the areas of its texels can be summed without telling winding numbers apart.

use crate::predicate::orient2d;
use crate::scene::Rule;
use crate::space::{Plan, PlanBox};

/// How many pairs of edges may be compared for each edge before a polygon is taken for one that is not simple.
const PAIRS_AN_EDGE: usize = 256;

/// More rings than this are not looked at.
const MOST_RINGS: usize = 4096;

/// Turns the rings of a polygon whose edges meet nowhere so that its winding numbers are 1 inside and 0 outside, and drops rings
/// that are no border. False, and nothing is changed, where edges cross or touch, or where it would take long to know.
pub(super) fn orient(rings: &mut Vec<Vec<Plan>>, rule: Rule) -> bool {
    if rings.len() > MOST_RINGS || !edges_are_apart(rings) {
        return false;
    }
    let turns: Vec<i32> = rings.iter().map(|ring| turn(ring)).collect();
    let boxes: Vec<PlanBox> = rings.iter().map(|ring| PlanBox::around(ring.iter().copied())).collect();
    // A ring lies in another when one of its vertices does.
    let around = |k: usize| -> i32 {
        let at = rings[k][0];
        let others = (0..rings.len()).filter(|other| *other != k && boxes[*other].contains(&boxes[k]));
        others.filter(|other| is_inside(&rings[*other], at)).map(|other| turns[other]).sum()
    };
    let outside: Vec<i32> = (0..rings.len()).map(around).collect();
    let mut k = 0;
    rings.retain_mut(|ring| {
        let is_inside = rule.contains(outside[k] + turns[k]);
        let is_border = is_inside != rule.contains(outside[k]);
        if is_border && is_inside != (turns[k] > 0) {
            ring.reverse();
        }
        k += 1;
        is_border
    });
    true
}

/// 1 for a simple ring that turns counter-clockwise, -1 for one that turns clockwise: its westernmost corner tells, exactly.
fn turn(ring: &[Plan]) -> i32 {
    let n = ring.len();
    let order = |a: &Plan, b: &Plan| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y));
    let corner = (0..n).min_by(|a, b| order(&ring[*a], &ring[*b])).unwrap_or(0);
    let (before, after) = (ring[(corner + n - 1) % n], ring[(corner + 1) % n]);
    if orient2d(before, ring[corner], after) > 0.0 { 1 } else { -1 }
}

/// Whether a point that lies on no edge of a ring lies in it.
fn is_inside(ring: &[Plan], at: Plan) -> bool {
    let crosses = |k: usize| {
        let (a, b) = (ring[k], ring[(k + 1) % ring.len()]);
        (a.y <= at.y) != (b.y <= at.y) && (orient2d(a, b, at) > 0.0) == (a.y <= at.y)
    };
    (0..ring.len()).filter(|k| crosses(*k)).count() % 2 == 1
}

/// An edge of a ring.
#[derive(Clone, Copy)]
struct Edge {
    ring: u32,
    index: u32,
    from: Plan,
    to: Plan,
}

impl Edge {
    fn west(&self) -> f64 {
        crate::math::min(self.from.x, self.to.x)
    }

    fn east(&self) -> f64 {
        crate::math::max(self.from.x, self.to.x)
    }
}

/// Whether no two edges share a point, but for the vertices between neighbours.
fn edges_are_apart(rings: &[Vec<Plan>]) -> bool {
    let mut edges = Vec::new();
    for (r, ring) in rings.iter().enumerate() {
        if ring.len() < 3 {
            return false;
        }
        for (k, from) in ring.iter().enumerate() {
            let to = ring[(k + 1) % ring.len()];
            if *from == to {
                return false;
            }
            edges.push(Edge { ring: r as u32, index: k as u32, from: *from, to });
        }
    }
    // Sweep from the west to the east; edges that have ended are left out now and then.
    edges.sort_by(|a, b| a.west().total_cmp(&b.west()));
    let mut budget = PAIRS_AN_EDGE * edges.len();
    let mut open: Vec<Edge> = Vec::new();
    for edge in &edges {
        open.retain(|other| other.east() >= edge.west());
        let Some(left) = budget.checked_sub(open.len()) else { return false };
        budget = left;
        if open.iter().any(|other| !are_apart(edge, other, rings)) {
            return false;
        }
        open.push(*edge);
    }
    true
}

fn are_apart(a: &Edge, b: &Edge, rings: &[Vec<Plan>]) -> bool {
    let is_beside = |p: f64, q: f64, r: f64, s: f64| {
        (p > r && p > s && q > r && q > s) || (p < r && p < s && q < r && q < s)
    };
    if is_beside(a.from.y, a.to.y, b.from.y, b.to.y) || is_beside(a.from.x, a.to.x, b.from.x, b.to.x) {
        return true;
    }
    let n = rings[a.ring as usize].len() as u32;
    let follows = |a: &Edge, b: &Edge| a.ring == b.ring && (a.index + 1) % n == b.index;
    match (follows(a, b), follows(b, a)) {
        (true, _) => is_no_fold(a.from, a.to, b.to),
        (_, true) => is_no_fold(b.from, b.to, a.to),
        _ => {
            let side = |edge: &Edge, p: Plan| orient2d(edge.from, edge.to, p);
            let same = |p: f64, q: f64| (p > 0.0 && q > 0.0) || (p < 0.0 && q < 0.0);
            same(side(a, b.from), side(a, b.to)) || same(side(b, a.from), side(b, a.to))
        }
    }
}

/// Whether the way a -> b -> c does not run back on itself.
fn is_no_fold(a: Plan, b: Plan, c: Plan) -> bool {
    orient2d(a, b, c) != 0.0 || (b - a).dot(c - b) > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(points: &[[f64; 2]]) -> Vec<Plan> {
        points.iter().map(|p| Plan::new(p[0], p[1])).collect()
    }

    fn square(at: f64, side: f64) -> Vec<Plan> {
        ring(&[[at, at], [at + side, at], [at + side, at + side], [at, at + side]])
    }

    fn reversed(mut ring: Vec<Plan>) -> Vec<Plan> {
        ring.reverse();
        ring
    }

    fn oriented(rings: &[Vec<Plan>], rule: Rule) -> Option<Vec<i32>> {
        let mut rings = rings.to_vec();
        orient(&mut rings, rule).then(|| rings.iter().map(|ring| turn(ring)).collect())
    }

    #[test]
    fn rings_turn_around_what_is_inside_whichever_way_they_were_written() {
        for flips in 0..8 {
            let flip = |k: usize, ring: Vec<Plan>| if flips >> k & 1 == 1 { reversed(ring) } else { ring };
            let rings = [flip(0, square(0.0, 9.0)), flip(1, square(1.0, 7.0)), flip(2, square(2.0, 5.0))];
            assert_eq!(oriented(&rings, Rule::EvenOdd), Some(vec![1, -1, 1]), "{flips}");
        }
    }

    #[test]
    fn with_the_rule_nonzero_a_ring_in_a_ring_of_its_own_turn_is_no_border() {
        let (outer, inner) = (square(0.0, 9.0), square(2.0, 5.0));
        assert_eq!(oriented(&[outer.clone(), inner.clone()], Rule::NonZero), Some(vec![1]));
        assert_eq!(oriented(&[outer, reversed(inner)], Rule::NonZero), Some(vec![1, -1]));
        assert_eq!(oriented(&[reversed(square(0.0, 9.0))], Rule::NonZero), Some(vec![1]));
    }

    #[test]
    fn what_crosses_touches_or_folds_is_not_simple() {
        let bow = ring(&[[0.0, 0.0], [4.0, 4.0], [4.0, 0.0], [0.0, 4.0]]);
        let folded = ring(&[[0.0, 0.0], [4.0, 0.0], [2.0, 0.0], [2.0, 3.0]]);
        let touching = ring(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 0.0]]);
        let twice = ring(&[[0.0, 0.0], [4.0, 0.0], [4.0, 0.0], [4.0, 4.0]]);
        for wrong in [bow, folded, touching, twice, ring(&[[0.0, 0.0], [1.0, 1.0]])] {
            assert_eq!(oriented(&[wrong], Rule::EvenOdd), None);
        }
        assert_eq!(oriented(&[square(0.0, 4.0), square(2.0, 4.0)], Rule::EvenOdd), None);
        assert_eq!(oriented(&[square(0.0, 4.0), square(4.0, 4.0)], Rule::EvenOdd), None, "a shared corner");
    }

    #[test]
    fn collinear_vertices_are_no_fold() {
        let ring = ring(&[[0.0, 0.0], [2.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [0.0, 2.0]]);
        assert_eq!(oriented(&[ring], Rule::EvenOdd), Some(vec![1]));
    }
}
