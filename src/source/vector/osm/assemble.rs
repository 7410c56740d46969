//! Ways of a relation, joined end to end into rings.

use super::block::Position;
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// What a relation says of a way: which side of an area it bounds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    Outer,
    Inner,
    /// It says nothing, or ways of both roles make one ring.
    Unknown,
}

/// The rings that ways make, as chains of node ids that begin and end with the same one; `None` where one stays open.
///
/// Outer ways are joined to outer ones and inner to inner, where all have roles and each kind closes; else ways are joined whatever their
/// roles. `place` knows each node.
pub(super) fn rings(
    ways: &[(&[i64], Role)],
    place: &impl Fn(i64) -> Position,
) -> Option<Vec<(Vec<i64>, Role)>> {
    let of_role = |role: Role| {
        let own: Vec<&[i64]> = ways.iter().filter(|way| way.1 == role).map(|way| way.0).collect();
        let rings = chained(&own, place)?;
        Some(rings.into_iter().map(move |ring| (ring, role)))
    };
    if ways.iter().all(|way| way.1 != Role::Unknown)
        && let Some((outer, inner)) = of_role(Role::Outer).zip(of_role(Role::Inner))
    {
        return Some(outer.chain(inner).collect());
    }
    let all: Vec<&[i64]> = ways.iter().map(|way| way.0).collect();
    Some(chained(&all, place)?.into_iter().map(|ring| (ring, Role::Unknown)).collect())
}

/// An end of a way.
#[derive(Debug, Clone, Copy)]
struct End {
    way: usize,
    is_last: bool,
}

impl End {
    /// The nodes of its way from this end on.
    fn inward<'a>(self, ways: &[&'a [i64]]) -> impl Iterator<Item = i64> + use<'a> {
        let nodes = ways[self.way];
        let count = nodes.len();
        (0..count).map(move |k| nodes[if self.is_last { count - 1 - k } else { k }])
    }
}

/// Where more than two ways meet, ends that lie beside one another around the node are joined: rings then touch, and never cross.
fn chained(ways: &[&[i64]], place: &impl Fn(i64) -> Position) -> Option<Vec<Vec<i64>>> {
    let mut at_node: BTreeMap<i64, Vec<End>> = BTreeMap::new();
    for (way, nodes) in ways.iter().enumerate() {
        let [first, .., last] = nodes else { return None };
        if first != last {
            at_node.entry(*first).or_default().push(End { way, is_last: false });
            at_node.entry(*last).or_default().push(End { way, is_last: true });
        }
    }
    // The end at which one goes on from the first and from the last node of each way; a closed one leads to itself.
    let mut onward: Vec<[End; 2]> = (0..ways.len()).map(|way| [End { way, is_last: false }; 2]).collect();
    for (node, mut ends) in at_node {
        if ends.len() > 2 {
            let from = place(node);
            let away = |end: &End| end.inward(ways).map(|id| offset(from, place(id))).find(|d| *d != [0; 2]);
            ends.sort_by(|a, b| around(away(a).unwrap_or_default(), away(b).unwrap_or_default()));
        }
        let (pairs, []) = ends.as_chunks() else { return None };
        for [a, b] in pairs {
            onward[a.way][usize::from(a.is_last)] = *b;
            onward[b.way][usize::from(b.is_last)] = *a;
        }
    }
    let mut is_used = vec![false; ways.len()];
    let mut rings = Vec::new();
    for (begin, way) in ways.iter().enumerate() {
        if std::mem::replace(&mut is_used[begin], true) {
            continue;
        }
        let mut ring = way.to_vec();
        let mut end = onward[begin][1];
        while !std::mem::replace(&mut is_used[end.way], true) {
            ring.extend(end.inward(ways).skip(1));
            end = onward[end.way][usize::from(!end.is_last)];
        }
        rings.push(ring);
    }
    Some(rings)
}

fn offset(from: Position, to: Position) -> [i64; 2] {
    [0, 1].map(|axis| i64::from(to[axis]) - i64::from(from[axis]))
}

/// The order of directions against the clock, from east on.
fn around(a: [i64; 2], b: [i64; 2]) -> Ordering {
    let is_south = |[x, y]: [i64; 2]| y < 0 || (y == 0 && x < 0);
    let [a_wide, b_wide] = [a, b].map(|d| d.map(i128::from));
    let turn = a_wide[0] * b_wide[1] - a_wide[1] * b_wide[0];
    is_south(a).cmp(&is_south(b)).then(0.cmp(&turn))
}

#[cfg(test)]
mod tests {
    use super::Role::{Inner, Outer, Unknown};
    use super::*;

    /// Rings of ways over nodes that lie by their numbers on a grid of ten columns.
    fn made(ways: &[(&[i64], Role)]) -> Option<Vec<(Vec<i64>, Role)>> {
        rings(ways, &|id| [(id % 10) as i32, (id / 10) as i32])
    }

    #[test]
    fn ways_in_any_order_and_direction_make_rings() {
        let ways: [(&[i64], Role); 4] =
            [(&[11, 12, 13], Outer), (&[37, 38, 49, 37], Outer), (&[25, 24, 13], Outer), (&[25, 11], Outer)];
        let rings = made(&ways).unwrap();
        assert_eq!(rings, [(vec![11, 12, 13, 24, 25, 11], Outer), (vec![37, 38, 49, 37], Outer)]);
    }

    #[test]
    fn what_stays_open_is_no_ring() {
        let open: [&[(&[i64], Role)]; 4] = [
            &[(&[1, 2, 13], Outer), (&[13, 4], Outer)],
            &[(&[], Outer)],
            &[(&[1], Outer)],
            &[(&[1, 2], Unknown)],
        ];
        for ways in open {
            assert!(made(ways).is_none(), "{ways:?}");
        }
    }

    #[test]
    fn ways_of_one_role_make_rings_of_their_own_where_others_touch_them() {
        // A square whose hole touches its corner 0; each is two ways.
        let ways: [(&[i64], Role); 4] =
            [(&[0, 9, 99], Outer), (&[0, 23, 44], Inner), (&[99, 90, 0], Outer), (&[44, 32, 0], Inner)];
        let rings = made(&ways).unwrap();
        assert_eq!(rings, [(vec![0, 9, 99, 90, 0], Outer), (vec![0, 23, 44, 32, 0], Inner)]);
    }

    #[test]
    fn where_a_role_is_wrong_ways_are_joined_all_the_same() {
        let ways: [(&[i64], Role); 2] = [(&[0, 9, 99], Outer), (&[99, 90, 0], Inner)];
        assert_eq!(made(&ways).unwrap(), [(vec![0, 9, 99, 90, 0], Unknown)]);
    }

    #[test]
    fn rings_touch_where_more_ways_meet_and_never_cross() {
        // Four ways from 5 up to 95, from left to right: two bands, or a band with a hole, however they are listed.
        let ways: [&[i64]; 4] = [&[5, 41, 95], &[95, 43, 5], &[5, 46, 95], &[5, 48, 95]];
        for first in 0..4 {
            let mut ways = ways.map(|way| (way, Outer));
            ways.rotate_left(first);
            ways.swap(1, 2);
            let pairs: Vec<Vec<i64>> = made(&ways)
                .unwrap()
                .into_iter()
                .map(|(ring, _)| {
                    let mut middles: Vec<i64> = ring.into_iter().filter(|id| id / 10 == 4).collect();
                    middles.sort_unstable();
                    middles
                })
                .collect();
            let crossing = [vec![41, 46], vec![43, 48]];
            assert!(pairs.iter().all(|pair| !crossing.contains(pair)), "{pairs:?}");
            assert_eq!(pairs.len(), 2);
        }
    }

    #[test]
    fn directions_are_ordered_against_the_clock_from_east_on() {
        let around_once = [[2, 0], [1, 1], [0, 5], [-1, 1], [-3, 0], [-1, -1], [0, -1], [1, -1]];
        for (k, a) in around_once.iter().enumerate() {
            for (n, b) in around_once.iter().enumerate() {
                assert_eq!(around(*a, *b), k.cmp(&n), "{a:?} {b:?}");
            }
        }
        assert_eq!(around([i64::from(u32::MAX), 1], [i64::from(u32::MAX), 2]), Ordering::Less);
    }
}
