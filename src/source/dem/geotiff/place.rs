//! Where a GeoTIFF's samples stand.
//!
//! Source: OGC 19-008r4, sections 7.3 (raster space) and annex B.6: `ModelTransformation`, or `ModelTiepoint` with
//! `ModelPixelScale`. Posts stand at the pixels' centres, or at their corners where samples are points.

use super::super::frame::Frame;
use super::super::geo_keys::GeoKeys;
use super::super::site::Site;
use super::super::world_file;
use super::tags::{Directory, Source, tag};
use crate::error::{Error, Result};
use glam::DVec2;
use std::io::{Read, Seek};

/// Where a TIFF's samples stand.
pub(super) struct Place {
    pub(super) frame: Frame,
    /// Whether the file or what lies beside it says so.
    pub(super) is_placed: bool,
    /// What to say where the file itself does not.
    pub(super) note: Option<String>,
}

/// The frame of a TIFF; `site` serves to find a world file, `bounds` and what is `beside` it stand in for a missing place.
pub(super) fn frame<R: Read + Seek>(
    directory: &Directory,
    source: &mut Source<R>,
    keys: &GeoKeys,
    size: (usize, usize),
    (site, bounds, beside): (Option<&Site>, Option<[f64; 4]>, Option<[f64; 6]>),
) -> Result<Place> {
    if let Some([a, b, x, d, e, y]) = affine(directory, source)? {
        let (column, row) = (DVec2::new(a, d), DVec2::new(b, e));
        let half = if keys.pixel_is_point() { 0.0 } else { 0.5 };
        let first = DVec2::new(x, y) + (column + row) * half;
        return Ok(Place { frame: Frame::new(size, first, (column, row))?, is_placed: true, note: None });
    }
    let told = |frame, is_placed, note: &str| Place { frame, is_placed, note: Some(note.into()) };
    if let Some(place) = beside {
        return Ok(told(Frame::of_geo_transform(size, place)?, true, "placed by the .aux.xml beside it"));
    }
    let beside = site.map(|s| world_file::frame_beside(s, size)).transpose()?;
    Ok(match (beside.flatten(), bounds) {
        (Some(frame), _) => told(frame, true, "placed by the world file beside it"),
        (None, Some(bounds)) => told(Frame::within(size, bounds)?, false, "placed by the given bounds"),
        (None, None) => told(
            Frame::local(size)?,
            false,
            "the file does not say its place: a local grid, cell 1, south-west post at (0, 0)",
        ),
    })
}

/// The map `x = a c + b r + x0`, `y = d c + e r + y0` from raster space: `[a, b, x0, d, e, y0]`.
fn affine<R: Read + Seek>(directory: &Directory, source: &mut Source<R>) -> Result<Option<[f64; 6]>> {
    let matrix = directory.doubles(source, tag::TRANSFORMATION)?;
    if let [a, b, _, x, d, e, _, y, ..] = matrix[..] {
        return Ok(Some([a, b, x, d, e, y]));
    }
    let scale = directory.doubles(source, tag::PIXEL_SCALE)?;
    let ties = directory.doubles(source, tag::TIE_POINTS)?;
    match (&scale[..], &ties[..]) {
        (&[sx, sy, ..], &[c, r, _, x, y, ..]) => Ok(Some([sx, 0.0, x - c * sx, 0.0, -sy, y + r * sy])),
        ([], []) => Ok(None),
        ([], _) => Err(Error::unsupported("the file is placed by ground control points only")
            .help("warp it first: gdalwarp FILE OUT.tif")),
        _ => Err(Error::new("the file gives a pixel scale without a tie point")
            .help("georeference it: gdal_edit.py -a_ullr west north east south FILE")),
    }
}
