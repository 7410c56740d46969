//! GeoTIFF and BigTIFF, classic layouts: strips or tiles, first band, first image.
//!
//! Reads 8, 16 and 32-bit whole numbers, single and double precision; uncompressed, LZW or deflate, with any predictor;
//! only the blocks that the window needs, one row of one block at a time. It refuses other compressions by name, and, before
//! memory is set aside, blocks outside the file and blocks that promise more than their bytes can stand for.

mod codec;
mod layout;
mod place;
mod sample;
mod tags;

use super::geo_keys::GeoKeys;
use super::grid::{GridFile, Header, Part, RowSink};
use super::nodata::Nodata;
use super::open::unreadable;
use crate::error::{Error, Result};
use codec::{Compression, Predictor};
use layout::{Block, Layout};
use sample::Sample;
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::path::Path;
use tags::{Directory, Endian, Source, tag};

/// An opened GeoTIFF.
pub(super) struct GeoTiff<R> {
    source: Source<BufReader<R>>,
    header: Header,
    layout: Layout,
    coding: Coding,
    nodata: Nodata,
    scaling: Option<(f64, f64)>,
}

/// How samples are written.
#[derive(Debug, Clone, Copy)]
struct Coding {
    endian: Endian,
    compression: Compression,
    predictor: Predictor,
    sample: Sample,
    /// Samples a pixel in a block.
    stride: usize,
}

impl<R: Read + Seek> GeoTiff<R> {
    /// Reads and judges the header; `path` serves to find a world file, `bounds` stands in for a missing place.
    pub(super) fn open(input: R, path: Option<&Path>, bounds: Option<[f64; 4]>) -> Result<Self> {
        let mut source = Source::new(BufReader::new(input))?;
        let directory = Directory::read(&mut source)?;
        let size = raster_size(&directory, &mut source)?;
        let (coding, bands) = coding(&directory, &mut source)?;
        let pixel_bytes = coding.sample.size() * coding.stride;
        let layout = Layout::read(&directory, &mut source, size, pixel_bytes)?;
        if coding.compression != Compression::None && !layout.has_lengths() {
            return Err(
                Error::new("the TIFF does not say how long its compressed blocks are")
                    .help("rewrite the file: gdal_translate FILE OUT.tif"),
            );
        }
        let keys = geo_keys(&directory, &mut source)?;
        let (frame, note) = place::frame(&directory, &mut source, &keys, size, (path, bounds))?;
        let declared = directory.text(&mut source, tag::GDAL_NODATA)?;
        let nodata = nodata(declared.as_deref(), coding.sample)?;
        let scaling = scaling(&directory, &mut source)?;
        let notes = [note, note_bands(bands), note_units(&keys), note_scaling(scaling)];
        let header = Header {
            format: if directory.big { "BigTIFF" } else { "GeoTIFF" },
            sample: coding.sample.name().into(),
            compression: coding.compression.name().into(),
            layout: layout.describe(),
            nodata: declared.map(|text| text.trim().to_owned()),
            frame,
            crs_hint: keys.crs_hint(),
            notes: notes.into_iter().flatten().collect(),
        };
        Ok(Self {
            source,
            header,
            layout,
            coding,
            nodata,
            scaling,
        })
    }

    /// Refuses a block that cannot hold its rows up to `rows`.
    fn check_block(&self, block: &Block, rows: usize) -> Result<()> {
        let length = self.source.length;
        let refuse = |what: String| {
            Err(Error::new(format!("block {} {what}", block.index))
                .help("it may be half a download: fetch it again"))
        };
        let promised = rows as u64 * self.layout.row_bytes() as u64;
        let end = match self.coding.compression {
            Compression::None => block.offset.checked_add(promised),
            _ => block.offset.checked_add(block.length),
        };
        if end.is_none_or(|end| end > length) {
            return refuse(format!(
                "lies outside the file: {} bytes at {}, of {length}",
                block.length, block.offset
            ));
        }
        if self.coding.compression.most_from(block.length) < promised {
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
        part: &Part,
        buffers: &mut Buffers,
        sink: &mut dyn RowSink,
    ) -> Result<()> {
        let rows = block.rows_of(part);
        self.check_block(block, rows.end)?;
        let coding = self.coding;
        let row_bytes = self.layout.row_bytes();
        let columns = block.size.0.min(self.layout.size.0 - block.first.0);
        let mut skip = rows.start;
        let mut start = block.offset;
        if coding.compression == Compression::None {
            start += (skip * row_bytes) as u64;
            skip = 0;
        }
        let input = &mut self.source.input;
        input.seek(SeekFrom::Start(start)).map_err(unreadable)?;
        let most = if coding.compression == Compression::None {
            u64::MAX
        } else {
            block.length
        };
        let mut samples = coding.compression.unpack(input.take(most));
        buffers.bytes.resize(row_bytes, 0);
        buffers.heights.resize(columns, 0.0);
        for _ in 0..skip {
            samples
                .read_exact(&mut buffers.bytes)
                .map_err(|e| damaged(&e, block, 0))?;
        }
        for row in rows {
            samples
                .read_exact(&mut buffers.bytes)
                .map_err(|e| damaged(&e, block, row))?;
            coding.decode(buffers);
            self.nodata.apply(&mut buffers.heights, self.scaling);
            sink.take(block.first.1 + row, block.first.0, &buffers.heights);
        }
        Ok(())
    }

    /// Hands on the rows of a block that the file leaves out.
    fn fill_block(&self, block: &Block, part: &Part, buffers: &mut Buffers, sink: &mut dyn RowSink) {
        let columns = block.size.0.min(self.layout.size.0 - block.first.0);
        buffers.heights.clear();
        buffers.heights.resize(columns, self.nodata.left_out());
        for row in block.rows_of(part) {
            sink.take(block.first.1 + row, block.first.0, &buffers.heights);
        }
    }
}

impl<R: Read + Seek> GridFile for GeoTiff<R> {
    fn header(&self) -> &Header {
        &self.header
    }

    fn check_promise(&mut self, part: &Part) -> Result<()> {
        let mut stored = 0_usize;
        for block in self.layout.blocks_of(part) {
            if block.is_left_out() {
                check_left_out(&block)?;
            } else {
                self.check_block(&block, block.rows_of(part).end)?;
                stored += 1;
            }
        }
        if stored == 0 {
            return Err(
                Error::new("the file leaves out all blocks of the wanted part: no data there")
                    .help("choose another window"),
            );
        }
        Ok(())
    }

    fn scan(&mut self, part: &Part, sink: &mut dyn RowSink) -> Result<()> {
        self.check_promise(part)?;
        let mut buffers = Buffers::default();
        let blocks: Vec<_> = self.layout.blocks_of(part).collect();
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
    Err(Error::new(format!(
        "block {} of {columns} x {rows} samples is not in the file",
        block.index
    ))
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
        let kind = (self.sample.size(), self.stride);
        let Buffers {
            bytes,
            scratch,
            heights,
        } = buffers;
        let endian = self.predictor.undo(bytes, scratch, kind, self.endian);
        self.sample.decode(bytes, self.stride, endian, heights);
    }
}

fn damaged(error: &io::Error, block: &Block, row: usize) -> Error {
    let what = if error.kind() == io::ErrorKind::UnexpectedEof {
        format!(
            "block {} ends before its row {row} of {}",
            block.index, block.size.1
        )
    } else {
        format!("block {} cannot be unpacked: {error}", block.index)
    };
    Error::new(what).help("the file is damaged: fetch it again")
}

fn raster_size<R: Read + Seek>(directory: &Directory, source: &mut Source<R>) -> Result<(usize, usize)> {
    let mut read = |tag, name: &str| {
        let value = directory.whole(source, tag)?.unwrap_or(0);
        if value == 0 || value > 1 << 31 {
            return Err(
                Error::new(format!("the TIFF's {name} of {value} samples is absurd"))
                    .help("the header is damaged: fetch the file again"),
            );
        }
        Ok(value as usize)
    };
    Ok((read(tag::WIDTH, "width")?, read(tag::HEIGHT, "height")?))
}

/// How samples are written, and how many bands there are.
fn coding<R: Read + Seek>(directory: &Directory, source: &mut Source<R>) -> Result<(Coding, u64)> {
    let mut get = |tag, default| Ok::<_, Error>(directory.whole(source, tag)?.unwrap_or(default));
    let bands = get(tag::SAMPLES_PER_PIXEL, 1)?;
    if bands == 0 || bands > 1 << 12 {
        return Err(Error::new(format!("the TIFF's {bands} bands are absurd"))
            .help("extract the heights: gdal_translate -b 1 FILE OUT.tif"));
    }
    if get(tag::FILL_ORDER, 1)? != 1 {
        return Err(
            Error::new("the TIFF's bytes hold their bits in reverse (FillOrder 2)")
                .help("rewrite the file: gdal_translate FILE OUT.tif"),
        );
    }
    let sample = Sample::from_tags(get(tag::BITS, 1)?, get(tag::SAMPLE_FORMAT, 1)?)?;
    let interleaved = get(tag::PLANAR, 1)? != 2;
    let coding = Coding {
        endian: directory.endian,
        compression: Compression::from_tag(get(tag::COMPRESSION, 1)?)?,
        predictor: Predictor::from_tag(get(tag::PREDICTOR, 1)?, sample.is_floating())?,
        sample,
        stride: if interleaved { bands as usize } else { 1 },
    };
    if interleaved && bands > 1 {
        check_equal_bits(directory, source, bands)?;
    }
    Ok((coding, bands))
}

/// Refuses interleaved bands of different sizes.
fn check_equal_bits<R: Read + Seek>(directory: &Directory, source: &mut Source<R>, bands: u64) -> Result<()> {
    let bits = directory.wholes(source, tag::BITS, bands)?;
    if bits.windows(2).all(|pair| pair[0] == pair[1]) {
        return Ok(());
    }
    Err(Error::new("the TIFF's bands have samples of different sizes")
        .help("extract the heights: gdal_translate -b 1 FILE OUT.tif"))
}

fn geo_keys<R: Read + Seek>(directory: &Directory, source: &mut Source<R>) -> Result<GeoKeys> {
    const MOST: u64 = 1 << 16;
    let keys = directory.wholes(source, tag::GEO_KEYS, MOST)?;
    let keys: Vec<u16> = keys.into_iter().map(|k| k as u16).collect();
    let numbers = directory.doubles(source, tag::GEO_NUMBERS)?;
    let text = directory.text(source, tag::GEO_TEXT)?.unwrap_or_default();
    Ok(GeoKeys::new(&keys, &numbers, &text))
}

fn nodata(declared: Option<&str>, sample: Sample) -> Result<Nodata> {
    let text = declared.map(str::trim).filter(|t| !t.is_empty());
    let value = text.map(|text| {
        text.parse().map_err(|_| {
            Error::new(format!("the nodata value `{text}` is not a number"))
                .help("set it anew: gdal_edit.py -a_nodata VALUE FILE")
        })
    });
    Ok(Nodata::new(value.transpose()?, sample.precision()))
}

/// Factor and offset of the first band in GDAL's metadata: height = sample * factor + offset.
fn scaling<R: Read + Seek>(directory: &Directory, source: &mut Source<R>) -> Result<Option<(f64, f64)>> {
    let Some(xml) = directory.text(source, tag::GDAL_METADATA)? else {
        return Ok(None);
    };
    let factor = metadata_item(&xml, "scale").unwrap_or(1.0);
    let offset = metadata_item(&xml, "offset").unwrap_or(0.0);
    Ok(((factor, offset) != (1.0, 0.0)).then_some((factor, offset)))
}

/// The number in `<Item ... sample="0" role="ROLE">number</Item>`.
fn metadata_item(xml: &str, role: &str) -> Option<f64> {
    let role = format!("role=\"{role}\"");
    xml.split("<Item ").skip(1).find_map(|item| {
        let (attributes, rest) = item.split_once('>')?;
        if !attributes.contains(&role) || !attributes.contains("sample=\"0\"") {
            return None;
        }
        let number: f64 = rest.split_once('<')?.0.trim().parse().ok()?;
        number.is_finite().then_some(number)
    })
}

fn note_bands(bands: u64) -> Option<String> {
    (bands > 1).then(|| format!("the file has {bands} bands: the first is taken as heights"))
}

fn note_units(keys: &GeoKeys) -> Option<String> {
    let unit = keys.foreign_vertical_unit()?;
    Some(format!(
        "the file declares heights in {unit}; they are taken as metres (set vertical_scale)"
    ))
}

fn note_scaling(scaling: Option<(f64, f64)>) -> Option<String> {
    let (factor, offset) = scaling?;
    Some(format!(
        "heights are samples x {factor} + {offset}, as the file declares"
    ))
}
