//! Geometry overlay with its option to fill polygons: triangles on the mesh in use, against point samples and the truth.
#![cfg(feature = "render")]

mod drawing;

use drapery::buffer::Values;
use drapery::technique::{self, Frame, Kind};
use drawing::{count, errors, frame_of, scene, stage, truth_of};

const NADIR: &str =
    "eye = [3, 5, 400], target = [3, 5, 0], up = [0, 1, 0], projection = \"orthographic\", height_m = 300";
const OBLIQUE: &str = "eye = [-60, -520, 330], target = [0, 0, 20]";
const HILLS: &str = "kind = \"fbm\", seed = 7, posts = [33, 33], cell_m = 20, height_m = 60";
const LEVELS: &str = "kind = \"fbm\", seed = 7, posts = [260, 300], cell_m = 2.5, height_m = 60";
const FILLED: &str = "technique.geometry-overlay.polygons=filled";
const ONE_SAMPLE: &str = "technique.static-decal.samples=1";
const SMOOTH: &str = "technique.geometry-overlay.polygons=antialiased";

/// A polygon with a hole and an island in it, one that crosses itself, and another rule: translucent, so that what is drawn twice is seen.
const AREAS: &str = "[[layer]]\n\
    features = [\n\
    { polygon = [[[-250, -130], [-20, -140], [10, 90], [-210, 120]], [[-200, -80], [-60, -90], [-50, 40], [-180, 60]], [[-150, -40], [-100, -40], [-120, 20]]] },\n\
    { polygon = [[20, -100], [230, 60], [220, -90], [40, 110]] },\n\
    ]\n\
    fill = { color = \"#aa0022\", opacity = 0.5 }\n\
    [[layer]]\n\
    features = [{ polygon = [[-100, -20], [160, -10], [-90, 40], [-80, -50], [150, 60]] }]\n\
    fill = { color = \"#00aa44\", opacity = 0.6, rule = \"nonzero\" }\n";

fn with_levels(text: &str) -> String {
    let levels = "color = \"#ffffff\", diagonal = \"alternating\", lod = { error_px = 0.7 } }";
    text.replace("color = \"#ffffff\" }", levels)
}

/// How many pixels of two frames differ.
fn differing(a: &Frame, b: &Frame) -> usize {
    a.image.values().iter().zip(b.image.values()).filter(|(a, b)| a != b).count()
}

fn numbers<'f>(frame: &'f Frame, name: &str) -> &'f Values {
    &frame.planes.iter().find(|plane| plane.name == name).unwrap().values
}

#[test]
fn every_fill_is_drawn_where_a_pixels_centre_lies_in_it_and_once() {
    for (terrain, camera) in [(HILLS, NADIR), (HILLS, OBLIQUE), (LEVELS, OBLIQUE)] {
        let text = scene(terrain, camera, AREAS);
        let text = if terrain == LEVELS { with_levels(&text) } else { text };
        let stage = stage(&text, &[FILLED]);
        let frame = frame_of(Kind::GeometryOverlay, &stage, &[]);
        // Stencil volumes hold the footprint at each pixel's centre, exactly.
        let samples = frame_of(Kind::StencilVolume, &stage, &[]);
        assert_eq!(differing(&frame, &samples), 0, "{terrain} {camera}");
        assert!(count(&frame, "fill_triangles") > 200);
    }
}

#[test]
fn inverted_fills_and_holes_of_the_terrain_are_filled_as_the_footprint_is() {
    let layer = "[[layer]]\nfeatures = [{ polygon = [[-100, -90], [150, -60], [60, 100]] }, { polygon = [[0, 0], [200, 20], [20, 130]] }]\n\
                 fill = { color = \"#aa0022\", opacity = 0.5, invert = true }\n";
    let (scene, surface) = drawing::loaded(
        &scene(HILLS, OBLIQUE, layer),
        &[FILLED, ONE_SAMPLE, "technique.geometry-overlay.offset_factor=0"],
    );
    let drapery::scene::Surface::Grid(mut posts) = surface else { panic!("no grid") };
    (0..8).for_each(|k| posts.heights_mut()[(12 + k) * 33 + 2 * k] = f64::NAN);
    let stage = drapery::stage::Stage::new(scene, drapery::scene::Surface::Grid(posts)).unwrap();
    let samples = frame_of(Kind::StaticDecal, &stage, &[]);
    let frame = frame_of(Kind::GeometryOverlay, &stage, &[]);
    assert_eq!(differing(&frame, &samples), 0);
    // On a silhouette what is hidden a little bleeds through a mesh that is moved back by its slope, and is blended once more.
    let mut moved = stage;
    moved.scene.technique.set(drapery::technique::geometry_overlay::Settings {
        polygons: drapery::technique::geometry_overlay::Polygons::Filled,
        ..Default::default()
    });
    let bled = differing(&frame_of(Kind::GeometryOverlay, &moved, &[]), &samples);
    assert!((1..20).contains(&bled), "{bled}");
}

#[test]
fn shares_of_pixels_are_the_truths() {
    // Of one layer's features that do not overlap, whose shares are all there is to know.
    let layer = AREAS.split("[[layer]]").nth(1).unwrap();
    // The ground itself is not smoothed where it meets the sky, which is not in these pictures.
    let near = "eye = [-40, -150, 300], target = [0, 0, 20]";
    let gentle = HILLS.replace("height_m = 60", "height_m = 15");
    for (terrain, camera, most) in [(HILLS, NADIR, 0.0), (&gentle, near, 0.0), (HILLS, near, 0.01)] {
        let stage = stage(&scene(terrain, camera, &format!("[[layer]]{layer}")), &[SMOOTH]);
        let frame = frame_of(Kind::GeometryOverlay, &stage, &[]);
        let found = errors(&truth_of(&stage), &drapery::compare::Image::from_rgba8(&frame.image).unwrap());
        // But on silhouettes, where the centre alone decides what is hidden.
        assert!(found.over_one_code_value <= most, "{camera}: {} {}", found.over_one_code_value, found.max);
    }
}

#[test]
fn machines_leave_no_gap_between_the_triangles_of_a_fill_and_draw_no_pixel_twice() {
    let layer = "[[layer]]\nfeatures = [{ polygon = [[[-900, -900], [900, -900], [900, 900], [-900, 900]]] }, { polygon = [[-300, -300], [300, -301], [2, 3]] }]\n\
                 fill = { color = \"#000000\", opacity = 0.5 }\n";
    for camera in [NADIR, "eye = [-20, -130, 330], target = [0, 0, 20]"] {
        for bits in ["0", "4", "8"] {
            let bits = format!("device.subpixel_bits={bits}");
            let text = scene(HILLS, camera, layer);
            let frame = frame_of(
                Kind::GeometryOverlay,
                &stage(&text, &["device.precision=f32", &bits, FILLED]),
                &["triangle"],
            );
            let Values::U32(triangles) = numbers(&frame, "triangle") else { panic!("triangles are numbers") };
            let grays: Vec<[u8; 4]> = frame
                .image
                .values()
                .iter()
                .zip(triangles)
                .filter(|(_, triangle)| **triangle != u32::MAX)
                .map(|(code, _)| *code)
                .collect();
            let known: std::collections::BTreeSet<[u8; 4]> = grays.iter().copied().collect();
            assert!(known.len() == 2 && grays.len() > 5000, "{camera} {bits} {}: {known:?}", grays.len());
        }
    }
}

#[test]
fn lines_and_fills_are_drawn_in_draw_order() {
    let fill = "[[layer]]\nfeatures = [{ polygon = [[-200, -100], [200, -120], [30, 140]] }]\nfill = { color = \"#208040\" }\n";
    let line = "[[layer]]\nfeatures = [{ line = [[-250, -70], [250, 20]] }]\nline = { color = \"#aa0022\", width_px = 3 }\n";
    let red = |layers: &str| {
        let frame =
            frame_of(Kind::GeometryOverlay, &stage(&scene(HILLS, NADIR, layers), &[FILLED]), &["clipping"]);
        let Values::U32(clippings) = numbers(&frame, "clipping") else { panic!("clippings are numbers") };
        let topmost = clippings.iter().filter(|clipping| **clipping != u32::MAX).count();
        (frame.image.values().iter().filter(|code| code[0] == 0xaa).count(), topmost)
    };
    let (above, below) = (red(&format!("{fill}{line}")), red(&format!("{line}{fill}")));
    assert!(above.0 > 200 && above.0 == above.1, "{above:?}");
    assert!(below.0 < above.0 - 60 && below.0 == below.1, "{below:?}");
}

#[test]
fn on_a_globe_fills_cross_the_seam_and_reach_the_pole() {
    let layer = "[[layer]]\nfeatures = [{ polygon = [[170, -10], [-170, -12], [-168, 34], [171, 29]] }, { polygon = [[0, 70], [120, 68], [-120, 72]] }]\n\
                 fill = { color = \"#aa0022\", opacity = 0.5 }\n";
    let terrain = "kind = \"fbm\", seed = 3, posts = [144, 72], cell_deg = 2.5, height_m = 90000";
    for place in ["178, 10", "30, 75"] {
        let camera = format!("eye_geo = [{place}, 5e6], target_geo = [{place}, 0]");
        let text = format!("plan = \"globe\"\n{}", scene(terrain, &camera, layer));
        let stage = stage(&with_levels(&text), &[FILLED, ONE_SAMPLE]);
        let frame = frame_of(Kind::GeometryOverlay, &stage, &[]);
        let samples = frame_of(Kind::StaticDecal, &stage, &[]);
        let painted = samples.image.values().iter().filter(|code| code[1] < 0x90 && code[0] > 0x90).count();
        let differing = differing(&frame, &samples);
        assert!(differing * 200 <= painted && painted > 500, "{camera}: {differing} of {painted}");
    }
}

#[test]
fn the_triangles_of_fills_are_tables_and_a_pixel_tells_of_its_pieces() {
    let layer = "[[layer]]\nfeatures = [{ polygon = [[[-200, -100], [200, -100], [200, 100], [-200, 100]], [[-50, -50], [50, -50], [0, 40]]] }]\n\
                 fill = { color = \"#208040\" }\n";
    let stage = stage(&scene(HILLS, NADIR, layer), &[FILLED]);
    let frame = frame_of(Kind::GeometryOverlay, &stage, &["fill-vertices", "fill-triangles"]);
    let (Values::F64(vertices), Values::U32(triangles)) =
        (numbers(&frame, "fill-vertices"), numbers(&frame, "fill-triangles"))
    else {
        panic!("columns and rows; numbers");
    };
    let vertices: Vec<&[f64]> = vertices.chunks(2).collect();
    let area: f64 = triangles
        .chunks(4)
        .map(|row| {
            let [a, b, c] = [1, 2, 3].map(|k| vertices[row[k] as usize]);
            ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2.0
        })
        .sum();
    assert!((area - (400.0 * 200.0 - 100.0 * 90.0 / 2.0) / 400.0).abs() < 1e-9, "{area}");
    let steps = technique::prepare(Kind::GeometryOverlay, &stage)
        .unwrap()
        .steps(&stage.view().unwrap(), [70, 30])
        .unwrap();
    let told: Vec<String> = steps.steps.iter().map(ToString::to_string).collect();
    assert!(told.iter().any(|step| step.contains("piece of its fill")), "{told:?}");
}
