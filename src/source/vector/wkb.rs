//! Well-known binary of geometries: ISO's (types + 1000, 2000, 3000 for Z, M, ZM) and EWKB's flags.
//!
//! Read here and not by `geozero`, whose reader sizes its buffers by the counts in the data.

use super::bytes::{Cursor, Endian};
use super::collector::Collector;
use super::curve::{append_piece, refusal_of_curves};
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
            // A point without coordinates has NaN for them.
            let point = vertices(cursor, &head, 1)?;
            found.add_points(point.into_iter().filter(|p| !(p.x.is_nan() && p.y.is_nan())).collect())?;
        }
        2 => found.add_line(vec![path(cursor, &head)?])?,
        3 => found.add_polygon(paths(cursor, &head)?)?,
        4 => {
            let count = cursor.count(head.endian, 21).ok_or_else(cut_short)?;
            found.add_points(
                members(cursor, count, POINTS, |cursor, head| vertices(cursor, head, 1))?.concat(),
            )?;
        }
        5 | 11 => {
            let count = cursor.count(head.endian, 9).ok_or_else(cut_short)?;
            let kinds = if head.kind == 5 { LINES } else { CURVES };
            found.add_line(members(cursor, count, kinds, curve)?)?;
        }
        6 | 12 => {
            let count = cursor.count(head.endian, 9).ok_or_else(cut_short)?;
            let kinds = if head.kind == 6 { POLYGONS } else { SURFACES };
            found.add_polygons(members(cursor, count, kinds, surface)?)?;
        }
        9 => found.add_line(vec![curve(cursor, &head)?])?,
        10 | 17 => found.add_polygon(surface(cursor, &head)?)?,
        7 => {
            let count = cursor.count(head.endian, 5).ok_or_else(cut_short)?;
            if count == 0 {
                found.leave_out_empty();
            }
            for _ in 0..count {
                geometry(cursor, found, depth + 1)?;
            }
        }
        kind => return Err(no_plain_type(kind)),
    }
    Ok(())
}

/// A type by its name, refused.
fn no_plain_type(kind: u32) -> Error {
    let name = match kind {
        8 => "CircularString",
        13 => "Curve",
        14 => "Surface",
        15 => "PolyhedralSurface",
        16 => "TIN",
        _ => "unknown",
    };
    refusal_of_curves(&format!("geometries of WKB type {kind} ({name})"))
}

/// The types that members of multi-geometries may have.
const POINTS: &[u32] = &[1];
const LINES: &[u32] = &[2];
const POLYGONS: &[u32] = &[3];
/// Those that may be straight.
const CURVES: &[u32] = &[2, 9];
const SURFACES: &[u32] = &[3, 10];
/// Those that never are.
const ARCS: &[u32] = &[8, 13, 14, 15, 16];

/// A line, or a compound curve of lines alone.
fn curve(cursor: &mut Cursor<'_>, head: &Head) -> Result<Vec<Plan>> {
    if head.kind == 2 {
        return path(cursor, head);
    }
    let count = cursor.count(head.endian, 9).ok_or_else(cut_short)?;
    let mut line = Vec::new();
    for piece in members(cursor, count, LINES, path)? {
        append_piece(&mut line, piece);
    }
    Ok(line)
}

/// A polygon or a triangle, or a curve polygon whose rings are straight.
fn surface(cursor: &mut Cursor<'_>, head: &Head) -> Result<Vec<Vec<Plan>>> {
    if head.kind != 10 {
        return paths(cursor, head);
    }
    let count = cursor.count(head.endian, 9).ok_or_else(cut_short)?;
    members(cursor, count, CURVES, curve)
}

/// The parts of a multi-geometry, each with a head of its own.
fn members<T>(
    cursor: &mut Cursor<'_>,
    count: usize,
    kinds: &[u32],
    read: impl Fn(&mut Cursor<'_>, &Head) -> Result<T>,
) -> Result<Vec<T>> {
    let mut all = Vec::new();
    for _ in 0..count {
        let head = head(cursor)?;
        match kinds.contains(&head.kind) {
            true => {}
            false if ARCS.contains(&head.kind) => return Err(no_plain_type(head.kind)),
            false => return Err(damaged("a part of it is of another type")),
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
