//! Layers by their columns: what is drawn, in which order, how it looks.

use super::*;
use crate::scene::{Color, Fill, Line, Style, Width};

const PLANE: &str = "terrain = { generate = { kind = \"plane\", posts = [9, 9], cell_m = 100.0 } }\n";

/// Lines of a layer of a file with these features, as (geometry, properties).
fn roads(features: &[(&str, &str)]) -> String {
    let feature = |(geometry, properties): &(&str, &str)| {
        format!(r#"{{"type":"Feature","properties":{{{properties}}},"geometry":{geometry}}}"#)
    };
    let all: Vec<String> = features.iter().map(feature).collect();
    format!(r#"{{"type":"FeatureCollection","features":[{}]}}"#, all.join(",\n"))
}

const LONG: &str = r#"{"type":"LineString","coordinates":[[0,0],[100,0]]}"#;
const SHORT: &str = r#"{"type":"LineString","coordinates":[[0,0],[0,50]]}"#;
const SMALL: &str = r#"{"type":"Polygon","coordinates":[[[0,0],[10,0],[10,10],[0,10],[0,0]]]}"#;
const LARGE: &str = r#"{"type":"Polygon","coordinates":[[[0,0],[90,0],[90,90],[0,90],[0,0]]]}"#;
const RING: &str = r#"{"type":"Polygon","coordinates":[[[0,0],[90,0],[90,90],[0,90],[0,0]],[[0,0],[0,90],[90,90],[89,0],[0,0]]]}"#;
const TWO: &str = r#"{"type":"GeometryCollection","geometries":[{"type":"LineString","coordinates":[[0,0],[9,9]]},{"type":"Polygon","coordinates":[[[0,0],[9,0],[9,9],[0,0]]]}]}"#;

fn folder(features: &[(&str, &str)]) -> Folder {
    Folder::new().with("r.json", roads(features))
}

/// A layer of that file with these lines.
fn layer(lines: &str) -> String {
    format!("{PLANE}[[layer]]\nsource = \"r.json\"\n{lines}\n")
}

fn drawn(folder: &Folder, lines: &str) -> Scene {
    folder.load(&layer(lines)).unwrap_or_else(|e| panic!("{lines}\n{e}")).0
}

fn numbers(scene: &Scene) -> Vec<usize> {
    scene.layers[0].features.iter().map(|feature| feature.index).collect()
}

fn widths(scene: &Scene) -> Vec<f64> {
    let layer = &scene.layers[0];
    let width = |line: Line| match line.width {
        Width::Metres(width) | Width::Pixels(width) => width,
    };
    layer.features.iter().filter_map(|feature| layer.style_of(feature).line.map(width)).collect()
}

/// What the notes say of conditions.
fn told(scene: &Scene) -> Vec<&str> {
    let notes = scene.notes.iter().filter(|note| note.contains("`where`"));
    notes.filter_map(|note| note.strip_prefix("layer `r`: ")).collect()
}

const BLACK: &str = "line = { color = \"#000000\", width_m = 1 }";

#[test]
fn each_value_has_its_colour_and_equal_looks_are_one_style() {
    let folder = folder(&[
        (LONG, r#""T":"b""#),
        (SHORT, r#""T":"a""#),
        (TWO, r#""T":"b""#),
        (LONG, ""),
        (SHORT, r#""T":"z""#),
        (LARGE, r#""T":"none that the map has""#),
    ]);
    let scene = drawn(
        &folder,
        "line = { color = { by = \"T\", map = { a = \"#ff0000\", b = \"#00ff0080\" }, default = \"#0000ff\" }, width_m = 1, opacity = 0.5 }\nfill = { color = \"#000000\" }",
    );
    let layer = &scene.layers[0];
    let styles: Vec<u32> = layer.features.iter().map(|feature| feature.style).collect();
    assert_eq!((numbers(&scene), styles), (vec![0, 1, 2, 2, 3, 4, 5], vec![0, 1, 0, 2, 3, 3, 2]));
    let colors: Vec<[f64; 4]> = layer.styles.iter().filter_map(|s| s.line.map(|line| line.color.0)).collect();
    assert_eq!(colors, [[0.0, 1.0, 0.0, 128.0 / 255.0 * 0.5], [1.0, 0.0, 0.0, 0.5], [0.0, 0.0, 1.0, 0.5]]);
    let fill = Fill { color: Color([0.0, 0.0, 0.0, 1.0]), rule: crate::scene::Rule::EvenOdd };
    assert_eq!(layer.styles[2], Style { fill: Some(fill), ..Style::default() });
}

#[test]
fn numbers_and_flags_are_keys_in_any_spelling() {
    let folder =
        folder(&[(LONG, r#""n":2"#), (LONG, r#""n":2.5"#), (LONG, r#""n":true"#), (LONG, r#""n":"2""#)]);
    let map =
        "line = { color = \"#000000\", width_m = { by = \"n\", map = { \"25e-1\" = 4, true = 5, 2 = 6 } } }";
    assert_eq!(widths(&drawn(&folder, map)), [6.0, 4.0, 5.0, 6.0]);
}

#[test]
fn stops_are_linear_between_and_constant_beyond() {
    let values = ["-3", "0", "1", "2.5", "4", "1e300"];
    let properties: Vec<String> = values.iter().map(|value| format!(r#""h":{value}"#)).collect();
    let features: Vec<(&str, &str)> = properties.iter().map(|p| (LONG, p.as_str())).collect();
    let folder = folder(&features);
    let scene = drawn(
        &folder,
        "line = { color = { by = \"h\", stops = [[0, \"#000000\"], [4, \"#ff000000\"]] }, width_m = { by = \"h\", stops = [[0, 10], [2, 20], [4, 0.5]] } }",
    );
    assert_eq!(widths(&scene), [10.0, 10.0, 15.0, 15.125, 0.5, 0.5]);
    let layer = &scene.layers[0];
    let quarter = layer.style_of(&layer.features[2]).line.unwrap().color;
    assert_eq!(quarter, Color([0.25, 0.0, 0.0, 0.75]));
    assert_eq!(layer.styles.len(), 4);
    let wide =
        "line = { color = \"#000000\", width_m = { by = \"h\", stops = [[-1.7e308, 1], [1.7e308, 3]] } }";
    let read = widths(&drawn(&folder, wide));
    assert!(read.iter().all(|width| (width - 2.0).abs() < 1e-6), "{read:?}");
}

#[test]
fn a_flag_that_a_map_does_not_cover_is_not_taken_for_a_slip() {
    let folder = folder(&[(LONG, r#""open":true"#)]);
    let lines = "line = { color = { by = \"open\", map = { True = \"#000000\" } }, width_m = 1 }";
    let error = folder.refused(&layer(lines)).to_string();
    assert!(
        error.contains("holds true") && error.contains("entries of flags are called `true` and `false`"),
        "{error}"
    );
    let lines = "line = { color = { by = \"open\", map = { true = \"#000000\" } }, width_m = 1 }";
    assert_eq!(numbers(&drawn(&folder, lines)), [0]);
}

#[test]
fn what_a_scale_does_not_cover_is_refused_by_file_feature_column_and_value() {
    let folder =
        folder(&[(LONG, r#""T":"primary","n":1"#), (LONG, r#""T":"secondry""#), (LONG, r#""n":"1""#)]);
    let color = |by: &str| format!("line = {{ color = {by}, width_m = 1 }}");
    for (lines, said) in [
        (
            color("{ by = \"T\", map = { primary = \"#000000\", secondary = \"#000000\" } }"),
            "r.json: feature 1: the column `T` holds \"secondry\", for which the map of `layer.r.line.color` has no entry, and there is no `default`",
        ),
        (
            color("{ by = \"T\", map = { primary = \"#000000\", secondary = \"#000000\" } }"),
            "did you mean `secondary`?",
        ),
        (
            color("{ by = \"T\", map = { primary = \"#000000\", secondry = \"#000000\" } }"),
            "feature 2: there is no value in the column `T`, and `layer.r.line.color` has no `default`",
        ),
        (
            color("{ by = \"T\", stops = [[0, \"#000000\"]], default = \"#000000\" }"),
            "feature 0: the column `T` holds \"primary\", and the stops of `layer.r.line.color` are for numbers",
        ),
        (
            color("{ by = \"n\", stops = [[0, \"#000000\"]] }"),
            "feature 1: there is no value in the column `n`, and `layer.r.line.color` has no `default`",
        ),
        (
            color("{ by = \"TT\", map = {}, default = \"#000000\" }"),
            "r.json: there is no column `TT`, which `layer.r` asks for",
        ),
        (color("{ by = \"t\", map = {}, default = \"#000000\" }"), "help: did you mean `T`?"),
        (color("{ by = \"CLASS\", map = {}, default = \"#000000\" }"), "help: known columns: T, n"),
        (format!("{BLACK}\nwhere = {{ CLASS = 1 }}"), "there is no column `CLASS`"),
        (format!("{BLACK}\norder = {{ by = \"CLASS\" }}"), "there is no column `CLASS`"),
        (
            format!("{BLACK}\nwhere = {{ n = {{ min = 0 }} }}"),
            "feature 2: the column `n` holds \"1\", and `layer.r.where` compares numbers",
        ),
    ] {
        let error = folder.refused(&layer(&lines)).to_string();
        assert!(error.contains(said), "{lines}\n{error}");
        let named = format!("named in {}:4:10", folder.path("s.toml").display());
        assert!(error.contains("r.json: ") && error.contains(&named), "{error}");
    }
}

#[test]
fn only_features_that_fulfil_all_conditions_are_drawn() {
    let folder = folder(&[
        (LONG, r#""T":"a","n":1,"f":true"#),
        (LONG, r#""T":"b","n":2,"f":true"#),
        (LONG, r#""T":"a","n":3.0,"f":false"#),
        (TWO, r#""T":"c","n":4,"f":null"#),
        (LONG, r#""T":"a""#),
    ]);
    for (conditions, kept) in [
        ("", vec![0, 1, 2, 3, 3, 4]),
        ("T = \"a\"", vec![0, 2, 4]),
        ("T = [\"a\", \"c\"]", vec![0, 2, 3, 3, 4]),
        ("n = [1, 3]", vec![0, 2]),
        ("n = 3.0", vec![2]),
        ("f = true", vec![0, 1]),
        ("n = { min = 2, max = 3 }", vec![1, 2]),
        ("n = { above = 2, below = 4 }", vec![2]),
        ("T = \"a\", n = { min = 1 }", vec![0, 2]),
    ] {
        let scene = drawn(&folder, &format!("{BLACK}\nwhere = {{ {conditions} }}"));
        assert_eq!((numbers(&scene), told(&scene).len()), (kept, 0), "{conditions}");
    }
}

#[test]
fn conditions_that_nothing_fulfils_are_told() {
    let folder = folder(&[(LONG, r#""T":"primary""#), (LONG, r#""T":"secondary""#)]);
    let scene = drawn(&folder, &format!("{BLACK}\nwhere = {{ T = [\"primary\", \"secundary\"] }}"));
    let note = "`where`: no feature has \"secundary\" in the column `T`; did you mean \"secondary\"?";
    assert_eq!((numbers(&scene), told(&scene)), (vec![0], vec![note]));
    let by_map = "line = { color = \"#000000\", width_m = { by = \"T\", map = { x = 1 } } }";
    let scene = drawn(&folder, &format!("{by_map}\nwhere = {{ T = 3 }}"));
    assert_eq!(told(&scene)[1], "none of its 2 features fulfils `where`");
    assert_eq!((scene.layers[0].features.len(), scene.layers[0].styles.len()), (0, 1));
}

#[test]
fn order_is_by_key_and_the_files_among_equals() {
    let folder = folder(&[
        (LONG, r#""n":2"#),
        (LARGE, r#""n":"x""#),
        (SHORT, ""),
        (SMALL, r#""n":-1.5"#),
        (RING, r#""n":2.0"#),
        (LONG, r#""n":true"#),
    ]);
    for (order, drawn_order) in [
        ("\"file\"", [0, 1, 2, 3, 4, 5]),
        ("\"size\"", [4, 3, 1, 2, 0, 5]),
        ("{ by = \"area\" }", [0, 2, 5, 4, 3, 1]),
        ("{ by = \"area\", descending = true }", [1, 3, 4, 0, 2, 5]),
        ("{ by = \"length\" }", [3, 2, 0, 5, 1, 4]),
        ("{ by = \"n\" }", [2, 5, 3, 0, 4, 1]),
        ("{ by = \"n\", descending = true }", [2, 1, 0, 4, 3, 5]),
    ] {
        let scene = drawn(&folder, &format!("{BLACK}\nfill = {{ color = \"#000000\" }}\norder = {order}"));
        assert_eq!(numbers(&scene), drawn_order, "{order}");
    }
}

#[test]
fn features_of_the_scene_file_and_of_generators_have_columns_too() {
    let text = format!(
        "{PLANE}[[layer]]\nname = \"a\"\nline = {{ color = {{ by = \"c\", map = {{ x = \"#ff0000\" }} }}, width_m = 1 }}\nwhere = {{ c = \"x\" }}
        features = [{{ line = [[0, 0], [1, 1]], properties = {{ c = \"y\" }} }}, {{ line = [[0, 0], [1, 1]], properties = {{ c = \"x\" }} }}, {{ line = [[0, 0], [1, 1]] }}]
        [[layer]]\nname = \"b\"\ngenerate = {{ kind = \"mosaic\", count = 60 }}\nfill = {{ color = {{ by = \"class\", stops = [[0, \"#000000\"], [5, \"#ffffff\"]] }} }}
        where = {{ class = {{ max = 4 }} }}"
    );
    let (scene, _) = Folder::new().load(&text).unwrap();
    assert_eq!(numbers(&scene), [1]);
    let styles = &scene.layers[1].styles;
    assert!(styles.len() == 5 && (20..60).contains(&scene.layers[1].features.len()), "{}", styles.len());
    let said = Folder::new().refused(&text.replace("c = \"x\" }\n", "d = 1 }\n")).to_string();
    assert!(said.contains("s.toml: there is no column `d`, which `layer.a` asks for"), "{said}");
    let said = Folder::new().refused(&text.replace("class = { max", "klass = { max")).to_string();
    assert!(said.contains("help: did you mean `class`?"), "{said}");
}

#[test]
fn a_mosaics_column_tells_the_class_that_a_layer_may_keep() {
    let features = |lines: &str| {
        let text = format!("{PLANE}[[layer]]\n{lines}\nfill = {{ color = \"#000000\" }}");
        Folder::new().load(&text).unwrap().0.layers[0]
            .features
            .iter()
            .map(|f| f.shape.clone())
            .collect::<Vec<_>>()
    };
    for class in 0..6 {
        let kept = features(&format!("generate = {{ kind = \"mosaic\", count = 60, class = [{class}, 6] }}"));
        let told = features(&format!(
            "generate = {{ kind = \"mosaic\", count = 60 }}\nwhere = {{ class = {class} }}"
        ));
        assert!(kept == told && !kept.is_empty(), "{class}");
    }
}

#[test]
fn two_keys_of_a_map_that_are_one_number_are_refused_where_a_feature_has_it_and_two_texts_are_two() {
    let folder = folder(&[(LONG, r#""T":2.5"#), (LONG, r#""T":"2.50""#)]);
    let map = "map = { \"2.5\" = 1, \"2.50\" = 3 }";
    let line =
        |map: &str| layer(&format!("line = {{ color = \"#000000\", width_m = {{ by = \"T\", {map} }} }}"));
    let error = folder.refused(&line(map));
    assert!(
        error.what().contains("`2.5` and `2.50` in the map of `layer.r.line.width_m` are one number, 2.5"),
        "{error}"
    );
    let texts = self::folder(&[(LONG, r#""T":"2.5""#), (LONG, r#""T":"2.50""#)]);
    assert_eq!(widths(&texts.load(&line(map)).unwrap().0), [1.0, 3.0]);
}

#[test]
fn a_layer_without_a_name_is_called_by_its_number_as_in_errors_of_the_scene_file() {
    let scene = format!("{PLANE}[[layer]]\nfeatures = [{{ line = [[0, 0]] }}]\n{BLACK}\n");
    assert!(Folder::new().refused(&scene).what().starts_with("`layer.0.features.0`"));
}

#[test]
fn vectors_are_no_terrain() {
    let folder = folder(&[(LONG, "")]);
    let error = folder.refused("terrain = { source = \"r.json\" }\n");
    assert!(
        error.what().contains("one of vectors") && error.help_text().unwrap().contains("[[layer]]"),
        "{error}"
    );
}
