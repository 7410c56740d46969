//! The same scene gives the same bits: whatever the threads, the tiles, the build, the place of the scene.
//!
//! The hashes below are those of every buffer of a scene together, by inverse projection. They change only when a pixel changes, which is
//! then said in the commit. (Goldens hold those of all techniques.)

use drapery::buffer::Plane;
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
        let text = mountains([0; 3], more);
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
        let here = hashes(kind, &mountains([0; 3], more), 128, 2);
        for by in [[5_000_000, -5_000_000, 0], [6_400_000; 3], [-6_400_000, 6_400_000, -6_400_000]] {
            assert_eq!(hashes(kind, &mountains(by, more), 128, 2), here, "{kind:?}, moved by {by:?}");
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
    assert_eq!(
        together(&hashes(Kind::InverseProjection, &mountains([0; 3], ""), 128, 2)),
        "3186dd76f49f0c05"
    );
    assert_eq!(
        together(&hashes(Kind::InverseProjection, &mountains([0; 3], IMITATED), 128, 2)),
        "465ff6b2a46a921b"
    );
}
