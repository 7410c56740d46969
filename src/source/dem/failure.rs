//! What every reader says when it has to give up.

use super::content::MAX_POSTS;
use super::frame::PostRange;
use crate::error::Error;
use std::io;

/// Says that reading failed.
pub(super) fn unreadable(error: io::Error) -> Error {
    if error.kind() == io::ErrorKind::UnexpectedEof {
        Error::new("the file ends too early")
            .caused_by(error)
            .help("it may be half a download: fetch it again")
    } else {
        Error::io("cannot be read", error)
    }
}

/// More posts than one call may read.
pub(super) fn too_many_posts(part: &PostRange) -> Error {
    Error::unsupported(format!(
        "{} x {} posts are more than the {MAX_POSTS} that can be read at once",
        part.columns, part.rows
    ))
    .help("read a part of it (`window = [x0, y0, x1, y1]`), or make it coarser: gdal_translate -outsize 25% 25%")
}
