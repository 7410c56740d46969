//! Vector files -> features, in the file's own coordinates.

use crate::crs::Crs;
use crate::error::Result;
use crate::scene::Feature;
use std::path::Path;

/// A vector file's content.
#[derive(Debug, Clone)]
pub struct VectorFile {
    /// Polygons and lines in file order, coordinates as in the file (absolute).
    pub features: Vec<Feature>,
    /// The CRS the file states.
    pub crs: Option<Crs>,
    /// What the user should know (points left out, empty geometries, ...).
    pub notes: Vec<String>,
}

/// Reads a vector file, the format told by its extension and content. `layer` names the layer of a GeoPackage.
///
/// # Errors
/// When the file is missing, damaged, absurd or of an unsupported kind: says what and where.
pub fn read(_path: &Path, _layer: Option<&str>) -> Result<VectorFile> {
    Err(crate::Error::internal("not built yet"))
}
