//! What pictures may be: whatever an imitated machine within the envelope draws is allowed, and what a planted bug draws is not.
#![cfg(feature = "render")]

mod drawing;

use drapery::buffer::Buffer;
use drapery::compare::{Allowed, Hypothesis};
use drapery::technique::Kind;
use drawing::{frame_of, scene, stage};

/// How many pixels of a picture a hypothesis does not allow.
fn outside(hypothesis: &Hypothesis, image: &Buffer<[u8; 4]>) -> usize {
    let fits = |code: &[u8; 4], lo: &[u16; 4], hi: &[u16; 4]| {
        (0..4).all(|c| (lo[c]..=hi[c]).contains(&(u16::from(code[c]) * 257)))
    };
    let mut choices = hypothesis.choices.chunk_by(|a, b| a.pixel == b.pixel).peekable();
    let pixels = (0u32..).zip(image.values()).filter(|(pixel, code)| {
        let k = *pixel as usize;
        let of_pixel = choices.next_if(|of| of[0].pixel == *pixel);
        let is_chosen = of_pixel.is_none_or(|of| of.iter().any(|c| fits(code, &c.lo, &c.hi)));
        !(is_chosen && fits(code, &hypothesis.lo[k], &hypothesis.hi[k]))
    });
    pixels.count()
}

fn allowed(kind: Kind, text: &str, changes: &[&str]) -> Allowed {
    let stage = stage(text, changes);
    drapery::allowed::allowed(kind, (&stage, &stage.view().unwrap()), &|_| {}).unwrap()
}

/// The fewest pixels outside of any hypothesis.
fn best(allowed: &Allowed, image: &Buffer<[u8; 4]>) -> usize {
    allowed.hypotheses.iter().map(|hypothesis| outside(hypothesis, image)).min().unwrap()
}

/// How many pixels may be more than two code values apart.
fn wide(hypothesis: &Hypothesis) -> usize {
    let is_wide = |(lo, hi): (&[u16; 4], &[u16; 4])| (0..4).any(|c| hi[c] - lo[c] > 2 * 257 + 2);
    hypothesis.lo.iter().zip(&hypothesis.hi).filter(|pixel| is_wide(*pixel)).count()
}

const HILLS: &str = r#"kind = "fbm", seed = 3, posts = [65, 65], cell_m = 10.0, height_m = 120.0"#;

/// A road, a translucent lake with a hole and a river over hills, seen from the south.
fn hills() -> String {
    let layers = "[[layer]]\nfeatures = [{ polygon = [[-150, -150], [120, -180], [60, 20], [160, 150], [-120, 90]] }]\n\
         fill = { color = \"#3388ff\", opacity = 0.6 }\noutline = { color = \"#003366\", width_m = 6.0 }\n\
         [[layer]]\nfeatures = [{ line = [[-280, -200], [0, 100], [250, -60], [300, 280]] }, { line = [[-200, 200], [-20, -40], [200, -250]] }]\n\
         line = { color = \"#ff7f00\", width_m = 12 }\n";
    scene(HILLS, "eye = [40, -420, 260], target = [0, 0, 40]", layers)
}

/// Outlines inside and outside of a wide ring and of a narrow polygon with an acute corner, round lines, and a bevelled one.
fn outlines() -> String {
    let layers = "[[layer]]\nfeatures = [{ polygon = [[[-150, -150], [120, -180], [60, 20], [160, 150], [-120, 90]], [[-60, -60], [20, -50], [-20, 40]]] }]\n\
         outline = { color = \"#003366\", width_m = 24.0, mode = \"inset\", opacity = 0.7 }\n\
         [[layer]]\nfeatures = [{ polygon = [[150, -150], [220, 180], [170, 120]] }]\n\
         outline = { color = \"#660033\", width_m = 18.0, mode = \"offset\", join = \"round\" }\n\
         [[layer]]\nfeatures = [{ line = [[-280, -200], [-100, 200], [-200, -250]] }]\n\
         line = { color = \"#ff7f00\", width_m = 12, opacity = 0.5, join = \"bevel\", cap = \"square\" }\n";
    scene(HILLS, "eye = [40, -420, 260], target = [0, 0, 40]", layers)
}

const MACHINES: [&[&str]; 5] = [
    &[],
    &["device.subpixel_bits=8"],
    &["device.subpixel_bits=8", "device.precision=\"f32\""],
    &["device.subpixel_bits=4", "device.precision=\"f32\"", "device.depth=\"unorm24\""],
    &["device.subpixel_bits=4"],
];

#[test]
fn what_machines_draw_is_allowed_and_little_else_is() {
    let kinds = [Kind::StencilVolume, Kind::StaticDecal];
    for (kind, text) in kinds.into_iter().flat_map(|kind| [(kind, hills()), (kind, outlines())]) {
        let all = allowed(kind, &text, &[]);
        for machine in MACHINES {
            let image = frame_of(kind, &stage(&text, machine), &[]).image;
            let missed: Vec<usize> = all.hypotheses.iter().map(|h| outside(h, &image)).collect();
            println!("{} {machine:?}: {missed:?}", kind.name());
            assert_eq!(best(&all, &image), 0, "{} {machine:?}: {missed:?}", kind.name());
        }
        let widths: Vec<usize> = all.hypotheses.iter().map(wide).collect();
        println!("{}: wide {widths:?} of {}", kind.name(), all.width * all.height);
        assert!(widths[0] * 50 < all.width * all.height, "{}: {widths:?}", kind.name());
    }
}

#[test]
fn what_bugs_draw_is_not_allowed() {
    let all = allowed(Kind::StencilVolume, &hills(), &["device.subpixel_bits=8"]);
    let bugs: [(&str, &str, &str); 6] = [
        ("wider by a twentieth", "width_m = 12 ", "width_m = 12.6 "),
        ("a line missing", ", { line = [[-200, 200], [-20, -40], [200, -250]] }", ""),
        (
            "half a pixel up",
            "eye = [40, -420, 260], target = [0, 0, 40]",
            "eye = [40, -420, 260.0], target = [0, 0, 42.0]",
        ),
        ("opacity", "opacity = 0.6", "opacity = 0.58"),
        ("outline", "width_m = 6.0", "width_m = 6.4"),
        ("a vertex moved", "[60, 20]", "[61.5, 20]"),
    ];
    for (name, from, to) in bugs {
        let text = hills().replacen(from, to, 1);
        assert_ne!(text, hills(), "{name}");
        let image = frame_of(Kind::StencilVolume, &stage(&text, &[]), &[]).image;
        println!("{name}: {:?}", all.hypotheses.iter().map(|h| outside(h, &image)).collect::<Vec<_>>());
        assert!(best(&all, &image) > 0, "{name}");
    }
}

/// Every scene among the goldens, by every machine that is allowed: about ten minutes of two cores in a release build.
#[test]
#[ignore = "minutes; the goldens' own pictures are looked at by `golden check`"]
fn what_machines_draw_of_every_golden_is_allowed() {
    let only = std::env::var("DRAPERY_ALLOWED").unwrap_or_default();
    let mut paths: Vec<_> = std::fs::read_dir("golden")
        .unwrap()
        .filter_map(|topic| {
            let topic = topic.unwrap().path();
            topic.is_dir().then(|| std::fs::read_dir(topic).unwrap().map(|file| file.unwrap().path()))
        })
        .flatten()
        .filter(|path| {
            path.extension().is_some_and(|e| e == "toml") && !path.to_string_lossy().ends_with("golden.toml")
        })
        .collect();
    paths.sort();
    for path in paths {
        let text = std::fs::read_to_string(&path).unwrap();
        for kind in [Kind::StencilVolume, Kind::StaticDecal] {
            let name = format!("{} {}", path.display(), kind.name());
            if !name.contains(&only) {
                continue;
            }
            let open = |changes: &[&str]| {
                let changes: Vec<_> =
                    changes.iter().map(|c| drapery::scene_file::Override::parse(c).unwrap()).collect();
                let file = drapery::scene_file::SceneFile::parse(&text, Some(&path), &changes).ok()?;
                let (scene, surface) = drapery::source::load::load(&file, &|_| {}).ok()?;
                drapery::stage::Stage::new(scene, surface).ok()
            };
            let Some(stage) = open(&[]) else {
                println!("{name}: not opened");
                continue;
            };
            if drapery::technique::applies(kind, &stage).is_err() {
                continue;
            }
            let view = stage.view().unwrap();
            let start = std::time::Instant::now();
            let all = match drapery::allowed::allowed(kind, (&stage, &view), &|_| {}) {
                Ok(all) => all,
                Err(error) => {
                    println!("{name}: {error}");
                    continue;
                }
            };
            let took = start.elapsed().as_secs_f64();
            let start = std::time::Instant::now();
            let _ = drawing::truth_of(&stage);
            let truth = start.elapsed().as_secs_f64();
            let size = all.width * all.height;
            let widths: Vec<f64> =
                all.hypotheses.iter().map(|h| (wide(h) * 1000 / size) as f64 / 10.0).collect();
            print!("{name}: wide {widths:?} %, {:.1} truths;", took / truth);
            let exact = stage.scene.device.is_exact();
            let mut worst = 0;
            for machine in if exact { &MACHINES[..] } else { &MACHINES[..1] } {
                let Some(stage) = open(machine) else { continue };
                let image = frame_of(kind, &stage, &[]).image;
                let missed: Vec<usize> = all.hypotheses.iter().map(|h| outside(h, &image)).collect();
                worst = worst.max(*missed.iter().min().unwrap());
                print!(" {missed:?}");
            }
            println!("{}", if worst > 0 { " OUTSIDE" } else { "" });
        }
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

fn what_machines_draw_of_a_clipmap_is_allowed() {
    for (name, text) in maps() {
        let start = std::time::Instant::now();
        let all = allowed(Kind::Clipmap, &text, &[]);
        let time = start.elapsed();
        for machine in TEXTURE_MACHINES {
            let image = frame_of(Kind::Clipmap, &stage(&text, machine), &[]).image;
            let missed: Vec<usize> = all.hypotheses.iter().map(|h| outside(h, &image)).collect();
            assert_eq!(best(&all, &image), 0, "{name} {machine:?}: {missed:?}");
        let start = std::time::Instant::now();
        drawing::truth_of(&stage(&text, &[]));
        let widths: Vec<usize> = all.hypotheses.iter().map(wide).collect();
        println!("{name}: wide {widths:?} of {}, {time:?}, the truth {:?}", all.width * all.height, start.elapsed());
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
        let all = allowed(Kind::Clipmap, text, settings);
        for machine in [TEXTURE_MACHINES[0], TEXTURE_MACHINES[2], TEXTURE_MACHINES[4]] {
            let image = frame_of(Kind::Clipmap, &stage(text, &[settings, machine].concat()), &[]).image;
            let missed: Vec<usize> = all.hypotheses.iter().map(|h| outside(h, &image)).collect();
            assert_eq!(best(&all, &image), 0, "{settings:?} {machine:?}: {missed:?}");
        }
        let widths: Vec<usize> = all.hypotheses.iter().map(wide).collect();
        println!("{settings:?}: wide {widths:?} of {}", all.width * all.height);
    }
}

#[test]
fn what_bugs_draw_of_a_clipmap_is_not_allowed() {
    let text = &maps()[1].1;
    let all = allowed(Kind::Clipmap, text, &["device.subpixel_bits=8"]);
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
        println!("{name}: {:?}", all.hypotheses.iter().map(|h| outside(h, &image)).collect::<Vec<_>>());
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
        println!("{setting}: {:?}", all.hypotheses.iter().map(|h| outside(h, &image)).collect::<Vec<_>>());
        assert!(best(&all, &image) > 0, "{setting}");
    }
}
