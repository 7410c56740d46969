//! Which reader a file gets: by its first bytes, else by its extension.

use super::ascii::AsciiGrid;
use super::failure::unreadable;
use super::geotiff::GeoTiff;
use super::grid::GridFile;
use super::hgt::Hgt;
use super::options::DemOptions;
use super::png::HeightPng;
use super::xyz::Xyz;
use crate::error::{Error, Result};
use std::fs::File;
use std::io::{self, Read, Seek};
use std::path::Path;

/// An opened terrain file.
pub(super) enum DemFile {
    Grid(Box<dyn GridFile>),
    Points(Xyz<File>),
}

/// Opens a terrain file and reads its header.
pub(super) fn open(path: &Path, options: &DemOptions) -> Result<DemFile> {
    let mut file = open_file(path)?;
    let mut magic = Vec::new();
    (&mut file).take(8).read_to_end(&mut magic).map_err(unreadable)?;
    file.rewind().map_err(unreadable)?;
    if magic.is_empty() {
        return Err(Error::new("the file is empty").help("fetch it again"));
    }
    refuse_packed(&magic)?;
    let extension = extension(path);
    let grid: Box<dyn GridFile> = match (magic.as_slice(), extension.as_str()) {
        ([b'I', b'I', 42 | 43, 0, ..] | [b'M', b'M', 0, 42 | 43, ..], _) => {
            Box::new(GeoTiff::open(file, Some(path), options.bounds)?)
        }
        ([0x89, b'P', b'N', b'G', ..], _) => Box::new(HeightPng::open(file, path, options)?),
        (_, "hgt") => Box::new(Hgt::open(file, path)?),
        (_, "asc" | "agr") => Box::new(AsciiGrid::open(file, Some(path))?),
        (_, "xyz") => return Ok(DemFile::Points(Xyz::open(file)?)),
        (_, "tif" | "tiff" | "png") => return Err(not_what_it_says(&extension)),
        _ => return Err(unknown(&extension)),
    };
    Ok(DemFile::Grid(grid))
}

/// Whether a file begins like a PNG.
pub(super) fn is_png(path: &Path) -> bool {
    let mut magic = [0; 4];
    let read = open_file(path).map(|mut file| file.read_exact(&mut magic).is_ok());
    read.unwrap_or(false) && magic == [0x89, b'P', b'N', b'G']
}

/// Opens a plain file for reading.
fn open_file(path: &Path) -> Result<File> {
    let refuse = |e: io::Error| Error::io("cannot be opened", e).help("check the path");
    let meta = std::fs::metadata(path).map_err(refuse)?;
    if meta.is_dir() {
        return Err(Error::new("this is a directory").help("name the terrain file in it"));
    }
    if !meta.is_file() {
        return Err(Error::new("this is not a plain file").help("copy its content into a file first"));
    }
    File::open(path).map_err(refuse)
}

fn refuse_packed(magic: &[u8]) -> Result<()> {
    let (kind, tool) = match magic {
        [b'P', b'K', 3 | 5, ..] => ("a zip archive", "unzip"),
        [0x1f, 0x8b, ..] => ("packed with gzip", "gunzip -k"),
        [0xfd, b'7', b'z', b'X', b'Z', ..] => ("packed with xz", "xz -dk"),
        [b'B', b'Z', b'h', ..] => ("packed with bzip2", "bunzip2 -k"),
        _ => return Ok(()),
    };
    Err(Error::unsupported(format!("the file is {kind}")).help(format!("unpack it first: {tool} FILE")))
}

fn extension(path: &Path) -> String {
    let extension = path.extension().unwrap_or_default();
    extension.to_string_lossy().to_ascii_lowercase()
}

fn not_what_it_says(extension: &str) -> Error {
    Error::new(format!("the file is named .{extension} but does not begin like one"))
        .help("it may be a web page or half a download: look at its first bytes, fetch it again")
}

fn unknown(extension: &str) -> Error {
    let what = if extension.is_empty() {
        "a terrain file without an extension".to_owned()
    } else {
        format!("terrain files of the kind .{extension} are unknown")
    };
    Error::unsupported(what).help(
        "known are .tif .hgt .asc .png .xyz; convert others with: gdal_translate FILE OUT.tif -co COMPRESS=DEFLATE",
    )
}
