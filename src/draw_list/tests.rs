use super::*;
use crate::scene::{Cap, Color, Feature, Fill, Join, Line, Outline, OutlineMode, Rule, Shape, Style, Width};
use proptest::prelude::*;

const RED: Color = Color([1.0, 0.0, 0.0, 0.5]);
const BLUE: Color = Color([0.0, 0.0, 1.0, 1.0]);

fn stroke(color: Color, width: f64) -> Line {
    Line { color, width: Width::Metres(width), join: Join::Round, cap: Cap::Butt }
}

fn filled(rule: Rule) -> Style {
    Style { fill: Some(Fill { color: RED, rule }), ..Style::default() }
}

fn outlined(mode: OutlineMode) -> Style {
    Style { outline: Some(Outline { line: stroke(BLUE, 2.0), mode }), ..Style::default() }
}

fn filled_and_outlined(rule: Rule, mode: OutlineMode) -> Style {
    Style { fill: filled(rule).fill, ..outlined(mode) }
}

fn lined() -> Style {
    Style { line: Some(stroke(BLUE, 2.0)), ..Style::default() }
}

fn plan(points: &[(f64, f64)]) -> Vec<Plan> {
    points.iter().map(|&(x, y)| Plan::new(x, y)).collect()
}

/// A layer's list; each feature names one of the styles.
fn list(styles: Vec<Style>, features: Vec<(u32, Shape)>) -> DrawList {
    let features = features.into_iter().enumerate();
    let features = features.map(|(index, (style, shape))| Feature { index, style, shape }).collect();
    DrawList::new(
        &mut [Layer { name: "layer".into(), styles, features, opacity: 1.0, outside: None }],
        &PlanBox::EMPTY,
    )
    .unwrap()
}

fn polygon(style: Style, rings: &[&[(f64, f64)]]) -> DrawList {
    list(vec![style], vec![(0, Shape::Polygon(rings.iter().map(|ring| plan(ring)).collect()))])
}

fn line(points: &[(f64, f64)]) -> DrawList {
    list(vec![lined()], vec![(0, Shape::Line(vec![plan(points)]))])
}

/// The vertices of the only stroke of the last item, and whether it is closed.
fn only_stroke(list: &DrawList) -> (Vec<(f64, f64)>, bool) {
    let [chain] = list.strokes(list.items().last().unwrap()) else { panic!("{list:?}") };
    (list.vertices_of(chain).iter().map(|p| (p.x, p.y)).collect(), chain.is_closed)
}

const SQUARE: [(f64, f64); 4] = [(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)];
const HOLE: [(f64, f64); 3] = [(2.0, 2.0), (2.0, 4.0), (4.0, 2.0)];
const TWICE: [(f64, f64); 5] = [(0.0, 0.0), (9.0, 0.0), (9.0, 1e-10), (9.0, 9.0), (0.0, 9.0)];

#[test]
fn a_polygon_makes_its_fill_and_then_its_outline_and_a_line_makes_a_line() {
    let everything = Style { line: lined().line, ..filled_and_outlined(Rule::EvenOdd, OutlineMode::Normal) };
    let shapes = vec![(0, Shape::Polygon(vec![plan(&SQUARE)])), (0, Shape::Line(vec![plan(&SQUARE)]))];
    let list = list(vec![everything], shapes);
    let told: Vec<(u32, Role)> =
        list.numbered().map(|(k, item)| (item.feature, list.style_of(k).role)).collect();
    assert_eq!(told, [(0, Role::Fill), (0, Role::Outline), (1, Role::Line)]);
}

#[test]
fn a_feature_whose_style_has_nothing_for_it_makes_nothing() {
    let line = || Shape::Line(vec![plan(&SQUARE)]);
    let polygon = || Shape::Polygon(vec![plan(&SQUARE)]);
    let styles = vec![filled(Rule::EvenOdd), lined()];
    let list = list(styles, vec![(0, line()), (1, polygon()), (0, polygon()), (1, line())]);
    assert_eq!(list.items().iter().map(|item| item.feature).collect::<Vec<_>>(), [2, 3]);
}

#[test]
fn items_keep_the_order_of_layers_and_features_and_know_where_they_are_from() {
    let of = |index| Feature { index, style: 0, shape: Shape::Line(vec![plan(&SQUARE)]) };
    let layer = |numbers: &[usize]| Layer::uniform("l", lined(), numbers.iter().map(|k| of(*k)).collect());
    // More features than are one piece of work.
    let many: Vec<usize> = (0..3000).rev().collect();
    let mut layers = [layer(&[7, 3]), layer(&[]), layer(&many)];
    let list = DrawList::new(&mut layers, &PlanBox::EMPTY).unwrap();
    let told: Vec<[u32; 3]> =
        list.items().iter().map(|item| [item.layer, item.feature, item.number]).collect();
    assert_eq!(told[..3], [[0, 0, 7], [0, 1, 3], [2, 0, 2999]]);
    assert!(told[2..].iter().enumerate().all(|(k, item)| *item == [2, k as u32, 2999 - k as u32]));
    let is_square = |item: &Item| list.vertices_of(&list.strokes(item)[0]) == plan(&SQUARE);
    assert!(list.items().iter().all(is_square));
    assert!(layers.iter().all(|layer| layer.features.is_empty()), "the list has taken the features");
}

#[test]
fn a_border_is_its_ring_as_it_is_with_its_first_vertex_behind_it() {
    let list = polygon(filled(Rule::EvenOdd), &[&TWICE, &HOLE]);
    let rings = list.area(&list.items()[0]);
    assert_eq!(
        rings.iter().map(|ring| (ring.part, ring.is_closed)).collect::<Vec<_>>(),
        [(0, true), (1, true)]
    );
    assert_eq!(list.vertices_of(&rings[0]), plan(&TWICE));
    assert_eq!(list.path_of(&rings[1]), plan(&[HOLE[0], HOLE[1], HOLE[2], HOLE[0]]));
}

#[test]
fn a_ring_of_fewer_than_three_vertices_encloses_nothing() {
    let list = polygon(filled_and_outlined(Rule::EvenOdd, OutlineMode::Inset), &[&SQUARE[..2], &SQUARE, &[]]);
    for item in list.items() {
        assert_eq!(list.area(item).iter().map(|ring| ring.part).collect::<Vec<_>>(), [1]);
    }
    let strokes = list.strokes(&list.items()[1]);
    assert_eq!(strokes.iter().map(|chain| chain.part).collect::<Vec<_>>(), [0, 1], "its outline has it");
}

#[test]
fn an_area_is_kept_only_for_fills_and_outlines_that_are_cut_to_it() {
    let has_area = |style| !polygon(style, &[&SQUARE]).items()[0].area.is_empty();
    assert!(has_area(filled(Rule::NonZero)));
    assert!(has_area(outlined(OutlineMode::Inset)) && has_area(outlined(OutlineMode::Offset)));
    assert!(!has_area(outlined(OutlineMode::Normal)));
    let both = polygon(filled_and_outlined(Rule::EvenOdd, OutlineMode::Normal), &[&SQUARE]);
    assert!(both.items()[1].area.is_empty());
}

#[test]
fn an_outline_is_cut_to_a_side_of_its_polygon_by_the_rule_of_the_fill() {
    let told = |style| {
        let list = polygon(style, &[&SQUARE]);
        let style = list.styles().last().unwrap();
        (style.cut, style.rule)
    };
    let by = |mode| told(filled_and_outlined(Rule::NonZero, mode));
    assert_eq!(by(OutlineMode::Inset), (Some(Side::Inside), Rule::NonZero));
    assert_eq!(by(OutlineMode::Offset), (Some(Side::Outside), Rule::NonZero));
    assert_eq!(by(OutlineMode::Normal).0, None);
    assert_eq!(told(outlined(OutlineMode::Inset)), (Some(Side::Inside), Rule::EvenOdd), "without a fill");
}

#[test]
fn an_area_belongs_to_the_fill_where_there_is_one() {
    let filled = polygon(filled_and_outlined(Rule::EvenOdd, OutlineMode::Inset), &[&SQUARE]);
    assert_eq!([0, 1].map(|item| filled.area_owner(item)), [0, 0]);
    let rings = || Shape::Polygon(vec![plan(&SQUARE)]);
    let alone = list(vec![outlined(OutlineMode::Inset)], vec![(0, rings()), (0, rings())]);
    assert_eq!([0, 1].map(|item| alone.area_owner(item)), [0, 1], "another feature's is none");
}

#[test]
fn a_ring_of_distinct_vertices_is_held_once_for_border_and_stroke() {
    let list = polygon(filled_and_outlined(Rule::EvenOdd, OutlineMode::Inset), &[&SQUARE, &HOLE]);
    let [fill, outline] = list.items() else { panic!("{list:?}") };
    assert_eq!((&fill.area, &outline.area), (&outline.strokes, &outline.strokes));
    assert_eq!(list.vertices().len(), SQUARE.len() + 1 + HOLE.len() + 1);
}

#[test]
fn where_a_ring_repeats_a_vertex_its_border_keeps_it_and_its_stroke_does_not() {
    let list = polygon(filled_and_outlined(Rule::EvenOdd, OutlineMode::Normal), &[&HOLE, &TWICE]);
    let [fill, outline] = list.items() else { panic!("{list:?}") };
    let [hole, ring] = list.area(fill) else { panic!("{list:?}") };
    let [hole_stroke, ring_stroke] = list.strokes(outline) else { panic!("{list:?}") };
    assert_eq!(hole, hole_stroke, "the other ring is still held once");
    assert_eq!(list.vertices_of(ring), plan(&TWICE));
    assert_eq!(list.vertices_of(ring_stroke), plan(&SQUARE));
    assert_eq!((ring_stroke.part, ring_stroke.is_closed), (1, true));
}

#[test]
fn a_ring_whose_last_vertex_is_its_first_has_it_once_in_its_stroke() {
    for last in [(0.0, 0.0), (0.0, -1e-10)] {
        let ring = [&SQUARE[..], &[last]].concat();
        let list = polygon(filled_and_outlined(Rule::EvenOdd, OutlineMode::Normal), &[&ring]);
        assert_eq!(only_stroke(&list), (SQUARE.to_vec(), true));
        assert_eq!(list.area(&list.items()[0])[0].count, 5);
    }
}

#[test]
fn consecutive_vertices_nearer_than_a_nanometre_are_one_vertex_of_a_stroke() {
    let apart = 1.5 * SAME_VERTEX;
    let points = [(0.0, 0.0), (0.0, 1e-10), (5.0, 0.0), (5.0, 0.0), (5.0, apart), (5.0, apart + 1e-10)];
    assert_eq!(only_stroke(&line(&points)), (vec![(0.0, 0.0), (5.0, 0.0), (5.0, apart)], false));
}

#[test]
fn a_line_that_ends_where_it_begins_with_three_distinct_vertices_is_a_ring() {
    for last in [(0.0, 0.0), (1e-10, 0.0)] {
        let list = line(&[&SQUARE[..3], &[last]].concat());
        assert_eq!(only_stroke(&list), (SQUARE[..3].to_vec(), true));
        let path = list.path_of(&list.strokes(&list.items()[0])[0]);
        assert_eq!(path.last(), path.first());
    }
}

#[test]
fn a_line_there_and_back_stays_open_and_ends_exactly_where_it_begins() {
    let there_and_back = vec![(0.0, 0.0), (9.0, 0.0), (0.0, 0.0)];
    assert_eq!(only_stroke(&line(&there_and_back)), (there_and_back.clone(), false));
    assert_eq!(
        only_stroke(&line(&[(0.0, 0.0), (9.0, 0.0), (9.0, 0.0), (1e-10, 0.0)])),
        (there_and_back, false)
    );
}

#[test]
fn a_ring_of_two_vertices_runs_there_and_back_and_is_closed() {
    let list = polygon(outlined(OutlineMode::Normal), &[&SQUARE[..2]]);
    assert_eq!(only_stroke(&list), (SQUARE[..2].to_vec(), true));
    assert_eq!(list.strokes(&list.items()[0])[0].segments(), 2);
}

#[test]
fn what_has_one_distinct_vertex_is_a_dot_and_what_has_none_is_nothing() {
    let same = [(3.0, 4.0), (3.0, 4.0), (3.0, 4.0 + 1e-10)];
    for dot in [line(&same), line(&same[..1]), polygon(outlined(OutlineMode::Normal), &[&same])] {
        assert_eq!(only_stroke(&dot), (vec![(3.0, 4.0)], false));
        assert_eq!(dot.strokes(&dot.items()[0])[0].segments(), 0);
    }
    assert!(line(&[]).items()[0].strokes.is_empty());
}

#[test]
fn equal_styles_are_held_once_and_others_apart() {
    let wider = Style { line: Some(stroke(BLUE, 3.0)), ..Style::default() };
    let of_pixels = Line { width: Width::Pixels(2.0), ..stroke(BLUE, 2.0) };
    let of_pixels = Style { line: Some(of_pixels), ..Style::default() };
    let styles = vec![lined(), wider, lined(), of_pixels, outlined(OutlineMode::Normal)];
    let lines = (0..4).map(|style| (style, Shape::Line(vec![plan(&SQUARE)])));
    let features = lines.chain([(4, Shape::Polygon(vec![plan(&SQUARE)]))]).collect();
    let list = list(styles, features);
    let numbers: Vec<u32> = list.items().iter().map(|item| item.style).collect();
    assert_eq!(numbers, [0, 1, 0, 2, 3], "an outline is not a line, though it looks like one");
    let widths: Vec<Width> = list.styles().iter().filter_map(|style| Some(style.stroke?.width)).collect();
    assert_eq!(widths, [Width::Metres(2.0), Width::Metres(3.0), Width::Pixels(2.0), Width::Metres(2.0)]);
}

#[test]
fn a_style_that_no_item_has_is_left_out() {
    let everything = Style { line: lined().line, ..filled_and_outlined(Rule::EvenOdd, OutlineMode::Normal) };
    let list = list(vec![filled(Rule::NonZero), everything], vec![(1, Shape::Line(vec![plan(&SQUARE)]))]);
    assert_eq!(list.styles().iter().map(|style| style.role).collect::<Vec<_>>(), [Role::Line]);
}

fn points() -> impl Strategy<Value = Vec<Plan>> {
    let near = prop_oneof![Just(0.0), Just(0.7e-9), Just(-0.7e-9), Just(1.3e-9)];
    let coordinate = (0..3i32, near).prop_map(|(k, near)| f64::from(k) + near);
    prop::collection::vec((coordinate.clone(), coordinate), 0..9)
        .prop_map(|points| points.into_iter().map(|(x, y)| Plan::new(x, y)).collect())
}

proptest! {
    #[test]
    fn the_vertices_of_a_stroke_are_distinct_ones_of_its_feature_in_their_order(points in points(), is_ring: bool) {
        let (style, shape) = match is_ring {
            true => (outlined(OutlineMode::Inset), Shape::Polygon(vec![points.clone()])),
            false => (lined(), Shape::Line(vec![points.clone()])),
        };
        let list = list(vec![style], vec![(0, shape)]);
        let chains = list.strokes(&list.items()[0]);
        prop_assert_eq!(chains.len(), usize::from(!points.is_empty()));
        for chain in chains {
            let path = list.path_of(chain);
            let distance = |a: &Plan, b: &Plan| (*a - *b).length();
            let shortest = path.windows(2).map(|pair| distance(&pair[0], &pair[1])).fold(1.0, crate::math::min);
            prop_assert!(shortest > SAME_VERTEX, "{:?}", path);
            prop_assert!(!chain.is_closed || path.first() == path.last());
            // Each vertex is one of the points, and they come in their order (the end may be the start's copy).
            let mut rest = points.iter();
            let count = chain.count as usize - usize::from(!chain.is_closed && chain.count > 2);
            prop_assert!(path[..count].iter().all(|p| rest.any(|q| q == p)), "{:?} of {:?}", path, points);
            // No point is farther from the stroke than the vertices that were taken for one.
            let reach = points.len() as f64 * SAME_VERTEX;
            prop_assert!(points.iter().all(|p| path.iter().any(|q| distance(p, q) <= reach)));
        }
    }
}

#[test]
fn what_is_outside_of_a_layer_s_polygons_is_one_item_below_all_others_of_it() {
    let square = |x: f64| plan(&[(x, 0.0), (x + 2.0, 0.0), (x + 2.0, 2.0), (x, 2.0)]);
    let fill = Fill { color: RED, rule: Rule::NonZero };
    let style = Style { line: Some(stroke(BLUE, 2.0)), ..Style::default() };
    let shapes = [
        Shape::Line(vec![square(0.0)]),
        Shape::Polygon(vec![square(0.0)]),
        Shape::MultiPolygon(vec![vec![square(1.0)], vec![square(7.0)]]),
    ];
    let features =
        shapes.into_iter().enumerate().map(|(index, shape)| Feature { index, style: 0, shape }).collect();
    let below = Layer::uniform("below", style, vec![]);
    let layer = Layer { outside: Some(fill), ..Layer::uniform("inverted", style, features) };
    let terrain = PlanBox { min: Plan::new(0.0, 0.0), max: Plan::new(10.0, 5.0) };
    let list = DrawList::new(&mut [below, layer], &terrain).unwrap();
    let told: Vec<_> =
        list.numbered().map(|(k, item)| (item.layer, item.number, list.style_of(k).role)).collect();
    assert_eq!(told, [(1, NO_FEATURE, Role::Outside), (1, 0, Role::Line)]);
    let item = &list.items()[0];
    assert_eq!(list.area(item).iter().map(|ring| ring.member).collect::<Vec<_>>(), [0, 1, 2]);
    let frame = list.vertices_of(&list.border(item)[0]);
    assert_eq!(frame, plan(&[(-10.0, -10.0), (20.0, -10.0), (20.0, 15.0), (-10.0, 15.0)]));
    assert_eq!(list.border(item).len(), 3);
}
