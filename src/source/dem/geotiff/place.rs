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

/// The frame of a TIFF, and a note where the file itself does not give it.
pub(super) fn frame<R: Read + Seek>(
    directory: &Directory,
    source: &mut Source<R>,
    keys: &GeoKeys,
    size: (usize, usize),
    (site, bounds, beside): (Option<&Site>, Option<[f64; 4]>, Option<[f64; 6]>),
) -> Result<(Frame, Option<String>)> {
    if let Some([a, b, x, d, e, y]) = affine(directory, source)? {
        let (column, row) = (DVec2::new(a, d), DVec2::new(b, e));
        let half = if keys.pixel_is_point() { 0.0 } else { 0.5 };
        let first = DVec2::new(x, y) + (column + row) * half;
        return Ok((Frame::new(size, first, (column, row))?, None));
    }
    if let Some(place) = beside {
        return Ok((Frame::of_geo_transform(size, place)?, Some("placed by the .aux.xml beside it".into())));
    }
    let beside = site.map(|s| world_file::frame_beside(s, size)).transpose()?;
    let (frame, note) = match (beside.flatten(), bounds) {
        (Some(frame), _) => (frame, "placed by the world file beside it"),
        (None, Some(bounds)) => (Frame::within(size, bounds)?, "placed by the given bounds"),
        (None, None) => (
            Frame::local(size)?,
            "the file does not say its place: a local grid, cell 1, south-west post at (0, 0)",
        ),
    };
    Ok((frame, Some(note.into())))
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
