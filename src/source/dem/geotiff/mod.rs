//! GeoTIFF and BigTIFF, classic layouts: strips or tiles, one band of the first image, and the masks that belong to it.
//!
//! Reads 8, 16 and 32-bit whole numbers, half, single and double precision; uncompressed, PackBits, LZW, deflate or ZSTD, with any predictor;
//! only the blocks that the window needs, one row of one block at a time. It refuses other compressions by name, and, before
//! memory is set aside, blocks outside the file and blocks that promise more than their bytes can stand for.

mod bands;
mod codec;
mod head;
mod layout;
mod metadata;
mod place;
mod sample;
mod tags;

use super::failure::unreadable;
use super::frame::PostRange;
use super::grid::{GridFile, Header, RowSink};
use super::options::DemOptions;
use super::sidecar::Sidecar;
use super::site::Site;
use crate::error::{Error, Result};
use codec::Compression;
use head::{Coding, Head};
use layout::Block;
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use tags::{Directory, Source, tag};

/// Where a mask is: samples of 0 where there is no post.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum MaskPlace {
    /// A band of the first directory, from 0.
    Band(usize),
    /// The first band of a later directory, the first one being 0.
    Directory(usize),
}

/// The directory of the mask that belongs to the first raster.
fn mask_directory<R: Read + Seek>(first: &Directory, source: &mut Source<R>) -> Result<Option<usize>> {
    /// More than any pyramid of overviews has; and an end to directories in a circle.
    const MOST: usize = 256;
    const REDUCED: u64 = 1;
    const MASK: u64 = 4;
    let mut next = first.next(source)?;
    for number in 1..MOST {
        let Some(directory) = next else {
            break;
        };
        let kind = directory.whole(source, tag::SUBFILE_TYPE)?.unwrap_or(0);
        if kind & MASK != 0 && kind & REDUCED == 0 {
            return Ok(Some(number));
        }
        next = directory.next(source)?;
    }
    Ok(None)
}

/// An opened GeoTIFF.
pub(super) struct GeoTiff<R> {
    source: Source<BufReader<R>>,
    head: Head,
}

impl<R: Read + Seek> GeoTiff<R> {
    /// Reads and judges the header; `site` serves to find a world file. Then come the places of its masks.
    pub(super) fn open(
        input: R,
        site: Option<&Site>,
        options: &DemOptions,
        beside: &Sidecar,
    ) -> Result<(Self, Vec<MaskPlace>)> {
        let mut source = Source::new(BufReader::new(input))?;
        let directory = Directory::read(&mut source)?;
        let mut head = Head::read(&directory, &mut source, site, options, beside)?;
        let mut masks: Vec<_> = head.alphas.iter().map(|band| MaskPlace::Band(*band)).collect();
        match mask_directory(&directory, &mut source) {
            Ok(found) => masks.extend(found.map(MaskPlace::Directory)),
            Err(error) => head.header.notes.push(format!(
                "the directories after the first are damaged, a mask among them is not followed: {}",
                error.what()
            )),
        }
        Ok((Self { source, head }, masks))
    }

    /// Opens a mask of a raster, or a raster that is a mask (its first band).
    pub(super) fn open_mask(input: R, place: MaskPlace) -> Result<Self> {
        let mut source = Source::new(BufReader::new(input))?;
        let mut directory = Directory::read(&mut source)?;
        let band = match place {
            MaskPlace::Band(band) => band,
            MaskPlace::Directory(number) => {
                for _ in 0..number {
                    let next = directory.next(&mut source)?;
                    directory = next.ok_or_else(|| Error::new("the file has changed while it was read"))?;
                }
                0
            }
        };
        let head = Head::of_mask(&directory, &mut source, band)?;
        Ok(Self { source, head })
    }

    /// Refuses a block that cannot hold its rows up to `rows`.
    fn check_block(&self, block: &Block, rows: usize) -> Result<()> {
        let length = self.source.length;
        let refuse = |what: String| {
            Err(Error::new(format!("block {} {what}", block.index))
                .help("it may be half a download: fetch it again"))
        };
        let promised = rows as u64 * self.head.layout.row_bytes() as u64;
        let end = match self.head.coding.compression {
            Compression::None => block.offset.checked_add(promised),
            _ => block.offset.checked_add(block.length),
        };
        if end.is_none_or(|end| end > length) {
            return refuse(format!(
                "lies outside the file: {} bytes at {}, of {length}",
                block.length, block.offset
            ));
        }
        if self.head.coding.compression.most_from(block.length) < promised {
            return refuse(format!(
                "promises {promised} bytes of samples, more than its {} bytes can stand for",
                block.length
            ));
        }
        Ok(())
    }

    /// Hands on the rows of `part` in one block.
    fn scan_block(
        &mut self,
        block: &Block,
        part: &PostRange,
        buffers: &mut Buffers,
        sink: &mut dyn RowSink,
    ) -> Result<()> {
        let rows = block.rows_of(part);
        self.check_block(block, rows.end)?;
        let (coding, nodata) = (self.head.coding, self.head.nodata);
        buffers.bytes.resize(self.head.layout.row_bytes(), 0);
        buffers.heights.resize(self.columns_in(block), 0.0);
        let (mut samples, first) = self.open_block(block, rows.start)?;
        for row in first..rows.end {
            samples.read_exact(&mut buffers.bytes).map_err(|e| damaged(e, block, row))?;
            if row >= rows.start {
                coding.decode(buffers);
                nodata.apply(&mut buffers.heights);
                sink.take(block.first.1 + row, block.first.0, &buffers.heights);
            }
        }
        Ok(())
    }

    /// The unpacked bytes of a block from `row` on; where it is packed, from its first row on. Says from which.
    fn open_block(&mut self, block: &Block, row: usize) -> Result<(Box<dyn Read + '_>, usize)> {
        let compression = self.head.coding.compression;
        let (start, first, length) = match compression {
            Compression::None => (block.offset + (row * self.head.layout.row_bytes()) as u64, row, u64::MAX),
            _ => (block.offset, 0, block.length),
        };
        let input = &mut self.source.input;
        input.seek(SeekFrom::Start(start)).map_err(unreadable)?;
        Ok((compression.unpack(input.take(length)), first))
    }

    /// The columns of a block that lie in the raster.
    fn columns_in(&self, block: &Block) -> usize {
        block.size.0.min(self.head.layout.size.0 - block.first.0)
    }

    /// Hands on the rows of a block that the file leaves out.
    fn fill_block(&self, block: &Block, part: &PostRange, buffers: &mut Buffers, sink: &mut dyn RowSink) {
        buffers.heights.clear();
        buffers.heights.resize(self.columns_in(block), self.head.nodata.left_out());
        for row in block.rows_of(part) {
            sink.take(block.first.1 + row, block.first.0, &buffers.heights);
        }
    }
}

impl<R: Read + Seek> GridFile for GeoTiff<R> {
    fn header(&self) -> &Header {
        &self.head.header
    }

    fn check_promise(&mut self, part: &PostRange) -> Result<()> {
        let mut stored = 0_usize;
        for block in self.head.layout.blocks_of(part) {
            if block.is_left_out() {
                check_left_out(&block)?;
            } else {
                self.check_block(&block, block.rows_of(part).end)?;
                stored += 1;
            }
        }
        if stored == 0 {
            return Err(Error::new("the file leaves out all blocks of the wanted part: no data there")
                .help("choose another window"));
        }
        Ok(())
    }

    fn scan(&mut self, part: &PostRange, sink: &mut dyn RowSink) -> Result<()> {
        self.check_promise(part)?;
        let mut buffers = Buffers::default();
        let blocks: Vec<_> = self.head.layout.blocks_of(part).collect();
        for block in blocks {
            if block.is_left_out() {
                self.fill_block(&block, part, &mut buffers, sink);
            } else {
                self.scan_block(&block, part, &mut buffers, sink)?;
            }
        }
        Ok(())
    }
}

/// Refuses a block that is left out and yet vast: nothing in the file vouches for its size.
fn check_left_out(block: &Block) -> Result<()> {
    const MOST: usize = 1 << 24;
    let (columns, rows) = block.size;
    if columns * rows <= MOST {
        return Ok(());
    }
    Err(Error::new(format!("block {} of {columns} x {rows} samples is not in the file", block.index))
        .help("it may be half a download: fetch it again"))
}

/// Memory for a row of a block.
#[derive(Default)]
struct Buffers {
    bytes: Vec<u8>,
    scratch: Vec<u8>,
    heights: Vec<f64>,
}

impl Coding {
    /// Decodes a row of a block.
    fn decode(self, buffers: &mut Buffers) {
        let kind = (self.sample.bits().div_ceil(8), self.stride);
        let Buffers { bytes, scratch, heights } = buffers;
        let endian = self.predictor.undo(bytes, scratch, kind, self.endian);
        self.sample.decode(bytes, (self.stride, self.which), endian, heights);
    }
}

fn damaged(error: io::Error, block: &Block, row: usize) -> Error {
    let what = if error.kind() == io::ErrorKind::UnexpectedEof {
        format!("block {} ends before its row {row} of {}", block.index, block.size.1)
    } else {
        format!("block {} cannot be unpacked: {error}", block.index)
    };
    Error::new(what).caused_by(error).help("the file is damaged: fetch it again")
}
