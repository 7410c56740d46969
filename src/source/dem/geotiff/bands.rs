//! Which of a TIFF's bands holds the heights, which hold transparency, and whether it is a picture instead.

use super::tags::{Directory, Source, tag};
use crate::error::{Error, Result};
use std::io::{Read, Seek};

/// The bands of a TIFF.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Bands {
    pub(super) count: usize,
    /// The band of heights, from 0.
    pub(super) heights: usize,
    /// The bands of transparency, from 0.
    pub(super) alphas: Vec<usize>,
    /// Whether a pixel's samples lie together.
    pub(super) interleaved: bool,
}

impl Bands {
    /// The bands, and the one that is asked for, from 1.
    pub(super) fn read<R: Read + Seek>(
        directory: &Directory,
        source: &mut Source<R>,
        asked: Option<usize>,
    ) -> Result<Self> {
        let count = directory.whole(source, tag::SAMPLES_PER_PIXEL)?.unwrap_or(1);
        if count == 0 || count > 1 << 12 {
            return Err(Error::new(format!("the TIFF's {count} bands are absurd"))
                .help("extract the heights: gdal_translate -b 1 FILE OUT.tif"));
        }
        let heights = asked.unwrap_or(1);
        if heights == 0 || heights > count as usize {
            return Err(Error::new(format!("`band` = {heights}, but the file's bands are 1 to {count}"))
                .help("`drapery info FILE` tells how many there are"));
        }
        let extra = directory.wholes(source, tag::EXTRA_SAMPLES, count)?;
        // What follows the colours; the colours are at least one band.
        let first = count.checked_sub(extra.len() as u64).filter(|first| *first > 0);
        let alphas = first.map_or_else(Vec::new, |first| {
            let extra = (first as usize..).zip(&extra);
            extra
                .filter(|(band, kind)| matches!(kind, 1 | 2) && *band != heights - 1)
                .map(|(b, _)| b)
                .collect()
        });
        let interleaved = directory.whole(source, tag::PLANAR)?.unwrap_or(1) != 2;
        Ok(Self { count: count as usize, heights: heights - 1, alphas, interleaved })
    }

    /// Samples a pixel in a block, and which of them is the wanted one.
    pub(super) fn in_pixel(&self) -> (usize, usize) {
        if self.interleaved { (self.count, self.heights) } else { (1, 0) }
    }

    /// Which plane of blocks holds the heights.
    pub(super) fn plane(&self) -> usize {
        if self.interleaved { 0 } else { self.heights }
    }

    /// What the user should know.
    pub(super) fn note(&self, asked: Option<usize>) -> Option<String> {
        if self.count == 1 {
            return None;
        }
        Some(match asked {
            Some(band) => format!("the file has {} bands: band {band} is taken as heights", self.count),
            None => format!(
                "the file has {} bands: the first is taken as heights (`band` picks another)",
                self.count
            ),
        })
    }
}

/// Refuses a picture: its samples are no heights. Three bands of unsigned numbers of 8 or 16 bits, and samples that a table of colours
/// is kept for without their being called indices, may be heights to who says which band holds them.
pub(super) fn refuse_picture<R: Read + Seek>(
    directory: &Directory,
    source: &mut Source<R>,
    is_unsigned: bool,
    asked: Option<usize>,
) -> Result<()> {
    const HELP: &str = "name the file of heights that belongs to it";
    const UNLESS: &str = "name the file of heights that belongs to it; if a band of this one does hold heights, say `band` = 1";
    let (what, help) = match directory.whole(source, tag::PHOTOMETRIC)?.unwrap_or(1) {
        2 if is_unsigned && asked.is_none() => ("red, green and blue", UNLESS),
        3 => ("indices into a palette", HELP),
        5 => ("shares of printing inks", HELP),
        6 => ("brightness and colour differences", HELP),
        8 => ("colours of the CIE", HELP),
        _ if directory.has(tag::COLOR_MAP) && asked.is_none() => ("indices into a palette", UNLESS),
        _ => return Ok(()),
    };
    Err(Error::new(format!("the file is a picture: its samples are {what}, not heights")).help(help))
}
