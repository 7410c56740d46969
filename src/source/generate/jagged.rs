//! Lines as jagged as nature's: middles of middles, each displaced to the side (midpoint displacement: Fournier, Fussell, Carpenter 1982).

use super::random::{scramble, signed};
use crate::math::{cos, sin};
use crate::space::Plan;
use glam::DVec2;
use std::f64::consts::TAU;

/// Corners of a shore before its sides are made jagged.
const CORNERS: usize = 6;

/// Appends the way between two points, the last one left out: so many pieces, at least one. Each middle is displaced by up to `roughness` of the
/// way that it halves; at 0.2 or less none of it is farther off the straight way than half of that's length.
pub(super) fn jagged(
    line: &mut Vec<Plan>,
    (from, to): (Plan, Plan),
    pieces: usize,
    roughness: f64,
    hash: u64,
) {
    let start = line.len();
    line.resize(start + pieces.max(1), from);
    displace(&mut line[start..], (from, to), 0, roughness, hash);
}

/// Sets all but the first of `line`, whose number in the whole line is `first`; `to` follows its last.
fn displace(line: &mut [Plan], (from, to): (Plan, Plan), first: usize, roughness: f64, hash: u64) {
    let half = line.len() / 2;
    if half == 0 {
        return;
    }
    let side = roughness * signed(scramble(hash ^ (first + half) as u64));
    let share = half as f64 / line.len() as f64;
    let middle = from + (to - from) * share + (to - from).perp() * side;
    line[half] = middle;
    let (before, after) = line.split_at_mut(half);
    displace(before, (from, middle), first, roughness, hash);
    displace(after, (middle, to), first + half, roughness, hash);
}

/// The same way from its end to its start, its start left out.
pub(super) fn jagged_backwards(
    line: &mut Vec<Plan>,
    (from, to): (Plan, Plan),
    pieces: usize,
    roughness: f64,
    hash: u64,
) {
    let start = line.len();
    jagged(line, (from, to), pieces, roughness, hash);
    line.push(to);
    line[start..].reverse();
    line.pop();
}

/// A closed line around a point, counter-clockwise: `vertices` of them (at least three), none of them farther than `reach` from the middle.
pub(super) fn shore(middle: Plan, reach: f64, vertices: usize, hash: u64) -> Vec<Plan> {
    let corners = vertices.clamp(3, CORNERS);
    let turn = signed(hash);
    let corner = |k: usize| {
        let angle = TAU * ((k % corners) as f64 + turn) / corners as f64;
        let far = reach * (0.75 + 0.1 * signed(scramble(hash ^ (k % corners) as u64)));
        middle + DVec2::new(cos(angle), sin(angle)) * far
    };
    let mut ring = Vec::with_capacity(vertices.max(3));
    let vertices = vertices.max(3);
    let until = |k: usize| k * vertices / corners;
    let mut from = corner(0);
    for k in 0..corners {
        let to = corner(k + 1);
        jagged(&mut ring, (from, to), until(k + 1) - until(k), 0.16, scramble(hash ^ (100 + k) as u64));
        from = to;
    }
    ring
}

#[cfg(test)]
mod tests {
    use super::*;

    const ENDS: (Plan, Plan) = (Plan::new(-3.0, 1.0), Plan::new(5.0, 7.0));

    #[test]
    fn a_line_has_as_many_pieces_as_asked_for_and_is_the_same_backwards() {
        for pieces in [1, 2, 3, 7, 8, 100] {
            let (mut there, mut back) = (vec![], vec![]);
            jagged(&mut there, ENDS, pieces, 0.2, 5);
            jagged_backwards(&mut back, ENDS, pieces, 0.2, 5);
            assert_eq!(there.len(), pieces);
            there.push(ENDS.1);
            back.push(ENDS.0);
            back.reverse();
            assert_eq!(there, back);
        }
    }

    #[test]
    fn no_piece_strays_farther_than_half_of_the_way() {
        let along = ENDS.1 - ENDS.0;
        for hash in 0..50 {
            let mut line = vec![];
            jagged(&mut line, ENDS, 500, 0.2, hash);
            let off = line.iter().map(|p| (along.perp_dot(*p - ENDS.0) / along.length()).abs());
            assert!(off.fold(0.0, crate::math::max) < 0.5 * along.length());
        }
    }

    #[test]
    fn a_shore_stays_within_its_reach_around_its_middle() {
        for vertices in [3, 4, 5, 6, 7, 50, 999] {
            for hash in 0..40 {
                let ring = shore(Plan::new(10.0, 20.0), 3.0, vertices, scramble(hash));
                assert_eq!(ring.len(), vertices);
                assert!(ring.iter().all(|p| (*p - Plan::new(10.0, 20.0)).length() <= 3.0));
                let twice: f64 =
                    (0..vertices).map(|k| ring[k].to_vec().perp_dot(ring[(k + 1) % vertices].to_vec())).sum();
                assert!(twice > 0.0, "{vertices} {hash}");
            }
        }
    }
}
