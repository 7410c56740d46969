//! Which reader a file gets: by its first bytes, else by its extension.

use super::ascii::AsciiGrid;
use super::failure::unreadable;
use super::geotiff::{GeoTiff, MaskPlace};
use super::grid::GridFile;
use super::hgt::Hgt;
use super::options::DemOptions;
use super::png::HeightPng;
use super::refined::Refined;
use super::sidecar::Sidecar;
use super::site::{Input, Site};
use super::xyz::Xyz;
use crate::error::{Error, Result};
use std::io::Read;
use std::path::Path;

/// An opened terrain file.
pub(super) enum DemFile {
    Grid(Box<dyn GridFile>),
    Points(Xyz<Input>),
}

/// Opens a terrain file, or the only one of an archive, and reads its header.
pub(super) fn open(path: &Path, options: &DemOptions) -> Result<DemFile> {
    let site = Site::on_disk(path);
    match &magic(&site)?[..] {
        [b'P', b'K', 3 | 5, ..] => open_site(&site.in_archive()?, options),
        _ => open_site(&site, options),
    }
}

fn open_site(site: &Site, options: &DemOptions) -> Result<DemFile> {
    let magic = magic(site)?;
    if magic.is_empty() {
        return Err(Error::new("the file is empty").help("fetch it again"));
    }
    refuse_packed(&magic)?;
    let extension = site.extension();
    let is_tiff = matches!(magic[..], [b'I', b'I', 42 | 43, 0, ..] | [b'M', b'M', 0, 42 | 43, ..]);
    if let (Some(band @ (0 | 2..)), false) = (options.band, is_tiff) {
        return Err(Error::new(format!("`band` = {band}, but the file has one band")));
    }
    let beside = Sidecar::beside(site, options.band.unwrap_or(1))?;
    let nodata = [beside.nodata, options.nodata];
    let file = site.open()?;
    let (grid, mut masks): (Box<dyn GridFile>, _) = match (magic.as_slice(), extension.as_str()) {
        _ if is_tiff => {
            let (file, masks) = GeoTiff::open(file, Some(site), options, &beside)?;
            (Box::new(file), masks_of(site, masks)?)
        }
        ([0x89, b'P', b'N', b'G', ..], _) => {
            (Box::new(HeightPng::open(file, site, options, &beside)?), Vec::new())
        }
        (_, "hgt") => (Box::new(Hgt::open(file, site.path(), nodata)?), Vec::new()),
        (_, "asc" | "agr") => (Box::new(AsciiGrid::open(file, Some(site), nodata)?), Vec::new()),
        (_, "xyz") => return Ok(DemFile::Points(Xyz::open(file, options.nodata)?)),
        (_, "tif" | "tiff" | "png") => return Err(not_what_it_says(&extension)),
        _ => return Err(unknown(&extension)),
    };
    masks.extend(mask_beside(site, options.band)?);
    Ok(DemFile::Grid(Box::new(Refined::new(grid, beside, masks)?)))
}

/// The masks inside a TIFF, each read through its own view of the file.
fn masks_of(site: &Site, places: Vec<MaskPlace>) -> Result<Vec<Box<dyn GridFile>>> {
    let open = |place| -> Result<Box<dyn GridFile>> {
        let mask = GeoTiff::open_mask(site.open()?, place);
        Ok(Box::new(mask.map_err(|error| error.reworded(|what| format!("its mask: {what}")))?))
    };
    places.into_iter().map(open).collect()
}

/// The mask in a file of its own: `FILE.msk`, a TIFF with a band for all, or one for each band.
fn mask_beside(site: &Site, band: Option<usize>) -> Result<Option<Box<dyn GridFile>>> {
    let Some(file) = site.with_ending(".msk")? else {
        return Ok(None);
    };
    let open = |band| Ok::<_, Error>(GeoTiff::open_mask(file.open()?, MaskPlace::Band(band))?);
    let mask = match band {
        Some(band @ 2..) => open(band - 1).or_else(|_| open(0)),
        _ => open(0),
    };
    let mask = mask.map_err(|error| {
        error.in_file(file.path()).help("it masks the terrain file beside it: write it anew, or remove it")
    })?;
    Ok(Some(Box::new(mask)))
}

/// The first bytes of a file.
fn magic(site: &Site) -> Result<Vec<u8>> {
    let mut magic = Vec::new();
    site.open()?.take(8).read_to_end(&mut magic).map_err(unreadable)?;
    Ok(magic)
}

/// Whether a file begins like a PNG.
pub(super) fn is_png(path: &Path) -> bool {
    let begins = |site: &Site| magic(site).map(|magic| magic.starts_with(b"\x89PNG"));
    let site = Site::on_disk(path);
    begins(&site).unwrap_or(false) || site.in_archive().is_ok_and(|site| begins(&site).unwrap_or(false))
}

fn refuse_packed(magic: &[u8]) -> Result<()> {
    let (kind, tool) = match magic {
        [b'P', b'K', 3 | 5, ..] => ("a zip archive in another", "unzip"),
        [0x1f, 0x8b, ..] => ("packed with gzip", "gunzip -k"),
        [0xfd, b'7', b'z', b'X', b'Z', ..] => ("packed with xz", "xz -dk"),
        [b'B', b'Z', b'h', ..] => ("packed with bzip2", "bunzip2 -k"),
        _ => return Ok(()),
    };
    Err(Error::unsupported(format!("the file is {kind}")).help(format!("unpack it first: {tool} FILE")))
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
