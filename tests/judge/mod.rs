//! A bundle made by hand, and how the command line is called with it.

pub mod bundle;
pub mod calls;
mod damaged;
mod sets;
