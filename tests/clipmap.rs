//! The clipmap texture (Taibo et al. 2014) on scenes whose answer is known, and the failures that it has by design, made on purpose.
#![cfg(feature = "render")]

mod drawing;

use drapery::buffer::{Look, Values};
use drapery::compare::{Image, Metrics};
use drapery::math;
use drapery::scene_file::{Override, SceneFile};
use drapery::space::ViewFrame;
use drapery::stage::Stage;
use drapery::technique::clipmap::{Prepare, Settings};
use drapery::technique::{Frame, FrameOptions, Kind};
use drawing::{count, errors, scene, stage, truth_of};

fn frame(text: &str, changes: &[&str], buffers: &[&str]) -> Frame {
    drawing::frame_of(Kind::Clipmap, &stage(text, changes), buffers)
}

/// The colours of a frame as numbers, not code values.
fn colors(frame: &Frame) -> Image {
    Image::from_plane(frame.planes.iter().find(|p| p.name == "color").unwrap()).unwrap()
}

/// How far a frame is from the truth.
fn against_the_truth(text: &str, changes: &[&str]) -> Metrics {
    let stage = stage(text, changes);
    let frame = drawing::frame_of(Kind::Clipmap, &stage, &["color"]);
    errors(&truth_of(&stage), &colors(&frame))
}

/// The red channel of all pixels.
fn reds(text: &str, changes: &[&str]) -> Vec<f64> {
    colors(&frame(text, changes, &["color"])).values().step_by(4).collect()
}

/// What is exact: areas, joins and caps of the style, nothing blended twice.
const OURS: [&str; 4] = [
    "technique.clipmap.polygons=exact",
    "technique.clipmap.joints=style",
    "technique.clipmap.overlaps=once",
    "technique.clipmap.threshold_texels=0",
];

/// A step of an 8-bit code.
const STEP: f64 = 1.0 / 255.0;

/// A map of 128 m seen from above on white ground, a pixel and a texel 1 m wide, pixels' centres on those of texels: a picture is the tile.
fn map(layers: &str) -> String {
    let down = "eye = [0, 0, 500], target = [0, 0, 0], up = [0, 1, 0], projection = \"orthographic\", height_m = 128.0";
    let sizes = "technique.clipmap.virtual_size = 256\n[image]\nwidth = 128\nheight = 128\n";
    let plane = r##"kind = "plane", posts = [3, 3], cell_m = 128.0"##;
    let terrain = format!("terrain = {{ generate = {{ {plane} }}, color = \"#ffffff\" }}\n");
    format!("schema = 1\n{terrain}camera = {{ {down} }}\n{sizes}{layers}")
}

/// A layer of lines in the contract's words.
fn lines(features: &str, style: &str) -> String {
    let features: String = features.split(';').map(|points| format!("{{ line = [{points}] }},")).collect();
    format!("[[layer]]\nfeatures = [{features}]\nline = {{ {style} }}\n")
}

const BLACK: &str = r##"color = "#000000", width_m ="##;

#[test]
fn a_texel_under_each_pixel_shows_the_truth_to_a_step() {
    let wood = "[[layer]]\nfeatures = [{ polygon = [[-50, -40], [45.5, -31.2], [10.3, 20.7], [50, 50], [-40, 33.3]] }]\n\
        fill = { color = \"#008800\", opacity = 0.6 }\noutline = { color = \"#aa0000\", width_m = 3.7, join = \"round\" }\n";
    let road = lines(
        "[-60, -61], [0.3, 40.1], [33, -20], [60, 62]",
        "color = \"#ff7f00\", width_m = 5.3, opacity = 0.8, cap = \"square\"",
    );
    for layers in [wood, &road] {
        let errors = against_the_truth(&map(layers), &OURS);
        assert!(errors.max < 0.5 * STEP, "{}", errors.max);
    }
    // Where edges of two items share a texel, it has only their areas, and not how these overlap.
    let both = against_the_truth(&map(&(wood.to_owned() + &road)), &OURS);
    assert!(both.max > 10.0 * STEP && both.over_one_code_value < 0.005, "{both:?}");
}

#[test]
fn outlines_inside_and_outside_are_cut_to_their_polygon_exactly() {
    for mode in ["inset", "offset", "normal"] {
        let ring = "polygon = [[-50, -40], [45.5, -31.2], [10.3, 20.7], [50, 50], [-40, 33.3]]";
        let layer = format!(
            "[[layer]]\nfeatures = [{{ {ring} }}]\noutline = {{ color = \"#aa0000\", width_m = 9.7, mode = \"{mode}\" }}\n"
        );
        let errors = against_the_truth(&map(&layer), &OURS);
        assert!(errors.max < 0.5 * STEP, "{mode}: {}", errors.max);
    }
}

#[test]
fn nearly_straight_joints_are_as_straight_lines() {
    // Hard case 19.
    let joints =
        ["algorithm-1", "method-1", "method-2", "method-3a-strip", "method-3a-quads", "method-3b", "style"];
    for joints in joints {
        let joints = format!("technique.clipmap.joints={joints:?}");
        let changes = [&OURS[..1], &OURS[2..], &[&joints[..]]].concat();
        let right = reds(&map(&lines("[-50, 0.25], [50, 0.25]", &format!("{BLACK} 6.5"))), &changes);
        for smaller in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12f64] {
            let turn = 50.0 * smaller.to_radians();
            for turn in [turn, -turn] {
                let bent = format!("[-50, 0.25], [0, 0.25], [50, {:?}]", 0.25 + turn);
                let drawn = reds(&map(&lines(&bent, &format!("{BLACK} 6.5"))), &changes);
                let off = right.iter().zip(&drawn).map(|(a, b)| (a - b).abs()).fold(0.0, math::max);
                assert!(off < 1.5 * turn.abs() + 0.5 * STEP, "{joints}, {smaller} degrees: {off}");
            }
        }
    }
}

#[test]
fn a_line_that_turns_back_is_drawn_without_a_miter() {
    // Hard case 21.
    let back = |join: &str| map(&lines("[0, 0], [10, 0], [2, 0]", &format!("{BLACK} 4, join = \"{join}\"")));
    for join in ["miter", "bevel", "round"] {
        let errors = against_the_truth(&back(join), &OURS);
        assert!(errors.max < 0.5 * STEP, "{join}: {}", errors.max);
    }
    for joints in ["algorithm-1", "method-1", "method-2", "method-3a-strip", "method-3a-quads", "method-3b"] {
        let changes = format!("technique.clipmap.joints={joints:?}");
        let reds = reds(&back("miter"), &[&changes, OURS[0], OURS[3]]);
        let area: f64 = reds.iter().map(|v| 1.0 - v).sum();
        // 10 m x 4 m, and no part of it is far away.
        assert!((39.9..60.0).contains(&area), "{joints}: {area}");
    }
}

#[test]
fn acute_miters_are_as_long_as_their_limit_and_no_longer() {
    // Hard case 22: ratios of 1.41, 3.86, 11.5 and 115; over the limit it is a bevel.
    for interior in [90.0f64, 30.0, 10.0, 1.0] {
        let half = 0.5 * interior.to_radians();
        let (x, y) = (40.0 * math::cos(half), 40.0 * math::sin(half));
        for limit in [4.0, 20.0, 200.0] {
            let style = format!("{BLACK} 3, join = \"miter\", miter_limit = {limit:?}");
            let text = map(&lines(
                &format!("[{:?}, {y:?}], [20, 0.3], [{:?}, {:?}]", 20.0 - x, 20.0 - x, -y),
                &style,
            ));
            let errors = against_the_truth(&text, &OURS);
            assert!(errors.max < 0.5 * STEP, "{interior} degrees, limit {limit}: {}", errors.max);
        }
    }
}

#[test]
fn repeated_vertices_change_nothing_and_a_line_of_one_point_is_a_dot() {
    // Hard case 23. (Vertices 1e-12 m apart are different vertices; their joint turns by any angle, within the width.)
    let style = format!("{BLACK} 5, cap = \"round\", join = \"round\"");
    let drawn = |points: &str| reds(&map(&lines(points, &style)), &OURS);
    let right = drawn("[-30, -20], [0, 10], [30, -5]");
    assert_eq!(drawn("[-30, -20], [-30, -20], [0, 10], [0, 10], [0, 10], [30, -5], [30, -5]"), right);
    let near = drawn("[-30, -20], [0, 10], [0.000000000001, 10], [30, -5]");
    assert!(near.iter().zip(&right).all(|(a, b)| (a - b).abs() < 0.5 * STEP));
    let dot: f64 = drawn("[3, 4], [3, 4]").iter().map(|v| 1.0 - v).sum();
    assert!((dot - 6.25 * std::f64::consts::PI).abs() < 0.01 * dot, "{dot}");
    let errors = against_the_truth(
        &map(&lines("[-30, -20], [0, 10], [30, -5], [10, 30], [-30, -20], [0, 10]", &style)),
        &OURS,
    );
    assert!(errors.max < 0.5 * STEP, "a loop that goes on: {}", errors.max);
}

#[test]
fn a_line_much_wider_than_its_segments_is_the_exact_sum_of_both() {
    // Hard case 24: a 360-gon of radius 2, 10 m wide: a disc of radius 7.
    let ring: Vec<String> = (0..=360)
        .map(|k| f64::from(k).to_radians())
        .map(|a| format!("[{:?}, {:?}]", 2.0 * math::cos(a), 2.0 * math::sin(a)))
        .collect();
    let text = map(&lines(&ring.join(", "), &format!("{BLACK} 10, join = \"round\", cap = \"round\"")));
    let errors = against_the_truth(&text, &OURS);
    assert!(errors.max < STEP, "{}", errors.max);
    let area: f64 = reds(&text, &OURS).iter().map(|v| 1.0 - v).sum();
    assert!((area - 49.0 * std::f64::consts::PI).abs() < 0.001 * area, "{area}");
}

/// The alpha that was drawn at a point of the map.
fn alpha_at(text: &str, changes: &[&str], x: f64, y: f64) -> f64 {
    let (column, row) = ((64.0 + x) as usize, (64.0 - y) as usize);
    1.0 - reds(text, changes)[row * 128 + column]
}

#[test]
fn a_feature_that_crosses_itself_is_blended_once_and_two_features_twice() {
    // Hard case 25.
    let half = format!("{BLACK} 8, opacity = 0.5");
    let eight = map(&lines("[-30, -30], [30, 30], [30, -30], [-30, 30]", &half));
    let two = map(&lines("[-30, -30], [30, 30]; [30, -30], [-30, 30]", &half));
    assert!((alpha_at(&eight, &OURS, 0.5, -0.5) - 0.5).abs() < 1e-6);
    assert!((alpha_at(&two, &OURS, 0.5, -0.5) - 0.75).abs() < 1e-6);
    // The papers' pipeline blends a strip's triangles one by one.
    assert!((alpha_at(&eight, &[], 0.5, -0.5) - 0.75).abs() < 1e-6);
}

#[test]
fn strips_blend_joints_once_but_for_method_1_and_3a() {
    // Fig. 8: where a strip laps over itself inside a turn, it is blended twice. A turn by 100 degrees to the left; just inside of it.
    let bend = map(&lines("[-40, 0], [0, 0], [-8, 40]", &format!("{BLACK} 12, opacity = 0.5")));
    let inside = |joints: &str| {
        let joints = format!("technique.clipmap.joints={joints:?}");
        alpha_at(&bend, &[&joints, "technique.clipmap.threshold_texels=0"], -3.5, 3.5)
    };
    for joints in ["algorithm-1", "method-2", "method-3b", "style"] {
        assert!((inside(joints) - 0.5).abs() < 1e-6, "{joints}: {}", inside(joints));
    }
    for joints in ["method-1", "method-3a-strip", "method-3a-quads"] {
        assert!((inside(joints) - 0.75).abs() < 1e-6, "{joints}: {}", inside(joints));
    }
}

#[test]
fn a_line_is_as_wide_as_it_should_be() {
    // Hard case 27, by exact areas, by a library, by line primitives.
    let ways: [(&[&str], f64); 3] = [
        (&OURS, 1e-3),
        (&["technique.clipmap.polygons=tiny-skia", "technique.clipmap.threshold_texels=0"], 0.07),
        (&["technique.clipmap.solution=1-lines", "device.max_line_width_px=64"], 1e-3),
    ];
    for (changes, within) in ways {
        for width in [1.0, 3.0, 7.0, 16.0, 31.0] {
            for angle in [0.0f64, 17.0, 45.0, 90.0] {
                let (sin, cos) = (math::sin(angle.to_radians()), math::cos(angle.to_radians()));
                let points = format!(
                    "[{:?}, {:?}], [{:?}, {:?}]",
                    0.37 - 40.0 * cos,
                    0.21 - 40.0 * sin,
                    0.37 + 40.0 * cos,
                    0.21 + 40.0 * sin
                );
                let reds = reds(&map(&lines(&points, &format!("{BLACK} {width:?}"))), changes);
                let drawn: f64 = reds.iter().map(|v| 1.0 - v).sum::<f64>() / 80.0;
                assert!(
                    (drawn - width).abs() < within * math::max(width, 1.0),
                    "{changes:?}, {width} m at {angle}: {drawn}"
                );
            }
        }
    }
}

#[test]
fn a_mitre_reaches_into_tiles_that_its_line_does_not_meet() {
    // Four tiles meet at (0, 0); the corner at (-9, -10) has its tip at (16.6, -10).
    let text = map(&lines("[-60, -14], [-9, -10], [-60, -6]", &format!("{BLACK} 4")));
    for solution in ["2-polygons", "4a-adjacency", "4b-offsets"] {
        let solution = format!("technique.clipmap.solution={solution:?}");
        let changes = [
            &OURS[..1],
            &[
                &solution[..],
                "technique.clipmap.joints=method-2",
                "technique.clipmap.virtual_size=512",
                "technique.clipmap.level_bias=-1",
            ],
        ]
        .concat();
        assert!(alpha_at(&text, &changes, 2.5, -10.5) > 0.9, "{solution}");
    }
}

#[test]
fn widths_in_pixels_have_round_joins_and_caps() {
    let text = map(&lines(
        "[-30, -20], [0, 30], [30, -20]",
        "color = \"#000000\", width_px = 9, join = \"miter\", cap = \"butt\"",
    ));
    let errors = against_the_truth(&text, &OURS);
    assert!(errors.max < 0.5 * STEP, "{}", errors.max);
}

#[test]
fn a_round_cap_wider_than_the_last_segment_is_seen_behind_it() {
    for points in ["[-40, 0], [0, 0], [-9, 3]", "[0, 0], [3, 1], [-40, 12]", "[5, 5], [9, 5]"] {
        let style = format!("{BLACK} 40, cap = \"round\", join = \"bevel\"");
        let errors = against_the_truth(&map(&lines(points, &style)), &OURS);
        assert!(errors.max < 0.5 * STEP, "{points}: {}", errors.max);
    }
}

#[test]
fn a_view_without_ground_has_all_buffers_and_no_tiles() {
    let text = map(&lines("[-60, 0], [60, 0]", &format!("{BLACK} 5")));
    let away = ["camera.eye=[9000, 0, 500]", "camera.target=[9000, 0, 0]"];
    let drawn = frame(&text, &away, &["tiles", "tile", "tile-keys", "level"]);
    assert_eq!(count(&drawn, "tiles"), 0);
    let tiles = drawn.planes.iter().find(|p| p.name == "tiles").unwrap();
    assert!(drapery::output::look(drapery::output::Npy::new(tiles).unwrap(), Look::CodeValues).is_none());
}

#[test]
fn a_line_along_a_border_of_tiles_is_as_it_is_elsewhere() {
    // Hard case 29: 512 texels across are two tiles; the same map with a line anywhere else is the same picture, moved.
    let width = 6.4;
    let column = |x: f64| {
        let text = map(&lines(&format!("[{x:?}, -70], [{x:?}, 70]"), &format!("{BLACK} {width:?}")));
        let two = ["image.width=256", "image.height=256", "technique.clipmap.virtual_size=512"];
        let reds = reds(&text, &[&OURS[..], &two].concat());
        assert!(
            reds.chunks(256).skip(10).take(200).all(|row| row == &reds[2560..2816]),
            "every row is the same"
        );
        reds[2560..2816].to_vec()
    };
    for off in [0.0, width / 4.0, width / 2.0, width / 2.0 - 1e-9, width / 2.0 + 1e-9, -width / 4.0] {
        let (on_border, elsewhere) = (column(off), column(off - 16.0));
        assert!(on_border.iter().any(|v| *v < 0.01), "{off}");
        let moved: Vec<f64> = elsewhere[..224].to_vec();
        let off_by = on_border[32..].iter().zip(&moved).map(|(a, b)| (a - b).abs()).fold(0.0, math::max);
        assert!(off_by < 1e-6, "{off}: {off_by}");
    }
}

/// Roads and woods over hills, seen at a slant.
fn hills() -> String {
    let hills = r#"kind = "fbm", seed = 3, posts = [65, 65], cell_m = 10.0, height_m = 120.0"#;
    let layers = "[[layer]]\nfeatures = [{ polygon = [[-150, -150], [120, -180], [60, 20], [160, 150], [-120, 90]] }]\n\
         fill = { color = \"#229922\", opacity = 0.6 }\noutline = { color = \"#004400\", width_px = 2 }\n\
         [[layer]]\nfeatures = [{ line = [[-280, -200], [0, 100], [250, -60], [300, 280]] }]\n\
         line = { color = \"#ff7f00\", width_m = 9 }\n";
    scene(hills, "eye = [40, -420, 260], target = [0, 0, 40]", layers)
}

/// A picture's hash, and those of everything that a frame shows.
fn hash(frame: &Frame) -> Vec<String> {
    let planes = frame.planes.iter().map(|p| format!("{} {}", p.name, p.hash()));
    std::iter::once(frame.image.hash()).chain(planes).collect()
}

#[test]
fn solutions_that_draw_the_same_geometry_draw_the_same_picture() {
    for joints in ["algorithm-1", "style", "method-3a-strip"] {
        let joints = format!("technique.clipmap.joints={joints:?}");
        let drawn = |solution: &str| {
            let solution = format!("technique.clipmap.solution={solution:?}");
            frame(&hills(), &[&joints, &solution], &[]).image
        };
        let right = drawn("4a-adjacency");
        assert!(drawn("3a-both") == right && drawn("4b-offsets") == right, "{joints}");
    }
    // Without lines that are thinner than the threshold, 2 and 3b are the same, too.
    let drawn = |solution: &str| {
        let solution = format!("technique.clipmap.solution={solution:?}");
        frame(&hills(), &[&solution, "technique.clipmap.threshold_texels=0"], &[]).image
    };
    assert!(
        ["2-polygons", "3b-wireframe", "4a-adjacency", "4b-offsets"]
            .map(drawn)
            .windows(2)
            .all(|w| w[0] == w[1])
    );
}

#[test]
fn a_changed_width_is_that_of_a_scene_with_the_width() {
    for (solution, joints) in [
        ("1-lines", "algorithm-1"),
        ("4a-adjacency", "algorithm-1"),
        ("4b-offsets", "algorithm-1"),
        ("3a-both", "algorithm-1"),
        ("3a-both", "method-3a-strip"),
        ("2-polygons", "method-2"),
    ] {
        let (solution, joints) = (
            format!("technique.clipmap.solution={solution:?}"),
            format!("technique.clipmap.joints={joints:?}"),
        );
        let changes = [&solution[..], &joints, "layer.1.line.width_m=9"];
        let stage_before = stage(&hills(), &changes);
        let mut prepared = Prepare::new(&stage_before).unwrap();
        assert!(prepared.change_width(2.0), "{changes:?}");
        let (changed, _) = prepared.frame_of(&stage_before.view().unwrap(), &PLAIN).unwrap();
        // Outlines in pixels stay as they are.
        let right = frame(&hills(), &[&solution, &joints, "layer.1.line.width_m=18"], &[]);
        assert!(changed.image == right.image, "{changes:?}");
    }
    let stage = stage(&hills(), &["technique.clipmap.solution=2-polygons"]);
    assert!(
        !Prepare::new(&stage).unwrap().change_width(2.0),
        "polygons of method 3b alone forget their lines"
    );
}

const PLAIN: FrameOptions = FrameOptions { tile: 128, buffers: &[], progress: &|_| {} };

/// Views on the way to one.
fn zooms() -> Vec<Stage> {
    let eyes =
        ["[400, -900, 900]", "[-300, -500, 500]", "[10, -60, 150]", "[40, -420, 900]", "[30, -420, 270]"];
    eyes.map(|eye| stage(&hills(), &[&format!("camera.eye={eye}")])).into()
}

#[test]
fn the_picture_does_not_depend_on_the_way_of_the_camera_nor_on_the_cache() {
    // Hard case 32: direct against five zooms, for caches that hold all, some, and one tile.
    for cache in ["1024", "4", "1"] {
        let cache = format!("technique.clipmap.cache_mib={cache}");
        let last = stage(&hills(), &[&cache]);
        let buffers = ["color", "level", "tile", "texels", "tiles"].map(str::to_owned);
        let options = FrameOptions { buffers: &buffers, ..PLAIN };
        let direct = Prepare::new(&last).unwrap().frame_of(&last.view().unwrap(), &options).unwrap().0;
        let prepared = Prepare::new(&last).unwrap();
        let views: Vec<ViewFrame> = zooms().iter().map(|stage| stage.view().unwrap()).collect();
        for view in &views {
            prepared.frame_of(view, &PLAIN).unwrap();
        }
        let wandered = prepared.frame_of(&last.view().unwrap(), &options).unwrap().0;
        assert_eq!(hash(&wandered), hash(&direct), "{cache}");
        let all = prepared.frame_of(&last.view().unwrap(), &options).unwrap();
        assert_eq!(hash(&all.0), hash(&direct));
        assert!(cache.ends_with("=1024") == (all.1.made == 0), "{cache}: {:?}", all.1);
    }
}

#[test]
fn a_camera_that_moves_on_makes_only_the_tiles_that_are_new() {
    let changes = ["layer.0.outline.width_px=", "layer.0.outline.width_m=3"];
    let (first, next) = (
        stage(&hills(), &changes),
        stage(&hills(), &[&changes[..], &["camera.eye=[45, -420, 260]"]].concat()),
    );
    let prepared = Prepare::new(&first).unwrap();
    let before = prepared.frame_of(&first.view().unwrap(), &PLAIN).unwrap().1;
    let after = prepared.frame_of(&next.view().unwrap(), &PLAIN).unwrap();
    assert!(after.1.made * 4 < before.made && after.1.found * 2 > before.made, "{before:?} {:?}", after.1);
    let direct = drawing::frame_of(Kind::Clipmap, &next, &[]);
    assert!(direct.image == after.0.image);
}

#[test]
fn every_cache_makes_the_same_picture() {
    let right = frame(&hills(), &[], &["color", "tile", "tiles"]);
    for cache in ["1", "1.5", "7"] {
        let drawn =
            frame(&hills(), &[&format!("technique.clipmap.cache_mib={cache}")], &["color", "tile", "tiles"]);
        assert_eq!(hash(&drawn), hash(&right), "{cache} MiB");
        assert_eq!(count(&drawn, "tiles"), count(&right, "tiles"));
    }
}

#[test]
fn every_buffer_keeps_its_bits_for_any_number_of_threads_and_any_tiles() {
    let machine =
        [&OURS[..], &["device.precision=f32", "device.subpixel_bits=8", "device.filter_bits=8"]].concat();
    for changes in
        [&[][..], &machine, &["technique.clipmap.polygons=tiny-skia", "technique.clipmap.texel=unorm8"]]
    {
        let stage = stage(&hills(), changes);
        let run = |tile, threads| {
            let draw = || {
                let prepared = drapery::technique::prepare(Kind::Clipmap, &stage).unwrap();
                let buffers = Kind::Clipmap.buffer_names();
                hash(
                    &prepared
                        .frame(
                            &stage.view().unwrap(),
                            &FrameOptions { tile, buffers: &buffers, progress: &|_| {} },
                        )
                        .unwrap(),
                )
            };
            drapery::parallel::with_threads(threads, draw).unwrap()
        };
        let one = run(128, 1);
        for (tile, threads) in [(128, 2), (32, 8), (50, 64)] {
            assert_eq!(run(tile, threads), one, "{changes:?}: tiles of {tile}, {threads} threads");
        }
    }
}

#[test]
fn every_buffer_has_the_bits_of_the_last_version_in_every_build() {
    let together = |changes: &[&str]| {
        let buffers = ["vertices", "strips", "color", "level", "tile", "texels", "tiles"];
        let all = hash(&frame(&hills(), changes, &buffers)).join("\n");
        blake3::hash(all.as_bytes()).to_hex()[..16].to_owned()
    };
    let smooth = ["technique.clipmap.polygons=tiny-skia", "technique.clipmap.lines=prefiltered"];
    assert_eq!(
        [together(&[]), together(&OURS), together(&smooth)],
        ["3e8ac4daf1ba60bc", "0244a417a226be15", "7de8bc6087de0861"]
    );
}

#[test]
fn the_picture_comes_nearer_to_the_truth_as_the_virtual_size_grows() {
    // A slanted view of a plane: what is left at the end is what the filter blurs.
    let text = scene(
        "kind = \"plane\", posts = [3, 3], cell_m = 6400.0",
        "eye = [0, -300, 150], target = [0, 0, 0], fov_y_deg = 40",
        &(lines("[-280, -200], [0, 100], [250, -60], [300, 280]", &format!("{BLACK} 9"))
            + &lines("[-200, 250], [200, -150]", &format!("{BLACK} 25, opacity = 0.5"))),
    );
    let white = "image.background=#ffffff";
    let rmse = |size: u32, more: &[&str]| {
        let size = format!("technique.clipmap.virtual_size={size}");
        let changes = [&OURS[..], &["technique.clipmap.anisotropy=64", white, &size], more].concat();
        against_the_truth(&text, &changes).rmse
    };
    let sizes = [256, 512, 1024, 2048, 4096, 8192].map(|size| rmse(size, &[]));
    assert!(sizes.windows(2).all(|w| w[1] < w[0] * 1.001), "{sizes:?}");
    assert!(sizes[5] < 0.5 * sizes[0], "{sizes:?}");
    let last = rmse(1 << 14, &[]);
    assert!(
        (last - sizes[5]).abs() < 0.05 * last,
        "the texture is finer than what is read of it: {last}, {sizes:?}"
    );
    // What is left is the filter: a level finer blurs less (and would alias more on finer detail).
    let sharper = rmse(1 << 14, &["technique.clipmap.level_bias=-1"]);
    assert!(sharper < 0.8 * last, "{sharper} {last}");
}

#[test]
fn thin_lines_near_the_horizon_are_as_dark_as_their_area() {
    // Hard case 7: 2 m wide lines across, 0.177, 0.0443 and 0.0111 pixels high.
    for (distance, height) in [(500.0, 0.177), (1000.0, 0.0443), (2000.0, 0.0111)] {
        let text = scene(
            "kind = \"plane\", posts = [3, 3], cell_m = 20000.0",
            "eye = [0, 0, 100], target = [0, 1000, 100], fov_y_deg = 60, near_m = 1",
            &lines(&format!("[-9000, {distance:?}], [9000, {distance:?}]"), &format!("{BLACK} 2")),
        );
        let size = [
            "image.width=256",
            "image.height=256",
            "technique.clipmap.anisotropy=64",
            "image.background=#ffffff",
        ];
        let drawn = |more: &[&str]| {
            let reds = reds(&text, &[&size[..], more].concat());
            (0..256).map(|row| 1.0 - reds[row * 256 + 128]).sum::<f64>()
        };
        // Of a pixel a tenth as high as its distance from the horizon, the footprint at its centre is not its area.
        let within = if distance < 1500.0 { 0.1 } else { 0.25 };
        for more in [&OURS[..], &["technique.clipmap.solution=1-lines"], &[]] {
            let sum = drawn(more);
            assert!((sum - height).abs() < within * height, "{distance} m by {more:?}: {sum}");
        }
        // Aliased polygons of so thin lines are holes and dashes.
        let dashes = drawn(&["technique.clipmap.solution=2-polygons", "technique.clipmap.virtual_size=4096"]);
        assert!((dashes - height).abs() > 0.5 * height, "{dashes}");
    }
}

#[test]
fn levels_meet_without_a_seam() {
    // Hard case 13: a wide line of alpha 1/2 over the borders of all levels: one composite everywhere, with and without coarser levels.
    let text = map(&lines("[-60, -60], [60, 60]", &format!("{BLACK} 40, opacity = 0.5")));
    let clipped = [
        "technique.clipmap.virtual_size=16384",
        "technique.clipmap.clip_size=256",
        "technique.clipmap.center=[3.0, -5.0]",
    ];
    for changes in [&clipped[..], &[&clipped[..], &OURS].concat()] {
        let drawn = frame(&text, &[changes, &["camera.height_m=2.0"]].concat(), &["color", "level"]);
        let reds: Vec<f64> = colors(&drawn).values().step_by(4).collect();
        assert!(reds.iter().all(|v| (v - 0.5).abs() < 1e-6));
        let wide = frame(&text, &[changes, &["technique.clipmap.level_bias=-5"]].concat(), &["color"]);
        let at = |x: f64, y: f64| colors(&wide).value(4 * ((64.0 - y) as usize * 128 + (64.0 + x) as usize));
        assert!((-50..50).all(|k| (at(f64::from(k), f64::from(k)) - 0.5).abs() < 1e-6));
        assert!(count(&wide, "coarsest_level") > count(&wide, "finest_level"));
    }
}

#[test]
fn beyond_the_clip_region_coarser_levels_blur() {
    // 32 m within one tile of 64 m are seen; of each level one tile is at hand.
    let text = map(&lines("[-64, 23.125], [64, 23.125]", &format!("{BLACK} 0.25")));
    let drawn = |center: &str, fallbacks: u64| {
        let near = [
            "camera.height_m=32.0",
            "camera.eye=[20, 20, 500]",
            "camera.target=[20, 20, 0]",
            "technique.clipmap.virtual_size=1024",
            "technique.clipmap.clip_size=256",
        ];
        let center = format!("technique.clipmap.center={center}");
        let drawn = frame(&text, &[&OURS[..], &near, &[&center]].concat(), &["color"]);
        assert_eq!(count(&drawn, "fallbacks"), fallbacks);
        colors(&drawn).values().step_by(4).fold(1.0, math::min)
    };
    assert!(drawn("[20.0, 20.0]", 0) < 0.01);
    // The first tile that holds all of it has texels of 1 m: a quarter of one is dark, and pixels between two texels have a part of that.
    let darkest = drawn("[-100.0, 20.0]", 128 * 128);
    assert!(darkest > 0.7 && darkest < 0.9, "{darkest}");
}

#[test]
fn a_line_moves_as_smoothly_as_the_camera() {
    // Hard case 15: a pillar of 1 m, 100 m tall, steps of a tenth of a pixel: what lies on the ground behind does not wobble.
    let pillar = "kind = \"tent\", posts = [101, 101], cell_m = 1.0, height_m = 100.0, radius_m = 1.0";
    let centroid = |step: u32| {
        let x = 0.1 * 0.25 * f64::from(step);
        let camera = format!(
            "eye = [{x:?}, -200, 200], target = [{x:?}, 0, 0], projection = \"orthographic\", height_m = 16.0"
        );
        let text = scene(pillar, &camera, &lines("[-4.3, -9], [-3.9, 9]", &format!("{BLACK} 0.8")));
        let reds = reds(&text, &OURS);
        let weights = |k: usize| 1.0 - reds[k];
        let sum: f64 = (0..reds.len()).map(weights).sum();
        (0..reds.len()).map(|k| weights(k) * (k % 96) as f64).sum::<f64>() / sum
    };
    let places: Vec<f64> = (0..11).map(centroid).collect();
    for pair in places.windows(2) {
        assert!((pair[0] - pair[1] - 0.1).abs() < 0.02, "{places:?}");
    }
}

#[test]
fn widths_in_pixels_follow_the_distance_or_are_texels() {
    let text = map(&lines("[-60, 0], [60, 0]", "color = \"#000000\", width_px = 6"));
    let width = |changes: &[&str]| {
        let reds = reds(&text, &[&OURS[..], changes].concat());
        (0..128).map(|row| 1.0 - reds[row * 128 + 64]).sum::<f64>()
    };
    assert!((width(&[]) - 6.0).abs() < 1e-3, "a pixel is 1 m");
    assert!((width(&["camera.height_m=64.0"]) - 6.0).abs() < 0.1, "nearer, a pixel is half a metre");
    let texels = "technique.clipmap.pixel_width=texels";
    assert!((width(&[texels]) - 6.0).abs() < 1e-3, "a texel is 1 m");
    assert!((width(&[texels, "camera.height_m=256.0"]) - 6.0).abs() < 1e-3, "farther away, one is 2 m");
    // Nearer, the same texels are two pixels each: the texture has nothing finer.
    assert!((width(&[texels, "camera.height_m=64.0"]) - 12.0).abs() < 0.1);
}

#[test]
fn line_primitives_wider_than_the_device_draws_are_left_out_or_clamped() {
    // Figs. 1 and 2.
    let text = map(&lines("[-60, 0], [60, 0]", &format!("{BLACK} 25")));
    let width = |wide: &str| {
        let wide = format!("technique.clipmap.wide_lines={wide}");
        let drawn = frame(&text, &["technique.clipmap.solution=1-lines", &wide], &["color"]);
        assert!(count(&drawn, "wide_items") > 0);
        let reds: Vec<f64> = colors(&drawn).values().step_by(4).collect();
        (0..128).map(|row| 1.0 - reds[row * 128 + 64]).sum::<f64>()
    };
    assert_eq!(width("discard"), 0.0);
    assert!((width("clamp") - 10.0).abs() < 1e-6);
}

#[test]
fn an_imitated_machine_is_off_by_what_it_rounds() {
    let road = map(&lines("[-50.3, -41.7], [43.1, 20.9]", &format!("{BLACK} 5.7")));
    let exact = reds(&road, &OURS);
    let off = |changes: &[&str]| {
        let drawn = reds(&road, &[&OURS[..], changes].concat());
        exact.iter().zip(&drawn).map(|(a, b)| (a - b).abs()).fold(0.0, math::max)
    };
    assert!(off(&["device.precision=f32"]) < 1e-3);
    let snapped = off(&["device.precision=f32", "device.subpixel_bits=4"]);
    assert!(snapped > 1e-3 && snapped < 0.08, "{snapped}");
    let between = ["camera.target=[0.2, 0, 0]", "camera.eye=[0.2, 0, 500]"];
    let weights = [&between[..], &["device.filter_bits=2"]].concat();
    // A fifth of a texel is rounded to a quarter.
    let (right, rounded) =
        (reds(&road, &[&OURS[..], &between].concat()), reds(&road, &[&OURS[..], &weights].concat()));
    let off_by = right.iter().zip(&rounded).map(|(a, b)| (a - b).abs()).fold(0.0, math::max);
    assert!(off_by > 0.01 && off_by < 0.051, "{off_by}");
    assert!(off(&["technique.clipmap.texel=unorm8"]) <= 0.5 * STEP + 1e-9);
}

#[test]
fn settings_that_make_no_texture_are_refused_with_what_they_may_be() {
    let text = map(&lines("[-50, 0], [50, 0]", &format!("{BLACK} 5")));
    for (setting, said) in [
        ("virtual_size=2097152", "must be one of [256, 512"),
        ("virtual_size=1000", "must be one of [256, 512"),
        ("clip_size=128", "must be one of [256, 512"),
        ("cache_mib=0.99", "holds no tile"),
        ("cache_mib=0", "greater than 0; found 0"),
        ("angle_deg=180", "between 0 and 180, both excluded; found 180"),
        ("threshold_texels=-0.1", "0 or more; found -0.1"),
        ("threshold_texels=nan", "0 or more; found NaN"),
        ("anisotropy=65", "from 1 to 64; found 65"),
        ("level_bias=16", "between -16 and 16, both excluded; found 16"),
        ("center=[0, inf]", "`technique.clipmap.center.1` must be a finite number"),
        ("solution=\"5\"", "\"4a-adjacency\" or \"4b-offsets\"; found the string \"5\""),
    ] {
        let change = Override::parse(&format!("technique.clipmap.{setting}")).unwrap();
        let refusal = SceneFile::parse(&text, None, &[change]).unwrap_err().to_string();
        assert!(refusal.contains(said), "{refusal}");
        assert!(refusal.contains(&format!("override `technique.clipmap.{setting}`")), "{refusal}");
    }
    let wide = Override::parse("layer.0.line.width_m=nan").unwrap();
    let refusal = SceneFile::parse(&text, None, &[wide]).unwrap_err().to_string();
    assert!(refusal.contains("must be a finite number greater than 0; found NaN"), "{refusal}");
    let smaller = stage(&text, &["technique.clipmap.texel=\"unorm8\"", "technique.clipmap.cache_mib=0.25"]);
    assert_eq!(
        smaller.scene.technique.get::<Settings>().tile_bytes(),
        1 << 18,
        "a tile of 8-bit texels is enough"
    );
}

#[test]
fn any_feature_gives_a_finite_picture() {
    let wild = "[0, 0]; [0, 0], [0, 0]; [-1e9, 3], [1e9, 4], [-1e9, 5]; [1, 1], [1, 1.0000000000000002]; [-1e-300, 0], [1e-300, 0]; \
                [5, 5], [5, 6], [5, 5], [5, 6], [5, 5]";
    for width in ["0.001", "3", "1e7"] {
        for solution in ["1-lines", "2-polygons", "3a-both", "3b-wireframe", "4a-adjacency", "4b-offsets"] {
            for joints in ["algorithm-1", "method-1", "method-2", "method-3a-quads", "style"] {
                let features: Vec<&str> = wild.split(';').filter(|f| f.contains("], [")).collect();
                let text = map(&lines(&features.join(";"), &format!("{BLACK} {width}, cap = \"round\"")));
                let (solution, joints) = (
                    format!("technique.clipmap.solution={solution:?}"),
                    format!("technique.clipmap.joints={joints:?}"),
                );
                let drawn = reds(&text, &[&solution, &joints]);
                assert!(drawn.iter().all(|v| (0.0..=1.0).contains(v)), "{solution}, {joints}, {width}");
            }
        }
    }
}

#[test]
fn the_level_and_texels_of_each_pixel_are_told() {
    let drawn =
        frame(&hills(), &["technique.clipmap.filter=nearest"], &["level", "texels", "tile", "tile-keys"]);
    let values = |name: &str| drawn.planes.iter().find(|p| p.name == name).unwrap();
    let (Values::U32(texels), Values::F64(levels)) = (&values("texels").values, &values("level").values)
    else {
        panic!("other types")
    };
    assert!(texels.iter().zip(levels).all(|(texels, level)| *texels == u32::from(level.is_finite())));
    assert_eq!(texels.iter().map(|n| u64::from(*n)).sum::<u64>(), count(&drawn, "texels_read"));
    let Values::U32(keys) = &values("tile-keys").values else { panic!("other types") };
    assert_eq!(keys.len() as u64, 3 * count(&drawn, "tiles"));
}
