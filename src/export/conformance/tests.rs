//! Each case shows what it says it shows: a picture with the fault is another.

use super::*;
use crate::buffer::Buffer;

/// What imitates a fault that a case exposes: changes of its scene. Where a technique of its own is named, of that alone.
const FAULTS: &[(&str, &[&str])] = &[
    ("caps", &["technique.stencil-volume.caps=bottom"]),
    ("caps", &["technique.stencil-volume.method=z-pass"]),
    ("eye-inside", &["technique.stencil-volume.method=z-pass", "technique.stencil-volume.far=clip"]),
    ("wrap", &["technique.stencil-volume.overflow=saturate"]),
    (
        "draw-order",
        &[
            "layer.below.features=[{ polygon = [[-60.0, -60.0], [180.0, -60.0], [180.0, 180.0], [-60.0, 180.0]] }, { polygon = [[20.0, -140.0], [100.0, -140.0], [100.0, 40.0], [20.0, 40.0]] }]",
            "layer.above.features=[{ polygon = [[-180.0, -120.0], [60.0, -120.0], [60.0, 120.0], [-180.0, 120.0]] }]",
            "layer.below.fill.color=#3060c0",
            "layer.above.fill.color=#c04030",
            "layer.below.outline.color=#001040",
            "layer.above.outline.color=#400000",
        ],
    ),
    // The nearest numbers of single precision.
    (
        "far-origin",
        &[
            "layer.kerbs.features=[{ line = [[512338.125, 4980117.0], [512347.1875, 4980123.0], [512352.125, 4980130.0]] }, { line = [[512338.15625, 4980129.0], [512351.125, 4980116.0]] }]",
        ],
    ),
    (
        "holes",
        &[
            "layer.lake.features=[{ polygon = [[[-220.0, -160.0], [220.0, -160.0], [200.0, 200.0], [-200.0, 180.0]], [[-120.0, -80.0], [-100.0, 100.0], [120.0, 110.0], [110.0, -90.0]]] }]",
        ],
    ),
    (
        "joins",
        &[
            "layer.road.features=[{ line = [[-220.0, -140.0], [-120.0, 120.0]] }, { line = [[-120.0, 120.0], [-20.0, -120.0]] }, { line = [[-20.0, -120.0], [60.0, 60.0]] }, { line = [[60.0, 60.0], [200.0, 60.0]] }, { line = [[200.0, 60.0], [200.0, -120.0]] }]",
            "technique.static-decal.joins=style",
        ],
    ),
    ("rules", &["layer.odd.fill.rule=nonzero"]),
    ("rules", &["layer.all.fill.rule=even-odd"]),
    (
        "overlaps",
        &[
            "layer.road.features=[{ line = [[-200.0, -120.0], [160.0, 120.0], [160.0, -60.0]] }, { line = [[160.0, -60.0], [-160.0, 140.0]] }]",
        ],
    ),
    ("widths", &["layer.narrow.line.width_m=12", "layer.wide.line.width_m=30"]),
    ("widths", &["layer.narrow.line.width_m=25.2", "layer.wide.line.width_m=63"]),
    ("outlines", &["layer.inside.outline.mode=normal"]),
    ("outlines", &["layer.outside.outline.mode=inset"]),
    ("inverted", &["layer.field.fill.invert=false"]),
    ("points", &["layer.towns.features=[{ points = [[-150.0, -100.0], [0.0, 0.0], [160.0, 120.0]] }]"]),
    // Half a pixel is half a metre.
    ("half-pixel", &["camera.eye=[0.5, 0.5, 300.0]", "camera.target=[0.5, 0.5, 0.0]"]),
    (
        "near-plane",
        &[
            "layer.roads.features=[{ line = [[30.0, -60.0], [30.0, 200.0]] }, { line = [[-200.0, -107.0], [-20.0, 240.0]] }]",
        ],
    ),
    ("sky", &["image.background=#80b0ff"]),
    ("silhouettes", &["technique.inverse-projection.silhouette=smear"]),
    ("layer-opacity", &["layer.fields.opacity=", "layer.fields.fill.opacity=0.5"]),
    ("linear", &["compositing.space=encoded"]),
    ("additive", &["compositing.mode=over"]),
    ("hillshade", &["terrain.light.azimuth_deg=100"]),
    ("diagonal", &["terrain.diagonal=sw-ne"]),
    ("edge-normals", &["technique.inverse-projection.point_in_polygon=winding"]),
    ("clip-region", &["technique.clipmap.clip_size=2048"]),
    ("clip-region", &["technique.clipmap.center=[200.0, 200.0]"]),
    ("anisotropy", &["technique.clipmap.filter=trilinear"]),
    ("anisotropy", &["technique.clipmap.level_bias=1"]),
    ("sample-places", &["technique.static-decal.samples=9"]),
    ("screen-widths", &["layer.roads.line.width_px=3.5"]),
    ("thin-lines", &["technique.dynamic-line.thin_lines=none"]),
];

/// A picture in which fewer pixels differ would not tell a fault from what devices do otherwise.
const LEAST: usize = 24;

fn pictures(case: &Case, changes: &[&str]) -> Vec<(Kind, Buffer<[u8; 4]>)> {
    let changes: Vec<Override> = changes.iter().map(|text| Override::parse(text).unwrap()).collect();
    let scene = case.open(&changes).unwrap_or_else(|error| panic!("{}: {error}", case.name));
    case.techniques.iter().map(|kind| (*kind, kind.draw(&scene.stage).unwrap().image)).collect()
}

#[test]
fn every_case_shows_the_faults_that_it_says_it_shows() {
    let mut hidden = Vec::new();
    for case in &CASES {
        let right = pictures(case, &[]);
        let faults = FAULTS.iter().filter(|(name, _)| *name == case.name);
        let mut count = 0;
        for (_, changes) in faults {
            for ((kind, right), (_, wrong)) in right.iter().zip(pictures(case, changes)) {
                let pairs = right.values().iter().zip(wrong.values());
                let other = pairs.filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 2)).count();
                if other < LEAST {
                    hidden.push(format!(
                        "{} by {}: {changes:?} changes {other} pixels",
                        case.name,
                        kind.name()
                    ));
                }
            }
            count += 1;
        }
        assert!(count > 0, "{}: no fault is tried", case.name);
    }
    assert!(hidden.is_empty(), "{hidden:#?}");
    assert!(FAULTS.iter().all(|(name, _)| CASES.iter().any(|case| case.name == *name)));
}

#[test]
fn the_set_of_a_technique_is_its_bundles_and_a_table_of_them() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("set");
    let budget = Budget::new(0.5, 2).unwrap();
    let set = Conformance { technique: Some(Kind::DynamicLine), changes: &[], budget, alternatives: false };
    let count = set.write(Batch::into(&out).unwrap(), &crate::measure::Unwatched).unwrap();
    let text = std::fs::read(out.join("conformance.json")).unwrap();
    let table: serde_json::Value = serde_json::from_slice(&text).unwrap();
    let cases = table["cases"].as_array().unwrap();
    assert_eq!((cases.len(), &cases[0]["name"]), (count, &"screen-widths.dynamic-line".into()));
    for case in cases {
        let bundle = out.join(case["bundle"].as_str().unwrap());
        let manifest: serde_json::Value =
            serde_json::from_slice(&std::fs::read(bundle.join("manifest.json")).unwrap()).unwrap();
        let names = manifest["files"].as_array().unwrap().iter().map(|file| file["name"].as_str().unwrap());
        assert!(names.clone().all(|name| bundle.join(name).is_file()));
        assert!(names.clone().any(|name| name == "dynamic-line.png"));
    }
}
