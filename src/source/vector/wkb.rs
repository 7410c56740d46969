//! Well-known binary of geometries: ISO's (types + 1000, 2000, 3000 for Z, M, ZM) and EWKB's flags.
//!
//! Read here and not by `geozero`, whose reader sizes its buffers by the counts in the data.

use super::bytes::{Cursor, Endian};
use super::collector::Collector;
use crate::error::{Error, Result};
use crate::space::Plan;

const DEEPEST: usize = 16;

/// Adds a geometry to the current feature.
pub(super) fn read(cursor: &mut Cursor<'_>, found: &mut Collector) -> Result<()> {
    geometry(cursor, found, 0)
}

fn damaged(why: &str) -> Error {
    Error::new(format!("the geometry is damaged: {why}"))
        .help("write the file again, or repair the feature with a GIS")
}

fn cut_short() -> Error {
    damaged("it holds fewer coordinates than it counts")
}

/// Byte order, type (1 to 7) and number of ordinates of a coordinate.
struct Head {
    endian: Endian,
    kind: u32,
    ordinates: usize,
}

fn head(cursor: &mut Cursor<'_>) -> Result<Head> {
    let endian = match cursor.u8() {
        Some(0) => Endian::Big,
        Some(1) => Endian::Little,
        _ => return Err(damaged("its byte order is neither 0 nor 1")),
    };
    let code = cursor.u32(endian).ok_or_else(cut_short)?;
    if code & 0x2000_0000 != 0 {
        let _srid = cursor.u32(endian).ok_or_else(cut_short)?;
    }
    let flagged = usize::from(code & 0x8000_0000 != 0) + usize::from(code & 0x4000_0000 != 0);
    let plain = code & 0x0fff_ffff;
    let more = match plain / 1000 {
        0 => flagged,
        1 | 2 => 1,
        3 => 2,
        _ => return Err(damaged(&format!("{code} is no type of geometry"))),
    };
    Ok(Head { endian, kind: plain % 1000, ordinates: 2 + more })
}

fn geometry(cursor: &mut Cursor<'_>, found: &mut Collector, depth: usize) -> Result<()> {
    if depth > DEEPEST {
        return Err(damaged("its collections are nested too deep"));
    }
    let head = head(cursor)?;
    match head.kind {
        1 => {
            let _point = vertices(cursor, &head, 1)?;
            found.leave_out_points(1);
        }
        2 => found.add_line(vec![path(cursor, &head)?])?,
        3 => found.add_polygon(paths(cursor, &head)?)?,
        4 => {
            let count = cursor.count(head.endian, 21).ok_or_else(cut_short)?;
            let _points = members(cursor, count, 1, |cursor, head| vertices(cursor, head, 1))?;
            found.leave_out_points(count);
        }
        5 => {
            let count = cursor.count(head.endian, 9).ok_or_else(cut_short)?;
            found.add_line(members(cursor, count, 2, path)?)?;
        }
        6 => {
            let count = cursor.count(head.endian, 9).ok_or_else(cut_short)?;
            found.add_polygon(members(cursor, count, 3, paths)?.into_iter().flatten().collect())?;
        }
        7 => {
            let count = cursor.count(head.endian, 5).ok_or_else(cut_short)?;
            if count == 0 {
                found.leave_out_empty();
            }
            for _ in 0..count {
                geometry(cursor, found, depth + 1)?;
            }
        }
        kind => {
            return Err(Error::unsupported(format!(
                "geometries of WKB type {kind} (curves, surfaces) are not supported"
            ))
            .help("convert curves to lines and polygons"));
        }
    }
    Ok(())
}

/// The parts of a multi-geometry, each with a head of its own.
fn members<T>(
    cursor: &mut Cursor<'_>,
    count: usize,
    kind: u32,
    read: impl Fn(&mut Cursor<'_>, &Head) -> Result<T>,
) -> Result<Vec<T>> {
    let mut all = Vec::new();
    for _ in 0..count {
        let head = head(cursor)?;
        if head.kind != kind {
            return Err(damaged("a part of it is of another type"));
        }
        all.push(read(cursor, &head)?);
    }
    Ok(all)
}

fn paths(cursor: &mut Cursor<'_>, head: &Head) -> Result<Vec<Vec<Plan>>> {
    let count = cursor.count(head.endian, 4).ok_or_else(cut_short)?;
    (0..count).map(|_| path(cursor, head)).collect()
}

fn path(cursor: &mut Cursor<'_>, head: &Head) -> Result<Vec<Plan>> {
    let count = cursor.count(head.endian, 8 * head.ordinates).ok_or_else(cut_short)?;
    vertices(cursor, head, count)
}

fn vertices(cursor: &mut Cursor<'_>, head: &Head, count: usize) -> Result<Vec<Plan>> {
    let size = 8 * head.ordinates;
    let bytes = count.checked_mul(size).and_then(|n| cursor.take(n)).ok_or_else(cut_short)?;
    let vertex = |bytes: &[u8]| {
        let mut at = Cursor::new(bytes);
        Some(Plan::new(at.f64(head.endian)?, at.f64(head.endian)?))
    };
    Ok(bytes.chunks_exact(size).filter_map(vertex).collect())
}
