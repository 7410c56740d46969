//! Terrain files -> posts or points, in the file's own coordinates.
//!
//! Input: a path and which part of it is wanted. Output: a [`Dem`]: heights at posts (row 0 in the south, NaN where
//! there is no data) or scattered points, and what the file says of its CRS. Nothing is reprojected here.
//!
//! | format | told by | files |
//! | --- | --- | --- |
//! | GeoTIFF, BigTIFF | first bytes | `geotiff`, `geo_keys` |
//! | PNG with heights in its colours | first bytes | `png`, `world_file` |
//! | SRTM tile | `.hgt` | `hgt` |
//! | Esri ASCII grid | `.asc` | `ascii` |
//! | points | `.xyz` | `xyz` |
//! | plain files side by side (`.vrt`) | first bytes, `.vrt` | `vrt`, `mosaic` |
//! | one of these in a zip archive | first bytes | `site` |
//!
//! Every grid is read the same way: its header gives a `Frame` (where the posts stand), the window a `Part` of it, and
//! the reader hands the heights of that part row by row to a `RowSink`: a `Sheet` that becomes [`Posts`], or a tally
//! that only counts ([`describe`]).
//!
//! It refuses files that are missing, damaged, of an unsupported kind, or that promise more than they can hold, before
//! it allocates for them. One call holds at most [`MAX_POSTS`] heights beside a row or two of the file (a PNG: beside
//! its pixels).
//!
//! [`Posts`]: crate::scene::Posts

mod ascii;
mod content;
mod extremes;
mod failure;
pub(super) mod frame;
mod geo_keys;
mod geotiff;
mod grid;
mod hgt;
pub(super) mod image_place;
mod mask;
mod mosaic;
mod nodata;
mod open;
mod options;
mod png;
mod refined;
mod sidecar;
mod site;
mod summary;
mod text;
mod vertical;
mod virtual_band;
mod vrt;
mod world_file;
mod xml;
mod xyz;

#[cfg(test)]
mod tests;

pub use content::{Dem, MAX_POINTS, MAX_POSTS};
pub use geo_keys::CrsHint;
pub use options::{DemOptions, PngEncoding};
pub use summary::{DemSummary, describe, describe_guessing};
pub(super) use vertical::VerticalUnit;

use crate::error::Result;
use crate::scene::Surface;
use grid::{GridFile, Sheet};
use open::DemFile;
use std::path::{Path, PathBuf};

/// Reads a terrain file, the format told by its content and extension.
///
/// # Errors
/// When the file is missing, damaged, absurd or of an unsupported kind: says what and where.
pub fn read(path: &Path, options: &DemOptions) -> Result<Dem> {
    let read = || match open::open(path, options)? {
        DemFile::Grid(mut file) => read_grid(&mut *file, options.window),
        DemFile::Points(mut file) => file.read(options.window),
    };
    read().map_err(|error| error.in_file(path))
}

/// Reads several terrain files as one: grids whose posts stand on one grid, in one CRS. Posts that they share are averaged.
///
/// # Errors
/// As [`read`]; and when the files do not fit together, naming the one that does not.
pub fn read_together(paths: &[PathBuf], options: &DemOptions) -> Result<Dem> {
    read_grid(&mut *open::open_together(paths, options)?, options.window)
}

/// Reads the wanted part of a grid.
fn read_grid(file: &mut dyn GridFile, window: Option<[f64; 4]>) -> Result<Dem> {
    let crs_hint = file.header().crs_hint.clone();
    let frame = file.header().frame;
    let (part, note) = frame.part(window)?;
    file.check_promise(&part)?;
    if part.count() > MAX_POSTS {
        return Err(failure::too_many_posts(&part));
    }
    let mut sheet = Sheet::new(&frame, part)?;
    file.scan(&part, &mut sheet)?;
    let mut notes = file.header().notes.clone();
    notes.extend(note);
    let posts = sheet.finish(&mut notes)?;
    Ok(Dem { surface: Surface::Grid(posts), crs_hint, states_unit: file.header().unit.is_some(), notes })
}
