//! The rings of a shapefile's polygon by the members that they bound.
//!
//! The format has no members: *ESRI Shapefile Technical Description*, July 1998, says of rings which side of them is inside: those that turn
//! clockwise are outer ones, those that turn the other way holes in them.

use crate::space::{Plan, PlanBox};
use std::cell::OnceCell;

/// Each outer ring a member, with the holes that lie in it: a hole belongs to the outer ring before it in the file, as writers put the holes of
/// a member behind its outer ring, if that is around it; else to the smallest outer ring around it, and is a member of its own where there is
/// none. One outer ring at most: all rings are one member, however they turn.
pub(super) fn members_by_turn(rings: Vec<Vec<Plan>>) -> Vec<Vec<Vec<Plan>>> {
    let outer: Vec<Outer> = rings.iter().enumerate().filter_map(|(k, ring)| Outer::of(k, ring)).collect();
    if outer.len() < 2 {
        return vec![rings];
    }
    let around = |k: usize| {
        let hole = &rings[k];
        let bounds = PlanBox::around(hole.iter().copied());
        let holds = |outer: &&Outer| outer.bounds.contains(&bounds) && outer.holds(hole);
        let before = outer[..outer.partition_point(|outer| outer.ring < k)].last();
        let around = before.filter(holds);
        let smallest = || outer.iter().filter(holds).min_by(|a, b| a.area.total_cmp(&b.area));
        around.or_else(smallest).map(|outer| outer.ring)
    };
    // The first ring of each member is the outer one: holes before theirs wait for it.
    let own = |k: usize| outer.binary_search_by_key(&k, |outer| outer.ring).is_ok();
    let member: Vec<usize> =
        (0..rings.len()).map(|k| if own(k) { k } else { around(k).unwrap_or(k) }).collect();
    let mut members: Vec<Vec<Vec<Plan>>> = vec![Vec::new(); rings.len()];
    for (ring, member) in rings.into_iter().zip(member) {
        members[member].push(ring);
    }
    members.retain(|rings| !rings.is_empty());
    members
}

/// A ring that turns clockwise.
struct Outer<'a> {
    ring: usize,
    points: &'a [Plan],
    area: f64,
    bounds: PlanBox,
    slabs: OnceCell<Slabs>,
}

impl<'a> Outer<'a> {
    fn of(ring: usize, points: &'a [Plan]) -> Option<Self> {
        let first = *points.first()?;
        let area = points.windows(2).map(|pair| (pair[1] - first).perp_dot(pair[0] - first)).sum::<f64>();
        let bounds = PlanBox::around(points.iter().copied());
        (area > 0.0).then(|| Self { ring, points, area, bounds, slabs: OnceCell::new() })
    }

    /// Whether a hole lies in this ring: most of its vertices do, as some may lie on it.
    fn holds(&self, hole: &[Plan]) -> bool {
        let slabs = self.slabs.get_or_init(|| Slabs::of(self.points, &self.bounds));
        let inside = hole.iter().filter(|p| self.is_inside(slabs, **p)).count();
        2 * inside > hole.len()
    }

    fn is_inside(&self, slabs: &Slabs, p: Plan) -> bool {
        let crossed = slabs.edges_at(p.y).iter().filter(|k| {
            let (a, b) = edge(self.points, **k as usize);
            (a.y <= p.y) != (b.y <= p.y) && a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) > p.x
        });
        crossed.count() % 2 == 1
    }
}

/// The edge of a ring that begins at a vertex.
fn edge(ring: &[Plan], k: usize) -> (Plan, Plan) {
    (ring[k], ring[if k + 1 == ring.len() { 0 } else { k + 1 }])
}

/// Edges of a ring by the slabs of y that they meet: a country may have a million vertices and ten thousands of lakes.
struct Slabs {
    low: f64,
    /// Slabs a unit of y.
    scale: f64,
    /// Where the edges of each slab begin, and the end of the last one's.
    begins: Vec<usize>,
    edges: Vec<u32>,
}

impl Slabs {
    /// Vertices a slab, on average.
    const EACH: usize = 8;

    fn of(ring: &[Plan], bounds: &PlanBox) -> Self {
        let count = (ring.len() / Self::EACH).max(1);
        let scale = count as f64 / (bounds.max.y - bounds.min.y);
        let mut slabs = Self { low: bounds.min.y, scale, begins: vec![0; count + 1], edges: Vec::new() };
        let met = |slabs: &Self, k: usize| {
            let (a, b) = edge(ring, k);
            let (a, b) = (slabs.at(a.y), slabs.at(b.y));
            a.min(b)..=a.max(b)
        };
        for k in 0..ring.len() {
            for slab in met(&slabs, k) {
                slabs.begins[slab + 1] += 1;
            }
        }
        for slab in 0..count {
            slabs.begins[slab + 1] += slabs.begins[slab];
        }
        let mut next = slabs.begins.clone();
        slabs.edges = vec![0; slabs.begins[count]];
        for k in 0..ring.len() {
            for slab in met(&slabs, k) {
                slabs.edges[next[slab]] = k as u32;
                next[slab] += 1;
            }
        }
        slabs
    }

    /// The slab of a y; the nearest where there is none.
    fn at(&self, y: f64) -> usize {
        (((y - self.low) * self.scale) as usize).min(self.begins.len() - 2)
    }

    fn edges_at(&self, y: f64) -> &[u32] {
        let slab = self.at(y);
        &self.edges[self.begins[slab]..self.begins[slab + 1]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_slab_has_all_edges_that_a_point_of_its_heights_needs(
            ring in prop::collection::vec((0_i32..20, 0_i32..20), 3..80),
            points in prop::collection::vec((-2.0_f64..22.0, 0.0_f64..=20.0), 20),
        ) {
            let ring: Vec<Plan> = ring.iter().map(|(x, y)| Plan::new(f64::from(*x), f64::from(*y))).collect();
            let turned: Vec<Plan> = ring.iter().rev().copied().collect();
            let Some(outer) = Outer::of(0, &ring).or_else(|| Outer::of(0, &turned)) else { return Ok(()) };
            let slabs = Slabs::of(outer.points, &outer.bounds);
            let all = Slabs { low: 0.0, scale: 0.0, begins: vec![0, ring.len()], edges: (0..ring.len() as u32).collect() };
            for (x, y) in points {
                for y in [y, y.round()] {
                    prop_assert_eq!(outer.is_inside(&slabs, Plan::new(x, y)), outer.is_inside(&all, Plan::new(x, y)));
                }
            }
        }
    }
}
