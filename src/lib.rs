//! Drapery: the reference renderer for 2D vector data draped over 3D terrain.
//!
//! Data walks through the rooms in this order; `docs/architecture.md` has the picture.
//!
//! 1. [`source`] reads what a scene file ([`scene_file`]) names: terrain and vectors, brought to one plan by [`crs`];
//! 2. [`scene`] is what is drawn, in memory, in scene-local coordinates ([`space`]);
//! 3. [`draw_list`] decides what is painted; [`terrain`] makes a mesh with bounding boxes of the heights; together they are a [`stage`];
//! 4. [`raster`] and [`visibility`] find, exactly, which triangle each sample sees, and where;
//! 5. [`technique`] draws, each beside its paper, on a [`canvas`]; [`resolve`] composes colours;
//! 6. [`output`] writes pictures, buffers and numbers;
//! 7. [`compare`] says how far a picture is from what is expected; [`golden`] replays what is known;
//! 8. [`report`] sets that against time, beside the [`truth`] and plain supersampling ([`sampling`]);
//! 9. [`export`] makes the files with which a program on a graphics processor draws the same.
//!
//! ```
//! use drapery::scene_file::SceneFile;
//! use drapery::stage::Stage;
//! use drapery::technique::{self, FrameOptions, Kind};
//!
//! let text = r##"
//!     schema = 1
//!     image = { width = 64, height = 48 }
//!     terrain.generate = { kind = "cone", posts = [33, 33], cell_m = 30.0, height_m = 200.0 }
//!     [[layer]]
//!     features = [ { line = [[-400, -300], [0, 0], [400, 100]] } ]
//!     line = { color = "#ff7f00", width_m = 20 }
//! "##;
//! let file = SceneFile::parse(text, None, &[])?;
//! let (scene, surface) = drapery::source::load::load(&file, &|_| {})?;
//! let stage = Stage::new(scene, surface)?;
//! let prepared = technique::prepare(Kind::InverseProjection, &stage)?;
//! let frame = prepared.frame(&stage.view()?, &FrameOptions { tile: 128, buffers: &[], progress: &|_| {} })?;
//! assert_eq!(frame.image.width(), 64);
//! # Ok::<(), drapery::Error>(())
//! ```
#![cfg_attr(not(test), warn(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

pub mod buffer;
pub mod canvas;
pub mod certainty;
pub mod compare;
pub mod crs;
pub mod draw_list;
mod error;
pub mod export;
pub mod footprint;
pub mod golden;
pub mod index;
pub mod interval;
pub mod math;
pub mod output;
pub mod parallel;
pub mod parameter;
pub mod predicate;
pub mod raster;
pub mod report;
pub mod resolve;
pub mod sampling;
pub mod scene;
pub mod scene_file;
pub mod source;
pub mod space;
pub mod stage;
pub mod technique;
pub mod terrain;
pub mod tiling;
pub mod truth;
pub mod visibility;

pub use error::{Error, Position, Result};
