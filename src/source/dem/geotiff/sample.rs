//! The kinds of numbers that a height can be stored as.

use super::super::nodata::Precision;
use super::tags::Endian;
use crate::error::{Error, Result};

/// A kind of stored number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Sample {
    /// A single bit: of masks only.
    Bit,
    U8,
    I8,
    U16,
    I16,
    U32,
    I32,
    F16,
    F32,
    F64,
}

impl Sample {
    /// The kind that a TIFF's bits and sample format tell.
    pub(super) fn from_tags(bits: u64, format: u64) -> Result<Self> {
        Ok(match (format, bits) {
            (1 | 4, 1) => Self::Bit,
            (1 | 4, 8) => Self::U8,
            (1 | 4, 16) => Self::U16,
            (1 | 4, 32) => Self::U32,
            (2, 8) => Self::I8,
            (2, 16) => Self::I16,
            (2, 32) => Self::I32,
            (3, 16) => Self::F16,
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
            Self::Bit => "bit",
            Self::U8 => "uint8",
            Self::I8 => "int8",
            Self::U16 => "uint16",
            Self::I16 => "int16",
            Self::U32 => "uint32",
            Self::I32 => "int32",
            Self::F16 => "float16",
            Self::F32 => "float32",
            Self::F64 => "float64",
        }
    }

    /// Bits a sample.
    pub(super) fn bits(self) -> usize {
        match self {
            Self::Bit => 1,
            Self::U8 | Self::I8 => 8,
            Self::U16 | Self::I16 | Self::F16 => 16,
            Self::U32 | Self::I32 | Self::F32 => 32,
            Self::F64 => 64,
        }
    }

    pub(super) fn is_floating(self) -> bool {
        matches!(self, Self::F16 | Self::F32 | Self::F64)
    }

    pub(super) fn precision(self) -> Precision {
        match self {
            Self::F32 => Precision::Single,
            Self::F16 | Self::F64 => Precision::Double,
            _ => Precision::Whole,
        }
    }

    /// Decodes one sample of each pixel: which of its `stride` samples.
    pub(super) fn decode(
        self,
        bytes: &[u8],
        (stride, which): (usize, usize),
        endian: Endian,
        out: &mut [f64],
    ) {
        let bytes = bytes.get(which * self.bits() / 8..).unwrap_or_default();
        match self {
            Self::Bit => out.iter_mut().enumerate().for_each(|(i, out)| {
                let at = i * stride + which % 8;
                *out = f64::from(bytes.get(at / 8).copied().unwrap_or(0) >> (7 - at % 8) & 1);
            }),
            Self::U8 => each(bytes, stride, endian, out, |[b]: [u8; 1]| f64::from(b)),
            Self::I8 => each(bytes, stride, endian, out, |b| f64::from(i8::from_le_bytes(b))),
            Self::U16 => each(bytes, stride, endian, out, |b| f64::from(u16::from_le_bytes(b))),
            Self::I16 => each(bytes, stride, endian, out, |b| f64::from(i16::from_le_bytes(b))),
            Self::U32 => each(bytes, stride, endian, out, |b| f64::from(u32::from_le_bytes(b))),
            Self::I32 => each(bytes, stride, endian, out, |b| f64::from(i32::from_le_bytes(b))),
            Self::F16 => each(bytes, stride, endian, out, |b| of_half(u16::from_le_bytes(b))),
            Self::F32 => each(bytes, stride, endian, out, |b| f64::from(f32::from_le_bytes(b))),
            Self::F64 => each(bytes, stride, endian, out, f64::from_le_bytes),
        }
    }
}

/// The number of the bits of half precision (IEEE 754 binary16).
fn of_half(bits: u16) -> f64 {
    let sign = f64::from(bits >> 15) * -2.0 + 1.0;
    let (exponent, fraction) = (i32::from(bits >> 10 & 31), f64::from(bits & 1023));
    let two_to = |power: i32| f64::from_bits(((power + 1023) as u64) << 52);
    sign * match exponent {
        0 => fraction * two_to(-24),
        31 if fraction > 0.0 => f64::NAN,
        31 => f64::INFINITY,
        _ => (1.0 + fraction / 1024.0) * two_to(exponent - 15),
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_precision_has_its_values() {
        let bits = [0x3c00, 0xc000, 0x7bff, 0x0001, 0x0400, 0x3555, 0x8000, 0xfc00];
        let expected = [
            1.0,
            -2.0,
            65504.0,
            5.960_464_477_539_063e-8,
            6.103_515_625e-5,
            0.333_251_953_125,
            -0.0,
            f64::NEG_INFINITY,
        ];
        assert_eq!(bits.map(of_half), expected);
        assert!(of_half(0x7e00).is_nan());
    }

    #[test]
    fn bits_are_counted_from_the_highest() {
        let mut out = [0.0; 5];
        Sample::Bit.decode(&[0b1011_0000, 0b1000_0000], (1, 0), Endian::Little, &mut out);
        assert_eq!(out, [1.0, 0.0, 1.0, 1.0, 0.0]);
        Sample::Bit.decode(&[0b1011_0100, 0b1000_0000], (2, 1), Endian::Little, &mut out);
        assert_eq!(out, [0.0, 1.0, 1.0, 0.0, 0.0]);
    }
}
