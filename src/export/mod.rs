//! A scene and its pictures -> files for a program that draws the same on a graphics processor.
//!
//! Input: a loaded scene, its mesh and view; a technique's buffers. Output: tables of the mesh, the features as GeoJSON, the numbers
//! of the view as JSON, the tiles of a texture as pictures. `layout.md` tells a reader of the bundle what is where. Refuses: nothing.

mod features;
mod mesh;
mod parameters;
mod tiles;

pub use features::write_features;
pub use mesh::{plan_points, triangles, vertices};
pub use parameters::{Camera, Canvas, Ground, Parameters};
pub use tiles::{TilePicture, tiles};

/// What the files of a bundle hold, for people.
pub const LAYOUT: &str = include_str!("layout.md");
