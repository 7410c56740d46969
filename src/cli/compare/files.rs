//! The pictures of a call, by whatever names.

use drapery::compare::{Image, same_file};
use drapery::{Error, Result};
use std::io::Read;
use std::path::Path;

/// Where stdin has a place in the file system, `compare a.png - < a.png` is seen through too.
const STDIN: &str = "/dev/stdin";

pub(super) fn is_standard(path: &Path) -> bool {
    path == Path::new("-")
}

/// The path that a name leads to; `None` of stdin where it has no place.
pub(super) fn place(path: &Path) -> Option<&Path> {
    match is_standard(path) {
        false => Some(path),
        true => Some(Path::new(STDIN)).filter(|stdin| stdin.exists()),
    }
}

/// Whether two names are of one file.
pub(super) fn is_one_file(a: &Path, b: &Path) -> Result<bool> {
    match (place(a), place(b)) {
        _ if is_standard(a) && is_standard(b) => Ok(true),
        (Some(a), Some(b)) => same_file(a, b),
        _ => Ok(false),
    }
}

pub(super) fn read(path: &Path) -> Result<Image> {
    if !is_standard(path) {
        return Image::read(path);
    }
    let mut bytes = Vec::new();
    let read = std::io::stdin().read_to_end(&mut bytes);
    read.map_err(|error| Error::io("stdin cannot be read", error))?;
    Image::decode(&bytes).map_err(|error| error.in_file(Path::new("<stdin>")))
}

/// The same file for both.
pub(super) fn twice(expected: &Path, actual: &Path) -> Error {
    Error::usage(format!(
        "the same file twice: {} and {} are one file, which would pass whatever it shows",
        expected.display(),
        actual.display()
    ))
    .help("compare two files; equal content is no hindrance")
}

/// The mask of a call, for a picture of a size: of each pixel, whether it is not to be looked at.
pub(super) fn mask(path: Option<&Path>, size: (usize, usize)) -> Result<Option<Vec<bool>>> {
    let Some(path) = path else { return Ok(None) };
    let mask = read(path)?;
    if (mask.width(), mask.height()) != size {
        let (width, height) = (mask.width(), mask.height());
        return Err(Error::usage(format!(
            "this mask has {width} x {height} pixels, and {} x {} are expected",
            size.0, size.1
        ))
        .in_file(path));
    }
    let marked = mask.marked();
    if marked.iter().all(|is_marked| *is_marked) {
        return Err(Error::usage("this mask leaves no pixel to judge")
            .in_file(path)
            .help("what is black in it is looked at, and what is not is ignored"));
    }
    Ok(Some(marked))
}
