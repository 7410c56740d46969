//! Each sample against the footprint, which knows no cell and no tree; and pictures that must not depend on the structures.

use crate::canvas::{Frame, FrameOptions};
use crate::sampling;
use crate::scene_file::{Override, SceneFile};
use crate::stage::Stage;
use crate::technique::Kind;
use proptest::prelude::*;

/// Everything that static decals draw.
const EVERYTHING: &str = include_str!("every_decal.toml");

fn stage(text: &str, changes: &[String]) -> Stage {
    let changes: Vec<Override> = changes.iter().map(|change| Override::parse(change).unwrap()).collect();
    let file = SceneFile::parse(text, None, &changes).unwrap();
    let (scene, surface) = crate::source::load::load(&file, &|_| {}).unwrap();
    Stage::new(scene, surface).unwrap()
}

/// Settings of the technique, and whatever else.
fn changes(of: &[&str]) -> Vec<String> {
    let long = |change: &&str| {
        if change.contains('.') { (*change).to_owned() } else { format!("technique.static-decal.{change}") }
    };
    of.iter().map(long).collect()
}

fn draw(text: &str, of: &[&str]) -> Frame {
    let stage = stage(text, &changes(of));
    let buffers: Vec<String> = ["color", "nodes", "tests", "cell"].map(str::to_owned).to_vec();
    let prepared = crate::technique::prepare(Kind::StaticDecal, &stage).unwrap();
    prepared
        .frame(&stage.view().unwrap(), &FrameOptions { buffers: &buffers, ..FrameOptions::default() })
        .unwrap()
}

fn colors(frame: &Frame) -> Vec<f64> {
    match &frame.planes.iter().find(|plane| plane.name == "color").unwrap().values {
        crate::buffer::Values::F64(values) => values.clone(),
        other => panic!("colours are doubles: {other:?}"),
    }
}

/// The largest difference from plain supersampling, which asks the footprints.
fn off(text: &str, n: usize, of: &[&str]) -> f64 {
    let samples = format!("samples={}", n * n);
    let all = [&[samples.as_str(), "joins=style", "outlines=polygon"], of].concat();
    let stage = stage(text, &changes(&all));
    let right = sampling::sample(&stage, &stage.view().unwrap(), n, &|_| {}).colors;
    let drawn = draw(text, &all);
    let pairs = right.values().as_flattened().iter().zip(colors(&drawn)).map(|(a, b)| (a - b).abs());
    pairs.fold(0.0, crate::math::max)
}

#[test]
fn every_sample_is_in_the_items_whose_footprint_holds_it_whatever_the_structures() {
    for of in [
        &["grid=500"][..],
        &["grid=1", "leaf_capacity=1", "depth=16"],
        &["grid=7", "leaf_capacity=3", "depth=2", "preparation=whole"],
        &["grid=64", "leaf_capacity=64", "depth=0", "hierarchy=wide"],
        &["grid=19", "hierarchy=curve", "leaf_capacity=2"],
        &["grid=23", "compositing.mode=additive"],
    ] {
        let off = off(EVERYTHING, 3, of);
        assert!(off < 1e-12, "{of:?}: {off}");
    }
    assert!(off(EVERYTHING, 3, &["outlines=side"]) > 0.01, "the samples would not tell");
    assert!(off(EVERYTHING, 3, &["joins=thesis"]) > 0.01, "the samples would not tell");
}

#[test]
fn the_picture_does_not_depend_on_the_structures() {
    let all_other = |of: &[&str], what: &str| {
        let usual = draw(EVERYTHING, &[]);
        let other = draw(EVERYTHING, of);
        assert_eq!(colors(&usual), colors(&other), "{what}");
        assert_eq!(usual.image, other.image, "{what}");
    };
    all_other(&["grid=3"], "grid");
    all_other(&["grid=1000", "leaf_capacity=1", "depth=16"], "quadtrees");
    all_other(&["preparation=whole", "grid=40"], "preparation");
    all_other(&["hierarchy=wide"], "wide nodes");
    all_other(&["hierarchy=curve"], "curve");
    all_other(&["leaf_polygons=clipped"], "no sample lies so near to an edge");
}

/// 10,000 short segments of four layers under and over one line that is 200 pixels wide; feature order reversed in the second.
fn crowd(is_reversed: bool) -> String {
    let mut features: Vec<String> = (0..2500)
        .map(|k| {
            let (x, y) = ((k * 7919 % 1000) as f64 - 500.0, (k * 104_729 % 900) as f64 - 450.0);
            format!("{{ line = [[{x}, {y}], [{}, {}]] }}", x + 13.0, y + (k % 29) as f64 - 14.0)
        })
        .collect();
    if is_reversed {
        features.reverse();
    }
    let layer = |color: &str, width: f64| {
        format!(
            "[[layer]]\nfeatures = [{}]\nline = {{ color = \"{color}\", width_m = {width}, opacity = 1.0 }}\n",
            features.join(", ")
        )
    };
    let wide = "[[layer]]\nfeatures = [{ line = [[-450, -400], [450, 380]] }]\nline = { color = \"#000000\", width_m = 300.0, opacity = 0.5 }\n";
    let head = EVERYTHING.split("[[layer]]").next().unwrap();
    [
        head,
        &layer("#ff0000", 2.0),
        &layer("#00ff00", 1.0),
        wide,
        &layer("#0000ff", 1.5),
        &layer("#ffffff", 0.5),
    ]
    .concat()
}

#[test]
fn a_wide_line_among_ten_thousand_segments_is_where_the_draw_order_puts_it() {
    for of in [&["grid=1"][..], &["grid=90"], &["grid=12", "hierarchy=curve"]] {
        let off = off(&crowd(false), 3, of);
        assert!(off < 1e-12, "{of:?}: {off}");
    }
    let (one, other) = (draw(&crowd(false), &["grid=11"]), draw(&crowd(true), &["grid=57"]));
    assert_eq!(one.image, other.image, "features of one colour in any order");
}

#[test]
fn a_line_counts_once_where_it_lies_over_itself_and_twice_on_request() {
    let head = EVERYTHING.split("[[layer]]").next().unwrap();
    let eight = "[[layer]]\nfeatures = [{ line = [[-300, -200], [300, 200], [300, -200], [-300, 200]] }]\nline = { color = \"#000000\", width_m = 80.0, opacity = 0.5 }\n";
    let text = [head, eight].concat();
    let (once, twice) = (draw(&text, &["grid=5"]), draw(&text, &["grid=5", "overlaps=double"]));
    // Fig. 4.7: half black on light ground, and darker where segments overlap.
    let darkest = |frame: &Frame| colors(frame).into_iter().fold(1.0, crate::math::min);
    assert!(darkest(&once) > 0.3, "{}", darkest(&once));
    assert!(darkest(&twice) < 0.8 * darkest(&once), "{}", darkest(&twice));
    assert!(off(&text, 3, &[]) < 1e-12);
}

#[test]
fn a_sample_pattern_of_eight_is_near_the_truth_of_many_samples() {
    let many = stage(EVERYTHING, &[]);
    let right = sampling::sample(&many, &many.view().unwrap(), 7, &|_| {}).colors;
    let error = |of: &[&str]| {
        let drawn = colors(&draw(EVERYTHING, &[&["joins=style", "outlines=polygon"], of].concat()));
        let squares = right.values().as_flattened().iter().zip(&drawn).map(|(a, b)| (a - b) * (a - b));
        (squares.sum::<f64>() / drawn.len() as f64).sqrt()
    };
    let (one, four, eight, analytic) =
        (error(&["samples=1"]), error(&["samples=4"]), error(&["samples=8"]), error(&["edges=analytic"]));
    assert!(four < 0.7 * one && eight < 0.8 * four, "{one} {four} {eight}");
    assert!(analytic < 0.8 * one, "{one} {analytic}");
}

#[test]
fn a_machine_of_single_precision_is_wrong_at_edges_alone() {
    let (exact, single) =
        (draw(EVERYTHING, &["samples=16"]), draw(EVERYTHING, &["samples=16", "device.precision=f32"]));
    let (exact, single) = (colors(&exact), colors(&single));
    let differ = exact.iter().zip(&single).filter(|(a, b)| (*a - *b).abs() > 1e-6).count();
    assert!(differ < exact.len() / 100, "{differ} of {}", exact.len());
}

#[test]
fn what_was_looked_at_is_counted_in_its_pixel() {
    let frame = draw(EVERYTHING, &["grid=9"]);
    let plane = |name: &str| match &frame.planes.iter().find(|plane| plane.name == name).unwrap().values {
        crate::buffer::Values::U32(values) => values.clone(),
        other => panic!("counts are whole numbers: {other:?}"),
    };
    let count = |name: &str| frame.counts.iter().find(|(known, _)| *known == name).unwrap().1;
    let sum = |name: &str| plane(name).iter().map(|v| u64::from(*v)).sum::<u64>();
    assert_eq!((sum("nodes"), sum("tests")), (count("nodes"), count("leaves")));
    assert!(plane("cell").iter().all(|cell| *cell < 81 || *cell == u32::MAX));
    assert!(plane("cell").iter().any(|cell| *cell < 81));
}

#[test]
fn a_frame_of_a_corner_builds_no_cell_that_it_does_not_see() {
    let narrow = ["camera.fov_y_deg=2.0", "grid=50"];
    let bytes = |of: &[&str]| {
        let stage = stage(EVERYTHING, &changes(&[&narrow, of].concat()));
        let prepared = crate::technique::prepare(Kind::StaticDecal, &stage).unwrap();
        prepared.frame(&stage.view().unwrap(), &FrameOptions::default()).unwrap();
        prepared.structure_bytes()
    };
    let (seen, whole) = (bytes(&[]), bytes(&["preparation=whole"]));
    assert!(seen < whole / 2, "{seen} {whole}");
}

fn vertices(count: std::ops::Range<usize>) -> impl Strategy<Value = String> {
    // Some on a lattice, so that edges and corners meet.
    let number = prop_oneof![-520.0..520.0f64, (-8..9i32).prop_map(|k| f64::from(k) * 60.0)];
    let pair = (number.clone(), number).prop_map(|(x, y)| format!("[{x}, {y}]"));
    prop::collection::vec(pair, count).prop_map(|pairs| format!("[{}]", pairs.join(", ")))
}

fn layer() -> impl Strategy<Value = String> {
    let style = (
        prop::sample::select(vec!["round", "bevel", "miter"]),
        prop::sample::select(vec!["butt", "square", "round"]),
        1.0..120.0f64,
        prop::sample::select(vec![0.4, 1.0]),
    );
    let polygon = (
        prop::collection::vec(vertices(3..9), 1..4),
        prop::sample::select(vec!["even-odd", "nonzero"]),
        prop::sample::select(vec!["inset", "normal", "offset"]),
    );
    (polygon, prop::collection::vec(vertices(2..9), 1..3), style).prop_map(|(polygon, lines, style)| {
        let ((rings, rule, mode), (join, cap, width, opacity)) = (polygon, style);
        let lines: Vec<String> = lines.iter().map(|line| format!("{{ line = {line} }}")).collect();
        let stroke = format!("width_m = {width}, join = \"{join}\", opacity = {opacity}");
        format!(
            "[[layer]]\nfeatures = [{{ polygon = [{}] }}, {}]\nfill = {{ color = \"#558855\", rule = \"{rule}\", opacity = {opacity} }}\n\
             outline = {{ color = \"#223322\", mode = \"{mode}\", {stroke} }}\nline = {{ color = \"#ffee88\", cap = \"{cap}\", {stroke} }}\n",
            rings.join(", "),
            lines.join(", ")
        )
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]
    #[test]
    fn every_sample_of_any_layers_is_in_the_items_whose_footprint_holds_it(
        layers in prop::collection::vec(layer(), 1..4), grid in 1..300u32, capacity in 1..20u32, depth in 0..17u32,
        hierarchy in prop::sample::select(vec!["binary", "wide", "curve"]),
    ) {
        let head = EVERYTHING.split("[[layer]]").next().unwrap();
        let text = [head, &layers.concat()].concat();
        let settings = [
            format!("grid={grid}"),
            format!("leaf_capacity={capacity}"),
            format!("depth={depth}"),
            format!("hierarchy={hierarchy}"),
        ];
        let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
        let off = off(&text, 1, &settings);
        prop_assert!(off < 1e-12, "{}", off);
    }
}

#[test]
fn more_samples_than_are_looked_up_together_are_each_looked_up_in_their_place() {
    let off = off(EVERYTHING, 10, &["image.width=24", "image.height=16"]);
    assert!(off < 1e-12, "{off}");
}

#[test]
fn an_inverted_fill_alone_paints_what_lies_far_from_its_polygons() {
    let head = EVERYTHING.split("[[layer]]").next().unwrap();
    let text = format!(
        "{head}[[layer]]\nfeatures = [{{ polygon = [[0, 0], [60, 0], [0, 60]] }}]\nfill = {{ color = \"#ff0000\", opacity = 0.5, invert = true }}\n"
    );
    for of in [&["grid=1"][..], &["grid=40", "hierarchy=curve"], &["grid=40", "leaf_polygons=clipped"]] {
        let off = off(&text, 3, of);
        assert!(off < 1e-12, "{of:?}: {off}");
    }
}

#[test]
fn rings_of_many_edges_among_others_hold_what_their_footprint_holds() {
    // Stars that cross themselves: one with 151 corners, a hole with 99, an island with 5.
    let star = |corners: u32, step: u32, radius: f64| {
        let corner = |k: u32| {
            let turn = f64::from(k * step % corners) / f64::from(corners) * std::f64::consts::TAU;
            format!("[{}, {}]", radius * crate::math::cos(turn), radius * crate::math::sin(turn))
        };
        format!("[{}]", (0..corners).map(corner).collect::<Vec<_>>().join(", "))
    };
    let rings = [star(151, 67, 450.0), star(99, 7, 250.0), star(5, 2, 90.0)].join(", ");
    let head = EVERYTHING.split("[[layer]]").next().unwrap();
    for rule in ["even-odd", "nonzero"] {
        let text = format!(
            "{head}[[layer]]\nfeatures = [{{ polygon = [{rings}] }}]\nfill = {{ color = \"#ff0000\", opacity = 0.5, rule = \"{rule}\" }}\n"
        );
        for of in [&["grid=1"][..], &["grid=9", "leaf_capacity=2"], &["grid=200"]] {
            let off = off(&text, 3, of);
            assert!(off < 1e-12, "{rule} {of:?}: {off}");
        }
    }
}

#[test]
fn cells_that_lie_in_the_same_fills_share_what_they_hold() {
    let head = EVERYTHING.split("[[layer]]").next().unwrap();
    let cover = "{ polygon = [[-9e3, -9e3], [9e3, -9e3], [9e3, 9e3], [-9e3, 9e3]] }, ";
    let text = format!(
        "{head}[[layer]]\nfeatures = [{} {{ polygon = [[0, 0], [90, 0], [0, 90]] }}]\nfill = {{ color = \"#ff0000\", opacity = 0.01 }}\n",
        cover.repeat(100)
    );
    let bytes = |of: &[&str]| {
        let stage = stage(&text, &changes(of));
        let prepared = super::Prepare::new(&stage, &|_| {}).unwrap();
        let memory = prepared.decals().memory();
        (memory.cells, memory.polygons)
    };
    let (few, many) = (bytes(&["preparation=whole", "grid=10"]), bytes(&["preparation=whole", "grid=40"]));
    assert_eq!([few.0, many.0], [100, 1600]);
    // Those that an edge of the triangle meets have their own; all others together two.
    assert!(many.1 < 5 * few.1 && many.1 < 100 * 20_000, "{few:?} {many:?}");
    assert!(off(&text, 3, &["grid=40"]) < 1e-12);
}

#[test]
fn a_sample_on_the_rim_that_is_rounded_outwards_is_in_the_grid() {
    let head = EVERYTHING.split("[[layer]]").next().unwrap();
    for invert in ["", ", invert = true"] {
        let corners = if invert.is_empty() {
            "[-9e3, -9e3], [9e3, -9e3], [9e3, 9e3]"
        } else {
            "[0, 0], [9, 0], [0, 9]"
        };
        let text = format!(
            "{head}[[layer]]\nfeatures = [{{ polygon = [{corners}] }}]\nfill = {{ color = \"#ff0000\"{invert} }}\n"
        );
        let stage = stage(&text, &[]);
        let prepared = super::Prepare::new(&stage, &|_| {}).unwrap();
        let (rim, decals) = (stage.mesh.plan_bounds(), prepared.decals());
        let beside =
            |by: f64| decals.cell_of(crate::space::Plan::new(rim.max.x + by, 0.5 * (rim.min.y + rim.max.y)));
        assert!(beside(1e-5).is_some() && beside(1.0).is_none());
    }
}

#[test]
fn a_crowd_in_one_cell_is_composed_as_the_footprint_says() {
    // 3,000 segments of one line, and 1,500 lines of one, over one another within a cell.
    let at = |k: u64| [(k * 7919 % 1009) as f64 * 0.9 - 450.0, (k * 104_729 % 997) as f64 * 0.9 - 450.0];
    let path: Vec<[f64; 2]> = (0..3001).map(at).collect();
    let lines: String =
        (0..1500).map(|k| format!("{{ line = {:?} }},", [at(2 * k), at(2 * k + 9)])).collect();
    let text = format!(
        "{}\n[[layer]]\nfeatures = [{{ line = {path:?} }}, {lines}]\n\
         line = {{ color = \"#aa2233\", width_m = 0.4, opacity = 0.7 }}\n",
        EVERYTHING
            .split("[[layer]]")
            .next()
            .unwrap()
            .replace("width = 72, height = 48", "width = 24, height = 16")
    );
    assert!(off(&text, 1, &["grid=1"]) < 1e-12);
}
