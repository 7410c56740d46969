//! `drapery export` as an engineer with a GPU calls it: what is in a bundle, and that one can draw with it.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "helpers of tests are no tests to the lint")]

use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

/// Moved by 5000 km and raised by 6400 km, with an outlined lake, a road, and a post without data.
const SCENE: &str = r##"
schema = 1
image = { width = 48, height = 32 }
camera = { eye = [5000000, 3998200, 6401500], target = [5000000, 4000000, 6400100] }
[terrain]
generate = { kind = "fbm", seed = 3, posts = [17, 17], cell_m = 120.0, height_m = 200.0 }
offset = [5000000, 4000000, 6400000]
[[layer]]
name = "lake"
offset = [5000000, 4000000]
features = [{ polygon = [[-300, -400], [300, -400], [300, 200], [-300, 200]] }]
fill = { color = "#3388ff", opacity = 0.6 }
outline = { color = "#113355", width_px = 2.0, mode = "inset" }
[[layer]]
name = "road"
offset = [5000000, 4000000]
features = [{ line = [[-800, -500], [0, 0], [800, -300]], properties = { TYPE = "primary", number = 3 } }]
line = { color = "#ff7f00", width_m = 60.0, join = "bevel" }
[technique.clipmap]
virtual_size = 1024
"##;

fn export(folder: &Path, arguments: &[&str]) -> Output {
    fs::write(folder.join("scene.toml"), SCENE).unwrap();
    let program = env!("CARGO_BIN_EXE_drapery");
    let call =
        Command::new(program).args(["export", "scene.toml"]).args(arguments).current_dir(folder).output();
    call.unwrap()
}

/// Sets a width that no view changes, which all techniques draw.
const IN_METRES: [&str; 4] =
    ["--set", "layer.lake.outline.width_px=", "--set", "layer.lake.outline.width_m=20"];

fn bundle(technique: &str, more: &[&str]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let done = export(folder.path(), &[&["-t", technique, "-o", "."], more].concat());
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    folder
}

fn json(folder: &tempfile::TempDir, name: &str) -> Value {
    serde_json::from_slice(&fs::read(folder.path().join(name)).unwrap()).unwrap()
}

/// The numbers of a table of 8-byte or 4-byte values.
fn table(folder: &tempfile::TempDir, name: &str) -> Vec<f64> {
    let bytes = fs::read(folder.path().join(name)).unwrap();
    let header = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    let (text, values) = bytes[10..].split_at(header);
    if String::from_utf8_lossy(text).contains("<f8") {
        values.as_chunks().0.iter().map(|v| f64::from_le_bytes(*v)).collect()
    } else {
        values.as_chunks().0.iter().map(|v| f64::from(u32::from_le_bytes(*v))).collect()
    }
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

#[test]
fn the_mesh_and_the_matrix_put_every_visible_point_on_its_pixel() {
    let folder = bundle("clipmap", &[]);
    let parameters = json(&folder, "parameters.json");
    let origin = numbers(&parameters["origin"]);
    assert_eq!((&origin[..], &parameters["origin_height"]), (&[5e6, 4e6][..], &Value::from(6.4e6)));
    assert_eq!(json(&folder, "result.json")["scene"]["origin_height"], 6.4e6);
    assert_eq!(numbers(&parameters["camera"]["eye"]), [0.0, -1800.0, 1500.0], "the camera is local too");
    let rows: Vec<Vec<f64>> =
        parameters["camera"]["clip_from_world"].as_array().unwrap().iter().map(numbers).collect();
    let (vertices, triangles) = (table(&folder, "mesh.vertices.npy"), table(&folder, "mesh.triangles.npy"));
    let (seen, plan) = (table(&folder, "clipmap.triangle.npy"), table(&folder, "clipmap.plan.npy"));
    let mut looked_at = 0;
    for (pixel, triangle) in seen.iter().enumerate().filter(|(_, id)| **id < 4e9) {
        let corner = |k: usize| {
            let vertex = triangles[3 * *triangle as usize + k] as usize;
            [vertices[3 * vertex], vertices[3 * vertex + 1], vertices[3 * vertex + 2]]
        };
        let (a, b, c) = (corner(0), corner(1), corner(2));
        let at = [plan[2 * pixel] - origin[0], plan[2 * pixel + 1] - origin[1]];
        let cross = |p: [f64; 2], q: [f64; 2]| p[0] * q[1] - p[1] * q[0];
        let from_a = |p: &[f64]| [p[0] - a[0], p[1] - a[1]];
        let area = cross(from_a(&b), from_a(&c));
        let (u, v) = (cross(from_a(&at), from_a(&c)) / area, cross(from_a(&b), from_a(&at)) / area);
        let height = a[2] + u * (b[2] - a[2]) + v * (c[2] - a[2]);
        let clip = |k: usize| rows[k][0] * at[0] + rows[k][1] * at[1] + rows[k][2] * height + rows[k][3];
        let (x, y) = ((2 * (pixel % 48) + 1) as f64 / 48.0 - 1.0, 1.0 - (2 * (pixel / 48) + 1) as f64 / 32.0);
        assert!(
            (clip(0) / clip(3) - x).abs() < 1e-6 && (clip(1) / clip(3) - y).abs() < 1e-6,
            "pixel {pixel}"
        );
        assert!(clip(2) >= 0.0 && clip(2) <= clip(3));
        looked_at += 1;
    }
    assert!(looked_at > 500, "{looked_at}");
}

#[test]
fn the_bundle_of_the_clipmap_has_its_sequences_tiles_and_what_is_right() {
    let folder = bundle("clipmap", &[]);
    let strips = table(&folder, "clipmap.strips.npy");
    let firsts: Vec<(f64, f64)> = strips.chunks(5).map(|s| (s[0], s[4])).collect();
    // The lake's outline: Algorithm 1 makes four corners and the first once more; the road: two ends and a joint.
    assert_eq!(firsts, [(0.0, 10.0), (1.0, 6.0)]);
    let vertices = table(&folder, "clipmap.vertices.npy");
    assert!(vertices.chunks(2).all(|p| (p[0] - 5e6).abs() < 1000.0 && (p[1] - 4e6).abs() < 1000.0));
    for file in ["README.md", "clipmap.png", "truth.png", "truth.lo.npy", "truth.hi.npy", "result.json"] {
        assert!(folder.path().join(file).is_file(), "{file}");
    }
    let keys = table(&folder, "clipmap.tile-keys.npy");
    for key in keys.chunks(3) {
        let size = 1024 >> key[0] as u32;
        let name = match size {
            256.. => format!("tiles/{}/{}/{}.png", (size as u32 / 256).ilog2(), key[1], key[2]),
            _ => format!("tiles/below/{size}.png"),
        };
        let picture = image::open(folder.path().join(&name)).unwrap();
        assert_eq!(picture.width(), size.min(256) as u32, "{name}");
    }
    for left_out in ["clipmap.tiles.npy", "clipmap.tiles.png"] {
        assert!(!folder.path().join(left_out).exists(), "{left_out}: the pyramid has them");
    }
    let features = json(&folder, "features.geojson");
    assert_eq!((&features["crs"], &features["plan_space"]), (&Value::Null, &"metres without a CRS".into()));
    assert_eq!(
        (&features["drawn_by"], &features["widths"]),
        (&"clipmap".into(), &"whole: from side to side".into())
    );
    let lake = &features["features"][0];
    assert_eq!(lake["geometry"]["coordinates"][0][1].to_string(), "[5000300.0,3999600.0]");
    assert_eq!(lake["geometry"]["coordinates"][0].as_array().unwrap().len(), 5, "rings are closed");
    let [lake, road] = [0, 1].map(|k| features["features"][k]["properties"].to_string());
    assert_eq!(
        lake,
        r##"{"cap":"butt","drawn-cap":"butt","drawn-join":"algorithm-1","feature":0,"fill":"#3388ff","fill-opacity":0.6,"fill-rule":"even-odd","join":"round","layer":"lake","layer-number":0,"number":0,"outline-mode":"inset","stroke":"#113355","stroke-opacity":1.0,"stroke-width-px":2.0}"##
    );
    assert_eq!(
        road,
        r##"{"TYPE":"primary","attribute.number":3,"cap":"butt","drawn-cap":"butt","drawn-join":"algorithm-1","feature":0,"join":"bevel","layer":"road","layer-number":1,"number":0,"stroke":"#ff7f00","stroke-opacity":1.0,"stroke-width-m":60.0}"##
    );
}

#[test]
fn the_manifest_tells_of_every_file_what_it_was() {
    let folder = bundle("clipmap", &[]);
    let manifest = json(&folder, "manifest.json");
    assert_eq!(
        (&manifest["schema"], &manifest["kind"], &manifest["technique"]),
        (&1.into(), &"bundle".into(), &"clipmap".into())
    );
    let files = manifest["files"].as_array().unwrap();
    let names: Vec<&str> = files.iter().map(|file| file["name"].as_str().unwrap()).collect();
    assert!(
        names.is_sorted()
            && names.contains(&"README.md")
            && names.iter().any(|name| name.starts_with("tiles/"))
    );
    for file in files {
        let bytes = fs::read(folder.path().join(file["name"].as_str().unwrap())).unwrap();
        assert_eq!(
            (file["bytes"].as_u64(), &file["blake3"]),
            (Some(bytes.len() as u64), &blake3::hash(&bytes).to_hex().to_string().into())
        );
    }
    // Of the scene and of the manifest itself nothing is told.
    let there =
        fs::read_dir(folder.path()).unwrap().filter(|entry| entry.as_ref().unwrap().path().is_file()).count();
    assert_eq!(names.iter().filter(|name| !name.contains('/')).count(), there - 2);
}

#[test]
fn the_volumes_of_a_bundle_count_what_the_picture_shows() {
    let folder = bundle("stencil-volume", &IN_METRES);
    let of = |name: &str| table(&folder, &format!("stencil-volume.{name}.npy"));
    let (objects, volumes, levels) = (of("objects"), of("volumes"), of("volume-levels"));
    let (rings, corners) = (of("volume-rings"), of("volume-corners"));
    assert_eq!(
        (objects.len() / 8, volumes.len() / 6, levels.len() / 2),
        (3, 7, 7),
        "fill, outline, road: 1, 4 and 2 volumes"
    );
    let winding = |volume: usize, at: [f64; 2]| -> i32 {
        let [first, count] = [volumes[6 * volume] as usize, volumes[6 * volume + 1] as usize];
        let ring = |k: usize| &corners[2 * rings[2 * k] as usize..][..2 * rings[2 * k + 1] as usize];
        (first..first + count).map(|k| turns(ring(k), at)).sum()
    };
    let (plan, stencil, triangle) =
        (of("plan"), table_u16(&folder, "stencil-volume.stencil.npy"), of("triangle"));
    let mut counted = 0;
    for (pixel, count) in stencil.iter().enumerate().filter(|(pixel, _)| triangle[*pixel] < 4e9) {
        let at = [plan[2 * pixel], plan[2 * pixel + 1]];
        let of_object = |object: usize| -> i32 {
            let [first, number] = [objects[8 * object + 3] as usize, objects[8 * object + 4] as usize];
            (first..first + number).map(|volume| winding(volume, at)).sum()
        };
        let last = (0..3).map(of_object).rfind(|count| *count != 0).unwrap_or(0);
        assert_eq!(i32::from(*count), last, "pixel {pixel}");
        counted += u32::from(last != 0);
    }
    assert!(counted > 50, "{counted}");
}

#[test]
fn the_edges_of_a_bundle_meet_the_quads_that_say_so() {
    let folder = bundle("inverse-projection", &IN_METRES);
    let of = |name: &str| table(&folder, &format!("inverse-projection.{name}.npy"));
    let (areas, edges, edge_areas) = (of("areas"), of("area-edges"), of("edge-areas"));
    assert_eq!(
        areas.chunks(8).map(|row| (row[0], row[3])).collect::<Vec<_>>(),
        [(0.0, 0.0), (1.0, 1.0), (2.0, 1.0)]
    );
    // The outline is cut to the inside of the fill's polygon.
    assert_eq!(areas[8..16], [1.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 0.0]);
    assert_eq!((edges.len() / 4, edge_areas.len()), (4 + 8 + 6, 18));
    let (quads, met) = (of("quad"), of("edges"));
    let mut looked_at = 0;
    for (pixel, quad) in quads.chunks(8).enumerate().filter(|(_, quad)| quad[0].is_finite()) {
        // Of an edge that ends in the quad's bounds and lies in it, the count must tell.
        let inside = |at: &[f64]| turns(quad, [at[0], at[1]]) != 0;
        let ends = edges.chunks(4).filter(|edge| inside(&edge[..2]) || inside(&edge[2..])).count();
        assert!(met[pixel] >= ends as f64, "pixel {pixel}");
        looked_at += ends;
    }
    assert!(looked_at > 10, "{looked_at}");
}

#[test]
fn a_bundle_is_for_the_device_that_is_named_and_says_so_first() {
    let device = |more: &[&str]| {
        let folder = bundle("stencil-volume", &[&IN_METRES[..], more].concat());
        let text = fs::read_to_string(folder.path().join("parameters.json")).unwrap();
        assert_eq!(text.lines().nth(2).map(str::trim), Some("\"device\": {"));
        json(&folder, "parameters.json")["device"].clone()
    };
    let swiftshader = device(&["--device", "swiftshader"]);
    assert_eq!((&swiftshader["subpixel_bits"], &swiftshader["precision"]), (&4.into(), &"f32".into()));
    let changed = device(&["--device", "llvmpipe", "--set", "device.subpixel_bits=4"]);
    assert_eq!(
        (&changed["subpixel_bits"], &changed["interpolation"]),
        (&4.into(), &"unsnapped".into()),
        "--set is over it"
    );
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("mine.toml"), "[device]\nsub_bits = 8\n").unwrap();
    for (asked, said) in [
        ("mine.toml", "mine.toml: a device has no key `sub_bits`"),
        ("voodoo", "there is no device `voodoo`"),
    ] {
        let done = export(folder.path(), &["-t", "clipmap", "--device", asked, "-o", "out"]);
        let told = String::from_utf8_lossy(&done.stderr).into_owned();
        assert_eq!(done.status.code(), Some(2), "{told}");
        assert!(told.contains(said) && !folder.path().join("out").exists(), "{told}");
    }
}

#[test]
fn a_frame_of_another_choice_fails_by_a_bundle_with_alternatives_and_is_told_which() {
    let other = "technique.static-decal.joins=\"style\"";
    let folder = bundle("static-decal", &[&IN_METRES[..], &["--alternatives"]].concat());
    let program = env!("CARGO_BIN_EXE_drapery");
    let call = |arguments: &[&str]| {
        Command::new(program).args(arguments).current_dir(folder.path()).output().unwrap()
    };
    let render = ["render", "scene.toml", "-t", "static-decal", "--set", other, "-o", "frame"];
    assert!(call(&[&render[..], &IN_METRES[..]].concat()).status.success());
    let done = call(&["compare", ".", "frame/static-decal.png"]);
    let said = String::from_utf8_lossy(&done.stdout).into_owned();
    assert_eq!(done.status.code(), Some(1), "{said}");
    let first = said.lines().next().unwrap();
    assert!(first.starts_with("FAIL: ") && first.ends_with(&format!("; by {other} it would pass")), "{said}");
    let files = json(&folder, "allowed.json")["alternatives"].as_array().unwrap().len();
    assert!(files >= 4, "{files}");
}

#[test]
fn a_device_is_asked_for_pictures_and_none_is_no_answer() {
    let folder = tempfile::tempdir().unwrap();
    let call = |arguments: &[&str]| {
        let program = env!("CARGO_BIN_EXE_drapery");
        Command::new(program).arg("calibrate").args(arguments).current_dir(folder.path()).output().unwrap()
    };
    assert!(call(&["export", "-o", "asked"]).status.success());
    assert!(folder.path().join("asked/edges.vertices.npy").is_file());
    let done = call(&["read", "asked"]);
    assert_eq!((done.status.code(), &done.stdout[..]), (Some(2), &b""[..]));
    fs::write(folder.path().join("asked/edges.png"), "half a picture").unwrap();
    assert_eq!(call(&["read", "asked"]).status.code(), Some(2));
}

#[test]
fn the_conformance_set_of_a_technique_is_written_for_a_device() {
    let folder = tempfile::tempdir().unwrap();
    let program = env!("CARGO_BIN_EXE_drapery");
    let coarse = ["--set", "image.width=40", "--set", "image.height=30", "--truth-width", "0.5"];
    let mut call = Command::new(program);
    call.args(["export", "--conformance", "-t", "dynamic-line", "--device", "lavapipe", "-o", "set"])
        .args(coarse);
    assert!(call.current_dir(folder.path()).status().unwrap().success());
    let table: Value =
        serde_json::from_slice(&fs::read(folder.path().join("set/conformance.json")).unwrap()).unwrap();
    let cases = table["cases"].as_array().unwrap();
    assert_eq!(
        (cases[0]["name"].as_str(), cases[0]["bundle"].as_str()),
        (Some("screen-widths.dynamic-line"), Some("screen-widths/dynamic-line"))
    );
    for case in cases {
        let bundle = folder.path().join("set").join(case["bundle"].as_str().unwrap());
        let parameters: Value =
            serde_json::from_slice(&fs::read(bundle.join("parameters.json")).unwrap()).unwrap();
        assert_eq!(parameters["device"]["interpolation"], "unsnapped");
        assert!(bundle.join("manifest.json").is_file() && !case["exposes"].as_str().unwrap().is_empty());
    }
    let both = Command::new(program).args(["export", "scene.toml", "--conformance"]).output().unwrap();
    assert_eq!(both.status.code(), Some(2), "a scene is not the set");
}

/// How often a ring winds around a point, counter-clockwise positive.
fn turns(ring: &[f64], at: [f64; 2]) -> i32 {
    let corner = |k: usize| [ring[2 * k % ring.len()] - at[0], ring[(2 * k + 1) % ring.len()] - at[1]];
    let crossing = |k: usize| {
        let (a, b) = (corner(k), corner(k + 1));
        let is_left = a[0] * b[1] - a[1] * b[0] > 0.0;
        match (a[1] <= 0.0, b[1] <= 0.0) {
            (true, false) if is_left => 1,
            (false, true) if !is_left => -1,
            _ => 0,
        }
    };
    (0..ring.len() / 2).map(crossing).sum()
}

/// The numbers of a table of 2-byte values.
fn table_u16(folder: &tempfile::TempDir, name: &str) -> Vec<u16> {
    let bytes = fs::read(folder.path().join(name)).unwrap();
    let header = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    bytes[10 + header..].as_chunks().0.iter().map(|v| u16::from_le_bytes(*v)).collect()
}

#[test]
fn every_technique_has_a_bundle_and_a_wrong_call_leaves_nothing() {
    for technique in ["stencil-volume", "inverse-projection"] {
        let folder = bundle(technique, &IN_METRES);
        assert_eq!(json(&folder, "parameters.json")["technique"], technique);
        assert!(folder.path().join(format!("{technique}.png")).is_file());
        assert!(!folder.path().join("tiles").exists());
    }
    for wrong in [&["-t", "truth"][..], &["-t", "raytracing"], &[], &["-t", "clipmap", "--set", "nonsense=1"]]
    {
        let folder = tempfile::tempdir().unwrap();
        let done = export(folder.path(), &[wrong, &["-o", "out"]].concat());
        assert_eq!(done.status.code(), Some(2), "{wrong:?}");
        assert!(!folder.path().join("out").exists());
    }
}
