//! Compressed bytes -> rows of samples: PackBits, LZW, deflate, ZSTD, and the three predictors.
//!
//! Everything is decoded row by row, and no further than the last wanted row: a stream that lacks its end code is read
//! until the rows are full, and one that would expand without end never gets the memory. Sources: "TIFF 6.0", sections 9,
//! 13 and 14; Adobe, "TIFF Technical Note 3" (floating-point predictor).

use super::tags::Endian;
use crate::error::{Error, Result};
use ruzstd::decoding::{FrameDecoder, StreamingDecoder};
use std::io::{self, BufRead, Read};
use weezl::decode::Decoder;
use weezl::{BitOrder, LzwStatus};

/// How the bytes of a block are packed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Compression {
    None,
    PackBits,
    Lzw,
    Deflate,
    Zstd,
}

impl Compression {
    /// The compression of a TIFF tag's value.
    pub(super) fn from_tag(code: u64) -> Result<Self> {
        let name = match code {
            1 => return Ok(Self::None),
            5 => return Ok(Self::Lzw),
            8 | 32946 => return Ok(Self::Deflate),
            32773 => return Ok(Self::PackBits),
            50000 => return Ok(Self::Zstd),
            2..=4 => "CCITT fax",
            6 | 7 => "JPEG",
            34887 => "LERC",
            34925 => "LZMA",
            34712 => "JPEG 2000",
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
            Self::PackBits => "PackBits",
            Self::Lzw => "LZW",
            Self::Deflate => "deflate",
            Self::Zstd => "ZSTD",
        }
    }

    /// The most bytes that `packed` bytes can stand for.
    pub(super) fn most_from(self, packed: u64) -> u64 {
        match self {
            Self::None => packed,
            // Two bytes repeat one up to 128 times.
            Self::PackBits => packed.saturating_mul(64),
            // 12 bits stand for at most the longest string of the table, 4096 - 258.
            Self::Lzw => packed.saturating_add(16).saturating_mul(2560),
            // 258 bytes in two bits.
            Self::Deflate => packed.saturating_add(16).saturating_mul(1032),
            // A block of four bytes repeats one 128 Ki times.
            Self::Zstd => packed.saturating_mul(1 << 15),
        }
    }

    /// Unpacks while reading.
    pub(super) fn unpack<'a>(self, packed: impl BufRead + 'a) -> Box<dyn Read + 'a> {
        match self {
            Self::None => Box::new(packed),
            Self::Lzw => {
                Box::new(LzwReader { packed, decoder: Decoder::with_tiff_size_switch(BitOrder::Msb, 8) })
            }
            Self::PackBits => Box::new(PackBits { packed, run: Run::Copied(0) }),
            Self::Deflate => Box::new(flate2::bufread::ZlibDecoder::new(packed)),
            Self::Zstd => Box::new(Zstd::Closed(Some(packed))),
        }
    }
}

/// Unpacks Apple's PackBits while reading.
struct PackBits<R> {
    packed: R,
    run: Run,
}

/// What is left of a run.
#[derive(Debug, Clone, Copy)]
enum Run {
    /// So many bytes as they are.
    Copied(usize),
    /// So many times a byte.
    Repeated(usize, u8),
}

impl<R: BufRead> PackBits<R> {
    fn byte(&mut self) -> io::Result<Option<u8>> {
        let byte = self.packed.fill_buf()?.first().copied();
        self.packed.consume(usize::from(byte.is_some()));
        Ok(byte)
    }

    /// The next run; `None` at the end.
    fn next_run(&mut self) -> io::Result<Option<Run>> {
        let Some(head) = self.byte()? else {
            return Ok(None);
        };
        Ok(match head {
            0..=127 => Some(Run::Copied(usize::from(head) + 1)),
            // Says nothing.
            128 => Some(Run::Copied(0)),
            129.. => self.byte()?.map(|byte| Run::Repeated(257 - usize::from(head), byte)),
        })
    }
}

impl<R: BufRead> Read for PackBits<R> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        while !out.is_empty() {
            match &mut self.run {
                Run::Copied(0) | Run::Repeated(0, _) => match self.next_run()? {
                    Some(run) => self.run = run,
                    None => return Ok(0),
                },
                Run::Copied(left) => {
                    let count = out.len().min(*left);
                    let read = self.packed.read(&mut out[..count])?;
                    *left -= read;
                    return Ok(read);
                }
                Run::Repeated(left, byte) => {
                    let count = out.len().min(*left);
                    out[..count].fill(*byte);
                    *left -= count;
                    return Ok(count);
                }
            }
        }
        Ok(0)
    }
}

/// Unpacks ZSTD while reading; the frame is opened with the first byte that is wanted.
enum Zstd<R: Read> {
    Closed(Option<R>),
    Open(Box<StreamingDecoder<R, FrameDecoder>>),
}

impl<R: Read> Read for Zstd<R> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        if let Self::Closed(packed) = self {
            let Some(packed) = packed.take() else {
                return Ok(0);
            };
            let decoder = StreamingDecoder::new(packed);
            let damaged = |error| io::Error::new(io::ErrorKind::InvalidData, format!("{error}"));
            *self = Self::Open(Box::new(decoder.map_err(damaged)?));
        }
        match self {
            Self::Open(decoder) => decoder.read(out),
            Self::Closed(_) => Ok(0),
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
