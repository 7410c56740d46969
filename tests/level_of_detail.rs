//! Scenes whose terrain has a level of detail: the plan does not move with it, techniques draw it, what has none is refused.
#![cfg(feature = "render")]

mod drawing;

use drapery::compare::Image;
use drapery::scene_file::{Override, SceneFile};
use drapery::stage::Stage;
use drapery::technique::Kind;
use drapery::terrain::Mesh;
use drapery::truth::Truth;
use std::sync::Arc;

const LAYERS: &str = r##"
[[layer]]
features = [{ polygon = [[[-300, -160], [100, -170], [150, 50], [-250, 100]], [[-150, -100], [0, -120], [-20, -60]]] }]
fill = { color = "#3f88c5", opacity = 0.7 }
[[layer]]
features = [{ line = [[-560, -220], [-200, 20], [60, -160], [300, 40], [560, 220]] }]
line = { color = "#ff7f00", width_m = 34.0 }
"##;

const DYNAMIC: &str = r##"
[[layer]]
features = [{ line = [[-560, -220], [-200, 20], [60, -160], [300, 40], [560, 220]] }]
line = { color = "#ff7f00", width_px = 5.0 }
"##;

/// A terrain of 129 x 65 posts: six levels of squares fit.
fn scene(terrain: &str, camera: &str, layers: &str) -> String {
    let terrain = format!("{terrain}, posts = [129, 65], cell_m = 10.0");
    drawing::scene(&terrain, camera, layers)
}

fn changed(text: &str, changes: &[&str]) -> Stage {
    drawing::stage(text, &[&["terrain.diagonal=alternating"], changes].concat())
}

fn image_of(kind: Kind, stage: &Stage) -> Vec<[u8; 4]> {
    drawing::frame_of(kind, stage, &[]).image.values().to_vec()
}

/// Values of which two truths have no number in common.
fn apart(one: &Truth, other: &Truth) -> usize {
    let values = |truth: &Truth| -> Vec<[f64; 2]> {
        let [low, high] = [&truth.low, &truth.high].map(|bound| bound.values().as_flattened().to_vec());
        low.into_iter().zip(high).map(|(low, high)| [low, high]).collect()
    };
    let pairs = values(one).into_iter().zip(values(other));
    pairs.filter(|([low, high], [a, b])| low > b || a > high).count()
}

#[test]
fn from_straight_above_no_pixel_of_a_line_or_polygon_changes_with_the_level() {
    let camera = "projection = \"orthographic\", height_m = 500, eye = [10, 5, 900], target = [10, 5, 0], up = [0, 1, 0]";
    for layers in [LAYERS, DYNAMIC] {
        let text = scene("kind = \"sine\", height_m = 20.0, wavelength_m = 130.0", camera, layers);
        let full = changed(&text, &[]);
        let kinds = drawing::kinds_of_footprints_for(&full);
        let truth = drawing::truth_of(&full);
        let pictures: Vec<_> = kinds.iter().map(|kind| image_of(*kind, &full)).collect();
        assert!(pictures.iter().all(|picture| picture.iter().any(|pixel| pixel[2] < 200)));
        for level in 0..6 {
            let stage = changed(&text, &[&format!("terrain.lod.level={level}")]);
            let mesh = stage.mesh_for(&stage.view().unwrap());
            assert_eq!(mesh.triangle_ids(), 2 * (128 >> level) * (64 >> level));
            let own = drawing::truth_of(&stage);
            assert_eq!(apart(&own, &truth), 0, "truth at level {level}");
            for (kind, picture) in kinds.iter().zip(&pictures) {
                let own = image_of(*kind, &stage);
                let changed = own.iter().zip(picture).filter(|(a, b)| a != b).count();
                assert_eq!(changed, 0, "pixels of {kind:?} at level {level}");
            }
        }
    }
}

#[test]
fn techniques_are_as_near_to_the_truth_over_a_coarse_mesh_as_over_the_grid() {
    let camera = "eye = [-320, -550, 420], target = [20, -40, 40]";
    // At the level, triangles lie above and below all of the full surface in a volume.
    for (layers, lod) in [(LAYERS, "terrain.lod.level=4"), (DYNAMIC, "terrain.lod.error_px=4")] {
        let text = scene("kind = \"fbm\", seed = 5, height_m = 220.0", camera, layers);
        let full = changed(&text, &[]);
        let coarse = changed(&text, &[lod]);
        let mesh = coarse.mesh_for(&coarse.view().unwrap());
        assert!(2 * mesh.triangle_ids() < full.mesh.triangle_ids(), "{}", mesh.triangle_ids());
        let rmse = |kind: Kind, stage: &Stage| {
            let picture = drawing::frame_of(kind, stage, &[]).image;
            drawing::errors(&drawing::truth_of(stage), &Image::from_rgba8(&picture).unwrap()).rmse
        };
        for kind in drawing::kinds_for(&coarse) {
            let (coarse, full) = (rmse(kind, &coarse), rmse(kind, &full));
            assert!(
                coarse < 1.3 * full + 0.002,
                "{kind:?}: {coarse} over the coarse mesh, {full} over the grid"
            );
        }
    }
}

#[test]
fn a_view_has_one_mesh_for_all_that_draw_it() {
    let text = scene("kind = \"fbm\", seed = 5", "eye = [-320, -550, 420], target = [20, -40, 40]", LAYERS);
    let stage = changed(&text, &["terrain.lod.error_px=2"]);
    let (view, again) = (stage.view().unwrap(), stage.view().unwrap());
    let mesh = stage.mesh_for(&view);
    assert!(Arc::ptr_eq(&mesh, &stage.mesh_for(&again)));
    let mut other = stage.scene.camera;
    other.eye.z += 500.0;
    let higher = other.view(&stage.scene.image).unwrap();
    assert_ne!(stage.mesh_for(&higher).triangle_ids(), mesh.triangle_ids());
    let back = stage.mesh_for(&view);
    let triangles = |mesh: &Mesh| (0..mesh.triangle_ids()).map(|id| mesh.triangle(id)).collect::<Vec<_>>();
    assert_eq!(triangles(&back), triangles(&mesh));
    let (low, high) = mesh.heights().unwrap();
    let (lowest, highest) = stage.mesh.heights().unwrap();
    assert!(lowest <= low && high <= highest && mesh.plan_bounds() == stage.mesh.plan_bounds());
    assert_eq!(mesh.resolution(), stage.mesh.resolution());
}

#[test]
fn what_has_no_level_of_detail_is_refused_with_what_to_write() {
    let terrain = |more: &str| format!("schema = 1\n[terrain]\n{more}\n");
    let refused = |text: &str| match SceneFile::parse(text, None, &[] as &[Override]) {
        Err(error) => format!("{error:#} {}", error.help_text().unwrap_or_default()),
        Ok(file) => {
            let (scene, surface) = drapery::source::load::load(&file, &|_| {}).unwrap();
            let error = Stage::new(scene, surface).map(|_| ()).unwrap_err();
            format!("{error:#} {}", error.help_text().unwrap_or_default())
        }
    };
    let generate = "generate = { kind = \"fbm\" }";
    for (text, told) in [
        (format!("{generate}\nlod = {{ error_px = 1.0 }}"), "alternating"),
        (format!("{generate}\ndiagonal = \"nw-se\"\nlod = {{ error_px = 1.0 }}"), "alternating"),
        (format!("{generate}\ndiagonal = \"alternating\"\nlod = {{ error_px = -1.0 }}"), "0 or more"),
        (format!("{generate}\ndiagonal = \"alternating\"\nlod = {{ error_px = nan }}"), "0 or more"),
        (format!("{generate}\ndiagonal = \"alternating\"\nlod = {{ error_px = 1.0, level = 2 }}"), "level"),
        (format!("{generate}\ndiagonal = \"alternating\"\nlod = {{ borrow = 0.5 }}"), "error_px"),
        (format!("{generate}\ndiagonal = \"alternating\"\nlod = {{ level = 1, borrow = 1.5 }}"), "from 0 to 1"),
        (format!("{generate}\ndiagonal = \"alternating\"\nlod = {{ level = 9 }}"), "at most 8"),
        (
            "generate = { kind = \"fbm\", posts = [128, 128] }\ndiagonal = \"alternating\"\nlod = { level = 1 }".into(),
            "129 x 129",
        ),
        (
            format!(
                "source = \"{}/golden/terrain/tin.xyz\"\ndiagonal = \"alternating\"\nlod = {{ level = 1 }}",
                env!("CARGO_MANIFEST_DIR")
            ),
            "scattered",
        ),
    ] {
        let error = refused(&terrain(&text));
        assert!(error.contains(told), "{text}: {error}");
    }
}
