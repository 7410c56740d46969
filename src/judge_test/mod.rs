//! Whether the judge can be trusted: it is shown pictures with planted bugs, which it has to fail, and pictures of other right programs, which
//! it has to pass.
//!
//! Input: a [`Plan`]. Output: a [`Trial`], counts by technique and by class of bugs ([`Trial::text`], [`Trial::json`]), which meets its
//! [`goals`](Trial::faults) or says why not. The same pictures are judged by the usual comparators (`contrast`), for contrast. Refuses:
//! scenes that do not exist; nothing of the corpus.
//!
//! The corpus is in the program: small scenes (`scenes`), `bugs` (edits of a scene, of a view or of the finished picture) and
//! `variants` (machines within the envelope, and other ways to write the same scene). A bug whose picture is the right one bit for bit is
//! no bug there, and counted apart.

mod bugs;
mod contrast;
mod drawing;
mod edit;
mod geometry;
mod judging;
mod picture;
mod scenes;
mod tally;
mod target;
mod told;
mod trial;
mod variants;

pub use tally::{Counts, OfScene, Tightness};
pub use trial::{Plan, Trial, run};
