//! The reference renderer for 2D vector data draped over 3D terrain.
//!
//! Roads, rivers and borders are put on terrain in a handful of ways, each with a paper. Drapery runs them in software,
//! deterministically, and computes beside them **the truth**: each pixel's right colour as a certified interval.
//!
//! ```
//! use drapery::{Budget, Image, Limits, Technique, Truth, Verdict, expected};
//!
//! # let folder = tempfile::tempdir().unwrap();
//! # let path = folder.path().join("scene.toml");
//! # std::fs::write(&path, drapery::tutorial::SMALL_SCENE).unwrap();
//! let scene = drapery::open(&path)?; // a scene file, with the terrain and vectors that it names
//! let truth = Truth::of(&scene.stage, &Budget::default())?;
//! let frame = Technique::InverseProjection.draw(&scene.stage)?;
//! let picture = Image::from_rgba8(&frame.image)?;
//! let verdict = Verdict::on(&picture, &expected(&truth)?, Limits::new(1.0 / 255.0, 0)?);
//! println!("{verdict}"); // FAIL: 296 of 3072 pixels are over the tolerance ...
//! # assert!(!verdict.passed());
//! # Ok::<(), drapery::Error>(())
//! ```
//!
//! The [`tutorial`] goes through all that one does with it; `examples/` in the repository has four programs to start from; the
//! command line `drapery` does the same without Rust.
//!
//! # Rooms
//!
//! Data walks through them in this order; `docs/architecture.md` has the picture. What others may build on:
//!
//! 1. [`mod@open`] reads a scene file ([`scene_file`]) and what it names; or [`scene`] is built in code, in scene-local coordinates
//!    ([`space`]);
//! 2. [`stage`] is a scene with its terrain, ready to be drawn;
//! 3. [`technique`] draws it, each beside its paper; [`truth`] certifies it;
//! 4. [`compare`] says how far a picture is from what is expected, and judges a frame by what a bundle allows; [`golden`] replays what is known;
//! 5. [`measure`] times; [`report`] sets error against time; [`export`] makes folders of pictures, and bundles for a program on a graphics
//!    processor; [`calibrate`] tells which machine that is;
//! 6. [`buffer`] holds images, [`output`] writes files, [`parallel`] says how many threads there are.
//!
//! Internals, public for the tests and benches of this repository, which may change in any version: [`crs`], [`source`] (files become
//! scenes), [`parameter`] (what is declared of settings), [`draw_list`] (what is painted), [`terrain`] (a mesh with bounding boxes),
//! [`raster`] and [`visibility`] (which triangle each sample sees, exactly), [`resolve`] (colours are composed), [`index`], [`tiling`] and
//! [`canvas`] (what frames are made of), [`decal`] (which items hold a plan point), [`certainty`] (how doubt composes), [`sampling`] (plain supersampling), [`math`]; and what is not
//! public at all.
//!
//! # Features
//!
//! `cli` (the program), `gpkg` (GeoPackages, by a SQLite that is compiled along) and, below both, `render` are on by default. Without any
//! (`default-features = false`) there is the judge alone: [`compare`] with its readers, [`output`], [`buffer`]. `docs/features.md` says what
//! each costs.
#![cfg_attr(not(test), warn(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

#[cfg(feature = "render")]
pub mod allowed;
pub mod buffer;
#[cfg(feature = "render")]
pub mod calibrate;
#[cfg(feature = "render")]
pub mod canvas;
#[cfg(feature = "render")]
pub mod certainty;
pub mod compare;
#[cfg(feature = "render")]
pub mod crs;
#[cfg(feature = "render")]
pub mod decal;
#[cfg(feature = "render")]
pub mod draw_list;
mod error;
#[cfg(feature = "render")]
pub mod explain;
#[cfg(feature = "render")]
pub mod export;
#[cfg(feature = "render")]
pub mod figures;
#[cfg(feature = "render")]
pub(crate) mod footprint;
#[cfg(feature = "render")]
pub mod golden;
#[cfg(feature = "render")]
pub mod hard_cases;
#[cfg(feature = "render")]
pub(crate) mod holding;
#[cfg(feature = "render")]
pub mod index;
#[cfg(feature = "render")]
pub(crate) mod interval;
#[cfg(feature = "render")]
pub mod judge_test;
pub mod math;
#[cfg(feature = "render")]
pub mod measure;
#[cfg(feature = "render")]
pub mod open;
pub mod output;
#[cfg(feature = "render")]
pub(crate) mod overlay;
#[cfg(feature = "render")]
pub mod parallel;
#[cfg(feature = "render")]
pub mod parameter;
#[cfg(feature = "render")]
pub(crate) mod predicate;
#[cfg(feature = "render")]
pub mod raster;
#[cfg(feature = "render")]
pub mod reduce;
#[cfg(feature = "render")]
pub mod report;
#[cfg(feature = "render")]
pub mod resolve;
#[cfg(feature = "render")]
pub mod sampling;
#[cfg(feature = "render")]
pub mod scene;
#[cfg(feature = "render")]
pub mod scene_file;
#[cfg(test)]
mod seeds;
#[cfg(feature = "render")]
pub mod source;
#[cfg(feature = "render")]
pub mod space;
#[cfg(feature = "render")]
pub mod stage;
#[cfg(feature = "render")]
pub mod technique;
#[cfg(feature = "render")]
pub mod terrain;
#[cfg(feature = "render")]
pub mod tiling;
#[cfg(feature = "render")]
pub mod truth;
#[cfg(feature = "render")]
pub mod tutorial;
#[cfg(feature = "render")]
pub mod visibility;

pub use compare::{Expected, Gates, Image, Judge, Limits, Verdict};
pub use error::{Error, ErrorKind, Position, Result};
#[cfg(feature = "render")]
pub use {
    export::Bundle,
    measure::expected,
    open::{Opened, open},
    scene::Scene,
    stage::Stage,
    technique::{Frame, Kind as Technique},
    truth::{Budget, Truth},
};

/// The vectors in the signatures of [`scene`] and [`space`].
pub use glam;
