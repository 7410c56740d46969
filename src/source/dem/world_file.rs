//! Esri world files: six numbers beside an image that say where its pixels stand.
//!
//! The lines A, D, B, E, C, F place the centre of pixel (c, r) at `x = A c + B r + C`, `y = D c + E r + F`.

use super::frame::Frame;
use super::site::Site;
use super::text::{Words, number_help};
use crate::error::{Error, Result};
use glam::DVec2;
use std::io::{BufReader, Read};
use std::path::PathBuf;

/// The frame of an image that has a world file beside it.
pub(in crate::source) fn frame_beside(image: &Site, size: (usize, usize)) -> Result<Option<Frame>> {
    let Some(file) = image.beside(paths(image))? else {
        return Ok(None);
    };
    read(&file, size).map(Some).map_err(|error| error.in_file(file.path()))
}

/// The world files of `image.png`: `image.pgw`, `image.pngw` or `image.wld`, in small or capital letters.
fn paths(image: &Site) -> Vec<PathBuf> {
    let extension = image.extension();
    let (Some(first), Some(last)) = (extension.chars().next(), extension.chars().last()) else {
        return Vec::new();
    };
    let names = [format!("{first}{last}w"), format!("{extension}w"), "wld".to_owned()];
    let both = names.iter().flat_map(|n| [n.clone(), n.to_ascii_uppercase()]);
    both.map(|n| image.path().with_extension(n)).collect()
}

fn read(file: &Site, size: (usize, usize)) -> Result<Frame> {
    const LONGEST: u64 = 4096;
    let mut words = Words::new(BufReader::new(file.open()?.take(LONGEST)));
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
