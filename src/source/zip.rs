//! Zip archives: what lies in one, and one file of it unpacked into memory.
//!
//! Source: PKWARE, "APPNOTE.TXT" 6.3.10, sections 4.3 and 4.5.3. Stored and deflated files, Zip64's sizes included. The directory
//! is believed about names alone: what it says of places and sizes is held against the archive's own length, no file grows beyond
//! what the caller allows, and its length and checksum must be those that it promises.

use crate::error::{Error, Result};
use flate2::Crc;
use flate2::bufread::DeflateDecoder;
use std::io::{self, BufReader, Read, Seek, SeekFrom};

/// The most bytes of a directory that are read: some hundred thousand files.
const LONGEST_DIRECTORY: u64 = 1 << 24;

/// A byte of deflate stands for at most 1032.
const LARGEST_EXPANSION: u64 = 1032;

/// An archive whose directory has been read.
pub(in crate::source) struct Archive<R> {
    input: BufReader<R>,
    length: u64,
    entries: Vec<Entry>,
}

/// A file in an archive.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(in crate::source) struct Entry {
    /// Its path, with `/` between folders.
    pub(in crate::source) name: String,
    /// Its length when unpacked, as the archive says.
    pub(in crate::source) size: u64,
    packed: u64,
    at: u64,
    method: u16,
    flags: u16,
    checksum: u32,
}

impl<R: Read + Seek> Archive<R> {
    /// Reads the directory of an archive.
    ///
    /// # Errors
    /// When there is none, or it leaves the archive.
    pub(in crate::source) fn open(input: R) -> Result<Self> {
        let mut input = BufReader::new(input);
        let length = input.seek(SeekFrom::End(0)).map_err(unreadable)?;
        let (at, size) = directory_place(&mut input, length)?;
        if at.checked_add(size).is_none_or(|end| end > length) {
            return Err(damaged("its directory lies outside it"));
        }
        if size > LONGEST_DIRECTORY {
            return Err(Error::unsupported(format!("the zip archive's directory has {size} bytes"))
                .help("unpack it first, and name the file that is wanted"));
        }
        let bytes = bytes_at(&mut input, at, size)?;
        Ok(Self { input, length, entries: entries(&bytes)? })
    }

    /// The files in it, in the directory's order; no folders, and none of the copies that macOS adds for its own use.
    pub(in crate::source) fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// The content of a file, of at most `most` bytes.
    ///
    /// # Errors
    /// When it is larger, packed in a way that is not read, locked, or not what its checksum says.
    pub(in crate::source) fn read(&mut self, entry: &Entry, most: u64) -> Result<Vec<u8>> {
        self.unpack(entry, most)
            .map_err(|error| error.reworded(|what| format!("{} in the archive: {what}", entry.name)))
    }

    fn unpack(&mut self, entry: &Entry, most: u64) -> Result<Vec<u8>> {
        if entry.flags & 1 != 0 {
            return Err(Error::unsupported("it is locked by a password").help("unpack it first"));
        }
        if entry.size > most {
            return Err(Error::unsupported(format!(
                "it has {} bytes, more than the {most} that are unpacked into memory",
                entry.size
            ))
            .help("unpack it first, and name the unpacked file"));
        }
        if entry.size > entry.packed.saturating_add(16).saturating_mul(LARGEST_EXPANSION) {
            return Err(damaged(&format!(
                "it promises {} bytes, more than its {} packed ones can stand for",
                entry.size, entry.packed
            )));
        }
        let head = bytes_at(&mut self.input, entry.at, 30)?;
        if !head.starts_with(b"PK\x03\x04") {
            return Err(damaged("it does not begin where the archive says"));
        }
        let start = entry.at + 30 + number(&head, 26, 2) + number(&head, 28, 2);
        if start.checked_add(entry.packed).is_none_or(|end| end > self.length) {
            return Err(damaged("it ends beyond the archive"));
        }
        self.input.seek(SeekFrom::Start(start)).map_err(unreadable)?;
        let packed = (&mut self.input).take(entry.packed);
        let content = match entry.method {
            0 => whole(packed, entry.size),
            8 => whole(DeflateDecoder::new(packed), entry.size),
            method => return Err(unknown_method(method)),
        }?;
        let mut checksum = Crc::new();
        checksum.update(&content);
        if content.len() as u64 != entry.size || checksum.sum() != entry.checksum {
            return Err(damaged("it is not what its length and checksum say"));
        }
        Ok(content)
    }
}

/// All that `input` holds, but at most a byte more than `size`.
fn whole(input: impl Read, size: u64) -> Result<Vec<u8>> {
    let mut content = Vec::new();
    let damaged = |error: io::Error| damaged(&format!("it cannot be unpacked: {error}")).caused_by(error);
    input.take(size + 1).read_to_end(&mut content).map_err(damaged)?;
    Ok(content)
}

fn unknown_method(method: u16) -> Error {
    let name = match method {
        1..=6 => "an old one",
        9 => "deflate64",
        12 => "bzip2",
        14 => "LZMA",
        93 => "zstd",
        95 => "xz",
        _ => "an unknown one",
    };
    Error::unsupported(format!("it is packed by method {method} ({name})"))
        .help("unpack it first, or pack it by deflate")
}

fn damaged(what: &str) -> Error {
    Error::new(format!("the zip archive is damaged: {what}")).help("fetch the archive again")
}

fn unreadable(error: io::Error) -> Error {
    Error::io("the zip archive cannot be read", error)
}

/// The little-endian number of `size` bytes at a place that must be in the slice.
fn number(bytes: &[u8], at: usize, size: usize) -> u64 {
    let digits = bytes.get(at..at + size).unwrap_or_default();
    digits.iter().rev().fold(0, |n, b| n << 8 | u64::from(*b))
}

fn bytes_at<R: Read + Seek>(input: &mut R, at: u64, count: u64) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    input.seek(SeekFrom::Start(at)).map_err(unreadable)?;
    input.take(count).read_to_end(&mut bytes).map_err(unreadable)?;
    if (bytes.len() as u64) < count {
        return Err(damaged("it ends too early"));
    }
    Ok(bytes)
}

/// Where the directory begins, and how long it is.
fn directory_place<R: Read + Seek>(input: &mut R, length: u64) -> Result<(u64, u64)> {
    // The end record has 22 bytes and a comment of up to 65,535.
    let tail_start = length.saturating_sub(22 + 65_535);
    let tail = bytes_at(input, tail_start, length - tail_start)?;
    let found = tail.windows(22).rposition(|w| w.starts_with(b"PK\x05\x06"));
    let end = found.ok_or_else(|| damaged("it has no directory; it may be half a download"))?;
    let (size, at) = (number(&tail, end + 12, 4), number(&tail, end + 16, 4));
    let is_zip64 = at == u64::from(u32::MAX) || size == u64::from(u32::MAX);
    let locator = end.checked_sub(20).filter(|l| is_zip64 && tail[*l..].starts_with(b"PK\x06\x07"));
    let Some(locator) = locator else {
        return Ok((at, size));
    };
    let record = bytes_at(input, number(&tail, locator + 8, 8), 56)?;
    if !record.starts_with(b"PK\x06\x06") {
        return Err(damaged("its directory is not where it says"));
    }
    Ok((number(&record, 48, 8), number(&record, 40, 8)))
}

fn entries(directory: &[u8]) -> Result<Vec<Entry>> {
    let mut entries = Vec::new();
    let mut rest = directory;
    while rest.starts_with(b"PK\x01\x02") {
        let [name, extra, comment] = [28, 30, 32].map(|at| number(rest, at, 2) as usize);
        let end = 46 + name + extra + comment;
        if rest.len() < end {
            return Err(damaged("its directory is cut"));
        }
        let entry = entry(rest, &rest[46..46 + name], &rest[46 + name..46 + name + extra]);
        if !(entry.name.ends_with('/') || entry.name.starts_with("__MACOSX/")) {
            entries.push(entry);
        }
        rest = &rest[end..];
    }
    Ok(entries)
}

fn entry(record: &[u8], name: &[u8], extra: &[u8]) -> Entry {
    let mut large = zip64(extra);
    // What does not fit 32 bits is in the extra field, in this order.
    let mut wide = |at| match number(record, at, 4) {
        n if n == u64::from(u32::MAX) => large.next().unwrap_or(n),
        n => n,
    };
    let (size, packed, at) = (wide(24), wide(20), wide(42));
    Entry {
        name: String::from_utf8_lossy(name).replace('\\', "/"),
        size,
        packed,
        at,
        method: number(record, 10, 2) as u16,
        flags: number(record, 8, 2) as u16,
        checksum: number(record, 16, 4) as u32,
    }
}

/// The 64-bit numbers of an extra field.
fn zip64(mut extra: &[u8]) -> impl Iterator<Item = u64> {
    let mut found: &[u8] = &[];
    while extra.len() >= 4 {
        let length = (number(extra, 2, 2) as usize).min(extra.len() - 4);
        if number(extra, 0, 2) == 1 {
            found = &extra[4..4 + length];
        }
        extra = &extra[4 + length..];
    }
    found.as_chunks().0.iter().map(|b| u64::from_le_bytes(*b))
}

#[cfg(test)]
pub(in crate::source) mod tests {
    use super::*;
    use std::io::{Cursor, Write};

    /// An archive of deflated files.
    pub(in crate::source) fn packed(files: &[(&str, &[u8])]) -> Vec<u8> {
        let (mut out, mut directory) = (Vec::new(), Vec::new());
        for (name, content) in files {
            let mut packer = flate2::write::DeflateEncoder::new(Vec::new(), flate2::Compression::default());
            packer.write_all(content).unwrap();
            let packed = packer.finish().unwrap();
            let mut checksum = Crc::new();
            checksum.update(content);
            let at = out.len() as u32;
            let mut common = vec![20, 0, 0, 0, 8, 0, 0, 0, 0, 0];
            for n in [checksum.sum(), packed.len() as u32, content.len() as u32] {
                common.extend(n.to_le_bytes());
            }
            common.extend((name.len() as u16).to_le_bytes());
            common.extend([0, 0]);
            out.extend(b"PK\x03\x04");
            out.extend(&common);
            out.extend(name.as_bytes());
            out.extend(packed);
            directory.extend(b"PK\x01\x02\x14\0");
            directory.extend(&common);
            directory.extend([0; 10]);
            directory.extend(at.to_le_bytes());
            directory.extend(name.as_bytes());
        }
        let (at, size) = (out.len() as u32, directory.len() as u32);
        out.extend(directory);
        out.extend(b"PK\x05\x06\0\0\0\0");
        out.extend([files.len() as u16, files.len() as u16].iter().flat_map(|n| n.to_le_bytes()));
        out.extend([size, at].iter().flat_map(|n| n.to_le_bytes()));
        out.extend([0, 0]);
        out
    }

    fn open(bytes: Vec<u8>) -> Result<Archive<Cursor<Vec<u8>>>> {
        Archive::open(Cursor::new(bytes))
    }

    #[test]
    fn files_come_back_as_they_were_packed_and_folders_are_none() {
        let long: Vec<u8> = (0..100_000_u32).map(|i| (i.wrapping_mul(i) >> 7) as u8).collect();
        let files: [(&str, &[u8]); 4] =
            [("a/b.txt", b"hello"), ("a/", b""), ("__MACOSX/a/._b.txt", b"x"), ("empty", b"")];
        let mut archive = open(packed(&[&files[..], &[("long", &long)]].concat())).unwrap();
        let entries = archive.entries().to_vec();
        let names: Vec<&str> = entries.iter().map(|e| e.name.as_str()).collect();
        assert_eq!(names, ["a/b.txt", "empty", "long"]);
        assert_eq!(archive.read(&entries[0], 100).unwrap(), b"hello");
        assert_eq!(archive.read(&entries[1], 100).unwrap(), b"");
        assert_eq!(archive.read(&entries[2], 100_000).unwrap(), long);
    }

    #[test]
    fn a_file_larger_than_is_needed_is_not_unpacked() {
        let mut archive = open(packed(&[("zeros", &[0; 100_000])])).unwrap();
        let entry = archive.entries()[0].clone();
        let message = archive.read(&entry, 99_999).unwrap_err().to_string();
        assert!(message.contains("zeros") && message.contains("unpack it first"), "{message}");
        // A directory that lies about the size is found out before more is unpacked.
        let lying = Entry { size: 10, ..entry };
        let message = archive.read(&lying, 99_999).unwrap_err().to_string();
        assert!(message.contains("length and checksum"), "{message}");
    }

    #[test]
    fn a_wrong_checksum_a_lock_and_a_foreign_packing_are_refused() {
        let mut archive = open(packed(&[("a", b"hello")])).unwrap();
        let entry = archive.entries()[0].clone();
        let refusals = [
            (Entry { checksum: 1, ..entry.clone() }, "checksum"),
            (Entry { flags: 1, ..entry.clone() }, "password"),
            (Entry { method: 93, ..entry.clone() }, "zstd"),
            (Entry { at: 3, ..entry.clone() }, "begin"),
            (Entry { packed: 1 << 40, ..entry.clone() }, "beyond"),
            (Entry { at: u64::MAX - 3, ..entry }, "early"),
        ];
        for (entry, expected) in refusals {
            let message = archive.read(&entry, 100).unwrap_err().to_string();
            assert!(message.contains(expected), "{message}");
        }
    }

    #[test]
    fn any_cut_or_changed_archive_returns() {
        let bytes = packed(&[("a/b.txt", b"hello hello hello"), ("c", b"12345")]);
        let try_it = |bytes: &[u8]| {
            let Ok(mut archive) = open(bytes.to_vec()) else { return };
            for entry in archive.entries().to_vec() {
                let _ = archive.read(&entry, 1000);
            }
        };
        for at in 0..bytes.len() {
            try_it(&bytes[..at]);
            for byte in [0, 0xff, 0x80] {
                let mut changed = bytes.clone();
                changed[at] = byte;
                try_it(&changed);
            }
        }
    }

    #[test]
    fn sizes_of_zip64_are_read_from_the_extra_field() {
        let mut record = vec![0; 46];
        record[20..28].fill(0xff);
        record[42..46].fill(0xff);
        let mut extra = vec![7, 0, 2, 0, 9, 9, 1, 0, 24, 0];
        [30_u64, 20, 10].iter().for_each(|n| extra.extend(n.to_le_bytes()));
        let entry = entry(&record, b"a", &extra);
        assert_eq!((entry.size, entry.packed, entry.at), (30, 20, 10));
    }
}
