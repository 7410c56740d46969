//! How much can be numbered.

use crate::error::Error;

/// The most vertices, and the most items.
pub(super) const MOST: usize = u32::MAX as usize / 2;

/// The refusal of more.
pub(super) fn too_many(what: &str) -> Error {
    Error::new(format!("more {what} than this program can number")).help("give the terrain a `window`")
}
