//! Failures that users of real systems reported, as scenes with a known right answer, over every technique and several machines; and how
//! errors grow with what makes scenes hard.
//!
//! Input: the numbers of the cases that are wanted ([`Plan`]). Output: a [`Suite`]: of each case, technique and machine the figures, and
//! whether they are as they should be, a known artifact of the technique's paper, or refused ([`Suite::text`], [`Suite::json`],
//! [`Suite::page`]); and the [`Curve`]s. Refuses: numbers that no case has.
//!
//! Each case is a [`Case`] in a file of its chapter: scenes, and a function that draws them by whoever is asked (`Hand`) and says what it
//! found. The answer is a closed form, another scene's picture, or the truth.

mod artifact;
mod camera;
mod case;
mod figure;
mod hand;
mod json;
mod machine;
mod page;
mod picture;
mod polygons;
mod precision;
mod real_files;
mod setup;
mod stability;
mod strokes;
mod suite;
mod surface;
mod text;
mod tiles;

pub use case::{Case, Row, Verdict};
pub use figure::{Bound, Figure};
pub use stability::{Curve, curves};
pub use suite::{CaseResult, Plan, Suite, cases, run};
