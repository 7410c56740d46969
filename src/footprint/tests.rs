use super::*;
use crate::scene::{Cap, Color, Feature, Fill, Join, Layer, Outline, OutlineMode, Rule, Shape, Style};
use proptest::prelude::*;

const PIXEL: PixelSize = PixelSize { pixel: 1.0, eye: None, away: Away::Over(0.0), ground: None };

fn line_style(width: f64, join: Join, cap: Cap) -> Style {
    let color = Color([1.0, 0.0, 0.0, 1.0]);
    Style { line: Some(Line { color, width: Width::Metres(width), join, cap }), ..Style::default() }
}

fn list(style: Style, shape: Shape) -> DrawList {
    DrawList::new(
        &mut [Layer::uniform("l", style, vec![Feature { index: 0, style: 0, shape }])],
        &PlanBox::EMPTY,
    )
    .unwrap()
}

fn footprints(list: &DrawList) -> Footprints<'_> {
    Footprints::new(list, PIXEL, &|_| true)
}

/// Whether a point lies in a part's stroke, in plain doubles.
fn holds(primitive: &Primitive, p: Plan) -> bool {
    match primitive {
        Primitive::Convex(shape) => shape.sides().iter().all(|s| {
            let v = p - s.at;
            s.normal[0].mid * v.x + s.normal[1].mid * v.y + s.offset.mid >= 0.0
        }),
        Primitive::Near { from, to, reach, .. } => distance(*from, *to, p) <= *reach,
        Primitive::Edge { .. } | Primitive::Perhaps(_) => false,
    }
}

/// The distance of a point from a segment, metres, in plain doubles.
fn distance(from: Plan, to: Plan, p: Plan) -> f64 {
    let (d, v): (glam::DVec2, glam::DVec2) = (to - from, p - from);
    let length_squared = d.length_squared();
    let t = if length_squared > 0.0 {
        crate::math::min(crate::math::max(v.dot(d) / length_squared, 0.0), 1.0)
    } else {
        0.0
    };
    (v - d * t).length()
}

fn stroke_holds(all: &Footprints, p: Plan) -> bool {
    let mut found = Vec::new();
    all.parts.iter().for_each(|part| all.primitives(*part, &mut found));
    found.iter().any(|primitive| holds(primitive, p))
}

fn polyline(points: &[(f64, f64)]) -> Shape {
    Shape::Line(vec![points.iter().map(|&(x, y)| Plan::new(x, y)).collect()])
}

#[test]
fn a_miter_reaches_its_tip_and_falls_to_a_bevel_over_its_limit() {
    let corner = [(-10.0, 0.0), (0.0, 0.0), (0.0, 10.0)];
    let with = |join| list(line_style(2.0, join, Cap::Butt), polyline(&corner));
    let (tip, middle) = (Plan::new(0.99, -0.99), Plan::new(0.49, -0.49));
    let [sharp, blunt] = [4.0, 1.2].map(|limit| with(Join::Miter { limit }));
    let (sharp, blunt) = (footprints(&sharp), footprints(&blunt));
    assert!(stroke_holds(&sharp, tip) && stroke_holds(&sharp, middle));
    assert!(!stroke_holds(&blunt, tip) && stroke_holds(&blunt, middle));
    assert!(!stroke_holds(&blunt, Plan::new(0.51, -0.51)));
}

#[test]
fn a_line_that_turns_back_has_no_join_beyond_its_end() {
    for join in [Join::Miter { limit: 100.0 }, Join::Bevel] {
        let list = list(line_style(2.0, join, Cap::Butt), polyline(&[(0.0, 0.0), (10.0, 0.0), (2.0, 0.0)]));
        let all = footprints(&list);
        assert!(!stroke_holds(&all, Plan::new(10.01, 0.0)) && stroke_holds(&all, Plan::new(9.99, 0.99)));
    }
}

#[test]
fn a_dot_has_the_shape_of_its_cap() {
    let same = [(3.0, 4.0); 3];
    let dot = |cap, x, y| {
        let list = list(line_style(2.0, Join::Round, cap), polyline(&same));
        stroke_holds(&footprints(&list), Plan::new(x, y))
    };
    assert!(!dot(Cap::Butt, 3.0, 4.0));
    assert!(dot(Cap::Square, 3.9, 4.9));
    assert!(!dot(Cap::Round, 3.9, 4.9) && dot(Cap::Round, 3.6, 4.6));
}

#[test]
fn a_line_that_ends_where_it_begins_is_a_ring() {
    let square = [(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0), (0.0, 0.0)];
    let style = line_style(2.0, Join::Miter { limit: 4.0 }, Cap::Butt);
    let list = list(style, polyline(&square));
    let all = footprints(&list);
    assert_eq!(all.parts.len(), 4);
    assert!(stroke_holds(&all, Plan::new(-0.9, -0.9)), "the corner where it closes is mitred");
}

#[test]
fn a_pentagram_is_hollow_by_one_rule_and_full_by_the_other() {
    let star: Vec<Plan> = (0..5)
        .map(|k| f64::from(k) * 0.8 * std::f64::consts::PI)
        .map(|a| Plan::new(100.0 * crate::math::cos(a), 100.0 * crate::math::sin(a)))
        .collect();
    let holds = |rule, x, y| {
        let fill = Some(Fill { color: Color([0.0, 0.0, 1.0, 1.0]), rule });
        let list = list(Style { fill, ..Style::default() }, Shape::Polygon(vec![star.clone()]));
        footprints(&list).polygon_holds(0, Plan::new(x, y))
    };
    assert!(!holds(Rule::EvenOdd, 1.0, 2.0) && holds(Rule::NonZero, 1.0, 2.0), "its middle");
    assert!(holds(Rule::EvenOdd, 95.0, 0.5) && holds(Rule::NonZero, 95.0, 0.5), "a tip");
}

#[test]
fn long_lines_that_pass_far_from_a_place_are_not_near_it() {
    let lines: Vec<Vec<Plan>> = (0..200)
        .map(|k| f64::from(k) * 5.0 - 500.0)
        .map(|y| vec![Plan::new(-1000.0, y - 1000.0), Plan::new(1000.0, y + 1000.0)])
        .collect();
    let list = list(line_style(0.01, Join::Bevel, Cap::Butt), Shape::Line(lines));
    let all = footprints(&list);
    let here = PlanBox::around([Plan::new(0.0, 0.0), Plan::new(1.0, 1.0)]);
    let (mut near, mut room) = (Vec::new(), Vec::new());
    all.parts_near(&here, |part| {
        near.push(part);
        true
    });
    near.sort_unstable();
    near.dedup();
    assert!(near.len() < 40, "{} of 200", near.len());
    near.retain(|part| !all.misses(*part, &here, &mut room));
    assert_eq!(near.len(), 1, "the one through the place");
}

#[test]
fn a_cut_outline_is_bounded_by_the_polygon_of_its_fill_which_is_there_once() {
    let color = Color([0.0, 0.0, 0.0, 1.0]);
    let line = Line { color, width: Width::Metres(1.0), join: Join::Bevel, cap: Cap::Butt };
    let ring = vec![Plan::new(0.0, 0.0), Plan::new(4.0, 0.0), Plan::new(0.0, 4.0)];
    let style = Style {
        fill: Some(Fill { color, rule: Rule::EvenOdd }),
        outline: Some(Outline { line, mode: OutlineMode::Inset }),
        ..Style::default()
    };
    let list = list(style, Shape::Polygon(vec![ring]));
    let all = footprints(&list);
    assert_eq!(all.areas.len(), 1);
    assert!(all.polygon_holds(1, Plan::new(1.0, 1.0)) && !all.polygon_holds(1, Plan::new(3.0, 3.0)));
    assert_eq!((all.wants_polygon(1), all.wants_stroke(1)), (Some(true), true));
    let mut of_outline: Vec<BorderPart> = all.parts.iter().copied().filter(|part| part.item == 1).collect();
    of_outline.dedup();
    let of_outline: Vec<u32> = of_outline.iter().map(|part| part.chain).collect();
    assert_eq!(of_outline, [0, 0, 0, 1, 1, 1], "its polygon's edges, then its stroke's segments");
}

/// The winding number by the sum of the angles that edges are seen under.
fn turns_by_angles(rings: &[Vec<Plan>], p: Plan) -> f64 {
    let mut sum = 0.0;
    for ring in rings {
        for (k, a) in ring.iter().enumerate() {
            let (u, v) = (*a - p, ring[(k + 1) % ring.len()] - p);
            sum += crate::math::atan2(u.perp_dot(v), u.dot(v));
        }
    }
    sum / std::f64::consts::TAU
}

proptest! {
    #[test]
    fn winding_numbers_are_the_turns_of_the_rings(
        rings in prop::collection::vec(prop::collection::vec((-9..9i32, -9..9i32), 1..40), 1..4),
        x in -10.0..10.0f64, y in -10.0..10.0f64,
    ) {
        let rings: Vec<Vec<Plan>> = rings
            .iter()
            .map(|ring| ring.iter().map(|&(x, y)| Plan::new(f64::from(x), f64::from(y))).collect())
            .collect();
        let fill = Some(Fill { color: Color([0.0, 0.0, 1.0, 1.0]), rule: Rule::NonZero });
        let list = list(Style { fill, ..Style::default() }, Shape::Polygon(rings.clone()));
        let all = footprints(&list);
        let at = Plan::new(x, y);
        let turns = turns_by_angles(&rings, at);
        prop_assume!((turns - turns.round()).abs() < 1e-6);
        prop_assert_eq!(all.polygon_holds(0, at), turns.round() != 0.0);
    }

    #[test]
    fn a_part_lies_in_its_box(
        points in prop::collection::vec((-9.0..9.0f64, -9.0..9.0f64), 2..6),
        width in 0.1..5.0f64, limit in 1.0..6.0f64,
        probes in prop::collection::vec((-30.0..30.0f64, -30.0..30.0f64), 60),
    ) {
        let style = line_style(width, Join::Miter { limit }, Cap::Square);
        let list = list(style, polyline(&points));
        let all = footprints(&list);
        for p in probes {
            let p = Plan::new(p.0, p.1);
            let mut near = false;
            all.parts_near(&PlanBox::around([p]), |_| { near = true; true });
            prop_assert!(near || !stroke_holds(&all, p));
        }
    }
}
