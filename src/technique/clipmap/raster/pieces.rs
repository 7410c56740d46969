//! Strips of vertex pairs -> simple pieces that turn counter-clockwise.
//!
//! A strip's quadrilaterals could each be a piece. But neighbours share an edge, where every texel would have two pieces to be told
//! apart. So quadrilaterals are joined as long as both sides of the strip run forward along one of the four directions of the
//! texture: such a run covers no point twice. (It is a sum of pieces, so its winding numbers are not negative; a line across the
//! direction crosses each of its two sides at most once, so they are at most 1. Where its two ends lie side by side, that is not
//! so, and it is cut again.)

use crate::math::{max, min};
use crate::space::Texel;
use crate::technique::clipmap::tessellation::Pair;
use glam::DVec2;

/// How a strip draws two pairs whose quadrilateral is folded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Folded {
    /// As two triangles of a triangle strip (Fig. 8a).
    Triangles,
    /// As one polygon of a strip of quadrilaterals (Fig. 8b).
    Polygon,
}

/// East, west, south, north: bits of a set of directions.
const DIRECTIONS: [DVec2; 4] = [DVec2::X, DVec2::NEG_X, DVec2::Y, DVec2::NEG_Y];
const ALL: u8 = 0b1111;

/// Calls `piece` with each piece of a strip of pairs (left, right); y points south.
pub(super) fn of_strip(
    pairs: &[Pair<Texel>],
    folded: Folded,
    ring: &mut Vec<Texel>,
    piece: &mut dyn FnMut(&[Texel]),
) {
    let (mut start, mut common) = (0, ALL);
    for k in 1..pairs.len() {
        let (before, pair) = (&pairs[k - 1], &pairs[k]);
        if !is_counter_clockwise(before, pair) {
            run(&pairs[start..k], common, ring, piece);
            match folded {
                Folded::Triangles => triangles(before, pair, ring, piece),
                Folded::Polygon => polygon(before, pair, ring, piece),
            }
            (start, common) = (k, ALL);
            continue;
        }
        let own = directions(before, pair);
        if common & own == 0 && start + 1 < k {
            run(&pairs[start..k], common, ring, piece);
            (start, common) = (k - 1, own);
        } else {
            common &= own;
        }
    }
    run(&pairs[start..], common, ring, piece);
}

/// Whether the quadrilateral between two pairs turns counter-clockwise on the map at each of its corners.
#[inline(always)]
fn is_counter_clockwise(from: &Pair<Texel>, to: &Pair<Texel>) -> bool {
    let (start, end) = (from.right - from.left, to.left - to.right);
    let (right, left) = (to.right - from.right, from.left - to.left);
    // y points south: what turns left on the map has a negative product.
    (start.perp_dot(right) <= 0.0)
        & (right.perp_dot(end) <= 0.0)
        & (end.perp_dot(left) <= 0.0)
        & (left.perp_dot(start) <= 0.0)
}

/// The directions along which neither side of a quadrilateral runs back.
#[inline(always)]
fn directions(from: &Pair<Texel>, to: &Pair<Texel>) -> u8 {
    let bit = |runs: bool, k: u8| u8::from(runs) << k;
    bit((to.left.x >= from.left.x) & (to.right.x >= from.right.x), 0)
        | bit((to.left.x <= from.left.x) & (to.right.x <= from.right.x), 1)
        | bit((to.left.y >= from.left.y) & (to.right.y >= from.right.y), 2)
        | bit((to.left.y <= from.left.y) & (to.right.y <= from.right.y), 3)
}

/// A run of quadrilaterals as one piece, or as several where its ends lie side by side.
fn run(pairs: &[Pair<Texel>], directions: u8, ring: &mut Vec<Texel>, piece: &mut dyn FnMut(&[Texel])) {
    if pairs.len() < 2 {
        return;
    }
    let (first, last) = (&pairs[0], &pairs[pairs.len() - 1]);
    let is_apart = |d: &DVec2| {
        let along = |p: Texel| p.to_vec().dot(*d);
        max(along(first.left), along(first.right)) <= min(along(last.left), along(last.right))
    };
    let is_one = pairs.len() == 2
        || DIRECTIONS.iter().enumerate().any(|(k, d)| directions >> k & 1 == 1 && is_apart(d));
    if is_one {
        ring.clear();
        ring.extend(pairs.iter().map(|pair| pair.right));
        ring.extend(pairs.iter().rev().map(|pair| pair.left));
        return piece(ring);
    }
    let middle = pairs.len() / 2;
    run(&pairs[..=middle], directions, ring, piece);
    run(&pairs[middle..], directions, ring, piece);
}

/// A quadrilateral that is folded or turned over, as the two triangles of a triangle strip (Fig. 8a).
fn triangles(from: &Pair<Texel>, to: &Pair<Texel>, ring: &mut Vec<Texel>, piece: &mut dyn FnMut(&[Texel])) {
    let (a, b, c, d) = (from.left, from.right, to.left, to.right);
    triangle([a, b, c], ring, piece);
    triangle([b, d, c], ring, piece);
}

/// The same as the polygon that its four sides enclose (Fig. 8b): two triangles that meet in the crossing of two sides, or at a
/// diagonal.
fn polygon(from: &Pair<Texel>, to: &Pair<Texel>, ring: &mut Vec<Texel>, piece: &mut dyn FnMut(&[Texel])) {
    let corners = [from.left, from.right, to.right, to.left];
    for k in 0..2 {
        let [a, b, c, d] = [0, 1, 2, 3].map(|n| corners[(n + k) % 4]);
        if let Some(knot) = crossing((a, b), (c, d)) {
            triangle([b, c, knot], ring, piece);
            return triangle([d, a, knot], ring, piece);
        }
    }
    let [a, b, c, d] = corners;
    let is_split_by_ac = (b - a).perp_dot(c - a) * (c - a).perp_dot(d - a) >= 0.0;
    let halves = if is_split_by_ac { [[a, b, c], [a, c, d]] } else { [[b, c, d], [b, d, a]] };
    halves.into_iter().for_each(|half| triangle(half, ring, piece));
}

/// Where two segments cross.
fn crossing((a, b): (Texel, Texel), (c, d): (Texel, Texel)) -> Option<Texel> {
    let (ab, cd) = (b - a, d - c);
    let across = ab.perp_dot(cd);
    let t = (c - a).perp_dot(cd) / across;
    let s = (c - a).perp_dot(ab) / across;
    let is_within = |share: f64| share > 0.0 && share < 1.0;
    (is_within(t) && is_within(s)).then(|| a + ab * t)
}

/// A triangle, turned counter-clockwise.
pub(super) fn triangle([a, b, c]: [Texel; 3], ring: &mut Vec<Texel>, piece: &mut dyn FnMut(&[Texel])) {
    let turn = (b - a).perp_dot(c - a);
    if turn == 0.0 {
        return;
    }
    ring.clear();
    ring.extend(if turn < 0.0 { [a, b, c] } else { [a, c, b] });
    piece(ring);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pieces(pairs: &[[f64; 4]], folded: Folded) -> Vec<Vec<Texel>> {
        let pair = |&[a, b, c, d]: &[f64; 4]| Pair { left: Texel::new(a, b), right: Texel::new(c, d) };
        let pairs: Vec<Pair<Texel>> = pairs.iter().map(pair).collect();
        let mut found = Vec::new();
        of_strip(&pairs, folded, &mut Vec::new(), &mut |ring| found.push(ring.to_vec()));
        found
    }

    /// Area that is positive for what turns counter-clockwise on the map.
    fn area(ring: &[Texel]) -> f64 {
        -0.5 * (0..ring.len())
            .map(|k| ring[k].to_vec().perp_dot(ring[(k + 1) % ring.len()].to_vec()))
            .sum::<f64>()
    }

    #[test]
    fn a_strip_that_runs_east_is_one_piece() {
        let strip = [[0.0, 0.0, 0.0, 2.0], [3.0, 1.0, 3.0, 3.0], [6.0, 0.0, 6.0, 2.0], [9.0, -1.0, 9.5, 1.0]];
        let pieces = pieces(&strip, Folded::Triangles);
        assert_eq!((pieces.len(), pieces[0].len()), (1, 8));
        assert!(area(&pieces[0]) > 0.0);
    }

    #[test]
    fn a_strip_that_turns_back_is_cut_where_it_turns() {
        // Half a ring around (0, 0), from radius 2 to 3, walked clockwise on the map: left is outside.
        let pair = |k: usize| {
            let angle = std::f64::consts::PI * k as f64 / 8.0;
            let (x, y) = (-crate::math::cos(angle), -crate::math::sin(angle));
            [3.0 * x, 3.0 * y, 2.0 * x, 2.0 * y]
        };
        let whole: Vec<[f64; 4]> = (0..=16).map(pair).collect();
        let found = pieces(&whole, Folded::Triangles);
        assert!((2..=6).contains(&found.len()), "{}", found.len());
        let sum: f64 = found.iter().map(|ring| area(ring)).sum();
        assert!(found.iter().all(|ring| area(ring) > 0.0));
        // 16-gons of these radii: 8 sin(2 pi / 16) r^2.
        let expected = 8.0 * crate::math::sin(std::f64::consts::PI / 8.0) * 5.0;
        assert!((sum - expected).abs() < 1e-9, "{sum} {expected}");
    }

    #[test]
    fn a_folded_joint_is_two_triangles_that_overlap_or_that_meet_in_a_point() {
        // A joint by method 3a: a line east, then back to the north-west.
        let joint = [[0.0, -1.0, 0.0, 1.0], [-0.6, 0.8, 0.6, -0.8]];
        let strip: f64 = pieces(&joint, Folded::Triangles).iter().map(|ring| area(ring)).sum();
        let quads = pieces(&joint, Folded::Polygon);
        assert_eq!(quads.len(), 2);
        assert!(quads.iter().all(|ring| ring.iter().any(|p| p.to_vec().length() < 1e-12)));
        let knotted: f64 = quads.iter().map(|ring| area(ring)).sum();
        assert!(strip > knotted && knotted > 0.0, "{strip} {knotted}");
    }

    #[test]
    fn a_run_whose_ends_lie_side_by_side_is_cut() {
        let bow = [[0.0, 0.0, 5.0, 1.0], [0.5, -2.0, 5.5, -1.0], [1.0, -4.0, 6.0, -3.0]];
        assert_eq!(pieces(&bow, Folded::Triangles).len(), 1, "its ends are apart from south to north");
        let flat = [[0.0, 0.0, 5.0, 1.0], [0.5, -0.2, 5.5, 0.8], [1.0, -0.4, 6.0, 0.6]];
        assert_eq!(pieces(&flat, Folded::Triangles).len(), 2);
    }

    #[test]
    fn strips_without_area_cover_nothing() {
        assert!(pieces(&[[0.0, 0.0, 0.0, 1.0]], Folded::Triangles).is_empty());
        assert!(pieces(&[], Folded::Polygon).is_empty());
        let flat = pieces(&[[0.0, 0.0, 0.0, 0.0], [1.0, 0.0, 1.0, 0.0]], Folded::Polygon);
        assert!(flat.iter().all(|ring| area(ring) == 0.0));
    }
}
