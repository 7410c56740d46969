//! Inverse projection (She 2016) on scenes whose answer is known.
#![cfg(feature = "render")]

use drapery::buffer::{Plane, Values};
use drapery::scene::{
    Camera, Cap, Color, Compositing, Device, Diagonal, Feature, Fill, Ground, ImageSettings, Join, Layer,
    Line, Posts, Projection, Rule, Scene, Shape, Style, Surface, Width,
};
use drapery::space::{Plan, World};
use drapery::stage::Stage;
use drapery::technique::inverse_projection::{Corners, PointInPolygon, Settings, Silhouette};
use drapery::technique::{self, Frame, FrameOptions, Kind};
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

fn camera(eye: [f64; 3], target: [f64; 3], projection: Projection) -> Camera {
    let point = |p: [f64; 3]| World::new(p[0], p[1], p[2]);
    let up = if eye[0] == target[0] && eye[1] == target[1] { DVec3::Y } else { DVec3::Z };
    Camera { eye: point(eye), target: point(target), up, projection, near_m: 0.1, far_m: None }
}

fn scene(size: (usize, usize), camera: Camera, layers: Vec<Layer>, settings: Settings) -> Scene {
    Scene {
        name: "test".into(),
        origin: DVec3::ZERO,
        plan_space: "metres".into(),
        image: ImageSettings { width: size.0, height: size.1, background: Color([0.0, 0.0, 1.0, 1.0]) },
        camera,
        globe: None,
        diagonal: Diagonal::SwNe,
        lod: None,
        ground: Ground::flat(WHITE),
        layers,
        compositing: Compositing::default(),
        device: Device::default(),
        technique: settings.into(),
        notes: Vec::new(),
    }
}

fn layer(shape: Shape, style: Style) -> Layer {
    Layer::uniform("layer", style, vec![Feature { index: 0, style: 0, shape }])
}

fn line(points: &[(f64, f64)], width: f64) -> Layer {
    let line = Line { color: BLACK, width: Width::Metres(width), join: Join::Bevel, cap: Cap::Butt };
    layer(Shape::Line(vec![plan(points)]), Style { line: Some(line), ..Style::default() })
}

fn polygon(rings: &[&[(f64, f64)]]) -> Layer {
    let fill = Fill { color: BLACK, rule: Rule::EvenOdd };
    let rings = rings.iter().map(|r| plan(r)).collect();
    layer(Shape::Polygon(rings), Style { fill: Some(fill), ..Style::default() })
}

fn plan(points: &[(f64, f64)]) -> Vec<Plan> {
    points.iter().map(|&(x, y)| Plan::new(x, y)).collect()
}

fn draw(scene: Scene, surface: Surface, tile: usize) -> Frame {
    let stage = Stage::new(scene, surface).unwrap();
    let prepared = technique::prepare(Kind::InverseProjection, &stage).unwrap();
    let buffers = Kind::InverseProjection.buffer_names();
    prepared
        .frame(&stage.view().unwrap(), &FrameOptions { tile, buffers: &buffers, progress: &|_| {} })
        .unwrap()
}

fn plane<'a>(frame: &'a Frame, name: &str) -> &'a Plane {
    frame.planes.iter().find(|p| p.name == name).unwrap()
}

fn doubles<'a>(frame: &'a Frame, name: &str) -> &'a [f64] {
    match &plane(frame, name).values {
        Values::F64(values) => values,
        other => panic!("{name} holds {other:?}"),
    }
}

fn classes(frame: &Frame) -> &[u8] {
    match &plane(frame, "class").values {
        Values::U8(values) => values,
        other => panic!("class holds {other:?}"),
    }
}

/// Straight down on the plan, one pixel a metre; pixel (0, 0) is the north-west corner.
fn nadir(size: usize, layers: Vec<Layer>, settings: Settings) -> Frame {
    let camera = camera([0.0, 0.0, 100.0], [0.0; 3], Projection::Orthographic { height_m: size as f64 });
    draw(scene((size, size), camera, layers, settings), posts(9, 4.0, |_, _| 0.0), 16)
}

fn exact() -> Settings {
    Settings {
        corners: Corners::True,
        point_in_polygon: PointInPolygon::Winding,
        samples: 4,
        ..Settings::default()
    }
}

/// The red channel (0 black, 9 white) as a picture of digits.
fn ascii(frame: &Frame) -> Vec<String> {
    let digit = |p: &[u8; 4]| char::from(b'0' + (u32::from(p[0]) * 9 / 255) as u8);
    (0..frame.image.height()).map(|y| frame.image.row(y).iter().map(digit).collect()).collect()
}

#[test]
fn a_polygon_with_a_hole_covers_its_pixels_wholly_partly_or_not() {
    let outer = [(-3.0, -3.0), (3.0, -3.0), (3.0, 2.5), (-3.0, 2.5)];
    let hole = [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)];
    let frame = nadir(8, vec![polygon(&[&outer, &hole])], exact());
    let expected =
        ["99999999", "94444449", "90000009", "90099009", "90099009", "90000009", "90000009", "99999999"];
    assert_eq!(ascii(&frame), expected);
    assert_eq!(&classes(&frame)[8 + 1..8 + 7], [1; 6], "the row that the border cuts is P");
    assert_eq!(classes(&frame)[8 * 3 + 4], 1, "the hole's border touches its pixels");
}

#[test]
fn a_pixel_deep_inside_is_f_and_one_far_away_is_n() {
    let frame = nadir(8, vec![polygon(&[&[(-3.5, -3.5), (3.5, -3.5), (3.5, 3.5), (-3.5, 3.5)]])], exact());
    assert_eq!(classes(&frame)[8 * 4 + 4], 2);
    let far = nadir(8, vec![polygon(&[&[(-3.5, -3.5), (-3.2, -3.5), (-3.5, -3.2)]])], exact());
    assert_eq!(classes(&far)[8 * 2 + 6], 0);
}

#[test]
fn the_papers_quadrilateral_shifts_the_picture_half_a_pixel_to_the_lower_left() {
    // Fig. 6b: the pixel takes the plan from its own centre to that of its upper right neighbour, so an edge
    // on a pixel's border lies in the middle of a quadrilateral.
    let half = [(-9.0, -9.0), (0.0, -9.0), (0.0, 9.0), (-9.0, 9.0)];
    let settings = Settings { corners: Corners::Centres, ..exact() };
    assert_eq!(ascii(&nadir(4, vec![polygon(&[&half])], settings))[2], "0499");
    assert_eq!(ascii(&nadir(4, vec![polygon(&[&half])], exact()))[2], "0099");
}

#[test]
fn edge_normals_with_the_pedal_rule_agree_with_the_winding_number_along_a_straight_line() {
    let road = || vec![line(&[(-20.0, -3.0), (20.0, 5.0)], 1.7)];
    let by = |point_in_polygon| nadir(16, road(), Settings { point_in_polygon, ..exact() });
    assert_eq!(by(PointInPolygon::EdgeNormals).image, by(PointInPolygon::Winding).image);
}

/// The pixels of a picture, 16 m wide, that are black by one rule alone.
fn seam(layer: &dyn Fn() -> Layer) -> usize {
    let by = |point_in_polygon| ascii(&nadir(16, vec![layer()], Settings { point_in_polygon, ..exact() }));
    let (normals, winding) = (by(PointInPolygon::EdgeNormals).concat(), by(PointInPolygon::Winding).concat());
    let differ = normals.bytes().zip(winding.bytes()).filter(|(a, b)| a != b);
    differ.inspect(|(normals, winding)| assert!(normals > winding, "{normals} {winding}")).count()
}

/// Code A sums over all edges of an item in the pixel: those of another part, in the middle of what is covered, count against it.
#[test]
fn parts_of_one_item_that_overlap_without_being_united_have_a_seam_by_edge_normals_and_none_by_winding() {
    let disc = Line { color: BLACK, width: Width::Metres(8.0), join: Join::Round, cap: Cap::Round };
    let dots = |points: &[(f64, f64)]| {
        layer(Shape::Points(plan(points)), Style { point: Some(disc), ..Style::default() })
    };
    assert!(seam(&|| dots(&[(-2.0, 0.0), (2.0, 0.3)])) >= 8);
    let square = |x0: f64, x1: f64| vec![plan(&[(x0, -5.3), (x1, -5.3), (x1, 5.4), (x0, 5.4)])];
    let members = |x: f64| {
        let fill = Fill { color: BLACK, rule: Rule::EvenOdd };
        let shape = Shape::MultiPolygon(vec![square(-5.3, 0.3), square(x, 5.4)]);
        layer(shape, Style { fill: Some(fill), ..Style::default() })
    };
    assert_eq!(seam(&|| members(0.3)), 0, "an edge that is shared is none");
    let apart = seam(&|| members(0.3_f64.next_up()));
    assert!((8..=16).contains(&apart), "a seam one pixel wide: {apart}");
}

#[test]
fn plan_points_on_a_plane_and_a_ramp_are_those_of_the_closed_form() {
    let perspective = Projection::Perspective { fov_y_deg: 50.0 };
    for slope in [0.0, 0.5] {
        let camera = camera([3.0, -60.0, 40.0], [1.0, 2.0, 0.5], perspective);
        let frame = draw(
            scene((48, 32), camera, Vec::new(), Settings::default()),
            posts(65, 8.0, |_, y| slope * y),
            32,
        );
        let view = camera.view(&ImageSettings { width: 48, height: 32, background: WHITE }).unwrap();
        for (k, at) in doubles(&frame, "plan").chunks(2).enumerate() {
            if doubles(&frame, "depth")[k].is_infinite() {
                continue;
            }
            let screen = drapery::space::Screen::new((k % 48) as f64 + 0.5, (k / 48) as f64 + 0.5);
            let (x, y) = (screen.x - 24.0, 16.0 - screen.y);
            let pixel = 2.0 * drapery::math::tan(25f64.to_radians()) / 32.0;
            let direction = view.forward() + view.right() * (x * pixel) + view.up() * (y * pixel);
            // eye + t direction on z = slope y
            let t = (slope * -60.0 - 40.0) / (direction.z - slope * direction.y);
            let expected = [3.0 + t * direction.x, -60.0 + t * direction.y];
            let scale = 1.0 + expected[0].abs() + expected[1].abs();
            assert!((at[0] - expected[0]).abs() < 1e-9 * scale && (at[1] - expected[1]).abs() < 1e-9 * scale);
            assert!((doubles(&frame, "depth")[k] - t).abs() < 1e-9 * t);
        }
    }
}

#[test]
fn the_sky_and_pixels_whose_quadrilateral_reaches_it_are_told_apart() {
    // A level view over a plain: the horizon's pixels have upper neighbours in the sky.
    let camera = camera([0.0, -30.0, 5.0], [0.0, 30.0, 5.0], Projection::Perspective { fov_y_deg: 60.0 });
    let road = line(&[(0.0, -100.0), (0.0, 100.0)], 4.0);
    let frame =
        draw(scene((32, 32), camera, vec![road], Settings::default()), posts(33, 8.0, |_, _| 0.0), 32);
    assert_eq!(*frame.image.at(16, 0), [0, 0, 255, 255], "sky");
    assert_eq!(refused(&frame), 32, "the last row of terrain under the sky has no quadrilateral");
    assert_eq!(*frame.image.at(16, 31), [0, 0, 0, 255], "the road in front of the eye");
    for p in frame.planes.iter().flat_map(|p| match &p.values {
        Values::F64(v) if p.name == "color" => v.clone(),
        _ => Vec::new(),
    }) {
        assert!(p.is_finite());
    }
}

/// How many pixels had no meaningful quadrilateral.
fn refused(frame: &Frame) -> u64 {
    frame.counts.iter().find(|(name, _)| *name == "refused").unwrap().1
}

#[test]
fn true_corners_are_refused_where_one_sees_the_sky_and_the_centre_does_not() {
    // Straight down on a square of terrain; the picture's pixels of a metre stand out by 8 on each side, and the rim cuts the outermost
    // ones at `rim` of their width.
    for (rim, by_corners, by_centres) in [(0.75, 4 * 17 - 4, 2 * 17 - 1), (0.25, 0, 2 * 15 - 1)] {
        let half = 7.5 + rim;
        let by = |corners| {
            let down = camera([0.0, 0.0, 100.0], [0.0; 3], Projection::Orthographic { height_m: 33.0 });
            let settings = Settings { corners, ..Settings::default() };
            refused(&draw(scene((33, 33), down, Vec::new(), settings), posts(5, half / 2.0, |_, _| 0.0), 32))
        };
        assert_eq!(by(Corners::True), by_corners, "{rim}: all four sides' pixels");
        assert_eq!(
            by(Settings::default().corners),
            by_centres,
            "{rim}: those with no neighbour to the right or above"
        );
    }
}

#[test]
fn quadrilaterals_over_a_silhouette_are_refused_where_edges_are_near_and_slivers_are_not() {
    // A plain that falls by 40 m, seen from above the fall: a row of pixels reaches from its edge to the ground far behind it.
    let fall = |y: f64| if y < 0.0 { 40.0 } else { 0.0 };
    // One that climbs, seen from before it: its quadrilaterals are slivers, and are what the pixels see.
    let climb = |y: f64| if y < 40.0 { 0.0 } else { 40.0 };
    let down = camera([0.0, -60.0, 70.0], [0.0, 120.0, 0.0], Projection::Perspective { fov_y_deg: 30.0 });
    let across = |y: f64| vec![line(&[(-900.0, y), (900.0, y)], 16.0)];
    let by = |silhouette, layers: Vec<Layer>, height: &dyn Fn(f64) -> f64| {
        let settings = Settings { silhouette, ..Settings::default() };
        refused(&draw(scene((64, 64), down, layers, settings), posts(257, 8.0, |_, y| height(y)), 32))
    };
    assert_eq!(by(Silhouette::Centre, across(40.0), &fall), 64, "the line lies hidden behind the fall");
    assert_eq!(by(Silhouette::Centre, across(-600.0), &fall), 0, "no edge is near the fall");
    assert_eq!(by(Silhouette::Centre, Vec::new(), &fall), 0, "there is no edge");
    assert_eq!(by(Silhouette::Smear, across(40.0), &fall), 0, "the paper's quadrilateral is meant");
    assert_eq!(by(Silhouette::Centre, across(36.0), &climb), 0, "a steep face is no silhouette");
}

#[test]
fn a_silhouette_is_refused_and_not_smeared() {
    // Two plains 40 m apart in height, seen along their common edge: neighbouring pixels are hundreds of metres apart.
    let cliff = |y: f64| if y < 0.0 { 40.0 } else { 0.0 };
    let camera = camera([0.0, -60.0, 70.0], [0.0, 300.0, 0.0], Projection::Perspective { fov_y_deg: 50.0 });
    let across = line(&[(-500.0, 40.0), (500.0, 40.0)], 16.0);
    let settings = |silhouette| Settings { samples: 5, silhouette, ..Settings::default() };
    let by = |silhouette| {
        draw(
            scene((64, 64), camera, vec![across.clone()], settings(silhouette)),
            posts(129, 8.0, |_, y| cliff(y)),
            32,
        )
    };
    let (centre, smear) = (by(Silhouette::Centre), by(Silhouette::Smear));
    // The line lies hidden behind the cliff's edge.
    assert!(centre.image.values().iter().all(|p| p[0] == 255 || p[2] == 255), "nothing of it is seen");
    assert!(smear.image.values().iter().any(|p| p[0] < 255 && p[2] < 255), "the paper's smear shows it");
}

#[test]
fn every_buffer_has_the_same_bits_for_any_tiles_and_threads() {
    let bumps = |x: f64, y: f64| ((x / 7.0).floor() * 3.0 + (y / 5.0).floor() * 7.0).rem_euclid(11.0);
    let road = line(&[(-60.0, -50.0), (-20.0, 30.0), (10.0, -40.0), (50.0, 60.0)], 3.0);
    let lake = polygon(&[&[(-30.0, 0.0), (30.0, -10.0), (20.0, 40.0)]]);
    let camera = camera([20.0, -120.0, 80.0], [0.0; 3], Projection::Perspective { fov_y_deg: 45.0 });
    let run = |tile, threads| {
        let scene = scene((120, 90), camera, vec![lake.clone(), road.clone()], Settings::default());
        let surface = posts(41, 4.0, bumps);
        drapery::parallel::with_threads(threads, || {
            let frame = draw(scene, surface, tile);
            let mut hashes = vec![frame.image.hash()];
            hashes.extend(frame.planes.iter().map(Plane::hash));
            hashes
        })
        .unwrap()
    };
    let reference = run(128, 1);
    for (tile, threads) in [(16, 1), (37, 2), (64, 3), (128, 7), (512, 16)] {
        assert_eq!(run(tile, threads), reference, "tiles of {tile}, {threads} threads");
    }
}

#[test]
fn an_edge_that_begins_far_outside_the_terrain_keeps_its_inside() {
    // The middle of the polygon's long western edge lies beyond the terrain (which ends at 16 m).
    let polygon = || polygon(&[&[(-3.3, -900.0), (2.1, 30.0), (400.0, 30.0), (400.0, -900.0)]]);
    let by = |point_in_polygon| nadir(16, vec![polygon()], Settings { point_in_polygon, ..exact() });
    assert_eq!(by(PointInPolygon::EdgeNormals).image, by(PointInPolygon::Winding).image);
}
