//! Analytic coverage against the truth: exact outside of pixels that are sampled, over every kind of terrain, ground and style.
#![cfg(feature = "render")]

mod drawing;

use drapery::buffer::Values;
use drapery::math::max;
use drapery::scene_file::SceneFile;
use drapery::stage::Stage;
use drapery::technique::{Frame, Kind};
use drapery::truth::Truth;
use drawing::{scene, stage, truth_of};

const HILLS: &str = "kind = \"fbm\", posts = [33, 33], cell_m = 10.0, height_m = 60.0, seed = 3";
const CAMERA: &str = "eye = [0, -260, 160], target = [0, 0, 20], fov_y_deg = 45";

fn doubles(frame: &Frame, name: &str) -> Vec<f64> {
    let plane = frame.planes.iter().find(|plane| plane.name == name).unwrap();
    let Values::F64(values) = &plane.values else { panic!("{name} has other numbers") };
    values.clone()
}

fn bytes(frame: &Frame, name: &str) -> Vec<u8> {
    let plane = frame.planes.iter().find(|plane| plane.name == name).unwrap();
    let Values::U8(values) = &plane.values else { panic!("{name} has other numbers") };
    values.clone()
}

/// How far the colour of each pixel is outside of the truth's interval, for pixels that are not sampled, and how many are.
fn beyond(truth: &Truth, frame: &Frame) -> (f64, usize) {
    let (color, fallback) = (doubles(frame, "color"), bytes(frame, "fallback"));
    let (lo, hi) = (truth.low.values(), truth.high.values());
    let mut worst: f64 = 0.0;
    for (k, own) in color.chunks(4).enumerate().filter(|(k, _)| fallback[*k] == 0) {
        for c in 0..4 {
            let off = max(lo[k][c] - own[c], own[c] - hi[k][c]);
            worst = max(off, worst);
        }
    }
    (worst, fallback.iter().filter(|why| **why != 0).count())
}

/// No pixel is sampled, and none is farther from the truth than a tolerance.
#[track_caller]
fn is_right(text: &str, changes: &[&str], tolerance: f64) {
    is_right_on(&stage(text, changes), tolerance);
}

#[track_caller]
fn is_right_on(stage: &Stage, tolerance: f64) {
    let frame = drawing::frame_of(Kind::Analytic, stage, &["color", "fallback"]);
    let (worst, sampled) = beyond(&truth_of(stage), &frame);
    assert!(worst <= tolerance, "{worst}");
    assert_eq!(sampled, 0);
}

#[test]
fn bare_ground_and_sky_are_exact() {
    is_right(&scene(HILLS, CAMERA, ""), &[], 1e-9);
}

#[test]
fn fills_are_exact() {
    let layer = "[[layer]]\nfill = { color = \"#ff0000\" }\nfeatures = [{ polygon = [[-100, -100], [90, -80], [20, 10], [80, 100], [-90, 70]] }]\n";
    is_right(&scene(HILLS, CAMERA, layer), &[], 1e-9);
}

const PARCELS: &str = "[[layer]]\nfill = { color = \"#ff0000\", opacity = 0.6 }\nfeatures = [{ polygon = [[-100, -100], [90, -80], [20, 10], [80, 100], [-90, 70]] }, { polygon = [[20, 10], [80, 100], [140, 20]] }]\n\
    [[layer]]\nopacity = 0.5\nfill = { color = \"#00a000\" }\nfeatures = [{ polygon = [[-60, -140], [0, 0], [-140, 20]] }, { polygon = [[-100, -60], [40, -40], [-20, 60]] }]\n";

#[test]
fn translucent_fills_and_layers_are_exact_in_both_spaces() {
    for space in ["space=encoded", "space=linear", "mode=additive"] {
        is_right(&scene(HILLS, CAMERA, PARCELS), &[&format!("compositing.{space}")], 1e-9);
    }
}

#[test]
fn parallel_rays_see_the_same() {
    let camera = "eye = [0, -260, 160], target = [0, 0, 20], projection = \"orthographic\", height_m = 260";
    is_right(&scene(HILLS, camera, PARCELS), &[], 1e-9);
}

#[test]
fn an_image_on_the_ground_and_a_hillshade_are_exact() {
    is_right(&scene(HILLS, CAMERA, PARCELS), &["terrain.shade=hillshade"], 1e-9);
}

#[test]
fn near_and_far_planes_cut_exactly() {
    is_right(&scene(HILLS, CAMERA, PARCELS), &["camera.near_m=200", "camera.far_m=330"], 1e-9);
    // Among the hills, with triangles behind the eye.
    let inside = "eye = [10, -20, 45], target = [0, 60, 30], fov_y_deg = 70";
    is_right(&scene(HILLS, inside, PARCELS), &["camera.near_m=0.5"], 1e-9);
}

const STROKES: &str = "[[layer]]\nline = { color = \"#ff0000\", width_m = 12, JOIN, opacity = 0.7 }\n\
    features = [{ line = [[-120, -100], [-20, -60], [-40, 40], [30, 60], [20, 50], [120, -90]] }, { line = [[10, -120], [10, -100]] }]\n\
    [[layer]]\nfill = { color = \"#00a000\", opacity = 0.4 }\noutline = { color = \"#000000\", width_m = 8, OJOIN, mode = \"MODE\" }\n\
    features = [{ polygon = [[-100, -20], [0, -120], [60, 20], [-30, 90]] }]\n";

#[test]
fn strokes_with_every_join_cap_and_mode_are_right() {
    let cases = [
        ("bevel", "butt", "normal", 1e-9),
        ("miter", "square", "inset", 1e-9),
        ("round", "round", "offset", 1.0 / 255.0),
    ];
    for (join, cap, mode, tolerance) in cases {
        let join = format!("join = \"{join}\"");
        let text = STROKES.replace("OJOIN", &join).replace("JOIN", &format!("{join}, cap = \"{cap}\""));
        let text = text.replace("MODE", mode);
        is_right(&scene(HILLS, CAMERA, &text), &[], tolerance);
    }
}

#[test]
fn dynamic_widths_are_right() {
    let text = STROKES
        .replace("width_m", "width_px")
        .replace("12", "4")
        .replace("8,", "2,")
        .replace(", OJOIN", "")
        .replace(", JOIN", "")
        .replace("MODE", "normal");
    is_right(&scene(HILLS, CAMERA, &text), &[], 2.0 / 255.0);
    let camera = "eye = [0, -260, 160], target = [0, 0, 20], projection = \"orthographic\", height_m = 260";
    is_right(&scene(HILLS, camera, &text), &[], 1.0 / 255.0);
}

#[test]
fn inverted_fills_are_exact() {
    let text = "[[layer]]\nfill = { color = \"#ff0000\", opacity = 0.5, invert = true }\nfeatures = [{ polygon = [[-100, -100], [90, -80], [20, 10], [80, 100], [-90, 70]] }, { polygon = [[-20, -10], [80, 100], [140, 20]] }]\n";
    is_right(&scene(HILLS, CAMERA, text), &[], 1e-9);
}

/// A scene of the goldens.
fn golden(name: &str) -> Stage {
    let path = std::path::Path::new("golden").join(name);
    let file = SceneFile::read(&path, &[]).unwrap();
    let (scene, surface) = drapery::source::load::load(&file, &|_| {}).unwrap();
    Stage::new(scene, surface).unwrap()
}

#[test]
fn scattered_points_and_holes_are_exact() {
    is_right_on(&golden("terrain/tin.toml"), 1e-9);
    is_right_on(&golden("terrain/holes.toml"), 1e-9);
}

#[test]
fn an_image_is_cut_at_its_texels() {
    is_right_on(&golden("terrain/imagery.toml"), 1e-9);
}

#[test]
fn a_level_of_detail_and_a_globe_are_exact() {
    is_right_on(&golden("lod/error.toml"), 1e-9);
    is_right_on(&golden("globe/region.toml"), 1e-9);
}

#[test]
fn without_any_budget_all_pixels_are_samples_and_the_same_as_plain_supersampling() {
    let text = STROKES
        .replace("OJOIN", "join = \"miter\"")
        .replace("JOIN", "join = \"bevel\"")
        .replace("MODE", "inset");
    for none in ["technique.analytic.fragments=0", "technique.analytic.crowd=0"] {
        let stage = stage(&scene(HILLS, CAMERA, &text), &[none, "technique.analytic.samples=3"]);
        let frame = drawing::frame_of(Kind::Analytic, &stage, &["color"]);
        assert_eq!(drawing::count(&frame, "sampled_pixels"), 96 * 64);
        let sampled = drapery::sampling::sample(&stage, &stage.view().unwrap(), 3, &|_| {});
        let off = doubles(&frame, "color")
            .into_iter()
            .zip(sampled.colors.values().as_flattened())
            .map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, max) < 1e-9);
    }
}

#[test]
fn a_pixel_of_many_triangles_needs_no_samples_where_no_border_lies_in_it() {
    let terrain = HILLS.replace("33, 33", "129, 129").replace("cell_m = 10.0", "cell_m = 2.5");
    let small = ["image.width=6", "image.height=4", "terrain.shade=hillshade"];
    // From above, so that nothing hides anything; the fill covers all.
    let camera = "eye = [0, -1, 300], target = [0, 0, 0], fov_y_deg = 30";
    let fill = "[[layer]]\nfill = { color = \"#ff0000\", opacity = 0.5 }\nfeatures = [{ polygon = [[-900, -900], [900, -900], [900, 900], [-900, 900]] }]\n";
    let stage = stage(&scene(&terrain, camera, fill), &small);
    is_right_on(&stage, 1e-9);
    let frame = drawing::frame_of(Kind::Analytic, &stage, &[]);
    assert!(drawing::count(&frame, "fragments") > 24 * 64, "more than are told apart");
}

#[test]
fn a_wide_line_near_the_eye_makes_samples_of_those_pixels_alone_that_its_border_crosses() {
    let camera = "eye = [0, -100, 30], target = [0, 0, 20], fov_y_deg = 60";
    let line = "[[layer]]\nline = { color = \"#ff0000\", width_px = 60 }\nfeatures = [{ line = [[2, -400], [2, 300]] }]\n";
    let stage = stage(&scene(HILLS, camera, line), &["camera.near_m=0.1"]);
    let frame = drawing::frame_of(Kind::Analytic, &stage, &["color", "fallback"]);
    let (worst, sampled) = beyond(&truth_of(&stage), &frame);
    assert!(worst <= 2.0 / 255.0, "{worst}");
    assert_eq!(drawing::count(&frame, "bent_widths"), sampled as u64);
    // Two borders of 64 rows, some of them in two columns.
    assert!((1..=4 * 64).contains(&sampled), "{sampled}");
}

#[test]
fn a_crowd_of_edges_is_sampled_and_counted() {
    // A star of 400 points around a pixel.
    let star: Vec<String> = (0..400)
        .map(|k| {
            let (radius, angle) =
                (if k % 2 == 0 { 20.0 } else { 120.0 }, f64::from(k) * 0.015_707_963_267_948_967);
            format!("[{}, {}]", radius * drapery::math::cos(angle), radius * drapery::math::sin(angle))
        })
        .collect();
    let layer = format!(
        "[[layer]]\nfill = {{ color = \"#ff0000\" }}\nfeatures = [{{ polygon = [{}] }}]\n",
        star.join(", ")
    );
    let stage = stage(&scene(HILLS, CAMERA, &layer), &["technique.analytic.crowd=6"]);
    let frame = drawing::frame_of(Kind::Analytic, &stage, &["color", "fallback"]);
    let (worst, sampled) = beyond(&truth_of(&stage), &frame);
    assert!(worst < 1e-9, "{worst}");
    assert!(sampled > 10, "{sampled}");
    assert_eq!(drawing::count(&frame, "crowded_by_edges"), sampled as u64);
}
