//! Stencil volumes (Schneider & Klein 2007) on scenes whose answer is known, and the failures that the paper warns of, made on purpose.
#![cfg(feature = "render")]

mod drawing;

use drapery::buffer::{PlaneKind, Values};
use drapery::compare::{Image, Metrics};
use drapery::technique::{self, Frame, FrameOptions, Kind};
use drawing::{count, scene, stage};

fn frame(text: &str, changes: &[&str], buffers: &[&str]) -> Frame {
    drawing::frame_of(Kind::StencilVolume, &stage(text, changes), buffers)
}

/// Which pixels show neither bare ground nor sky.
fn mask(text: &str, changes: &[&str]) -> Vec<bool> {
    frame(text, changes, &[]).image.values().iter().map(|p| p[0] == 255 && p[1] == 0).collect()
}

fn counts_in(frame: &Frame, name: &str) -> Vec<u32> {
    match &frame.planes.iter().find(|p| p.name == name).unwrap().values {
        Values::U32(values) => values.clone(),
        Values::U16(values) => values.iter().map(|v| u32::from(*v)).collect(),
        other => panic!("{name} holds {other:?}"),
    }
}

fn differing(a: &[bool], b: &[bool]) -> usize {
    a.iter().zip(b).filter(|(a, b)| a != b).count()
}

fn covered(mask: &[bool]) -> usize {
    mask.iter().filter(|m| **m).count()
}

const HILLS: &str = r#"kind = "fbm", seed = 3, posts = [65, 65], cell_m = 10.0, height_m = 120.0"#;
const RED: &str = r##"color = "#ff0000""##;

/// A road and a lake over hills, seen from the south.
fn hills() -> String {
    let layers = format!(
        "[[layer]]\nfeatures = [{{ polygon = [[-150, -150], [120, -180], [60, 20], [160, 150], [-120, 90]] }},\n\
         {{ line = [[-280, -200], [0, 100], [250, -60], [300, 280]] }}]\n\
         fill = {{ {RED} }}\nline = {{ {RED}, width_m = 12 }}\n"
    );
    scene(HILLS, "eye = [40, -420, 260], target = [0, 0, 40]", &layers)
}

/// The eye in the volume of a square plateau.
fn eye_inside() -> String {
    let square = format!(
        "[[layer]]\nfeatures = [{{ polygon = [[-200, -200], [200, -200], [200, 200], [-200, 200]] }}]\nfill = {{ {RED} }}\n"
    );
    let tent = r#"kind = "tent", posts = [41, 41], cell_m = 20.0, height_m = 200.0, radius_m = 150.0"#;
    scene(tent, "eye = [0, -180, 60], target = [0, 400, 120], near_m = 0.5", &square)
}

const METHOD: &str = "technique.stencil-volume.method";

fn by(method: &str) -> String {
    format!("{METHOD}={method:?}")
}

#[test]
fn all_methods_agree_where_the_eye_is_outside() {
    let right = mask(&hills(), &[]);
    assert!(covered(&right) > 500);
    for method in ["z-pass", "z-fail"] {
        assert_eq!(differing(&mask(&hills(), &[&by(method)]), &right), 0, "{method}");
    }
}

#[test]
fn z_pass_fails_with_the_eye_inside_and_the_automatic_choice_does_not() {
    let right = mask(&eye_inside(), &[&by("z-fail")]);
    let automatic = frame(&eye_inside(), &[], &[]);
    assert_eq!((count(&automatic, "z_fail"), count(&automatic, "z_pass")), (1, 0));
    assert_eq!(differing(&mask(&eye_inside(), &[]), &right), 0);
    assert!(differing(&mask(&eye_inside(), &[&by("z-pass")]), &right) > 1000);
}

#[test]
fn the_mask_is_the_same_for_every_near_plane_that_cuts_no_terrain() {
    // Hard case 1: a square of 20 m, the eye 2 m up and on, just inside, just outside, well inside and outside a wall.
    let square = format!(
        "[[layer]]\nfeatures = [{{ polygon = [[-10, -10], [10, -10], [10, 10], [-10, 10]] }}]\nfill = {{ {RED} }}\n"
    );
    let plane = r#"kind = "plane", posts = [41, 41], cell_m = 5.0, height_m = 0.0"#;
    for lens in ["fov_y_deg = 60.0", "projection = \"orthographic\", height_m = 30.0"] {
        for offset in ["0.0", "1e-6", "-1e-6", "1.0", "-1.0"] {
            let masks = ["0.01", "0.5", "1.5"].map(|near| {
                let x: f64 = 10.0 + offset.parse::<f64>().unwrap();
                let eye =
                    format!("eye = [{x:?}, 3.0, 2.0], target = [4.0, -1.0, -1.0], near_m = {near}, {lens}");
                let text = scene(plane, &eye, &square);
                let forced = mask(&text, &[&by("z-fail")]);
                assert_eq!(differing(&mask(&text, &[]), &forced), 0, "{lens}, {offset}, near {near}");
                mask(&text, &[])
            });
            assert!(covered(&masks[0]) > 100, "{lens}, {offset}");
            if !lens.contains("orthographic") {
                assert_eq!(differing(&masks[0], &masks[1]), 0, "{offset}");
            }
        }
    }
}

#[test]
fn a_finite_far_plane_cuts_volumes_unless_depth_is_clamped() {
    // Hard case 2: terrain on both sides of the far plane, volumes that reach across it.
    let far = "camera.far_m=520.0";
    let right = mask(&hills(), &[]);
    let clamped = mask(&hills(), &[far, &by("z-fail")]);
    let sky = frame(&hills(), &[far], &["triangle"]);
    let is_seen: Vec<bool> = counts_in(&sky, "triangle").iter().map(|id| *id != u32::MAX).collect();
    let wrong_on_terrain =
        |mask: &[bool]| (0..mask.len()).filter(|k| is_seen[*k] && mask[*k] != right[*k]).count();
    assert_eq!(wrong_on_terrain(&clamped), 0, "while the terrain is inside, far does not matter");
    let clipped = mask(&hills(), &[far, &by("z-fail"), "technique.stencil-volume.far=\"clip\""]);
    assert!(wrong_on_terrain(&clipped) > 10, "{}", wrong_on_terrain(&clipped));
    let by_z_pass = mask(&hills(), &[far, &by("z-pass"), "technique.stencil-volume.far=\"clip\""]);
    assert_eq!(wrong_on_terrain(&by_z_pass), 0, "z-pass does not look beyond the terrain");
    // Where the far plane has cut the terrain away, the front of a volume stays without its back.
    assert!(differing(&by_z_pass, &clamped) > 10);
}

#[test]
fn the_nadir_mask_does_not_depend_on_how_high_the_terrain_is() {
    // Hard case 3.
    let tent = r#"kind = "tent", posts = [41, 41], cell_m = 20.0, height_m = 500.0"#;
    let pentagon = format!(
        "[[layer]]\nfeatures = [{{ polygon = [[-150, -150], [120, -180], [160, 20], [50, 150], [-120, 90]] }}]\nfill = {{ {RED} }}\n"
    );
    let camera = "eye = [0, 0, 5000], target = [0, 0, 0], up = [0, 1, 0], projection = \"orthographic\", height_m = 500.0";
    let text = scene(tent, camera, &pentagon);
    let flat = mask(&text, &[]);
    assert!(covered(&flat) > 500);
    for scale in ["1.25", "5.0"] {
        let change = format!("terrain.vertical_scale={scale}");
        assert_eq!(differing(&mask(&text, &[&change]), &flat), 0, "{scale}");
    }
}

#[test]
fn without_its_top_cap_a_volume_fails_by_z_pass() {
    let no_top = "technique.stencil-volume.caps=\"bottom\"";
    let right = mask(&hills(), &[]);
    assert!(differing(&mask(&hills(), &[no_top]), &right) > 200);
    let (all, open) = (frame(&hills(), &[], &["overdraw"]), frame(&hills(), &[no_top], &["overdraw"]));
    assert!(count(&all, "faces") > count(&open, "faces"), "counts come from faces");
    assert_ne!(counts_in(&all, "overdraw"), counts_in(&open, "overdraw"));
}

/// `n` squares of one colour on top of one another, seen at a slant.
fn stacked(n: usize) -> String {
    let square = "{ polygon = [[-20, -20], [20, -20], [20, 20], [-20, 20]] },";
    let layer = format!(
        "[[layer]]\nfeatures = [{}]\nfill = {{ {RED}, rule = \"nonzero\" }}\n\
         [technique.stencil-volume]\ngrouping = \"color\"\n",
        square.repeat(n)
    );
    let hill = r#"kind = "fbm", seed = 1, posts = [21, 21], cell_m = 5.0, height_m = 20.0"#;
    scene(hill, "eye = [10, -80, 60], target = [0, 0, 5]", &layer)
}

#[test]
fn eight_bits_wrap_at_256_volumes_and_nowhere_else() {
    // Hard case 36.
    let one = mask(&stacked(1), &[]);
    assert!(covered(&one) > 500);
    for n in [2, 255, 257, 511, 600] {
        assert_eq!(differing(&mask(&stacked(n), &[]), &one), 0, "{n}");
    }
    for n in [256, 512] {
        assert_eq!(covered(&mask(&stacked(n), &[])), 0, "{n}");
    }
    assert_eq!(differing(&mask(&stacked(256), &["device.stencil_bits=9"]), &one), 0);
    assert_eq!(covered(&mask(&stacked(4), &["device.stencil_bits=2"])), 0);
}

#[test]
fn saturation_keeps_what_is_stacked_but_leaves_traces_of_what_only_passes_by() {
    let saturate = "technique.stencil-volume.overflow=\"saturate\"";
    let right = mask(&stacked(1), &[]);
    let many = mask(&stacked(300), &[saturate, &by("z-fail")]);
    let lost = right.iter().zip(&many).filter(|(right, many)| **right && !**many).count();
    assert_eq!(lost, 0, "300 stacked volumes stay at 255");
    // Behind the surface a front face counts down from 0, where the stencil stays, then a back face counts up.
    let wrong = differing(&mask(&hills(), &[saturate, &by("z-fail")]), &mask(&hills(), &[]));
    assert!(wrong > 20, "{wrong}");
}

#[test]
fn a_pentagram_has_the_area_of_its_rule() {
    // Hard case 35: radius 100, even-odd 7756.77, nonzero 11225.70 square metres.
    let point = |k: usize| {
        let angle = std::f64::consts::TAU * (2 * k % 5) as f64 / 5.0;
        format!("[{:?}, {:?}]", 100.0 * drapery::math::sin(angle), 100.0 * drapery::math::cos(angle))
    };
    let ring: Vec<String> = (0..5).map(point).collect();
    let plane = r#"kind = "plane", posts = [9, 9], cell_m = 50.0, height_m = 7.0"#;
    let camera = "eye = [0, 0, 500], target = [0, 0, 0], up = [0, 1, 0], projection = \"orthographic\", height_m = 256.0";
    for (rule, area) in [("even-odd", 7756.77), ("nonzero", 11225.70)] {
        let layer = format!(
            "[[layer]]\nfeatures = [{{ polygon = [{}] }}]\nfill = {{ {RED}, rule = \"{rule}\" }}\n\
             [technique.stencil-volume]\nsamples = 4\n",
            ring.join(", ")
        );
        let drawn = frame(&scene(plane, camera, &layer), &[], &["stencil"]);
        let test = |v: &&u32| if rule == "nonzero" { **v != 0 } else { **v % 2 == 1 };
        // A pixel is 4 m, a sample 1 m.
        let sampled = counts_in(&drawn, "stencil").iter().filter(test).count() as f64;
        assert!((sampled - area).abs() < 60.0, "{rule}: {sampled}");
    }
}

#[test]
fn overlaps_are_composed_once_an_object_and_in_sequence() {
    // Hard case 37: two half transparent squares of one colour, and a line that crosses itself.
    let squares = "[[layer]]\nfeatures = [\n\
         { polygon = [[-30, -30], [10, -30], [10, 30], [-30, 30]] },\n\
         { polygon = [[-10, -20], [30, -20], [30, 20], [-10, 20]] }]\nfill = { color = \"#000000\", opacity = 0.5, rule = \"nonzero\" }\n";
    let plane = r#"kind = "plane", posts = [9, 9], cell_m = 10.0, height_m = 0.0"#;
    let camera = "eye = [0, 0, 100], target = [0, 0, 0], up = [0, 1, 0], projection = \"orthographic\", height_m = 64.0";
    let levels = |text: &str, change: &str| {
        let mut levels: Vec<u8> = frame(text, &[change], &[])
            .image
            .values()
            .iter()
            .filter(|p| p[2] != 255 || p[0] == 255)
            .map(|p| p[0])
            .collect();
        levels.sort_unstable();
        levels.dedup();
        levels
    };
    let text = scene(plane, camera, squares);
    assert_eq!(levels(&text, "technique.stencil-volume.grouping=\"object\""), [64, 128, 255]);
    assert_eq!(levels(&text, "technique.stencil-volume.grouping=\"color\""), [128, 255]);
    let eight = "[[layer]]\nfeatures = [{ line = [[-30, -20], [30, 20], [30, -20], [-30, 20]] }]\n\
        line = { color = \"#000000\", opacity = 0.5, width_m = 8 }\n";
    assert_eq!(levels(&scene(plane, camera, eight), "compositing.mode=\"over\""), [128, 255], "hard case 25");
    let red = squares.replace("#000000", "#ff0000").replace("#ffffff", "#000000");
    let added = frame(
        &scene(plane, camera, &red),
        &["compositing.mode=\"additive\"", "terrain.color=\"#000000\""],
        &[],
    );
    assert!(added.image.values().contains(&[255, 0, 0, 255]), "0.5 + 0.5");
}

#[test]
fn the_stencil_is_what_front_and_back_faces_leave() {
    // Fig. 5: the middle column and the right one.
    let concave = format!(
        "[[layer]]\nfeatures = [{{ polygon = [[-40, -40], [40, -40], [40, 40], [0, -10], [-40, 40]] }}]\nfill = {{ {RED} }}\n"
    );
    let hill = r#"kind = "fbm", seed = 1, posts = [33, 33], cell_m = 5.0, height_m = 20.0"#;
    let text = scene(hill, "eye = [10, -120, 90], target = [0, 0, 5]", &concave);
    let names = ["stencil", "stencil-front", "stencil-back", "overdraw"];
    for (method, sign) in [("z-pass", 1), ("z-fail", -1)] {
        let drawn = frame(&text, &[&by(method)], &names);
        let [stencil, front, back, all] = names.map(|name| counts_in(&drawn, name));
        for k in 0..stencil.len() {
            let (front, back) = (front[k] as i32, back[k] as i32);
            assert_eq!(stencil[k] as i32, sign * (front - back), "{method}");
            assert!((front + back) as u32 <= all[k]);
        }
        assert!(stencil.contains(&1) && back.iter().any(|v| *v > 0), "{method}");
        assert_eq!(stencil.iter().max(), Some(&1), "the fan's overlaps cancel");
        assert_eq!(count(&drawn, "fragments"), all.iter().map(|v| u64::from(*v)).sum::<u64>());
    }
}

#[test]
fn an_outline_is_cut_to_its_polygon_by_a_bit_of_the_stencil() {
    let outline = |mode: &str| {
        format!(
            "[[layer]]\nfeatures = [{{ polygon = [[-40, -40], [40, -40], [40, 40], [0, -10], [-40, 40]] }}]\n\
                 outline = {{ {RED}, width_m = 10, mode = \"{mode}\" }}\n"
        )
    };
    let hill = r#"kind = "fbm", seed = 1, posts = [33, 33], cell_m = 5.0, height_m = 20.0"#;
    let camera = "eye = [10, -120, 90], target = [0, 0, 5]";
    let masks = ["normal", "inset", "offset"].map(|mode| mask(&scene(hill, camera, &outline(mode)), &[]));
    let [normal, inset, offset] = &masks;
    for ((normal, inset), offset) in normal.iter().zip(inset).zip(offset) {
        assert_eq!(*normal, *inset || *offset);
        assert!(!(*inset && *offset));
    }
    assert!(covered(&masks[1]) > 50 && covered(&masks[2]) > 50);
    let text = scene(hill, camera, &outline("inset"));
    let refused =
        technique::applies(Kind::StencilVolume, &stage(&text, &["device.stencil_bits=1"])).unwrap_err();
    assert!(refused.to_string().contains("second bit"), "{refused}");
}

#[test]
fn widths_in_pixels_are_refused_with_the_reason() {
    let line = format!(
        "[[layer]]\nname = \"paths\"\nfeatures = [{{ line = [[0, 0], [9, 9]] }}]\nline = {{ {RED}, width_px = 3 }}\n"
    );
    let text = scene(HILLS, "eye = [40, -420, 260], target = [0, 0, 40]", &line);
    let refused = technique::applies(Kind::StencilVolume, &stage(&text, &[])).unwrap_err().to_string();
    assert!(refused.contains("`paths`") && refused.contains("width_px"), "{refused}");
}

#[test]
fn an_object_that_does_not_exist_is_refused() {
    let stage = stage(&hills(), &["technique.stencil-volume.object=2"]);
    let refused = technique::prepare(Kind::StencilVolume, &stage).map(|_| ()).unwrap_err().to_string();
    assert!(refused.contains("2 objects"), "{refused}");
}

const MACHINES: [&str; 4] = ["f32-reversed", "f32", "unorm24", "unorm16"];

#[test]
fn an_imitated_machine_draws_nearly_the_same_mask() {
    let right = mask(&hills(), &[]);
    for depth in MACHINES {
        let change = format!("device.depth={depth:?}");
        let drawn = mask(&hills(), &["device.precision=\"f32\"", "device.subpixel_bits=8", &change]);
        let wrong = differing(&drawn, &right);
        // Sixteen bits between 1 m and infinity leave a metre's step at 250 m.
        let most = if depth == "unorm16" { covered(&right) / 2 } else { covered(&right) / 50 };
        assert!(wrong <= most, "{depth}: {wrong} of {}", covered(&right));
    }
}

#[test]
fn an_imitated_machine_fails_with_the_eye_inside_and_by_a_far_plane_as_exact_mathematics_does() {
    let machine = "device.subpixel_bits=8";
    let right = mask(&eye_inside(), &[machine]);
    assert!(differing(&mask(&eye_inside(), &[machine, &by("z-pass")]), &right) > 1000);
    let far = ["camera.far_m=520.0", "technique.stencil-volume.method=\"z-fail\"", machine];
    let clamped = mask(&hills(), &far);
    let clipped = mask(&hills(), &[&far[..], &["technique.stencil-volume.far=\"clip\""]].concat());
    assert!(differing(&clipped, &clamped) > 10);
}

fn hashes(text: &str, changes: &[&str], tile: usize, threads: usize) -> Vec<String> {
    let run = || {
        let stage = stage(text, changes);
        let prepared = technique::prepare(Kind::StencilVolume, &stage).unwrap();
        let buffers = Kind::StencilVolume.buffer_names();
        let none = prepared
            .frame(&stage.view().unwrap(), &FrameOptions { tile, buffers: &[], progress: &|_| {} })
            .unwrap();
        let all = prepared
            .frame(&stage.view().unwrap(), &FrameOptions { tile, buffers: &buffers, progress: &|_| {} })
            .unwrap();
        assert_eq!(none.image, all.image, "buffers change no pixel");
        let mut hashes = vec![all.image.hash()];
        hashes.extend(all.planes.iter().map(|p| format!("{} {}", p.name, p.hash())));
        hashes
    };
    drapery::parallel::with_threads(threads, run).unwrap()
}

#[test]
fn every_buffer_keeps_its_bits_for_any_number_of_threads_and_any_tiles() {
    let styled = ["technique.stencil-volume.joins=\"style\"", "technique.stencil-volume.samples=3"];
    let machine = ["device.precision=\"f32\"", "device.subpixel_bits=4", "device.depth=\"unorm24\""];
    let failing =
        ["technique.stencil-volume.overflow=\"saturate\"", "technique.stencil-volume.method=\"z-fail\""];
    for changes in [&styled[..], &machine, &failing] {
        let one = hashes(&hills(), changes, 128, 1);
        for (tile, threads) in [(128, 2), (32, 3), (21, 7)] {
            assert_eq!(
                hashes(&hills(), changes, tile, threads),
                one,
                "{changes:?}: tiles of {tile}, {threads} threads"
            );
        }
    }
}

#[test]
fn every_buffer_has_the_bits_of_the_last_version_in_every_build() {
    let changes = ["technique.stencil-volume.joins=\"style\"", "technique.stencil-volume.samples=2"];
    let mut all = hashes(&hills(), &changes, 128, 2);
    // Which items touch pixels follows from what makes the picture.
    let is_pick = |line: &str| PlaneKind::PICKS.iter().any(|kind| line.split(' ').next() == Some(kind.name));
    all.retain(|line| !is_pick(line));
    let all = all.join("\n");
    assert_eq!(&blake3::hash(all.as_bytes()).to_hex()[..16], "4b8b8b93208db432");
}

/// How far a frame is from the truth, and the black share of a column's height in the truth and in the frame.
fn against_the_truth(text: &str, changes: &[&str]) -> (Metrics, [f64; 2]) {
    let white = [changes, &["image.background=#ffffff"]].concat();
    let stage = stage(text, &white);
    let truth = drawing::truth_of(&stage);
    let frame = frame(text, &white, &[]);
    let image = Image::from_rgba8(&frame.image).unwrap();
    let metrics = drawing::errors(&truth, &image);
    let [width, height] = [image.width(), image.height()];
    let black = |red: &dyn Fn(usize, usize) -> f64| {
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        pixels.map(|(x, y)| 1.0 - red(x, y)).sum::<f64>() / width as f64
    };
    let is = black(&|x, y| truth.estimate.at(x, y)[0]);
    let drawn = black(&|x, y| image.value(4 * (y * width + x)));
    (metrics, [is, drawn])
}

#[test]
fn thin_distant_lines_are_dashes_with_one_sample_and_samples_mend_them() {
    // She, Fig. 12a: a line thinner than a pixel is hit where a sample happens to lie on it.
    let text = scene(
        "kind = \"plane\", posts = [3, 3], cell_m = 20000.0",
        "eye = [0, 0, 100], target = [0, 1000, 100], fov_y_deg = 60",
        "[[layer]]\nfeatures = [ { line = [[-3000, 800], [3000, 1200]] } ]\nline = { color = \"#000000\", width_m = 10.0 }",
    );
    let with = |n: u32| against_the_truth(&text, &[&format!("technique.stencil-volume.samples={n}")]);
    let (one, [right, drawn]) = with(1);
    // All or nothing: a hit is a whole pixel, though the line covers a twentieth of it.
    assert!(one.max > 0.9 && right < 0.2, "{} {right}", one.max);
    assert!(drawn < 3.0 * right, "the dashes are about as black as the line: {drawn}, {right}");
    let mut before = one.rmse;
    for n in [2, 4, 8] {
        let (more, _) = with(n);
        assert!(more.rmse < 0.75 * before, "{n}: {} after {before}", more.rmse);
        before = more.rmse;
    }
}

#[test]
fn a_contour_line_smears_on_a_steep_slope_as_its_definition_says() {
    // Hard case 9: the width in plan stays, so that on the surface it is 1 / cos(slope) times as wide.
    for slope in [45, 80, 85] {
        let height = 400.0 * drapery::math::tan(f64::from(slope).to_radians());
        let camera =
            format!("eye = [0, -300, {}], target = [0, 0, {height}], fov_y_deg = 20", height + 100.0);
        let ramp = format!("kind = \"ramp\", posts = [3, 3], cell_m = 400.0, slope_deg = {slope}");
        let text = scene(
            &ramp,
            &camera,
            "[[layer]]\nfeatures = [ { line = [[-390, 0], [390, 0]] } ]\nline = { color = \"#000000\", width_m = 4.0 }",
        );
        let (metrics, [right, drawn]) = against_the_truth(&text, &["technique.stencil-volume.samples=8"]);
        assert!(right > 0.1, "{slope} degrees: {right}");
        assert!((drawn - right).abs() < 0.05 * right + 0.05, "{slope} degrees: {drawn} and {right}");
        assert!(metrics.max < 0.3, "{slope} degrees: {}", metrics.max);
    }
}
