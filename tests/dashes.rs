//! Dashes: where they lie by closed forms, and that every technique draws them as it draws the same dashes written one by one.
#![cfg(feature = "render")]

mod drawing;

use drapery::scene_file::SceneFile;
use drapery::technique::Kind;
use drawing::{errors, frame_of, kinds_for, kinds_of_footprints_for, loaded, scene, stage, truth_of};

const PLANE: &str = r#"kind = "plane", posts = [9, 9], cell_m = 20.0"#;
const HILLS: &str = r#"kind = "fbm", seed = 3, posts = [33, 33], cell_m = 10.0, height_m = 60.0"#;
const FROM_ABOVE: &str =
    r#"eye = [0, 0, 200], target = [0, 0, 0], up = [0, 1, 0], projection = "orthographic", height_m = 80.0"#;
const OBLIQUE: &str = "eye = [20, -220, 140], target = [0, 0, 20]";

/// The area of a pixel from above, square metres.
const PIXEL: f64 = 80.0 / 64.0 * 80.0 / 64.0;

fn layer(features: &str, style: &str) -> String {
    format!("[[layer]]\nfeatures = [{features}]\n{style}\n")
}

/// How many square metres are red over white ground, by the truth from above.
fn red_area(features: &str, style: &str) -> f64 {
    let stage = stage(&scene(PLANE, FROM_ABOVE, &layer(features, style)), &[]);
    let estimate = truth_of(&stage).estimate;
    PIXEL * estimate.values().iter().map(|[_, green, ..]| 1.0 - green).sum::<f64>()
}

fn is_about(value: f64, expected: f64) -> bool {
    // The truth is half a code value wide in the pixels of the border.
    (value - expected).abs() < 0.002 * expected
}

#[test]
fn dashes_of_a_line_have_the_area_of_their_caps() {
    let line = "{ line = [[-50.0, 3.3], [50.0, 3.3]] }";
    let area = |cap: &str| {
        red_area(
            line,
            &format!(r##"line = {{ color = "#ff0000", width_m = 4, dash = [10, 5], cap = "{cap}" }}"##),
        )
    };
    assert!(is_about(area("butt"), 7.0 * 40.0), "{}", area("butt"));
    assert!(is_about(area("square"), 7.0 * (40.0 + 16.0)), "{}", area("square"));
    let round = 7.0 * (40.0 + 4.0 * std::f64::consts::PI);
    assert!(is_about(area("round"), round), "{}", area("round"));
}

#[test]
fn an_offset_moves_dashes_along_the_line() {
    let line = "{ line = [[-50.0, 3.3], [50.0, 3.3]] }";
    let style = |more: &str| {
        format!(r##"line = {{ color = "#ff0000", width_m = 4, dash = [12, 8, 3, 2], {more} }}"##)
    };
    // 12 of 0..12, 3 of 20..23, 25 a turn, four turns.
    assert!(is_about(red_area(line, &style("dash_offset = 0")), 4.0 * 60.0));
    // The last turn's first dash is cut at the line's end, the first one's at its start.
    assert!(is_about(red_area(line, &style("dash_offset = 6")), 4.0 * 60.0));
    let short = "{ line = [[-50.0, 3.3], [-35.0, 3.3]] }";
    assert!(is_about(red_area(short, &style("dash_offset = 6")), 4.0 * (6.0 + 1.0)));
    assert!(is_about(red_area(short, &style("dash_offset = -4")), 4.0 * (2.0 + 11.0)));
}

#[test]
fn a_dashed_outline_is_cut_to_its_side() {
    let square = "{ polygon = [[-30, -20], [30, -20], [30, 20], [-30, 20]] }";
    let area = |mode: &str| {
        red_area(
            square,
            &format!(
                r##"outline = {{ color = "#ff0000", width_m = 4, join = "miter", dash = [10, 10], dash_offset = 5, mode = "{mode}" }}"##
            ),
        )
    };
    // Ten dashes, one around each corner: there the inside lacks a square of 2 m, the outside has one more.
    assert!(is_about(area("normal"), 10.0 * 40.0), "{}", area("normal"));
    assert!(is_about(area("inset"), 10.0 * 20.0 - 4.0 * 4.0), "{}", area("inset"));
    assert!(is_about(area("offset"), 10.0 * 20.0 + 4.0 * 4.0), "{}", area("offset"));
}

/// A line of 100 m with a joint, the vertices in between, and its dashes one by one.
const BENT: &str = "{ line = [[-50, 10], [-30, 10], [10, 10], [10, -30]] }";
const BENT_DASHES: &str = "{ line = [[[-50, 10], [-40, 10]], [[-35, 10], [-30, 10], [-25, 10]], [[-20, 10], [-10, 10]], [[-5, 10], [5, 10]], \
     [[10, 10], [10, 0]], [[10, -5], [10, -15]], [[10, -20], [10, -30]]] }";

#[test]
fn every_technique_draws_dashes_as_lines_of_their_own() {
    let cases = [
        ("width_m = 4", "technique.static-decal.samples=4"),
        (r#"width_m = 6, cap = "round", opacity = 0.5"#, r#"technique.clipmap.joints="style""#),
        ("width_px = 5", "technique.clipmap.filter=\"nearest\""),
        (r#"width_px = 2.5, cap = "square""#, r#"technique.dynamic-line.simplification="none""#),
    ];
    let mut pictures = 0;
    for (style, change) in cases {
        let by = |features: &str, dash: &str| {
            let style = format!(r##"line = {{ color = "#ff0000", {style}{dash} }}"##);
            stage(&scene(HILLS, OBLIQUE, &layer(features, &style)), &[change])
        };
        let (dashed, written) = (by(BENT, ", dash = [10, 5]"), by(BENT_DASHES, ""));
        let [of_dashed, of_written] = [&dashed, &written].map(truth_of);
        assert_eq!((&of_dashed.low, &of_dashed.high), (&of_written.low, &of_written.high), "{style}");
        for kind in kinds_for(&written) {
            let [one, other] = [&dashed, &written].map(|stage| frame_of(kind, stage, &[]).image);
            assert_eq!(one, other, "{kind:?} {style}");
            pictures += 1;
        }
    }
    assert!(pictures >= 12, "{pictures}");
}

#[test]
fn a_vertex_in_a_straight_line_moves_no_dash() {
    let by = |features: &str| {
        let style = r##"line = { color = "#ff0000", width_m = 4, dash = [10, 5] }"##;
        stage(&scene(HILLS, OBLIQUE, &layer(features, style)), &[])
    };
    let whole = by("{ line = [[-50, 10], [50, 10]] }");
    let seam = by("{ line = [[-50, 10], [-12.7, 10], [50, 10]] }");
    for kind in kinds_of_footprints_for(&whole) {
        let [one, other] = [&whole, &seam].map(|stage| frame_of(kind, stage, &[]).image);
        let differing = one.values().iter().zip(other.values()).filter(|(a, b)| a != b).count();
        // The dash that holds the vertex has a joint there.
        assert!(differing <= 2, "{kind:?}: {differing}");
    }
}

/// Ends and corners as the layer says, where a paper has its own.
const ENDS_BY_STYLE: [&str; 3] = [
    r#"technique.static-decal.joins="style""#,
    r#"technique.stencil-volume.joins="style""#,
    r#"technique.clipmap.joints="style""#,
];

#[test]
fn techniques_are_as_near_to_the_truth_with_dashes_as_without() {
    let square = "{ polygon = [[-60, -40], [55, -45], [60, 50], [-50, 40]] }";
    for mode in ["normal", "inset", "offset"] {
        let by = |dash: &str| {
            let style = format!(
                r##"outline = {{ color = "#ff0000", width_m = 8, join = "miter", mode = "{mode}"{dash} }}"##
            );
            stage(&scene(HILLS, OBLIQUE, &layer(square, &style)), &ENDS_BY_STYLE)
        };
        let (whole, dashed) = (by(""), by(", dash = [20, 10]"));
        let truths = [&whole, &dashed].map(truth_of);
        for kind in kinds_of_footprints_for(&whole) {
            let rmse = |stage, truth| {
                let image = frame_of(kind, stage, &[]).image;
                errors(truth, &drapery::compare::Image::from_rgba8(&image).unwrap()).rmse
            };
            let [of_whole, of_dashed] = [rmse(&whole, &truths[0]), rmse(&dashed, &truths[1])];
            assert!(of_dashed < 1.5 * of_whole + 0.005, "{kind:?} {mode}: {of_dashed} against {of_whole}");
        }
    }
}

#[test]
fn dynamic_lines_draw_dashes_in_pixels() {
    let style = r##"line = { color = "#ff0000", width_px = 3, dash = [10, 5] }"##;
    let stage = stage(&scene(HILLS, OBLIQUE, &layer(BENT, style)), &[]);
    let lines = drawing::count(&frame_of(Kind::DynamicLine, &stage, &[]), "lines");
    assert_eq!(lines, 7);
}

#[test]
fn patterns_that_are_none_and_dashes_without_end_are_refused() {
    let refusal = |dash: &str| {
        let style = format!(r##"line = {{ color = "#ff0000", width_m = 4, {dash} }}"##);
        let text = scene(PLANE, FROM_ABOVE, &layer(BENT, &style));
        SceneFile::parse(&text, None, &[]).expect_err(dash).to_string()
    };
    for dash in [
        "dash = [10]",
        "dash = []",
        "dash = [10, 5, 1]",
        "dash = [10, 0]",
        "dash = [-1, 5]",
        "dash = [nan, 5]",
        "dash = 10",
    ] {
        assert!(refusal(dash).contains("layer.0.line.dash"), "{}", refusal(dash));
    }
    assert!(refusal("dash_offset = 3").contains("`dash_offset` goes with `dash` only"));
    let style = r##"line = { color = "#ff0000", width_m = 4, dash = [1.2e-6, 1.2e-6] }"##;
    let (scene, surface) = loaded(&scene(PLANE, FROM_ABOVE, &layer(BENT, style)), &[]);
    let error = drapery::stage::Stage::new(scene, surface).map(|_| ()).expect_err("40 million dashes");
    let text = error.to_string();
    assert!(text.contains("2^25 dashes") && text.contains("feature"), "{text}");
}
