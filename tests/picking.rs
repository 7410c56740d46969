//! Picking: what the buffers of items say of a pixel is what its picture shows there.
#![cfg(feature = "render")]

mod drawing;

use drapery::buffer::{PlaneKind, Values, picked};
use drapery::stage::Stage;
use drapery::technique::{Frame, Kind};
use drapery::truth::{Budget, Touched};
use drawing::{frame_of, kinds_for, scene, stage};

const HILLS: &str = r#"kind = "fbm", seed = 5, posts = [33, 33], cell_m = 10.0, height_m = 60.0"#;
const CAMERA: &str = "eye = [30, -230, 150], target = [0, 0, 20]";

/// One sample a pixel, at its centre, and what the style says of ends and joints.
const SINGLE: [&str; 8] = [
    "technique.static-decal.samples=1",
    r#"technique.static-decal.joins="style""#,
    r#"technique.static-decal.outlines="polygon""#,
    r#"technique.stencil-volume.joins="style""#,
    "technique.inverse-projection.samples=1",
    r#"technique.dynamic-line.antialiasing="none""#,
    r#"technique.dynamic-line.simplification="none""#,
    r#"technique.dynamic-line.boxes="enclosing""#,
];

/// Fills, an outline inside its polygon, lines and dashes over one another, each of a colour of its own.
fn layers(width: &str) -> String {
    format!(
        r##"
[[layer]]
features = [{{ polygon = [[-90, -70], [60, -80], [80, 60], [-70, 70]], properties = {{ name = "wood" }} }}]
fill = {{ color = "#008000" }}
outline = {{ color = "#804000", width_m = 14, mode = "inset", join = "miter" }}
[[layer]]
features = [{{ line = [[-120, 20], [0, -30], [130, 40]] }}, {{ line = [[-40, -120], [10, 110]] }}]
line = {{ color = "#ff0000", {width} = 9, join = "bevel", dash = [50, 12] }}
[[layer]]
features = [{{ polygon = [[0, 0], [50, 5], [45, 45], [-5, 40]] }}]
fill = {{ color = "#ffff00" }}
"##
    )
}

fn ids(frame: &Frame) -> Vec<u32> {
    match &frame.planes.iter().find(|plane| plane.name == "id").unwrap().values {
        Values::U32(ids) => ids.clone(),
        other => panic!("ids are no {other:?}"),
    }
}

const PICKS: [&str; 3] = ["id", "id-starts", "ids"];

fn has_picks(kind: &Kind) -> bool {
    kind.buffer_names().iter().any(|name| name == PlaneKind::ID.name)
}

fn paint_of(stage: &Stage, item: u32) -> [u8; 3] {
    let [r, g, b, _] = stage.draw_list.style_of(item).paint.0.map(|v| (v * 255.0 + 0.5) as u8);
    [r, g, b]
}

#[test]
fn the_id_of_a_pixel_is_the_feature_that_its_picture_shows() {
    let mut asked = 0;
    for width in ["width_m", "width_px"] {
        let stage = stage(&scene(HILLS, CAMERA, &layers(width)), &SINGLE);
        // Where borders cross a pixel, areas show no feature's own paint.
        let by_samples =
            kinds_for(&stage).into_iter().filter(has_picks).filter(|kind| *kind != Kind::Analytic);
        for kind in by_samples {
            let frame = frame_of(kind, &stage, &PICKS);
            assert_eq!(
                frame.image,
                frame_of(kind, &stage, &[]).image,
                "{kind:?}: asking changes the picture"
            );
            let mut seen = std::collections::BTreeSet::new();
            for (pixel, id) in frame.image.values().iter().zip(ids(&frame)) {
                let shown = [pixel[0], pixel[1], pixel[2]];
                let is_bare = shown == [255; 3] || shown == [0, 0, 255];
                match id {
                    u32::MAX => assert!(is_bare, "{kind:?} shows {shown:?} where no feature is"),
                    item => {
                        assert_eq!(shown, paint_of(&stage, item), "{kind:?}");
                        seen.insert(item);
                    }
                }
            }
            assert!(seen.len() >= 4, "{kind:?}: {seen:?}");
            asked += 1;
        }
    }
    assert_eq!(asked, 6);
}

#[test]
fn all_features_of_a_pixel_are_the_topmost_and_those_below_in_draw_order() {
    let stage = stage(&scene(HILLS, CAMERA, &layers("width_m")), &[]);
    for kind in kinds_for(&stage).into_iter().filter(has_picks) {
        let frame = frame_of(kind, &stage, &PICKS);
        let mut several = 0;
        for (x, y) in (0..64).flat_map(|y| (0..96).map(move |x| (x, y))) {
            let (topmost, all) = picked(&frame.planes, [x, y]).unwrap();
            assert!(all.windows(2).all(|pair| pair[0] > pair[1]), "{kind:?} {all:?}");
            assert!(topmost.is_none_or(|item| all.contains(&item)), "{kind:?} {topmost:?} {all:?}");
            several += usize::from(all.len() > 1);
        }
        assert!(several > 50, "{kind:?}: {several}");
    }
}

#[test]
fn the_truth_and_exact_samples_pick_the_same_features() {
    let stage = stage(&scene(HILLS, CAMERA, &layers("width_m")), &SINGLE);
    let view = stage.view().unwrap();
    let touched = Touched::of(&stage, &view, &Budget::default(), &|_| {});
    let planes = touched.touches.planes(64, &|_| true);
    for kind in [Kind::StaticDecal, Kind::StencilVolume, Kind::Analytic] {
        let frame = frame_of(kind, &stage, &PICKS);
        for (x, y) in (0..64).flat_map(|y| (0..96).map(move |x| (x, y))) {
            let (topmost, all) = picked(&planes, [x, y]).unwrap();
            let (of_kind, all_of_kind) = picked(&frame.planes, [x, y]).unwrap();
            assert_eq!(of_kind, topmost, "{kind:?} at {x},{y}");
            assert!(all_of_kind.iter().all(|item| all.contains(item)), "{kind:?} at {x},{y}");
        }
    }
    // What covers all of a pixel is there whatever decides.
    for (at, coverage) in touched.coverage.values().iter().enumerate() {
        let (_, all) = picked(&planes, [at % 96, at / 96]).unwrap();
        let covering = coverage.items.iter().filter(|item| item.low > 0.001);
        assert!(covering.into_iter().all(|item| all.contains(&item.item)));
    }
}

#[test]
fn one_mask_for_a_colour_tells_no_feature() {
    let stage =
        stage(&scene(HILLS, CAMERA, &layers("width_m")), &[r#"technique.stencil-volume.grouping="color""#]);
    assert!(frame_of(Kind::StencilVolume, &stage, &PICKS).planes.is_empty());
}
