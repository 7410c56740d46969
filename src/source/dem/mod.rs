//! Terrain files -> posts or points, in the file's own coordinates.

use crate::crs::Crs;
use crate::error::Result;
use crate::scene::Surface;
use std::path::Path;

/// What to read of a terrain file.
#[derive(Debug, Clone, Copy, Default)]
pub struct DemOptions {
    /// Only this part: x0, y0, x1, y1 in the file's own coordinates; grown to whole posts around it.
    pub window: Option<[f64; 4]>,
    /// How a PNG encodes heights; `None` refuses PNG files with a hint.
    pub encoding: Option<PngEncoding>,
}

/// How a PNG encodes heights.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PngEncoding {
    /// R * 256 + G + B / 256 - 32768 metres.
    Terrarium,
    /// (R * 65536 + G * 256 + B) / 10 - 10000 metres.
    Mapbox,
}

/// A terrain file's content.
#[derive(Debug, Clone)]
pub struct Dem {
    /// Heights in the file's own coordinates (absolute; degrees for a geographic CRS).
    pub surface: Surface,
    /// The CRS the file states.
    pub crs: Option<Crs>,
    /// What the user should know.
    pub notes: Vec<String>,
}

/// Reads a terrain file, the format told by its extension and content.
///
/// # Errors
/// When the file is missing, damaged, absurd or of an unsupported kind: says what and where.
pub fn read(_path: &Path, _options: &DemOptions) -> Result<Dem> {
    Err(crate::Error::internal("not built yet"))
}
