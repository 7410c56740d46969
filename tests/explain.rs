//! Why a pixel has its colour: the steps are those of the code that draws frames, and lead to the frame's pixel.

#![cfg(feature = "render")]

mod drawing;

use drapery::canvas::mean;
use drapery::resolve::Paint;
use drapery::scene_file::{Override, SceneFile};
use drapery::stage::Stage;
use drapery::technique::{self, Kind, clipmap, inverse_projection, stencil_volume};
use std::path::Path;

/// Goldens, changed, that take every way to a colour: all classes and refusals, counts in full, in passing and on a machine, cut
/// outlines, several samples, imagery, linear and additive colours, levels that are not at hand.
const SCENES: [(&str, &[&str]); 8] = [
    ("inverse-projection/silhouettes", &[]),
    ("style/outlines", &["technique.stencil-volume.samples=2", "technique.inverse-projection.samples=5"]),
    ("style/joins-and-caps", &["technique.stencil-volume.overflow=\"saturate\""]),
    ("device/f32-snapped-8-bits-unorm24", &[]),
    ("terrain/imagery", &["compositing.space=\"linear\""]),
    ("compositing/additive", &["technique.inverse-projection.corners=\"true\""]),
    ("clipmap/small-clip-region", &[]),
    ("view/near-and-far", &["technique.stencil-volume.far=\"clip\"", "technique.clipmap.filter=\"nearest\""]),
];

/// A golden's stage, its picture small.
fn golden(name: &str, changes: &[&str]) -> Stage {
    let small = ["image.width=24", "image.height=16"];
    let changes = small.iter().chain(changes).map(|change| Override::parse(change).unwrap());
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden").join(format!("{name}.toml"));
    let file = SceneFile::read(&path, &changes.collect::<Vec<_>>()).unwrap_or_else(|e| panic!("{e}"));
    let (scene, surface) = drapery::source::load::load(&file, &|_| {}).unwrap();
    Stage::new(scene, surface).unwrap()
}

#[test]
fn every_pixel_is_explained_to_the_colour_that_the_frame_has() {
    let mut pictures = 0;
    for (name, changes) in SCENES {
        let stage = golden(name, changes);
        let view = stage.view().unwrap();
        for kind in Kind::ALL.into_iter().filter(|kind| technique::applies(*kind, &stage).is_ok()) {
            pictures += 1;
            let frame = drawing::frame_of(kind, &stage, &[]);
            let prepared = technique::prepare(kind, &stage).unwrap();
            for (x, y) in (0..16).flat_map(|y| (0..24).map(move |x| (x, y))) {
                let explained = technique::explain(prepared.as_ref(), &view, [x, y]).unwrap();
                let texts: Vec<String> = explained.steps.iter().map(ToString::to_string).collect();
                assert_eq!(explained.code, *frame.image.at(x, y), "{kind:?} {name} {x},{y}: {texts:#?}");
                assert!(!texts.is_empty() && texts.iter().all(|text| !text.is_empty()));
            }
        }
    }
    assert!(pictures > 20, "{pictures}");
}

#[test]
fn a_pixel_beside_the_picture_is_refused() {
    let stage = golden("style/outlines", &[]);
    let prepared = technique::prepare(Kind::InverseProjection, &stage).unwrap();
    let view = stage.view().unwrap();
    let error = technique::explain(prepared.as_ref(), &view, [24, 3]).unwrap_err();
    assert!(error.to_string().contains("there is no pixel 24,3 in a picture of 24 x 16"), "{error}");
    assert!(technique::explain(prepared.as_ref(), &view, [3, 16]).is_err());
    assert!(technique::explain(prepared.as_ref(), &view, [23, 15]).is_ok());
}

/// A white plane of 960 x 640 m seen from straight above, 10 m a pixel, half of which a black polygon covers: its border runs through the
/// middles of pixels of column 48.
fn half_black(more: &str) -> Stage {
    let layer = "[[layer]]\nfeatures = [{ polygon = [[-900, -900], [5, -900], [5, 900], [-900, 900]] }]\n\
                 fill = { color = \"#000000\" }\n";
    let text = drawing::scene(
        "kind = \"plane\", posts = [97, 97], cell_m = 20.0, height_m = 0.0",
        "eye = [0, 0, 500], target = [0, 0, 0], up = [0, 1, 0], projection = \"orthographic\", height_m = 640.0",
        &format!("{layer}{more}"),
    );
    drawing::stage(&text, &[])
}

#[test]
fn inverse_projection_tells_class_edges_and_each_sample() {
    use inverse_projection::{AreaId, PixelClass, Prepare, Step};
    let stage = half_black("[technique.inverse-projection]\nsamples = 4\ncorners = \"true\"");
    let prepared = Prepare::new(&stage).unwrap();
    let steps = |x| prepared.steps_of(&stage.view().unwrap(), [x, 30]).0;
    let class = |x| steps(x).into_iter().find(|step| matches!(step, Step::Class(_)));
    let classes = [40, 48, 60].map(class);
    assert_eq!(classes, [PixelClass::F, PixelClass::P, PixelClass::N].map(|c| Some(Step::Class(c))));
    let mixed = steps(48);
    let edges = mixed.iter().find_map(|step| match step {
        Step::NearEdges(edges) => Some(edges.len()),
        _ => None,
    });
    assert_eq!(edges, Some(1));
    let within: Vec<&Vec<AreaId>> = mixed
        .iter()
        .filter_map(|step| match step {
            Step::Sample { within, .. } => Some(within),
            _ => None,
        })
        .collect();
    assert_eq!(within.len(), 16);
    assert_eq!(within.iter().filter(|areas| **areas == &[AreaId::polygon_of(0)]).count(), 8);
    assert_eq!(mixed.last(), Some(&Step::Mean(Paint([0.5, 0.5, 0.5, 1.0]))));
}

#[test]
fn stencil_volumes_tell_faces_masks_and_each_sample() {
    use stencil_volume::{Prepare, Step};
    let stage = half_black("[technique.stencil-volume]\nsamples = 2");
    let prepared = Prepare::new(&stage).unwrap();
    let (steps, code) = prepared.steps_of(&stage.view().unwrap(), [48, 30]).unwrap();
    let masked = |sample: [usize; 2]| {
        let mut crossings = 0;
        let mut mask = None;
        for step in &steps {
            match step {
                Step::Crossing { sample: at, step, .. } if *at == sample => crossings += step,
                Step::Mask { sample: at, paint, .. } if *at == sample && paint.is_some() => mask = *paint,
                _ => {}
            }
        }
        (crossings, mask)
    };
    let black = Some(Paint([0.0, 0.0, 0.0, 1.0]));
    assert_eq!([[0, 0], [1, 0], [0, 1], [1, 1]].map(masked), [(1, black), (0, None), (1, black), (0, None)]);
    let samples: Vec<Paint> = steps
        .iter()
        .filter_map(|step| match step {
            Step::Sample { paint, .. } => Some(*paint),
            _ => None,
        })
        .collect();
    assert_eq!(steps.last(), Some(&Step::Mean(mean(2, |c, r| samples[r * 2 + c]))));
    assert_eq!(code, [128, 128, 128, 255]);
}

#[test]
fn the_clipmap_tells_probes_levels_and_each_texel() {
    use clipmap::{Prepare, Step};
    let stage = half_black("[technique.clipmap]\nfilter = \"bilinear\"\nvirtual_size = 4096");
    let prepared = Prepare::new(&stage).unwrap();
    let (steps, _) = prepared.steps_of(&stage.view().unwrap(), [48, 30]);
    let (mut weights, mut sum) = (0.0, [0.0; 4]);
    for step in &steps {
        if let Step::Texel { weight, value, .. } = step {
            weights += weight;
            (0..4).for_each(|k| sum[k] += weight * f64::from(value[k]));
        }
    }
    assert!((weights - 1.0f64).abs() < 1e-12, "{weights}");
    assert!(steps.iter().any(|step| matches!(step, Step::Probes { count: 1, .. })));
    assert!(steps.contains(&Step::Texture(Paint(sum))), "{steps:#?}");
    assert!(sum[3] > 0.1 && sum[3] < 0.9, "a pixel across the border: {sum:?}");
}
