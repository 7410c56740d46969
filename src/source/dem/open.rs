//! Which reader a file gets: by its first bytes, else by its extension.

use super::ascii::AsciiGrid;
use super::failure::unreadable;
use super::geotiff::{GeoTiff, MaskPlace};
use super::grid::GridFile;
use super::hgt::Hgt;
use super::mosaic::{Mosaic, Piece};
use super::options::DemOptions;
use super::png::HeightPng;
use super::refined::Refined;
use super::sidecar::Sidecar;
use super::site::{Input, Site};
use super::vrt;
use super::xyz::Xyz;
use crate::error::{Error, Result};
use crate::source::packed;
use std::io::Read;
use std::path::{Path, PathBuf};

/// An opened terrain file.
pub(super) enum DemFile {
    Grid(Box<dyn GridFile>),
    Points(Xyz<Input>),
}

/// Opens a terrain file, or the only one of an archive, and reads its header.
pub(super) fn open(path: &Path, options: &DemOptions) -> Result<DemFile> {
    let site = site_of(path)?;
    if site.extension() == "vrt" || magic(&site)?.starts_with(b"<VRTData") {
        return open_virtual(&site, options).map(DemFile::Grid);
    }
    open_site(&site, options, true)
}

/// Opens several grids as one.
pub(super) fn open_together(paths: &[PathBuf], options: &DemOptions) -> Result<Box<dyn GridFile>> {
    if options.bounds.is_some() {
        return Err(Error::new("`bounds` places one file, but several are named")
            .help("give each a world file, or georeference it: gdal_translate -a_ullr"));
    }
    let options = DemOptions { window: None, ..*options };
    let open = move |piece: &Piece| only_grid(open(&piece.path, &options)?);
    Ok(Box::new(Mosaic::of_files(paths, Box::new(open))?))
}

/// Opens a virtual raster.
fn open_virtual(site: &Site, options: &DemOptions) -> Result<Box<dyn GridFile>> {
    let beside = Sidecar::beside(site, options.band.unwrap_or(1))?;
    let of_pieces = DemOptions { window: None, bounds: None, ..*options };
    // Plain files alone: a virtual raster of virtual rasters could name itself.
    let open = move |piece: &Piece| {
        let options = DemOptions { band: piece.band, ..of_pieces };
        only_grid(open_site(&site_of(&piece.path)?, &options, false)?)
    };
    let mosaic = vrt::open(site, options, &beside, Box::new(open))?;
    let masks = mask_beside(site, options.band)?.into_iter().collect();
    Ok(Box::new(Refined::new(Box::new(mosaic), beside, masks, true)?))
}

fn only_grid(file: DemFile) -> Result<Box<dyn GridFile>> {
    match file {
        DemFile::Grid(grid) => Ok(grid),
        DemFile::Points(_) => Err(Error::unsupported("scattered points cannot be put beside other files")
            .help("name the one file of points, with all of them")),
    }
}

/// The place of a file on disk, or of the only terrain file of the archive there.
fn site_of(path: &Path) -> Result<Site> {
    let site = Site::on_disk(path);
    match &magic(&site)?[..] {
        [b'P', b'K', 3 | 5, ..] => site.in_archive(),
        _ => Ok(site),
    }
}

/// Opens a file of one raster, or of points; one that is not converted keeps its samples as they are stored.
fn open_site(site: &Site, options: &DemOptions, converts: bool) -> Result<DemFile> {
    let magic = magic(site)?;
    if magic.is_empty() {
        return Err(Error::new("the file is empty").help("fetch it again"));
    }
    packed::refuse(&magic)?;
    let extension = site.extension();
    let is_tiff = matches!(magic[..], [b'I', b'I', 42 | 43, 0, ..] | [b'M', b'M', 0, 42 | 43, ..]);
    if let (Some(band @ (0 | 2..)), false) = (options.band, is_tiff) {
        return Err(Error::new(format!("`band` = {band}, but the file has one band")));
    }
    let beside = Sidecar::beside(site, options.band.unwrap_or(1))?;
    beside.refuse_picture()?;
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
    Ok(DemFile::Grid(Box::new(Refined::new(grid, beside, masks, converts)?)))
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
    let open = |band| GeoTiff::open_mask(file.open()?, MaskPlace::Band(band));
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

fn not_what_it_says(extension: &str) -> Error {
    Error::new(format!("the file is named .{extension} but does not begin like one"))
        .help("it may be a web page or half a download: look at its first bytes, fetch it again")
}

/// Rasters that GDAL makes a GeoTIFF of.
const RASTERS: [&str; 21] = [
    "adf", "bag", "bil", "bin", "bsq", "bt", "dem", "dt0", "dt1", "dt2", "flt", "grb", "grd", "h5", "hdf",
    "img", "jp2", "nc", "rst", "sdat", "ter",
];

fn unknown(extension: &str) -> Error {
    let what = if extension.is_empty() {
        "a terrain file without an extension".to_owned()
    } else {
        format!("terrain files of the kind .{extension} are unknown")
    };
    let help = if RASTERS.contains(&extension) {
        "make a GeoTIFF of it: gdal_translate FILE OUT.tif -co COMPRESS=DEFLATE"
    } else {
        "read are terrain (.tif .hgt .asc .png .xyz .vrt), vectors (.geojson .json .geojsonl .shp .fgb .gpkg .osm.pbf) and a \
         .zip of one; points x, y, height are a terrain when the file is named .xyz"
    };
    Error::unsupported(what).help(help)
}
