//! Values that tables of several kinds have: rectangles, data files.

use crate::error::Result;
use crate::scene::file::place::Origin;
use crate::scene::file::section::{Section, Taken};
use crate::scene::file::spec::DataFile;
use std::path::Path;

/// A rectangle x0, y0, x1, y1 that is not empty.
pub(super) fn rectangle(section: &mut Section<'_>, key: &str) -> Result<Option<[f64; 4]>> {
    let Some(Taken { value, place }) = section.numbers_at::<4>(key)? else {
        return Ok(None);
    };
    let [x0, y0, x1, y1] = value;
    if !((x1 - x0).is_finite() && (y1 - y0).is_finite()) {
        return Err(section.error_at(&place, format!("`{key}` is larger than numbers can tell")));
    }
    if x0 < x1 && y0 < y1 {
        return Ok(Some(value));
    }
    let what = format!("`{key}` is empty: x0 < x1 and y0 < y1 must hold in [x0, y0, x1, y1]");
    Err(section.error_at(&place, what))
}

/// A data file beside the scene file.
pub(super) fn data_file(origin: &Origin<'_>, taken: Taken<String>) -> DataFile {
    let folder = origin.path.and_then(Path::parent).unwrap_or(Path::new(""));
    DataFile {
        path: folder.join(&taken.value),
        position: origin.position(&taken.place),
        written: taken.value,
    }
}

/// A file's name without its extension.
pub(super) fn stem(path: Option<&Path>, otherwise: &str) -> String {
    let stem = path.and_then(Path::file_stem).map(|stem| stem.to_string_lossy().into_owned());
    stem.filter(|stem| !stem.is_empty() && !stem.starts_with('<')).unwrap_or_else(|| otherwise.into())
}
