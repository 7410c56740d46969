//! Boxes that no edge meets: one answer for all their points. Samples of a pixel lie near to each other, edges mostly do not.

use super::crossing::Exact;
use super::node::Kind;
use super::tree::{Counts, Edges, Quadtree, Start};
use crate::math::{max, min};
use crate::space::{Plan, PlanBox};

/// How far from an edge a box must be, as a share of the products that enter: they and their sums are rounded four times.
const SLACK: f64 = 8.0 * f64::EPSILON;

impl Quadtree {
    /// The ring's winding number around all points of a box, of which one is given; `None`: that was not found out. A box that lies in one leaf and
    /// that no edge of the leaf meets is asked about once.
    pub fn turns_throughout(
        &self,
        vertices: &[Plan],
        start: Start,
        (plan, at): (&PlanBox, Plan),
        counts: &mut Counts,
    ) -> Option<i32> {
        if self.count == 0 || !self.bounds.meets(plan) {
            return Some(0);
        }
        if !self.bounds.contains(plan) {
            return None;
        }
        let Some(nodes) = &self.nodes else {
            let path = &vertices[self.first as usize..][..self.count as usize + 1];
            let is_clear = path.windows(2).all(|edge| misses(edge[0], edge[1], plan));
            return is_clear.then(|| self.winding(vertices, start, at, counts));
        };
        let (low, high) = (nodes.borders.place(plan.min), nodes.borders.place(plan.max));
        let mut level = start.quad.level();
        if low.quad(level) != start.quad || high.quad(level) != start.quad {
            return None;
        }
        let mut node = start.node;
        loop {
            counts.nodes += 1;
            match nodes.nodes[node as usize].kind() {
                Kind::Internal(children) => {
                    level += 1;
                    let quarter = low.quarter(level);
                    if quarter != high.quarter(level) {
                        return None;
                    }
                    node = children + quarter;
                }
                Kind::Full(turns) => return Some(turns),
                Kind::Partial(leaf) => {
                    let own = nodes.edges_of(leaf);
                    let is_clear = match &nodes.edges {
                        Edges::Numbers(numbers) => numbers[own]
                            .iter()
                            .all(|k| misses(vertices[*k as usize], vertices[*k as usize + 1], plan)),
                        Edges::Segments(ends, segments) => segments[own]
                            .iter()
                            .all(|[a, b]| misses(ends[*a as usize], ends[*b as usize], plan)),
                    };
                    let corner = nodes.borders.corner(low.quad(level));
                    return is_clear
                        .then(|| nodes.turns_in_leaf::<Exact>(leaf, corner, vertices, at, counts));
                }
            }
        }
    }
}

impl Quadtree {
    /// The ring's winding number around all points of any box, by a subtree that has all that the ring has in it; `None`: an edge may meet the box.
    pub fn turns_in(&self, vertices: &[Plan], start: Start, plan: &PlanBox) -> Option<i32> {
        let may_meet = |k: u32| !misses(vertices[k as usize], vertices[k as usize + 1], plan);
        let is_met = match &self.nodes {
            None => (self.first..self.first + self.count).any(may_meet),
            Some(nodes) => {
                // The edges of leaves that are clipped have moved.
                let Edges::Numbers(edges) = &nodes.edges else { return None };
                let mut stack = vec![start];
                loop {
                    let Some(start) = stack.pop() else { break false };
                    if !nodes.borders.of(start.quad).meets(plan) {
                        continue;
                    }
                    match nodes.nodes[start.node as usize].kind() {
                        Kind::Internal(_) => stack.extend(nodes.children(start).into_iter().flatten()),
                        Kind::Full(_) => {}
                        Kind::Partial(leaf) if edges[nodes.edges_of(leaf)].iter().any(|k| may_meet(*k)) => {
                            break true;
                        }
                        Kind::Partial(_) => {}
                    }
                }
            }
        };
        (!is_met).then(|| self.winding(vertices, Start::ROOT, plan.min, &mut Counts::default()))
    }
}

/// Whether an edge surely has no point in a box.
#[inline(always)]
pub(super) fn misses(a: Plan, b: Plan, plan: &PlanBox) -> bool {
    let is_beside = (max(a.x, b.x) < plan.min.x)
        | (min(a.x, b.x) > plan.max.x)
        | (max(a.y, b.y) < plan.min.y)
        | (min(a.y, b.y) > plan.max.y);
    if is_beside {
        return true;
    }
    // How far the box's middle is from the edge's line, times the edge's length, against how far the box reaches across it.
    let (d, half) = (b - a, (plan.max - plan.min) * 0.5);
    let u = plan.min + half - a;
    let (p, q) = (d.x * u.y, d.y * u.x);
    let reach = d.x.abs() * half.y + d.y.abs() * half.x;
    // The rounding of coordinates themselves, of differences and of products.
    let size = a.x.abs() + a.y.abs() + b.x.abs() + b.y.abs() + u.x.abs() + u.y.abs();
    let slack = SLACK * (p.abs() + q.abs() + reach + (d.x.abs() + d.y.abs()) * size);
    (p - q).abs() > reach + slack
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decal::LeafPolygons;
    use crate::decal::quadtree::Limits;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn what_is_said_of_a_box_is_true_of_each_of_its_points(
            corners in prop::collection::vec((0..24i32, 0..24i32), 3..40), scale in prop_oneof![Just(1.0), Just(0.1)],
            (x, y, w, h) in (-2.0..24.0f64, -2.0..24.0f64, 0.0..3.0f64, 0.0..3.0f64), capacity in 1..9u32, depth in 0..9u32,
        ) {
            let mut path: Vec<Plan> =
                corners.iter().map(|(x, y)| Plan::new(f64::from(*x) * scale, f64::from(*y) * scale)).collect();
            path.push(path[0]);
            let tree = Quadtree::new(&path, 0, Limits { capacity, depth }, LeafPolygons::Corner);
            let at = |s: f64, t: f64| Plan::new((x + s * w) * scale, (y + t * h) * scale);
            let plan = PlanBox { min: at(0.0, 0.0), max: at(1.0, 1.0) };
            let counts = &mut Counts::default();
            let Some(start) = tree.start_in(&plan) else { return Ok(()) };
            let said = [
                tree.turns_throughout(&path, start, (&plan, plan.min), counts),
                tree.turns_in(&path, start, &plan),
            ];
            for turns in said.into_iter().flatten() {
                for k in 0..25 {
                    let p = at(f64::from(k % 5) / 4.0, f64::from(k / 5) / 4.0);
                    prop_assert_eq!(tree.winding(&path, start, p, counts), turns, "{:?}", p);
                }
            }
        }
    }

    #[test]
    fn a_box_beside_a_diagonal_is_told_apart_from_one_on_it() {
        let path = [(0.0, 0.0), (8.0, 8.0), (0.0, 8.0), (0.0, 0.0)].map(|(x, y)| Plan::new(x, y));
        let plan = |x: f64, y: f64| PlanBox { min: Plan::new(x, y), max: Plan::new(x + 1.0, y + 1.0) };
        assert!(misses(path[0], path[1], &plan(4.0, 2.5)));
        assert!(!misses(path[0], path[1], &plan(4.0, 3.0)), "it touches the corner");
        let tree = Quadtree::new(&path, 0, Limits { capacity: 8, depth: 8 }, LeafPolygons::Corner);
        let said = |x, y| {
            let (plan, counts) = (plan(x, y), &mut Counts::default());
            tree.turns_throughout(&path, Start::ROOT, (&plan, plan.min), counts)
        };
        assert_eq!(
            [said(4.0, 2.5), said(4.0, 4.5), said(1.0, 5.0), said(9.0, 9.0)],
            [Some(0), None, Some(1), Some(0)]
        );
    }

    #[test]
    fn a_box_over_several_quarters_is_not_judged_by_one_of_them_and_a_small_one_enters_its_own() {
        // A square with a notch from the east, whose tip lies in the box's north-eastern part.
        let path = [
            (0.0, 0.0),
            (16.0, 0.0),
            (16.0, 8.2),
            (8.5, 8.5),
            (16.0, 8.8),
            (16.0, 16.0),
            (0.0, 16.0),
            (0.0, 0.0),
        ]
        .map(|(x, y)| Plan::new(x, y));
        let tree = Quadtree::new(&path, 0, Limits { capacity: 1, depth: 8 }, LeafPolygons::Corner);
        let plan = |low: f64, high: f64| PlanBox { min: Plan::new(low, low), max: Plan::new(high, high) };
        let said = |start, plan: PlanBox| {
            tree.turns_throughout(&path, start, (&plan, plan.min), &mut Counts::default())
        };
        assert_eq!(said(Start::ROOT, plan(7.0, 9.0)), None);
        assert_eq!(said(Start::ROOT, plan(6.5, 6.9)), Some(1));
        let start = tree.start_in(&plan(6.5, 6.9)).unwrap();
        assert!(start.quad.level() > 1, "{start:?}");
        assert_eq!(said(start, plan(6.5, 6.9)), Some(1));
        assert_eq!(
            tree.start_in(&plan(3.0, 5.0)).unwrap().quad.level(),
            1,
            "over all quarters of the south-western one"
        );
    }

    #[test]
    fn an_edge_that_touches_a_box_does_not_miss_it_however_it_is_rounded() {
        let p = Plan::new;
        let plan = PlanBox { min: p(4.0, 4.0), max: p(6.0, 6.0) };
        for (a, b) in [
            (p(4.0, 0.0), p(4.0, 9.0)),
            (p(6.0, 0.0), p(6.0, 9.0)),
            (p(0.0, 4.0), p(9.0, 4.0)),
            (p(9.0, 6.0), p(0.0, 6.0)),
        ] {
            assert!(!misses(a, b, &plan), "{a:?} {b:?}");
        }
        // A corner on the middle of the edge, in numbers whose products have more digits than doubles.
        for k in 0..500 {
            let (x, y) = (f64::from(1 << 30) + f64::from(2 * k + 1), f64::from((1 << 30) - 77_777 * k - 3));
            let (w, h) = (f64::from(1_000_003 + 2 * k), f64::from(700_001 + 4 * k));
            let above = PlanBox { min: p(x - w, y), max: p(x, y + h) };
            let below = PlanBox { min: p(x, y - h), max: p(x + w, y) };
            for plan in [above, below] {
                assert!(!misses(p(0.0, 0.0), p(2.0 * x, 2.0 * y), &plan), "{k}");
                assert!(
                    misses(p(0.0, 1e7), p(2.0 * x, 2.0 * y + 1e7), &below)
                        && misses(p(1e7, 0.0), p(2.0 * x + 1e7, 2.0 * y), &above)
                );
            }
        }
    }
}
