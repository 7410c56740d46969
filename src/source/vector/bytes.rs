//! Files beside a file, and numbers out of a slice of bytes, never past its end.

use std::path::Path;

/// Which end of a number comes first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Endian {
    /// The most significant byte.
    Big,
    /// The least significant byte.
    Little,
}

/// A place in a slice of bytes; every read advances it, or gives `None` at the end.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cursor<'a> {
    rest: &'a [u8],
}

impl<'a> Cursor<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes }
    }

    pub(super) fn left(&self) -> usize {
        self.rest.len()
    }

    pub(super) fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.rest.split_at_checked(count)?;
        self.rest = rest;
        Some(taken)
    }

    fn array<const N: usize>(&mut self) -> Option<[u8; N]> {
        self.take(N)?.try_into().ok()
    }

    #[cfg(feature = "gpkg")]
    pub(super) fn u8(&mut self) -> Option<u8> {
        self.array::<1>().map(|[byte]| byte)
    }

    pub(super) fn u16(&mut self, endian: Endian) -> Option<u16> {
        self.array().map(|bytes| match endian {
            Endian::Big => u16::from_be_bytes(bytes),
            Endian::Little => u16::from_le_bytes(bytes),
        })
    }

    pub(super) fn u32(&mut self, endian: Endian) -> Option<u32> {
        self.array().map(|bytes| match endian {
            Endian::Big => u32::from_be_bytes(bytes),
            Endian::Little => u32::from_le_bytes(bytes),
        })
    }

    pub(super) fn u64(&mut self, endian: Endian) -> Option<u64> {
        self.array().map(|bytes| match endian {
            Endian::Big => u64::from_be_bytes(bytes),
            Endian::Little => u64::from_le_bytes(bytes),
        })
    }

    pub(super) fn f32(&mut self, endian: Endian) -> Option<f32> {
        self.u32(endian).map(f32::from_bits)
    }

    pub(super) fn f64(&mut self, endian: Endian) -> Option<f64> {
        self.array().map(|bytes| match endian {
            Endian::Big => f64::from_be_bytes(bytes),
            Endian::Little => f64::from_le_bytes(bytes),
        })
    }

    /// A count of things of at least `size` bytes each, all of which must still fit.
    pub(super) fn count(&mut self, endian: Endian, size: usize) -> Option<usize> {
        let count = self.u32(endian)? as usize;
        (count.checked_mul(size)? <= self.left()).then_some(count)
    }
}

/// The contents of a file beside another, by one of two spellings of its extension.
pub(super) fn beside(path: &Path, extension: &str, capitals: &str) -> Option<Vec<u8>> {
    let read = |extension: &str| std::fs::read(path.with_extension(extension)).ok();
    read(extension).or_else(|| read(capitals))
}
