//! A directory of a TIFF: which tags it has, and their values on demand.
//!
//! Source: Adobe, "TIFF 6.0", section 2; BigTIFF after libtiff's "The BigTIFF File Format". Classic and BigTIFF, both byte
//! orders. It refuses directories and values outside the file, and values of a kind that the reader cannot use; nothing is
//! allocated beyond what the file's length vouches for.

use super::super::failure::unreadable;
use crate::error::{Error, Result};
use std::collections::BTreeMap;
use std::io::{Read, Seek, SeekFrom};

/// The tags that the reader knows, by name.
pub(super) mod tag {
    pub(in super::super) const SUBFILE_TYPE: u16 = 254;
    pub(in super::super) const WIDTH: u16 = 256;
    pub(in super::super) const HEIGHT: u16 = 257;
    pub(in super::super) const BITS: u16 = 258;
    pub(in super::super) const COMPRESSION: u16 = 259;
    pub(in super::super) const PHOTOMETRIC: u16 = 262;
    pub(in super::super) const FILL_ORDER: u16 = 266;
    pub(in super::super) const STRIP_OFFSETS: u16 = 273;
    pub(in super::super) const SAMPLES_PER_PIXEL: u16 = 277;
    pub(in super::super) const ROWS_PER_STRIP: u16 = 278;
    pub(in super::super) const STRIP_LENGTHS: u16 = 279;
    pub(in super::super) const PLANAR: u16 = 284;
    pub(in super::super) const PREDICTOR: u16 = 317;
    pub(in super::super) const COLOR_MAP: u16 = 320;
    pub(in super::super) const TILE_WIDTH: u16 = 322;
    pub(in super::super) const TILE_HEIGHT: u16 = 323;
    pub(in super::super) const TILE_OFFSETS: u16 = 324;
    pub(in super::super) const TILE_LENGTHS: u16 = 325;
    pub(in super::super) const EXTRA_SAMPLES: u16 = 338;
    pub(in super::super) const SAMPLE_FORMAT: u16 = 339;
    pub(in super::super) const PIXEL_SCALE: u16 = 33550;
    pub(in super::super) const TIE_POINTS: u16 = 33922;
    pub(in super::super) const TRANSFORMATION: u16 = 34264;
    pub(in super::super) const GEO_KEYS: u16 = 34735;
    pub(in super::super) const GEO_NUMBERS: u16 = 34736;
    pub(in super::super) const GEO_TEXT: u16 = 34737;
    pub(in super::super) const GDAL_METADATA: u16 = 42112;
    pub(in super::super) const GDAL_NODATA: u16 = 42113;
}

/// The order of a number's bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Endian {
    Little,
    Big,
}

impl Endian {
    /// The unsigned number in up to eight bytes.
    fn number(self, bytes: &[u8]) -> u64 {
        let fold = |n: u64, b: &u8| n << 8 | u64::from(*b);
        match self {
            Self::Big => bytes.iter().fold(0, fold),
            Self::Little => bytes.iter().rev().fold(0, fold),
        }
    }
}

/// A file of known length.
pub(super) struct Source<R> {
    pub(super) input: R,
    pub(super) length: u64,
}

impl<R: Read + Seek> Source<R> {
    pub(super) fn new(mut input: R) -> Result<Self> {
        let length = input.seek(SeekFrom::End(0)).map_err(unreadable)?;
        Ok(Self { input, length })
    }

    /// The bytes at a place, refused before allocation where they leave the file.
    fn bytes(&mut self, at: u64, count: u64) -> Result<Vec<u8>> {
        if at.checked_add(count).is_none_or(|end| end > self.length) {
            return Err(outside(at, count, self.length));
        }
        let mut bytes = vec![0; count as usize];
        self.input
            .seek(SeekFrom::Start(at))
            .and_then(|_| self.input.read_exact(&mut bytes))
            .map_err(unreadable)?;
        Ok(bytes)
    }
}

fn outside(at: u64, count: u64, length: u64) -> Error {
    Error::new(format!("the TIFF points to {count} bytes at {at}, but the file has {length} bytes"))
        .help("it may be half a download: fetch it again")
}

/// A tag's values: kind, count and where they are.
#[derive(Debug, Clone, Copy)]
struct Entry {
    kind: u16,
    count: u64,
    at: u64,
}

/// A directory of a TIFF.
#[derive(Debug)]
pub(super) struct Directory {
    pub(super) endian: Endian,
    pub(super) big: bool,
    /// Where the next one begins; 0: nowhere.
    next: u64,
    entries: BTreeMap<u16, Entry>,
}

impl Directory {
    /// Reads the file's header and its first directory.
    pub(super) fn read<R: Read + Seek>(source: &mut Source<R>) -> Result<Self> {
        let head = source.bytes(0, 8)?;
        let endian = if head.starts_with(b"II") { Endian::Little } else { Endian::Big };
        let big = endian.number(&head[2..4]) == 43;
        let first = if big { endian.number(&source.bytes(8, 8)?) } else { endian.number(&head[4..8]) };
        Self::at(source, first, (endian, big))
    }

    /// The directory after this one.
    pub(super) fn next<R: Read + Seek>(&self, source: &mut Source<R>) -> Result<Option<Self>> {
        let next = (self.next > 0).then_some(self.next);
        next.map(|at| Self::at(source, at, (self.endian, self.big))).transpose()
    }

    fn at<R: Read + Seek>(source: &mut Source<R>, first: u64, (endian, big): (Endian, bool)) -> Result<Self> {
        let (count_size, entry_size) = if big { (8, 20) } else { (2, 12) };
        let count = endian.number(&source.bytes(first, count_size)?);
        if count > u64::from(u16::MAX) {
            return Err(Error::new(format!("the TIFF promises {count} tags: its header is damaged")));
        }
        let start = first + count_size;
        let table = source.bytes(start, count * entry_size)?;
        let entries = (0_u64..)
            .zip(table.chunks_exact(entry_size as usize))
            .filter_map(|(i, e)| entry(endian, big, e, start + i * entry_size))
            .collect();
        // Some writers end the file here, without the place of a next directory.
        let next = source.bytes(start + count * entry_size, if big { 8 } else { 4 });
        let next = next.map_or(0, |bytes| endian.number(&bytes));
        Ok(Self { endian, big, next, entries })
    }

    /// Whether a tag is present.
    pub(super) fn has(&self, tag: u16) -> bool {
        self.entries.contains_key(&tag)
    }

    /// How many values a tag has.
    pub(super) fn count(&self, tag: u16) -> u64 {
        self.entries.get(&tag).map_or(0, |e| e.count)
    }

    /// The first whole number of a tag.
    pub(super) fn whole<R: Read + Seek>(&self, source: &mut Source<R>, tag: u16) -> Result<Option<u64>> {
        Ok(self.wholes(source, tag, 1)?.first().copied())
    }

    /// The first `most` whole numbers of a tag; none where it is missing.
    pub(super) fn wholes<R: Read + Seek>(
        &self,
        source: &mut Source<R>,
        tag: u16,
        most: u64,
    ) -> Result<Vec<u64>> {
        let Some(entry) = self.entries.get(&tag) else {
            return Ok(Vec::new());
        };
        let size = match entry.kind {
            1 => 1,
            3 => 2,
            4 | 13 => 4,
            16 | 18 => 8,
            kind => return Err(wrong_kind(tag, kind, "whole numbers")),
        };
        let bytes = values(source, entry, most, size)?;
        Ok(bytes.chunks_exact(size as usize).map(|b| self.endian.number(b)).collect())
    }

    /// The double-precision numbers of a tag.
    pub(super) fn doubles<R: Read + Seek>(&self, source: &mut Source<R>, tag: u16) -> Result<Vec<f64>> {
        const MOST: u64 = 1 << 16;
        let Some(entry) = self.entries.get(&tag) else {
            return Ok(Vec::new());
        };
        if entry.kind != 12 {
            return Err(wrong_kind(tag, entry.kind, "double-precision numbers"));
        }
        let bytes = values(source, entry, MOST, 8)?;
        Ok(bytes.chunks_exact(8).map(|b| f64::from_bits(self.endian.number(b))).collect())
    }

    /// The text of a tag, up to its first zero byte.
    pub(super) fn text<R: Read + Seek>(&self, source: &mut Source<R>, tag: u16) -> Result<Option<String>> {
        const MOST: u64 = 1 << 20;
        let Some(entry) = self.entries.get(&tag) else {
            return Ok(None);
        };
        if !matches!(entry.kind, 1 | 2 | 7) {
            return Err(wrong_kind(tag, entry.kind, "text"));
        }
        let bytes = values(source, entry, MOST, 1)?;
        let end = bytes.iter().position(|b| *b == 0).unwrap_or(bytes.len());
        Ok(Some(String::from_utf8_lossy(&bytes[..end]).into_owned()))
    }
}

/// One line of the directory; `None` for a kind of value that nobody knows.
fn entry(endian: Endian, big: bool, bytes: &[u8], at: u64) -> Option<(u16, Entry)> {
    let tag = endian.number(&bytes[..2]) as u16;
    let kind = endian.number(&bytes[2..4]) as u16;
    let (count, place, inline) =
        if big { (&bytes[4..12], &bytes[12..20], 8) } else { (&bytes[4..8], &bytes[8..12], 4) };
    let count = endian.number(count);
    let length = size_of_kind(kind)?.checked_mul(count)?;
    let at = if length <= inline { at + bytes.len() as u64 - inline } else { endian.number(place) };
    Some((tag, Entry { kind, count, at }))
}

fn size_of_kind(kind: u16) -> Option<u64> {
    match kind {
        1 | 2 | 6 | 7 => Some(1),
        3 | 8 => Some(2),
        4 | 9 | 11 | 13 => Some(4),
        5 | 10 | 12 | 16 | 17 | 18 => Some(8),
        _ => None,
    }
}

fn values<R: Read + Seek>(source: &mut Source<R>, entry: &Entry, most: u64, size: u64) -> Result<Vec<u8>> {
    let count = entry.count.min(most);
    source.bytes(entry.at, count.saturating_mul(size))
}

fn wrong_kind(tag: u16, kind: u16, wanted: &str) -> Error {
    Error::new(format!("TIFF tag {tag} should hold {wanted}, but is of type {kind}"))
        .help("rewrite the file: gdal_translate FILE OUT.tif")
}
