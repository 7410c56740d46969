//! Runs with their times: the truth of a stage, supersampling, a technique's picture, and how far a picture is from the truth.
//!
//! Input: a [`Stage`], a view of it and a [`Watch`], which lends its clock and is told what is going on: nothing below the command line
//! reads a clock or prints. Output: [`Certified`], [`Drawn`] and [`Sampled`](crate::sampling::Sampled) with their [`Times`]. Refuses: what a
//! technique refuses. Two runs of the same thing that differ are a bug, and told as such.
//!
//! ```
//! use drapery::measure::{Certified, Drawn, Watch};
//! use drapery::{Budget, Technique};
//! use std::time::Instant;
//!
//! struct Stopwatch(Instant);
//!
//! impl Watch for Stopwatch {
//!     fn milliseconds(&self) -> f64 {
//!         self.0.elapsed().as_secs_f64() * 1000.0
//!     }
//! }
//!
//! # let scene = drapery::Opened::parse(drapery::tutorial::SMALL_SCENE)?;
//! let (stage, view) = (&scene.stage, &scene.stage.view()?);
//! let watch = Stopwatch(Instant::now());
//! let certified = Certified::of((stage, view), &Budget::default(), 1, &watch)?;
//! let drawn = Drawn::by(Technique::InverseProjection, (stage, view), (3, &|_| false), &watch)?;
//! let error = certified.metrics(&drawn.frame.image)?;
//! println!("{} ms, off by {} at most", drawn.draw.median, error.max);
//! # assert!(drawn.draw.max > 0.0 && error.max < 0.5);
//! # Ok::<(), drapery::Error>(())
//! ```

mod certified;
mod drawn;
mod expected;
mod sampled;
mod times;
mod touched;
mod watch;

pub use certified::Certified;
pub use drawn::{Drawn, Seen, applicable, flight};
pub use expected::{expected, half_widths, image};
pub use sampled::supersampled;
pub use times::Times;
pub use touched::touched;
pub use watch::{Unwatched, Watch, timed};

use crate::error::Error;
use crate::output::{ByName, SceneResult, SurfaceError};
use crate::parameter::{Settings, Value};
use crate::scene::Device;
use crate::space::ViewFrame;
use crate::stage::Stage;
use crate::terrain::lod::Deviation;
use serde_json::Value as Json;

/// A device as a scene file writes it under `[device]`.
pub fn device_words(device: &Device) -> ByName {
    // Its numbers have always had a point in files.
    let spelt = |value| if let Value::Number(number) = value { number.into() } else { Json::from(value) };
    ByName::from_pairs(device.values().into_iter().map(|(name, value)| (name, spelt(value))))
}

/// What is told of a scene. `hash` is that of its file (`SceneFile::hash`); a scene that was built in code may have any name there.
pub fn scene_result(stage: &Stage, hash: &str) -> SceneResult {
    let scene = &stage.scene;
    SceneResult {
        name: scene.name.clone(),
        hash: hash.to_owned(),
        plan_space: scene.plan_space.clone(),
        origin: scene.origin.truncate().to_array(),
        origin_height: scene.origin.z,
        surface_error: None,
    }
}

/// What is told of a scene in a view.
pub fn view_result(stage: &Stage, view: &ViewFrame, hash: &str) -> SceneResult {
    let told = stage.mesh_for(view).deviation().map(|deviation| {
        let Deviation { metres, pixels, left_out } = deviation;
        SurfaceError { metres, pixels, left_out }
    });
    SceneResult { surface_error: told, ..scene_result(stage, hash) }
}

/// Two pictures of one scene that should be the same are not.
fn unequal(what: &str) -> Error {
    Error::internal(format!("two frames of {what} of the same scene differ"))
}
