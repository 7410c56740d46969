//! Where an image lies: by the `.aux.xml` beside it, else by its world file.

use super::frame::Frame;
use super::geo_keys::CrsHint;
use super::sidecar::Sidecar;
use super::site::Site;
use super::world_file;
use crate::error::Result;
use std::path::Path;

/// The place of an image.
pub(in crate::source) struct ImagePlace {
    pub(in crate::source) frame: Frame,
    /// The CRS that is stated with it; a world file states none.
    pub(in crate::source) crs: Option<CrsHint>,
    /// Which file says so, in words.
    pub(in crate::source) said_by: &'static str,
}

/// The place of an image on disk of so many columns and rows; `None` where nothing beside it says one.
pub(in crate::source) fn of_image(path: &Path, size: (usize, usize)) -> Result<Option<ImagePlace>> {
    let site = Site::on_disk(path);
    let beside = Sidecar::beside(&site, 1)?;
    let place = place(&site, size, beside.place)?;
    Ok(place.map(|(frame, said_by)| ImagePlace { frame, crs: beside.crs, said_by }))
}

/// The frame of an image, and which file says so, in words; `beside` is what its `.aux.xml` says.
pub(super) fn place(
    site: &Site,
    size: (usize, usize),
    beside: Option<[f64; 6]>,
) -> Result<Option<(Frame, &'static str)>> {
    if let Some(place) = beside {
        return Ok(Some((Frame::of_geo_transform(size, place)?, ".aux.xml")));
    }
    Ok(world_file::frame_beside(site, size)?.map(|frame| (frame, "world file")))
}
