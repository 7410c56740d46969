//! The scene file as people write it, rightly and wrongly.

mod by_column;

use super::*;
use crate::parameter::{Shape as KeyShape, TableShape};
use crate::scene::{Attribute, Color, Join, Projection};
use crate::technique::{inverse_projection, stencil_volume};
use glam::DVec3;
use proptest::prelude::*;

/// Every key of the description at least once, over several files.
pub(super) const EVERY_KEY: [&str; 6] = [
    r##"
schema = 1
name = "all"
crs = "EPSG:32733"
[image]
width = 64
height = 48
background = "#ffffff80"
[camera]
eye = [-4200.0, -3900.0, 2600]
target = [0, 0, 900.0]
up = [0.0, 0.0, 1.0]
projection = "perspective"
fov_y_deg = 45.0
near_m = 1.0
far_m = 1e5
[terrain]
source = "dem.png"
window = [0, 0, 10, 10]
offset = [1, 2]
crs = "EPSG:4326"
bounds = [0, 0, 1, 1]
encoding = "terrarium"
band = 1
nodata = -9999.0
diagonal = "alternating"
lod = { error_px = 1.5, borrow = 0.25 }
vertical_scale = 1.5
color = "#c8b89a"
shade = "hillshade"
light = { azimuth_deg = 200, elevation_deg = 30.5 }
[[layer]]
name = "lakes"
source = "data/lakes.gpkg"
layer = "water"
crs = "EPSG:4326"
edges = "straight"
offset = [5, 6]
opacity = 0.8
fill = { color = "#3388ff", opacity = 0.5, rule = "nonzero" }
outline = { color = "#003366", opacity = 1, width_m = 4.0, mode = "inset", join = "miter", miter_limit = 2, dash = [9, 3.5], dash_offset = 1, cap = "round" }
[[layer]]
source = "roads.shp"
line = { color = "#ff7f00", opacity = 1.0, width_m = 12.0, join = "miter", miter_limit = 3, cap = "round", dash = [10, 5, 1, 5], dash_offset = -2.5 }
[[layer]]
features = [{ polygon = [[0, 0], [4, 0], [0, 3]] }, { line = [[0, 0], [1, 1]] }, { points = [[1, 2]] }]
outline = { color = "#003366", width_px = 2 }
line = { color = "#ff7f00", width_px = 3 }
[[layer]]
generate = { kind = "roads", seed = 1, count = 10, window = [0, 0, 9, 9], segment_m = 5 }
line = { color = "#ff7f00", width_px = 3 }
[[layer]]
generate = { kind = "mosaic", class = [0, 3], holes = 0.2 }
fill = { color = "#112233", invert = true }
[[layer]]
generate = { kind = "case-study", study = "graz", group = "roads", scale = 0.25, seed = 9 }
line = { color = "#112233", width_m = 3 }
[technique.clipmap]
virtual_size = 4096
clip_size = 512
center = [10, 20.5]
cache_mib = 64
texel = "unorm8"
solution = "3b-wireframe"
joints = "method-3a-strip"
angle_deg = 60
threshold_texels = 2
lines = "prefiltered"
line_filter = "cone"
wide_lines = "clamp"
polygons = "exact"
overlaps = "once"
offsets = "polar"
pixel_width = "texels"
filter = "trilinear"
anisotropy = 16
level_bias = -0.5
[technique.inverse-projection]
samples = 5
corners = "true"
point_in_polygon = "winding"
silhouette = "smear"
[technique.stencil-volume]
method = "z-fail"
overflow = "saturate"
far = "clip"
caps = "bottom"
joins = "style"
grouping = "color"
samples = 4
object = 2
[compositing]
space = "linear"
mode = "additive"
[technique.geometry-overlay]
lines = "antialiased"
polygons = "filled"
widths = "one"
offset_factor = 0.5
offset_units = 2
stipple = 255
stipple_factor = 2
primitives = "strips"
borrowed = "searched"
tolerance_px = 0.5
[device]
precision = "f32"
position = "relative-to-eye"
subpixel_bits = 8
depth = "unorm24"
stencil_bits = 4
max_line_width_px = 7.5
filter_bits = 8
level_bits = 8
interpolation = "unsnapped"
"##,
    r#"
schema = 1
camera = { eye_geo = [15, -22, 3000], target_geo = [15.1, -22, 900], projection = "orthographic", height_m = 9e3 }
terrain = { source = "dem.tif", imagery = "ortho.png", shade = "hillshade" }
"#,
    r#"
schema = 1
terrain = { generate = { kind = "ramp", slope_deg = 20, posts = [9, 9], cell_m = 10, height_m = 5 } }
"#,
    r#"
schema = 1
terrain = { generate = { kind = "fbm", seed = 3, wavelength_m = 900, octaves = 5 }, diagonal = "alternating", lod = { level = 3 } }
"#,
    r##"
schema = 1
terrain.generate = { kind = "plane" }
[[layer]]
name = "land"
features = [{ polygon = [[0, 0], [4, 0], [0, 3]], properties = { CLASS = "wood", depth = 2, "is wet" = true, "" = 0.5 } }]
fill = { color = { by = "CLASS", map = { wood = "#228b22", "2.50" = "#0000ff80" }, default = "#808080" }, opacity = { by = "depth", stops = [[0, 0.5], [10.5, 1]] } }
outline = { color = { by = "depth", stops = [[-1, "#000000"], [2, "#ffffff"]], default = "#ff0000" }, opacity = { by = "a", map = { x = 0.5 }, default = 1 }, width_px = { by = "depth", stops = [[0, 1]], default = 3 } }
line = { color = "#000000", opacity = { by = "a", map = {}, default = 0.5 }, width_m = { by = "lanes", map = { 1 = 3, 2 = 6.5 }, default = 4 } }
where = { CLASS = ["wood", "meadow", 3], depth = { min = 0, max = 20 }, lanes = { above = 1, below = 4.5 }, "is wet" = true, name = "A1" }
order = { by = "depth", descending = true }
[[layer]]
source = "b.shp"
outline = { color = "#000000", width_m = { by = "lanes", stops = [[1, 3], [2, 9]] } }
line = { color = { by = "kind", map = { a = "#000000" } }, width_px = { by = "lanes", map = { 1 = 3 }, default = 1 } }
order = "size"
"##,
    r##"
schema = 1
plan = "globe"
terrain.generate = { kind = "cone", cell_deg = 0.5 }
"##,
];

const CONE: &str = "schema = 1\nterrain.generate = { kind = \"cone\", radius_m = 100 }\n";

fn parse(text: &str) -> Result<SceneFile> {
    SceneFile::parse(text, Some(Path::new("dir/scene.toml")), &[])
}

/// The message for a scene with these lines after a terrain.
fn refusal(lines: &str) -> String {
    let text = format!("{CONE}{lines}");
    parse(&text).expect_err(lines).to_string()
}

fn with(text: &str, overrides: &[&str]) -> Result<SceneFile> {
    let overrides: Result<Vec<_>> = overrides.iter().map(|o| Override::parse(o)).collect();
    SceneFile::parse(text, Some(Path::new("dir/scene.toml")), &overrides?)
}

fn inverse_projection(scene: &SceneFile) -> inverse_projection::Settings {
    scene.technique.get()
}

fn layer(lines: &str) -> String {
    refusal(&format!("[[layer]]\nsource = \"a.shp\"\n{lines}\n"))
}

/// The table in a shape, and how the names of its keys begin: those of a map's values with `*` for the map's keys.
fn table_in(shape: KeyShape) -> Option<(&'static TableShape, &'static str)> {
    match shape {
        KeyShape::Table(inner) | KeyShape::Tables(inner) | KeyShape::OrTable(_, inner) => Some((inner, "")),
        KeyShape::Map(values) => table_in(*values).map(|(inner, _)| (inner, "*.")),
        _ => None,
    }
}

/// Adds the dotted names of all keys of a description.
fn described(shape: &TableShape, path: &str, names: &mut Vec<String>) {
    for key in shape.keys {
        let name = format!("{path}{}", key.name);
        if let Some((inner, start)) = table_in(key.shape) {
            described(inner, &format!("{name}.{start}"), names);
        }
        names.push(name);
    }
}

fn in_schema(value: &serde_json::Value, path: &str, names: &mut Vec<String>) {
    for (key, value) in value["properties"].as_object().into_iter().flatten() {
        let name = format!("{path}{key}");
        in_schema(value, &format!("{name}."), names);
        names.push(name);
    }
    for inner in value["anyOf"].as_array().into_iter().flatten().chain([&value["items"]]) {
        if inner.is_object() {
            in_schema(inner, path, names);
        }
    }
    if value["additionalProperties"].is_object() {
        in_schema(&value["additionalProperties"], &format!("{path}*."), names);
    }
}

fn written(value: &Value, shape: &TableShape, path: &str, names: &mut Vec<String>) {
    match value {
        Value::Table(table) => {
            for entry in &table.0 {
                let Some(key) = shape.key(&entry.key) else { continue };
                let name = format!("{path}{}", entry.key);
                match (table_in(key.shape), &entry.node.value) {
                    (Some((inner, "*.")), Value::Table(tree::Table(entries))) => entries
                        .iter()
                        .for_each(|entry| written(&entry.node.value, inner, &format!("{name}.*."), names)),
                    (Some((inner, _)), value) => written(value, inner, &format!("{name}."), names),
                    (None, _) => {}
                }
                names.push(name);
            }
        }
        Value::Array(items) => items.iter().for_each(|item| written(&item.value, shape, path, names)),
        _ => {}
    }
}

fn sorted(mut names: Vec<String>) -> Vec<String> {
    names.sort();
    names.dedup();
    names
}

#[test]
fn schema_and_parser_know_the_same_keys() {
    let (mut of_parser, mut of_schema) = (Vec::new(), Vec::new());
    described(&keys::ROOT, "", &mut of_parser);
    in_schema(&schema(), "", &mut of_schema);
    assert_eq!(sorted(of_parser), sorted(of_schema));
}

/// Scenes in which each setting of a style is told by a column, by both kinds of scale.
fn by_column() -> Vec<String> {
    let paint = [("color", "\"#000000\""), ("opacity", "1")];
    let metres = [("color", "\"#000000\""), ("opacity", "1"), ("width_m", "2")];
    let pixels = [("color", "\"#000000\""), ("opacity", "1"), ("width_px", "2")];
    let parts = [
        ("fill", &paint[..]),
        ("outline", &metres),
        ("outline", &pixels),
        ("line", &metres),
        ("line", &pixels),
        ("point", &metres),
        ("point", &pixels),
    ];
    let scene = |(part, settings): &(&str, &[(&str, &str)]), scale: &dyn Fn(&str) -> String| {
        let setting = |(key, value): &(&str, &str)| {
            format!("{key} = {{ by = \"a\", {}, default = {value} }}", scale(value))
        };
        let settings: Vec<String> = settings.iter().map(setting).collect();
        format!("{CONE}[[layer]]\nsource = \"a.shp\"\n{part} = {{ {} }}\n", settings.join(", "))
    };
    let map = |value: &str| format!("map = {{ x = {value} }}");
    let stops = |value: &str| format!("stops = [[0, {value}]]");
    parts.iter().flat_map(|part| [scene(part, &map), scene(part, &stops)]).collect()
}

#[test]
fn every_described_key_is_read_somewhere() {
    // `Section::read` refuses a key that nobody takes, so that a key written in a scene that parses is read. (Parameters of techniques
    // are read as they are declared: tests/parameters.rs.)
    let (mut of_parser, mut of_scenes) = (Vec::new(), Vec::new());
    described(&keys::ROOT, "", &mut of_parser);
    let by_column = by_column();
    for text in EVERY_KEY.into_iter().chain([CONE]).chain(by_column.iter().map(String::as_str)) {
        parse(text).unwrap_or_else(|error| panic!("{error}\n{text}"));
        let origin = Origin { text, path: None };
        written(&tree::parse(&origin).unwrap().value, &keys::ROOT, "", &mut of_scenes);
    }
    of_parser.retain(|name| !name.starts_with("technique."));
    of_scenes.retain(|name| !name.starts_with("technique."));
    assert_eq!(sorted(of_parser), sorted(of_scenes));
}

#[test]
fn values_arrive_where_they_belong() {
    let scene = parse(EVERY_KEY[0]).unwrap();
    assert_eq!((scene.name.as_str(), scene.image.width, scene.image.height), ("all", 64, 48));
    assert_eq!(scene.camera.projection, Projection::Perspective { fov_y_deg: 45.0 });
    assert_eq!(scene.camera.far_m, Some(1e5));
    assert_eq!(scene.terrain.offset, DVec3::new(1.0, 2.0, 0.0));
    let raised = parse(&format!("{CONE}terrain.offset = [1, -2, 3.5]")).unwrap();
    assert_eq!(raised.terrain.offset, DVec3::new(1.0, -2.0, 3.5));
    let lakes = &scene.layers[0];
    let fill = lakes.style.fill.as_ref().unwrap();
    assert_eq!(fill.paint.opacity, StyleSetting::Constant(0.5));
    let outline = lakes.style.outline.as_ref().unwrap();
    assert_eq!(outline.line.join, Join::Miter { limit: 2.0 });
    assert_eq!(scene.layers[1].name, "roads");
    let line = scene.layers[1].style.line.as_ref().unwrap();
    assert_eq!(line.width, WidthSpec::Metres(StyleSetting::Constant(12.0)));
    assert_eq!(inverse_projection(&scene).samples, 5);
    let volumes: stencil_volume::Settings = scene.technique.get();
    assert_eq!((volumes.samples, volumes.object), (4, Some(2)));
    assert_eq!(scene.device.subpixel_bits, 8);
}

#[test]
fn a_minimal_scene_has_the_contracts_defaults() {
    let scene = parse(CONE).unwrap();
    assert_eq!(scene.name, "scene");
    assert_eq!(scene.camera.view, None);
    assert_eq!(scene.camera.near_m, 1.0);
    assert_eq!(scene.device, crate::scene::Device::default());
    assert!(scene.layers.is_empty());
}

#[test]
fn the_default_scene_is_right() {
    let scene = SceneFile::parse(DEFAULT_SCENE, None, &[]).unwrap();
    assert_eq!(scene.name, "valley");
    assert!(scene.layers.len() > 5 && scene.camera.view.is_some());
}

#[test]
fn paths_start_at_the_scene_files_folder() {
    let LayerSource::File { file, layer } = &parse(EVERY_KEY[0]).unwrap().layers[0].source else {
        panic!("no file")
    };
    assert_eq!(file.path, Path::new("dir/data/lakes.gpkg"));
    assert_eq!((file.written.as_str(), layer.as_deref()), ("data/lakes.gpkg", Some("water")));
    assert_eq!(file.position.map(|at| (at.line, at.column)), Some((34, 10)));
}

#[test]
fn a_polygon_is_one_ring_or_several_by_depth_and_loses_its_closing_vertex() {
    let text = format!(
        "{CONE}[[layer]]\nfill = {{ color = \"#000000\" }}\nfeatures = [\n{{ polygon = [[0,0],[4,0],[0,3],[0,0]] }},\n\
         {{ polygon = [[[0,0],[9,0],[0,9]],[[1,1],[2,1],[1,2]]] }}, {{ line = [[[0,0],[1,1]],[[5,5],[6,6]]] }}]"
    );
    let LayerSource::Inline(features) = parse(&text).unwrap().layers.remove(0).source else {
        panic!("not inline")
    };
    let lengths = |feature: &InlineFeature| feature.shape.parts().map(Vec::len).collect();
    let lengths: Vec<Vec<usize>> = features.iter().map(lengths).collect();
    assert_eq!(lengths, [vec![3], vec![3, 3], vec![2, 2]]);
}

#[test]
fn an_unknown_key_is_refused_with_its_place_and_the_nearest_known_one() {
    assert_eq!(
        layer("line = { color = \"#ff7f00\", width = 3 }"),
        "dir/scene.toml:5:29: there is no key `layer.0.line.width`\n  help: did you mean `width_m`?"
    );
    assert_eq!(
        refusal("[camra]\neye = [0, 0, 0]"),
        "dir/scene.toml:3:2: there is no key `camra`\n  help: did you mean `camera`?"
    );
}

#[test]
fn a_wrong_type_says_what_was_expected_and_found() {
    for (lines, said) in [
        (
            "image.width = \"wide\"",
            "3:15: `image.width` must be a whole number from 1 to 65536; found the string \"wide\"",
        ),
        ("image.width = 3.0", "found 3.0"),
        ("name = 3", "3:8: `name` must be a string that is not empty; found 3\n  help: put it in quotes"),
        ("name = \"\"", "found the string \"\""),
        ("image = 3", "3:9: `image` must be a table; found 3"),
        ("layer = 3", "3:9: `layer` must be an array of tables; found 3"),
        ("layer = [3]", "3:10: `layer.0` must be a table; found 3"),
        ("[layer]\nname = \"a\"", "3:1: `layer` must be an array of tables; found a table"),
        (
            "camera.eye = [1, 2]",
            "3:14: `camera.eye` must be an array of 3 finite numbers; found an array of 2",
        ),
        (
            "camera.eye = [1, 2, \"3\"]",
            "3:21: `camera.eye.2` must be a finite number; found the string \"3\"",
        ),
        ("camera.up = 2026-01-01", "found a date"),
        ("camera.projection = \"ortographic\"", "did you mean \"orthographic\"?"),
        (
            "technique.clipmap.center = \"automtic\"",
            "3:28: `technique.clipmap.center` must be an array of 2 finite numbers or \"automatic\"; found the string \"automtic\"\n  \
             help: did you mean \"automatic\"?",
        ),
        ("technique.clipmap.center = [1, 2, 3]", "must be an array of 2 finite numbers; found an array of 3"),
        (
            "technique.stencil-volume.object = -1",
            "must be a whole number from 0 to 4294967295 or \"all\"; found -1",
        ),
        ("technique.inverse-projection.corners = true", "or \"true\"; found true\n  help: put it in quotes"),
        (
            "image.background = \"whitish\"",
            "must be a colour of CSS (\"#rrggbb\", \"#rrggbbaa\", \"#rgb\", a name, rgb(), hsl())",
        ),
    ] {
        let error = refusal(lines);
        assert!(error.contains(said), "{lines}\n{error}");
    }
}

#[test]
fn numbers_out_of_range_are_refused_at_the_number() {
    for (lines, place) in [
        ("image.width = 0", "3:15"),
        ("image.width = 65537", "3:15"),
        ("image.height = -1", "3:16"),
        ("image.width = 99999999999999999999999999999999999999999999", "3:15"),
        ("image = { width = 65536, height = 4097 }", "3:35"),
        ("camera.fov_y_deg = 180", "3:20"),
        ("camera.fov_y_deg = 0.0", "3:20"),
        ("camera.near_m = 0", "3:17"),
        ("camera.near_m = nan", "3:17"),
        ("camera = { near_m = 5, far_m = 5 }", "3:32"),
        ("camera.far_m = inf", "3:16"),
        ("camera.far_m = 1e999", "3:16"),
        ("device.subpixel_bits = 5", "3:24"),
        ("device.stencil_bits = 17", "3:23"),
        ("technique.inverse-projection.samples = 65", "3:40"),
        ("camera = { eye_geo = [0, 91, 0], target_geo = [0, 0, 0] }", "3:22"),
    ] {
        let error = refusal(lines);
        assert!(error.starts_with(&format!("dir/scene.toml:{place}: ")), "{lines}\n{error}");
    }
}

#[test]
fn widths_opacities_and_limits_are_checked() {
    for (lines, said) in [
        (
            "line = { color = \"#ff0000\", width_m = 0 }",
            "5:39: `layer.0.line.width_m` must be a finite number greater than 0",
        ),
        (
            "line = { color = \"#ff0000\", width_m = 1, width_px = 2 }",
            "5:42: `layer.0.line.width_m` and `width_px` exclude",
        ),
        ("line = { color = \"#ff0000\" }", "5:8: `layer.0.line` needs `width_m` or `width_px`"),
        ("line = { width_m = 1 }", "5:8: `layer.0.line.color` is missing"),
        (
            "fill = { color = \"#ff0000\", opacity = 1.5 }",
            "5:39: `layer.0.fill.opacity` must be a number from 0 to 1",
        ),
        ("line = { color = \"#ff0000\", width_m = 1, join = \"miter\", miter_limit = 0.5 }", "5:72"),
        ("line = { color = \"#ff0000\", width_m = 1, miter_limit = 2 }", "goes with join = \"miter\" only"),
        ("", "3:1: `layer.0` needs `fill` or `outline` or `line`"),
    ] {
        let error = layer(lines);
        assert!(error.contains(said), "{lines}\n{error}");
    }
}

#[test]
fn a_camera_without_a_picture_is_refused() {
    for (lines, said) in [
        (
            "camera = { eye = [1, 2, 3], target = [1, 2, 3] }",
            "3:38: `camera.eye` and `camera.target` are the same point",
        ),
        ("camera = { eye = [1, 2, 3], target = [1, 2, 0] }", "parallel to the direction of view"),
        (
            "camera = { eye = [1, 2, 3], target = [9, 2, 0], up = [0, 0, 0] }",
            "3:54: `camera.up` has no direction",
        ),
        ("camera.up = [0, 0, 0]", "3:13: `camera.up` has no direction"),
        ("camera.eye = [1, 2, 3]", "3:14: `camera` has an eye and no target"),
        ("camera = { eye = [1, 2, 3], eye_geo = [1, 2, 3] }", "exclude each other"),
        ("camera.height_m = 5", "goes with projection = \"orthographic\" only"),
        ("camera.projection = \"orthographic\"", "needs `height_m`"),
    ] {
        let error = refusal(lines);
        assert!(error.contains(said), "{lines}\n{error}");
    }
}

#[test]
fn a_view_is_judged_whatever_its_size() {
    let far = DVec3::splat(f64::MAX);
    assert!(check_view(far, -far, DVec3::Z).is_ok());
    assert!(check_view(DVec3::splat(f64::MIN_POSITIVE), DVec3::ZERO, DVec3::Z * 1e300).is_ok());
    assert!(check_view(DVec3::ZERO, DVec3::Z, DVec3::Z * -1e-300).is_err());
}

#[test]
fn a_terrain_has_one_origin_and_its_own_keys() {
    for (text, said) in [
        ("schema = 1", "1:1: `terrain` is missing"),
        ("schema = 1\n[terrain]", "2:1: `terrain` needs `source` or `generate`"),
        ("schema = 1\nterrain = { source = \"a\", generate = { kind = \"plane\" } }", "exclude each other"),
        ("schema = 1\nterrain = { source = \"a\", window = [1, 0, 1, 5] }", "`window` is empty"),
        (
            "schema = 1\nterrain = { source = \"a\", window = [-1e308, 0, 1e308, 5] }",
            "`window` is larger than",
        ),
        (
            "schema = 1\nterrain = { generate = { kind = \"plane\" }, window = [0, 0, 1, 5] }",
            "goes with a `source`",
        ),
        ("schema = 1\nterrain.generate = { kind = \"plane\", slope_deg = 3 }", "has no `slope_deg`"),
        ("schema = 1\nterrain.generate = { kind = \"fbm\", posts = [32768, 16384] }", "at most 2^28"),
        ("schema = 1\nterrain.generate = { kind = \"alps\" }", "must be \"plane\" or \"ramp\""),
    ] {
        let error = parse(text).expect_err(text).to_string();
        assert!(error.contains(said), "{text}\n{error}");
    }
}

#[test]
fn another_schema_number_says_which_one_this_program_reads() {
    let error = parse("schema = 2\nsomething = 1").unwrap_err();
    assert_eq!(error.what(), "`schema` must be 1; found 2");
    assert!(error.help_text().is_some_and(|help| help.contains("reads schema 1")));
    let missing = parse("terrain.source = \"x\"").unwrap_err();
    assert_eq!(missing.what(), "`schema` is missing");
}

#[test]
fn a_generated_layer_has_the_keys_of_its_kind_alone() {
    for (generator, said) in [
        (r#"kind = "roads", holes = 0.5"#, "`holes` goes with kind = \"mosaic\" only"),
        (r#"kind = "mosaic", segment_m = 5"#, "`segment_m` goes with kind = \"roads\" or \"paths\" only"),
        (r#"kind = "parcels", study = "rc""#, "`study` goes with kind = \"case-study\" only"),
        (r#"kind = "case-study", study = "rc", count = 5"#, "`count` goes with other kinds"),
        (r#"kind = "case-study""#, "goes with a `study`\n"),
        (r#"kind = "case-study", study = "austria""#, "must be \"il\" or"),
        (r#"kind = "case-study", study = "rc", scale = 9"#, "`layer.0.generate.scale`"),
        (r#"kind = "case-study", study = "rc", group = "floods""#, "study `rc` has no group `floods`"),
    ] {
        let text = format!(
            "schema = 1\nterrain.generate = {{ kind = \"plane\" }}\n[[layer]]\ngenerate = {{ {generator} }}\nfill = {{ color = \"#123\" }}"
        );
        let error = parse(&text).expect_err(&text).to_string();
        assert!(error.contains(said), "{generator}\n{error}");
    }
}

#[test]
fn two_layers_of_one_name_are_refused() {
    let error = layer(
        "fill = { color = \"#000000\" }\n[[layer]]\nsource = \"b/a.fgb\"\nfill = { color = \"#000000\" }",
    );
    assert!(error.contains("6:1: two layers are called `a`"), "{error}");
}

#[test]
fn the_first_error_in_file_order_is_told() {
    let error = refusal("[device]\nstencil_bits = 0\n[image]\nwidth = 0");
    assert!(error.contains(":4:16:"), "{error}");
}

#[test]
fn overrides_change_tables_arrays_and_named_layers() {
    let scene = with(
        EVERY_KEY[0],
        &[
            "camera.eye=[1,2,3]",
            "camera.target.2 = 5",
            "technique.inverse-projection.samples=2",
            "layer.0.fill.color=#ff0000",
            "layer.roads.line.width_m=",
            "layer.roads.line.width_px=2.5",
            "name=night view",
        ],
    )
    .unwrap();
    let view = scene.camera.view.unwrap();
    assert_eq!(
        (view.eye, view.target),
        (Spot::Plan(DVec3::new(1.0, 2.0, 3.0)), Spot::Plan(DVec3::new(0.0, 0.0, 5.0)))
    );
    assert_eq!(inverse_projection(&scene).samples, 2);
    let fill = scene.layers[0].style.fill.as_ref().unwrap();
    assert_eq!(fill.paint.color, StyleSetting::Constant(Color([1.0, 0.0, 0.0, 1.0])));
    let line = scene.layers[1].style.line.as_ref().unwrap();
    assert_eq!(line.width, WidthSpec::Pixels(StyleSetting::Constant(2.5)));
    assert_eq!(scene.name, "night view");
}

#[test]
fn an_override_makes_the_tables_that_are_missing() {
    let scene = with(CONE, &["technique.inverse-projection.samples=7", "image={width=5,height=6}"]).unwrap();
    assert_eq!((inverse_projection(&scene).samples, scene.image.width), (7, 5));
}

#[test]
fn an_error_in_an_override_names_the_override() {
    for (change, said) in [
        (
            "image.widht=3",
            "override `image.widht=3`: there is no key `image.widht`\n  help: did you mean `width`?",
        ),
        ("camra.eye=3", "there is no key `camra`"),
        (
            "image.width=0",
            "override `image.width=0`: `image.width` must be a whole number from 1 to 65536; found 0",
        ),
        ("image.width.x=0", "64 has no part `x`"),
        ("layer.9.name=a", "there is no number 9: there are 6, counted from 0"),
        ("layer.roda.name=a", "help: did you mean `roads`?"),
        ("layer.lake.name=a", "help: did you mean `lakes`?"),
        ("image.wall=", "there is no `wall` to remove"),
        ("image.width", "there is no `=`"),
        ("=3", "not a dotted path"),
        ("a..b=3", "not a dotted path"),
    ] {
        let error = with(EVERY_KEY[0], &[change]).expect_err(change).to_string();
        assert!(error.contains(said) && !error.contains("scene.toml"), "{change}\n{error}");
    }
}

#[test]
fn text_that_is_not_toml_is_refused_where_it_stops_being_so() {
    let error = parse("schema = 1\nname = \"a\nb\"").unwrap_err();
    assert!(error.what().starts_with("this is not TOML"), "{error}");
    assert_eq!(error.position().map(|at| at.line), Some(2));
    assert!(parse("schema = 1\nschema = 1").unwrap_err().to_string().contains("2:1"));
}

#[test]
fn deep_nesting_is_refused_not_a_crash() {
    for deep in
        ["x = ".to_string() + &"[".repeat(200_000), format!("[a{}]", ".a".repeat(100_000)), "{".repeat(9999)]
    {
        assert!(parse(&deep).is_err());
    }
    let change = format!("a{}=1", ".a".repeat(50_000));
    assert!(with(CONE, &[&change]).is_err());
}

#[test]
fn bytes_that_are_no_text_are_refused_with_their_place() {
    let error = decode(b"schema = 1\nname = \"\xff\"".to_vec(), Path::new("s.toml")).unwrap_err();
    assert!(error.to_string().starts_with("s.toml:2:9: a scene file is UTF-8 text"), "{error}");
}

#[test]
fn a_missing_file_and_a_folder_are_named() {
    for path in ["no/such.toml", "."] {
        let error = SceneFile::read(Path::new(path), &[]).unwrap_err();
        assert!(error.to_string().starts_with(&format!("{path}: this scene file cannot be read")), "{error}");
    }
}

proptest! {
    #[test]
    fn random_text_never_panics(text in "\\PC*") {
        let _ = parse(&text);
        let _ = with(CONE, &[&text]);
    }

    #[test]
    fn scenes_with_random_changes_never_panic(
        which in 0..EVERY_KEY.len(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), "[\\PC\n]{0,3}", 0..4usize), 1..6),
    ) {
        let mut text: Vec<char> = EVERY_KEY[which].chars().collect();
        for (at, put, removed) in changes {
            let at = at.index(text.len() + 1);
            text.splice(at..(at + removed).min(text.len()), put.chars());
        }
        let result = parse(&text.into_iter().collect::<String>());
        prop_assert!(result.is_ok() || result.is_err_and(|error| !error.is_internal()));
    }

    #[test]
    fn random_values_of_known_keys_never_panic(
        key in prop::sample::select({
            let mut names = Vec::new();
            described(&keys::ROOT, "", &mut names);
            names
        }),
        value in prop::sample::select(vec!["0", "-1", "1e308", "[]", "{}", "[[]]", "[[[]]]", "\"\"", "true", "", "[1,2,3]", "[0,0]", "\"x\"", "[{}]"]),
    ) {
        let path = key.replace("layer.", "layer.0.").replace("features.", "features.0.").replace('*', "a");
        let result = with(EVERY_KEY[0], &[&format!("{path}={value}")]);
        prop_assert!(result.is_ok() || result.is_err_and(|error| !error.is_internal()));
    }
}
