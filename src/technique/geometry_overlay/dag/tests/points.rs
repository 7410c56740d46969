//! The points of clippings: bits that neighbours share, heights of the triangle's plane.

use super::super::crossing::Direction;
use super::brute_force::{exact, rational};
use super::*;
use dashu::rational::RBig;

/// Heights without a pattern.
fn height([x, y]: Post) -> f64 {
    f64::from((x * 7919 + y * 104_729 + x * y * 31) % 1009) * 0.37
}

/// The exact height of a triangle's plane over a point.
fn plane_height(triangle: &RightTriangle, point: GridPoint) -> RBig {
    let [a, b, c] = triangle.corners().map(|post| exact(post.map(f64::from)));
    let [za, zb, zc] = triangle.corners().map(|post| rational(height(post)));
    let p = exact(point);
    let cross = |o: &[RBig; 2], u: &[RBig; 2], v: &[RBig; 2]| {
        let d = |end: &[RBig; 2], k: usize| end[k].clone() - o[k].clone();
        d(u, 0) * d(v, 1) - d(u, 1) * d(v, 0)
    };
    let whole = cross(&a, &b, &c);
    (za * cross(&p, &b, &c) + zb * cross(&p, &c, &a) + zc * cross(&p, &a, &b)) / whole
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn each_piece_begins_with_the_bits_that_the_last_one_ends_with_and_lies_in_its_triangles_plane(
        chain in chain([0, 0], SIDE),
        splits in splits(),
    ) {
        let block = block(0, 0, 1);
        let vertices = refined(Mesh::of_squares([0, 0], SIDE, 1, 0), &splits).vertices();
        let lods = lods(block, &[chain]);
        for quad in lods.polylines.iter().flat_map(|line| &line.quad_clippings) {
            let mut last: Option<[f64; 3]> = None;
            quad.traverse(|post| vertices.contains(&post), |clipping| {
                let points = quad.points(clipping, height, |height| !height.is_nan());
                let points: Vec<[f64; 3]> = points.map(|([x, y], z)| [x, y, z]).collect();
                assert_eq!(points.len(), clipping.point_count());
                if let (Some(last), Some(first)) = (last, points.first()) {
                    assert_eq!(last.map(f64::to_bits), first.map(f64::to_bits));
                }
                for [x, y, z] in &points {
                    let exact = plane_height(&clipping.triangle, [*x, *y]).to_f64().value();
                    assert!((z - exact).abs() < 1e-11, "{z} instead of {exact}");
                }
                last = points.last().copied();
            });
        }
    }

    #[test]
    fn a_crossing_is_the_double_next_to_the_rational_one_whichever_way_segment_and_edge_are_read(
        ends in prop::array::uniform2(prop::array::uniform2(prop_oneof![
            -20.0..20.0f64, -1e7..1e7f64, (-9..9i8).prop_map(f64::from), -1e-9..1e-9f64
        ])),
        post in prop::array::uniform2(2..6u32),
        way in 0..4usize,
    ) {
        let [p, q] = ends;
        let edge = [post, [[post[0], post[1] + 1], [post[0] + 1, post[1]], post.map(|at| at + 1), [post[0] + 1, post[1] - 1]][way]];
        // On which side of the edge's line: exact for these.
        let beyond = |point: GridPoint| {
            let [x, y] = [0, 1].map(|k| rational(point[k]) - RBig::from(post[k]));
            [x.clone(), y.clone(), x.clone() - y.clone(), x + y][way].clone()
        };
        let (from, to) = (beyond(p), beyond(q));
        prop_assume!(from != to && (from <= RBig::ZERO) != (to < RBig::ZERO));
        let crossing = Crossing::new(p, q, edge);
        prop_assert_eq!(crossing, Crossing::new(q, p, edge));
        prop_assert_eq!(crossing, Crossing::new(p, q, [edge[1], edge[0]]));
        prop_assert_eq!(crossing.direction, [Direction::Column, Direction::Row, Direction::Rising, Direction::Falling][way]);
        let share = from.clone() / (from - to);
        for k in 0..2 {
            let at = rational(p[k]) + (rational(q[k]) - rational(p[k])) * share.clone();
            let nearest = at.to_f64().value();
            prop_assert!((nearest.next_down()..=nearest.next_up()).contains(&crossing.at[k]), "{nearest} {:?}", crossing.at);
        }
    }
}

#[test]
fn a_clipping_over_a_triangle_with_a_missing_corner_has_no_points() {
    let lods = lods(block(0, 0, 1), &[vec![[-1.0, 2.5], [9.0, 2.5]]]);
    let quad = &lods.polylines[0].quad_clippings[0];
    let height = |post: Post| if post == [3, 3] { f64::NAN } else { 1.0 };
    let mut empty = BTreeSet::new();
    for clipping in &quad.triangle_clippings {
        let count = quad.points(clipping, height, |height| !height.is_nan()).count();
        assert_eq!(
            count,
            if clipping.triangle.corners().contains(&[3, 3]) { 0 } else { clipping.point_count() }
        );
        empty.extend((count == 0).then_some(clipping.triangle));
    }
    assert!(empty.len() >= 4, "{empty:?}");
}
