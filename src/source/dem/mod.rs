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
pub(super) mod frame;
mod geo_keys;
mod geotiff;
mod grid;
mod hgt;
mod nodata;
mod open;
mod png;
mod summary;
mod text;
pub(super) mod world_file;
mod xyz;

#[cfg(test)]
mod tests;

pub use geo_keys::CrsHint;
pub use summary::{DemSummary, describe, describe_guessing};

use crate::error::{Error, Result};
use crate::scene::Surface;
use grid::{GridFile, Sheet};
use open::DemFile;
use std::path::Path;

/// The most posts that one call reads (1 GiB of heights); larger terrain is read through a window.
pub const MAX_POSTS: usize = 1 << 27;

/// The most scattered points that one call reads.
pub const MAX_POINTS: usize = 1 << 25;

/// What to read of a terrain file.
#[derive(Debug, Clone, Copy, Default)]
pub struct DemOptions {
    /// Only this part: x0, y0, x1, y1 in the file's own coordinates; grown to whole posts around it, and cut at the
    /// file's edge.
    pub window: Option<[f64; 4]>,
    /// How a PNG encodes heights; `None` refuses PNG files with a hint.
    pub encoding: Option<PngEncoding>,
    /// The outer edges x0, y0, x1, y1 of an image that says itself nothing of its place (PNG or TIFF without geo keys
    /// and without a world file); such an image is else a grid of cell 1 whose south-west post stands at (0, 0).
    pub bounds: Option<[f64; 4]>,
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
#[non_exhaustive]
pub struct Dem {
    /// Heights in the file's own coordinates (absolute; degrees for a geographic CRS).
    pub surface: Surface,
    /// What the file says of its CRS, as it says it.
    pub crs_hint: Option<CrsHint>,
    /// What the user should know.
    pub notes: Vec<String>,
}

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

/// Reads the wanted part of a grid.
fn read_grid(file: &mut dyn GridFile, window: Option<[f64; 4]>) -> Result<Dem> {
    let mut notes = file.header().notes.clone();
    let crs_hint = file.header().crs_hint.clone();
    let frame = file.header().frame;
    let (part, note) = frame.part(window)?;
    notes.extend(note);
    file.check_promise(&part)?;
    if part.count() > MAX_POSTS {
        return Err(too_many_posts(&part));
    }
    let mut sheet = Sheet::new(&frame, part)?;
    file.scan(&part, &mut sheet)?;
    let posts = sheet.finish(&mut notes)?;
    Ok(Dem { surface: Surface::Grid(posts), crs_hint, notes })
}

/// More posts than one call may read.
fn too_many_posts(part: &frame::Part) -> Error {
    Error::unsupported(format!(
        "{} x {} posts are more than the {MAX_POSTS} that can be read at once",
        part.columns, part.rows
    ))
    .help("read a part of it (`window = [x0, y0, x1, y1]`), or make it coarser: gdal_translate -outsize 25% 25%")
}
