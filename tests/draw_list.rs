//! One list of what is painted: truth, supersampling and every technique draw its items, whatever layer and style they are of.
#![cfg(feature = "render")]

mod drawing;

use drapery::buffer::{Buffer, Plane, Values};
use drapery::measure::{Drawn, Unwatched};
use drapery::scene::TechniqueSettings;
use drapery::scene::{
    Cap, Color, Feature, Fill, Join, Layer, Line, Outline, OutlineMode, Rule, Shape, Style, Width,
};
use drapery::scene_file::SceneFile;
use drapery::space::Plan;
use drapery::stage::Stage;
use drapery::technique::clipmap::{self, Joints, Overlaps, PolygonRaster, Solution};
use drapery::technique::stencil_volume::{self, Grouping, VolumeJoins};
use drapery::technique::{Frame, Kind, inverse_projection, static_decal};
use drapery::truth::{self, Budget, Truth};
use drawing::{count, frame_of, kinds_for, scene, truth_of};
use proptest::prelude::*;
use std::ops::Range;

/// A stage of other layers than its text says.
fn stage_of(text: &str, layers: Vec<Layer>, technique: &TechniqueSettings) -> Stage {
    let file = SceneFile::parse(text, None, &[]).unwrap_or_else(|e| panic!("{e}"));
    let (mut scene, surface) = drapery::source::load::load(&file, &|_| {}).unwrap_or_else(|e| panic!("{e}"));
    scene.layers = layers;
    scene.technique = technique.clone();
    Stage::new(scene, surface).unwrap_or_else(|e| panic!("{e}"))
}

fn plan(points: &[(f64, f64)]) -> Vec<Plan> {
    points.iter().map(|&(x, y)| Plan::new(x, y)).collect()
}

// ---- Which items there are ----

/// Metres, and pixels, a side of a cell.
const CELL: usize = 12;

/// What a shape has, besides a name.
#[derive(Clone, Copy, PartialEq)]
enum Has {
    Inside,
    Length,
    Nothing,
}

/// Shapes around the zero point, within 3 m of it: of polygons, then of lines.
fn shapes() -> Vec<(Shape, Has)> {
    let square = || plan(&[(-2.75, -2.75), (2.75, -2.75), (2.75, 2.75), (-2.75, 2.75)]);
    let repeated: Vec<Plan> =
        square().into_iter().flat_map(|p| [p, p, Plan::new(p.x, p.y + 1e-10)]).collect();
    let returning = [&square()[..], &square()[..1]].concat();
    let hole = plan(&[(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)]);
    let [two, dot] = [&square()[..2], &square()[..1]].map(<[Plan]>::to_vec);
    let polygons = [
        (vec![square()], Has::Inside),
        (vec![square(), hole], Has::Inside),
        (vec![repeated.clone()], Has::Inside),
        (vec![returning.clone()], Has::Inside),
        (vec![two.clone(), square(), dot.clone()], Has::Inside),
        (vec![two.clone()], Has::Length),
        (vec![dot.clone()], Has::Nothing),
    ];
    let lines = [
        (vec![square()], Has::Length),
        (vec![repeated], Has::Length),
        (vec![returning], Has::Length),
        (vec![[&two[..], &dot].concat()], Has::Length),
        (vec![dot.clone(), vec![dot[0]; 3]], Has::Nothing),
    ];
    let polygons = polygons.into_iter().map(|(rings, has)| (Shape::Polygon(rings), has));
    let points = Shape::Points(two.clone());
    let twice = Shape::MultiPolygon(vec![vec![square()], vec![dot.clone(), square()], vec![two]]);
    let others = [(twice, Has::Inside), (points, Has::Length)];
    let lines = lines.into_iter().map(|(lines, has)| (Shape::Line(lines), has));
    polygons.chain(lines).chain(others).collect()
}

/// Every style there is, but for colours and widths.
fn styles() -> Vec<Style> {
    let line = Line {
        color: Color([0.0, 0.0, 0.0, 1.0]),
        width: Width::Metres(2.0),
        join: Join::Round,
        cap: Cap::Round,
    };
    let fill = Fill { color: Color([1.0, 0.0, 0.0, 1.0]), rule: Rule::EvenOdd };
    let modes = [OutlineMode::Inset, OutlineMode::Normal, OutlineMode::Offset];
    let outlines = modes.map(|mode| Some(Outline { line, mode }));
    let mut all = Vec::new();
    for fill in [None, Some(fill)] {
        for outline in outlines.into_iter().chain([None]) {
            all.extend([None, Some(line)].map(|line| Style {
                fill,
                outline,
                line,
                point: line,
                ..Style::default()
            }));
        }
    }
    all
}

/// Whether anything of a feature can be seen.
fn is_painted(shape: &Shape, has: Has, style: &Style) -> bool {
    match shape {
        Shape::Line(_) => style.line.is_some(),
        Shape::Points(_) => style.point.is_some(),
        Shape::Polygon(_) | Shape::MultiPolygon(_) | Shape::Swath { .. } if has == Has::Inside => {
            style.fill.is_some() || style.outline.is_some()
        }
        // Nothing is inside.
        Shape::Polygon(_) | Shape::MultiPolygon(_) | Shape::Swath { .. } => {
            style.outline.is_some_and(|outline| outline.mode != OutlineMode::Inset)
        }
    }
}

#[test]
fn truth_and_techniques_paint_the_same_items_of_every_shape_in_every_style_of_one_layer() {
    let (shapes, styles) = (shapes(), styles());
    let (columns, rows) = (styles.len(), shapes.len());
    let (width, height) = (columns * CELL, rows * CELL);
    let text = format!(
        "schema = 1\nimage = {{ width = {width}, height = {height} }}\n\
         terrain = {{ generate = {{ kind = \"plane\", posts = [3, 3], cell_m = 120.0 }}, color = \"#ffffff\" }}\n\
         camera = {{ eye = [0, 0, 100], target = [0, 0, 0], up = [0, 1, 0], projection = \"orthographic\", height_m = {height} }}"
    );
    let (mut features, mut expected) = (Vec::new(), Vec::new());
    for (row, (shape, has)) in shapes.iter().enumerate() {
        for (column, style) in styles.iter().enumerate() {
            let x = (column * CELL + CELL / 2) as f64 - width as f64 / 2.0;
            let y = height as f64 / 2.0 - (row * CELL + CELL / 2) as f64;
            let mut shape = shape.clone();
            let rings: Vec<&mut Vec<Plan>> = match &mut shape {
                Shape::Polygon(parts) | Shape::Line(parts) => parts.iter_mut().collect(),
                Shape::Points(points) => vec![points],
                Shape::MultiPolygon(members) | Shape::Swath { members, .. } => {
                    members.iter_mut().flatten().collect()
                }
            };
            rings.into_iter().flatten().for_each(|p| *p = Plan::new(p.x + x, p.y + y));
            expected.push((is_painted(&shape, *has, style), *has));
            features.push(Feature { index: features.len(), style: column as u32, shape });
        }
    }
    let mut technique = TechniqueSettings::default();
    technique.set(stencil_volume::Settings { joins: VolumeJoins::Style, ..Default::default() });
    technique.set(clipmap::Settings { virtual_size: 2048, joints: Joints::Style, ..Default::default() });
    technique.set(static_decal::Settings {
        joins: static_decal::Joins::Style,
        outlines: static_decal::Outlines::Polygon,
        ..Default::default()
    });
    let layer = Layer { name: "all".into(), styles, features, opacity: 1.0, outside: None };
    let stage = stage_of(&text, vec![layer], &technique);

    let budget = Budget { coverage: true, ..Budget::new(0.01, 10).unwrap() };
    let truth = truth::certify(&stage, &stage.view().unwrap(), &budget, &|_| {});
    let frames: Vec<_> = kinds_for(&stage)
        .into_iter()
        .map(|kind| (kind.name(), kind, frame_of(kind, &stage, &["strips"])))
        .collect();
    let images = frames.iter().map(|(name, kind, frame)| (*name, Some(*kind), &frame.image));
    let right = truth.image();
    for (name, kind, image) in images.chain([("truth", None, &right)]) {
        for (cell, (is_painted, has)) in expected.iter().enumerate() {
            let (x, y) = (cell % columns * CELL, cell / columns * CELL);
            let mut pixels = (0..CELL * CELL).map(|k| image.at(x + k % CELL, y + k / CELL));
            let is_seen = pixels.any(|pixel| pixel[1] < 200);
            // Inverse projection draws segments alone.
            let can_be = *has != Has::Nothing || kind != Some(Kind::InverseProjection);
            assert_eq!(
                is_seen,
                *is_painted && can_be,
                "{name}: shape {}, style {}",
                cell / columns,
                cell % columns
            );
        }
    }

    // All count the same items, and number them alike.
    let list = &stage.draw_list;
    let frame = |kind: Kind| &frames.iter().find(|(_, of, _)| *of == kind).unwrap().2;
    assert_eq!(count(frame(Kind::StencilVolume), "objects"), list.items().len() as u64);
    let is_cut_alone = |item: &u32| list.style_of(*item).cut.is_some() && list.area_owner(*item) == *item;
    let cut_alone = (0..list.items().len() as u32).filter(is_cut_alone).count();
    assert_eq!(count(frame(Kind::InverseProjection), "areas"), (list.items().len() + cut_alone) as u64);
    assert_eq!(strips(frame(Kind::Clipmap)), strokes(&stage));
    let of_pixels = truth.coverage.as_ref().unwrap().values().iter();
    let mut covering: Vec<u32> = of_pixels
        .flat_map(|pixel| &pixel.items)
        .filter(|entry| entry.low > 0.0)
        .map(|entry| entry.item)
        .collect();
    covering.sort_unstable();
    covering.dedup();
    let covers = |item: &u32| {
        let of = &list.items()[*item as usize];
        let (has, style) = (expected[of.feature as usize].1, list.style_of(*item));
        match (style.stroke, style.cut) {
            (None, _) | (_, Some(drapery::draw_list::Side::Inside)) => has == Has::Inside,
            _ => true,
        }
    };
    assert_eq!(covering, (0..list.items().len() as u32).filter(covers).collect::<Vec<_>>());
}

/// The layers, features and parts of the strips of a frame of the clipmap, each once.
fn strips(frame: &Frame) -> Vec<[u32; 3]> {
    let Values::U32(values) = &frame.planes[0].values else { panic!("strips are whole numbers") };
    let mut all: Vec<[u32; 3]> = values.chunks(5).map(|row| [row[0], row[1], row[2]]).collect();
    all.dedup();
    all
}

/// Those of a draw list's strokes, without dots.
fn strokes(stage: &Stage) -> Vec<[u32; 3]> {
    let list = &stage.draw_list;
    let of = |item| list.strokes(item).iter().map(move |chain| (item, chain));
    let strokes = list.items().iter().flat_map(of).filter(|(_, chain)| chain.segments() > 0);
    strokes
        .map(|(item, chain): (&drapery::draw_list::Item, _)| [item.layer, item.feature, chain.part])
        .collect()
}

// ---- Each feature in its own style ----

/// Pixels, and metres, a side of what belongs to a feature: nothing of another one reaches into it.
const PLOT: usize = 32;
const PLOTS: usize = 3;

/// A map on which a pixel is a metre.
fn plots() -> String {
    let side = PLOT * PLOTS;
    let plane = format!("kind = \"plane\", posts = [3, 3], cell_m = {side}.0");
    let camera =
        "eye = [0, 0, 100], target = [0, 0, 0], up = [0, 1, 0], projection = \"orthographic\", height_m =";
    let text = scene(&plane, &format!("{camera} {side}"), "");
    text.replace("width = 96, height = 64", &format!("width = {side}, height = {side}"))
}

/// Features on plots of their own, each of a style of its own.
fn scattered(has_pixels: bool) -> impl Strategy<Value = Layer> {
    let ring = || prop::collection::vec((-4.0..4.0f64, -4.0..4.0f64), 2..6);
    let shape = (ring(), any::<bool>(), style(has_pixels, 1.0..2.0));
    prop::collection::vec(shape, PLOTS * PLOTS).prop_map(|shapes| {
        let (mut styles, mut features) = (Vec::new(), Vec::new());
        for (index, (points, is_line, style)) in shapes.into_iter().enumerate() {
            let middle = |k: usize| (k * PLOT + PLOT / 2) as f64 - (PLOT * PLOTS) as f64 / 2.0;
            let at = (middle(index % PLOTS), -middle(index / PLOTS));
            let points: Vec<(f64, f64)> = points.into_iter().map(|(x, y)| (at.0 + x, at.1 + y)).collect();
            let parts = vec![plan(&points)];
            let shape = if is_line { Shape::Line(parts) } else { Shape::Polygon(parts) };
            styles.push(style);
            features.push(Feature { index, style: index as u32, shape });
        }
        Layer { name: "scattered".into(), styles, features, opacity: 1.0, outside: None }
    })
}

/// The pixels of a plot.
fn plot<T: Clone>(image: &Buffer<T>, plot: usize) -> Vec<T> {
    let (x, y) = (plot % PLOTS * PLOT, plot / PLOTS * PLOT);
    (y..y + PLOT).flat_map(|y| image.row(y)[x..x + PLOT].to_vec()).collect()
}

/// Whether each feature of a layer looks as it does in a scene of its own.
fn assert_each_as_alone(layer: &Layer, technique: &TechniqueSettings, kinds: &[Kind]) {
    let stage = |layer: Layer| stage_of(&plots(), vec![layer], technique);
    let together = stage(layer.clone());
    let frames: Vec<Frame> = kinds.iter().map(|kind| frame_of(*kind, &together, &[])).collect();
    let truth = truth_of(&together);
    for (k, feature) in layer.features.iter().enumerate() {
        let feature = Feature { style: 0, ..feature.clone() };
        let alone = stage(Layer::uniform("alone", layer.styles[k], vec![feature]));
        for (kind, frame) in kinds.iter().zip(&frames) {
            let right = frame_of(*kind, &alone, &[]).image;
            assert!(plot(&frame.image, k) == plot(&right, k), "{kind:?}, feature {k}: {:?}", layer.styles[k]);
        }
        let right = truth_of(&alone);
        let bounds = |truth: &Truth| [plot(&truth.low, k), plot(&truth.high, k)];
        assert!(bounds(&truth) == bounds(&right), "truth, feature {k}: {:?}", layer.styles[k]);
    }
}

// ---- Styles of one layer, or of many ----

fn color() -> impl Strategy<Value = Color> {
    let channel = || prop_oneof![Just(0.0), Just(1.0), 0.0..1.0f64];
    (channel(), channel(), channel(), prop_oneof![Just(1.0), 0.2..0.9f64])
        .prop_map(|(r, g, b, a)| Color([r, g, b, a]))
}

fn line(has_pixels: bool, width: Range<f64>) -> impl Strategy<Value = Line> {
    let join = prop_oneof![Just(Join::Round), Just(Join::Bevel), Just(Join::Miter { limit: 3.0 })];
    let cap = prop_oneof![Just(Cap::Butt), Just(Cap::Square), Just(Cap::Round)];
    (color(), width, any::<bool>(), join, cap).prop_map(move |(color, width, is_thin, join, cap)| {
        let width = if has_pixels && is_thin { Width::Pixels(width / 2.0) } else { Width::Metres(width) };
        Line { color, width, join, cap }
    })
}

fn style(has_pixels: bool, width: Range<f64>) -> impl Strategy<Value = Style> {
    let rule = prop_oneof![Just(Rule::EvenOdd), Just(Rule::NonZero)];
    let mode = prop_oneof![Just(OutlineMode::Inset), Just(OutlineMode::Normal), Just(OutlineMode::Offset)];
    let fill = (color(), rule).prop_map(|(color, rule)| Fill { color, rule });
    let outline = (line(has_pixels, width.clone()), mode).prop_map(|(line, mode)| Outline { line, mode });
    (prop::option::of(fill), prop::option::of(outline), prop::option::of(line(has_pixels, width)))
        .prop_map(|(fill, outline, line)| Style { fill, outline, line, point: line, ..Style::default() })
}

fn points() -> impl Strategy<Value = Vec<Plan>> {
    prop::collection::vec((-240.0..240.0f64, -240.0..240.0f64), 2..7).prop_map(|points| plan(&points))
}

/// Features of a layer that has some styles.
fn mixed(has_pixels: bool) -> impl Strategy<Value = Layer> {
    let shape = prop_oneof![
        prop::collection::vec(points(), 1..3).prop_map(Shape::Polygon),
        prop::collection::vec(points(), 1..3).prop_map(Shape::Line),
        points().prop_map(Shape::Points),
    ];
    let features = prop::collection::vec((shape, 0..5u32), 3..9);
    (prop::collection::vec(style(has_pixels, 2.0..40.0), 5), features).prop_map(|(styles, features)| {
        let features = features.into_iter().enumerate();
        let features = features.map(|(index, (shape, style))| Feature { index, style, shape }).collect();
        Layer { name: "mixed".into(), styles, features, opacity: 1.0, outside: None }
    })
}

/// The same features in layers of one style each.
fn split(layer: &Layer) -> Vec<Layer> {
    let runs = layer.features.chunk_by(|a, b| a.style == b.style);
    let of_run = |run: &[Feature]| {
        let features = run.iter().map(|feature| Feature { style: 0, ..feature.clone() }).collect();
        Layer::uniform("one", layer.styles[run[0].style as usize], features)
    };
    runs.map(of_run).collect()
}

/// What a frame is, but for the numbers of layers and features.
fn told(frame: &Frame) -> (Vec<String>, Vec<(&'static str, u64)>) {
    let plane = |plane: &Plane| {
        let mut plane = plane.clone();
        if let ("strips", Values::U32(values)) = (plane.name, &mut plane.values) {
            values.chunks_mut(5).for_each(|row| row[..2].fill(0));
        }
        format!("{} {}", plane.name, plane.hash())
    };
    let image = format!("image {}", frame.image.hash());
    (frame.planes.iter().map(plane).chain([image]).collect(), frame.counts.clone())
}

const HILLS: &str = r#"kind = "fbm", seed = 6, posts = [17, 17], cell_m = 40.0, height_m = 120.0"#;
const CAMERA: &str = "eye = [60, -520, 420], target = [0, -20, 30]";

/// Hills seen at a slant.
fn slanted() -> String {
    scene(HILLS, CAMERA, "").replace("width = 96, height = 64", "width = 48, height = 32")
}

/// Whether two stages have the same pictures by truth, supersampling and the techniques.
fn assert_same(layer: &Layer, technique: &TechniqueSettings, kinds: &[Kind]) {
    let stages = [vec![layer.clone()], split(layer)].map(|layers| stage_of(&slanted(), layers, technique));
    for kind in kinds {
        let frames = stages.each_ref().map(|stage| {
            // Structures number layers and styles, too.
            let planes = kind.declaration().planes.iter().filter(|plane| !plane.is_structure);
            let names: Vec<&str> = planes.map(|plane| plane.name).collect();
            told(&frame_of(*kind, stage, &names))
        });
        assert_eq!(frames[0], frames[1], "{kind:?}, {technique:?}");
    }
}

/// The same by the truth and by supersampling.
fn assert_same_truth(layer: &Layer) {
    let [mixed, split] = [vec![layer.clone()], split(layer)].map(|layers| {
        let stage = stage_of(&slanted(), layers, &TechniqueSettings::default());
        let view = stage.view().unwrap();
        let budget = Budget { coverage: true, ..Budget::default() };
        let truth = truth::certify(&stage, &view, &budget, &|_| {});
        (truth, drapery::sampling::sample(&stage, &view, 3, &|_| {}).colors)
    });
    assert!((&mixed.0.low, &mixed.0.high) == (&split.0.low, &split.0.high), "bounds");
    assert!((&mixed.0.estimate, &mixed.0.coverage) == (&split.0.estimate, &split.0.coverage), "coverage");
    assert!(mixed.1 == split.1, "supersampling");
}

/// Settings of stencil volumes and inverse projection: as they are, and all else.
fn settings() -> [TechniqueSettings; 2] {
    let mut other = TechniqueSettings::default();
    other.set(stencil_volume::Settings {
        joins: VolumeJoins::Style,
        grouping: Grouping::Color,
        ..Default::default()
    });
    let point_in_polygon = inverse_projection::PointInPolygon::Winding;
    other.set(inverse_projection::Settings { point_in_polygon, ..Default::default() });
    other.set(clipmap::Settings { virtual_size: 512, ..Default::default() });
    [TechniqueSettings::default(), other]
}

/// Settings of the clipmap: each of the solutions, drawn in different ways.
fn clipmaps() -> impl Iterator<Item = TechniqueSettings> {
    let ways = [
        (Solution::Lines, PolygonRaster::Aliased, Joints::Combined, Overlaps::Blend),
        (Solution::Polygons, PolygonRaster::Exact, Joints::Style, Overlaps::Once),
        (Solution::Both, PolygonRaster::Aliased, Joints::BevelInner, Overlaps::Blend),
        (Solution::Wireframe, PolygonRaster::TinySkia, Joints::BevelStrip, Overlaps::Blend),
        (Solution::Adjacency, PolygonRaster::Exact, Joints::Combined, Overlaps::Blend),
        (Solution::Offsets, PolygonRaster::Aliased, Joints::Style, Overlaps::Once),
    ];
    ways.into_iter().map(|(solution, polygons, joints, overlaps)| {
        let mut technique = TechniqueSettings::default();
        let defaults = clipmap::Settings::default();
        technique.set(clipmap::Settings {
            virtual_size: 512,
            solution,
            polygons,
            joints,
            overlaps,
            ..defaults
        });
        technique
    })
}

/// The techniques that draw footprints, of widths in metres alone.
fn static_kinds() -> Vec<Kind> {
    let is_one = |kind: &Kind| !matches!(kind, Kind::DynamicLine | Kind::GeometryOverlay);
    Kind::ALL.into_iter().filter(is_one).collect()
}

/// Whether strips that are stored are drawn as those that are made for each tile, whatever is stored of other items.
fn assert_stored_as_made(layer: &Layer) {
    let image = |solution| {
        let mut technique = TechniqueSettings::default();
        let settings = clipmap::Settings { virtual_size: 512, solution, ..Default::default() };
        technique.set(settings);
        frame_of(Kind::Clipmap, &stage_of(&slanted(), vec![layer.clone()], &technique), &[]).image
    };
    assert!(image(Solution::Both) == image(Solution::Adjacency));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]
    #[test]
    fn a_layer_of_many_styles_is_drawn_as_layers_of_one_style_each(layer in mixed(false)) {
        assert_same_truth(&layer);
        let kinds = [Kind::StencilVolume, Kind::InverseProjection];
        settings().iter().for_each(|technique| assert_same(&layer, technique, &kinds));
    }

    #[test]
    fn truth_and_clipmap_draw_it_so_with_widths_in_pixels_among_them(layer in mixed(true)) {
        assert_same_truth(&layer);
        clipmaps().for_each(|technique| assert_same(&layer, &technique, &[Kind::Clipmap]));
        assert_stored_as_made(&layer);
    }

    #[test]
    fn a_feature_among_those_of_other_styles_is_drawn_as_it_is_alone(layer in scattered(false)) {
        settings().iter().for_each(|technique| assert_each_as_alone(&layer, technique, &static_kinds()));
    }

    #[test]
    fn so_does_every_solution_of_the_clipmap_with_widths_in_pixels_among_them(layer in scattered(true)) {
        clipmaps().for_each(|technique| assert_each_as_alone(&layer, &technique, &[Kind::Clipmap]));
    }
}

// ---- Points ----

/// How much of the ground two points cover, in pixels: one alone, and one that shares a feature with another.
fn covered(kind: Option<Kind>, changes: &str, point: &str) -> f64 {
    let text = format!(
        "schema = 1\nimage = {{ width = 60, height = 60 }}\ncamera = {{ eye = [0, 0, 100], target = [0, 0, 0], up = [0, 1, 0], \
         projection = \"orthographic\", height_m = 60.0 }}\n{changes}\nterrain = {{ color = \"#ffffff\", generate = {{ kind = \"plane\", posts = [3, 3], \
         cell_m = 40.0 }} }}\n[[layer]]\nfeatures = [{{ points = [[-15.3, 4.1], [14.2, 3.9]] }}, {{ points = [[2.0, -14.0]] }}]\n\
         point = {{ color = \"#000000\", {point} }}\n"
    );
    let scene = drapery::Opened::parse(&text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let view = scene.view().unwrap();
    let image = match kind {
        Some(kind) => {
            let drawn = Drawn::by(kind, (&scene.stage, &view), (1, &|_| false), &Unwatched).unwrap();
            drawn.frame.image
        }
        None => truth::certify(&scene.stage, &view, &Budget::default(), &|_| {}).image(),
    };
    image.values().iter().map(|pixel| 1.0 - f64::from(pixel[0]) / 255.0).sum()
}

#[test]
fn points_are_discs_in_the_truth_and_by_every_technique_whatever_lines_are() {
    let area = 3.0 * std::f64::consts::PI * 4.0 * 4.0;
    let near = |found: f64, share: f64, what: &str| {
        assert!((found - area).abs() < share * area, "{what}: {found} of {area} pixels");
    };
    for point in ["width_m = 8.0", "width_px = 8.0"] {
        near(covered(None, "", point), 0.002, "the truth");
    }
    for kind in static_kinds().into_iter().chain([Kind::DynamicLine]) {
        let width = if kind == Kind::DynamicLine { "width_px = 8.0" } else { "width_m = 8.0" };
        near(covered(Some(kind), "", width), 0.06, kind.name());
    }
    for solution in ["1-lines", "2-polygons", "3a-both", "3b-wireframe", "4a-adjacency", "4b-offsets"] {
        for threshold in ["0.0", "1e9"] {
            let changes = format!(
                "technique.clipmap = {{ solution = \"{solution}\", threshold_texels = {threshold} }}"
            );
            for point in ["width_m = 8.0", "width_px = 8.0"] {
                near(covered(Some(Kind::Clipmap), &changes, point), 0.06, &format!("{changes}, {point}"));
            }
        }
    }
    for joins in ["none", "style"] {
        let changes = format!("technique.stencil-volume = {{ joins = \"{joins}\", samples = 4 }}");
        near(covered(Some(Kind::StencilVolume), &changes, "width_m = 8.0"), 0.02, &changes);
    }
}
