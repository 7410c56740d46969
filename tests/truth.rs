//! The truth against what is known without it: closed forms of `docs/semantics.md`'s definitions, brute-force sampling, and
//! itself on other machines' worth of threads. (Exact rational arithmetic: `src/truth/tile/tests.rs`.)
#![cfg(feature = "render")]

use drapery::buffer::Buffer;
use drapery::math;
use drapery::scene::{
    BlendMode, BlendSpace, Camera, Cap, Color, Compositing, Device, Diagonal, Feature, Fill, Ground,
    GroundColors, ImageSettings, Imagery, Join, Layer, Light, Line, Outline, OutlineMode, Posts, Projection,
    Rule, Scene, Shape, Style, Surface, TechniqueSettings, Width,
};
use drapery::space::{Plan, PlanBox, World};
use drapery::stage::Stage;
use drapery::technique::{self, FrameOptions, Kind};
use drapery::terrain::Mesh;
use drapery::truth::{Budget, Truth, certify};
use glam::{DVec2, DVec3};

const BLACK: Color = Color([0.0, 0.0, 0.0, 1.0]);
const WHITE: Color = Color([1.0; 4]);

fn posts(n: usize, cell: f64, height: impl Fn(f64, f64) -> f64) -> Surface {
    let half = cell * (n - 1) as f64 / 2.0;
    let at = |k: usize| cell * k as f64 - half;
    let heights = (0..n * n).map(|k| height(at(k % n), at(k / n))).collect();
    let steps = (DVec2::X * cell, DVec2::Y * cell);
    Surface::Grid(Posts::new((n, n), Plan::new(-half, -half), steps, heights).unwrap())
}

/// A camera; one that looks straight down has north up.
fn camera(eye: [f64; 3], target: [f64; 3], projection: Projection) -> Camera {
    let point = |p: [f64; 3]| World::new(p[0], p[1], p[2]);
    let up = if eye[0] == target[0] && eye[1] == target[1] { DVec3::Y } else { DVec3::Z };
    Camera { eye: point(eye), target: point(target), up, projection, near_m: 0.5, far_m: None }
}

fn scene(size: (usize, usize), camera: Camera, layers: Vec<Layer>) -> Scene {
    Scene {
        name: "test".into(),
        origin: DVec3::ZERO,
        plan_space: "metres".into(),
        globe: None,
        image: ImageSettings { width: size.0, height: size.1, background: WHITE },
        camera,
        diagonal: Diagonal::SwNe,
        lod: None,
        ground: Ground::flat(WHITE),
        layers,
        compositing: Compositing::default(),
        device: Device::default(),
        technique: TechniqueSettings::default(),
        notes: Vec::new(),
    }
}

/// A picture of `side` x `side` pixels, each a metre wide, straight down on the middle.
fn map(side: usize, layers: Vec<Layer>) -> Scene {
    let down = camera([0.0, 0.0, 500.0], [0.0; 3], Projection::Orthographic { height_m: side as f64 });
    scene((side, side), down, layers)
}

fn flat() -> Surface {
    posts(5, 100.0, |_, _| 0.0)
}

fn layer(shape: Shape, style: Style) -> Layer {
    Layer::uniform("layer", style, vec![Feature { index: 0, style: 0, shape }])
}

fn plan(points: &[(f64, f64)]) -> Vec<Plan> {
    points.iter().map(|&(x, y)| Plan::new(x, y)).collect()
}

fn polygon(rings: &[&[(f64, f64)]], rule: Rule, color: Color) -> Layer {
    let rings = rings.iter().map(|r| plan(r)).collect();
    layer(Shape::Polygon(rings), Style { fill: Some(Fill { color, rule }), ..Style::default() })
}

fn line(points: &[(f64, f64)], line: Line) -> Layer {
    layer(Shape::Line(vec![plan(points)]), Style { line: Some(line), ..Style::default() })
}

fn stroke(width: f64) -> Line {
    Line { color: BLACK, width: Width::Metres(width), join: Join::Miter { limit: 4.0 }, cap: Cap::Butt }
}

/// As narrow as the work allows: `width` a pixel.
fn truth(scene: &Scene, surface: Surface, width: f64) -> Truth {
    let stage = Stage::new(scene.clone(), surface).unwrap();
    certify(&stage, &stage.view().unwrap(), &Budget::new(width, 14).unwrap(), &|_| {})
}

/// Between which bounds the area of black on white lies, in pixels, over some pixels.
fn black(truth: &Truth, pixels: impl Iterator<Item = usize> + Clone) -> (f64, f64) {
    let sum = |bound: &[[f64; 4]]| pixels.clone().map(|k| 1.0 - bound[k][0]).sum::<f64>();
    (sum(truth.high.values()), sum(truth.low.values()))
}

/// The black area of a whole picture is `area`, and is known to `within`.
#[track_caller]
fn assert_area(truth: &Truth, area: f64, within: f64) {
    let (low, high) = black(truth, 0..truth.low.values().len());
    // The closed form itself is rounded.
    let rounding = 1e-9 * (1.0 + area);
    assert!(low - rounding <= area && area <= high + rounding, "{area} is not in [{low}, {high}]");
    assert!(high - low <= within, "[{low}, {high}] is wider than {within}");
}

#[test]
fn case_7_lines_near_the_horizon_have_their_exact_thickness() {
    let focal = 128.0 / (math::tan(30f64.to_radians()));
    for distance in [500.0, 1000.0, 2000.0] {
        let across = line(&[(-9000.0, distance), (9000.0, distance)], stroke(2.0));
        let level =
            camera([0.0, 0.0, 100.0], [0.0, 1000.0, 100.0], Projection::Perspective { fov_y_deg: 60.0 });
        let truth = truth(&scene((256, 256), level, vec![across]), posts(3, 20_000.0, |_, _| 0.0), 1e-6);
        let thickness = focal * 100.0 * (1.0 / (distance - 1.0) - 1.0 / (distance + 1.0));
        for column in [0, 100, 255] {
            let (low, high) = black(&truth, (0..256).map(|row| row * 256 + column));
            assert!(low - 1e-9 <= thickness && thickness <= high + 1e-9, "{thickness}: [{low}, {high}]");
            assert!(high - low < 2e-6);
        }
    }
}

#[test]
fn case_9_a_contour_line_on_a_ramp_is_as_wide_in_plan() {
    for (degrees, width) in [(0.0f64, 4.0), (45.0, 5.66), (80.0, 23.0), (85.0, 45.9), (89.0, 229.0)] {
        let slope = math::tan(degrees.to_radians());
        let normal = DVec3::new(0.0, -slope, 1.0).normalize() * 400.0;
        let mut at_right_angles =
            camera(normal.to_array(), [0.0; 3], Projection::Orthographic { height_m: 320.0 });
        at_right_angles.up = DVec3::Y + DVec3::Z;
        let contour = line(&[(-300.0, 0.0), (300.0, 0.0)], stroke(4.0));
        let truth =
            truth(&scene((8, 160), at_right_angles, vec![contour]), posts(3, 300.0, |_, y| y * slope), 1e-7);
        let (low, high) = black(&truth, (0..160).map(|row| row * 8 + 3));
        let exact = 4.0 * (1.0 + slope * slope).sqrt();
        assert!((exact - width).abs() < 0.005 * width);
        assert!(low - 1e-7 <= exact / 2.0 && exact / 2.0 <= high + 1e-7, "{exact}: [{low}, {high}]");
    }
}

#[test]
fn case_22_miters_have_their_exact_area_and_fall_to_bevels_over_the_limit() {
    for interior in [90.0f64, 30.0, 10.0, 1.0] {
        let (turn, half) = ((180.0 - interior).to_radians(), 2.0);
        // From the west to the origin, then on after the turn to the left.
        let (x, y) = (100.0 * math::cos(turn), 100.0 * math::sin(turn));
        for limit in [1.0, 4.0, 1000.0] {
            let style = Line { join: Join::Miter { limit }, ..stroke(2.0 * half) };
            let truth =
                truth(&map(128, vec![line(&[(-100.0, 0.0), (0.0, 0.0), (x, y)], style)]), flat(), 1e-5);
            let bevelled = Line { join: Join::Bevel, ..stroke(2.0 * half) };
            let bevel = self::truth(
                &map(128, vec![line(&[(-100.0, 0.0), (0.0, 0.0), (x, y)], bevelled)]),
                flat(),
                1e-5,
            );
            let is_mitred = 1.0 / math::sin(interior.to_radians() / 2.0) <= limit;
            // Kite minus bevel triangle: half^2 (tan(t/2) - sin(t)/2).
            let more = half * half * (math::tan(turn / 2.0) - math::sin(turn) / 2.0);
            // The tip of the sharpest kite leaves the picture.
            if interior == 1.0 && is_mitred {
                continue;
            }
            let (low, high) = black(&truth, 0..128 * 128);
            let (bevel_low, bevel_high) = black(&bevel, 0..128 * 128);
            let by = if is_mitred { more } else { 0.0 };
            let range = (low - bevel_high - 1e-6, high - bevel_low + 1e-6);
            assert!(range.0 <= by && by <= range.1, "{interior} deg, limit {limit}: {by} not in {range:?}");
            assert!(range.1 - range.0 < 0.1);
        }
    }
}

#[test]
fn case_24_round_joins_of_a_wide_ring_give_the_minkowski_sum() {
    let ring: Vec<(f64, f64)> = (0..=360)
        .map(|k| f64::from(k % 360).to_radians())
        .map(|a| (2.0 * math::cos(a), 2.0 * math::sin(a)))
        .collect();
    let style = Line { join: Join::Round, ..stroke(10.0) };
    let truth = truth(&map(20, vec![line(&ring, style)]), flat(), 1e-3);
    // The polygon's area, its length times the half width, a disc.
    let (n, r, half) = (360.0f64, 2.0f64, 5.0f64);
    let step = std::f64::consts::TAU / n;
    let area = n / 2.0 * r * r * math::sin(step)
        + 2.0 * n * r * math::sin(step / 2.0) * half
        + std::f64::consts::PI * half * half;
    assert_area(&truth, area, 0.2);
}

#[test]
fn round_joins_of_a_continent_are_decided_as_those_of_a_village_are() {
    let corners = [(-9.0, -6.0), (8.0, -5.0), (1.0, 8.0), (-9.0, -6.0)];
    let covered = |unit: f64| {
        let corners = corners.map(|(x, y)| (x * unit, y * unit));
        let down =
            camera([0.0, 0.0, 10.0 * unit], [0.0; 3], Projection::Orthographic { height_m: 24.0 * unit });
        let ring = line(&corners, Line { join: Join::Round, ..stroke(0.5 * unit) });
        let scene = scene((24, 24), down, vec![ring]);
        black(&truth(&scene, posts(29, 2.0 * unit, |_, _| 0.0), 1e-3), 0..24 * 24)
    };
    let ((low, high), (least, most)) = (covered(1e5), covered(1.0));
    assert!(most - least < 1.0 && high - low < 1.0, "{least} {most}, {low} {high}");
    assert!(low <= most && least <= high);
}

#[test]
fn case_25_a_line_covers_a_point_once_and_two_lines_twice() {
    let eight = [(-20.0, -20.0), (20.0, 20.0), (20.0, -20.0), (-20.0, 20.0)];
    let half = |layers: usize| {
        let style = Line { color: Color([0.0, 0.0, 0.0, 0.5]), ..stroke(8.0) };
        let truth = truth(&map(32, vec![line(&eight, style); layers]), flat(), 1e-9);
        // The pixel at the crossing.
        let (low, high) = black(&truth, std::iter::once(16 * 32 + 16));
        assert!(high - low < 1e-9);
        high
    };
    assert!((half(1) - 0.5).abs() < 1e-9);
    assert!((half(2) - 0.75).abs() < 1e-9);
}

#[test]
fn case_27_a_line_is_as_wide_as_it_says() {
    for width in [1.0, 3.0, 7.0, 16.0, 31.0] {
        let truth = truth(&map(64, vec![line(&[(-90.0, -21.3), (90.0, 33.7)], stroke(width))]), flat(), 1e-7);
        // Each column is crossed at the same slant.
        let slant = (55.0f64 * 55.0 + 180.0 * 180.0).sqrt() / 180.0;
        let (low, high) = black(&truth, (0..64).map(|row| row * 64 + 31));
        assert!(low - 1e-9 <= width * slant && width * slant <= high + 1e-9, "{width}: [{low}, {high}]");
        assert!(high - low < 1e-5);
    }
}

#[test]
fn cases_33_to_35_polygons_have_their_exact_areas() {
    let moved =
        |ring: &[(f64, f64)], x: f64, y: f64| ring.iter().map(|p| (p.0 - x, p.1 - y)).collect::<Vec<_>>();
    let outer = moved(&[(10.0, 10.0), (25.0, 10.0), (25.0, 40.0), (10.0, 40.0)], 17.0, 25.0);
    let (a, b) = (
        moved(&[(15.0, 30.0), (20.0, 35.0), (10.0, 40.0)], 17.0, 25.0),
        moved(&[(15.0, 15.0), (15.0, 20.0), (20.0, 15.0)], 17.0, 25.0),
    );
    let with_holes = polygon(&[&outer, &a, &b], Rule::EvenOdd, BLACK);
    assert_area(&truth(&map(64, vec![with_holes]), flat(), 1e-7), 400.0, 1e-4);

    let outer = moved(&[(0.0, 0.0), (20.0, 0.0), (20.0, 25.0), (0.0, 25.0)], 10.1, 12.3);
    let (a, b) = (
        moved(&[(3.0, 3.0), (2.0, 12.0), (9.0, 15.0)], 10.1, 12.3),
        moved(&[(9.0, 21.0), (2.0, 12.0), (7.0, 22.0)], 10.1, 12.3),
    );
    let touching = polygon(&[&outer, &a, &b], Rule::EvenOdd, BLACK);
    assert_area(&truth(&map(32, vec![touching]), flat(), 1e-7), 454.5, 1e-4);

    let star: Vec<(f64, f64)> = (0..5)
        .map(|k| (f64::from(k) * 144.0 + 90.0).to_radians())
        .map(|a| (100.0 * math::cos(a), 100.0 * math::sin(a)))
        .collect();
    for (rule, area) in [(Rule::EvenOdd, 7756.77), (Rule::NonZero, 11225.70)] {
        let truth = truth(&map(208, vec![polygon(&[&star], rule, BLACK)]), flat(), 1e-7);
        let (low, high) = black(&truth, 0..208 * 208);
        assert!(low - 0.005 <= area && area <= high + 0.005 && high - low < 1e-3, "{area}: [{low}, {high}]");
    }
}

#[test]
fn case_40_polygons_under_a_pixel_keep_their_area() {
    let mut state = 1u32;
    let mut next = move || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state >> 8) / f64::from(1 << 24)
    };
    let squares: Vec<Feature> = (0..32 * 32)
        .map(|k| {
            let corner = (f64::from(k % 32) - 16.0 + 0.9 * next(), f64::from(k / 32) - 16.0 + 0.9 * next());
            let ring =
                [(0.0, 0.0), (0.1, 0.0), (0.1, 0.1), (0.0, 0.1)].map(|(x, y)| (corner.0 + x, corner.1 + y));
            Feature { index: k as usize, style: 0, shape: Shape::Polygon(vec![plan(&ring)]) }
        })
        .collect();
    let style = Style { fill: Some(Fill { color: BLACK, rule: Rule::EvenOdd }), ..Style::default() };
    let all = Layer::uniform("squares", style, squares);
    let truth = truth(&map(32, vec![all]), flat(), 1e-9);
    let (low, high) = black(&truth, 0..32 * 32);
    assert!(low <= 10.24 && 10.24 <= high && high - low < 1e-5, "[{low}, {high}]");
    let (low, high) = black(&truth, std::iter::once(77));
    assert!(low - 1e-12 <= 0.01 && 0.01 <= high + 1e-12 && high - low < 1e-9);
}

#[test]
fn case_41_red_over_blue_is_composed_in_layer_order() {
    let square: &[(f64, f64)] = &[(-9.0, -9.0), (9.0, -9.0), (9.0, 9.0), (-9.0, 9.0)];
    let (blue, red) = (Color([0.0, 0.0, 1.0, 0.5]), Color([1.0, 0.0, 0.0, 0.5]));
    let outline = Style {
        outline: Some(Outline { line: Line { color: red, ..stroke(30.0) }, mode: OutlineMode::Normal }),
        ..Style::default()
    };
    let tops = [
        polygon(&[square], Rule::NonZero, red),
        line(&[(-9.0, 0.0), (9.0, 0.0)], Line { color: red, ..stroke(12.0) }),
        line(&[(-9.0, 0.0), (9.0, 0.0)], Line { color: red, width: Width::Pixels(12.0), ..stroke(1.0) }),
        layer(Shape::Polygon(vec![plan(square)]), outline),
    ];
    for top in tops {
        let mut scene = map(4, vec![polygon(&[square], Rule::EvenOdd, blue), top]);
        scene.ground = Ground::flat(Color([0.0; 4]));
        let truth = truth(&scene, flat(), 1e-9);
        // Premultiplied (.5, 0, .25, .75).
        for (c, value) in [2.0 / 3.0, 0.0, 1.0 / 3.0, 0.75].into_iter().enumerate() {
            let (low, high) = (truth.low.at(1, 1)[c], truth.high.at(1, 1)[c]);
            assert!(
                low <= value + 1e-12 && value <= high + 1e-12 && high - low < 1e-9,
                "{c}: [{low}, {high}]"
            );
        }
    }
}

/// The work of 8 x 8 pixels that see a metre between so many long oblique lines.
fn work_beside_lines(count: u32) -> u64 {
    let beside = |k: u32| f64::from(k) * 4.0 - f64::from(count) * 2.0;
    let lines = (0..count)
        .map(|k| vec![Plan::new(-4000.0, beside(k) - 4002.0), Plan::new(4000.0, beside(k) + 3998.0)])
        .collect();
    let style = Style { line: Some(stroke(0.01)), ..Style::default() };
    let mut scene = map(8, vec![layer(Shape::Line(lines), style)]);
    scene.camera.projection = Projection::Orthographic { height_m: 1.0 };
    truth(&scene, posts(9, 1000.0, |_, _| 0.0), 1.0 / 510.0).tally.pieces
}

#[test]
fn long_lines_that_pass_what_is_seen_cost_no_pieces() {
    assert_eq!([100, 200, 400].map(work_beside_lines), [work_beside_lines(0); 3]);
}

/// 12 x 12 pixels under a wide line that is cut into so many segments.
fn under_a_line_of(segments: u32, width: Width) -> Truth {
    let place = |k: u32| f64::from(k) / f64::from(segments);
    let points: Vec<_> = (0..=segments).map(|k| (20.0 * place(k) - 10.0, 4.0 * place(k) - 2.0)).collect();
    let scene =
        map(12, vec![line(&points, Line { width, join: Join::Round, cap: Cap::Round, ..stroke(1.0) })]);
    truth(&scene, flat(), 1.0 / 510.0)
}

#[test]
fn a_wide_line_of_many_segments_covers_what_its_single_segment_does() {
    for width in [Width::Pixels(5.0), Width::Metres(5.0)] {
        let [one, few, many] = [1, 20, 1000].map(|segments| under_a_line_of(segments, width));
        for (y, x) in (0..12).flat_map(|y| (0..12).map(move |x| (y, x))) {
            for c in 0..4 {
                let (low, high) = (one.low.at(x, y)[c], one.high.at(x, y)[c]);
                // Vertices are rounded to where they are stored.
                assert!(
                    many.low.at(x, y)[c] <= high + 1e-6 && low <= many.high.at(x, y)[c] + 1e-6,
                    "{x},{y}"
                );
            }
        }
        // Most of what many cover the deepest of them tells; without that it is 90 times as many.
        let (few, many) = (few.tally.pieces, many.tally.pieces);
        assert!(many < 40 * few, "{width:?}: {many} pieces, {few} of 20 segments");
    }
}

/// A wide line, and over it a wide outline inside of its polygon, both half transparent and cut into so many segments.
fn under_two_strokes_of(segments: u32, y: f64) -> Truth {
    let place = |k: u32| f64::from(k) / f64::from(segments);
    let half = Color([1.0, 0.0, 0.0, 0.5]);
    let along: Vec<_> = (0..=4 * segments).map(|k| (10.0 * place(k) - 20.0, y)).collect();
    let wide = Line { color: half, width: Width::Metres(9.0), join: Join::Round, cap: Cap::Round };
    let mut ring: Vec<_> = (0..=segments).map(|k| (40.0 * place(k) - 20.0, 0.25)).collect();
    ring.extend([(20.0, 60.0), (-20.0, 60.0)]);
    let outline =
        Outline { line: Line { color: Color([0.0, 0.0, 1.0, 0.5]), ..wide }, mode: OutlineMode::Inset };
    let style = Style { outline: Some(outline), ..Style::default() };
    truth(&map(6, vec![line(&along, wide), layer(Shape::Polygon(vec![plan(&ring)]), style)]), flat(), 1e-4)
}

#[test]
fn strokes_that_cover_a_pixel_with_any_of_their_many_parts_are_painted_once_each() {
    // Either may be found first.
    for at in [-2.47, 0.53] {
        let [one, many] = [1, 2000].map(|segments| under_two_strokes_of(segments, at));
        for (y, x) in (0..6).flat_map(|y| (0..6).map(move |x| (y, x))) {
            for c in 0..4 {
                let (low, high) = (one.low.at(x, y)[c], one.high.at(x, y)[c]);
                assert!(
                    many.low.at(x, y)[c] <= high + 1e-6 && low <= many.high.at(x, y)[c] + 1e-6,
                    "{x},{y}"
                );
            }
        }
    }
}

#[test]
fn a_pixel_of_thirty_thousand_triangles_is_the_mean_of_the_pixels_that_it_would_be() {
    let layers = vec![
        polygon(&[&[(-900.0, -800.0), (700.0, -300.0), (100.0, 900.0)]], Rule::EvenOdd, BLACK),
        line(
            &[(-900.0, 700.0), (800.0, -900.0)],
            Line { color: Color([1.0, 0.0, 0.0, 0.5]), ..stroke(90.0) },
        ),
    ];
    let hills = || posts(129, 16.0, |i, j| 150.0 * math::sin(i / 7.0) * math::cos(j / 11.0));
    let from_the_south =
        camera([200.0, -2600.0, 1500.0], [0.0; 3], Projection::Perspective { fov_y_deg: 40.0 });
    let of_side = |side: usize| {
        let scene = scene((side, side), from_the_south, layers.clone());
        truth(&scene, hills(), 1.0 / 510.0)
    };
    let (one, many) = (of_side(1), of_side(16));
    for c in 0..4 {
        let mean = |colors: &Buffer<[f64; 4]>| colors.values().iter().map(|v| v[c]).sum::<f64>() / 256.0;
        let (low, high) = (one.low.at(0, 0)[c], one.high.at(0, 0)[c]);
        assert!(low <= mean(&many.high) && high >= mean(&many.low), "{c}: {low} {high}");
        assert!(high - low < 0.02, "{c}: {low} {high}");
    }
}

#[test]
fn the_coverage_of_each_feature_is_known_below_an_opaque_one_too() {
    let square = |half: f64| [(-half, -half), (half, -half), (half, half), (-half, half)];
    let (small, large) = (square(2.25), square(3.5));
    let scene =
        map(8, vec![polygon(&[&small], Rule::EvenOdd, BLACK), polygon(&[&large], Rule::EvenOdd, BLACK)]);
    let stage = Stage::new(scene, flat()).unwrap();
    let budget = Budget { coverage: true, ..Budget::new(1e-6, 14).unwrap() };
    let truth = certify(&stage, &stage.view().unwrap(), &budget, &|_| {});
    let coverage = truth.coverage.as_ref().unwrap();
    for (item, area) in [(0, 4.5 * 4.5), (1, 49.0)] {
        let of = coverage.values().iter().flat_map(|pixel| &pixel.items).filter(|c| c.item == item);
        let (low, high) = of.fold((0.0, 0.0), |sum, c| (sum.0 + c.low, sum.1 + c.high));
        let others: f64 = coverage.values().iter().map(|pixel| pixel.others).sum();
        assert!(
            low <= area && area <= high + others && high + others - low < 1e-4,
            "{item}: [{low}, {high}]"
        );
    }
    assert_eq!(stage.draw_list.items()[1].layer, 1);
    // A corner of the small square: a quarter of a quarter pixel is in it, all of the pixel in the large one.
    let corner = coverage.at(1, 1);
    let small = corner.items.iter().find(|c| c.item == 0).unwrap();
    assert!((small.low - 0.0625).abs() < 1e-9 && (small.high - 0.0625).abs() < 1e-9, "{small:?}");
}

/// A hilly scene with everything in it; `k` picks what is special.
fn varied(k: usize) -> (Scene, Surface) {
    let ring: &[(f64, f64)] = &[(-30.0, -22.0), (26.0, -31.0), (35.0, 18.0), (-4.0, 8.0), (-22.0, 33.0)];
    let hole: &[(f64, f64)] = &[(-8.0, -15.0), (9.0, -18.0), (3.0, -4.0)];
    let road: &[(f64, f64)] = &[(-45.0, 5.0), (-12.0, -6.0), (4.0, 24.0), (14.0, -20.0), (45.0, 2.0)];
    let color = |r, g, b, a| Color([r, g, b, a]);
    let width = if k.is_multiple_of(2) { Width::Metres(5.0) } else { Width::Pixels(2.5) };
    let joins = [Join::Round, Join::Miter { limit: 4.0 }, Join::Bevel];
    let road_line = Line {
        color: color(0.9, 0.2, 0.1, 0.8),
        width,
        join: joins[k % 3],
        cap: [Cap::Round, Cap::Square, Cap::Butt][k / 2 % 3],
    };
    let lake = Style {
        fill: Some(Fill { color: color(0.1, 0.3, 0.9, 0.6), rule: [Rule::EvenOdd, Rule::NonZero][k % 2] }),
        outline: Some(Outline {
            line: Line { color: color(0.0, 0.0, 0.2, 1.0), ..stroke(3.0) },
            mode: [OutlineMode::Inset, OutlineMode::Normal, OutlineMode::Offset][k % 3],
        }),
        ..Style::default()
    };
    // The members of every other lake overlap, across a hole.
    let cove: &[(f64, f64)] = &[(-16.0, -12.0), (12.0, -12.0), (12.0, 16.0), (-16.0, 16.0)];
    let lake_shape = match k % 2 {
        0 => Shape::Polygon(vec![plan(ring), plan(hole)]),
        _ => Shape::MultiPolygon(vec![vec![plan(ring), plan(hole)], vec![plan(cove)]]),
    };
    let layers = vec![
        layer(lake_shape, lake),
        line(road, road_line),
        line(&[(-40.0, -40.0), (40.0, 40.0)], Line { width: Width::Pixels(1.5), ..stroke(1.0) }),
    ];
    let projection = match k % 4 {
        3 => Projection::Orthographic { height_m: 60.0 },
        _ => Projection::Perspective { fov_y_deg: 40.0 },
    };
    let eye = [[-40.0, -70.0, 40.0], [55.0, 20.0, 9.0], [3.0, -2.0, 90.0], [-60.0, 45.0, 30.0]][k % 4];
    let mut scene = scene((36, 24), camera(eye, [0.0, 0.0, 4.0], projection), layers);
    scene.image.background = color(0.7, 0.8, 1.0, 1.0);
    scene.ground = Ground { light: Some(Light::default()), ..Ground::flat(color(0.8, 0.9, 0.6, 1.0)) };
    if k == 5 || k == 11 {
        scene.compositing.mode = BlendMode::Additive;
    }
    if k == 4 || k == 9 {
        scene.compositing.space = BlendSpace::Linear;
    }
    if k == 8 || k == 9 {
        // Texels that no cell of the terrain agrees with, in a low light.
        let texel = |t: usize| color(0.2 + 0.1 * (t % 7) as f64, 0.9 - 0.1 * (t % 5) as f64, 0.5, 1.0);
        let texels = Buffer::from_values(11, 7, (0..77).map(texel).collect());
        let extent = PlanBox { min: Plan::new(-40.0, -45.0), max: Plan::new(46.0, 41.0) };
        let light = Light { azimuth_deg: 200.0, elevation_deg: 25.0 };
        scene.ground =
            Ground { colors: GroundColors::Imagery(Imagery { texels, extent }), light: Some(light) };
    }
    if k >= 9 {
        // The lake's outline lies over its fill, and the roads cross.
        let road = scene.layers.remove(1);
        scene.layers[0].styles[0].line = road.styles[0].line;
        scene.layers[0].features.extend(road.features);
        scene.layers[0].opacity = 0.4;
        scene.layers[1].opacity = 0.75;
    }
    let height = move |x: f64, y: f64| {
        let hill = 9.0 * math::sin(x * 0.11 + k as f64) * math::cos(y * 0.13);
        // A hole in the surface, and a cliff.
        if k == 2 && x.abs() < 6.0 && y > 20.0 { f64::NAN } else { hill + if x > 20.0 { 12.0 } else { 0.0 } }
    };
    (scene, posts(9, 12.0, height))
}

mod brute_force {
    //! Every sample against every triangle and every feature, in plain doubles, from the definitions.

    use super::*;
    use drapery::space::Screen;

    fn segment_distance(a: Plan, b: Plan, p: Plan) -> f64 {
        let (d, v) = (b - a, p - a);
        let t = if d.length_squared() > 0.0 { (v.dot(d) / d.length_squared()).clamp(0.0, 1.0) } else { 0.0 };
        (v - d * t).length()
    }

    fn winding(rings: &[Vec<Plan>], p: Plan) -> i32 {
        let mut turns = 0;
        for ring in rings {
            for (k, a) in ring.iter().enumerate() {
                let b = ring[(k + 1) % ring.len()];
                let side = (b - *a).perp_dot(p - *a);
                turns += i32::from(a.y <= p.y && b.y > p.y && side > 0.0);
                turns -= i32::from(b.y <= p.y && a.y > p.y && side < 0.0);
            }
        }
        turns
    }

    fn in_triangle(a: DVec2, b: DVec2, c: DVec2, p: DVec2) -> bool {
        let sides = [(b - a).perp_dot(p - a), (c - b).perp_dot(p - b), (a - c).perp_dot(p - c)];
        sides.iter().all(|s| *s >= 0.0) || sides.iter().all(|s| *s <= 0.0)
    }

    fn in_static_stroke(chain: &[Plan], is_ring: bool, line: &Line, half: f64, p: Plan) -> bool {
        let last = chain.len() - 1;
        let direction = |k: usize| (chain[k + 1] - chain[k]).normalize();
        for k in 0..last {
            let (d, v) = (direction(k), p - chain[k]);
            let cap = |is_end: bool| if is_end && !is_ring && line.cap == Cap::Square { half } else { 0.0 };
            let (along, length) = (v.dot(d), (chain[k + 1] - chain[k]).length());
            let in_reach = along >= -cap(k == 0) && along <= length + cap(k + 1 == last);
            if in_reach && d.perp_dot(v).abs() <= half {
                return true;
            }
            let joined = if k > 0 { Some(direction(k - 1)) } else { is_ring.then(|| direction(last - 1)) };
            if joined.is_some_and(|before| in_join(before, d, line.join, half, v)) {
                return true;
            }
        }
        let ends = !is_ring && line.cap == Cap::Round;
        ends && [chain[0], chain[last]].iter().any(|end| (p - *end).length() <= half)
    }

    fn in_join(before: DVec2, after: DVec2, join: Join, half: f64, v: DVec2) -> bool {
        let sign = if before.perp_dot(after) > 0.0 { 1.0 } else { -1.0 };
        let normal = |d: DVec2| DVec2::new(d.y, -d.x) * sign * half;
        let (n1, n2) = (normal(before), normal(after));
        let tip = (n1 + n2) / (1.0 + before.dot(after));
        match join {
            Join::Round => v.length() <= half,
            Join::Miter { limit } if tip.length() <= limit * half => {
                in_triangle(DVec2::ZERO, n1, tip, v) || in_triangle(DVec2::ZERO, tip, n2, v)
            }
            _ => in_triangle(DVec2::ZERO, n1, n2, v),
        }
    }

    fn in_stroke(points: &[Plan], is_ring: bool, line: &Line, seen: &Seen) -> bool {
        let mut chain = points.to_vec();
        if is_ring {
            chain.push(points[0]);
        }
        match line.width {
            Width::Metres(width) => in_static_stroke(&chain, is_ring, line, width / 2.0, seen.plan),
            Width::Pixels(width) => {
                chain.windows(2).any(|s| segment_distance(s[0], s[1], seen.plan) <= width / 2.0 * seen.pixel)
            }
        }
    }

    /// A visible point and the size of a pixel there.
    struct Seen {
        plan: Plan,
        pixel: f64,
    }

    fn linear(v: f64) -> f64 {
        if v <= 0.04045 { v / 12.92 } else { math::pow((v + 0.055) / 1.055, 2.4) }
    }

    /// Premultiplied, in the working space.
    fn over(scene: &Scene, below: [f64; 4], color: Color) -> [f64; 4] {
        let [r, g, b, a] = color.0;
        let work = |v: f64| if scene.compositing.space == BlendSpace::Linear { linear(v) } else { v };
        let source = [work(r) * a, work(g) * a, work(b) * a, a];
        let mut out = [0.0; 4];
        for c in 0..4 {
            out[c] = match scene.compositing.mode {
                BlendMode::Over => source[c] + below[c] * (1.0 - a),
                BlendMode::Additive => math::min(source[c] + below[c], 1.0),
            };
        }
        out
    }

    fn color_at(scene: &Scene, mesh: &Mesh, view: &drapery::space::ViewFrame, at: Screen) -> [f64; 4] {
        let ray = view.ray(at);
        let along = (ray.through - ray.from) / view.reach();
        let mut nearest: Option<(f64, [World; 3])> = None;
        for t in (0..mesh.triangle_ids()).filter_map(|id| mesh.triangle(id)) {
            let (e, f) = (t[1] - t[0], t[2] - t[0]);
            let normal = e.cross(f);
            let depth = normal.dot(t[0] - ray.from) / normal.dot(along);
            let p = (ray.from + along * depth).plan();
            let [a, b, c] = t.map(|v| v.plan().to_vec());
            let is_hit = depth >= view.near() && in_triangle(a, b, c, p.to_vec());
            if is_hit && nearest.is_none_or(|n| depth < n.0) {
                nearest = Some((depth, t));
            }
        }
        let Some((depth, triangle)) = nearest else {
            return over(scene, [0.0; 4], scene.image.background);
        };
        let p = ray.from + along * depth;
        let distance = if matches!(scene.camera.projection, Projection::Orthographic { .. }) {
            1.0
        } else {
            (p - view.eye()).length()
        };
        let seen = Seen { plan: p.plan(), pixel: view.lens().pixel() * distance };
        let color = match &scene.ground.colors {
            GroundColors::Constant(color) => *color,
            GroundColors::Imagery(Imagery { texels, extent }) => {
                let share = (seen.plan - extent.min) / (extent.max - extent.min);
                let texel = |share: f64, count: usize| ((share * count as f64) as usize).min(count - 1);
                *texels.at(texel(share.x, texels.width()), texel(1.0 - share.y, texels.height()))
            }
        };
        let ground = match &scene.ground.light {
            Some(light) => {
                let n = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalize();
                let light = math::max(n.dot(light.direction()), 0.0);
                let [r, g, b, a] = color.0;
                Color([r * light, g * light, b * light, a])
            }
            None => color,
        };
        let mut paint = over(scene, [0.0; 4], ground);
        for layer in &scene.layers {
            let below = paint;
            for feature in &layer.features {
                let style = layer.style_of(feature);
                match &feature.shape {
                    Shape::Line(parts) => {
                        let line = style.line.as_ref().unwrap();
                        if parts.iter().any(|part| in_stroke(part, false, line, &seen)) {
                            paint = over(scene, paint, line.color);
                        }
                    }
                    Shape::Points(_) => unreachable!("these scenes have none"),
                    Shape::Polygon(_) | Shape::MultiPolygon(_) | Shape::Swath { .. } => {
                        let fill = style.fill.as_ref();
                        let rule = fill.map_or(Rule::EvenOdd, |f| f.rule);
                        let inside = match &feature.shape {
                            Shape::MultiPolygon(members) => {
                                members.iter().any(|rings| rule.contains(winding(rings, seen.plan)))
                            }
                            shape => {
                                rule.contains(winding(&shape.parts().cloned().collect::<Vec<_>>(), seen.plan))
                            }
                        };
                        if let Some(fill) = fill.filter(|_| inside) {
                            paint = over(scene, paint, fill.color);
                        }
                        if let Some(outline) = &style.outline {
                            let wanted = match outline.mode {
                                OutlineMode::Inset => inside,
                                OutlineMode::Normal => true,
                                OutlineMode::Offset => !inside,
                            };
                            let mut rings = feature.shape.parts();
                            if wanted && rings.any(|r| in_stroke(r, true, &outline.line, &seen)) {
                                paint = over(scene, paint, outline.line.color);
                            }
                        }
                    }
                }
            }
            for c in 0..4 {
                paint[c] = (1.0 - layer.opacity) * below[c] + layer.opacity * paint[c];
            }
        }
        paint
    }

    fn encoded(v: f64) -> f64 {
        if v <= 0.0031308 { v * 12.92 } else { 1.055 * math::pow(v, 1.0 / 2.4) - 0.055 }
    }

    /// The mean colour of a pixel over n x n jittered samples.
    fn sampled(scene: &Scene, mesh: &Mesh, (x, y): (usize, usize), n: usize, state: &mut u32) -> [f64; 4] {
        let view = scene.camera.view(&scene.image).unwrap();
        let mut sum = [0.0; 4];
        for k in 0..n * n {
            let mut next = || {
                *state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                f64::from(*state >> 8) / f64::from(1 << 24)
            };
            let at = Screen::new(
                x as f64 + ((k % n) as f64 + next()) / n as f64,
                y as f64 + ((k / n) as f64 + next()) / n as f64,
            );
            let color = color_at(scene, mesh, &view, at);
            (0..4).for_each(|c| sum[c] += color[c] / (n * n) as f64);
        }
        let is_linear = scene.compositing.space == BlendSpace::Linear;
        (0..3).for_each(|c| sum[c] = if is_linear { encoded(sum[c] / sum[3]) } else { sum[c] / sum[3] });
        sum
    }

    #[test]
    fn samples_agree_with_the_intervals_as_far_as_chance_allows() {
        const N: usize = 16;
        for k in 0..12 {
            let (scene, surface) = varied(k);
            let mesh = Mesh::new(surface.clone(), scene.diagonal).unwrap();
            let truth = truth(&scene, surface, 1.0 / 510.0);
            assert!(truth.widest() <= 1.0 / 510.0, "scene {k}: {}", truth.widest());
            let (mut state, mut signed, mut square) = (k as u32, 0.0, 0.0);
            let pixels = scene.image.width * scene.image.height;
            for at in 0..pixels {
                let at = (at % scene.image.width, at / scene.image.width);
                let color = sampled(&scene, &mesh, at, N, &mut state);
                for (c, value) in color.into_iter().enumerate().take(3) {
                    let (low, high) = (truth.low.at(at.0, at.1)[c], truth.high.at(at.0, at.1)[c]);
                    let off = math::max(value - high, 0.0) - math::max(low - value, 0.0);
                    // Hoeffding: 256 independent samples of 0..=1 stray by more than this once in 10^8 pixels.
                    assert!(
                        off.abs() < 0.19,
                        "scene {k}, pixel {at:?}, channel {c}: {value} is not in [{low}, {high}]"
                    );
                    signed += off;
                    square += off * off;
                }
            }
            let values = (3 * pixels) as f64;
            // Jittered samples do better than independent ones (0.5 / 16 a pixel), and have no bias.
            assert!((square / values).sqrt() < 0.5 / N as f64, "scene {k}: {}", (square / values).sqrt());
            assert!((signed / values).abs() < 0.003, "scene {k}: {}", signed / values);
        }
    }
}

#[test]
fn the_pixels_centres_see_what_exact_visibility_says() {
    use drapery::buffer::{Plane, Values};
    for k in 0..4 {
        let (mut scene, surface) = varied(k);
        scene.layers.clear();
        let truth = truth(&scene, surface.clone(), 1e-3);
        let stage = Stage::new(scene, surface).unwrap();
        let names = ["depth".to_owned(), "triangle".to_owned()];
        let prepared = technique::prepare(Kind::InverseProjection, &stage).unwrap();
        let frame = prepared
            .frame(&stage.view().unwrap(), &FrameOptions { tile: 16, buffers: &names, progress: &|_| {} })
            .unwrap();
        let plane = |name: &str| frame.planes.iter().find(|p| p.name == name).unwrap();
        assert_eq!(truth.plane("triangle").unwrap().values, plane("triangle").values, "scene {k}");
        let (Some(Plane { values: Values::F64(own), .. }), Values::F64(theirs)) =
            (truth.plane("depth"), &plane("depth").values)
        else {
            panic!("depths are doubles");
        };
        for (a, b) in own.iter().zip(theirs) {
            assert!(a == b || (a - b).abs() < 1e-9 * b, "scene {k}: {a} and {b}");
        }
    }
}

#[test]
fn threads_change_no_bit() {
    let (scene, surface) = varied(1);
    let on = |threads| {
        let surface = surface.clone();
        drapery::parallel::with_threads(threads, || truth(&scene, surface, 1e-3)).unwrap()
    };
    let (one, eight) = (on(1), on(8));
    assert_eq!(one.low, eight.low);
    assert_eq!(one.high, eight.high);
    assert_eq!(one.estimate, eight.estimate);
}

/// The truth of a scene is finite, in order and the same twice.
#[track_caller]
fn assert_sound(scene: &Scene, surface: Surface) -> Truth {
    let first = truth(scene, surface.clone(), 1.0 / 510.0);
    let again = truth(scene, surface, 1.0 / 510.0);
    assert_eq!((&first.low, &first.high), (&again.low, &again.high));
    for (low, high) in first.low.values().iter().zip(first.high.values()) {
        for c in 0..4 {
            assert!(
                low[c].is_finite()
                    && high[c].is_finite()
                    && 0.0 <= low[c]
                    && low[c] <= high[c]
                    && high[c] <= 1.0
            );
        }
    }
    first
}

#[test]
fn degenerate_features_are_certified() {
    let ring = |points: &[(f64, f64)]| polygon(&[points], Rule::EvenOdd, BLACK);
    let nothing = [
        ring(&[(0.0, 0.0), (5.0, 5.0), (0.0, 0.0)]),
        ring(&[(1.0, 1.0)]),
        ring(&[(-9.0, 0.0), (9.0, 0.0), (3.0, 0.0)]),
        line(&[(2.0, 2.0), (2.0, 2.0), (2.0, 2.0)], stroke(4.0)),
        line(&[(500.0, 500.0), (900.0, 900.0)], stroke(4.0)),
    ];
    for layer in nothing {
        let truth = assert_sound(&map(8, vec![layer]), flat());
        assert_area(&truth, 0.0, 1e-6);
    }
}

#[test]
fn overlapping_duplicates_are_composed_one_after_the_other() {
    let square: &[(f64, f64)] = &[(-2.3, -2.3), (2.3, -2.3), (2.3, 2.3), (-2.3, 2.3)];
    let layers = vec![polygon(&[square], Rule::EvenOdd, Color([0.0, 0.0, 0.0, 0.5])); 40];
    let truth = assert_sound(&map(8, layers), flat());
    assert!(truth.high.at(4, 4)[0] < 1e-9);
    let twice = polygon(&[square, square], Rule::EvenOdd, BLACK);
    assert_area(&assert_sound(&map(8, vec![twice]), flat()), 0.0, 1e-3);
    let twice = polygon(&[square, square], Rule::NonZero, BLACK);
    assert_area(&truth_of(map(8, vec![twice])), 4.6 * 4.6, 1e-3);
}

#[test]
fn a_crowd_of_many_colours_is_bounded_by_all_of_them() {
    // White first, so that one colour alone would not do.
    let color = |k: u32| match k % 4 {
        0 => WHITE,
        1 => Color([0.1, 0.9, 0.9, 0.9]),
        2 => Color([0.9, 0.1, 0.9, 0.9]),
        _ => Color([0.9, 0.9, 0.1, 0.9]),
    };
    let style = |k| Style { line: Some(Line { color: color(k), ..stroke(0.05) }), ..Style::default() };
    let across = |k: u32| {
        let y = f64::from(k) * 0.9 / 400.0 - 0.45;
        Feature {
            index: k as usize,
            style: k % 8,
            shape: Shape::Line(vec![plan(&[(-4.0, y), (4.0, y + 0.01)])]),
        }
    };
    let features = (0..400).map(across).collect();
    let crowd = Layer {
        name: "crowd".into(),
        styles: (0..8).map(style).collect(),
        features,
        opacity: 1.0,
        outside: None,
    };
    let stage = Stage::new(map(1, vec![crowd]), flat()).unwrap();
    let by = |depth| certify(&stage, &stage.view().unwrap(), &Budget::new(1e-4, depth).unwrap(), &|_| {});
    let (coarse, fine) = (by(0), by(16));
    let [wide, narrow] = [&coarse, &fine].map(|truth| (truth.low.at(0, 0), truth.high.at(0, 0)));
    for c in 0..3 {
        assert!(wide.1[c] - wide.0[c] > 0.5, "nothing has been looked at: {wide:?}");
        assert!(wide.0[c] <= narrow.0[c] && narrow.1[c] <= wide.1[c], "{narrow:?} is not in {wide:?}");
    }
}

fn truth_of(scene: Scene) -> Truth {
    truth(&scene, flat(), 1e-6)
}

#[test]
fn widths_of_a_micrometre_and_of_a_thousand_kilometres_are_certified() {
    for join in [Join::Round, Join::Bevel, Join::Miter { limit: 10.0 }] {
        let of = |width| {
            let style = Line { join, cap: Cap::Round, ..stroke(width) };
            map(8, vec![line(&[(-30.0, -1.0), (0.5, 0.25), (30.0, 4.0)], style)])
        };
        let (low, high) = black(&truth(&of(1e-6), flat(), 1e-9), 0..64);
        let length = 4.5 * (1.0 + (1.25f64 / 30.5) * (1.25 / 30.5)).sqrt()
            + 3.5 * (1.0 + (3.75f64 / 29.5) * (3.75 / 29.5)).sqrt();
        assert!((low - 1e-9..=high + 1e-9).contains(&(length * 1e-6)), "{length}: [{low}, {high}]");
        assert_area(&assert_sound(&of(1e6), flat()), 64.0, 1e-6);
    }
    for width in [1e-6, 1e6] {
        let style = Line { width: Width::Pixels(width), ..stroke(1.0) };
        let (mut scene, surface) = varied(0);
        scene.layers = vec![line(&[(-30.0, -1.0), (0.5, 0.25), (30.0, 4.0)], style)];
        assert_sound(&scene, surface);
    }
}

#[test]
fn opacities_of_zero_and_one_are_certified() {
    let square: &[(f64, f64)] = &[(-2.5, -2.5), (2.5, -2.5), (2.5, 2.5), (-2.5, 2.5)];
    let clear = polygon(&[square], Rule::EvenOdd, Color([0.0, 0.0, 0.0, 0.0]));
    assert_area(&assert_sound(&map(8, vec![clear]), flat()), 0.0, 1e-6);
    let mut scene = map(8, vec![polygon(&[square], Rule::EvenOdd, BLACK)]);
    scene.ground = Ground::flat(Color([0.3, 0.3, 0.3, 0.0]));
    scene.image.background = Color([0.0; 4]);
    let truth = assert_sound(&scene, flat());
    assert!(truth.high.at(0, 0)[3] < 1e-12);
    assert!(truth.low.at(3, 3)[3] > 1.0 - 1e-9);
}

#[test]
fn an_eye_on_a_vertex_and_rays_along_edges_are_certified() {
    // The eye on a post; on an edge; under the ground; level with a plain that it looks along.
    let eyes = [[0.0, 0.0, 5.0], [4.0, 0.0, 5.0], [3.0, 1.0, -10.0], [1.0, 1.0, 5.0]];
    for eye in eyes {
        let target = [30.0, 0.0, 5.0];
        let view = camera(eye, target, Projection::Perspective { fov_y_deg: 70.0 });
        let road = line(&[(-40.0, 3.0), (40.0, 3.0)], Line { join: Join::Round, ..stroke(2.0) });
        let scene = scene((16, 12), view, vec![road]);
        assert_sound(&scene, posts(9, 8.0, |_, _| 5.0));
        assert_sound(
            &scene,
            posts(9, 8.0, |x, y| 5.0 + if x == 0.0 && y == 0.0 { 0.0 } else { 0.01 * x.abs() }),
        );
    }
    // Every pixel's corner lies on a post, every border on an edge.
    let mut down = map(
        16,
        vec![polygon(&[&[(-4.0, -4.0), (4.0, -4.0), (4.0, 4.0), (-4.0, 4.0)]], Rule::EvenOdd, BLACK)],
    );
    down.camera.up = DVec3::Y;
    assert_area(&assert_sound(&down, posts(33, 1.0, |x, y| (x * 7.0 + y * 3.0) % 2.0)), 64.0, 1e-7);
}
