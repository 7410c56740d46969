//! A scene and its pictures -> folders of files: [`Pictures`] as `drapery render` writes them, and a [`Bundle`] for a program that draws
//! the same on a graphics processor.
//!
//! Input: a stage, the technique, how exact the truth is. Output: pictures, buffers and `result.json`; for a bundle also tables of the
//! mesh, the features as GeoJSON, the numbers of the view as JSON, the tiles of a texture as pictures. Its `README.md` tells
//! what is where and how the technique goes, `manifest.json` what each file was. Refuses: what a technique refuses; then nothing is written.

mod allowed;
mod buffers;
mod bundle;
pub mod conformance;
mod features;
mod gltf;
mod items;
mod manifest;
mod mesh;
mod parameters;
mod picked;
mod pictures;
mod readme;
mod run_files;
mod tiles;

pub use allowed::stage_allowed;
pub use buffers::Buffers;
pub use bundle::Bundle;
pub use conformance::Conformance;
pub use features::{FeatureTable, write_features};
pub use items::{item_paints, items};
pub use mesh::{plan_points, triangles, vertices};
pub use parameters::{Camera, Canvas, GroundParameters, Parameters};
pub use pictures::Pictures;
pub use tiles::{TilePicture, tiles};
