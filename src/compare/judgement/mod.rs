//! What is allowed and a frame -> the judgement: which hypothesis fits, what lies outside, and to which side the open pixels lean.

mod fit;
mod gates;
mod involved;
mod lean;
mod on;
mod otherwise;
mod stages;

pub use gates::{Gates, MOST_IN_WINDOW};
pub use involved::Involved;
pub use lean::{Lean, Lopsided};
pub use on::{Fitted, Judgement, Ruling, Tried};
pub use otherwise::Otherwise;
pub use stages::{StageFound, StageOutcome};
