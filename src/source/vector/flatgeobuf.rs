//! FlatGeobuf 3: a header, a spatial index (skipped) and features, each a size-prefixed flatbuffer.
//!
//! The flatbuffers are verified by the `flatgeobuf` crate's generated code; the walk over the file is ours, so that
//! every size is held against the file's length before it is believed.

use super::bytes::{Cursor, Endian};
use super::collector::Collector;
use super::curve::{append_piece, refusal_of_curves};
use crate::crs::Crs;
use crate::error::{Error, Result};
use crate::scene::Attribute;
use crate::space::Plan;
use ::flatgeobuf::{
    Column, ColumnType, Feature, Geometry, GeometryType, Header, size_prefixed_root_as_feature,
    size_prefixed_root_as_header,
};

const DEEPEST: usize = 16;
const INDEX_NODE_BYTES: u64 = 40;

/// Reads a FlatGeobuf file, and of its columns what is wanted.
pub(super) fn read(bytes: &[u8], mut found: Collector) -> Result<Collector> {
    let mut cursor = Cursor::new(bytes);
    check_magic(&mut cursor)?;
    let header_bytes = sized(&mut cursor).ok_or_else(|| damaged("it ends within its header"))?;
    let header = size_prefixed_root_as_header(header_bytes)
        .map_err(|e| damaged(&format!("its header: {e}")).caused_by(e))?;
    if let Some(read) = crs_of(&header) {
        found.state_crs(read, "in the header");
    }
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
            Err(Error::unsupported(format!("version {version} of FlatGeobuf is not supported"))
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

fn crs_of(header: &Header<'_>) -> Option<Result<Crs>> {
    let crs = header.crs()?;
    let by_code = u32::try_from(crs.code())
        .ok()
        .filter(|code| *code > 0 && crs.org().is_none_or(|org| org.eq_ignore_ascii_case("EPSG")))
        .map(Crs::from_epsg);
    let text = [crs.wkt(), crs.code_string(), crs.name()].into_iter().flatten().find(|text| !text.is_empty());
    let by_text = text.map(Crs::parse);
    match by_code {
        Some(Err(_)) if matches!(by_text, Some(Ok(_))) => by_text,
        Some(by_code) => Some(by_code),
        None => by_text,
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
    let of_all = fields(header.columns().iter().flatten(), found);
    let stated = header.geometry_type();
    let mut others = 0;
    while cursor.left() > 0 {
        let index = found.current();
        let bytes =
            sized(&mut cursor).ok_or_else(|| damaged("it ends within this feature").in_feature(index))?;
        let feature = size_prefixed_root_as_feature(bytes)
            .map_err(|e| damaged(&e.to_string()).caused_by(e).in_feature(index))?;
        match feature.geometry() {
            Some(geometry) => {
                others +=
                    usize::from(stated != GeometryType::Unknown && kind_of(&geometry, stated) != stated);
                add(&geometry, stated, found, 0).map_err(|e| e.in_feature(index))?;
            }
            None => found.leave_out_empty(),
        }
        read_properties(&feature, &of_all, found).map_err(|e| e.in_feature(index))?;
        found.next_feature();
    }
    let (count, seen) = (header.features_count(), found.seen as u64);
    if count != 0 && count != seen {
        return Err(damaged(&format!("its header states {count} features but it holds {seen}")));
    }
    if others > 0 {
        found.notes.push(format!(
            "{others} of {seen} features are of another type than the header says ({}): read as what they are",
            stated.variant_name().unwrap_or("unknown")
        ));
    }
    Ok(())
}

/// A column of attributes: its number among those of the file, and the type of its values.
struct Field {
    column: usize,
    kind: ColumnType,
}

/// The columns of the header, or of a feature that has its own.
fn fields<'a>(columns: impl Iterator<Item = Column<'a>>, found: &mut Collector) -> Vec<Field> {
    if !found.attributes.are_read() {
        return Vec::new();
    }
    let field =
        |column: Column<'a>| Field { column: found.attributes.column(column.name()), kind: column.type_() };
    columns.map(field).collect()
}

/// The values of the current feature: each is the number of a field and what its type says.
fn read_properties(feature: &Feature<'_>, of_all: &[Field], found: &mut Collector) -> Result<()> {
    let Some(properties) = feature.properties().filter(|_| found.attributes.are_read()) else {
        return Ok(());
    };
    let own = feature.columns().map(|own| fields(own.iter(), found)).filter(|own| !own.is_empty());
    let fields = own.as_deref().unwrap_or(of_all);
    let index = found.current();
    let mut cursor = Cursor::new(properties.bytes());
    // Some writers leave a byte behind the last value.
    while cursor.left() > 1 {
        let number = cursor.u16(Endian::Little).map(usize::from);
        let field = number
            .and_then(|number| fields.get(number))
            .ok_or_else(|| damaged("its values name a column that there is not"))?;
        match value(&mut cursor, field.kind) {
            Ok(Some(value)) => found.attributes.put(field.column, index, value),
            Ok(None) => found.attributes.put_unread(field.column, "holds bytes, which are not read")?,
            Err(what) => return Err(found.attributes.error(field.column, what)),
        }
    }
    Ok(())
}

/// The next value; `None` for bytes.
fn value(cursor: &mut Cursor<'_>, kind: ColumnType) -> std::result::Result<Option<Attribute>, &'static str> {
    let cut_short = "holds a value that is longer than all of the feature's";
    let whole = |bytes: &[u8], is_signed| Attribute::Integer(little_endian(bytes, is_signed));
    let mut take = |count| cursor.take(count).ok_or(cut_short);
    let value = match kind {
        ColumnType::Bool => Attribute::Boolean(take(1)?[0] != 0),
        ColumnType::Byte => whole(take(1)?, true),
        ColumnType::UByte => whole(take(1)?, false),
        ColumnType::Short => whole(take(2)?, true),
        ColumnType::UShort => whole(take(2)?, false),
        ColumnType::Int => whole(take(4)?, true),
        ColumnType::UInt => whole(take(4)?, false),
        ColumnType::Long => whole(take(8)?, true),
        ColumnType::ULong => unsigned(cursor.u64(Endian::Little).ok_or(cut_short)?),
        ColumnType::Float => Attribute::of_number(cursor.f32(Endian::Little).ok_or(cut_short)?.into()),
        ColumnType::Double => Attribute::of_number(cursor.f64(Endian::Little).ok_or(cut_short)?),
        ColumnType::String | ColumnType::Json | ColumnType::DateTime => {
            let bytes = cursor.count(Endian::Little, 1).and_then(|count| cursor.take(count));
            let text = std::str::from_utf8(bytes.ok_or(cut_short)?);
            Attribute::Text(text.map_err(|_| "holds a text that is not UTF-8")?.to_owned())
        }
        ColumnType::Binary => {
            let bytes = cursor.count(Endian::Little, 1).and_then(|count| cursor.take(count));
            return bytes.map(|_| None).ok_or(cut_short);
        }
        _ => return Err("is of a type that is not known"),
    };
    Ok(Some(value))
}

/// A whole number of at most 8 bytes.
fn little_endian(bytes: &[u8], is_signed: bool) -> i64 {
    let fill = if is_signed && bytes.last().is_some_and(|high| *high > 127) { -1 } else { 0 };
    bytes.iter().rev().fold(fill, |number, byte| (number << 8) | i64::from(*byte))
}

/// A whole number that may be too large for a signed one.
fn unsigned(number: u64) -> Attribute {
    i64::try_from(number).map_or(Attribute::Number(number as f64), Attribute::Integer)
}

/// The type of a feature's geometry: its own, where it says one, else the header's.
fn kind_of(geometry: &Geometry<'_>, stated: GeometryType) -> GeometryType {
    let own = geometry.type_();
    if own == GeometryType::Unknown { stated } else { own }
}

fn add(geometry: &Geometry<'_>, stated: GeometryType, found: &mut Collector, depth: usize) -> Result<()> {
    if depth > DEEPEST {
        return Err(damaged("its collections are nested too deep"));
    }
    match kind_of(geometry, stated) {
        GeometryType::Point | GeometryType::MultiPoint => {
            found.add_points(paths(geometry)?.concat())?;
        }
        GeometryType::LineString | GeometryType::MultiLineString => found.add_line(paths(geometry)?)?,
        GeometryType::Polygon | GeometryType::Triangle => found.add_polygon(paths(geometry)?)?,
        GeometryType::MultiPolygon | GeometryType::MultiSurface => found.add_polygons(members(geometry)?)?,
        GeometryType::MultiCurve => found.add_line(straight_parts(geometry)?)?,
        GeometryType::CompoundCurve => found.add_line(vec![straight(geometry)?])?,
        GeometryType::CurvePolygon => found.add_polygon(straight_parts(geometry)?)?,
        GeometryType::GeometryCollection => {
            for part in geometry.parts().iter().flatten() {
                add(&part, GeometryType::Unknown, found, depth + 1)?;
            }
        }
        other => return Err(no_plain_type(other)),
    }
    Ok(())
}

fn no_plain_type(kind: GeometryType) -> Error {
    refusal_of_curves(&format!("geometries of type {}", kind.variant_name().unwrap_or("unknown")))
}

/// The straight pieces of a curve, one after the other: a line, or a compound curve of such.
fn straight(geometry: &Geometry<'_>) -> Result<Vec<Plan>> {
    match kind_of(geometry, GeometryType::LineString) {
        GeometryType::LineString => Ok(paths(geometry)?.concat()),
        GeometryType::CompoundCurve => {
            let mut line = Vec::new();
            for piece in geometry.parts().iter().flatten() {
                let kind = kind_of(&piece, GeometryType::LineString);
                if kind != GeometryType::LineString {
                    return Err(no_plain_type(kind));
                }
                append_piece(&mut line, paths(&piece)?.concat());
            }
            Ok(line)
        }
        other => Err(no_plain_type(other)),
    }
}

/// The parts of a geometry, each a curve that is straight.
fn straight_parts(geometry: &Geometry<'_>) -> Result<Vec<Vec<Plan>>> {
    geometry.parts().iter().flatten().map(|part| straight(&part)).collect()
}

/// A multi-polygon keeps its polygons as parts; writers may also put a single one flat.
fn members(geometry: &Geometry<'_>) -> Result<Vec<Vec<Vec<Plan>>>> {
    let Some(parts) = geometry.parts().filter(|parts| !parts.is_empty()) else {
        return Ok(vec![paths(geometry)?]);
    };
    let member = |part: Geometry<'_>| match kind_of(&part, GeometryType::Polygon) {
        // Some writers give the parts the type of the whole.
        GeometryType::Polygon | GeometryType::MultiPolygon | GeometryType::Triangle => paths(&part),
        GeometryType::CurvePolygon => straight_parts(&part),
        other => Err(no_plain_type(other)),
    };
    parts.iter().map(member).collect()
}

/// The coordinates, cut at the ends (counted in vertices) where there are any.
fn paths(geometry: &Geometry<'_>) -> Result<Vec<Vec<Plan>>> {
    let Some(xy) = geometry.xy() else {
        return match geometry.parts().is_some_and(|parts| !parts.is_empty()) {
            true => Err(damaged("it has parts, which its type has not")),
            false => Ok(Vec::new()),
        };
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
