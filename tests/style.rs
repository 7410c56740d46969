//! What a style says is what every technique, supersampling and the truth draw.
#![cfg(feature = "render")]

mod drawing;

use drapery::sampling;
use drapery::scene_file::SceneFile;
use drapery::source::load;
use drapery::stage::Stage;
use drapery::truth::{Budget, certify};

/// A plane seen from straight above, a metre a pixel, with what is said.
fn stage(ground: &str, said: &str) -> Stage {
    let text = format!(
        "schema = 1\nimage = {{ width = 24, height = 24 }}\n\
         camera = {{ eye = [0, 0, 100], target = [0, 0, 0], up = [0, 1, 0], projection = \"orthographic\", height_m = 24 }}\n\
         terrain = {{ generate = {{ kind = \"plane\", posts = [5, 5], cell_m = 10 }}, color = \"{ground}\" }}\n\
         [technique.clipmap]\nvirtual_size = 4096\nlevel_bias = -3\n{said}"
    );
    let (scene, surface) = load::load(&SceneFile::parse(&text, None, &[]).unwrap(), &|_| {}).unwrap();
    Stage::new(scene, surface).unwrap()
}

/// The colour of each of some pixels, by whoever draws: their names and 8-bit codes.
fn drawn(stage: &Stage, pixels: &[[usize; 2]]) -> Vec<(String, Vec<[u8; 4]>)> {
    let view = stage.view().unwrap();
    let codes = |color: &[f64; 4]| color.map(|v| (v * 255.0 + 0.5) as u8);
    let truth = certify(stage, &view, &Budget::new(1e-6, 12).unwrap(), &|_| {});
    let sampled = sampling::sample(stage, &view, 4, &|_| {});
    let mut all = vec![
        ("truth".to_owned(), pixels.iter().map(|[x, y]| codes(truth.estimate.at(*x, *y))).collect()),
        ("supersampling".to_owned(), pixels.iter().map(|[x, y]| codes(sampled.colors.at(*x, *y))).collect()),
    ];
    for kind in drawing::kinds_of_footprints_for(stage) {
        let frame = kind.draw(stage).unwrap();
        all.push((format!("{kind:?}"), pixels.iter().map(|[x, y]| *frame.image.at(*x, *y)).collect()));
    }
    all
}

/// Two squares that share the middle of the picture, and a line over both.
const SQUARES: &str = "[[layer]]\nname = \"below\"\nfeatures = [{ polygon = [[-12, -12], [12, -12], [12, -3], [-12, -3]] }]\n\
    fill = { color = \"blue\" }\n\
    [[layer]]\nname = \"group\"\nopacity = 0.5\n\
    features = [{ polygon = [[-9, -9], [3, -9], [3, 9], [-9, 9]] }, { polygon = [[-3, -9], [9, -9], [9, 9], [-3, 9]] }, { line = [[-9, 7], [9, 7]] }]\n\
    fill = { color = \"red\" }\nline = { color = \"lime\", width_m = 4 }\n\
    [[layer]]\nname = \"above\"\nfeatures = [{ polygon = [[-12, -1], [12, -1], [12, 2], [-12, 2]] }]\nfill = { color = \"black\" }\n";

/// In one square, in both, in the line over both, over what lies below, in what lies above, outside.
const PLACES: [[usize; 2]; 6] = [[4, 8], [12, 8], [12, 5], [12, 18], [12, 11], [1, 8]];

#[test]
fn features_of_a_layer_with_an_opacity_do_not_add_up_whoever_draws() {
    let pink = [255, 128, 128, 255];
    let expected = [pink, pink, [128, 255, 128, 255], [128, 0, 128, 255], [0, 0, 0, 255], [255; 4]];
    for (who, colors) in drawn(&stage("white", SQUARES), &PLACES) {
        assert_eq!(colors, expected, "{who}");
    }
    let grouped = "[technique.stencil-volume]\ngrouping = \"color\"\n";
    for (who, colors) in drawn(&stage("white", &format!("{grouped}{SQUARES}")), &PLACES) {
        assert_eq!(colors, expected, "{who}, a mask a colour");
    }
}

#[test]
fn additive_layers_are_mixed_with_what_is_there_without_them() {
    let said = format!("[compositing]\nmode = \"additive\"\n{SQUARES}");
    for (who, colors) in drawn(&stage("#000020", &said), &PLACES[..3]) {
        assert_eq!(colors, [[128, 0, 32, 255], [128, 0, 32, 255], [128, 128, 32, 255]], "{who}");
    }
}

#[test]
fn a_layer_of_full_opacity_is_drawn_feature_by_feature() {
    let said =
        SQUARES.replace("opacity = 0.5\n", "").replace("color = \"red\"", "color = \"red\", opacity = 0.5");
    for (who, colors) in drawn(&stage("white", &said), &PLACES[..2]) {
        assert_eq!(colors, [[255, 128, 128, 255], [255, 64, 64, 255]], "{who}");
    }
}

/// A square with a hole, one that overlaps it, one of another kind, and a layer that paints what is outside of them.
fn inverted(how: &str) -> String {
    format!(
        "[[layer]]\nname = \"mask\"\nfeatures = [\
         {{ polygon = [[[-10, -10], [3, -10], [3, 5], [-10, 5]], [[-8, -8], [-8, -1], [-1, -1], [-1, -8]]], properties = {{ kind = 1 }} }}, \
         {{ polygon = [[10, 10], [10, 1], [-1, 1], [-1, 10]], properties = {{ kind = 1 }} }}, \
         {{ polygon = [[5, -11], [11, -11], [11, -5], [5, -5]], properties = {{ kind = 2 }} }}, \
         {{ polygon = [[900, 0], [900, 9], [909, 9]], properties = {{ kind = 1 }} }}]\n{how}\n"
    )
}

/// In the first square, in its hole, in both, in the second, in the one of another kind, outside.
const INVERTED_PLACES: [[usize; 2]; 6] = [[13, 17], [7, 16], [13, 9], [18, 5], [20, 19], [4, 2]];

#[test]
fn an_inverted_fill_paints_what_is_outside_of_all_polygons_once_whoever_draws() {
    let (pink, white) = ([255, 128, 128, 255], [255; 4]);
    let grouped = "[technique.stencil-volume]\ngrouping = \"color\"\n";
    let faint = "fill = { color = \"red\", opacity = 0.5, invert = true";
    for (how, painted) in [
        (format!("{faint} }}"), [white, pink, white, white, white, pink]),
        (format!("{faint}, rule = \"nonzero\" }}"), [white, pink, white, white, white, pink]),
        (format!("{faint} }}\nwhere = {{ kind = 1 }}"), [white, pink, white, white, pink, pink]),
        (format!("{faint} }}\nwhere = {{ kind = 3 }}"), [pink; 6]),
        (
            "fill = { color = \"red\", invert = true }\nopacity = 0.5".into(),
            [white, pink, white, white, white, pink],
        ),
    ] {
        for (who, colors) in drawn(&stage("white", &format!("{grouped}{}", inverted(&how))), &INVERTED_PLACES)
        {
            assert_eq!(colors, painted, "{who}: {how}");
        }
    }
}

#[test]
fn a_polygon_around_all_of_the_terrain_leaves_an_inverted_fill_its_holes() {
    let around = "[-900, -900], [900, -900], [900, 900], [-900, 900]";
    for (hole, middle) in [("", [255; 4]), (", [[-5, -5], [-5, 5], [5, 5], [5, -5]]", [255, 0, 0, 255])] {
        let said = format!(
            "[[layer]]\nname = \"mask\"\nfeatures = [{{ polygon = [[{around}]{hole}] }}]\nfill = {{ color = \"red\", invert = true }}"
        );
        for (who, colors) in drawn(&stage("white", &said), &[[12, 12], [2, 2]]) {
            assert_eq!(colors, [middle, [255; 4]], "{who}{hole}");
        }
    }
}

#[test]
fn an_inverted_fill_lies_below_the_outlines_of_each_polygon_and_shares_no_count_with_other_fills() {
    let (red, black, white) = ([255, 0, 0, 255], [0, 0, 0, 255], [255; 4]);
    let outlined = "fill = { color = \"red\", invert = true, rule = \"nonzero\" }\n\
        outline = { color = \"black\", width_m = 6, mode = \"inset\" }";
    let grouped = "[technique.stencil-volume]\ngrouping = \"color\"\n";
    let other = "[[layer]]\nname = \"other\"\nfeatures = [{ polygon = [[-12, 7], [-12, 12], [-3, 12], [-3, 7]] }]\n\
        fill = { color = \"red\", rule = \"nonzero\" }\n";
    let said = format!("{grouped}{}{other}", inverted(outlined));
    // The second square's side in the first one, its middle, the hole, what is outside and in the other layer.
    for (who, colors) in drawn(&stage("white", &said), &[[12, 9], [17, 6], [7, 16], [4, 2], [22, 12]]) {
        assert_eq!(colors, [black, white, red, red, red], "{who}");
    }
}

#[test]
fn no_column_tells_the_colour_of_an_inverted_fill() {
    let by = "{ by = \"kind\", map = { 1 = \"red\" } }";
    for (color, opacity) in [(by, "1"), ("\"red\"", "{ by = \"kind\", stops = [[0, 0], [1, 1]] }")] {
        let layer = inverted(&format!("fill = {{ color = {color}, opacity = {opacity}, invert = true }}"));
        let text = format!("schema = 1\nterrain.generate = {{ kind = \"plane\" }}\n{layer}");
        let error = SceneFile::parse(&text, None, &[]).unwrap_err().to_string();
        assert!(error.contains("an inverted fill is painted once") && error.contains("`kind`"), "{error}");
    }
}
