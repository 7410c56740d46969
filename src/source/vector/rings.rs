//! Rings by the members that they bound, for formats that have no members.
//!
//! A shapefile's rings say by their turn which side of them is inside (*ESRI Shapefile Technical Description*, July 1998: those that turn
//! clockwise are outer ones, those that turn the other way holes in them); OpenStreetMap's by how they lie in one another.

use crate::space::{Plan, PlanBox};
use std::cell::OnceCell;

/// Each outer ring a member, with the holes that lie in it: a hole belongs to the outer ring before it in the file, as writers put the holes of
/// a member behind its outer ring, if that is around it; else to the smallest outer ring around it, and is a member of its own where there is
/// none. One outer ring at most: all rings are one member, however they turn.
pub(super) fn members_by_turn(rings: Vec<Vec<Plan>>) -> Vec<Vec<Vec<Plan>>> {
    let all: Vec<Ring<'_>> = rings.iter().map(|points| Ring::of(points)).collect();
    let outer: Vec<usize> = (0..all.len()).filter(|k| all[*k].area < 0.0).collect();
    if outer.len() < 2 {
        return vec![rings];
    }
    let around = |k: usize| {
        let holds = |outer: &&usize| all[**outer].holds(&all[k]);
        let before = outer[..outer.partition_point(|outer| *outer < k)].last();
        let smallest = || {
            let holding = outer.iter().filter(holds);
            holding.min_by(|a, b| all[**a].area.abs().total_cmp(&all[**b].area.abs()))
        };
        before.filter(holds).or_else(smallest).copied()
    };
    let owner = |k: usize| if all[k].area < 0.0 { k } else { around(k).unwrap_or(k) };
    let owners: Vec<usize> = (0..all.len()).map(owner).collect();
    members(rings, &owners)
}

/// Of each ring the outer ring that it belongs to, itself if it is one: a ring with an even number of rings around it is an outer one, the
/// others are holes in the smallest outer ring around them. Of equal rings the later lies in the earlier.
pub(super) fn owners_by_nesting(rings: &[Vec<Plan>]) -> Vec<usize> {
    let all: Vec<Ring<'_>> = rings.iter().map(|points| Ring::of(points)).collect();
    let mut falling: Vec<usize> = (0..all.len()).collect();
    falling.sort_by(|a, b| all[*b].area.abs().total_cmp(&all[*a].area.abs()));
    let mut owners: Vec<usize> = (0..all.len()).collect();
    for (at, k) in falling.iter().enumerate() {
        let around: Vec<usize> =
            falling[..at].iter().copied().filter(|larger| all[*larger].holds(&all[*k])).collect();
        let smallest = || around.iter().rev().copied().find(|larger| owners[*larger] == *larger);
        if let Some(outer) = smallest().filter(|_| around.len() % 2 == 1) {
            owners[*k] = outer;
        }
    }
    owners
}

/// Rings by members, given of each the outer ring that it belongs to. The first ring of each member is the outer one.
pub(super) fn members(rings: Vec<Vec<Plan>>, owners: &[usize]) -> Vec<Vec<Vec<Plan>>> {
    let mut members: Vec<Vec<Vec<Plan>>> = vec![Vec::new(); rings.len()];
    // Holes before their outer ring wait for it.
    let mut holes = Vec::new();
    for (k, (ring, owner)) in rings.into_iter().zip(owners).enumerate() {
        match *owner == k || !members[*owner].is_empty() {
            true => members[*owner].push(ring),
            false => holes.push((*owner, ring)),
        }
    }
    for (owner, ring) in holes {
        members[owner].push(ring);
    }
    members.retain(|rings| !rings.is_empty());
    members
}

/// A point in a ring: the middle of the widest piece of its inside at half its height; `None` where nothing lies in it.
pub(in crate::source) fn inner_point(ring: &[Plan]) -> Option<Plan> {
    let bounds = PlanBox::around(ring.iter().copied());
    let y = 0.5 * bounds.min.y + 0.5 * bounds.max.y;
    let edges = (0..ring.len()).map(|k| edge(ring, k));
    let crossing = edges.filter(|(a, b)| (a.y <= y) != (b.y <= y));
    let mut at: Vec<f64> = crossing.map(|(a, b)| crossed_at(a, b, y)).collect();
    at.sort_by(f64::total_cmp);
    let pieces = at.chunks_exact(2).map(|piece| (piece[1] - piece[0], 0.5 * piece[0] + 0.5 * piece[1]));
    let widest = pieces.max_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(Plan::new(widest.1, y))
}

/// The area of a ring twice, its closing point given or not: positive where it runs against the clock.
pub(in crate::source) fn signed_area(ring: &[Plan]) -> f64 {
    // From the first corner on, so that far away from the origin nothing cancels.
    let [first, rest @ ..] = ring else { return 0.0 };
    rest.windows(2).map(|pair| (pair[0] - *first).perp_dot(pair[1] - *first)).sum()
}

/// Where an edge crosses the horizontal line at `y`.
fn crossed_at(a: Plan, b: Plan, y: f64) -> f64 {
    a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x)
}

/// A ring, and what is found out of it when it is needed.
struct Ring<'a> {
    points: &'a [Plan],
    /// Twice its signed area.
    area: f64,
    bounds: PlanBox,
    inner: OnceCell<Option<Plan>>,
    slabs: OnceCell<Slabs>,
}

impl<'a> Ring<'a> {
    fn of(points: &'a [Plan]) -> Self {
        let bounds = PlanBox::around(points.iter().copied());
        let (inner, slabs) = (OnceCell::new(), OnceCell::new());
        Self { points, area: signed_area(points), bounds, inner, slabs }
    }

    /// Whether a ring that is not larger lies in this one: a point in it does, as all its vertices may lie on this one.
    fn holds(&self, ring: &Self) -> bool {
        if self.area.abs() < ring.area.abs() || !self.bounds.contains(&ring.bounds) {
            return false;
        }
        let inner = ring.inner.get_or_init(|| inner_point(ring.points).or(ring.points.first().copied()));
        inner.is_some_and(|p| {
            self.is_inside(self.slabs.get_or_init(|| Slabs::of(self.points, &self.bounds)), p)
        })
    }

    fn is_inside(&self, slabs: &Slabs, p: Plan) -> bool {
        let crossed = slabs.edges_at(p.y).iter().filter(|k| {
            let (a, b) = edge(self.points, **k as usize);
            (a.y <= p.y) != (b.y <= p.y) && crossed_at(a, b, p.y) > p.x
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

    fn ring(points: &[(f64, f64)]) -> Vec<Plan> {
        points.iter().map(|(x, y)| Plan::new(*x, *y)).collect()
    }

    #[test]
    fn a_hole_whose_vertices_all_lie_on_the_border_is_a_hole() {
        let outer = ring(&[(0.0, 0.0), (0.0, 4.0), (0.0, 8.0), (8.0, 8.0), (8.0, 0.0), (4.0, 0.0)]);
        let hole = ring(&[(0.0, 4.0), (4.0, 0.0), (8.0, 8.0)]);
        let far = ring(&[(20.0, 0.0), (20.0, 1.0), (21.0, 0.0)]);
        let rings = vec![far.clone(), hole.clone(), outer.clone()];
        assert_eq!(owners_by_nesting(&rings), [0, 2, 2]);
        assert_eq!(members_by_turn(rings), [vec![far], vec![outer, hole]]);
    }

    proptest! {
        #[test]
        fn a_slab_has_all_edges_that_a_point_of_its_heights_needs(
            ring in prop::collection::vec((0_i32..20, 0_i32..20), 3..80),
            points in prop::collection::vec((-2.0_f64..22.0, 0.0_f64..=20.0), 20),
        ) {
            let ring: Vec<Plan> = ring.iter().map(|(x, y)| Plan::new(f64::from(*x), f64::from(*y))).collect();
            let outer = Ring::of(&ring);
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
