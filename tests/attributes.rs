//! Layers by their columns: a picture by classes is the picture of a layer for each class.

#![cfg(feature = "render")]

mod drawing;

use drapery::technique::Kind;
use drawing::{frame_of, kinds_for, scene, stage, truth_of};

const TERRAIN: &str = "kind = \"fbm\", seed = 3, posts = [33, 33], cell_m = 30.0, height_m = 200.0";
const CAMERA: &str = "eye = [0, -900, 700], target = [0, 0, 60]";

/// Fields, paths and lakes of three classes, in an order of their own.
const FEATURES: &str = r#"features = [
  { polygon = [[-300, -200], [100, -200], [100, 150], [-300, 150]], properties = { class = "wood", rank = 1 } },
  { line = [[-400, -100], [0, 50], [350, -50]], properties = { class = "road", rank = 3 } },
  { polygon = [[[-50, -300], [300, -300], [300, 100], [-50, 100]], [[50, -100], [150, -100], [150, 0], [50, 0]]], properties = { class = "lake", rank = 2 } },
  { line = [[0, -350], [30, 300]], properties = { class = "path", rank = 4 } },
  { polygon = [[-200, 50], [200, 50], [0, 320]], properties = { class = "wood", rank = 1 } },
]"#;

/// One layer whose styles are told by a column, drawn by rank.
const BY_COLUMN: &str = r##"
order = { by = "rank" }
fill = { color = { by = "class", map = { wood = "#228b22", lake = "#3388ff" } }, opacity = { by = "rank", stops = [[1, 0.75], [3, 0.25]] } }
line = { color = { by = "class", map = { path = "#553311" }, default = "#cc2200" }, width_m = { by = "class", map = { road = 40, path = 15 } }, join = "round", cap = "round" }
"##;

/// The same, a layer for each class.
const BY_LAYER: [(&str, &str); 4] = [
    ("wood", "fill = { color = \"#228b22\", opacity = 0.75 }"),
    ("lake", "fill = { color = \"#3388ff\", opacity = 0.5 }"),
    ("road", "line = { color = \"#cc2200\", width_m = 40, join = \"round\", cap = \"round\" }"),
    ("path", "line = { color = \"#553311\", width_m = 15, join = \"round\", cap = \"round\" }"),
];

#[test]
fn a_picture_by_classes_is_that_of_a_layer_for_each_class() {
    let one = scene(TERRAIN, CAMERA, &format!("[[layer]]\n{FEATURES}\n{BY_COLUMN}"));
    let class = |(class, style): &(&str, &str)| {
        format!("[[layer]]\nname = \"{class}\"\n{FEATURES}\nwhere = {{ class = \"{class}\" }}\n{style}\n")
    };
    let many = scene(TERRAIN, CAMERA, &BY_LAYER.iter().map(class).collect::<String>());
    let (one, many) = (stage(&one, &[]), stage(&many, &[]));
    assert_eq!((one.scene.layers[0].styles.len(), many.scene.layers.len()), (4, 4));
    for kind in kinds_for(&one) {
        let [one, many] = [&one, &many].map(|stage| frame_of(kind, stage, &[]).image);
        assert!(one == many, "{kind:?}");
    }
    let truths = [&one, &many].map(truth_of);
    assert_eq!(truths[0].low.values(), truths[1].low.values());
    assert_eq!(truths[0].high.values(), truths[1].high.values());
    let reversed = stage(
        &scene(TERRAIN, CAMERA, &format!("[[layer]]\n{FEATURES}\n{BY_COLUMN}")),
        &["layer.0.order.descending=true"],
    );
    let [one, reversed] = [&one, &reversed].map(|stage| frame_of(Kind::InverseProjection, stage, &[]).image);
    assert!(one != reversed, "the order is seen");
}

#[test]
fn areas_and_lines_of_one_look_keep_their_own_parts_of_it() {
    let features = r#"features = [
  { polygon = [[-300, -200], [0, -200], [0, 150], [-300, 150]], properties = { k = "a" } },
  { line = [[50, -250], [300, 200]], properties = { k = "a" } },
]"#;
    let styled = |color: &str| {
        let stroke = format!("{{ color = {color}, width_m = 30 }}");
        let layer = format!("[[layer]]\n{features}\noutline = {stroke}\nline = {stroke}");
        stage(&scene(TERRAIN, CAMERA, &layer), &[])
    };
    let (plain, by_column) = (styled("\"#cc2200\""), styled("{ by = \"k\", map = { a = \"#cc2200\" } }"));
    assert_eq!((plain.draw_list.items().len(), by_column.draw_list.items().len()), (2, 2));
    for kind in kinds_for(&plain) {
        assert!(frame_of(kind, &plain, &[]).image == frame_of(kind, &by_column, &[]).image, "{kind:?}");
    }
}
