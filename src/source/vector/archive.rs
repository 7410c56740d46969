//! Vector files in a zip archive: a shapefile with what lies beside it, or the one file of another kind.

use super::attributes::Wanted;
use super::collector::Collector;
use super::shapefile::{self, Parts};
use super::{VectorFormat, flatgeobuf, foreign, geojson, osm, promised_by_name, told_by_content};
use crate::error::{Error, Result};
use crate::source::zip::{Archive, Entry};
use std::fs::File;
use std::io::Cursor;
use std::path::Path;

/// The most bytes of a file that are unpacked into memory.
const MOST_UNPACKED: u64 = 1 << 30;

/// Whether a file begins like an archive.
pub(super) fn is_one(start: &[u8]) -> bool {
    start.starts_with(b"PK\x03\x04") || start.starts_with(b"PK\x05\x06")
}

/// Whether an archive holds vectors; what lies beside a grid of heights is none of its own.
pub(super) fn holds_vectors(path: &Path) -> bool {
    let Ok(archive) = open(path) else { return false };
    let has = |names: &[&str]| {
        archive.entries().iter().any(|entry| names.contains(&extension(&entry.name).as_str()))
    };
    let is_vector = |entry: &Entry| {
        let name = Path::new(&entry.name);
        promised_by_name(name).is_some() || foreign::by_name(name).is_some_and(|kind| kind.stands_alone())
    };
    !has(&["hgt", "tif", "tiff", "asc", "agr", "xyz"]) && archive.entries().iter().any(is_vector)
}

/// Reads the one vector file of an archive, and of its attributes what is wanted.
pub(super) fn read(path: &Path, wanted: Wanted) -> Result<(VectorFormat, Collector)> {
    let mut archive = open(path)?;
    let (format, entry) = the_vectors(archive.entries())?;
    let inner = path.join(&entry.name);
    read_entry(&mut archive, (format, &entry), (&inner, wanted))
        .map(|found| (format, found))
        .map_err(|e| e.in_file(&inner))
}

fn open(path: &Path) -> Result<Archive<File>> {
    Archive::open(File::open(path).map_err(super::cannot_read)?)
}

fn read_entry(
    archive: &mut Archive<File>,
    (format, entry): (VectorFormat, &Entry),
    (inner, wanted): (&Path, Wanted),
) -> Result<Collector> {
    let found = Collector::new(wanted);
    let content = archive.read(entry, MOST_UNPACKED)?;
    let beginning = content.get(..512).unwrap_or(&content);
    if told_by_content(beginning) != Some(format) {
        return Err(Error::new(format!("this is not a {format}, whatever its name says"))
            .help("unpack the archive and look at it"));
    }
    match format {
        VectorFormat::GeoJson => geojson::read(content, found),
        VectorFormat::FlatGeobuf => flatgeobuf::read(&content, found),
        VectorFormat::OpenStreetMap => osm::read(Cursor::new(content), found),
        VectorFormat::Shapefile => shapefile::read(&parts(archive, entry, content)?, inner, found),
        VectorFormat::GeoPackage => {
            Err(Error::unsupported("a GeoPackage is read where it lies, not in an archive")
                .help("unpack it first, and name the unpacked file"))
        }
    }
}

/// A shapefile's files, those of the name of its .shp in any letters.
fn parts(archive: &mut Archive<File>, shp: &Entry, content: Vec<u8>) -> Result<Parts> {
    let stem = |name: &str| name.rsplit_once('.').map_or(name, |(stem, _)| stem).to_lowercase();
    let mut beside = |wanted: &str| {
        let is_part =
            |entry: &&Entry| extension(&entry.name) == wanted && stem(&entry.name) == stem(&shp.name);
        let entry = archive.entries().iter().find(is_part).cloned();
        entry.map(|entry| archive.read(&entry, MOST_UNPACKED)).transpose()
    };
    Ok(Parts {
        shx: beside("shx")?,
        dbf: beside("dbf")?,
        prj: beside("prj")?,
        cpg: beside("cpg")?,
        shp: content,
    })
}

fn extension(name: &str) -> String {
    let name = Path::new(name).extension().unwrap_or_default();
    name.to_string_lossy().to_ascii_lowercase()
}

/// The one vector file; a `.json` beside others is a description of them.
fn the_vectors(entries: &[Entry]) -> Result<(VectorFormat, Entry)> {
    let is = |entry: &Entry, is_plain_json: bool| {
        let format = promised_by_name(Path::new(&entry.name))?;
        ((extension(&entry.name) == "json") == is_plain_json).then_some(format)
    };
    for is_plain_json in [false, true] {
        let found: Vec<(VectorFormat, &Entry)> =
            entries.iter().filter_map(|entry| is(entry, is_plain_json).zip(Some(entry))).collect();
        match found[..] {
            [] => {}
            [(format, one)] => return Ok((format, one.clone())),
            [(_, first), (_, second), ..] => {
                return Err(Error::new(format!(
                    "the zip archive holds {} vector files, {} and {} among them",
                    found.len(),
                    first.name,
                    second.name
                ))
                .help("unpack it, and make a layer of each file that is wanted"));
            }
        }
    }
    let foreign = entries.iter().find_map(|entry| {
        let path = Path::new(&entry.name);
        foreign::by_name(path).filter(|kind| kind.stands_alone()).map(|kind| kind.refuse(path))
    });
    Err(foreign.unwrap_or_else(|| {
        Error::new(format!("the zip archive holds no vector file among its {} files", entries.len()))
            .help("known are .shp .geojson .json .fgb .osm.pbf")
    }))
}
