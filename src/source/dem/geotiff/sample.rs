//! The kinds of numbers that a height can be stored as.

use super::super::nodata::Precision;
use super::tags::Endian;
use crate::error::{Error, Result};

/// A kind of stored number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Sample {
    U8,
    I8,
    U16,
    I16,
    U32,
    I32,
    F32,
    F64,
}

impl Sample {
    /// The kind that a TIFF's bits and sample format tell.
    pub(super) fn from_tags(bits: u64, format: u64) -> Result<Self> {
        Ok(match (format, bits) {
            (1 | 4, 8) => Self::U8,
            (1 | 4, 16) => Self::U16,
            (1 | 4, 32) => Self::U32,
            (2, 8) => Self::I8,
            (2, 16) => Self::I16,
            (2, 32) => Self::I32,
            (3, 32) => Self::F32,
            (3, 64) => Self::F64,
            _ => {
                let kind = match format {
                    1 | 4 => "unsigned",
                    2 => "signed",
                    3 => "floating-point",
                    _ => "complex or unknown",
                };
                return Err(Error::unsupported(format!("unsupported samples: {kind}, {bits} bits"))
                    .help("convert it: gdal_translate -ot Float32 FILE OUT.tif"));
            }
        })
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::U8 => "uint8",
            Self::I8 => "int8",
            Self::U16 => "uint16",
            Self::I16 => "int16",
            Self::U32 => "uint32",
            Self::I32 => "int32",
            Self::F32 => "float32",
            Self::F64 => "float64",
        }
    }

    /// Bytes a sample.
    pub(super) fn size(self) -> usize {
        match self {
            Self::U8 | Self::I8 => 1,
            Self::U16 | Self::I16 => 2,
            Self::U32 | Self::I32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    pub(super) fn is_floating(self) -> bool {
        matches!(self, Self::F32 | Self::F64)
    }

    pub(super) fn precision(self) -> Precision {
        match self {
            Self::F32 => Precision::Single,
            Self::F64 => Precision::Double,
            _ => Precision::Whole,
        }
    }

    /// Decodes the first sample of each pixel of `stride` samples.
    pub(super) fn decode(self, bytes: &[u8], stride: usize, endian: Endian, out: &mut [f64]) {
        match self {
            Self::U8 => each(bytes, stride, endian, out, |[b]: [u8; 1]| f64::from(b)),
            Self::I8 => each(bytes, stride, endian, out, |b| f64::from(i8::from_le_bytes(b))),
            Self::U16 => each(bytes, stride, endian, out, |b| f64::from(u16::from_le_bytes(b))),
            Self::I16 => each(bytes, stride, endian, out, |b| f64::from(i16::from_le_bytes(b))),
            Self::U32 => each(bytes, stride, endian, out, |b| f64::from(u32::from_le_bytes(b))),
            Self::I32 => each(bytes, stride, endian, out, |b| f64::from(i32::from_le_bytes(b))),
            Self::F32 => each(bytes, stride, endian, out, |b| f64::from(f32::from_le_bytes(b))),
            Self::F64 => each(bytes, stride, endian, out, f64::from_le_bytes),
        }
    }
}

fn each<const N: usize>(
    bytes: &[u8],
    stride: usize,
    endian: Endian,
    out: &mut [f64],
    number: impl Fn([u8; N]) -> f64,
) {
    let samples = bytes.as_chunks::<N>().0.iter().step_by(stride);
    for (out, sample) in out.iter_mut().zip(samples) {
        let mut sample = *sample;
        if endian == Endian::Big {
            sample.reverse();
        }
        *out = number(sample);
    }
}
