//! What a style says is what every technique, supersampling and the truth draw.
#![cfg(feature = "render")]

use drapery::sampling;
use drapery::scene_file::SceneFile;
use drapery::source::load;
use drapery::stage::Stage;
use drapery::technique::Kind;
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
    for kind in Kind::ALL {
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
