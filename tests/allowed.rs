//! What pictures may be: whatever an imitated machine within the envelope draws is allowed, and what a planted bug draws is not.
#![cfg(feature = "render")]

mod drawing;
mod judged;

use drapery::technique::Kind;
use drawing::{frame_of, scene, stage};
use judged::{MACHINES, allowed_of, best, outside, wide};

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

const KINDS: [Kind; 3] = [Kind::StencilVolume, Kind::StaticDecal, Kind::InverseProjection];

#[test]
fn what_machines_draw_is_allowed_and_little_else_is() {
    for (kind, text) in KINDS.into_iter().flat_map(|kind| [(kind, hills()), (kind, outlines())]) {
        let all = allowed_of(kind, &stage(&text, &[]));
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
    let all = allowed_of(Kind::StencilVolume, &stage(&hills(), &["device.subpixel_bits=8"]));
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
        for kind in Kind::ALL {
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
    }
}
