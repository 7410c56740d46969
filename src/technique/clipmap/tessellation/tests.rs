//! Vertex sequences of the paper, and areas of what they cover.

use super::*;

use crate::technique::clipmap::rational::union_area;
use proptest::prelude::*;

const ALL: [Joints; 7] = [
    Joints::Combined,
    Joints::Isolated,
    Joints::Corner,
    Joints::BevelStrip,
    Joints::BevelQuads,
    Joints::BevelInner,
    Joints::Style,
];

fn plan(points: &[[f64; 2]]) -> Vec<Plan> {
    points.iter().map(|p| Plan::new(p[0], p[1])).collect()
}

fn rule(joints: Joints) -> Rule {
    Rule::new(joints, 90.0, Join::Bevel, Cap::Butt).unwrap()
}

fn styled(join: Join, cap: Cap) -> Rule {
    Rule::new(Joints::Style, 90.0, join, cap).unwrap()
}

fn strips(rule: &Rule, points: &[[f64; 2]], is_loop: bool, width: f64) -> Strips {
    let mut out = Strips::default();
    let vertices = plan(points);
    let line = Polyline { vertices: &vertices, is_loop };
    rule.tessellate(&line, width, Sagitta::DEFAULT, &mut out).unwrap();
    out
}

/// Vertices to a hundredth, strip by strip.
fn rounded(strips: &Strips) -> Vec<Vec<[f64; 2]>> {
    let near = |v: f64| (v * 100.0).round() / 100.0 + 0.0;
    let of_pair = |pair: Pair<Plan>| [pair.left, pair.right].map(|p| [near(p.x), near(p.y)]);
    strips.iter().map(|strip| strip.iter().flat_map(|v| of_pair(v.pair(1.0))).collect()).collect()
}

/// The triangles of all strips, each a convex shape.
fn triangles(strips: &Strips) -> Vec<Vec<[f64; 2]>> {
    let mut all = Vec::new();
    for strip in strips.iter() {
        let vertices: Vec<[f64; 2]> = strip
            .iter()
            .map(|v| v.pair(1.0))
            .flat_map(|p| [[p.left.x, p.left.y], [p.right.x, p.right.y]])
            .collect();
        all.extend(vertices.windows(3).map(<[[f64; 2]]>::to_vec).filter(|t| area(t) > 0.0));
    }
    all
}

fn area(ring: &[[f64; 2]]) -> f64 {
    let cross = |k: usize| {
        let (a, b) = (ring[k], ring[(k + 1) % ring.len()]);
        a[0] * b[1] - a[1] * b[0]
    };
    0.5 * (0..ring.len()).map(cross).sum::<f64>().abs()
}

const EVERYWHERE: [f64; 4] = [-1e3, -1e3, 1e3, 1e3];

/// The area that triangles cover, and the sum of their areas.
fn areas(strips: &Strips) -> (f64, f64) {
    let triangles = triangles(strips);
    (union_area(&triangles, EVERYWHERE), triangles.iter().map(|t| area(t)).sum())
}

/// The footprint of an open line with butt caps: its rectangles, and wedges (or mitres up to a limit) between them.
fn footprint(points: &[[f64; 2]], half: f64, limit: Option<f64>) -> Vec<Vec<[f64; 2]>> {
    let normal = |k: usize| {
        let (dx, dy) = (points[k + 1][0] - points[k][0], points[k + 1][1] - points[k][1]);
        let length = (dx * dx + dy * dy).sqrt();
        [-dy / length * half, dx / length * half]
    };
    let moved = |p: [f64; 2], n: [f64; 2], s: f64| [p[0] + s * n[0], p[1] + s * n[1]];
    let mut shapes = Vec::new();
    for k in 0..points.len() - 1 {
        let n = normal(k);
        let (a, b) = (points[k], points[k + 1]);
        shapes.push(vec![moved(a, n, 1.0), moved(a, n, -1.0), moved(b, n, -1.0), moved(b, n, 1.0)]);
        if k > 0 {
            let before = normal(k - 1);
            let turn = before[0] * n[1] - before[1] * n[0];
            let side = if turn > 0.0 { -1.0 } else { 1.0 };
            let (p, q) = (moved(a, before, side), moved(a, n, side));
            let one_plus = 1.0 + (before[0] * n[0] + before[1] * n[1]) / (half * half);
            let tip = [(before[0] + n[0]) / one_plus, (before[1] + n[1]) / one_plus];
            shapes.push(match limit {
                Some(limit) if limit * limit * one_plus >= 2.0 => vec![a, p, moved(a, tip, side), q],
                _ => vec![a, p, q],
            });
        }
    }
    shapes.into_iter().filter(|shape| area(shape) > 0.0).collect()
}

#[test]
fn an_isolated_segment_has_the_four_vertices_of_method_1() {
    for joints in ALL {
        let strips = strips(&rule(joints), &[[0.0, 0.0], [10.0, 0.0]], false, 2.0);
        assert_eq!(rounded(&strips), [[[0.0, 1.0], [0.0, -1.0], [10.0, 1.0], [10.0, -1.0]]], "{joints:?}");
    }
}

#[test]
fn a_wide_angle_has_the_intersections_of_method_2() {
    let bend = [[0.0, 0.0], [10.0, 0.0], [20.0, 10.0]];
    for joints in [Joints::Combined, Joints::Corner] {
        // tan(45 / 2) = 0.4142.
        let expected = [[0.0, 1.0], [0.0, -1.0], [9.59, 1.0], [10.41, -1.0], [19.29, 10.71], [20.71, 9.29]];
        assert_eq!(rounded(&strips(&rule(joints), &bend, false, 2.0)), [expected], "{joints:?}");
    }
}

#[test]
fn an_acute_right_turn_has_the_sequence_of_method_3b() {
    // v1l v1r v2l v2i v2l' v2i v3l v3r, the turn is to the right by 135 degrees.
    let sharp = [[0.0, 0.0], [10.0, 0.0], [0.0, -10.0]];
    let c = std::f64::consts::FRAC_1_SQRT_2;
    let inner = [10.0 - (1.0 + 2f64.sqrt()), -1.0];
    let near = |v: f64| (v * 100.0).round() / 100.0;
    let expected = [
        [0.0, 1.0],
        [0.0, -1.0],
        [10.0, 1.0],
        inner.map(near),
        [near(10.0 + c), near(-c)],
        inner.map(near),
        [near(c), near(-10.0 - c)],
        [near(-c), near(-10.0 + c)],
    ];
    for joints in [Joints::Combined, Joints::BevelInner] {
        assert_eq!(rounded(&strips(&rule(joints), &sharp, false, 2.0)), [expected], "{joints:?}");
    }
}

#[test]
fn an_acute_left_turn_has_the_sequence_of_method_3b() {
    // v1l v1r v2i v2r v2i v2r' v3l v3r.
    let found =
        rounded(&strips(&rule(Joints::Combined), &[[0.0, 0.0], [10.0, 0.0], [0.0, 10.0]], false, 2.0));
    assert_eq!(found[0].len(), 8);
    assert_eq!((found[0][2], found[0][4]), ([7.59, 1.0], [7.59, 1.0]), "v2i twice");
    assert_eq!((found[0][3], found[0][5]), ([10.0, -1.0], [10.71, 0.71]), "v2r, v2r'");
}

#[test]
fn method_3a_keeps_both_segments_own_vertices() {
    let sharp = [[0.0, 0.0], [10.0, 0.0], [0.0, 10.0]];
    for joints in [Joints::BevelStrip, Joints::BevelQuads] {
        let found = rounded(&strips(&rule(joints), &sharp, false, 2.0));
        assert_eq!(found.len(), 1);
        assert_eq!(found[0][2..6], [[10.0, 1.0], [10.0, -1.0], [9.29, -0.71], [10.71, 0.71]], "{joints:?}");
    }
}

#[test]
fn method_1_leaves_the_segments_unconnected() {
    let found =
        rounded(&strips(&rule(Joints::Isolated), &[[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]], false, 2.0));
    assert_eq!(
        found,
        [
            [[0.0, 1.0], [0.0, -1.0], [10.0, 1.0], [10.0, -1.0]],
            [[9.0, 0.0], [11.0, 0.0], [9.0, 10.0], [11.0, 10.0]],
        ]
    );
    let round = strips(&rule(Joints::Isolated), &[[0.0, 0.0], [9.0, 0.0], [0.0, 9.0]], true, 1.0);
    assert_eq!(round.iter().count(), 3, "one strip a segment of a loop too");
}

#[test]
fn the_threshold_decides_between_methods_2_and_3b() {
    // The angle between the segments of these lines is 60 degrees.
    let bend = [[0.0, 0.0], [10.0, 0.0], [5.0, 75f64.sqrt()]];
    let pairs = |angle: f64| {
        let rule = Rule::new(Joints::Combined, angle, Join::Bevel, Cap::Butt).unwrap();
        strips(&rule, &bend, false, 1.0).vertices.len()
    };
    assert_eq!([59.0, 60.0, 61.0].map(pairs), [3, 3, 4], "an angle equal to the threshold is not below it");
}

#[test]
fn right_angles_are_mitred_however_the_line_is_turned() {
    for k in 0..720 {
        let angle = f64::from(k) * 0.5f64.to_radians();
        let d = [crate::math::cos(angle) * 7.3, crate::math::sin(angle) * 7.3];
        let bend = [[0.0, 0.0], d, [d[0] - d[1], d[1] + d[0]]];
        assert_eq!(strips(&rule(Joints::Combined), &bend, false, 1.0).vertices.len(), 3, "{k}");
    }
}

#[test]
fn a_loop_ends_with_the_pair_that_it_begins_with() {
    let square = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]];
    let found = rounded(&strips(&rule(Joints::Combined), &square, true, 2.0));
    let expected = [
        [1.0, 1.0],
        [-1.0, -1.0],
        [9.0, 1.0],
        [11.0, -1.0],
        [9.0, 9.0],
        [11.0, 11.0],
        [1.0, 9.0],
        [-1.0, 11.0],
        [1.0, 1.0],
        [-1.0, -1.0],
    ];
    assert_eq!(found, [expected]);
    // A triangle with an acute joint where it begins: the bevel comes last.
    let triangle = [[0.0, 0.0], [10.0, 0.0], [0.0, 10.0]];
    let strip = &strips(&rule(Joints::Combined), &triangle, true, 2.0);
    let pairs = strip.iter().next().unwrap();
    assert_eq!(pairs.first(), pairs.last());
    let (union, sum) = areas(strip);
    assert!((union - sum).abs() < 1e-9, "{union} {sum}");
}

#[test]
fn every_turn_from_180_degrees_to_a_trillionth_of_one_is_finite_and_covers_its_segments() {
    let turns =
        [180.0, 179.999_999, 179.9, 170.0, 135.0, 90.0, 89.999, 45.0, 1.0, 1e-3, 1e-6, 1e-9, 1e-12, 0.0];
    for joints in ALL {
        for turn in turns.into_iter().flat_map(|turn| [turn, -turn]) {
            let angle = f64::to_radians(turn);
            let end = match turn.abs() {
                180.0 => [2.0, 0.0],
                0.0 => [18.0, 0.0],
                _ => [10.0 + 8.0 * crate::math::cos(angle), 8.0 * crate::math::sin(angle)],
            };
            let line = [[0.0, 0.0], [10.0, 0.0], end];
            let found = strips(&rule(joints), &line, false, 1.0);
            assert!(found.vertices().all(Plan::is_finite), "{joints:?} {turn}");
            if joints == Joints::Corner && turn.abs() > 135.0 {
                // "Method 2 is not adequate for narrow angles" (4.2.3): its inner corner lies beyond the segment.
                continue;
            }
            let rectangles: Vec<_> =
                line.windows(2).flat_map(|segment| footprint(segment, 0.5, None)).collect();
            let covered = triangles(&found);
            let both: Vec<_> = covered.iter().chain(&rectangles).cloned().collect();
            let (own, all) = (union_area(&covered, EVERYWHERE), union_area(&both, EVERYWHERE));
            assert!((own - all).abs() < 1e-6 * all, "{joints:?} {turn}: {own} of {all}");
        }
    }
}

#[test]
fn method_2_has_corners_up_to_a_million_half_widths_and_bevels_what_turns_back_farther() {
    // The corner of a turn of 180 - a degrees is 1 / sin(a / 2) half widths from its vertex.
    for (short_of, expected) in
        [(1e-2, Some(11_459.156)), (1.2e-4, Some(954_929.7)), (1e-4, None), (1e-9, None)]
    {
        let angle = f64::to_radians(short_of);
        let points =
            [[-1e6, 0.0], [0.0, 0.0], [-1e6 * crate::math::cos(angle), 1e6 * crate::math::sin(angle)]];
        let strips = strips(&rule(Joints::Corner), &points, false, 2.0);
        let strip = strips.iter().next().unwrap();
        match expected {
            Some(distance) => {
                let corner = strip[1].pair(1.0).left;
                let found = (corner.x * corner.x + corner.y * corner.y).sqrt();
                assert!((found / distance - 1.0).abs() < 1e-4, "{short_of}: {found}");
                assert_eq!(strip.len(), 3);
            }
            None => assert_eq!(strip.len(), 4, "{short_of}: both segments' own vertices"),
        }
    }
}

#[test]
fn small_turns_move_vertices_continuously() {
    // Hard case 19: turns of 1e-3 to 1e-12 degrees.
    let mitred = styled(Join::Miter { limit: 4.0 }, Cap::Butt);
    for rule in [rule(Joints::Combined), rule(Joints::Corner), mitred] {
        for exponent in [3, 6, 9, 12] {
            let turn: f64 = format!("1e-{exponent}").parse().unwrap();
            let angle = turn.to_radians();
            let line = [
                [0.0, 0.0],
                [10.0, 0.0],
                [10.0 + 10.0 * crate::math::cos(angle), 10.0 * crate::math::sin(angle)],
            ];
            let straight = strips(&rule, &[[0.0, 0.0], [10.0, 0.0], [20.0, 0.0]], false, 1.0);
            let bent = strips(&rule, &line, false, 1.0);
            for (a, b) in straight.vertices().zip(bent.vertices()) {
                assert!((a - b).length() <= 11.0 * angle + 1e-15, "{rule:?} {turn}");
            }
        }
    }
}

#[test]
fn inner_lines_that_do_not_meet_fall_back_to_method_3a() {
    // The second segment is shorter than what the inner intersection would cut off it.
    let short = [[0.0, 0.0], [10.0, 0.0], [9.5, 0.5]];
    let combined = strips(&rule(Joints::Combined), &short, false, 2.0);
    assert_eq!(combined, strips(&rule(Joints::BevelStrip), &short, false, 2.0));
}

#[test]
fn method_3b_overlaps_nowhere_and_method_3a_does() {
    let zigzag = [[0.0, 0.0], [20.0, 0.0], [5.0, 12.0], [25.0, 14.0], [3.0, 30.0]];
    let of = |joints| areas(&strips(&rule(joints), &zigzag, false, 1.5));
    let (union, sum) = of(Joints::BevelInner);
    assert!((union - sum).abs() < 1e-9, "{union} {sum}");
    for joints in [Joints::BevelStrip, Joints::Isolated] {
        let (union, sum) = of(joints);
        assert!(sum > union + 0.5, "{joints:?}: {union} {sum}");
    }
}

/// A line of segments that are longer than four widths.
fn long_segments() -> impl Strategy<Value = Vec<[f64; 2]>> {
    let step = (4.0..9.0f64, -3.1..3.1f64);
    prop::collection::vec(step, 1..5).prop_map(|steps| {
        let (mut at, mut angle) = ([0.0, 0.0], 0.3);
        let mut line = vec![at];
        for (length, turn) in steps {
            angle += turn;
            at = [at[0] + length * crate::math::cos(angle), at[1] + length * crate::math::sin(angle)];
            line.push(at);
        }
        line
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn algorithm_1_covers_the_footprint_with_mitres_up_to_its_threshold(line in long_segments(), angle in 60.0..120.0f64) {
        let rule = Rule::new(Joints::Combined, angle, Join::Bevel, Cap::Butt).unwrap();
        let strips = strips(&rule, &line, false, 0.4);
        // A joint of that angle has the miter ratio 1 / sin(angle / 2).
        let limit = 1.0 / crate::math::sin(0.5 * angle.to_radians());
        let right = union_area(&footprint(&line, 0.2, Some(limit)), EVERYWHERE);
        let (union, _) = areas(&strips);
        prop_assert!((union - right).abs() < 1e-6, "{union} {right}");
    }

    #[test]
    fn a_styles_strips_cover_the_footprint_however_short_the_segments(
        line in long_segments(), width in 0.1..12.0f64, mitred in any::<bool>(),
    ) {
        let (join, limit) = if mitred { (Join::Miter { limit: 3.0 }, Some(3.0)) } else { (Join::Bevel, None) };
        let strips = strips(&styled(join, Cap::Butt), &line, false, width);
        let right = union_area(&footprint(&line, 0.5 * width, limit), EVERYWHERE);
        let (union, _) = areas(&strips);
        prop_assert!((union - right).abs() < 1e-6 * right, "{union} {right}");
    }

    #[test]
    fn parts_of_a_line_have_the_pairs_of_the_whole(line in long_segments(), is_loop in any::<bool>()) {
        prop_assume!(line.len() > 3);
        for joints in ALL {
            let rule = styled_or(joints);
            let vertices = plan(&line);
            let polyline = Polyline { vertices: &vertices, is_loop };
            let (mut whole, mut parts) = (Strips::default(), Strips::default());
            rule.part(&polyline, 0..polyline.segments(), 0.3, Sagitta::DEFAULT, &mut whole);
            for segment in 0..polyline.segments() {
                rule.part(&polyline, segment..segment + 1, 0.3, Sagitta::DEFAULT, &mut parts);
            }
            let quads = |strips: &Strips| -> Vec<[OffsetVertex; 2]> {
                strips.iter().flat_map(|strip| strip.windows(2).map(|w| [w[0], w[1]])).collect()
            };
            prop_assert_eq!(quads(&whole), quads(&parts), "{:?}", joints);
        }
    }
}

fn styled_or(joints: Joints) -> Rule {
    Rule::new(joints, 90.0, Join::Round, Cap::Round).unwrap()
}

/// Where triangles and a distance of `reach` from a line disagree, of a lattice of points.
fn disagreements(strips: &Strips, points: &[[f64; 2]], is_loop: bool, reach: f64) -> usize {
    let triangles = triangles(strips);
    let inside = |p: [f64; 2]| {
        triangles.iter().any(|t| {
            let side = |k: usize| {
                let (a, b) = (t[k], t[(k + 1) % 3]);
                (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
            };
            (0..3).all(|k| side(k) >= 0.0) || (0..3).all(|k| side(k) <= 0.0)
        })
    };
    let distance = |p: [f64; 2]| {
        let segments = if is_loop { points.len() } else { points.len() - 1 };
        let to = |k: usize| {
            let (a, b) = (points[k], points[(k + 1) % points.len()]);
            let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
            let t = (((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / (dx * dx + dy * dy)).clamp(0.0, 1.0);
            let (x, y) = (p[0] - a[0] - t * dx, p[1] - a[1] - t * dy);
            (x * x + y * y).sqrt()
        };
        (0..segments).map(to).fold(f64::INFINITY, crate::math::min)
    };
    let at = |k: usize| 10.0 * (k as f64 + 0.5) / 80.0 - 5.0;
    let lattice = (0..80 * 80).map(|k| [at(k % 80), at(k / 80)]);
    // A side of a circle stays up to a 2048th of the radius within it.
    lattice
        .filter(|p| (distance(*p) - reach).abs() > reach / 1000.0 && inside(*p) != (distance(*p) < reach))
        .count()
}

#[test]
fn round_joins_and_caps_are_discs_up_to_their_sides() {
    // Hard case 24 in small: a stroke much wider than its segments is the Minkowski sum with a disc.
    let ring: Vec<[f64; 2]> = (0..12)
        .map(|k| {
            let angle = std::f64::consts::TAU * f64::from(k) / 12.0;
            [2.0 * crate::math::cos(angle), 2.0 * crate::math::sin(angle)]
        })
        .collect();
    let round = styled(Join::Round, Cap::Round);
    assert_eq!(disagreements(&strips(&round, &ring, true, 5.0), &ring, true, 2.5), 0);
    let bend = [[-3.0, -1.0], [1.0, 0.5], [-1.0, 3.0], [-1.2, 2.9], [2.0, -2.0]];
    for reach in [0.3, 0.7, 1.5] {
        let found = disagreements(&strips(&round, &bend, false, 2.0 * reach), &bend, false, reach);
        assert_eq!(found, 0, "{reach}");
    }
}

#[test]
fn dots_are_what_their_caps_are() {
    let dot = |cap| {
        let mut out = Strips::default();
        styled(Join::Round, cap).dot(Plan::new(3.0, 4.0), 0.5, Sagitta::DEFAULT, &mut out);
        // A dot's triangles do not overlap.
        triangles(&out).iter().map(|t| area(t)).sum::<f64>()
    };
    assert_eq!(dot(Cap::Butt), 0.0);
    assert!((dot(Cap::Square) - 1.0).abs() < 1e-12);
    assert!((dot(Cap::Round) - std::f64::consts::FRAC_PI_4).abs() < 1e-3);
}

#[test]
fn what_cannot_be_tessellated_is_refused_with_a_reason() {
    let refused = |points: &[[f64; 2]], width: f64| {
        let vertices = plan(points);
        let line = Polyline { vertices: &vertices, is_loop: false };
        let mut out = Strips::default();
        let error = rule(Joints::Combined).tessellate(&line, width, Sagitta::DEFAULT, &mut out).unwrap_err();
        assert_eq!(out, Strips::default());
        error.to_string()
    };
    assert!(refused(&[], 1.0).contains("without vertices"));
    assert!(refused(&[[1.0, 2.0]], 1.0).contains("of one vertex"));
    assert!(refused(&[[1.0, 2.0]; 3], 1.0).contains("all the same"));
    for width in [f64::NAN, f64::INFINITY, 0.0, -1.0] {
        assert!(refused(&[[0.0, 0.0], [1.0, 0.0]], width).contains("a width of"), "{width}");
    }
    assert!(refused(&[[0.0, 0.0], [f64::NAN, 0.0]], 1.0).contains("vertex 1"));
    for angle in [0.0, 180.0, -5.0, f64::NAN] {
        let error = Rule::new(Joints::Combined, angle, Join::Bevel, Cap::Butt).unwrap_err();
        assert!(error.to_string().contains("threshold"), "{angle}");
    }
}
