//! Esri world files: six numbers beside an image that say where its pixels stand.
//!
//! The lines A, D, B, E, C, F place the centre of pixel (c, r) at `x = A c + B r + C`, `y = D c + E r + F`.

use super::failure::unreadable;
use super::frame::Frame;
use super::text::{Words, number_help};
use crate::error::{Error, Result};
use glam::DVec2;
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};

/// The frame of an image that has a world file beside it.
pub(in crate::source) fn frame_beside(image: &Path, size: (usize, usize)) -> Result<Option<Frame>> {
    let Some(path) = path_beside(image) else {
        return Ok(None);
    };
    let read = || read(&path, size);
    read().map(Some).map_err(|error| error.in_file(&path))
}

/// The world file of `image.png`: `image.pgw`, `image.pngw` or `image.wld`, in small or capital letters.
fn path_beside(image: &Path) -> Option<PathBuf> {
    let extension = image.extension()?.to_str()?.to_ascii_lowercase();
    let (first, last) = (extension.chars().next()?, extension.chars().last()?);
    let names = [format!("{first}{last}w"), format!("{extension}w"), "wld".to_owned()];
    names
        .iter()
        .flat_map(|n| [n.clone(), n.to_ascii_uppercase()])
        .map(|n| image.with_extension(n))
        .find(|p| p.is_file())
}

fn read(path: &Path, size: (usize, usize)) -> Result<Frame> {
    const LONGEST: u64 = 4096;
    let file = File::open(path).map_err(unreadable)?;
    let mut words = Words::new(BufReader::new(file.take(LONGEST)));
    let mut numbers = [0.0; 6];
    for (i, slot) in numbers.iter_mut().enumerate() {
        let Some(word) = words.next()? else {
            return Err(Error::new(format!("a world file has six numbers, this one {i}"))
                .help("its lines are: column step x, y; row step x, y; centre of the first pixel x, y")
                .at(words.end()));
        };
        *slot = word.number().ok_or_else(|| {
            Error::new(format!("`{}` is not a number", word.text()))
                .help(number_help(&word.text()))
                .at(word.position())
        })?;
    }
    let [a, d, b, e, x, y] = numbers;
    Frame::new(size, DVec2::new(x, y), (DVec2::new(a, d), DVec2::new(b, e)))
}
