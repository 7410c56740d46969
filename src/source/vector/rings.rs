//! The rings of a shapefile's polygon by the members that they bound.
//!
//! The format has no members: *ESRI Shapefile Technical Description*, July 1998, says of rings which side of them is inside: those that turn
//! clockwise are outer ones, those that turn the other way holes in them.

use crate::space::{Plan, PlanBox};

/// Each outer ring a member, with the holes that lie in it: a hole belongs to the smallest outer ring around it, and is a member of its own
/// where there is none. One outer ring at most: all rings are one member, however they turn.
pub(super) fn members_by_turn(rings: Vec<Vec<Plan>>) -> Vec<Vec<Vec<Plan>>> {
    let outer: Vec<Outer> = rings.iter().enumerate().filter_map(|(k, ring)| Outer::of(k, ring)).collect();
    if outer.len() < 2 {
        return vec![rings];
    }
    let around = |ring: &[Plan]| {
        let holding = outer.iter().filter(|outer| outer.holds(&rings[outer.ring], ring));
        holding.min_by(|a, b| a.area.total_cmp(&b.area)).map(|outer| outer.ring)
    };
    // The first ring of each member is the outer one: holes before theirs wait for it.
    let own = |k: usize| outer.binary_search_by_key(&k, |outer| outer.ring).is_ok();
    let member: Vec<usize> = rings
        .iter()
        .enumerate()
        .map(|(k, ring)| if own(k) { k } else { around(ring).unwrap_or(k) })
        .collect();
    let mut members: Vec<Vec<Vec<Plan>>> = vec![Vec::new(); rings.len()];
    for (ring, member) in rings.into_iter().zip(member) {
        members[member].push(ring);
    }
    members.retain(|rings| !rings.is_empty());
    members
}

/// A ring that turns clockwise.
struct Outer {
    ring: usize,
    area: f64,
    bounds: PlanBox,
}

impl Outer {
    fn of(ring: usize, points: &[Plan]) -> Option<Self> {
        let first = *points.first()?;
        let area = points.windows(2).map(|pair| (pair[1] - first).perp_dot(pair[0] - first)).sum::<f64>();
        (area > 0.0).then(|| Self { ring, area, bounds: PlanBox::around(points.iter().copied()) })
    }

    /// Whether a hole lies in this ring of these points: most of its vertices do, as some may lie on it.
    fn holds(&self, points: &[Plan], hole: &[Plan]) -> bool {
        let bounds = PlanBox::around(hole.iter().copied());
        if !self.bounds.contains(&bounds) {
            return false;
        }
        let inside = hole.iter().filter(|p| is_inside(points, **p)).count();
        2 * inside > hole.len()
    }
}

fn is_inside(ring: &[Plan], p: Plan) -> bool {
    let next = ring.iter().cycle().skip(1);
    let crossed = ring
        .iter()
        .zip(next)
        .filter(|(a, b)| (a.y <= p.y) != (b.y <= p.y) && a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) > p.x);
    crossed.count() % 2 == 1
}
