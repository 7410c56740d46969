//! Planes as .npy files (format version 1.0, as NumPy's `numpy.lib.format` describes it).

use crate::buffer::{PixelBytes, Plane, Values};
use crate::error::{Error, Result};
use glam::DVec2;
use std::io::{self, Write};

/// The bytes that open a file of version 1.0.
const MAGIC: &[u8] = b"\x93NUMPY\x01\x00";
/// The values start at a multiple of this.
const ALIGNMENT: usize = 64;

/// A plane that can be written.
///
/// # Guarantees
/// The values fill the plane, and each is a number (infinities are).
#[derive(Debug, Clone, Copy)]
pub struct Npy<'a>(&'a Plane);

impl<'a> Npy<'a> {
    /// Checks a plane.
    ///
    /// # Errors
    /// Internal errors: a value is not a number, or the values do not fill the plane.
    pub fn new(plane: &'a Plane) -> Result<Self> {
        let wanted = plane.width * plane.height * plane.components;
        let (length, wrong) = match &plane.values {
            Values::F64(values) => (values.len(), values.iter().position(|v| v.is_nan())),
            Values::F32(values) => (values.len(), values.iter().position(|v| v.is_nan())),
            Values::U32(values) => (values.len(), None),
            Values::U16(values) => (values.len(), None),
            Values::U8(values) => (values.len(), None),
        };
        let name = plane.name;
        if length != wanted {
            return Err(Error::internal(format!("buffer `{name}` has {length} values instead of {wanted}")));
        }
        if let Some(at) = wrong {
            let pixel = at / plane.components;
            let (x, y) = (pixel % plane.width, pixel / plane.width);
            return Err(Error::internal(format!(
                "buffer `{name}` has a value that is not a number at pixel {x},{y}"
            )));
        }
        Ok(Self(plane))
    }

    /// The plane.
    pub fn plane(self) -> &'a Plane {
        self.0
    }

    /// Writes the file: an array of (rows, columns), or (rows, columns, components) where a pixel has several.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write(self, to: &mut dyn Write) -> io::Result<()> {
        to.write_all(&self.head())?;
        match &self.0.values {
            Values::F64(values) => write_values(to, values),
            Values::F32(values) => write_values(to, values),
            Values::U32(values) => write_values(to, values),
            Values::U16(values) => write_values(to, values),
            Values::U8(values) => to.write_all(values),
        }
    }

    fn head(self) -> Vec<u8> {
        let Plane { width, height, components, .. } = *self.0;
        let kind = match self.0.values {
            Values::F64(_) => "<f8",
            Values::F32(_) => "<f4",
            Values::U32(_) => "<u4",
            Values::U16(_) => "<u2",
            Values::U8(_) => "|u1",
        };
        let shape = if components == 1 {
            format!("({height}, {width})")
        } else {
            format!("({height}, {width}, {components})")
        };
        let mut words = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}");

        // Pad with spaces, so that the values are aligned; the last byte is a line's end.
        let before = MAGIC.len() + 2;
        let padded = (before + words.len() + 1).next_multiple_of(ALIGNMENT) - before;
        words.push_str(&" ".repeat(padded - 1 - words.len()));
        words.push('\n');

        let mut head = MAGIC.to_vec();
        head.extend_from_slice(&(padded as u16).to_le_bytes());
        head.extend_from_slice(words.as_bytes());
        head
    }
}

fn write_values<T: PixelBytes>(to: &mut dyn Write, values: &[T]) -> io::Result<()> {
    let mut bytes = Vec::new();
    for chunk in values.chunks(8192) {
        bytes.clear();
        chunk.iter().for_each(|value| value.push_bytes(&mut bytes));
        to.write_all(&bytes)?;
    }
    Ok(())
}

/// A plane of scene-local plan coordinates (x, y, x, y, ...) in absolute ones, in double precision whatever it was in.
/// Infinities (no coordinates) stay.
///
/// # Panics
/// When a row has an odd number of values.
pub fn absolute(plane: &Plane, origin: DVec2) -> Plane {
    assert!((plane.width * plane.components).is_multiple_of(2), "plan coordinates come in pairs");
    let moved = |values: &mut dyn Iterator<Item = f64>| {
        let origin = [origin.x, origin.y].into_iter().cycle();
        values.zip(origin).map(|(value, origin)| value + origin).collect()
    };
    let values = match &plane.values {
        Values::F64(values) => moved(&mut values.iter().copied()),
        Values::F32(values) => moved(&mut values.iter().map(|value| f64::from(*value))),
        Values::U32(values) => moved(&mut values.iter().map(|value| f64::from(*value))),
        Values::U16(values) => moved(&mut values.iter().map(|value| f64::from(*value))),
        Values::U8(values) => moved(&mut values.iter().map(|value| f64::from(*value))),
    };
    Plane { values: Values::F64(values), ..*plane }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plane(components: usize, values: Values) -> Plane {
        Plane { name: "depth", width: 3, height: 2, components, values }
    }

    /// Reads a file back: its kind, its shape as written, its bytes of values.
    fn read(plane: &Plane) -> (String, String, Vec<u8>) {
        let mut file = Vec::new();
        Npy::new(plane).unwrap().write(&mut file).unwrap();
        assert_eq!(&file[..8], b"\x93NUMPY\x01\x00");
        let length = usize::from(u16::from_le_bytes([file[8], file[9]]));
        assert_eq!((10 + length) % 64, 0, "the values are aligned");
        let head = std::str::from_utf8(&file[10..10 + length]).unwrap();
        assert!(head.ends_with('\n') && head.contains("'fortran_order': False"));
        let between = |from: &str, to: &str| {
            let rest = &head[head.find(from).unwrap() + from.len()..];
            rest[..rest.find(to).unwrap()].to_owned()
        };
        (between("'descr': '", "'"), between("'shape': (", ")"), file[10 + length..].to_vec())
    }

    #[test]
    fn every_kind_of_number_is_read_back() {
        let (kind, shape, bytes) =
            read(&plane(1, Values::F64(vec![0.0, -1.5, f64::INFINITY, 3.0, 1e300, 0.1])));
        let back: Vec<f64> = bytes.as_chunks().0.iter().map(|b| f64::from_le_bytes(*b)).collect();
        assert_eq!((kind.as_str(), shape.as_str()), ("<f8", "2, 3"));
        assert_eq!(back, [0.0, -1.5, f64::INFINITY, 3.0, 1e300, 0.1]);

        let (kind, shape, bytes) = read(&plane(2, Values::F32((0..12).map(|v| v as f32).collect())));
        let back: Vec<f32> = bytes.as_chunks().0.iter().map(|b| f32::from_le_bytes(*b)).collect();
        assert_eq!((kind.as_str(), shape.as_str()), ("<f4", "2, 3, 2"));
        assert_eq!(back[11], 11.0);

        let (kind, _, bytes) = read(&plane(1, Values::U32(vec![u32::MAX, 1, 2, 3, 4, 5])));
        assert_eq!((kind.as_str(), &bytes[..8]), ("<u4", &[255, 255, 255, 255, 1, 0, 0, 0][..]));

        let (kind, _, bytes) = read(&plane(1, Values::U16(vec![258, 1, 2, 3, 4, 5])));
        assert_eq!((kind.as_str(), bytes.len(), bytes[0]), ("<u2", 12, 2));

        let (kind, _, bytes) = read(&plane(1, Values::U8(vec![9, 1, 2, 3, 4, 5])));
        assert_eq!((kind.as_str(), bytes), ("|u1", vec![9, 1, 2, 3, 4, 5]));
    }

    #[test]
    fn a_value_that_is_not_a_number_reaches_no_file() {
        let wrong = plane(1, Values::F64(vec![0.0, 0.0, 0.0, 0.0, f64::NAN, 0.0]));
        let error = Npy::new(&wrong).unwrap_err();
        assert!(error.is_internal() && error.what().contains("at pixel 1,1"), "{error}");
        assert!(Npy::new(&plane(1, Values::F32(vec![f32::NAN; 6]))).is_err());
    }

    #[test]
    fn values_that_do_not_fill_the_plane_reach_no_file() {
        let error = Npy::new(&plane(2, Values::U8(vec![0; 6]))).unwrap_err();
        assert!(error.is_internal() && error.what().contains("6 values instead of 12"), "{error}");
    }

    #[test]
    fn absolute_coordinates_are_doubles_and_infinities_stay() {
        let local = [0.5, 1.5, f32::INFINITY, f32::INFINITY, -2.0, 0.0];
        let local: Vec<f32> = local.into_iter().cycle().take(12).collect();
        let moved = absolute(&plane(2, Values::F32(local)), DVec2::new(5e5, 7e6));
        let Values::F64(values) = moved.values else { panic!("not doubles") };
        assert_eq!(values[..6], [500_000.5, 7_000_001.5, f64::INFINITY, f64::INFINITY, 499_998.0, 7e6]);
    }
}
