//! Dynamic lines (Zechmeister 2020, chapters 3 and 4) against the footprint by definition, and the thesis's failures on request.
#![cfg(feature = "render")]

mod drawing;

use drapery::buffer::Values;
use drapery::scene::{Cap, Color, Feature, Join, Layer, Line, Shape, Style, Width};
use drapery::scene_file::{Override, SceneFile};
use drapery::space::{Plan, Screen, ViewFrame};
use drapery::stage::Stage;
use drapery::technique::dynamic_line::{Step, Verdict};
use drapery::technique::{self, Frame, FrameOptions, Kind, dynamic_line};
use drapery::{parallel, sampling};
use drawing::{count, errors, frame_of, loaded, scene, stage, truth_of};

const HILLS: &str = "kind = \"fbm\", seed = 7, posts = [33, 33], cell_m = 20, height_m = 160";
const FLAT: &str = "kind = \"plane\", posts = [33, 33], cell_m = 20";

/// From the south, over the hills; straight down in perspective; a map.
const OBLIQUE: &str = "eye = [-60, -520, 330], target = [0, 0, 40]";
const ABOVE: &str = "eye = [0, 0, 520], target = [0, 0, 0], up = [0, 1, 0]";
const MAP: &str =
    "eye = [0, 0, 500], target = [0, 0, 0], up = [0, 1, 0], projection = \"orthographic\", height_m = 400";
const SLANTED_MAP: &str =
    "eye = [-200, -300, 400], target = [0, 0, 40], projection = \"orthographic\", height_m = 360";
const VIEWS: [&str; 4] = [OBLIQUE, ABOVE, MAP, SLANTED_MAP];

/// Straight runs, an acute turn, a loop, a line that ends off the picture, one along the terrain's border, a ring, a dot; with an opacity as a whole.
const LINES: &str = r##"
[[layer]]
features = [
  { line = [[-250, -150], [-60, 120], [80, -120], [95, 110], [240, 90], [900, 300]] },
  { line = [[-100, -60], [100, -60], [60, 60], [-100, -60]] },
  { line = [[-318, 310], [318, 310]] },
]
line = { color = "#aa0022", width_px = WIDTH, opacity = 0.6 }
[[layer]]
opacity = 0.5
features = [{ polygon = [[-200, 0], [0, -30], [20, 140], [-150, 160]] }, { polygon = [[-40, 20], [180, 10], [150, 150]] }]
outline = { color = "#004488", width_px = WIDTH }
[[layer]]
features = [{ points = [[30, -150], [-150, -100]] }]
point = { color = "#226600", width_px = 9.0 }
"##;

fn lines(width: f64) -> String {
    LINES.replace("WIDTH", &format!("{width:.3}"))
}

/// Settings under which the lines of a picture are the footprint by definition, and no colour is smoothed.
const EXACT: [&str; 5] = [
    "technique.dynamic-line.simplification=none",
    "technique.dynamic-line.culling=boxes",
    "technique.dynamic-line.boxes=enclosing",
    "technique.dynamic-line.thin_lines=none",
    "technique.dynamic-line.antialiasing=none",
];

/// The thesis's geometry, not smoothed.
const PLAIN: [&str; 3] = [
    "technique.dynamic-line.simplification=none",
    "technique.dynamic-line.thin_lines=none",
    "technique.dynamic-line.antialiasing=none",
];

fn with<'a>(changes: &[&'a str], more: &[&'a str]) -> Vec<&'a str> {
    changes.iter().chain(more).copied().collect()
}

fn draw(text: &str, changes: &[&str], buffers: &[&str]) -> Frame {
    frame_of(Kind::DynamicLine, &stage(text, changes), buffers)
}

fn counts_of(frame: &Frame, name: &str) -> Vec<u32> {
    match &frame.planes.iter().find(|plane| plane.name == name).unwrap().values {
        Values::U32(values) => values.clone(),
        other => panic!("{name} holds {other:?}"),
    }
}

fn doubles(frame: &Frame, name: &str) -> Vec<f64> {
    match &frame.planes.iter().find(|plane| plane.name == name).unwrap().values {
        Values::F64(values) => values.clone(),
        other => panic!("{name} holds {other:?}"),
    }
}

/// Whether the footprint of polylines, by definition, holds the centre of each pixel: the distance in the plan of its surface point from the nearest
/// segment is at most half the width times a pixel's size at the point's distance from the eye.
fn footprint(frame: &Frame, view: &ViewFrame, paths: &[Vec<Plan>], width: f64) -> Vec<bool> {
    let (plan, depth) = (doubles(frame, "plan"), doubles(frame, "depth"));
    let is_held = |k: usize| {
        let at = Plan::new(plan[2 * k], plan[2 * k + 1]);
        if !at.is_finite() {
            return false;
        }
        let ray = view.ray(Screen::new((k % view.width()) as f64 + 0.5, (k / view.width()) as f64 + 0.5));
        let eye_to_point = depth[k] * ((ray.through - ray.from) / view.reach()).length();
        let pixel = match view.lens() {
            drapery::space::Lens::Central { pixel } => pixel * eye_to_point,
            drapery::space::Lens::Parallel { pixel } => pixel,
        };
        let distance = |pair: &[Plan]| {
            let (along, from) = (pair[1] - pair[0], at - pair[0]);
            let t = (from.dot(along) / along.length_squared()).clamp(0.0, 1.0);
            (from - along * t).length()
        };
        paths.iter().flat_map(|path| path.windows(2)).any(|pair| distance(pair) <= width / 2.0 * pixel)
    };
    (0..depth.len()).map(is_held).collect()
}

fn path(points: &[[f64; 2]]) -> Vec<Plan> {
    points.iter().map(|[x, y]| Plan::new(*x, *y)).collect()
}

fn line_layer(points: &[[f64; 2]], width: f64) -> String {
    format!(
        "[[layer]]\nfeatures = [{{ line = {points:?} }}]\nline = {{ color = \"#000000\", width_px = {width:.3} }}\n"
    )
}

/// How many pixels a line of one path misses of its footprint, has too much, and has.
fn missing_extra_covered(
    (terrain, camera): (&str, &str),
    points: &[[f64; 2]],
    width: f64,
    changes: &[&str],
) -> [usize; 3] {
    let stage = stage(&scene(terrain, camera, &line_layer(points, width)), changes);
    let frame = frame_of(Kind::DynamicLine, &stage, &["plan", "depth", "list-length"]);
    let held = footprint(&frame, &stage.view().unwrap(), &[path(points)], width);
    let lengths = counts_of(&frame, "list-length");
    let differ =
        |is: bool| held.iter().zip(&lengths).filter(|(held, n)| **held == is && (**n > 0) != is).count();
    [differ(true), differ(false), lengths.iter().filter(|n| **n > 0).count()]
}

const TURNS: [[f64; 2]; 7] = [
    [-250.0, -150.0],
    [-60.0, 120.0],
    [80.0, -120.0],
    [95.0, 110.0],
    [240.0, 90.0],
    [200.0, 0.0],
    [900.0, 300.0],
];

// ---- The footprint ----

#[test]
fn every_pixel_is_covered_exactly_where_the_footprint_holds_its_centre() {
    for view in VIEWS {
        for (width, more) in [
            (1.0, &[][..]),
            (6.0, &[]),
            (40.0, &[]),
            (6.0, &["technique.dynamic-line.l_max=1e9"]),
            (6.0, &["technique.dynamic-line.l_max=3"]),
        ] {
            let [missing, extra, covered] =
                missing_extra_covered((HILLS, view), &TURNS, width, &with(&EXACT, more));
            assert_eq!([missing, extra], [0, 0], "{view}, {width}, {more:?}");
            assert!(covered > 60, "{covered}");
        }
    }
}

#[test]
fn mitred_boxes_have_the_footprint_of_a_line_that_is_thin_beside_its_parts() {
    for view in VIEWS {
        let changes = with(&PLAIN, &["technique.dynamic-line.culling=boxes"]);
        let [missing, extra, _] = missing_extra_covered((HILLS, view), &TURNS, 3.0, &changes);
        assert_eq!([missing, extra], [0, 0], "{view}");
    }
}

#[test]
fn composed_colours_are_those_of_point_samples_of_the_items() {
    for view in VIEWS {
        for more in [&[][..], &["compositing.space=linear"], &["compositing.mode=additive"]] {
            let stage = stage(&scene(HILLS, view, &lines(7.0)), &with(&EXACT, more));
            let frame = frame_of(Kind::DynamicLine, &stage, &["color"]);
            let sampled = sampling::sample(&stage, &stage.view().unwrap(), 1, &|_| {});
            let colors = doubles(&frame, "color");
            let off = sampled.colors.values().as_flattened().iter().zip(&colors);
            let off = off.fold(0.0f64, |most, (a, b)| drapery::math::max((a - b).abs(), most));
            assert!(off < 1e-12, "{view} {more:?}: {off}");
        }
    }
}

/// Fills, an inverted one, inset outlines and roads in metres, above and below lines in pixels.
const MIXED: &str = r##"
[[layer]]
features = [{ polygon = [[-280, -200], [280, -180], [250, 240], [-270, 200]] }]
fill = { color = "#88aa44", opacity = 0.4, invert = true }
[[layer]]
opacity = 0.7
features = [
  { polygon = [[-200, 0], [0, -30], [20, 140], [-150, 160]] },
  { polygon = [[-40, 20], [180, 10], [150, 150]] },
  { line = [[-250, -100], [250, 60]] },
]
fill = { color = "#ccaa55", opacity = 0.8 }
outline = { color = "#004488", width_px = 5.0 }
line = { color = "#444444", width_m = 40.0, join = "round" }
[[layer]]
features = [{ line = [[-250, 200], [-60, -120], [80, 120], [240, -90]] }]
line = { color = "#aa0022", width_px = 9.0 }
[[layer]]
features = [{ polygon = [[-100, -150], [120, -140], [60, 100]] }]
fill = { color = "#2266ee", opacity = 0.5 }
outline = { color = "#221166", width_m = 30.0, mode = "inset", join = "round" }
"##;

#[test]
fn static_decals_and_dynamic_lines_are_composed_in_the_order_that_they_share() {
    let as_defined = ["technique.static-decal.joins=style", "technique.static-decal.outlines=polygon"];
    for view in VIEWS {
        let stage = stage(&scene(HILLS, view, MIXED), &with(&EXACT, &as_defined));
        let frame = frame_of(Kind::DynamicLine, &stage, &["color"]);
        let sampled = sampling::sample(&stage, &stage.view().unwrap(), 1, &|_| {});
        let colors = doubles(&frame, "color");
        let off = sampled.colors.values().as_flattened().iter().zip(&colors);
        let off = off.fold(0.0f64, |most, (a, b)| drapery::math::max((a - b).abs(), most));
        assert!(off < 1e-12, "{view}: {off}");
    }
    // With analytic edges, of both kinds, it is nearer to the truth than with one sample.
    let rmse = |how: &str| {
        let how = format!("technique.dynamic-line.antialiasing={how}");
        let changes = [&EXACT[..4], &as_defined, &[how.as_str()]].concat();
        let stage = stage(&scene(FLAT, MAP, MIXED), &changes);
        let image = frame_of(Kind::DynamicLine, &stage, &[]).image;
        errors(&truth_of(&stage), &drapery::compare::Image::from_rgba8(&image).unwrap()).rmse
    };
    let [none, analytic] = ["none", "analytic"].map(rmse);
    assert!(analytic < 0.5 * none, "{analytic} {none}");
}

#[test]
fn an_outline_in_pixels_that_is_inset_is_refused() {
    let text = scene(FLAT, MAP, &lines(3.0).replace("outline = {", "outline = { mode = \"inset\","));
    let said = refusal(&text, &[]);
    assert!(said.contains("inset or offset") && said.contains("layer"), "{said}");
}

// ---- Where the thesis's geometry does not cover it ----

#[test]
fn culling_by_vertices_loses_a_segment_that_passes_the_picture_between_its_vertices() {
    let far = [[-900.0, 3.0], [900.0, 3.0]];
    let changes = with(&PLAIN, &["technique.dynamic-line.l_max=1e9"]);
    let [missing, _, covered] = missing_extra_covered((FLAT, MAP), &far, 5.0, &changes);
    assert!(missing > 400 && covered == 0, "{missing} {covered}");
    let changes = with(&changes, &["technique.dynamic-line.culling=boxes"]);
    assert_eq!(missing_extra_covered((FLAT, MAP), &far, 5.0, &changes)[..2], [0, 0]);
    // Parts of half a cell each have a vertex in the picture, but for those at its border.
    assert!(missing_extra_covered((FLAT, MAP), &far, 5.0, &PLAIN)[0] < 10);
}

#[test]
fn the_box_of_the_farther_vertex_is_too_narrow_for_what_lies_still_farther() {
    let changes = with(&PLAIN, &["technique.dynamic-line.culling=boxes"]);
    let aside = [[-400.0, 40.0], [400.0, 110.0]];
    let [missing, extra, _] = missing_extra_covered((FLAT, ABOVE), &aside, 24.0, &changes);
    assert!(missing > 0 && extra == 0, "{missing}");
    let changes = with(&changes, &["technique.dynamic-line.boxes=enclosing"]);
    assert_eq!(missing_extra_covered((FLAT, ABOVE), &aside, 24.0, &changes)[..2], [0, 0]);
}

#[test]
fn mitres_of_acute_turns_lose_what_is_nearer_to_another_segment() {
    let acute: Vec<[f64; 2]> =
        (0..40).map(|k| [f64::from(k) * 6.0 - 120.0, f64::from(k % 2) * 10.0]).collect();
    let changes = with(&PLAIN, &["technique.dynamic-line.culling=boxes"]);
    let [missing, extra, _] = missing_extra_covered((FLAT, MAP), &acute, 9.0, &changes);
    assert_eq!(extra, 0);
    println!("{missing}");
    let changes = with(&changes, &["technique.dynamic-line.boxes=overlapping"]);
    assert_eq!(missing_extra_covered((FLAT, MAP), &acute, 9.0, &changes)[..2], [0, 0]);
}

#[test]
fn a_line_within_a_pixel_vanishes_however_wide_it_is_drawn() {
    let tiny = [[3.2, 3.2], [4.1, 3.4], [4.4, 4.2]];
    let frame = |how: &str| {
        let how = format!("technique.dynamic-line.simplification={how}");
        let changes = [PLAIN[1], PLAIN[2], &how];
        draw(&scene(FLAT, MAP, &line_layer(&tiny, 6.0)), &changes, &["list-length"])
    };
    let covered = |frame: &Frame| counts_of(frame, "list-length").iter().filter(|n| **n > 0).count();
    let same_pixel = frame("same-pixel");
    assert_eq!((covered(&same_pixel), count(&same_pixel, "vanished")), (0, 1));
    for how in ["none", "screen-error"] {
        assert!(covered(&frame(how)) > 20, "{how}");
        assert_eq!(count(&frame(how), "vanished"), 0);
    }
}

#[test]
fn simplification_keeps_a_line_within_its_error_of_where_it_was() {
    // Steps of a third of a pixel on a curve: a map has one metre of height for each pixel of 400 / 64 m.
    let curve: Vec<[f64; 2]> = (0..400)
        .map(|k| {
            let x = f64::from(k) * 1.2 - 240.0;
            [x, 60.0 * (x / 90.0) * (1.0 - x * x / 60_000.0)]
        })
        .collect();
    let pixel = 400.0 / 64.0;
    for (how, error, segments) in [("same-pixel", 1.5, 150), ("screen-error", 0.5, 60)] {
        let changes = [
            "technique.dynamic-line.thin_lines=none",
            "technique.dynamic-line.antialiasing=none",
            &format!("technique.dynamic-line.simplification={how}"),
        ];
        let stage = stage(&scene(FLAT, MAP, &line_layer(&curve, 8.0)), &changes);
        let frame = frame_of(Kind::DynamicLine, &stage, &["plan", "depth", "list-length"]);
        let view = stage.view().unwrap();
        let lengths = counts_of(&frame, "list-length");
        // On a map, moving a line by so many pixels is to widen or to narrow it by twice as many.
        let (within, around) = (8.0 - 2.0 * error, 8.0 + 2.0 * error);
        let (least, most) = (
            footprint(&frame, &view, &[path(&curve)], within),
            footprint(&frame, &view, &[path(&curve)], around),
        );
        for k in 0..lengths.len() {
            assert!(!least[k] || lengths[k] > 0, "{how}: {k} is missing");
            assert!(most[k] || lengths[k] == 0, "{how}: {k} is too much");
        }
        let kept = count(&frame, "segments");
        assert!(kept < segments, "{how}: {kept} of {}, pixels of {pixel} m", count(&frame, "vertices"));
    }
}

// ---- The thesis's figures ----

/// Three wide lines that cross, of three colours, longest on top (Fig. 3.7).
const CROSSING: &str = r##"
[[layer]]
features = [
  { line = [[-200, -120], [200, 120]], properties = { color = "#00aa00" } },
  { line = [[-200, 120], [200, -120]], properties = { color = "#ff66cc" } },
  { line = [[-250, 0], [250, 10]], properties = { color = "#dd0000" } },
]
line = { color = { by = "color", map = { "#00aa00" = "#00aa00", "#ff66cc" = "#ff66cc", "#dd0000" = "#dd0000" } }, width_px = 16 }
"##;

#[test]
fn without_sorting_lines_lie_on_one_another_in_patches() {
    let text = scene(HILLS, OBLIQUE, CROSSING);
    let sorted = draw(&text, &PLAIN, &["list-length"]);
    let unsorted = draw(&text, &with(&PLAIN, &["technique.dynamic-line.sorting=none"]), &["list-length"]);
    let lengths = counts_of(&sorted, "list-length");
    assert_eq!(lengths, counts_of(&unsorted, "list-length"), "the lists hold the same");
    let differ: Vec<usize> =
        (0..lengths.len()).filter(|k| sorted.image.values()[*k] != unsorted.image.values()[*k]).collect();
    assert!(differ.len() > 20, "{}", differ.len());
    assert!(differ.iter().all(|k| lengths[*k] > 1), "only where lines lie on one another");
}

#[test]
fn overlaps_of_boxes_are_darker_where_each_segment_is_drawn() {
    // Fig. 4.4: a translucent line with turns. Black at half over white is grey; twice is darker.
    let text = scene(FLAT, OBLIQUE, &line_layer(&TURNS, 9.0).replace("width_px", "opacity = 0.5, width_px"));
    let darker = |changes: &[&str]| {
        let frame = draw(&text, &with(&PLAIN, changes), &[]);
        frame.image.values().iter().filter(|pixel| pixel[0] < 100 && pixel[2] < 100).count()
    };
    let double = "technique.dynamic-line.overlaps=double";
    let overlapping = darker(&[double, "technique.dynamic-line.boxes=overlapping"]);
    let mitred = darker(&[double]);
    assert_eq!(darker(&[]), 0, "each line once");
    assert!(0 < mitred && 2 * mitred < overlapping, "{mitred} {overlapping}");
}

/// Pixels of a row or column of a picture that a horizontal line covers: which columns have one.
fn columns_covered(frame: &Frame) -> Vec<bool> {
    let lengths = counts_of(frame, "list-length");
    (0..96).map(|x| (0..64).any(|y| lengths[y * 96 + x] > 0)).collect()
}

#[test]
fn thin_lines_are_dashed_and_corrected_in_top_down_views() {
    // Fig. 4.9: a line of a third of a pixel.
    let text = |camera| scene(FLAT, camera, &line_layer(&[[-290.0, -20.0], [290.0, 27.0]], 0.33));
    let covered = |camera, how: &str| {
        let how = format!("technique.dynamic-line.thin_lines={how}");
        let changes = [PLAIN[0], PLAIN[2], &how];
        columns_covered(&draw(&text(camera), &changes, &["list-length"])).iter().filter(|c| **c).count()
    };
    for camera in [MAP, ABOVE] {
        let dashed = covered(camera, "none");
        assert!(10 < dashed && dashed < 60, "{dashed}");
        assert!(covered(camera, "correction") >= 85, "{}", covered(camera, "correction"));
        assert!(covered(camera, "second-depth") >= 85);
    }
    assert!(covered(OBLIQUE, "none") < 60);
    assert_eq!(covered(OBLIQUE, "correction"), covered(OBLIQUE, "none"), "only from above (4.5)");
    assert!(covered(OBLIQUE, "second-depth") >= 70, "{}", covered(OBLIQUE, "second-depth"));
}

#[test]
fn a_thin_line_behind_a_hill_does_not_shine_through() {
    let hill = "kind = \"tent\", posts = [33, 33], cell_m = 20, height_m = 150";
    let camera = "eye = [0, -600, 60], target = [0, 0, 60]";
    for points in [[[-200.0, 120.0], [200.0, 120.0]], [[-120.0, 60.0], [200.0, 260.0]]] {
        let changes = [PLAIN[0], PLAIN[2], "technique.dynamic-line.thin_lines=second-depth"];
        let frame = draw(&scene(hill, camera, &line_layer(&points, 0.5)), &changes, &["list-length"]);
        let covered = counts_of(&frame, "list-length").iter().filter(|n| **n > 0).count();
        assert_eq!(covered, 0, "{points:?}");
        let front = points.map(|[x, y]| [x, -y]);
        let frame = draw(&scene(hill, camera, &line_layer(&front, 0.5)), &changes, &["list-length"]);
        assert!(counts_of(&frame, "list-length").iter().filter(|n| **n > 0).count() > 20, "before the hill");
    }
}

#[test]
fn the_filter_smooths_steps_and_analytic_edges_are_nearer_to_the_truth() {
    let text = scene(FLAT, MAP, &line_layer(&TURNS[..5], 8.0));
    let rmse = |how: &str| {
        let how = format!("technique.dynamic-line.antialiasing={how}");
        let stage = stage(&text, &[EXACT[0], EXACT[1], EXACT[2], EXACT[3], &how]);
        let image = frame_of(Kind::DynamicLine, &stage, &[]).image;
        errors(&truth_of(&stage), &drapery::compare::Image::from_rgba8(&image).unwrap()).rmse
    };
    let [none, fxaa, analytic] = ["none", "fxaa", "analytic"].map(rmse);
    assert!(fxaa < none, "{fxaa} {none}");
    assert!(analytic < 0.5 * fxaa, "{analytic} {fxaa}");
}

#[test]
fn corners_are_round_mitred_or_bevelled() {
    // A right angle on a map: what lies in its outer corner.
    let angle = [[-100.0, -100.0], [50.0, -100.0], [50.0, 100.0]];
    let covered = |join: &str, cap: &str| {
        let layer = line_layer(&angle, 12.0)
            .replace("width_px", &format!("join = \"{join}\", cap = \"{cap}\", width_px"));
        let changes = with(&PLAIN, &["technique.dynamic-line.corners=style"]);
        let frame = draw(&scene(FLAT, MAP, &layer), &changes, &["list-length"]);
        counts_of(&frame, "list-length").iter().filter(|n| **n > 0).count() as f64
    };
    // In pixels: two runs of 24 and 32 pixels, 12 wide, that share a square.
    let corner = |join: &str| covered(join, "butt");
    let [bevel, round, miter] = ["bevel", "round", "miter"].map(corner);
    let near = |found: f64, right: f64| assert!((found - right).abs() <= 6.0, "{found} {right}");
    near(miter - bevel, 18.0);
    near(round - bevel, 36.0 * (std::f64::consts::FRAC_PI_4 - 0.5));
    near(covered("miter", "square") - miter, 2.0 * 6.0 * 12.0);
    near(covered("miter", "round") - miter, std::f64::consts::PI * 36.0);
}

// ---- Determinism ----

fn hashes(stage: &Stage, tile: usize, threads: usize) -> Vec<String> {
    let run = || {
        let prepared = technique::prepare(Kind::DynamicLine, stage).unwrap();
        let buffers = Kind::DynamicLine.buffer_names();
        let options = FrameOptions { tile, buffers: &buffers, progress: &|_| {} };
        // The second frame finds what the first one matched.
        [(); 2].map(|()| {
            let frame = prepared.frame(&stage.view().unwrap(), &options).unwrap();
            let mut hashes = vec![frame.image.hash(), format!("{:?}", frame.counts)];
            hashes.extend(frame.planes.iter().map(|plane| plane.hash()));
            hashes
        })
    };
    let [first, second] = parallel::with_threads(threads, run).unwrap();
    assert_eq!(first, second);
    first
}

#[test]
fn neither_tiles_nor_threads_nor_preparation_change_a_bit() {
    for more in [
        &[][..],
        &[
            "technique.dynamic-line.simplification=screen-error",
            "technique.dynamic-line.thin_lines=second-depth",
        ],
        &["technique.dynamic-line.antialiasing=analytic", "technique.dynamic-line.sorting=none"],
    ] {
        let text = scene(HILLS, OBLIQUE, &lines(4.0));
        let whole = with(more, &["technique.dynamic-line.preparation=whole"]);
        // The numbers of triangles that a tile draws follow the tiles.
        let own = |hashes: Vec<String>| -> Vec<String> {
            hashes.into_iter().map(|h| h.split("(\"triangles_drawn").next().unwrap().to_owned()).collect()
        };
        let here = own(hashes(&stage(&text, more), 128, 1));
        for (tile, threads) in [(7, 3), (64, 2), (1, 1)] {
            assert_eq!(own(hashes(&stage(&text, more), tile, threads)), here, "{tile} {threads}");
        }
        assert_eq!(own(hashes(&stage(&text, &whole), 128, 2)), here);
    }
}

#[test]
fn single_precision_draws_nearly_the_same() {
    for view in VIEWS {
        let text = scene(HILLS, view, &lines(5.0));
        let exact = draw(&text, &PLAIN, &[]);
        let single = draw(&text, &with(&PLAIN, &["device.precision=f32"]), &[]);
        let differ = exact.image.values().iter().zip(single.image.values()).filter(|(a, b)| a != b).count();
        assert!(differ < 20, "{view}: {differ}");
    }
}

// ---- Explanation ----

#[test]
fn a_pixel_is_explained_by_the_segments_whose_boxes_cover_it() {
    let stage = stage(&scene(FLAT, MAP, &line_layer(&[[-200.0, 3.0], [200.0, 3.0]], 4.0)), &PLAIN);
    let prepared = dynamic_line::Prepare::new(&stage).unwrap();
    let (steps, code) = prepared.steps_of(&stage.view().unwrap(), [48, 31]).unwrap();
    assert_eq!(code, [0, 0, 0, 255]);
    let is_in = |step: &Step| matches!(step, Step::Tested { item: 0, verdict: Verdict::Inside(share), .. } if *share == 1.0);
    assert!(steps.iter().any(is_in), "{steps:#?}");
    assert!(steps.contains(&Step::Composed(vec![(0, 1.0)])));
    let (steps, code) = prepared.steps_of(&stage.view().unwrap(), [48, 3]).unwrap();
    assert_eq!(code, [255; 4]);
    assert!(steps.contains(&Step::Composed(Vec::new())));
}

// ---- Bad input ----

fn refusal(text: &str, changes: &[&str]) -> String {
    let stage = stage(text, changes);
    technique::prepare(Kind::DynamicLine, &stage).map(|_| ()).unwrap_err().to_string()
}

#[test]
fn parts_without_number_are_refused_and_a_length_of_zero_too() {
    let text = scene(FLAT, MAP, &lines(3.0));
    let said = refusal(&text, &["technique.dynamic-line.l_max=1e-9"]);
    assert!(said.contains("at most 2^28") && said.contains("l_max"), "{said}");
    let zero = [Override::parse("technique.dynamic-line.l_max=0").unwrap()];
    let said = SceneFile::parse(&text, None, &zero).unwrap_err().to_string();
    assert!(said.contains("l_max") && said.contains("greater than 0"), "{said}");
    let open = ["technique.dynamic-line.corners=style", "technique.dynamic-line.antialiasing=analytic"];
    let open: Vec<Override> = open.iter().map(|change| Override::parse(change).unwrap()).collect();
    let said = SceneFile::parse(&text, None, &open).unwrap_err().to_string();
    assert!(said.contains("analytic"), "{said}");
}

#[test]
fn a_scene_without_widths_in_pixels_is_refused() {
    let text = scene(FLAT, MAP, &lines(3.0).replace("width_px", "width_m"));
    let said = refusal(&text, &[]);
    assert!(said.contains("there is no width in pixels") && said.contains("static-decal"), "{said}");
}

#[test]
fn widths_of_nothing_and_of_everything_are_drawn() {
    for (width, covered) in [(0.0, 0..97), (1e300, 96 * 64..96 * 64 + 1), (f64::MIN_POSITIVE, 0..97)] {
        for view in [OBLIQUE, ABOVE, MAP] {
            let (mut scene, surface) = loaded(&scene(FLAT, view, ""), &PLAIN);
            let line = Line {
                color: Color([0.0, 0.0, 0.0, 1.0]),
                width: Width::Pixels(width),
                join: Join::Round,
                cap: Cap::Round,
            };
            let shape = Shape::Line(vec![path(&[[-100.0, 0.0], [100.0, 0.0]])]);
            let style = Style { line: Some(line), ..Style::default() };
            scene.layers = vec![Layer::uniform("line", style, vec![Feature { index: 0, style: 0, shape }])];
            let stage = Stage::new(scene, surface).unwrap();
            let frame = frame_of(Kind::DynamicLine, &stage, &["list-length", "triangle"]);
            let sky = counts_of(&frame, "triangle").iter().filter(|id| **id == u32::MAX).count();
            let found = counts_of(&frame, "list-length").iter().filter(|n| **n > 0).count();
            assert!(
                covered.contains(&(found + if width > 1.0 { sky } else { 0 })),
                "{width} {view}: {found}"
            );
        }
    }
}

#[test]
fn what_lies_behind_the_eye_does_not_fold_over() {
    // The camera stands over a line that comes from behind it and goes on before it.
    let camera = "eye = [0, 0, 30], target = [0, 100, 0], near_m = 0.5";
    for points in [&[[3.0, -300.0], [3.0, 300.0]][..], &[[-200.0, -20.0], [200.0, -20.0]], &TURNS] {
        let [missing, extra, covered] = missing_extra_covered((FLAT, camera), points, 5.0, &EXACT);
        assert_eq!([missing, extra], [0, 0], "{points:?}");
        assert!(covered > 0 || points[0][1] == -20.0);
        let [_, extra, _] = missing_extra_covered((FLAT, camera), points, 5.0, &PLAIN);
        assert_eq!(extra, 0);
    }
}

#[test]
fn a_pixel_may_have_a_hundred_thousand_segments() {
    // A scribble within a pixel, and a line over it.
    let scribble: Vec<[f64; 2]> = (0..50_001i64)
        .map(|k| [3.0 + (k * 7919 % 1000) as f64 / 1e3, 3.0 + (k * 104_729 % 997) as f64 / 1e3])
        .collect();
    let layer = line_layer(&scribble, 0.2) + &line_layer(&[[-100.0, 3.0], [100.0, 3.4]], 2.0);
    let frame = draw(&scene(FLAT, MAP, &layer), &EXACT, &["list-length"]);
    assert!(count(&frame, "longest_list") > 10_000, "{}", count(&frame, "longest_list"));
}

#[test]
fn pieces_of_long_lines_join_as_one() {
    // Some thousand parts: more than one piece; only a part of it is seen. With few vertices the same is one piece.
    let wave: Vec<[f64; 2]> = (0..3000)
        .map(|k| f64::from(k) * 0.4 - 600.0)
        .map(|x| [x, 40.0 * drapery::math::sin(x / 25.0)])
        .collect();
    let closed: Vec<[f64; 2]> = (0..2401)
        .map(|k| f64::from(k % 2400) / 2400.0 * 2.0 * std::f64::consts::PI)
        .map(|t| [500.0 * drapery::math::cos(t) - 400.0, 130.0 * drapery::math::sin(t)])
        .collect();
    for points in [wave, closed] {
        for (changes, width) in [(&EXACT[..], 5.0), (&PLAIN[..], 2.0)] {
            let zoomed = "eye = [0, 0, 500], target = [0, 0, 0], up = [0, 1, 0], projection = \"orthographic\", height_m = 150";
            let [missing, extra, covered] = missing_extra_covered((FLAT, zoomed), &points, width, changes);
            assert_eq!([missing.min(3) * usize::from(changes.len() == 5), extra], [0, 0]);
            assert!(covered > 50);
        }
    }
}
