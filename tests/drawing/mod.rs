//! What tests of techniques share: scenes from text, frames, and how far they are from the truth.

#![allow(dead_code, reason = "each test file uses its part")]
#![allow(clippy::unwrap_used, reason = "helpers of tests are no tests to the lint")]

use drapery::compare::{Difference, Image, Metrics};
use drapery::measure;
use drapery::scene::{Scene, Surface};
use drapery::scene_file::{Override, SceneFile};
use drapery::stage::Stage;
use drapery::technique::{self, Frame, FrameOptions, Kind};
use drapery::truth::{self, Budget, Truth};

/// A scene of 96 x 64 pixels over a terrain, with these layers and other keys.
pub fn scene(terrain: &str, camera: &str, more: &str) -> String {
    format!(
        "schema = 1\nimage = {{ width = 96, height = 64, background = \"#0000ff\" }}\n\
         terrain = {{ generate = {{ {terrain} }}, color = \"#ffffff\" }}\ncamera = {{ {camera} }}\n{more}"
    )
}

/// A scene in memory, with changes, and its terrain's heights.
pub fn loaded(text: &str, changes: &[&str]) -> (Scene, Surface) {
    let changes: Vec<Override> = changes.iter().map(|c| Override::parse(c).unwrap()).collect();
    let file = SceneFile::parse(text, None, &changes).unwrap_or_else(|e| panic!("{e}"));
    drapery::source::load::load(&file, &|_| {}).unwrap_or_else(|e| panic!("{e}"))
}

/// A scene ready to be drawn, with changes.
pub fn stage(text: &str, changes: &[&str]) -> Stage {
    let (scene, surface) = loaded(text, changes);
    Stage::new(scene, surface).unwrap_or_else(|e| panic!("{e}"))
}

/// A frame of a stage by a technique, with buffers.
pub fn frame_of(kind: Kind, stage: &Stage, buffers: &[&str]) -> Frame {
    let prepared = technique::prepare(kind, stage).unwrap_or_else(|e| panic!("{e}"));
    let buffers: Vec<String> = buffers.iter().map(|b| (*b).to_owned()).collect();
    prepared
        .frame(&stage.view().unwrap(), &FrameOptions { tile: 128, buffers: &buffers, progress: &|_| {} })
        .unwrap()
}

/// The techniques that draw a stage.
pub fn kinds_for(stage: &Stage) -> Vec<Kind> {
    Kind::ALL.into_iter().filter(|kind| technique::applies(*kind, stage).is_ok()).collect()
}

/// Those of them that draw footprints: geometry overlay draws lines of the screen, and polygons by their outlines.
pub fn kinds_of_footprints_for(stage: &Stage) -> Vec<Kind> {
    kinds_for(stage).into_iter().filter(|kind| *kind != Kind::GeometryOverlay).collect()
}

/// The truth of a stage.
pub fn truth_of(stage: &Stage) -> Truth {
    truth::certify(stage, &stage.view().unwrap(), &Budget::default(), &|_| {})
}

/// How far a picture is from the truth.
pub fn errors(truth: &Truth, image: &Image) -> Metrics {
    Difference::of(&measure::expected(truth).unwrap(), image).unwrap().metrics(0.0)
}

/// A number of a frame.
pub fn count(frame: &Frame, name: &str) -> u64 {
    frame.counts.iter().find(|(known, _)| *known == name).unwrap().1
}
