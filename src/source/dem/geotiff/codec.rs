//! Compressed bytes -> rows of samples: LZW, deflate, and the three predictors.
//!
//! Everything is decoded row by row, and no further than the last wanted row: a stream that lacks its end code is read
//! until the rows are full, and one that would expand without end never gets the memory. Sources: "TIFF 6.0", sections 13
//! and 14; Adobe, "TIFF Technical Note 3" (floating-point predictor).

use super::tags::Endian;
use crate::error::{Error, Result};
use std::io::{self, BufRead, Read};
use weezl::decode::Decoder;
use weezl::{BitOrder, LzwStatus};

/// How the bytes of a block are packed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Compression {
    None,
    Lzw,
    Deflate,
}

impl Compression {
    /// The compression of a TIFF tag's value.
    pub(super) fn from_tag(code: u64) -> Result<Self> {
        let name = match code {
            1 => return Ok(Self::None),
            5 => return Ok(Self::Lzw),
            8 | 32946 => return Ok(Self::Deflate),
            2..=4 => "CCITT fax",
            6 | 7 => "JPEG",
            32773 => "PackBits",
            34887 => "LERC",
            34925 => "LZMA",
            34712 => "JPEG 2000",
            50000 => "ZSTD",
            50001 => "WebP",
            50002 => "JPEG XL",
            _ => "an unknown one",
        };
        Err(Error::unsupported(format!("unsupported compression {code} ({name})"))
            .help("convert it: gdal_translate -co COMPRESS=DEFLATE FILE OUT.tif"))
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Lzw => "LZW",
            Self::Deflate => "deflate",
        }
    }

    /// The most bytes that `packed` bytes can stand for.
    pub(super) fn most_from(self, packed: u64) -> u64 {
        match self {
            Self::None => packed,
            // 12 bits stand for at most the longest string of the table, 4096 - 258.
            Self::Lzw => packed.saturating_add(16).saturating_mul(2560),
            // 258 bytes in two bits.
            Self::Deflate => packed.saturating_add(16).saturating_mul(1032),
        }
    }

    /// Unpacks while reading.
    pub(super) fn unpack<'a>(self, packed: impl BufRead + 'a) -> Box<dyn Read + 'a> {
        match self {
            Self::None => Box::new(packed),
            Self::Lzw => {
                Box::new(LzwReader { packed, decoder: Decoder::with_tiff_size_switch(BitOrder::Msb, 8) })
            }
            Self::Deflate => Box::new(flate2::bufread::ZlibDecoder::new(packed)),
        }
    }
}

/// Unpacks TIFF's LZW while reading.
struct LzwReader<R> {
    packed: R,
    decoder: Decoder,
}

impl<R: BufRead> Read for LzwReader<R> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        loop {
            let packed = self.packed.fill_buf()?;
            let step = self.decoder.decode_bytes(packed, out);
            let (read, written) = (step.consumed_in, step.consumed_out);
            self.packed.consume(read);
            match step.status {
                Err(error) if written == 0 => {
                    return Err(io::Error::new(io::ErrorKind::InvalidData, error));
                }
                Ok(LzwStatus::Done | LzwStatus::NoProgress) | Err(_) => return Ok(written),
                Ok(LzwStatus::Ok) if written > 0 || read == 0 => return Ok(written),
                Ok(LzwStatus::Ok) => {}
            }
        }
    }
}

/// How samples were made easier to pack.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Predictor {
    None,
    /// Differences to the sample on the left.
    Horizontal,
    /// Differences of bytes sorted by weight.
    FloatingPoint,
}

impl Predictor {
    /// The predictor of a TIFF tag's value, for samples of this kind.
    pub(super) fn from_tag(code: u64, floating: bool) -> Result<Self> {
        match code {
            1 => Ok(Self::None),
            2 => Ok(Self::Horizontal),
            3 if floating => Ok(Self::FloatingPoint),
            _ => Err(Error::unsupported(format!("unsupported TIFF predictor {code} for these samples"))
                .help("convert it: gdal_translate -co COMPRESS=DEFLATE FILE OUT.tif")),
        }
    }

    /// Undoes it in a row of samples of `size` bytes, `stride` of them a pixel; returns the order of the bytes after it.
    pub(super) fn undo(
        self,
        row: &mut [u8],
        scratch: &mut Vec<u8>,
        (size, stride): (usize, usize),
        endian: Endian,
    ) -> Endian {
        match self {
            Self::None => endian,
            Self::Horizontal => {
                sum_samples(row, size, stride, endian);
                endian
            }
            Self::FloatingPoint => {
                sum_bytes(row, stride);
                gather_bytes(row, scratch, size);
                Endian::Big
            }
        }
    }
}

/// Adds to each sample the one a pixel before.
fn sum_samples(row: &mut [u8], size: usize, stride: usize, endian: Endian) {
    match size {
        1 => sum_bytes(row, stride),
        2 => sum_words(row, stride, endian, u16::from_le_bytes, u16::to_le_bytes, u16::wrapping_add),
        4 => sum_words(row, stride, endian, u32::from_le_bytes, u32::to_le_bytes, u32::wrapping_add),
        _ => sum_words(row, stride, endian, u64::from_le_bytes, u64::to_le_bytes, u64::wrapping_add),
    }
}

fn sum_words<const N: usize, T: Copy>(
    row: &mut [u8],
    stride: usize,
    endian: Endian,
    from: impl Fn([u8; N]) -> T,
    to: impl Fn(T) -> [u8; N],
    add: impl Fn(T, T) -> T,
) {
    let turn = |mut bytes: [u8; N]| {
        if endian == Endian::Big {
            bytes.reverse();
        }
        bytes
    };
    let words = row.as_chunks_mut::<N>().0;
    for i in stride..words.len() {
        let sum = add(from(turn(words[i])), from(turn(words[i - stride])));
        words[i] = turn(to(sum));
    }
}

fn sum_bytes(row: &mut [u8], stride: usize) {
    for i in stride..row.len() {
        row[i] = row[i].wrapping_add(row[i - stride]);
    }
}

/// Brings together the bytes of each sample, which lie in planes from the most to the least significant.
fn gather_bytes(row: &mut [u8], scratch: &mut Vec<u8>, size: usize) {
    scratch.clear();
    scratch.extend_from_slice(row);
    let count = row.len() / size;
    for (i, sample) in row.chunks_exact_mut(size).enumerate() {
        for (plane, byte) in sample.iter_mut().enumerate() {
            *byte = scratch[plane * count + i];
        }
    }
}
