//! How to use this library, chapter by chapter. Every example runs as a test.
//!
//! 1. [A first picture](#a-first-picture)
//! 2. [The truth](#the-truth)
//! 3. [Judging a picture in a test](#judging-a-picture-in-a-test)
//! 4. [Looking into a technique](#looking-into-a-technique)
//! 5. [One scene, many views](#one-scene-many-views)
//! 6. [A scene built in code](#a-scene-built-in-code)
//! 7. [A bundle for a program on a GPU](#a-bundle-for-a-program-on-a-gpu)
//! 8. [Times and reports](#times-and-reports)
//! 9. [When something is wrong](#when-something-is-wrong)
//!
//! # A first picture
//!
//! A scene file names terrain and vectors and says how they look ([`scene_file`](crate::scene_file); `drapery new dem.tif roads.shp`
//! writes one, `docs/contract.md` lists its keys). [`open`](crate::open()) reads it and all that it names; a
//! [`Technique`](crate::Technique) draws it.
//!
//! ```
//! use drapery::Technique;
//! use drapery::output::{write_png, write_whole};
//!
//! # let folder = tempfile::tempdir().unwrap();
//! # std::fs::write(folder.path().join("scene.toml"), drapery::tutorial::SMALL_SCENE).unwrap();
//! # let path = |name: &str| folder.path().join(name);
//! let scene = drapery::open(path("scene.toml"))?;
//! for note in scene.notes() {
//!     println!("note: {note}"); // a layer in another CRS, points that were left out, ...
//! }
//! let frame = Technique::StencilVolume.draw(&scene.stage)?;
//! write_whole(&path("picture.png"), |file| write_png(&frame.image, file))?;
//! # assert!(path("picture.png").exists());
//! # Ok::<(), drapery::Error>(())
//! ```
//!
//! The same scene has the same bits on any number of threads, in any build, on any processor: `frame.image.hash()` may stand in a test.
//!
//! # The truth
//!
//! A pixel's right colour is the mean, over the pixel's square, of the ground composed with every feature that covers the visible point
//! (`docs/semantics.md`). [`Truth`](crate::Truth) holds two bounds that certainly contain it, for each channel, and an estimate between
//! them; a [`Budget`](crate::Budget) says how far apart they may be.
//!
//! ```
//! use drapery::{Budget, Truth};
//! # let scene = drapery::Opened::parse(drapery::tutorial::SMALL_SCENE)?;
//! let truth = Truth::of(&scene.stage, &Budget::new(0.001, 12)?)?;
//! let (low, high) = (truth.low.at(32, 24), truth.high.at(32, 24));
//! assert!(low[0] <= high[0] && truth.widest() <= 0.001);
//! let picture = truth.image(); // 8-bit codes
//! # assert_eq!(picture.width(), 64);
//! # Ok::<(), drapery::Error>(())
//! ```
//!
//! # Judging a picture in a test
//!
//! A [`Verdict`](crate::Verdict) needs what is expected, a picture, and what it may be off by. What is expected is another picture
//! ([`Expected::exactly`](crate::Expected::exactly)), two bounds ([`Expected::between`](crate::Expected::between)), or the truth
//! ([`expected`](crate::expected())). Distances are in units of 1: one step of an 8-bit code is 1/255. Another size, a NaN, a missing file
//! are failures of their own, never a pass.
//!
//! ```
//! use drapery::{Expected, Image, Limits, Verdict};
//! # let folder = tempfile::tempdir().unwrap();
//! # let path = |name: &str| folder.path().join(name);
//! # for name in ["golden.png", "mine.png"] {
//! #     let picture = drapery::buffer::Buffer::from_values(4, 2, vec![[9, 9, 9, 255]; 8]);
//! #     drapery::output::write_whole(&path(name), |file| drapery::output::write_png(&picture, file))?;
//! # }
//! let golden = Expected::exactly(Image::read(&path("golden.png"))?); // PNG, EXR or .npy
//! let verdict = Verdict::on(&Image::read(&path("mine.png"))?, &golden, Limits::new(2.0 / 255.0, 20)?);
//! if let Some(map) = verdict.heat_map() {
//!     drapery::output::write_whole(&path("heat.png"), |file| drapery::output::write_png(&map, file))?;
//! }
//! assert!(verdict.passed(), "{verdict}");
//! # Ok::<(), drapery::Error>(())
//! ```
//!
//! A project whose tests do only this takes `drapery = { version = "0.1", default-features = false }` as a development dependency: no
//! renderer, no SQLite and no command line are compiled then.
//!
//! # Looking into a technique
//!
//! A technique's stages leave buffers: where two programs differ, the first buffer that differs is nearest to the cause. They are made when they
//! are asked for by name, and written as `.npy` ([`Npy`](crate::output::Npy)).
//!
//! ```
//! use drapery::technique::{self, FrameOptions};
//! use drapery::Technique;
//! # let scene = drapery::Opened::parse(drapery::tutorial::SMALL_SCENE)?;
//! let prepared = technique::prepare(Technique::InverseProjection, &scene.stage)?;
//! let buffers = Technique::InverseProjection.buffer_names();
//! let frame = prepared.frame(&scene.view()?, &FrameOptions { buffers: &buffers, ..FrameOptions::default() })?;
//! for plane in &frame.planes {
//!     println!("{}: {} x {} x {}, {}", plane.name, plane.width, plane.height, plane.components, plane.hash());
//! }
//! for (what, count) in &frame.counts {
//!     println!("{what}: {count}");
//! }
//! # assert!(frame.planes.iter().any(|plane| plane.name == "class") && !frame.counts.is_empty());
//! # Ok::<(), drapery::Error>(())
//! ```
//!
//! # One scene, many views
//!
//! A [`Stage`](crate::Stage) does not hold the view: what is prepared once draws from anywhere.
//!
//! ```
//! use drapery::space::World;
//! use drapery::technique::{self, FrameOptions};
//! use drapery::Technique;
//! # let scene = drapery::Opened::parse(drapery::tutorial::SMALL_SCENE)?;
//! let stage = &scene.stage;
//! let prepared = technique::prepare(Technique::Clipmap, stage)?;
//! let mut camera = stage.scene.camera;
//! for step in 0..3 {
//!     camera.eye = World::new(camera.eye.x + 50.0, camera.eye.y, camera.eye.z);
//!     let view = camera.view(&stage.scene.image)?;
//!     let frame = prepared.frame(&view, &FrameOptions::default())?;
//!     println!("{step}: {}", frame.image.hash());
//! }
//! # Ok::<(), drapery::Error>(())
//! ```
//!
//! # A scene built in code
//!
//! [`Scene::new`](crate::Scene::new) takes a camera and layers; the rest is as in a scene file that says nothing, and every field can be set.
//! The heights are a [`Surface`](crate::scene::Surface).
//!
//! ```
//! use drapery::glam::DVec2;
//! use drapery::scene::{Camera, Cap, Color, Feature, Join, Layer, Line, Posts, Shape, Style, Surface, Width};
//! use drapery::space::{Plan, World};
//! use drapery::{Scene, Stage, Technique};
//!
//! let orange = Color::from_rgba8([255, 127, 0, 255]);
//! let line = Line { color: orange, width: Width::Metres(12.0), join: Join::Round, cap: Cap::Round };
//! let road = vec![vec![Plan::new(-400.0, -300.0), Plan::new(0.0, 0.0), Plan::new(400.0, 100.0)]];
//! let road = Feature { index: 0, style: 0, shape: Shape::Line(road) };
//! let roads = Layer::uniform("roads", Style { line: Some(line), ..Style::default() }, vec![road]);
//!
//! // 33 x 33 posts, 30 m apart, from the south-western one.
//! let heights = (0..33 * 33).map(|k| f64::from(k % 33 * 3 + k / 33)).collect();
//! let steps = (DVec2::new(30.0, 0.0), DVec2::new(0.0, 30.0));
//! let posts = Posts::new((33, 33), Plan::new(-480.0, -480.0), steps, heights)?;
//!
//! let camera = Camera::new(World::new(0.0, -1000.0, 600.0), World::new(0.0, 0.0, 50.0));
//! let mut scene = Scene::new(camera, vec![roads]);
//! (scene.image.width, scene.image.height) = (96, 64);
//! let stage = Stage::new(scene, Surface::Grid(posts))?;
//! let frame = Technique::InverseProjection.draw(&stage)?;
//! # assert_eq!(frame.image.height(), 64);
//! # Ok::<(), drapery::Error>(())
//! ```
//!
//! # A bundle for a program on a GPU
//!
//! A [`Bundle`](crate::Bundle) holds all that another program needs to draw the same: mesh, features, matrices, parameters, the picture that it
//! should get with every buffer on the way, and for each pixel what is allowed.
//!
//! ```
//! use drapery::{Bundle, Technique};
//! # let scene = drapery::Opened::parse(drapery::tutorial::SMALL_SCENE)?;
//! # let folder = tempfile::tempdir().unwrap();
//! # let folder = folder.path().join("bundle");
//! Bundle::of(&scene.stage, Technique::InverseProjection).write_to(&folder)?;
//! println!("{}", std::fs::read_to_string(folder.join("README.md")).unwrap()); // what is where
//! # assert!(folder.join("truth.lo.npy").exists());
//! # Ok::<(), drapery::Error>(())
//! ```
//!
//! # Times and reports
//!
//! Nothing in this library reads a clock or prints: who measures lends one, as a [`Watch`](crate::measure::Watch), which also hears of progress
//! and of what is left out. [`measure`](crate::measure) times single runs; [`report::measure`](crate::report::measure()) runs every technique over its
//! settings, and [`report::write`](crate::report::write) makes a page of it.
//!
//! ```
//! use drapery::measure::Watch;
//! use drapery::output::Batch;
//! use drapery::{Budget, report};
//! use std::time::Instant;
//!
//! struct Terminal(Instant);
//!
//! impl Watch for Terminal {
//!     fn milliseconds(&self) -> f64 {
//!         self.0.elapsed().as_secs_f64() * 1000.0
//!     }
//!     fn note(&self, text: &str) {
//!         eprintln!("note: {text}");
//!     }
//! }
//!
//! # fn main() -> drapery::Result<()> {
//! # if false {
//! let scene = drapery::open("scene.toml")?;
//! let measured = report::measure(scene, &Budget::default(), 3, &Terminal(Instant::now()))?;
//! report::write(vec![measured], 3, Batch::into("report".as_ref())?)?;
//! # }
//! # Ok(())
//! # }
//! ```
//!
//! # When something is wrong
//!
//! An [`Error`](crate::Error) says what is wrong, where, and what to do. A program matches on its [`kind`](crate::Error::kind); the error that led to
//! it, of the system or of a library, is its `source`.
//!
//! ```
//! use drapery::{ErrorKind, Opened};
//! let error = Opened::parse("schema = 1\nterrain.source = \"dem.tif\"\n").unwrap_err();
//! assert_eq!(error.kind(), ErrorKind::Io);
//! assert_eq!(error.to_string().lines().next(), Some("line 2, column 18: there is no file `dem.tif`"));
//! match error.kind() {
//!     ErrorKind::Unsupported => println!("not by this build, version or technique"),
//!     ErrorKind::Io => println!("the system refuses"),
//!     _ => println!("{error}"),
//! }
//! ```

/// The scene of this tutorial: a road and a lake on a cone, 64 x 48 pixels.
pub const SMALL_SCENE: &str = r##"
schema = 1
image = { width = 64, height = 48 }
camera = { eye = [0, -1100, 700], target = [0, 0, 60] }
terrain.generate = { kind = "cone", posts = [33, 33], cell_m = 30.0, height_m = 200.0 }

[[layer]]
name = "lake"
features = [ { polygon = [[-300, -350], [-80, -380], [-60, -220], [-280, -200]] } ]
fill = { color = "#3388ff", opacity = 0.6 }

[[layer]]
name = "road"
features = [ { line = [[-400, -300], [0, 0], [400, 100]] } ]
line = { color = "#ff7f00", width_m = 20 }

[technique.clipmap]
virtual_size = 4096
"##;
