//! The parameters that a person can set: what is said of each, once.

mod named;

pub use named::Named;
