//! Scenes that say the same in other words have the same picture by areas.
#![cfg(feature = "render")]

mod drawing;

use drapery::buffer::Values;
use drapery::technique::Kind;
use drawing::{frame_of, scene, stage};

const HILLS: &str = "kind = \"fbm\", posts = [17, 17], cell_m = 20.0, height_m = 60.0, seed = 3";
const CAMERA: &str = "eye = [0, -260, 160], target = [0, 0, 20], fov_y_deg = 45";
const SMALL: [&str; 2] = ["image.width=48", "image.height=32"];

/// The polygon of a ring with a hole.
const LAKE: &str =
    "[[[-100, -90], [90, -110], [60, 10], [110, 90], [-90, 60]], [[-40, -40], [30, -50], [-10, 30]]]";

fn colors(layers: &str, changes: &[&str]) -> Vec<f64> {
    let stage = stage(&scene(HILLS, CAMERA, layers), &[&SMALL[..], changes].concat());
    let frame = frame_of(Kind::Analytic, &stage, &["color"]);
    let Values::F64(values) = &frame.planes[0].values else { panic!("colours have other numbers") };
    values.clone()
}

#[track_caller]
fn are_the_same(one: (&str, &[&str]), other: (&str, &[&str])) {
    let (one, other) = (colors(one.0, one.1), colors(other.0, other.1));
    let off = one.iter().zip(&other).map(|(a, b)| (a - b).abs()).fold(0.0, drapery::math::max);
    assert!(off < 1e-9, "{off}");
    assert!(one.chunks(4).any(|color| color[..2] != one[..2]), "nothing is drawn");
}

fn layer(features: &str, style: &str) -> String {
    format!("[[layer]]\nfeatures = [{features}]\n{style}\n")
}

#[test]
fn a_fill_is_the_ground_beside_its_complement() {
    let lake = format!("{{ polygon = {LAKE} }}");
    let fill = layer(&lake, "fill = { color = \"#ff0000\" }");
    let rest = layer(&lake, "fill = { color = \"#ffffff\", invert = true }");
    are_the_same((&fill, &[]), (&rest, &["terrain.color=#ff0000"]));
}

#[test]
fn an_outline_is_its_inner_and_its_outer_half() {
    let lake = format!("{{ polygon = {LAKE} }}");
    for join in ["miter", "round", "bevel"] {
        let outline = |mode: &str| {
            let style = format!(
                "outline = {{ color = \"#ff0000\", width_m = 21.0, mode = \"{mode}\", join = \"{join}\" }}"
            );
            layer(&lake, &style)
        };
        are_the_same((&outline("normal"), &[]), (&(outline("inset") + &outline("offset")), &[]));
    }
}

#[test]
fn a_line_may_have_vertices_along_its_segments() {
    let styles = [
        "line = { color = \"#ff0000\", width_m = 16.0, cap = \"square\", opacity = 0.5 }",
        "line = { color = \"#ff0000\", width_m = 16.0, join = \"round\", cap = \"round\", opacity = 0.5 }",
    ];
    for style in styles {
        let plain = layer("{ line = [[-120, -80], [40, 80], [60, -80]] }", style);
        let split =
            layer("{ line = [[-120, -80], [-40, 0], [20, 60], [40, 80], [55, -40], [60, -80]] }", style);
        are_the_same((&plain, &[]), (&split, &[]));
    }
}

#[test]
fn equal_features_may_come_in_any_order_and_halves_are_a_whole() {
    let style = "fill = { color = \"#ff0000\" }\nline = { color = \"#ff0000\", width_m = 9.0 }";
    let features = [
        "{ polygon = [[-100, -90], [0, -90], [0, 80]] }",
        "{ polygon = [[0, -90], [90, -90], [0, 80]] }",
        "{ line = [[-120, 40], [0, 0], [130, 70]] }",
    ];
    let whole = "{ polygon = [[-100, -90], [90, -90], [0, 80]] }";
    let forth = layer(&features.join(", "), style);
    let back = layer(&[features[2], features[1], features[0]].join(", "), style);
    are_the_same((&forth, &[]), (&back, &[]));
    are_the_same((&forth, &[]), (&layer(&[whole, features[2]].join(", "), style), &[]));
    let translucent = "fill = { color = \"#ff0000\", opacity = 0.4 }";
    let halves = layer(&features[..2].join(", "), translucent);
    are_the_same((&halves, &[]), (&layer(whole, translucent), &[]));
}
