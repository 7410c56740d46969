//! What pictures of a clipmap may be: whatever an imitated machine within the envelope draws is allowed, and what a planted bug draws is not.
#![cfg(feature = "render")]

mod drawing;
mod judged;

use drapery::technique::Kind;
use drawing::{frame_of, scene, stage};
use judged::{allowed_of, best, outside, outside_of_stage, wide};

const HILLS: &str = r#"kind = "fbm", seed = 3, posts = [65, 65], cell_m = 10.0, height_m = 120.0"#;

/// Layers of scenes of textures: a translucent lake with a hole, thin and wide lines.
const MAP: &str = "[[layer]]\nfeatures = [{ polygon = [[[-150, -150], [120, -180], [60, 20], [160, 150], [-120, 90]], [[-60, -60], [0, -80], [-20, 20]]] }]\n\
     fill = { color = \"#3388ff\", opacity = 0.6 }\noutline = { color = \"#003366\", width_m = 2.0 }\n\
     [[layer]]\nfeatures = [{ line = [[-280, -200], [0, 100], [250, -60], [300, 280]] }]\n\
     line = { color = \"#ff7f00\", width_m = 12 }\n\
     [[layer]]\nfeatures = [{ line = [[-200, 200], [-20, -40], [200, -250]] }]\n\
     line = { color = \"#7f0000\", width_m = 1.0, opacity = 0.8 }\n";

/// Scenes of textures, by name.
fn maps() -> Vec<(&'static str, String)> {
    let flat = r#"kind = "fbm", seed = 3, posts = [65, 65], cell_m = 10.0, height_m = 0.0"#;
    let of = |terrain: &str, camera: &str| scene(terrain, camera, MAP);
    vec![
        ("hills", of(HILLS, "eye = [40, -420, 260], target = [0, 0, 40]")),
        ("near", of(HILLS, "eye = [-60, -120, 130], target = [0, 20, 40]")),
        ("far", of(HILLS, "eye = [100, -1900, 700], target = [0, 0, 40]")),
        ("flat", of(flat, "eye = [40, -420, 160], target = [0, 0, 0]")),
        ("grazing", of(HILLS, "eye = [-300, -300, 140], target = [200, 200, 60]")),
    ]
}

/// Machines that draw textures.
const TEXTURE_MACHINES: [&[&str]; 6] = [
    &[],
    &["device.subpixel_bits=8", "device.filter_bits=8"],
    &["device.subpixel_bits=8", "device.precision=\"f32\"", "device.filter_bits=8"],
    &["device.filter_bits=8"],
    &["device.subpixel_bits=4", "device.precision=\"f32\"", "device.filter_bits=8"],
    &["device.precision=\"f32\"", "device.depth=\"f32\""],
];

#[test]
fn what_machines_draw_of_a_clipmap_is_allowed() {
    for (name, text) in maps() {
        let all = allowed_of(Kind::Clipmap, &stage(&text, &[]));
        for machine in TEXTURE_MACHINES {
            let frame = frame_of(Kind::Clipmap, &stage(&text, machine), &["level"]);
            let missed: Vec<usize> = all.hypotheses.iter().map(|h| outside(h, &frame.image)).collect();
            assert_eq!(best(&all, &frame.image), 0, "{name} {machine:?}: {missed:?}");
            assert_eq!(outside_of_stage(&all, &frame, "level"), 0, "{name} {machine:?}");
        }
        let widths: Vec<usize> = all.hypotheses.iter().map(wide).collect();
        // Where colours change, vertices of 8 bits and weights of 8 bits move them by two to four code values.
        assert!(widths[0] * 8 < all.width * all.height, "{name}: {widths:?}");
    }
}

/// Settings whose textures have a model besides the technique's own.
const TEXTURES: [&[&str]; 8] = [
    &["technique.clipmap.filter=\"nearest\""],
    &["technique.clipmap.filter=\"bilinear\"", "technique.clipmap.level_bias=-1"],
    &["technique.clipmap.filter=\"trilinear\"", "technique.clipmap.clip_size=256"],
    &["technique.clipmap.polygons=\"exact\"", "technique.clipmap.overlaps=\"once\""],
    &["technique.clipmap.texel=\"unorm8\"", "technique.clipmap.polygons=\"exact\""],
    &["technique.clipmap.solution=\"3b-wireframe\"", "technique.clipmap.lines=\"prefiltered\""],
    &["technique.clipmap.solution=\"1-lines\"", "technique.clipmap.lines=\"plain\""],
    &["technique.clipmap.solution=\"2-polygons\"", "technique.clipmap.joints=\"method-3a-quads\""],
];

#[test]
fn what_machines_draw_of_a_clipmap_is_allowed_whatever_its_settings() {
    let text = &maps()[0].1;
    for settings in TEXTURES {
        let all = allowed_of(Kind::Clipmap, &stage(text, settings));
        for machine in [TEXTURE_MACHINES[0], TEXTURE_MACHINES[2], TEXTURE_MACHINES[4]] {
            let image = frame_of(Kind::Clipmap, &stage(text, &[settings, machine].concat()), &[]).image;
            let missed: Vec<usize> = all.hypotheses.iter().map(|h| outside(h, &image)).collect();
            assert_eq!(best(&all, &image), 0, "{settings:?} {machine:?}: {missed:?}");
        }
    }
}

#[test]
fn what_bugs_draw_of_a_clipmap_is_not_allowed() {
    let text = &maps()[1].1;
    let all = allowed_of(Kind::Clipmap, &stage(text, &["device.subpixel_bits=8"]));
    let drawn = |text: &str, changes: &[&str]| frame_of(Kind::Clipmap, &stage(text, changes), &[]).image;
    let texts: [(&str, &str, &str); 5] = [
        ("wider by a twentieth", "width_m = 12 ", "width_m = 12.6 "),
        ("a line missing", "features = [{ line = [[-200, 200], [-20, -40], [200, -250]] }]", "features = []"),
        ("a hole missing", ", [[-60, -60], [0, -80], [-20, 20]]]", "]"),
        ("half a pixel aside", "target = [0, 20, 40]", "target = [0.6, 20, 40]"),
        ("opacity", "opacity = 0.6", "opacity = 0.58"),
    ];
    for (name, from, to) in texts {
        let changed = text.replacen(from, to, 1);
        assert_ne!(&changed, text, "{name}");
        let image = drawn(&changed, &[]);
        assert!(best(&all, &image) > 0, "{name}");
    }
    let settings = [
        "level_bias=1",
        "level_bias=-1",
        "level_bias=0.1",
        "anisotropy=1",
        "filter=\"nearest\"",
        "filter=\"trilinear\"",
        "joints=\"method-1\"",
        "lines=\"plain\"",
        "polygons=\"exact\"",
        "threshold_texels=0",
    ];
    for setting in settings {
        let image = drawn(text, &[&format!("technique.clipmap.{setting}")]);
        assert!(best(&all, &image) > 0, "{setting}");
    }
    // A width that follows the picture, drawn as one that follows the level.
    let text = text.replacen("width_m = 1.0", "width_px = 1.5", 1);
    let all = allowed_of(Kind::Clipmap, &stage(&text, &["device.subpixel_bits=8"]));
    assert_eq!(best(&all, &drawn(&text, &[])), 0);
    assert!(best(&all, &drawn(&text, &["technique.clipmap.pixel_width=\"texels\""])) > 50);
}
