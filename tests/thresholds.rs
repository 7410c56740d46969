//! Values at which a picture changes, from both sides and two in a hundred away, in the truth and in every technique: miter limits,
//! near and far planes; and hillshade's code values. What is right is a closed form of `docs/semantics.md`'s definitions.
#![cfg(feature = "render")]

mod drawing;

use drapery::math;
use drapery::resolve::code_values;
use drapery::scene::{
    Cap, Color, Feature, Join, Layer, Light, Line, Posts, Projection, Scene, Shape, Style, Surface, Width,
};
use drapery::space::{Plan, World};
use drapery::stage::Stage;
use drapery::technique::Kind;
use drapery::technique::clipmap::{self, Joints, Overlaps, PolygonRaster};
use drapery::technique::inverse_projection;
use drapery::technique::static_decal;
use drapery::technique::stencil_volume::{self, VolumeJoins};
use drapery::truth::{Budget, Truth, certify};
use drawing::{frame_of, kinds_of_footprints_for, loaded};
use glam::{DVec2, DVec3};

const BLACK: Color = Color([0.0, 0.0, 0.0, 1.0]);

/// A scene without layers, seen from straight above through 64 x 64 pixels of 4 m each; the ground is white, the sky blue.
fn map() -> Scene {
    let text = "schema = 1\nimage = { width = 64, height = 64, background = \"#0000ff\" }\n\
                terrain = { generate = { kind = \"plane\", posts = [3, 3], cell_m = 10.0 }, color = \"#ffffff\" }\n\
                camera = { eye = [0, 0, 500], target = [0, 0, 0], up = [0, 1, 0], projection = \"orthographic\", \
                height_m = 256 }";
    let mut scene = loaded(text, &[]).0;
    scene.technique.set(clipmap::Settings {
        virtual_size: 1024,
        joints: Joints::Style,
        polygons: PolygonRaster::Exact,
        overlaps: Overlaps::Once,
        ..Default::default()
    });
    scene.technique.set(inverse_projection::Settings::default());
    scene.technique.set(stencil_volume::Settings { joins: VolumeJoins::Style, ..Default::default() });
    // The others look at pixels' centres alone.
    scene.technique.set(static_decal::Settings { samples: 1, ..Default::default() });
    scene
}

/// A ground of this height around the origin.
fn ground(cell: f64, height: impl Fn(f64, f64) -> f64) -> Surface {
    let at = |k: usize| cell * (k as f64 - 4.0);
    let heights = (0..81).map(|k| height(at(k % 9), at(k / 9))).collect();
    let steps = (DVec2::X * cell, DVec2::Y * cell);
    Surface::Grid(Posts::new((9, 9), Plan::new(at(0), at(0)), steps, heights).unwrap())
}

/// The truth, as narrow as the work allows.
fn truth_of(stage: &Stage) -> Truth {
    certify(stage, &stage.view().unwrap(), &Budget::new(1e-7, 14).unwrap(), &|_| {})
}

/// Whether the truth surely has a pixel black, or surely not.
#[track_caller]
fn is_black(truth: &Truth, (x, y): (usize, usize)) -> bool {
    let (low, high) = (truth.low.at(x, y)[0], truth.high.at(x, y)[0]);
    assert!(high < 1e-6 || low > 1.0 - 1e-6, "[{low}, {high}]: the pixel is on a border");
    high < 0.5
}

/// The pixel of [`map`] at a plan point.
fn pixel(p: DVec2) -> (usize, usize) {
    ((p.x / 4.0 + 32.0) as usize, (32.0 - p.y / 4.0) as usize)
}

/// A line that turns by an angle at the origin, 120 m wide, and a point of the kite between its bevel and the tip of its miter.
fn corner(turn: f64, is_left: bool, join: Join) -> (Layer, DVec2) {
    // At no angle to the pixels that would be special.
    let into = DVec2::new(math::cos(0.3), math::sin(0.3));
    let turn = if is_left { turn } else { -turn };
    let out = DVec2::new(math::cos(0.3 + turn), math::sin(0.3 + turn));
    let points = [into * -300.0, DVec2::ZERO, out * 300.0].map(Plan::from).to_vec();
    let width = Width::Metres(2.0 * HALF);
    let line = Line { color: BLACK, width, join, cap: Cap::Butt };
    let style = Style { line: Some(line), ..Style::default() };
    let feature = Feature { index: 0, style: 0, shape: Shape::Line(vec![points]) };
    let (bevel, tip) = (HALF * math::cos(turn / 2.0), HALF / math::cos(turn / 2.0));
    (Layer::uniform("corner", style, vec![feature]), (into - out).normalize() * (bevel + 0.3 * (tip - bevel)))
}

/// Half the width of [`corner`]'s line, metres.
const HALF: f64 = 60.0;

/// The turn whose miter is so many widths long.
fn turn_of(ratio: f64) -> f64 {
    2.0 * math::atan((ratio * ratio - 1.0).sqrt())
}

#[test]
fn a_corner_is_mitred_up_to_its_limit_and_bevelled_beyond_it() {
    for ratio in [1.17, 1.5, 2.5, 4.0] {
        for (is_left, share) in [(true, 1.02), (false, 1.02), (true, 0.98), (false, 0.98)] {
            let join = Join::Miter { limit: ratio * share };
            let (layer, kite) = corner(turn_of(ratio), is_left, join);
            let mut scene = map();
            scene.layers = vec![layer];
            let stage = Stage::new(scene, ground(80.0, |_, _| 0.0)).unwrap();
            let (what, at) = (format!("ratio {ratio}, limit {share} of it, left: {is_left}"), pixel(kite));
            assert_eq!(is_black(&truth_of(&stage), at), share > 1.0, "{what}");
            // Inverse projection has its own rule.
            for kind in [Kind::Clipmap, Kind::StencilVolume] {
                // The texture's filter reaches a little over the border.
                let seen = frame_of(kind, &stage, &[]).image.at(at.0, at.1)[0];
                assert_eq!(seen < 8, share > 1.0, "{}: {what}: {seen}", kind.name());
                assert!(!(8..=247).contains(&seen), "{}: {what}: {seen}", kind.name());
            }
        }
    }
}

#[test]
fn inverse_projection_cuts_corners_off_that_reach_farther_than_ten_half_widths() {
    for (is_left, ratio) in [(true, 9.8), (false, 9.8), (true, 10.2), (false, 10.2)] {
        // The line's own join is not asked.
        for join in [Join::Bevel, Join::Miter { limit: 100.0 }] {
            let (mut layer, kite) = corner(turn_of(ratio), is_left, join);
            layer.styles[0].line.as_mut().unwrap().width = Width::Metres(HALF / 3.0);
            let mut scene = map();
            scene.layers = vec![layer];
            let stage = Stage::new(scene, ground(80.0, |_, _| 0.0)).unwrap();
            let at = pixel(kite / 6.0);
            let seen = frame_of(Kind::InverseProjection, &stage, &[]).image.at(at.0, at.1)[0];
            assert_eq!(seen, if ratio < 10.0 { 0 } else { 255 }, "ratio {ratio}, left: {is_left}, {join:?}");
        }
    }
}

/// Checks that each column shows ground from one height of the picture down to another and sky elsewhere, in pixels from the top.
fn check_band(stage: &Stage, (top, bottom): (f64, f64), what: &str) {
    let truth = truth_of(stage);
    let (width, height) = (truth.low.width(), truth.low.height());
    for x in [0, width / 3, width - 1] {
        // The sky has no red.
        let sum =
            |bound: &drapery::buffer::Buffer<[f64; 4]>| (0..height).map(|y| bound.at(x, y)[0]).sum::<f64>();
        let (low, high) = (sum(&truth.low), sum(&truth.high));
        assert!(
            low - 1e-6 <= bottom - top && bottom - top <= high + 1e-6 && high - low < 1e-4,
            "{what}, the truth: {} pixels of ground are not in [{low}, {high}]",
            bottom - top
        );
    }
    // Who goes by areas is with the truth.
    for kind in kinds_of_footprints_for(stage).into_iter().filter(|kind| *kind != Kind::Analytic) {
        let image = frame_of(kind, stage, &[]).image;
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let is_ground = (top..bottom).contains(&(y as f64 + 0.5));
            let right = if is_ground { [255, 255, 255, 255] } else { [0, 0, 255, 255] };
            assert_eq!(*image.at(x, y), right, "{what}, {}: pixel {x}, {y}", kind.name());
        }
    }
}

#[test]
fn a_level_view_shows_a_plain_between_the_near_and_the_far_plane() {
    let mut scene = map();
    scene.image.height = 256;
    let camera = &mut scene.camera;
    (camera.eye, camera.target, camera.up) =
        (World::new(0.0, 0.0, 100.0), World::new(0.0, 900.0, 100.0), DVec3::Z);
    camera.projection = Projection::Perspective { fov_y_deg: 60.0 };
    let focal = 128.0 / math::tan(30f64.to_radians());
    let row_at = |depth: f64| 128.0 + focal * 100.0 / depth;
    for (near, far) in [(180.3, Some(222.2)), (180.3, Some(226.6)), (183.9, Some(222.2)), (178.1, None)] {
        (scene.camera.near_m, scene.camera.far_m) = (near, far);
        let stage = Stage::new(scene.clone(), ground(2500.0, |_, _| 0.0)).unwrap();
        // Without a far plane the terrain ends 10 km away.
        let band = (row_at(far.unwrap_or(10_000.0)), row_at(near));
        check_band(&stage, band, &format!("near {near}, far {far:?}"));
    }
}

#[test]
fn a_map_shows_a_slope_between_the_near_and_the_far_plane() {
    // The depth grows from north to south: 500 m less the height.
    for (near, far) in [(450.0, Some(560.0)), (441.1, Some(560.0)), (450.0, Some(548.9)), (1.0, Some(560.0))]
    {
        let mut scene = map();
        (scene.camera.near_m, scene.camera.far_m) = (near, far);
        let stage = Stage::new(scene, ground(80.0, |_, y| y)).unwrap();
        let row_at = |depth: f64| 32.0 - (500.0 - depth) / 4.0;
        let band = (math::max(row_at(near), 0.0), far.map_or(64.0, row_at));
        check_band(&stage, band, &format!("near {near}, far {far:?}"));
    }
}

#[test]
fn hillshade_is_lamberts_cosine_to_the_code_value() {
    let lights = [(315.0, 45.0), (0.0, 30.0), (120.0, 20.0), (250.0, 60.0), (77.0, 5.0), (0.0, 90.0)];
    for (azimuth_deg, elevation_deg) in lights {
        for slope in [DVec2::ZERO, DVec2::new(0.4, -0.25), DVec2::new(-1.0, 0.5), DVec2::new(0.1, 2.0)] {
            let mut scene = map();
            scene.ground.light = Some(Light { azimuth_deg, elevation_deg });
            let stage = Stage::new(scene, ground(80.0, |x, y| slope.dot(DVec2::new(x, y)))).unwrap();
            let (azimuth, elevation) = (f64::to_radians(azimuth_deg), f64::to_radians(elevation_deg));
            // How much of the light meets a square metre of the slope.
            let level = math::cos(elevation);
            let met =
                math::sin(elevation) - level * (slope.x * math::sin(azimuth) + slope.y * math::cos(azimuth));
            let light = math::max(met / (1.0 + slope.length_squared()).sqrt(), 0.0);
            let what = format!("light {azimuth_deg}, {elevation_deg}, slope {slope}");
            let truth = truth_of(&stage);
            let right = code_values([light, light, light, 1.0]);
            for (x, y) in [(0, 0), (31, 32), (63, 5)] {
                let (low, high) = (truth.low.at(x, y)[0], truth.high.at(x, y)[0]);
                assert!(
                    low - 1e-9 <= light && light <= high + 1e-9 && high - low < 1e-6,
                    "{what}, the truth: {light} is not in [{low}, {high}]"
                );
                for kind in kinds_of_footprints_for(&stage) {
                    let seen = *frame_of(kind, &stage, &[]).image.at(x, y);
                    assert_eq!(seen, right, "{what}, {}", kind.name());
                }
            }
        }
    }
}
