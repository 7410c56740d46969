//! How a TIFF's samples are cut into blocks (strips or tiles), and where those lie in the file.

use super::super::frame::PostRange;
use super::tags::{Directory, Source, tag};
use crate::error::{Error, Result};
use std::io::{Read, Seek};
use std::ops::Range;

/// The largest row of a block, in bytes, that is held.
const LONGEST_ROW: u64 = 1 << 26;

/// The blocks of a band.
#[derive(Debug)]
pub(super) struct Layout {
    /// Columns and rows of the raster.
    pub(super) size: (usize, usize),
    /// Columns and rows of a block; blocks at the edge of tiled rasters reach beyond it.
    pub(super) block: (usize, usize),
    pub(super) tiled: bool,
    /// Bits a pixel in a block.
    pixel_bits: usize,
    across: usize,
    offsets: Vec<u64>,
    /// Lengths in the file; empty where an uncompressed file leaves them out.
    lengths: Vec<u64>,
}

/// One block: where it lies in the raster and in the file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Block {
    pub(super) index: usize,
    /// The raster's column and row of its first sample.
    pub(super) first: (usize, usize),
    /// Columns and rows stored in it.
    pub(super) size: (usize, usize),
    pub(super) offset: u64,
    pub(super) length: u64,
}

impl Block {
    /// Whether the file leaves the block out.
    pub(super) fn is_left_out(&self) -> bool {
        self.offset == 0 && self.length == 0
    }

    /// The rows of `part` in it, counted from its own first.
    pub(super) fn rows_of(&self, part: &PostRange) -> Range<usize> {
        let from = part.row.max(self.first.1) - self.first.1;
        let to = (part.row + part.rows).min(self.first.1 + self.size.1) - self.first.1;
        from..to
    }
}

impl Layout {
    /// Reads the layout of a raster: `pixel_bits` is the size of all interleaved samples of a pixel, `plane` which of the
    /// sets of blocks is wanted where bands lie apart.
    pub(super) fn read<R: Read + Seek>(
        directory: &Directory,
        source: &mut Source<R>,
        size: (usize, usize),
        pixel_bits: usize,
        plane: usize,
    ) -> Result<Self> {
        let tiled = directory.has(tag::TILE_WIDTH) || directory.has(tag::TILE_OFFSETS);
        let block = if tiled {
            let columns = directory.whole(source, tag::TILE_WIDTH)?.unwrap_or(0);
            (columns, directory.whole(source, tag::TILE_HEIGHT)?.unwrap_or(0))
        } else {
            let rows = directory.whole(source, tag::ROWS_PER_STRIP)?;
            (size.0 as u64, rows.unwrap_or(u64::MAX).min(size.1 as u64))
        };
        let block = checked_block(block, pixel_bits)?;
        let across = size.0.div_ceil(block.0);
        let in_plane = across as u64 * size.1.div_ceil(block.1) as u64;
        let count = in_plane.saturating_mul(plane as u64 + 1);
        let (offsets, lengths) = if tiled {
            (tag::TILE_OFFSETS, tag::TILE_LENGTHS)
        } else {
            (tag::STRIP_OFFSETS, tag::STRIP_LENGTHS)
        };
        if directory.count(offsets) < count
            || !matches!(directory.count(lengths), 0) && directory.count(lengths) < count
        {
            return Err(Error::new(format!(
                "{} x {} samples need {count} blocks, but the TIFF lists {}",
                size.0,
                size.1,
                directory.count(offsets)
            ))
            .help("the header is damaged: fetch the file again"));
        }
        let mut of_plane = |tag| {
            let mut values = directory.wholes(source, tag, count)?;
            values.drain(..values.len().saturating_sub(in_plane as usize));
            Ok::<_, Error>(values)
        };
        let (offsets, lengths) = (of_plane(offsets)?, of_plane(lengths)?);
        Ok(Self { size, block, tiled, pixel_bits, across, offsets, lengths })
    }

    /// Whether the file says how long its blocks are.
    pub(super) fn has_lengths(&self) -> bool {
        !self.lengths.is_empty()
    }

    /// In words, for a person.
    pub(super) fn describe(&self) -> String {
        if self.tiled {
            format!("tiles of {} x {}", self.block.0, self.block.1)
        } else if self.block.1 == 1 {
            "strips of 1 row".into()
        } else {
            format!("strips of {} rows", self.block.1)
        }
    }

    /// The bytes of a block's row.
    pub(super) fn row_bytes(&self) -> usize {
        (self.block.0 * self.pixel_bits).div_ceil(8)
    }

    /// The blocks that hold samples of `part`, in file order.
    pub(super) fn blocks_of(&self, part: &PostRange) -> impl Iterator<Item = Block> + use<'_> {
        let (across, down) = self.block;
        let columns = part.column / across..(part.column + part.columns).div_ceil(across);
        let rows = part.row / down..(part.row + part.rows).div_ceil(down);
        rows.flat_map(move |r| columns.clone().map(move |c| self.block_at(c, r)))
    }

    fn block_at(&self, column: usize, row: usize) -> Block {
        let index = row * self.across + column;
        let first = (column * self.block.0, row * self.block.1);
        // The last strip ends with the raster; tiles are whole.
        let rows = if self.tiled { self.block.1 } else { self.block.1.min(self.size.1 - first.1) };
        let stored = (rows * self.row_bytes()) as u64;
        Block {
            index,
            first,
            size: (self.block.0, rows),
            offset: self.offsets.get(index).copied().unwrap_or(0),
            length: self.lengths.get(index).copied().unwrap_or(stored),
        }
    }
}

fn checked_block((columns, rows): (u64, u64), pixel_bits: usize) -> Result<(usize, usize)> {
    let longest = 8 * LONGEST_ROW / pixel_bits as u64;
    if columns == 0 || rows == 0 || columns > longest || rows > 1 << 31 {
        return Err(Error::unsupported(format!(
            "blocks of {columns} x {rows} samples are not supported (a row may have {longest})"
        ))
        .help("convert it: gdal_translate -co TILED=YES FILE OUT.tif"));
    }
    Ok((columns as usize, rows as usize))
}
