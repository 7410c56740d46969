//! The blobs of a file of OpenStreetMap: each packed by itself, one after the other.

use super::protobuf::Fields;
use crate::error::{Error, Result};
use flate2::read::ZlibDecoder;
use std::io::{self, Read, Seek, SeekFrom};

/// The longest header of a blob, by the format.
const LONGEST_HEADER: u64 = 1 << 16;
/// The most bytes of a blob, packed and unpacked, by the format.
const LONGEST_BLOB: u64 = 1 << 25;

/// A file whose blobs are known.
pub(super) struct Blobs<R> {
    input: R,
    /// Those of elements.
    pub(super) data: Vec<Place>,
}

/// Where a blob lies.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    at: u64,
    length: u64,
}

impl<R: Read + Seek> Blobs<R> {
    /// Finds all blobs and refuses files that ask for what is not done here.
    pub(super) fn open(mut input: R) -> Result<Self> {
        let end = input.seek(SeekFrom::End(0)).map_err(unreadable)?;
        let mut blobs = Self { input, data: Vec::new() };
        let mut at = 0;
        let mut has_header = false;
        while at < end {
            let (kind, place) = blobs.head(at, end)?;
            at = place.at + place.length;
            match &kind[..] {
                b"OSMHeader" => {
                    has_header = true;
                    check_features(&blobs.unpacked(place)?)?;
                }
                b"OSMData" => blobs.data.push(place),
                _ => {}
            }
        }
        if has_header { Ok(blobs) } else { Err(damaged("it has no header")) }
    }

    /// What a blob's header says: its kind, and where it is.
    fn head(&mut self, at: u64, end: u64) -> Result<(Vec<u8>, Place)> {
        let cut = || damaged("it ends within the header of a blob");
        let length = self.bytes(at, 4)?.try_into().map_err(|_| cut())?;
        let length = u64::from(u32::from_be_bytes(length));
        if length > LONGEST_HEADER {
            return Err(damaged(&format!("a header of {length} bytes is longer than any")));
        }
        let header = self.bytes(at + 4, length)?;
        let (mut kind, mut size) = (None, None);
        for field in Fields::of(&header) {
            match field.ok_or_else(cut)? {
                (1, value) => kind = value.bytes(),
                (3, value) => size = value.number(),
                _ => {}
            }
        }
        let (kind, size) = kind.zip(size).ok_or_else(|| damaged("a blob has no kind or no size"))?;
        let place = Place { at: at + 4 + length, length: size };
        if size > LONGEST_BLOB || place.at + size > end {
            return Err(damaged(&format!("it ends within a blob of {size} bytes")));
        }
        Ok((kind.to_vec(), place))
    }

    /// So many bytes, fewer than which are an error.
    fn bytes(&mut self, at: u64, count: u64) -> Result<Vec<u8>> {
        let mut bytes = Vec::new();
        self.input.seek(SeekFrom::Start(at)).map_err(unreadable)?;
        (&mut self.input).take(count).read_to_end(&mut bytes).map_err(unreadable)?;
        if bytes.len() as u64 == count { Ok(bytes) } else { Err(damaged("it ends too early")) }
    }

    /// The content of a blob.
    pub(super) fn unpacked(&mut self, Place { at, length }: Place) -> Result<Vec<u8>> {
        let blob = self.bytes(at, length)?;
        for field in Fields::of(&blob) {
            let (number, value) = field.ok_or_else(|| damaged("a blob is cut"))?;
            let Some(bytes) = value.bytes() else { continue };
            let method = match number {
                1 => return Ok(bytes.to_vec()),
                3 => return inflated(bytes),
                4 => "LZMA",
                5 => "bzip2",
                6 => "LZ4",
                7 => "zstd",
                _ => continue,
            };
            return Err(Error::unsupported(format!("its blobs are packed by {method}"))
                .help("pack them by zlib: osmium cat IN.osm.pbf -o OUT.osm.pbf"));
        }
        Err(damaged("a blob has no content"))
    }
}

fn inflated(bytes: &[u8]) -> Result<Vec<u8>> {
    let mut content = Vec::new();
    let read = ZlibDecoder::new(bytes).take(LONGEST_BLOB + 1).read_to_end(&mut content);
    read.map_err(|e| damaged(&format!("a blob cannot be unpacked: {e}")).caused_by(e))?;
    if content.len() as u64 > LONGEST_BLOB {
        return Err(damaged("a blob unpacks to more bytes than the format allows"));
    }
    Ok(content)
}

/// Refuses a file that needs what is not done here.
fn check_features(header: &[u8]) -> Result<()> {
    for field in Fields::of(header) {
        let (number, value) = field.ok_or_else(|| damaged("its header is cut"))?;
        let Some(feature) = value.bytes().filter(|_| number == 4) else { continue };
        if feature != b"OsmSchema-V0.6" && feature != b"DenseNodes" {
            let name: String = String::from_utf8_lossy(feature).chars().take(40).collect();
            return Err(Error::unsupported(format!("the file asks its reader for '{name}'"))
                .help("write a plain extract of one moment: osmium time-filter, or osmium cat"));
        }
    }
    Ok(())
}

fn unreadable(error: io::Error) -> Error {
    Error::io("the file cannot be read", error)
}

/// The refusal of a damaged file.
pub(super) fn damaged(why: &str) -> Error {
    Error::new(format!("the OpenStreetMap file is damaged: {why}")).help("fetch it again")
}
