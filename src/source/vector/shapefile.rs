//! Esri shapefiles: *ESRI Shapefile Technical Description*, July 1998.
//!
//! Read here and not by the `shapefile` crate, which allocates by the counts that a damaged record claims. Every
//! count is held against the bytes of its record, every record against the file. Records are read one after the other,
//! so the .shx index is not needed; where there is one that points elsewhere, a note says from which feature on, since
//! programs that follow it see other features or none. The .dbf is not read.

use super::bytes::{Cursor, Endian, contents_of};
use super::collector::Collector;
use crate::crs::Crs;
use crate::error::{Error, Result};
use crate::space::Plan;
use std::path::Path;

const HEADER_BYTES: usize = 100;

/// Reads a shapefile and the .prj beside it.
pub(super) fn read(path: &Path) -> Result<Collector> {
    let bytes = contents_of(path)?;
    let mut found = Collector::default();
    read_prj(path, &mut found);
    let records = records_of(&bytes, &mut found)?;
    let mut cursor = Cursor::new(records);
    let mut places = Vec::new();
    while cursor.left() > 0 {
        let index = found.current();
        let start = HEADER_BYTES + records.len() - cursor.left();
        let record = next_record(&mut cursor).map_err(|e| e.in_feature(index))?;
        places.push((start, record.left()));
        read_record(record, &mut found).map_err(|e| e.in_feature(index))?;
        found.next_feature();
    }
    note_index_that_points_elsewhere(path, &places, &mut found);
    found.finish();
    Ok(found)
}

/// Compare the .shx, where there is one, with where the records begin and how long they are.
fn note_index_that_points_elsewhere(path: &Path, places: &[(usize, usize)], found: &mut Collector) {
    let index = beside(path, "shx", "SHX");
    let Some(entries) = index.as_deref().and_then(|bytes| bytes.get(HEADER_BYTES..)) else {
        return;
    };
    let place = |entry: &[u8]| {
        let mut cursor = Cursor::new(entry);
        let mut bytes = || cursor.u32(Endian::Big).and_then(|words| (words as usize).checked_mul(2));
        Some((bytes()?, bytes()?))
    };
    let listed: Vec<_> = entries.chunks_exact(8).map(place).collect();
    let differ = |(place, listed): (&(usize, usize), &Option<_>)| Some(*place) != *listed;
    let first_wrong = places.iter().zip(&listed).position(differ);
    let shorter = if places.len() < listed.len() { places.len() } else { listed.len() };
    if first_wrong.is_some() || places.len() != listed.len() {
        found.notes.push(format!(
            "the .shx index is damaged: it lists {} features, points elsewhere from feature {} on, and is not used; the \
             .shp itself holds {} whole ones",
            listed.len(),
            first_wrong.unwrap_or(shorter),
            places.len()
        ));
    }
}

/// The contents of a file beside the .shp, by one of two spellings of its extension.
fn beside(path: &Path, extension: &str, capitals: &str) -> Option<Vec<u8>> {
    let read = |extension: &str| std::fs::read(path.with_extension(extension)).ok();
    read(extension).or_else(|| read(capitals))
}

/// A .prj that is missing or not understood is a note: the scene can name the CRS.
fn read_prj(path: &Path, found: &mut Collector) {
    let Some(bytes) = beside(path, "prj", "PRJ") else {
        return found.notes.push("there is no .prj beside the file, so its CRS is not known".to_owned());
    };
    match Crs::parse(&String::from_utf8_lossy(&bytes)) {
        Ok(crs) => found.crs = Some(crs),
        Err(e) => found.notes.push(format!("the CRS in the .prj is not understood: {}", e.what())),
    }
}

/// The bytes after the header, as far as the header says that the file reaches.
fn records_of<'a>(bytes: &'a [u8], found: &mut Collector) -> Result<&'a [u8]> {
    let header = bytes.get(..HEADER_BYTES).and_then(|header| {
        let mut at_length = Cursor::new(header.get(24..)?);
        let words = at_length.u32(Endian::Big)? as usize;
        let version = at_length.u32(Endian::Little)?;
        Some((words.checked_mul(2)?, version))
    });
    let (length, version) = header.ok_or_else(|| damaged("the file ends within its header"))?;
    if version != 1000 || length < HEADER_BYTES {
        return Err(damaged("the header is not one of a shapefile"));
    }
    if length < bytes.len() {
        let extra = bytes.len() - length;
        found.notes.push(format!("{extra} bytes after the end that the header states are not read"));
    }
    // A file shorter than its header says is read to its end, where the record that is cut off has a number.
    if length > bytes.len() && bytes.len() == HEADER_BYTES {
        return Err(damaged("the file ends after its header"));
    }
    let end = if length < bytes.len() { length } else { bytes.len() };
    let records = &bytes[HEADER_BYTES..end];
    if length > bytes.len() {
        ends_within_a_record(records, length - bytes.len())?;
    }
    Ok(records)
}

/// A file that is cut exactly between two records would else look whole.
fn ends_within_a_record(records: &[u8], missing: usize) -> Result<()> {
    let mut cursor = Cursor::new(records);
    let mut index = 0;
    while cursor.left() > 0 && next_record(&mut cursor).is_ok() {
        index += 1;
    }
    Err(damaged(&format!("the file ends here, {missing} bytes before the end that its header states"))
        .in_feature(index))
}

fn damaged(why: &str) -> Error {
    Error::new(format!("the shapefile is damaged: {why}"))
        .help("write it again from its source, or repair it with a GIS")
}

/// The content of the next record: its header is a number, from 1, and a length in 16-bit words.
fn next_record<'a>(cursor: &mut Cursor<'a>) -> Result<Cursor<'a>> {
    let mut content = || {
        let _number = cursor.u32(Endian::Big)?;
        let bytes = (cursor.u32(Endian::Big)? as usize).checked_mul(2)?;
        cursor.take(bytes)
    };
    content().map(Cursor::new).ok_or_else(|| damaged("its record reaches past the end of the file"))
}

fn read_record(mut record: Cursor<'_>, found: &mut Collector) -> Result<()> {
    let kind = record.u32(Endian::Little).ok_or_else(|| damaged("its record is empty"))?;
    match kind {
        0 => found.leave_out_empty(),
        1 | 11 | 21 => found.leave_out_points(1),
        8 | 18 | 28 => found.leave_out_points(points_of_multipoint(record)?),
        3 | 13 | 23 => found.add_line(parts_of_record(record)?)?,
        5 | 15 | 25 => found.add_polygon(parts_of_record(record)?)?,
        31 => {
            return Err(Error::new("a multipatch is a body, not a shape in the plan")
                .help("export its footprint as polygons"));
        }
        _ => return Err(damaged(&format!("{kind} is no type of shape"))),
    }
    Ok(())
}

fn points_of_multipoint(mut record: Cursor<'_>) -> Result<usize> {
    let count = record.take(32).and_then(|_| record.count(Endian::Little, 16));
    count.ok_or_else(|| damaged("its record is too short for its points"))
}

/// Box, number of parts, number of points, first point of each part, points; heights and measures after them are
/// left out.
fn parts_of_record(mut record: Cursor<'_>) -> Result<Vec<Vec<Plan>>> {
    let length = record.left();
    let counts = record.take(32).and_then(|_| {
        let parts = record.u32(Endian::Little)? as usize;
        Some((parts, record.u32(Endian::Little)? as usize))
    });
    let (parts, points) = counts.ok_or_else(|| damaged("its record is too short for its counts"))?;
    let slices = parts
        .checked_mul(4)
        .and_then(|n| record.take(n))
        .zip(points.checked_mul(16).and_then(|n| record.take(n)));
    let (starts, vertices) = slices.ok_or_else(|| {
        damaged(&format!("its record of {} bytes cannot hold {parts} parts and {points} points", length + 4))
    })?;
    split(Cursor::new(starts), vertices, points)
}

fn split(mut starts: Cursor<'_>, vertices: &[u8], points: usize) -> Result<Vec<Vec<Plan>>> {
    let mut bounds = Vec::with_capacity(starts.left() / 4 + 1);
    while let Some(start) = starts.u32(Endian::Little) {
        bounds.push(start as usize);
    }
    bounds.push(points);
    let orderly = bounds.is_sorted() && bounds.first() == Some(&0);
    if !orderly && points > 0 {
        return Err(damaged("its parts do not begin in order within its points"));
    }
    let part = |ends: &[usize]| {
        let bytes = vertices.get(ends[0] * 16..ends[1] * 16)?;
        Some(bytes.chunks_exact(16).filter_map(vertex).collect())
    };
    bounds
        .windows(2)
        .map(|ends| part(ends).ok_or_else(|| damaged("its parts reach past its points")))
        .collect()
}

fn vertex(bytes: &[u8]) -> Option<Plan> {
    let mut cursor = Cursor::new(bytes);
    Some(Plan::new(cursor.f64(Endian::Little)?, cursor.f64(Endian::Little)?))
}
