//! What a box of the plan has of a ring with few edges, without a quadtree: the box is a leaf, whose edges and whose corner's winding number say all.

use super::crossing::{Exact, turns_above};
use super::throughout::misses;
use crate::space::{Plan, PlanBox};

/// A ring in a box.
#[derive(Debug, PartialEq)]
pub struct Cut<'p> {
    /// The winding number of the box's south-east corner; that of all its points where no edge meets the box.
    pub corner: i32,
    /// Consecutive vertices, from the path, of edges that may meet the box: all that do, border included.
    pub runs: Vec<&'p [Plan]>,
}

impl<'p> Cut<'p> {
    /// Cuts a ring, whose path ends with its first vertex once more.
    pub fn new(path: &'p [Plan], plan: &PlanBox) -> Self {
        let mut runs = Vec::new();
        let mut start = None;
        for (k, edge) in path.windows(2).enumerate() {
            match (start, misses(edge[0], edge[1], plan)) {
                (None, false) => start = Some(k),
                (Some(first), true) => {
                    runs.push(&path[first..=k]);
                    start = None;
                }
                _ => {}
            }
        }
        runs.extend(start.map(|first| &path[first..]));
        Self { corner: turns_of_ring(path, south_east(plan)), runs }
    }
}

/// The corner from which the winding numbers of a box's points are counted.
pub fn south_east(plan: &PlanBox) -> Plan {
    Plan::new(plan.max.x, plan.min.y)
}

/// What the winding number of a point of a box is above that of the box's south-east corner, by one run of a ring, exactly.
#[inline]
pub fn turns_of_run(run: &[Plan], corner: Plan, at: Plan) -> i32 {
    turns_above::<Exact>(run.windows(2).map(|edge| (edge[0], edge[1])), corner, at)
}

/// Whether no edge of a run surely meets a box.
#[inline]
pub fn run_misses(run: &[Plan], plan: &PlanBox) -> bool {
    run.windows(2).all(|edge| misses(edge[0], edge[1], plan))
}

/// The winding number of a ring around any point.
fn turns_of_ring(path: &[Plan], at: Plan) -> i32 {
    let bounds = PlanBox::around(path.iter().copied());
    let is_near = bounds.contains(&PlanBox::around([at]));
    if is_near { turns_of_run(path, south_east(&bounds), at) } else { 0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::decal::LeafPolygons;
    use crate::decal::quadtree::{Limits, Quadtree, Start};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_cut_ring_winds_around_each_point_of_the_box_as_the_whole_one_does(
            corners in prop::collection::vec((0..24i32, 0..24i32), 3..20), scale in prop_oneof![Just(1.0), Just(0.1)],
            (x, y, w, h) in (-2..24i32, -2..24i32, 0..9i32, 0..9i32),
        ) {
            let at = |x: i32, y: i32| Plan::new(f64::from(x) * scale, f64::from(y) * scale);
            let mut path: Vec<Plan> = corners.iter().map(|(x, y)| at(*x, *y)).collect();
            path.push(path[0]);
            let plan = PlanBox { min: at(x, y), max: at(x + w, y + h) };
            let cut = Cut::new(&path, &plan);
            let whole = Quadtree::new(&path, 0, Limits { capacity: 99, depth: 0 }, LeafPolygons::Corner);
            for (i, j) in (0..=w).flat_map(|i| (0..=h).map(move |j| (i, j))) {
                // Lattice points lie on edges, ends and borders.
                let p = at(x + i, y + j);
                let turns = cut.runs.iter().map(|run| turns_of_run(run, south_east(&plan), p)).sum::<i32>();
                let right = whole.winding(&path, Start::ROOT, p, &mut Default::default());
                prop_assert_eq!(cut.corner + turns, right, "{:?} {:?}", p, &cut);
            }
            if cut.runs.iter().all(|run| run_misses(run, &plan)) {
                prop_assert!(cut.runs.is_empty());
            }
        }
    }

    #[test]
    fn only_edges_that_are_near_are_kept() {
        let path = [(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0), (0.0, 0.0)].map(|(x, y)| Plan::new(x, y));
        let cut = |x: f64, y: f64, size: f64| {
            let plan = PlanBox { min: Plan::new(x, y), max: Plan::new(x + size, y + size) };
            let cut = Cut::new(&path, &plan);
            (cut.corner, cut.runs.iter().map(|run| run.len()).collect::<Vec<_>>())
        };
        assert_eq!(cut(3.0, 3.0, 1.0), (1, vec![]));
        assert_eq!(cut(10.0, 3.0, 1.0), (0, vec![]));
        assert_eq!(cut(8.5, 8.5, 1.0), (0, vec![3]), "a corner");
        assert_eq!(cut(-0.5, -0.5, 1.0), (0, vec![2, 2]), "the corner at which the path starts");
        assert_eq!(cut(-1.0, -1.0, 11.0), (0, vec![5]));
    }
}
