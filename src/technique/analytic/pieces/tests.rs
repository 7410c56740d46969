//! Pieces against the definition of strokes, point by point, and against areas that are known.

use super::super::coverage::{Coverage, Membership};
use super::*;
use crate::scene::Color;
use proptest::prelude::*;

const SAGITTA: f64 = 1e-3;

fn line(width: Width, join: Join, cap: Cap) -> Line {
    Line { color: Color([0.0, 0.0, 0.0, 1.0]), width, join, cap }
}

fn wide(half: f64) -> HalfWidth {
    HalfWidth { at: Plan::new(0.0, 0.0), half, gradient: DVec2::ZERO }
}

/// The segments of a chain.
fn segments(path: &[Plan], is_closed: bool) -> Vec<Segment> {
    let count = path.len();
    if count == 1 {
        return vec![Segment { before: None, from: path[0], to: path[0], is_last: true }];
    }
    let last = if is_closed { count } else { count - 1 };
    let of = |k: usize| Segment {
        before: match k {
            0 => is_closed.then(|| path[count - 1]),
            _ => Some(path[k - 1]),
        },
        from: path[k],
        to: path[(k + 1) % count],
        is_last: !is_closed && k + 1 == last,
    };
    (0..last).map(of).collect()
}

fn pieces_of(segments: &[Segment], line: &Line, half: &HalfWidth, near: &Near) -> Pieces {
    let mut pieces = Pieces::default();
    assert!(segments.iter().all(|segment| stroke_pieces(segment, line, half, near, &mut pieces)));
    pieces
}

fn around(middle: [f64; 2], half: f64) -> Near {
    let at = Plan::new(middle[0], middle[1]);
    Near { plan: PlanBox { min: at, max: at }.grown(half), sagitta: SAGITTA }
}

/// The area of a chain's stroke within a box around the origin.
fn area(path: &[Plan], is_closed: bool, line: &Line, half: &HalfWidth) -> f64 {
    let near = around([0.0, 0.0], 20.0);
    let pieces = pieces_of(&segments(path, is_closed), line, half, &near);
    let mut cover = Coverage::default();
    let corner = |x: f64, y: f64| DVec2::new(20.0 * x, 20.0 * y);
    cover.begin(&[corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)]);
    let item = cover.item(Membership { area: None, has_stroke: true }).unwrap();
    for ring in pieces.rings() {
        let ring: Vec<DVec2> = ring.iter().map(|p| p.to_vec()).collect();
        cover.piece(item, &ring);
    }
    cover.measure(usize::MAX).unwrap();
    cover.areas().iter().filter(|(set, _)| *set == 1).map(|(_, area)| area).sum()
}

fn path(points: &[[f64; 2]]) -> Vec<Plan> {
    points.iter().map(|[x, y]| Plan::new(*x, *y)).collect()
}

const METRES: Width = Width::Metres(2.0);
const PI: f64 = std::f64::consts::PI;

#[test]
fn caps_and_joins_of_a_right_angle_have_their_areas() {
    let angle = path(&[[-8.0, 0.0], [0.0, 0.0], [0.0, 6.0]]);
    // Two rectangles that share a quarter of a square.
    let both = 8.0 * 2.0 + 6.0 * 2.0 - 1.0;
    let cases = [
        (Join::Miter { limit: 4.0 }, Cap::Butt, both + 1.0),
        (Join::Miter { limit: 1.4 }, Cap::Butt, both + 0.5),
        (Join::Bevel, Cap::Square, both + 0.5 + 4.0),
        (Join::Round, Cap::Butt, both + PI / 4.0),
        (Join::Round, Cap::Round, both + PI / 4.0 + PI),
    ];
    for (join, cap, expected) in cases {
        let found = area(&angle, false, &line(METRES, join, cap), &wide(1.0));
        assert!((found - expected).abs() < 1e-9, "{join:?} {cap:?}: {found} {expected}");
    }
}

#[test]
fn a_closed_chain_is_joined_at_its_first_vertex() {
    let square = path(&[[-5.0, -5.0], [5.0, -5.0], [5.0, 5.0], [-5.0, 5.0]]);
    let expected = [(Join::Miter { limit: 4.0 }, 80.0), (Join::Bevel, 78.0), (Join::Round, 76.0 + PI)];
    for (join, expected) in expected {
        let found = area(&square, true, &line(METRES, join, Cap::Square), &wide(1.0));
        assert!((found - expected).abs() < 1e-9, "{join:?}: {found} {expected}");
    }
}

#[test]
fn dots_are_discs_and_squares_or_nothing() {
    let dot = path(&[[1.0, 2.0]]);
    for (cap, expected) in [(Cap::Round, PI), (Cap::Square, 4.0), (Cap::Butt, 0.0)] {
        let found = area(&dot, false, &line(METRES, Join::Round, cap), &wide(1.0));
        assert!((found - expected).abs() < 1e-9, "{cap:?}: {found} {expected}");
    }
    let dynamic = line(Width::Pixels(3.0), Join::Bevel, Cap::Butt);
    assert!((area(&dot, false, &dynamic, &wide(1.0)) - PI).abs() < 1e-9);
}

#[test]
fn a_width_that_grows_makes_ellipses_of_discs() {
    // Points nearer to a focus than 1 + x / 4: an ellipse of half axes p / (1 - e^2) and p / sqrt(1 - e^2).
    let half = HalfWidth { gradient: DVec2::new(0.25, 0.0), ..wide(1.0) };
    let dynamic = line(Width::Pixels(3.0), Join::Bevel, Cap::Butt);
    let e2: f64 = 1.0 - 0.0625;
    let expected = PI / (e2 * e2.sqrt());
    let found = area(&path(&[[0.0, 0.0]]), false, &dynamic, &half);
    assert!((found - expected).abs() < 1e-3, "{found} {expected}");
    let steep = HalfWidth { gradient: DVec2::new(0.6, 0.0), ..wide(1.0) };
    let dot = segments(&path(&[[0.0, 0.0]]), false)[0];
    assert!(!stroke_pieces(&dot, &dynamic, &steep, &around([0.0; 2], 1.0), &mut Pieces::default()));
}

/// How far inside of a stroke a point is by definition (negative: outside), the least of what decides it.
fn depth(segments: &[Segment], of: &Line, half: &HalfWidth, p: Plan) -> f64 {
    let deepest = segments.iter().map(|segment| depth_of(segment, of, half, p));
    deepest.fold(f64::NEG_INFINITY, math::max)
}

fn depth_of(segment: &Segment, of: &Line, half: &HalfWidth, p: Plan) -> f64 {
    let Segment { before, from, to, is_last } = *segment;
    let h = half.of(p);
    let disc = |at: Plan| h - (p - at).length();
    let (length, q) = ((to - from).length(), p - from);
    if let Width::Pixels(_) = of.width {
        let share = if length > 0.0 { (q.dot(to - from) / (length * length)).clamp(0.0, 1.0) } else { 0.0 };
        return disc(from + (to - from) * share);
    }
    let d2 = (to - from) / length;
    let cap = |is_end: bool| if is_end && of.cap == Cap::Square { h } else { 0.0 };
    let beside = h - q.perp_dot(d2).abs();
    let along = math::min(q.dot(d2) + cap(before.is_none()), length + cap(is_last) - q.dot(d2));
    let mut deepest = math::min(beside, along);
    if of.cap == Cap::Round {
        deepest = if before.is_none() { math::max(deepest, disc(from)) } else { deepest };
        deepest = if is_last { math::max(deepest, disc(to)) } else { deepest };
    }
    let Some(before) = before else { return deepest };
    let d1 = (from - before) / (from - before).length();
    let side = if d1.perp_dot(d2) > 0.0 { -1.0 } else { 1.0 };
    let (n1, n2, cosine) = (d1.perp() * side, d2.perp() * side, d1.dot(d2));
    let wedge = math::min(q.dot(d1), -q.dot(d2));
    let miter = math::min(h - q.dot(n1), h - q.dot(n2));
    let bevel = h * (1.0 + cosine) - q.dot(n1 + n2);
    let join = match of.join {
        Join::Round => disc(from),
        Join::Miter { limit } if limit * limit * (1.0 + cosine) > 2.0 => math::min(wedge, miter),
        _ => math::min(wedge, bevel),
    };
    math::max(deepest, join)
}

fn holds(ring: &[Plan], p: Plan) -> bool {
    let crosses = |k: usize| {
        let (a, b) = (ring[k], ring[(k + 1) % ring.len()]);
        (a.y <= p.y) != (b.y <= p.y) && ((b - a).perp_dot(p - a) > 0.0) == (a.y <= p.y)
    };
    (0..ring.len()).filter(|k| crosses(*k)).count() % 2 == 1
}

fn style() -> impl Strategy<Value = Line> {
    let join =
        prop_oneof![Just(Join::Round), Just(Join::Bevel), (1.0..4.0).prop_map(|limit| Join::Miter { limit })];
    let cap = prop_oneof![Just(Cap::Butt), Just(Cap::Square), Just(Cap::Round)];
    let width = prop_oneof![3 => Just(METRES), 1 => Just(Width::Pixels(2.0))];
    (width, join, cap).prop_map(|(width, join, cap)| line(width, join, cap))
}

fn plan_point() -> impl Strategy<Value = Plan> {
    (-4.0..4.0, -4.0..4.0).prop_map(|(x, y)| Plan::new(x, y))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn pieces_near_a_point_hold_it_when_the_stroke_does(
        path in prop::collection::vec(plan_point(), 2..5),
        (of, is_closed) in (style(), any::<bool>()),
        (half, gradient) in (0.05..3.0, [-0.3..0.3, -0.3..0.3]),
        (middle, size) in ([-5.0..5.0, -5.0..5.0], prop_oneof![Just(0.0), 0.01..2.0]),
        shares in prop::collection::vec([-1.0..1.0, -1.0..1.0], 8),
    ) {
        let is_dynamic = matches!(of.width, Width::Pixels(_));
        let gradient = if is_dynamic { DVec2::from_array(gradient) } else { DVec2::ZERO };
        let half = HalfWidth { at: Plan::new(middle[0], middle[1]), half, gradient };
        let near = around(middle, size);
        let segments = segments(&path, is_closed && path.len() > 2);
        let pieces = pieces_of(&segments, &of, &half, &near);
        for [x, y] in shares {
            let p = Plan::new(middle[0] + size * x, middle[1] + size * y);
            let depth = depth(&segments, &of, &half, p);
            // On a border either is right, near a round one both are within the bound.
            if depth.abs() > 3.0 * SAGITTA {
                prop_assert_eq!(pieces.rings().any(|ring| holds(ring, p)), depth > 0.0, "{:?} {}", p, depth);
            }
            let is_near = |segment: &Segment| {
                let most = math::max(half.of(p), 0.0) + SAGITTA;
                segment_box(segment, &of, most).meets(&PlanBox { min: p, max: p })
            };
            prop_assert!(depth < 0.0 || segments.iter().any(is_near));
        }
    }
}
