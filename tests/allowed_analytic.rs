//! What pictures by areas may be: what programs draw that move borders by less than a machine does is allowed, and what a planted bug draws is not.
#![cfg(feature = "render")]

mod drawing;
mod judged;

use drapery::technique::Kind;
use drawing::{frame_of, scene, stage};
use judged::{allowed_of, best, outside};

const HILLS: &str = r#"kind = "fbm", seed = 3, posts = [17, 17], cell_m = 40.0, height_m = 120.0"#;
const CAMERA: &str = "eye = [40, -420, 260], target = [0, 0, 40]";
const SMALL: [&str; 3] = ["image.width=48", "image.height=32", "device.subpixel_bits=8"];

/// A translucent lake with an outline, a road with round joins, a river whose width is in pixels.
fn lake() -> String {
    let layers = "[[layer]]\nfeatures = [{ polygon = [[-150, -150], [120, -180], [60, 20], [160, 150], [-120, 90]] }]\n\
         fill = { color = \"#3388ff\", opacity = 0.6 }\noutline = { color = \"#003366\", width_m = 12.0, mode = \"inset\" }\n\
         [[layer]]\nfeatures = [{ line = [[-280, -200], [0, 100], [250, -60], [300, 280]] }]\n\
         line = { color = \"#ff7f00\", width_m = 40, join = \"round\" }\n\
         [[layer]]\nfeatures = [{ line = [[-200, 200], [-20, -40], [200, -250]] }]\n\
         line = { color = \"#004400\", width_px = 2.5 }\n";
    scene(HILLS, CAMERA, layers)
}

fn changed(from: &str, to: &str) -> String {
    let text = lake().replacen(from, to, 1);
    assert_ne!(text, lake(), "{from}");
    text
}

#[test]
fn what_right_programs_draw_is_allowed_and_what_bugs_draw_is_not() {
    let all = allowed_of(Kind::Analytic, &stage(&lake(), &SMALL));
    let image = |text: &str| frame_of(Kind::Analytic, &stage(text, &SMALL), &[]).image;
    assert_eq!(best(&all, &image(&lake())), 0);
    // A tenth of a millimetre is four roundings of the eye's coordinates, and a hundred-thousandth of a pixel.
    let moved = changed(CAMERA, "eye = [40.0001, -420, 260], target = [0.0001, 0, 40]");
    assert_eq!(best(&all, &image(&moved)), 0);
    let bugs = [
        ("wider by a twentieth", "width_m = 40", "width_m = 42"),
        ("wider by a quarter of a pixel", "width_px = 2.5", "width_px = 2.75"),
        ("a tenth of a pixel up", "target = [0, 0, 40]", "target = [0, 0, 41.5]"),
        ("opacity", "opacity = 0.6", "opacity = 0.58"),
        ("square caps", "join = \"round\"", "join = \"round\", cap = \"square\""),
        ("an outline on the wrong side", "\"inset\"", "\"offset\""),
        ("a vertex moved", "[60, 20]", "[62, 20]"),
    ];
    for (name, from, to) in bugs {
        let found = best(&all, &image(&changed(from, to)));
        assert!(found > 0, "{name}");
    }
}

#[test]
fn ranges_are_as_narrow_as_strips_along_borders() {
    let all = allowed_of(Kind::Analytic, &stage(&lake(), &SMALL));
    let [of] = &all.hypotheses[..] else { panic!("{}", all.hypotheses.len()) };
    let width = |k: usize| (0..3).map(|c| of.hi[k][c] - of.lo[k][c]).max().unwrap();
    let codes = |codes: u16| (0..of.lo.len()).filter(|k| width(*k) > codes * 257).count();
    assert!(codes(2) < of.lo.len() / 3, "{}", codes(2));
    assert!(codes(16) < of.lo.len() / 10, "{}", codes(16));
}

#[test]
fn a_program_that_samples_all_pixels_is_judged_by_its_samples() {
    let sampled = [&SMALL[..], &["technique.analytic.fragments=0", "technique.analytic.samples=3"]].concat();
    let stage_of = |changes: &[&str]| stage(&lake(), changes);
    let all = allowed_of(Kind::Analytic, &stage_of(&sampled));
    assert_eq!(best(&all, &frame_of(Kind::Analytic, &stage_of(&sampled), &[]).image), 0);
    let exact = frame_of(Kind::Analytic, &stage_of(&SMALL), &[]).image;
    assert!(outside(&all.hypotheses[0], &exact) > 50);
}

#[test]
fn pictures_over_any_ground_and_in_any_space_are_allowed() {
    let all: [&[&str]; 5] = [
        &["terrain.shade=hillshade"],
        &["compositing.space=linear"],
        &["image.background=#00000000"],
        &["camera.near_m=300", "device.subpixel_bits=0"],
        &["technique.analytic.crowd=3"],
    ];
    for changes in all {
        let stage = stage(&lake(), &[&SMALL[..], &["image.width=24", "image.height=16"], changes].concat());
        let allowed = allowed_of(Kind::Analytic, &stage);
        let image = frame_of(Kind::Analytic, &stage, &[]).image;
        assert_eq!(outside(&allowed.hypotheses[0], &image), 0, "{changes:?}");
    }
}
