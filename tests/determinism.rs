//! The same scene gives the same bits: whatever the threads, the tiles, the build, the place of the scene.
//!
//! The hashes below are those of every buffer of a scene together, by inverse projection. They change only when a pixel changes, which is
//! then said in the commit. (Goldens hold those of all techniques.)
#![cfg(feature = "render")]

use drapery::buffer::{Plane, PlaneKind};
use drapery::scene::Surface;
use drapery::scene_file::{Override, SceneFile};
use drapery::stage::Stage;
use drapery::technique::{self, FrameOptions, Kind};
use drapery::truth::{self, Budget, Truth};

/// Mountains, land use, an outlined lake, a road with a sharp turn; seen in perspective over the horizon.
const MOUNTAINS: &str = r##"
schema = 1
image = { width = 150, height = 100, background = "#dde8f0" }
[camera]
eye = [EX, EY, EZ]
target = [TX, TY, TZ]
[terrain]
generate = { kind = "fbm", seed = 11, posts = [65, 57], cell_m = 32.0, height_m = 600.0 }
offset = [OX, OY, OZ]
shade = "hillshade"
[[layer]]
name = "land use"
generate = { kind = "mosaic", seed = 4, count = 40, holes = 0.3 }
fill = { color = "#558855", opacity = 0.5 }
outline = { color = "#223322", width_m = 5.0, mode = "inset" }
[[layer]]
name = "road"
offset = [OX, OY]
features = [ { line = [[-900, -800], [-250.5, 100], [300, -600], [800.25, 700]] } ]
line = { color = "#ff7f00", width_m = 18.0 }
"##;

/// The same on a machine with single precision, snapping and a coarse depth buffer, with linear blending.
const IMITATED: &str = r##"
[device]
precision = "f32"
subpixel_bits = 8
depth = "unorm24"
[compositing]
space = "linear"
[technique.inverse-projection]
corners = "true"
point_in_polygon = "winding"
"##;

/// The scene as a technique draws it: dynamic lines are in pixels, and nothing else is among them.
fn mountains_for(kind: Kind, at: [i64; 3], more: &str) -> String {
    let text = mountains(at, more);
    match kind {
        Kind::DynamicLine => text
            .replace("fill = { color = \"#558855\", opacity = 0.5 }\n", "")
            .replace("width_m = 5.0, mode = \"inset\"", "width_px = 1.5, opacity = 0.5")
            .replace("width_m = 18.0", "width_px = 5.0"),
        _ => text,
    }
}

fn mountains(at: [i64; 3], more: &str) -> String {
    let place = |value: i64, by: i64| format!("{}.0", value + by);
    MOUNTAINS
        .replace("EX", &place(-300, at[0]))
        .replace("EY", &place(-1500, at[1]))
        .replace("EZ", &place(700, at[2]))
        .replace("TX", &place(0, at[0]))
        .replace("TY", &place(0, at[1]))
        .replace("TZ", &place(150, at[2]))
        .replace("OX", &place(0, at[0]))
        .replace("OY", &place(0, at[1]))
        .replace("OZ", &place(0, at[2]))
        + more
}

/// The hash of a technique's picture and of each of its buffers.
fn hashes(kind: Kind, text: &str, tile: usize, threads: usize) -> Vec<String> {
    let file = SceneFile::parse(text, None, &[]).unwrap_or_else(|e| panic!("{e}"));
    let run = || {
        let (scene, surface) = drapery::source::load::load(&file, &|_| {}).unwrap();
        let stage = Stage::new(scene, surface).unwrap();
        let prepared = technique::prepare(kind, &stage).unwrap();
        let buffers = kind.buffer_names();
        let frame = prepared
            .frame(&stage.view().unwrap(), &FrameOptions { tile, buffers: &buffers, progress: &|_| {} })
            .unwrap();
        let mut hashes = vec![format!("image {}", frame.image.hash())];
        hashes.extend(frame.planes.iter().map(|p: &Plane| format!("{} {}", p.name, p.hash())));
        hashes
    };
    drapery::parallel::with_threads(threads, run).unwrap()
}

fn together(hashes: &[String]) -> String {
    blake3::hash(hashes.join("\n").as_bytes()).to_hex()[..16].to_owned()
}

/// All techniques, on any machine and on an imitated one.
fn every_technique() -> impl Iterator<Item = (Kind, &'static str)> {
    Kind::ALL.iter().flat_map(|kind| ["", IMITATED].map(|more| (*kind, more)))
}

#[test]
fn every_buffer_keeps_its_bits_for_any_number_of_threads_and_any_tiles() {
    for (kind, more) in every_technique() {
        let text = mountains_for(kind, [0; 3], more);
        let one = hashes(kind, &text, 128, 1);
        for (tile, threads) in [(128, 2), (32, 3), (50, 7), (128, 16)] {
            assert_eq!(
                hashes(kind, &text, tile, threads),
                one,
                "{kind:?}: tiles of {tile}, {threads} threads"
            );
        }
    }
}

#[test]
fn every_buffer_keeps_its_bits_when_the_scene_is_moved_along_the_ground_and_up() {
    for (kind, more) in every_technique() {
        let here = hashes(kind, &mountains_for(kind, [0; 3], more), 128, 2);
        for by in [[5_000_000, -5_000_000, 0], [6_400_000; 3], [-6_400_000, 6_400_000, -6_400_000]] {
            assert_eq!(
                hashes(kind, &mountains_for(kind, by, more), 128, 2),
                here,
                "{kind:?}, moved by {by:?}"
            );
        }
    }
}

#[test]
fn the_truth_keeps_its_bits_when_the_scene_is_moved_along_the_ground_and_up() {
    let truth_of = |by| {
        let changes =
            [Override::parse("image.width=48").unwrap(), Override::parse("image.height=32").unwrap()];
        let file = SceneFile::parse(&mountains(by, ""), None, &changes).unwrap();
        let (scene, surface) = drapery::source::load::load(&file, &|_| {}).unwrap();
        let stage = Stage::new(scene, surface).unwrap();
        let truth = truth::certify(&stage, &stage.view().unwrap(), &Budget::default(), &|_| {});
        Truth::PLANES.map(|kind| truth.plane(kind.name).unwrap().hash())
    };
    assert_eq!(truth_of([6_400_000; 3]), truth_of([0; 3]));
}

#[test]
fn every_buffer_has_the_bits_of_the_last_version_in_every_build() {
    let of = |more: &str| {
        let mut all = hashes(Kind::InverseProjection, &mountains([0; 3], more), 128, 2);
        // Which items touch pixels follows from what makes the picture.
        let is_pick =
            |line: &str| PlaneKind::PICKS.iter().any(|kind| line.split(' ').next() == Some(kind.name));
        all.retain(|line| !is_pick(line));
        together(&all)
    };
    assert_eq!(of(""), "b22fb56bcaa84805");
    assert_eq!(of(IMITATED), "aad972aea60c1cd6");
}

/// A line in the coordinates of each projection, all about one place of Switzerland.
#[rustfmt::skip]
const LINES: [(&str, &str); 11] = [
    ("EPSG:3035", "[[4125376.83, 2651656.88], [4125935.94, 2651607.58], [4126313.33, 2652114.44]]"),
    ("EPSG:3413", "[[3873921.07, -2979868.59], [3874330.22, -2979391.7], [3874114.24, -2978716.78]]"),
    ("EPSG:3031", "[[4035929.94, 30939364.04], [4039874.23, 30938633.05], [4042909.79, 30941988.02]]"),
    ("EPSG:28992", "[[310985.83, -114270.97], [311547.62, -114285.71], [311894.03, -113754.97]]"),
    ("EPSG:21781", "[[599500.0, 199650.0], [600060.0, 199620.0], [600420.0, 200140.0]]"),
    ("EPSG:5514", "[[-1314283.79, -1292005.05], [-1313743.6, -1292162.16], [-1313273.26, -1291736.36]]"),
    ("+proj=aea +lat_0=30 +lon_0=10 +lat_1=43 +lat_2=62 +ellps=intl +towgs84=-87,-98,-121", "[[-193819.19, 1858259.99], [-193265.05, 1858210.35], [-192889.81, 1858721.72]]"),
    ("EPSG:31287", "[[-48561.16, 355836.41], [-48005.2, 355764.09], [-47606.95, 356255.17]]"),
    ("EPSG:32632", "[[380682.07, 5200571.4], [381241.23, 5200530.27], [381611.42, 5201042.88]]"),
    ("EPSG:3857", "[[827333.67, 5933579.75], [828152.51, 5933535.78], [828678.95, 5934298.54]]"),
    ("EPSG:4326", "[[7.4320648, 46.9479342], [7.4394206, 46.9476646], [7.4441497, 46.952342]]"),
];

/// The bits of all that is reprojected to a plan: the vertices of a layer in each of [`LINES`]' systems, and the posts of a terrain.
fn reprojected(plan: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: String| std::fs::write(folder.path().join(name), text).unwrap();
    let mut posts = String::from("ncols 9\nnrows 9\nxllcenter 7.42\nyllcenter 46.94\ncellsize 0.004\n");
    (0..81).for_each(|i| posts += &format!("{} ", 300 + i * i % 37));
    write("d.asc", posts);
    let mut scene =
        format!("schema = 1\ncrs = \"{plan}\"\nterrain = {{ source = \"d.asc\", crs = \"EPSG:4326\" }}\n");
    for (i, (crs, line)) in LINES.iter().enumerate() {
        write(&format!("{i}.geojson"), format!(r#"{{"type":"LineString","coordinates":{line}}}"#));
        scene += &format!(
            "[[layer]]\nsource = \"{i}.geojson\"\ncrs = \"{crs}\"\nline = {{ color = \"#000000\", width_m = 9 }}\n"
        );
    }
    write("s.toml", scene);
    let file = SceneFile::read(&folder.path().join("s.toml"), &[]).unwrap();
    let (scene, surface) = drapery::source::load::load(&file, &|_| {}).unwrap();
    let told = scene.notes.iter().find(|note| note.contains("between processors"));
    assert_eq!(told, None);
    let mut hash = blake3::Hasher::new();
    let mut add = |number: f64| {
        hash.update(&number.to_le_bytes());
    };
    for feature in scene.layers.iter().flat_map(|layer| &layer.features) {
        feature.shape.parts().flatten().for_each(|p| [p.x, p.y].into_iter().for_each(&mut add));
    }
    let Surface::Grid(posts) = surface else { panic!("a grid") };
    posts.heights().iter().copied().for_each(&mut add);
    hash.finalize().to_hex()[..16].to_owned()
}

#[test]
fn what_is_reprojected_has_the_bits_of_the_last_version_in_every_build() {
    let albers = LINES[6].0;
    let found = ["EPSG:2056", "EPSG:3035", "EPSG:5514", "EPSG:28992", "EPSG:3413", albers].map(reprojected);
    assert_eq!(
        found,
        [
            "e7799e2bfe7f5728",
            "dfdc46b5ce0f8565",
            "df441037a62a52ac",
            "00b98c586cf0f9f7",
            "32ba72dadf7863a6",
            "45ae55f467f224ac"
        ]
    );
}
