//! Esri shapefiles: *ESRI Shapefile Technical Description*, July 1998.
//!
//! Read here and not by the `shapefile` crate, which allocates by the counts that a damaged record claims. Every
//! count is held against the bytes of its record, every record against the file. Where records lie is told by `records`. The
//! .dbf is read where a column is wanted; records whose row it marks as deleted are left out.

mod records;

use super::attributes::Attributes;
use super::bytes::{Cursor, Endian, beside};
use super::collector::Collector;
use super::dbf::{self, Rows};
use super::rings::members_by_turn;
use crate::crs::Crs;
use crate::error::{Error, Result};
use crate::space::Plan;
use records::{Records, damaged};
use std::path::Path;

/// The contents of the files that are a shapefile.
#[derive(Debug, Default)]
pub(super) struct Parts {
    pub(super) shp: Vec<u8>,
    pub(super) shx: Option<Vec<u8>>,
    pub(super) dbf: Option<Vec<u8>>,
    pub(super) prj: Option<Vec<u8>>,
    pub(super) cpg: Option<Vec<u8>>,
}

impl Parts {
    /// Those beside a .shp.
    pub(super) fn of(path: &Path) -> Result<Self> {
        Ok(Self {
            shp: super::contents_of(path)?,
            shx: beside(path, "shx", "SHX"),
            dbf: beside(path, "dbf", "DBF"),
            prj: beside(path, "prj", "PRJ"),
            cpg: beside(path, "cpg", "CPG"),
        })
    }
}

/// Reads a shapefile, and of its .dbf what is wanted. `path` names the .shp in errors.
pub(super) fn read(parts: &Parts, path: &Path, mut found: Collector) -> Result<Collector> {
    read_prj(parts.prj.as_deref(), &mut found);
    let table = parts.dbf.as_deref().map(Rows::of).transpose();
    let rows = table.as_ref().ok().and_then(Option::as_ref);
    let mut records = Records::of(&parts.shp, parts.shx.as_deref(), rows.map(|rows| rows.count))?;
    found.notes.append(&mut records.notes);
    let belongs = rows.filter(|rows| rows.count == records.count());
    for (index, content) in records.contents(&parts.shp).enumerate() {
        match belongs.is_some_and(|rows| rows.is_deleted(index)) {
            true => found.leave_out_deleted(),
            false => read_record(Cursor::new(content), &mut found).map_err(|e| e.in_feature(index))?,
        }
        found.next_feature();
    }
    read_table(table, parts.cpg.as_deref(), &mut found)
        .map_err(|e| e.in_file(&path.with_extension("dbf")))?;
    found.finish();
    Ok(found)
}

/// Reads the columns that are wanted. Without the .dbf the shapes can be drawn all the same: where no column is asked for by
/// name, a note says what is wrong with it.
fn read_table(table: Result<Option<Rows<'_>>>, cpg: Option<&[u8]>, found: &mut Collector) -> Result<()> {
    let Err(e) = dbf::read(table, cpg, found) else { return Ok(()) };
    let lost = match (found.attributes.are_read(), found.attributes.are_summed_up()) {
        (true, false) => return Err(e),
        (true, true) => "no attributes",
        (false, _) => "which records are deleted is not known",
    };
    found.attributes = Attributes::default();
    found.notes.push(format!("{lost}: {}", e.what()));
    Ok(())
}

/// The note of a shapefile that comes without a .prj.
pub(in crate::source) const NO_PRJ: &str = "there is no .prj beside the file, so its CRS is not known";

/// A .prj that is missing is a note: the scene can name the CRS.
fn read_prj(prj: Option<&[u8]>, found: &mut Collector) {
    let Some(bytes) = prj else {
        return found.notes.push(NO_PRJ.to_owned());
    };
    let text = String::from_utf8_lossy(bytes);
    match text.trim_matches(['\u{feff}', '\0', ' ', '\r', '\n']) {
        "" => found.notes.push("the .prj beside the file is empty, so its CRS is not known".to_owned()),
        text => found.state_crs(Crs::parse(text), "in the .prj"),
    }
}

fn read_record(mut record: Cursor<'_>, found: &mut Collector) -> Result<()> {
    let kind = record.u32(Endian::Little).ok_or_else(|| damaged("its record is empty"))?;
    match kind {
        0 => found.leave_out_empty(),
        1 | 11 | 21 => {
            let point = record.take(16).and_then(vertex);
            found.add_points(vec![point.ok_or_else(|| damaged("its record is too short for its point"))?])?;
        }
        8 | 18 | 28 => found.add_points(points_of_multipoint(record)?)?,
        3 | 13 | 23 => found.add_line(parts_of_record(record)?)?,
        5 | 15 | 25 => found.add_polygons(members_by_turn(parts_of_record(record)?))?,
        31 => {
            return Err(Error::unsupported("a multipatch is a body, not a shape in the plan")
                .help("export its footprint as polygons"));
        }
        _ => return Err(damaged(&format!("{kind} is no type of shape"))),
    }
    Ok(())
}

fn points_of_multipoint(mut record: Cursor<'_>) -> Result<Vec<Plan>> {
    let count = record.take(32).and_then(|_| record.count(Endian::Little, 16));
    let bytes = count.and_then(|count| record.take(count.checked_mul(16)?));
    let bytes = bytes.ok_or_else(|| damaged("its record is too short for its points"))?;
    Ok(bytes.chunks_exact(16).filter_map(vertex).collect())
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
