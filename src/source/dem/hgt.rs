//! SRTM tiles (`.hgt`): a degree by a degree, its place in its name.
//!
//! Big-endian int16 from the north-west, 1201, 3601 or 7201 posts a side, or 1801 from west to east and 3601 from north to south
//! (two arc seconds by one, as tiles near the poles have it); the outer posts stand on the degree lines (neighbours share
//! them); -32768 is a void. Source: USGS, "SRTM Topography", section 3.0.

use super::failure::unreadable;
use super::frame::{Frame, PostRange};
use super::geo_keys::CrsHint;
use super::grid::{GridFile, Header, RowSink};
use super::nodata::{Nodata, Precision};
use super::site::Input;
use crate::error::{Error, Result};
use glam::DVec2;
use std::io::{Read, Seek, SeekFrom};
use std::path::Path;

const VOID: i16 = -32768;

/// An SRTM tile.
pub(super) struct Hgt {
    file: Input,
    header: Header,
    nodata: Nodata,
}

impl Hgt {
    /// Tells size and place from the file's length and name.
    pub(super) fn open(file: Input, path: &Path, more_nodata: [Option<f64>; 2]) -> Result<Self> {
        let length = file.length()?;
        let (columns, rows) = size_of(length)?;
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        let (lon, lat) = south_west(&name).ok_or_else(|| unnamed(&name))?;
        let frame = Frame::new(
            (columns, rows),
            DVec2::new(lon, lat + 1.0),
            (DVec2::new(1.0 / (columns as f64 - 1.0), 0.0), DVec2::new(0.0, -1.0 / (rows as f64 - 1.0))),
        )?;
        let header = Header {
            format: "SRTM tile",
            sample: "int16".into(),
            compression: "none".into(),
            layout: "rows".into(),
            nodata: Some(VOID.to_string()),
            frame,
            is_placed: true,
            crs_hint: Some(CrsHint::Epsg(4326)),
            unit: None,
            scaling: None,
            notes: Vec::new(),
        };
        let [beside, user] = more_nodata;
        let nodata = Nodata::new([Some(VOID.into()), beside, user], Precision::Whole);
        Ok(Self { file, header, nodata })
    }
}

impl GridFile for Hgt {
    fn header(&self) -> &Header {
        &self.header
    }

    fn check_promise(&mut self, _part: &PostRange) -> Result<()> {
        Ok(())
    }

    fn scan(&mut self, part: &PostRange, sink: &mut dyn RowSink) -> Result<()> {
        let mut bytes = vec![0; part.columns * 2];
        let mut heights = vec![0.0; part.columns];
        for row in part.row..part.row + part.rows {
            let start = (row * self.header.frame.columns + part.column) * 2;
            self.file
                .seek(SeekFrom::Start(start as u64))
                .and_then(|_| self.file.read_exact(&mut bytes))
                .map_err(unreadable)?;
            for (height, pair) in heights.iter_mut().zip(bytes.as_chunks().0) {
                *height = self.nodata.height(i16::from_be_bytes(*pair).into());
            }
            sink.take(row, part.column, &heights);
        }
        Ok(())
    }
}

/// Columns and rows of tiles.
const SIZES: [(usize, usize); 4] = [(1201, 1201), (3601, 3601), (1801, 3601), (7201, 7201)];

/// The columns and rows of a tile of so many bytes.
fn size_of(length: u64) -> Result<(usize, usize)> {
    let found = SIZES.into_iter().find(|(columns, rows)| 2 * columns * rows == length as usize);
    found.ok_or_else(|| {
        let known = SIZES.map(|(columns, rows)| format!("{} ({columns} x {rows} posts)", 2 * columns * rows));
        Error::new(format!("the file has {length} bytes; an SRTM tile has {}", known.join(", ")))
            .help("fetch it again, or convert other tiles with: gdal_translate FILE OUT.tif")
    })
}

/// The longitude and latitude of the south-west corner, from a name like `N43E006` or `S34W070.SRTMGL1`.
fn south_west(name: &str) -> Option<(f64, f64)> {
    let tile = name.get(..7)?;
    let lat = signed(tile.get(..3)?, 'N', 'S')?;
    let lon = signed(tile.get(3..)?, 'E', 'W')?;
    ((-90..90).contains(&lat) && (-180..180).contains(&lon)).then_some((f64::from(lon), f64::from(lat)))
}

fn signed(text: &str, plus: char, minus: char) -> Option<i32> {
    let letter = text.chars().next()?.to_ascii_uppercase();
    let digits = text.get(1..)?;
    if !digits.bytes().all(|b| b.is_ascii_digit()) {
        return None;
    }
    let value: i32 = digits.parse().ok()?;
    match letter {
        l if l == plus => Some(value),
        l if l == minus => Some(-value),
        _ => None,
    }
}

fn unnamed(name: &str) -> Error {
    Error::new(format!("the name `{name}` does not say where the tile lies"))
        .help("name an SRTM tile after its south-west corner, like N43E006.hgt")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tile_is_named_after_its_south_west_corner() {
        assert_eq!(south_west("N43E006"), Some((6.0, 43.0)));
        assert_eq!(south_west("s34w070.SRTMGL1"), Some((-70.0, -34.0)));
        for wrong in ["", "43N006E", "N43", "N43E06", "N95E006", "N43E180", "N+3E006", "N4é006x"] {
            assert_eq!(south_west(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn only_the_known_lengths_are_tiles() {
        assert_eq!(size_of(2_884_802).unwrap(), (1201, 1201));
        assert_eq!(size_of(25_934_402).unwrap(), (3601, 3601));
        assert_eq!(size_of(12_970_802).unwrap(), (1801, 3601));
        assert!(size_of(2_884_801).is_err());
        assert!(size_of(0).is_err());
    }
}
