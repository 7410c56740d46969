//! On which side of a polygon's rings it lies.

use crate::draw_list::{Chain, DrawList, Item};
use crate::predicate::orient2d;
use crate::space::Plan;
use std::collections::BTreeMap;

/// About so many edges of a ring are asked in how many of the others they lie.
const MOST_ASKED: usize = 64;

/// Of each ring of an item, by its part: whether the item's polygon lies on the left; `None`: it cannot be told.
///
/// It follows from the ring's turn and whether it is a hole (Zechmeister 2020, 4.4.1), also where a ring crosses itself and that is wrong
/// for some of its segments; dashes take it from the ring that they are parts of.
#[derive(Debug)]
pub(super) struct Sides(BTreeMap<u32, Option<bool>>);

impl Sides {
    pub(super) fn of(list: &DrawList, item: &Item) -> Self {
        let rings = list.area(item);
        let members = rings.chunk_by(|a, b| a.member == b.member);
        let of_member = |member: &'_ [Chain]| -> Vec<(u32, Option<bool>)> {
            let side = |ring: &Chain| {
                let is_hole = is_hole(list, ring, member)?;
                Some(turns_left(list.path_of(ring))? != is_hole)
            };
            member.iter().map(|ring| (ring.part, side(ring))).collect()
        };
        Self(members.flat_map(of_member).collect())
    }

    /// Whether the polygon lies on the left of the ring of a part.
    pub(super) fn left_of(&self, part: u32) -> Option<bool> {
        self.0.get(&part).copied().flatten()
    }
}

/// Whether a closed path encloses more on its left than on its right; `None`: what is enclosed is less than rounding.
fn turns_left(path: &[Plan]) -> Option<bool> {
    let (mut twice, mut size) = (0.0, 0.0);
    for ends in path.windows(2) {
        let (a, b) = (ends[0] - path[0], ends[1] - path[0]);
        twice += a.perp_dot(b);
        size += (a.x * b.y).abs() + (a.y * b.x).abs();
    }
    // Each of n terms is rounded by a few units of its last place, and each of the sums by one of the whole.
    let doubt = (path.len() as f64 + 4.0) * f64::EPSILON * size;
    (twice.abs() > doubt).then_some(twice > 0.0)
}

/// Whether most edges of a ring lie in an odd number of its member's other rings; `None`: as many as do not.
fn is_hole(list: &DrawList, ring: &Chain, member: &[Chain]) -> Option<bool> {
    let path = list.path_of(ring);
    let every = (path.len() / MOST_ASKED).max(1);
    // Rings may touch at vertices: middles of edges are asked.
    let middles = path.windows(2).step_by(every).map(|ends| ends[0] + (ends[1] - ends[0]) * 0.5);
    let others = || member.iter().filter(|other| other.part != ring.part).map(|other| list.path_of(other));
    let is_in_odd =
        |at: Plan| others().flat_map(|other| other.windows(2)).filter(|e| is_crossed(e, at)).count() % 2 == 1;
    let (mut odd, mut all) = (0, 0);
    for at in middles {
        odd += usize::from(is_in_odd(at));
        all += 1;
    }
    (2 * odd != all).then_some(2 * odd > all)
}

/// Whether a ray from a point to the east crosses an edge, half-open.
fn is_crossed(edge: &[Plan], at: Plan) -> bool {
    let rises = edge[0].y <= at.y;
    rises != (edge[1].y <= at.y) && (orient2d(edge[0], edge[1], at) > 0.0) == rises
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_turns_to_the_side_on_which_it_encloses_more() {
        let path = |points: &[(f64, f64)]| points.iter().map(|(x, y)| Plan::new(*x, *y)).collect::<Vec<_>>();
        let square = path(&[(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0), (0.0, 0.0)]);
        assert_eq!(turns_left(&square), Some(true));
        let back: Vec<Plan> = square.iter().rev().copied().collect();
        assert_eq!(turns_left(&back), Some(false));
        let bow = path(&[(0.0, 0.0), (3.0, 3.0), (3.0, 0.0), (0.0, 2.0), (0.0, 0.0)]);
        assert_eq!(turns_left(&bow), Some(false), "the lobe on its right is the larger one");
        let even_bow = path(&[(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 2.0), (0.0, 0.0)]);
        assert_eq!(turns_left(&even_bow), None);
    }
}
