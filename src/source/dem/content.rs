//! What a terrain file holds, and how much of it one call may read.

use super::geo_keys::CrsHint;
use crate::scene::Surface;

/// The most posts that one call reads (1 GiB of heights); larger terrain is read through a window.
pub const MAX_POSTS: usize = 1 << 27;

/// The most scattered points that one call reads.
pub const MAX_POINTS: usize = 1 << 25;

/// A terrain file's content.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Dem {
    /// Heights in the file's own coordinates (absolute; degrees for a geographic CRS).
    pub surface: Surface,
    /// What the file says of its CRS, as it says it.
    pub crs_hint: Option<CrsHint>,
    /// Whether the file says in which unit its heights are; they are in metres in any case.
    pub states_unit: bool,
    /// What the user should know.
    pub notes: Vec<String>,
}
