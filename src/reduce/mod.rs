//! The smallest scene that still shows what is wrong.
//!
//! Input: a [`Draft`] of a scene, and who tells whether a draft still fails. Output: a smaller draft that does; its [`Draft::text`] is a scene
//! file with all features in it. Refuses: scenes on a globe.
//!
//! Delta debugging (Zeller & Hildebrandt 2002, *Simplifying and isolating failure-inducing input*): something is left out, and if it still
//! fails, stays out. First features, then what the picture shows, vertices, the terrain, settings; round after round, until nothing
//! can be left out.

mod crop;
mod draft;
mod fewest;
mod settings;
mod shrink;
mod vertices;
mod written;

pub use draft::{Draft, DraftLayer, SCENE_FILE};
pub use shrink::{Failing, Reduced, reduce};
