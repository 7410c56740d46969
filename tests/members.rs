//! Members of a multi-polygon that overlap are united, and so are polygons outside of which is painted, whatever draws them.
#![cfg(feature = "render")]

mod drawing;

use drapery::scene::{Cap, Join, TechniqueSettings, Width};
use drapery::scene::{Color, Feature, Fill, Layer, Line, Outline, OutlineMode, Rule, Shape, Style};
use drapery::space::Plan;
use drapery::stage::Stage;
use drapery::technique::clipmap::{self, Overlaps, PolygonRaster};
use drapery::technique::inverse_projection::{self, PointInPolygon};
use drapery::technique::static_decal;
use drapery::technique::stencil_volume::{self, Grouping};
use drawing::{frame_of, kinds_of_footprints_for, loaded, truth_of};
use proptest::prelude::*;

const SIDE: usize = 40;

/// A plane seen from above, ten metres a pixel.
fn text() -> String {
    format!(
        "schema = 1\nimage = {{ width = {SIDE}, height = {SIDE} }}\n\
         terrain = {{ generate = {{ kind = \"plane\", posts = [3, 3], cell_m = 300.0 }}, color = \"#ffffff\" }}\n\
         camera = {{ eye = [0, 0, 100], target = [0, 0, 0], up = [0, 1, 0], projection = \"orthographic\", height_m = {} }}",
        10 * SIDE
    )
}

fn stage(layers: Vec<Layer>, technique: &TechniqueSettings) -> Stage {
    let (mut scene, surface) = loaded(&text(), &[]);
    scene.layers = layers;
    scene.technique = technique.clone();
    Stage::new(scene, surface).unwrap()
}

fn square(x: f64, y: f64, half: f64) -> Vec<Plan> {
    [(-half, -half), (half, -half), (half, half), (-half, half)]
        .map(|(a, b)| Plan::new(x + a, y + b))
        .to_vec()
}

fn filled(rule: Rule, alpha: f64) -> Style {
    Style { fill: Some(Fill { color: Color([0.0, 0.0, 0.0, alpha]), rule }), ..Style::default() }
}

fn layer(members: Vec<Vec<Vec<Plan>>>, style: Style) -> Layer {
    let shape = Shape::MultiPolygon(members);
    Layer::uniform("members", style, vec![Feature { index: 0, style: 0, shape }])
}

/// Settings of techniques under which all of them are tried.
fn settings() -> Vec<TechniqueSettings> {
    let mut all = Vec::new();
    for (polygons, inside, grouping) in [
        (PolygonRaster::Exact, PointInPolygon::EdgeNormals, Grouping::Object),
        (PolygonRaster::Aliased, PointInPolygon::Winding, Grouping::Color),
        (PolygonRaster::TinySkia, PointInPolygon::Winding, Grouping::Color),
    ] {
        let mut technique = TechniqueSettings::default();
        let overlaps = Overlaps::Once;
        technique.set(clipmap::Settings { virtual_size: 1024, polygons, overlaps, ..Default::default() });
        technique.set(inverse_projection::Settings { point_in_polygon: inside, ..Default::default() });
        technique.set(stencil_volume::Settings { grouping, ..Default::default() });
        technique
            .set(static_decal::Settings { outlines: static_decal::Outlines::Polygon, ..Default::default() });
        all.push(technique);
    }
    all
}

/// Whether any member holds a point.
fn holds(members: &[Vec<Vec<Plan>>], rule: Rule, p: Plan) -> bool {
    members.iter().any(|rings| {
        let edges = rings.iter().filter(|ring| ring.len() > 2);
        let edges = edges.flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)));
        let turns = edges.filter(|(a, b)| (a.y <= p.y) != (b.y <= p.y)).map(|(a, b)| {
            let is_east = a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) > p.x;
            i32::from(is_east) * if a.y < b.y { 1 } else { -1 }
        });
        rule.contains(turns.sum())
    })
}

/// Whether no edge comes nearer to a point than `reach`.
fn is_clear(members: &[Vec<Vec<Plan>>], p: Plan, reach: f64) -> bool {
    let rings = members.iter().flatten();
    rings.flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1))).all(|(a, b)| {
        let (along, to) = (*b - *a, p - *a);
        let share = to.dot(along) / along.length_squared();
        let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 };
        (to - along * share).length() > reach
    })
}

/// Checks pixels near no edge against the definition, in the truth and in every technique.
fn check(members: &[Vec<Vec<Plan>>], rule: Rule, alpha: f64) -> Result<usize, TestCaseError> {
    let layer = layer(members.to_vec(), filled(rule, alpha));
    check_layer(&layer, members, &|at| if holds(members, rule, at) { 1.0 - alpha } else { 1.0 })
}

/// Checks pixels near no edge of members against what is right there.
fn check_layer(
    layer: &Layer,
    members: &[Vec<Vec<Plan>>],
    right: &dyn Fn(Plan) -> f64,
) -> Result<usize, TestCaseError> {
    let mut checked = 0;
    for technique in settings() {
        let stage = stage(vec![layer.clone()], &technique);
        let truth = truth_of(&stage).image();
        let kinds = kinds_of_footprints_for(&stage).into_iter();
        let images: Vec<_> = kinds.map(|kind| (kind.name(), frame_of(kind, &stage, &[]).image)).collect();
        for (name, image) in images.iter().map(|(name, image)| (*name, image)).chain([("truth", &truth)]) {
            for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
                let middle = Plan::new(
                    10.0 * (x as f64 + 0.5 - SIDE as f64 / 2.0),
                    10.0 * (SIDE as f64 / 2.0 - y as f64 - 0.5),
                );
                // As far as the filters of the clipmap reach.
                if !is_clear(members, middle, if name == "clipmap" { 45.0 } else { 15.0 }) {
                    continue;
                }
                let right = right(middle);
                let seen = image.at(x, y)[0];
                prop_assert!(
                    (f64::from(seen) / 255.0 - right).abs() < 0.003,
                    "{}: {} at {:?}",
                    name,
                    seen,
                    middle
                );
                checked += 1;
            }
        }
    }
    Ok(checked)
}

#[test]
fn a_square_in_a_square_as_two_members_has_the_larger_one_s_area_and_one_coat_of_paint() {
    let members = vec![vec![square(0.0, 0.0, 200.0)], vec![square(0.0, 0.0, 100.0)]];
    for rule in [Rule::EvenOdd, Rule::NonZero] {
        check(&members, rule, 0.5).unwrap();
        let stage = stage(vec![layer(members.clone(), filled(rule, 0.5))], &TechniqueSettings::default());
        let truth = truth_of(&stage);
        let dark: f64 = truth.estimate.values().iter().map(|pixel| 1.0 - pixel[0]).sum();
        assert!((dark * 100.0 / 0.5 - 160_000.0).abs() < 1e-6, "{dark}");
    }
}

#[test]
fn a_point_is_found_in_its_member_whichever_is_asked_first() {
    // One with a hole that is in no other, one beside it, one that reaches over both.
    let mut members = vec![
        vec![square(-90.0, 0.0, 100.0), square(-90.0, 0.0, 55.0)],
        vec![square(110.0, -30.0, 60.0)],
        vec![square(60.0, 120.0, 70.0)],
    ];
    for _ in 0..3 {
        members.rotate_left(1);
        for rule in [Rule::EvenOdd, Rule::NonZero] {
            let checked = check(&members, rule, 0.5).unwrap();
            assert!(checked > 4_000, "{checked}");
        }
    }
}

#[test]
fn members_side_by_side_are_painted_without_a_seam() {
    let place = |k: u32| (f64::from(k % 5) - 2.0, f64::from(k / 5) - 2.0);
    let members: Vec<_> =
        (0..25).map(|k| vec![square(place(k).0 * 62.0 + 1.25, place(k).1 * 62.0 + 0.75, 31.0)]).collect();
    for technique in settings() {
        let stage = stage(vec![layer(members.clone(), filled(Rule::EvenOdd, 0.5))], &technique);
        for kind in kinds_of_footprints_for(&stage) {
            let image = frame_of(kind, &stage, &[]).image;
            let inside = (10..30).flat_map(|y| (10..30).map(move |x| (x, y)));
            let seam = inside.filter(|(x, y)| image.at(*x, *y)[0].abs_diff(128) > 1).count();
            assert_eq!(seam, 0, "{}", kind.name());
        }
    }
}

#[test]
fn an_outline_follows_all_rings_and_is_cut_to_the_union() {
    let members = vec![vec![square(0.0, 0.0, 147.0)], vec![square(147.0, 0.0, 48.0)]];
    let line = Line {
        color: Color([0.0, 0.0, 0.0, 1.0]),
        width: Width::Metres(40.0),
        join: Join::Miter { limit: 4.0 },
        cap: Cap::Butt,
    };
    // On the small square's side in the large one, inside and outside of the union's border, and across the large one's side in the small one.
    let places = [(95.0, 5.0), (-145.0, 5.0), (-155.0, 5.0), (145.0, 5.0), (155.0, 5.0)];
    for (mode, dark) in [
        (OutlineMode::Inset, [true, true, false, true, true]),
        (OutlineMode::Normal, [true, true, true, true, true]),
        (OutlineMode::Offset, [false, false, true, false, false]),
    ] {
        let style = Style { outline: Some(Outline { line, mode }), ..Style::default() };
        for technique in settings() {
            let stage = stage(vec![layer(members.clone(), style)], &technique);
            let truth = truth_of(&stage).image();
            let kinds = kinds_of_footprints_for(&stage).into_iter();
            let images: Vec<_> = kinds.map(|kind| (kind.name(), frame_of(kind, &stage, &[]).image)).collect();
            for (name, image) in images.iter().map(|(name, image)| (*name, image)).chain([("truth", &truth)])
            {
                let seen = places.map(|(x, y)| {
                    let at = |v: f64| ((v + 10.0 * SIDE as f64 / 2.0) / 10.0) as usize;
                    image.at(at(x), SIDE - 1 - at(y))[0] < 128
                });
                assert_eq!(seen, dark, "{name}, {mode:?}");
            }
        }
    }
}

fn ring() -> impl Strategy<Value = Vec<Plan>> {
    let coordinate = || prop_oneof![-190.0..190.0f64, (-4..5i32).prop_map(|k| f64::from(k) * 45.0)];
    let point = (coordinate(), coordinate()).prop_map(|(x, y)| Plan::new(x, y));
    let square = (-90.0..90.0f64, -90.0..90.0f64, 20.0..100.0f64).prop_map(|(x, y, half)| square(x, y, half));
    prop_oneof![prop::collection::vec(point, 3..6), square.clone(), square]
}

/// A layer that paints what is outside of polygons, each of which is a feature.
fn inverted(polygons: &[Vec<Vec<Plan>>], rule: Rule, alpha: f64) -> Layer {
    let features = polygons.iter().enumerate();
    let feature =
        |(index, rings): (usize, &Vec<_>)| Feature { index, style: 0, shape: Shape::Polygon(rings.clone()) };
    let outside = Some(Fill { color: Color([0.0, 0.0, 0.0, alpha]), rule });
    Layer { outside, ..Layer::uniform("inverted", Style::default(), features.map(feature).collect()) }
}

fn check_inverted(polygons: &[Vec<Vec<Plan>>], rule: Rule, alpha: f64) -> Result<usize, TestCaseError> {
    let layer = inverted(polygons, rule, alpha);
    check_layer(&layer, polygons, &|at| if holds(polygons, rule, at) { 1.0 } else { 1.0 - alpha })
}

#[test]
fn what_is_outside_of_squares_that_overlap_has_the_rest_of_the_picture_s_area() {
    let polygons = [vec![square(-50.0, 0.0, 100.0), square(-50.0, 0.0, 45.0)], vec![square(50.0, 0.0, 80.0)]];
    for rule in [Rule::EvenOdd, Rule::NonZero] {
        check_inverted(&polygons, rule, 0.5).unwrap();
        let truth = truth_of(&stage(vec![inverted(&polygons, rule, 0.5)], &TechniqueSettings::default()));
        let dark: f64 = truth.estimate.values().iter().map(|pixel| 1.0 - pixel[0]).sum();
        // The second square lies over 25 x 90 of the first one's hole.
        let hole = if rule == Rule::EvenOdd { 90.0 * 90.0 - 25.0 * 90.0 } else { 0.0 };
        let union = 200.0 * 200.0 + 160.0 * 160.0 - 80.0 * 160.0 - hole;
        assert!((dark * 100.0 / 0.5 - (160_000.0 - union)).abs() < 1e-6, "{dark}");
    }
}

#[test]
fn outside_of_no_polygon_is_everywhere_and_outside_of_one_around_the_terrain_nowhere() {
    let around = [vec![square(0.0, 0.0, 5000.0)]];
    let degenerate = [vec![square(0.0, 0.0, 0.0), Vec::new()]];
    for (polygons, right) in [(&around[..], 1.0), (&[], 0.25), (&degenerate, 0.25)] {
        check_layer(&inverted(polygons, Rule::NonZero, 0.75), &around, &|_| right).unwrap();
    }
    // One that reaches over the frame around the terrain is cut by it, and turns there the other way.
    for reversed in [false, true] {
        let mut ring =
            vec![Plan::new(0.0, -9e4), Plan::new(9e4, -9e4), Plan::new(9e4, 9e4), Plan::new(0.0, 9e4)];
        if reversed {
            ring.reverse();
        }
        check_inverted(&[vec![ring]], Rule::NonZero, 0.5).unwrap();
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]
    #[test]
    fn a_point_is_painted_once_where_no_polygon_holds_it(
        polygons in prop::collection::vec(prop::collection::vec(ring(), 1..3), 1..5),
        is_even_odd in any::<bool>(),
        alpha in 0.2..1.0f64,
    ) {
        let rule = if is_even_odd { Rule::EvenOdd } else { Rule::NonZero };
        check_inverted(&polygons, rule, alpha)?;
    }

    #[test]
    fn a_point_is_painted_once_where_any_member_holds_it(
        members in prop::collection::vec(prop::collection::vec(ring(), 1..3), 2..5),
        is_even_odd in any::<bool>(),
        alpha in 0.2..1.0f64,
    ) {
        let rule = if is_even_odd { Rule::EvenOdd } else { Rule::NonZero };
        check(&members, rule, alpha)?;
    }
}
