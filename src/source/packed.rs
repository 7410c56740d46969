//! Files that are packed, and must be unpacked to be read.

use crate::error::{Error, Result};

/// Refuses a file that is packed as a whole, by what it begins with.
pub(super) fn refuse(magic: &[u8]) -> Result<()> {
    let (kind, tool) = match magic {
        [b'P', b'K', 3 | 5, ..] => ("a zip archive in another", "unzip"),
        [0x1f, 0x8b, ..] => ("packed with gzip", "gunzip -k"),
        [0xfd, b'7', b'z', b'X', b'Z', ..] => ("packed with xz", "xz -dk"),
        [b'B', b'Z', b'h', ..] => ("packed with bzip2", "bunzip2 -k"),
        _ => return Ok(()),
    };
    Err(Error::unsupported(format!("the file is {kind}")).help(format!("unpack it first: {tool} FILE")))
}
