//! The crate read as code: what each file says of other files, and who stands on whom.
//!
//! What is compiled for tests only is left out, wherever it stands; comments and strings are no code.

#![allow(clippy::unwrap_used, reason = "helpers of tests are no tests to the lint")]

mod circles;
mod code;
mod graph;
mod tokens;
mod tree;

pub use circles::circles;
pub use code::Code;
pub use graph::edges;
pub use tree::{House, module_of};
