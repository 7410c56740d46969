//! FlatGeobuf 3: a header, a spatial index (skipped) and features, each a size-prefixed flatbuffer.
//!
//! The flatbuffers are verified by the `flatgeobuf` crate's generated code; the walk over the file is ours, so that
//! every size is held against the file's length before it is believed.

use super::bytes::{Cursor, Endian, contents_of};
use super::collector::Collector;
use crate::crs::Crs;
use crate::error::{Error, Result};
use crate::space::Plan;
use ::flatgeobuf::{
    Geometry, GeometryType, Header, size_prefixed_root_as_feature, size_prefixed_root_as_header,
};
use std::path::Path;

const DEEPEST: usize = 16;
const INDEX_NODE_BYTES: u64 = 40;

/// Reads a FlatGeobuf file.
pub(super) fn read(path: &Path) -> Result<Collector> {
    let bytes = contents_of(path)?;
    let mut found = Collector::default();
    let mut cursor = Cursor::new(&bytes);
    check_magic(&mut cursor)?;
    let header_bytes = sized(&mut cursor).ok_or_else(|| damaged("it ends within its header"))?;
    let header =
        size_prefixed_root_as_header(header_bytes).map_err(|e| damaged(&format!("its header: {e}")))?;
    found.crs = crs_of(&header, &mut found.notes);
    skip_index(&mut cursor, &header)?;
    read_features(cursor, &header, &mut found)?;
    found.finish();
    Ok(found)
}

fn damaged(why: &str) -> Error {
    Error::new(format!("the FlatGeobuf is damaged: {why}")).help("write it again from its source")
}

fn check_magic(cursor: &mut Cursor<'_>) -> Result<()> {
    match cursor.take(8) {
        Some([b'f', b'g', b'b', 3, b'f', b'g', b'b', _]) => Ok(()),
        Some([b'f', b'g', b'b', version, ..]) => {
            Err(Error::new(format!("version {version} of FlatGeobuf is not supported"))
                .help("write it as version 3"))
        }
        _ => Err(damaged("it does not begin as one")),
    }
}

/// The next flatbuffer with its size before it.
fn sized<'a>(cursor: &mut Cursor<'a>) -> Option<&'a [u8]> {
    let mut ahead = *cursor;
    let size = ahead.u32(Endian::Little)? as usize;
    // Fewer bytes than these cannot be decoded at all.
    (size >= 8).then(|| cursor.take(size.checked_add(4)?)).flatten()
}

fn crs_of(header: &Header<'_>, notes: &mut Vec<String>) -> Option<Crs> {
    let crs = header.crs()?;
    let by_code = u32::try_from(crs.code())
        .ok()
        .filter(|code| *code > 0 && crs.org().is_none_or(|org| org.eq_ignore_ascii_case("EPSG")))
        .map(Crs::from_epsg);
    let by_text = || crs.wkt().or(crs.code_string()).or(crs.name()).map(Crs::parse);
    match by_code.filter(Result::is_ok).or_else(by_text)? {
        Ok(crs) => Some(crs),
        Err(e) => {
            notes.push(format!("the CRS in the header is not understood: {}", e.what()));
            None
        }
    }
}

/// Skip the packed R-tree: levels of nodes, each `node_size` times smaller than the one below, down to one.
fn skip_index(cursor: &mut Cursor<'_>, header: &Header<'_>) -> Result<()> {
    let (count, node_size) = (header.features_count(), u64::from(header.index_node_size()));
    if count == 0 || node_size == 0 {
        return Ok(());
    }
    if node_size == 1 || count > cursor.left() as u64 / INDEX_NODE_BYTES {
        return Err(damaged(&format!("its index of {count} features is longer than the file")));
    }
    let (mut level, mut nodes) = (count, count);
    while level > 1 {
        level = level.div_ceil(node_size);
        nodes += level;
    }
    // An index over a single feature still has its root.
    let nodes = if count == 1 { 2 } else { nodes };
    let bytes = usize::try_from(nodes * INDEX_NODE_BYTES).ok();
    bytes.and_then(|n| cursor.take(n)).map(|_| ()).ok_or_else(|| damaged("it ends within its index"))
}

fn read_features(mut cursor: Cursor<'_>, header: &Header<'_>, found: &mut Collector) -> Result<()> {
    while cursor.left() > 0 {
        let index = found.current();
        let bytes =
            sized(&mut cursor).ok_or_else(|| damaged("it ends within this feature").in_feature(index))?;
        let feature =
            size_prefixed_root_as_feature(bytes).map_err(|e| damaged(&e.to_string()).in_feature(index))?;
        match feature.geometry() {
            Some(geometry) => {
                add(&geometry, header.geometry_type(), found, 0).map_err(|e| e.in_feature(index))?
            }
            None => found.leave_out_empty(),
        }
        found.next_feature();
    }
    let (stated, seen) = (header.features_count(), found.seen as u64);
    if stated != 0 && stated != seen {
        return Err(damaged(&format!("its header states {stated} features but it holds {seen}")));
    }
    Ok(())
}

fn add(geometry: &Geometry<'_>, stated: GeometryType, found: &mut Collector, depth: usize) -> Result<()> {
    if depth > DEEPEST {
        return Err(damaged("its collections are nested too deep"));
    }
    let kind = if stated == GeometryType::Unknown { geometry.type_() } else { stated };
    match kind {
        GeometryType::Point | GeometryType::MultiPoint => {
            found.leave_out_points(geometry.xy().map_or(0, |xy| xy.len() / 2));
        }
        GeometryType::LineString | GeometryType::MultiLineString => found.add_line(paths(geometry)?)?,
        GeometryType::Polygon => found.add_polygon(paths(geometry)?)?,
        GeometryType::MultiPolygon => found.add_polygon(rings_of_parts(geometry)?)?,
        GeometryType::GeometryCollection => {
            for part in geometry.parts().iter().flatten() {
                add(&part, GeometryType::Unknown, found, depth + 1)?;
            }
        }
        other => {
            let name = other.variant_name().unwrap_or("unknown");
            return Err(Error::new(format!("geometries of type {name} are not supported"))
                .help("convert curves and surfaces to lines and polygons"));
        }
    }
    Ok(())
}

/// A multi-polygon keeps its polygons as parts; writers may also put a single one flat.
fn rings_of_parts(geometry: &Geometry<'_>) -> Result<Vec<Vec<Plan>>> {
    let mut rings = Vec::new();
    match geometry.parts() {
        Some(parts) => {
            for part in parts {
                rings.append(&mut paths(&part)?);
            }
        }
        None => rings = paths(geometry)?,
    }
    Ok(rings)
}

/// The coordinates, cut at the ends (counted in vertices) where there are any.
fn paths(geometry: &Geometry<'_>) -> Result<Vec<Vec<Plan>>> {
    let Some(xy) = geometry.xy() else {
        return Ok(Vec::new());
    };
    let count = xy.len() / 2;
    let mut ends: Vec<usize> = geometry.ends().iter().flatten().map(|end| end as usize).collect();
    if ends.is_empty() {
        ends.push(count);
    }
    if !ends.is_sorted() || ends.last() != Some(&count) || xy.len() % 2 != 0 {
        return Err(damaged("its parts do not end in order within its coordinates"));
    }
    let mut start = 0;
    let mut cut = |end: usize| {
        let part = (start..end).map(|i| Plan::new(xy.get(2 * i), xy.get(2 * i + 1))).collect();
        start = end;
        part
    };
    Ok(ends.into_iter().map(&mut cut).collect())
}
