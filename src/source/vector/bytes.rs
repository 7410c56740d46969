//! A file's bytes, and numbers out of a slice of them, never past its end.

use crate::error::{Error, Result};
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

    pub(super) fn u8(&mut self) -> Option<u8> {
        self.array::<1>().map(|[byte]| byte)
    }

    pub(super) fn u32(&mut self, endian: Endian) -> Option<u32> {
        self.array().map(|bytes| match endian {
            Endian::Big => u32::from_be_bytes(bytes),
            Endian::Little => u32::from_le_bytes(bytes),
        })
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

/// The refusal of a file that the system does not give.
pub(super) fn cannot_read(e: &std::io::Error) -> Error {
    let help = match e.kind() {
        std::io::ErrorKind::NotFound => "check the path; a scene's paths are relative to the scene file",
        _ => "check the file's permissions",
    };
    Error::new(format!("cannot read the file: {e}")).help(help)
}

/// The whole file in memory.
pub(super) fn contents_of(path: &Path) -> Result<Vec<u8>> {
    std::fs::read(path).map_err(|e| cannot_read(&e))
}
