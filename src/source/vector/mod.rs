//! Vector files -> features, in the file's own coordinates.
//!
//! Reads GeoJSON, shapefiles, FlatGeobuf, GeoPackage and OpenStreetMap's PBF, all but GeoPackages from a zip archive too: polygons,
//! lines and points, in file order (FlatGeobuf: the order of the file, which is its index's and not the source's; GeoPackage: by primary
//! key; OpenStreetMap: ways, then relations, no points). Empty geometries, heights and
//! measures are left out and counted in the notes. Refuses what is damaged, not finite, or of no plan (multipatches),
//! naming file and feature; never allocates by a count that the file's length does not bear out.
//!
//! Attributes are read only where a column is asked for ([`read_columns`]), and of these columns alone: of shapefiles from the
//! .dbf, of GeoJSON from `properties`, of the others from their tables. Refuses values that are not what their column says,
//! naming file, feature and column.
//!
//! Each feature of the file becomes one [`Feature`] with all its parts, polygons by members; a geometry collection becomes one for its
//! polygons and one for its lines, with the same index. Rings lose their closing vertex.

mod archive;
mod attributes;
mod bytes;
mod code_page;
mod collector;
mod column_summary;
mod curve;
mod dbf;
mod doubts;
mod flatgeobuf;
mod foreign;
mod geojson;
#[cfg(feature = "gpkg")]
mod geopackage;
mod osm;
mod rings;
mod shapefile;
mod summary;
#[cfg(not(feature = "gpkg"))]
mod without_geopackage;
#[cfg(feature = "gpkg")]
mod wkb;

pub(super) use collector::is_drawable;
pub use column_summary::{ColumnKind, ColumnSummary};
pub(super) use doubts::MOST_TURNS;
pub use doubts::doubts;
pub(super) use rings::{inner_point, signed_area};
pub(super) use shapefile::NO_PRJ;
pub use summary::{VectorSummary, describe};

use crate::crs::Crs;
use crate::error::{Error, Result};
use crate::scene::{Column, Feature};
use crate::source::packed;
use attributes::Wanted;
use collector::Collector;
use shapefile::Parts;
use std::fmt;
use std::fs::File;
use std::io::Read;
use std::path::Path;
#[cfg(not(feature = "gpkg"))]
use without_geopackage as geopackage;

/// A vector file's content.
#[derive(Debug, Clone)]
pub struct VectorFile {
    /// Polygons and lines in file order, coordinates as in the file (absolute).
    pub features: Vec<Feature>,
    /// The columns that were asked for, those that the file has, in its order.
    pub columns: Vec<Column>,
    /// The names of all columns of the file, in its order; none where no column was asked for.
    pub column_names: Vec<String>,
    /// The CRS the file states.
    pub crs: Option<Crs>,
    /// What is wrong with the CRS the file states, where it is one that is not supported or not understood.
    pub crs_not_read: Option<String>,
    /// What the user should know (points left out, empty geometries, ...), but for [`doubts`] about the CRS.
    pub notes: Vec<String>,
}

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
    /// OpenStreetMap's PBF.
    OpenStreetMap,
}

impl fmt::Display for VectorFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::GeoJson => "GeoJSON",
            Self::Shapefile => "shapefile",
            Self::FlatGeobuf => "FlatGeobuf",
            Self::GeoPackage => "GeoPackage",
            Self::OpenStreetMap => "OpenStreetMap PBF",
        })
    }
}

/// Reads a vector file without its attributes, the format told by its extension and content. `layer` names the layer of a
/// GeoPackage.
///
/// # Errors
/// When the file is missing, damaged, absurd or of an unsupported kind: says what and where.
pub fn read(path: &Path, layer: Option<&str>) -> Result<VectorFile> {
    read_columns(path, layer, &[])
}

/// Reads a vector file and, of its attributes, the columns with these names; one that the file does not have is not in
/// the answer.
///
/// # Errors
/// As [`read`], and when a value in these columns is damaged or not what its column says.
pub fn read_columns(path: &Path, layer: Option<&str>, columns: &[String]) -> Result<VectorFile> {
    let wanted = if columns.is_empty() { Wanted::Nothing } else { Wanted::Columns(columns.to_vec()) };
    read_collected(path, layer, wanted).map(|(_, found)| found.into_file()).map_err(|e| e.in_file(path))
}

/// Reads all attributes of a vector file. A value of a kind that is not read is no value.
///
/// # Errors
/// As [`read_columns`].
pub fn read_attributes(path: &Path, layer: Option<&str>) -> Result<Vec<Column>> {
    let read = read_collected(path, layer, Wanted::All);
    read.map(|(_, found)| found.into_file().columns).map_err(|e| e.in_file(path))
}

fn read_collected(path: &Path, layer: Option<&str>, wanted: Wanted) -> Result<(VectorFormat, Collector)> {
    let no_layers = |what: &str, layer: &str| {
        Error::new(format!("{what} has no layers, so none named '{layer}'"))
            .help("leave the layer out; it is for GeoPackages")
    };
    if is_archive(path)? {
        return match layer {
            Some(layer) => Err(no_layers("a file in an archive", layer)),
            None => archive::read(path, wanted),
        };
    }
    let format = format_of(path)?;
    if let (Some(layer), true) = (layer, format != VectorFormat::GeoPackage) {
        return Err(no_layers(&format!("a {format}"), layer));
    }
    let found = match format {
        VectorFormat::GeoJson => geojson::read(contents_of(path)?, Collector::new(wanted))?,
        VectorFormat::Shapefile => shapefile::read(&Parts::of(path)?, path, Collector::new(wanted))?,
        VectorFormat::FlatGeobuf => flatgeobuf::read(&contents_of(path)?, Collector::new(wanted))?,
        VectorFormat::OpenStreetMap => {
            osm::read(File::open(path).map_err(cannot_read)?, Collector::new(wanted))?
        }
        VectorFormat::GeoPackage => geopackage::read(path, layer, wanted)?,
    };
    Ok((format, found))
}

/// Whether a file is an archive, and not of a kind of its own that is packed so.
fn is_archive(path: &Path) -> Result<bool> {
    Ok(!path.is_dir() && foreign::by_name(path).is_none() && archive::is_one(&beginning_of(path)?))
}

/// Whether a file is one of vectors: of a kind that is read here, or of one that is known and refused with the command which
/// converts it. By its name, and where that says nothing by its content.
pub fn is_vector(path: &Path) -> bool {
    let by_content = || {
        let start = beginning_of(path).unwrap_or_default();
        told_by_content(&start).is_some()
            || foreign::by_content(&start).is_some()
            || (archive::is_one(&start) && archive::holds_vectors(path))
    };
    match path.extension().and_then(|extension| extension.to_str()) {
        _ if promised_by_name(path).is_some() || foreign::by_name(path).is_some() => true,
        Some(extension) if TERRAIN.contains(&extension.to_ascii_lowercase().as_str()) => false,
        _ => by_content(),
    }
}

/// The names of terrain files.
const TERRAIN: [&str; 9] = ["tif", "tiff", "hgt", "asc", "agr", "xyz", "png", "vrt", "toml"];

/// The format by what the file begins with; a name that promises another is refused.
fn format_of(path: &Path) -> Result<VectorFormat> {
    if let Some(foreign) = foreign::by_name(path).filter(|_| path.is_dir()) {
        return Err(foreign.refuse(path));
    }
    let start = beginning_of(path)?;
    if start.is_empty() {
        return Err(Error::new("the file is empty").help("write the file again"));
    }
    let promised = promised_by_name(path);
    let found = told_by_content(&start);
    let foreign = match (promised, found) {
        (_, None | Some(VectorFormat::GeoJson)) => foreign::by_content(&start),
        _ => None,
    };
    if let Some(foreign) =
        foreign.or_else(|| foreign::by_name(path).filter(|kind| found.is_none() || !kind.stands_alone()))
    {
        return Err(foreign.refuse(path));
    }
    if found.is_none() {
        packed::refuse(&start)?;
    }
    match (promised, found) {
        (Some(promised), Some(found)) if promised == found => Ok(found),
        (None, Some(found)) => Ok(found),
        (_, None) if start.starts_with(&[0xff, 0xfe]) || start.starts_with(&[0xfe, 0xff]) => {
            Err(Error::unsupported("this is text in UTF-16").help("save it as UTF-8"))
        }
        (Some(promised), None) => {
            Err(Error::new(format!("this is not a {promised}, whatever its name says"))
                .help("check that the file was copied whole"))
        }
        (Some(promised), Some(found)) => {
            Err(Error::new(format!("the name says {promised} but the content is a {found}"))
                .help("give the file the extension of what it is"))
        }
        (None, None) => Err(unknown()),
    }
}

fn unknown() -> Error {
    Error::unsupported("this is no vector file of a kind known here")
        .help("use .geojson, .json, .geojsonl, .shp, .fgb, .gpkg, .osm.pbf or a .zip of one; heights go into [terrain]")
}

fn beginning_of(path: &Path) -> Result<Vec<u8>> {
    if path.is_dir() {
        return Err(Error::new("this is a folder, not a file").help("name the file in it"));
    }
    let mut start = Vec::new();
    File::open(path).and_then(|file| file.take(512).read_to_end(&mut start)).map_err(cannot_read)?;
    Ok(start)
}

fn cannot_read(e: std::io::Error) -> Error {
    let help = match e.kind() {
        std::io::ErrorKind::NotFound => "check the path; a scene's paths are relative to the scene file",
        _ => "check the file's permissions",
    };
    Error::io("cannot read the file", e).help(help)
}

/// The whole file in memory.
fn contents_of(path: &Path) -> Result<Vec<u8>> {
    std::fs::read(path).map_err(cannot_read)
}

fn promised_by_name(path: &Path) -> Option<VectorFormat> {
    let extension = path.extension()?.to_str()?.to_ascii_lowercase();
    Some(match extension.as_str() {
        "geojson" | "json" | "geojsonl" | "geojsons" | "geojsonseq" | "ndjson" | "jsonl" => {
            VectorFormat::GeoJson
        }
        "shp" => VectorFormat::Shapefile,
        "fgb" => VectorFormat::FlatGeobuf,
        "gpkg" => VectorFormat::GeoPackage,
        "pbf" => VectorFormat::OpenStreetMap,
        _ => return None,
    })
}

fn told_by_content(start: &[u8]) -> Option<VectorFormat> {
    let text = start.strip_prefix(b"\xef\xbb\xbf").unwrap_or(start);
    if start.starts_with(b"SQLite format 3\0") {
        Some(VectorFormat::GeoPackage)
    } else if start.starts_with(b"fgb") {
        Some(VectorFormat::FlatGeobuf)
    } else if start.get(4..15) == Some(b"\x0a\x09OSMHeader") {
        Some(VectorFormat::OpenStreetMap)
    } else if start.starts_with(&9994_u32.to_be_bytes()) {
        Some(VectorFormat::Shapefile)
    } else {
        let is_space = |b: &u8| b.is_ascii_whitespace() || *b == geojson::RECORD_SEPARATOR;
        let text = &text[text.iter().take_while(|b| is_space(b)).count()..];
        // A text of a sequence may be `null`, the first one too.
        let is_null = text.strip_prefix(b"null").is_some_and(|rest| rest.first().is_some_and(is_space));
        (is_null || text.starts_with(b"{")).then_some(VectorFormat::GeoJson)
    }
}

#[cfg(test)]
mod tests;
