//! Vector files -> features, in the file's own coordinates.
//!
//! Reads GeoJSON, shapefiles, FlatGeobuf and GeoPackage: polygons and lines, in file order (FlatGeobuf: the order of
//! the file, which is its index's and not the source's; GeoPackage: by primary key). Points, empty geometries, heights and
//! measures are left out and counted in the notes. Refuses what is damaged, not finite, or of no plan (multipatches),
//! naming file and feature; never allocates by a count that the file's length does not bear out.
//!
//! Each feature of the file becomes one [`Feature`](crate::scene::Feature) with all its parts; a geometry collection becomes one for each
//! member, with the same index. Rings lose their closing vertex.

mod bytes;
mod collector;
mod flatgeobuf;
mod geojson;
mod geopackage;
mod shapefile;
mod summary;
mod wkb;

pub use collector::VectorFile;
pub use summary::{VectorSummary, describe};

use crate::error::{Error, Result};
use bytes::cannot_read;
use collector::Collector;
use std::fmt;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// The kinds of file that are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum VectorFormat {
    /// RFC 7946, and its predecessor's `crs` member.
    GeoJson,
    /// Esri shapefile.
    Shapefile,
    /// FlatGeobuf 3.
    FlatGeobuf,
    /// OGC GeoPackage.
    GeoPackage,
}

impl fmt::Display for VectorFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::GeoJson => "GeoJSON",
            Self::Shapefile => "shapefile",
            Self::FlatGeobuf => "FlatGeobuf",
            Self::GeoPackage => "GeoPackage",
        })
    }
}

/// Reads a vector file, the format told by its extension and content. `layer` names the layer of a GeoPackage.
///
/// # Errors
/// When the file is missing, damaged, absurd or of an unsupported kind: says what and where.
pub fn read(path: &Path, layer: Option<&str>) -> Result<VectorFile> {
    read_collected(path, layer).map(|(_, found)| found.into_file()).map_err(|e| e.in_file(path))
}

fn read_collected(path: &Path, layer: Option<&str>) -> Result<(VectorFormat, Collector)> {
    let format = format_of(path)?;
    if let (Some(layer), true) = (layer, format != VectorFormat::GeoPackage) {
        return Err(Error::new(format!("a {format} has no layers, so none named '{layer}'"))
            .help("leave the layer out; it is for GeoPackages"));
    }
    let found = match format {
        VectorFormat::GeoJson => geojson::read(path)?,
        VectorFormat::Shapefile => shapefile::read(path)?,
        VectorFormat::FlatGeobuf => flatgeobuf::read(path)?,
        VectorFormat::GeoPackage => geopackage::read(path, layer)?,
    };
    Ok((format, found))
}

/// The format by what the file begins with; a name that promises another is refused.
fn format_of(path: &Path) -> Result<VectorFormat> {
    let start = beginning_of(path)?;
    let promised = promised_by_name(path);
    let found = told_by_content(&start);
    match (promised, found) {
        (Some(promised), Some(found)) if promised == found => Ok(found),
        (None, Some(found)) => Ok(found),
        (_, None) if start.is_empty() => Err(Error::new("the file is empty").help("write the file again")),
        (Some(promised), None) => {
            Err(Error::new(format!("this is not a {promised}, whatever its name says"))
                .help("check that the file was copied whole"))
        }
        (Some(promised), Some(found)) => {
            Err(Error::new(format!("the name says {promised} but the content is a {found}"))
                .help("give the file the extension of what it is"))
        }
        (None, None) => Err(Error::new("this is no vector file of a kind known here")
            .help("use .geojson, .json, .shp, .fgb or .gpkg")),
    }
}

fn beginning_of(path: &Path) -> Result<Vec<u8>> {
    if path.is_dir() {
        return Err(Error::new("this is a folder, not a file").help("name the file in it"));
    }
    let mut start = Vec::new();
    File::open(path).and_then(|file| file.take(512).read_to_end(&mut start)).map_err(|e| cannot_read(&e))?;
    Ok(start)
}

fn promised_by_name(path: &Path) -> Option<VectorFormat> {
    let extension = path.extension()?.to_str()?.to_ascii_lowercase();
    Some(match extension.as_str() {
        "geojson" | "json" => VectorFormat::GeoJson,
        "shp" => VectorFormat::Shapefile,
        "fgb" => VectorFormat::FlatGeobuf,
        "gpkg" => VectorFormat::GeoPackage,
        _ => return None,
    })
}

fn told_by_content(start: &[u8]) -> Option<VectorFormat> {
    let text = start.strip_prefix(b"\xef\xbb\xbf").unwrap_or(start);
    if start.starts_with(b"SQLite format 3\0") {
        Some(VectorFormat::GeoPackage)
    } else if start.starts_with(b"fgb") {
        Some(VectorFormat::FlatGeobuf)
    } else if start.starts_with(&9994_u32.to_be_bytes()) {
        Some(VectorFormat::Shapefile)
    } else {
        let first = text.iter().find(|b| !b.is_ascii_whitespace());
        (first == Some(&b'{')).then_some(VectorFormat::GeoJson)
    }
}

#[cfg(test)]
mod tests;
