//! Row-major images of anything, and the hash of their pixels.

mod kind;
mod touches;

pub use kind::{Look, PlaneKind};
pub use touches::{Touches, picked};

/// An image: `width x height` values, rows from the top.
///
/// # Guarantees
/// `values().len() == width * height`.
#[derive(Debug, Clone, PartialEq)]
pub struct Buffer<T> {
    width: usize,
    height: usize,
    values: Vec<T>,
}

impl<T> Buffer<T> {
    /// An image of these values, rows from the top.
    ///
    /// # Panics
    /// When there are not `width * height` values.
    pub fn from_values(width: usize, height: usize, values: Vec<T>) -> Self {
        assert_eq!(values.len(), width * height, "a buffer's values must fill it");
        Self { width, height, values }
    }

    /// Pixels a row.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.height
    }

    /// All values, rows from the top.
    pub fn values(&self) -> &[T] {
        &self.values
    }

    /// The values in row order, of a buffer that is needed no more.
    pub fn into_values(self) -> Vec<T> {
        self.values
    }

    /// The value of pixel (x, y).
    ///
    /// # Panics
    /// Outside the image.
    #[inline]
    pub fn at(&self, x: usize, y: usize) -> &T {
        assert!(x < self.width, "pixel column outside the buffer");
        &self.values[y * self.width + x]
    }

    /// One row.
    ///
    /// # Panics
    /// Outside the image.
    #[inline]
    pub fn row(&self, y: usize) -> &[T] {
        &self.values[y * self.width..(y + 1) * self.width]
    }
}

/// A pixel's bytes in a fixed (little-endian) order, for hashing and writing.
pub trait PixelBytes {
    /// Appends the bytes of one pixel.
    fn push_bytes(&self, out: &mut Vec<u8>);
}

macro_rules! number_bytes {
    ($($t:ty),*) => {$(
        impl PixelBytes for $t {
            fn push_bytes(&self, out: &mut Vec<u8>) {
                out.extend_from_slice(&self.to_le_bytes());
            }
        }
    )*};
}
number_bytes!(u8, u16, u32, u64, f32, f64);

impl<T: PixelBytes, const N: usize> PixelBytes for [T; N] {
    fn push_bytes(&self, out: &mut Vec<u8>) {
        for v in self {
            v.push_bytes(out);
        }
    }
}

impl<T: PixelBytes> Buffer<T> {
    /// BLAKE3 over the pixel values in row order (little-endian), in hexadecimal: it survives re-encoding.
    pub fn hash(&self) -> String {
        let mut hasher = blake3::Hasher::new();
        let mut bytes = Vec::new();
        for row in self.values.chunks(self.width.max(1)) {
            bytes.clear();
            for v in row {
                v.push_bytes(&mut bytes);
            }
            hasher.update(&bytes);
        }
        hasher.finalize().to_hex().to_string()
    }
}

/// A named buffer of numbers, as `--buffers` writes it.
#[derive(Debug, Clone, PartialEq)]
pub struct Plane {
    /// Its name in the contract (`depth`, `class`, ...).
    pub name: &'static str,
    /// Pixels a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Numbers a pixel.
    pub components: usize,
    /// All numbers: rows from the top, then columns, then components.
    pub values: Values,
}

/// Numbers of one kind.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Doubles.
    F64(Vec<f64>),
    /// Singles.
    F32(Vec<f32>),
    /// 32-bit counts and numbers.
    U32(Vec<u32>),
    /// 16-bit counts.
    U16(Vec<u16>),
    /// Classes and bytes.
    U8(Vec<u8>),
}

impl Values {
    /// How many bytes they have.
    pub fn bytes(&self) -> usize {
        match self {
            Self::F64(values) => size_of_val(&values[..]),
            Self::F32(values) => size_of_val(&values[..]),
            Self::U32(values) => size_of_val(&values[..]),
            Self::U16(values) => size_of_val(&values[..]),
            Self::U8(values) => values.len(),
        }
    }
}

impl Plane {
    /// BLAKE3 over the values in order (little-endian), in hexadecimal.
    pub fn hash(&self) -> String {
        fn of<T: PixelBytes>(values: &[T]) -> String {
            let mut hasher = blake3::Hasher::new();
            let mut bytes = Vec::new();
            for chunk in values.chunks(4096) {
                bytes.clear();
                chunk.iter().for_each(|v| v.push_bytes(&mut bytes));
                hasher.update(&bytes);
            }
            hasher.finalize().to_hex().to_string()
        }
        match &self.values {
            Values::F64(v) => of(v),
            Values::F32(v) => of(v),
            Values::U32(v) => of(v),
            Values::U16(v) => of(v),
            Values::U8(v) => of(v),
        }
    }
}
