//! GeoPackages: SQLite tables of WKB geometries.
//!
//! Opened read-only and immutable, so that nothing is written beside the data.

use super::attributes::Wanted;
use super::bytes::{Cursor, Endian};
use super::collector::Collector;
use super::wkb;
use crate::crs::Crs;
use crate::error::{Error, Result};
use crate::scene::Attribute;
use rusqlite::types::ValueRef;
use rusqlite::{Connection, OpenFlags};
use std::fmt::Write;
use std::path::Path;

/// A table of features.
struct Table {
    name: String,
    geometry: String,
    srs: i64,
}

/// Reads one layer, the only one where none is named, and of its columns what is wanted.
pub(super) fn read(path: &Path, layer: Option<&str>, wanted: Wanted) -> Result<Collector> {
    let connection = open(path)?;
    let tables = tables_of(&connection)?;
    if tables.is_empty() {
        return Err(without_features(&connection, path));
    }
    let table = chosen(&tables, layer)?;
    let mut found = Collector::new(wanted);
    note_unmerged_log(path, &mut found);
    if let Some(read) = crs_of(&connection, table.srs) {
        found.state_crs(read, &format!("{} of the layer", table.srs));
    }
    read_rows(&connection, table, &mut found)?;
    found.finish();
    Ok(found)
}

/// The layers with features, in the order of their names.
pub(super) fn layer_names(path: &Path) -> Result<Vec<String>> {
    let connection = open(path)?;
    let tables = tables_of(&connection)?;
    if tables.is_empty() {
        return Err(without_features(&connection, path));
    }
    Ok(tables.into_iter().map(|table| table.name).collect())
}

fn damaged(e: rusqlite::Error) -> Error {
    Error::new(format!("the GeoPackage cannot be read: {e}"))
        .caused_by(e)
        .help("check that the file was copied whole")
}

fn open(path: &Path) -> Result<Connection> {
    let flags =
        OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_URI | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    let connection = Connection::open_with_flags(immutable_uri(path)?, flags).map_err(damaged)?;
    connection
        .execute_batch(
            "PRAGMA trusted_schema = OFF; PRAGMA cell_size_check = ON; PRAGMA temp_store = MEMORY;",
        )
        .map_err(damaged)?;
    Ok(connection)
}

/// `file:` URI of a path, everything but plain characters escaped.
fn immutable_uri(path: &Path) -> Result<String> {
    let absolute = std::path::absolute(path).map_err(super::cannot_read)?;
    let text = absolute.to_str().ok_or_else(|| {
        Error::new("the path is not valid Unicode, which SQLite needs").help("rename the file")
    })?;
    let mut uri = "file:".to_owned();
    if !text.starts_with('/') {
        uri.push('/');
    }
    for byte in text.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'-' | b'_' | b'.' | b'~' | b':' => {
                uri.push(byte as char)
            }
            b'\\' if cfg!(windows) => uri.push('/'),
            _ => {
                let _ = write!(uri, "%{byte:02X}");
            }
        }
    }
    uri.push_str("?mode=ro&immutable=1");
    Ok(uri)
}

fn note_unmerged_log(path: &Path, found: &mut Collector) {
    let mut log = path.as_os_str().to_owned();
    log.push("-wal");
    if std::fs::metadata(log).is_ok_and(|meta| meta.len() > 0) {
        found.notes.push(
            "a write-ahead log (-wal) lies beside the file: changes that are only there are not read"
                .to_owned(),
        );
    }
}

fn tables_of(connection: &Connection) -> Result<Vec<Table>> {
    let sql = "SELECT g.table_name, g.column_name, g.srs_id FROM gpkg_geometry_columns g \
               JOIN gpkg_contents c ON c.table_name = g.table_name WHERE c.data_type = 'features' \
               ORDER BY g.table_name";
    let mut statement = connection.prepare(sql).map_err(|e| {
        damaged(e).help("a GeoPackage has the tables gpkg_contents and gpkg_geometry_columns; this may be another kind of SQLite file")
    })?;
    let table =
        |row: &rusqlite::Row<'_>| Ok(Table { name: row.get(0)?, geometry: row.get(1)?, srs: row.get(2)? });
    let rows = statement.query_map([], table).map_err(damaged)?;
    rows.collect::<rusqlite::Result<_>>().map_err(damaged)
}

/// What there is in a GeoPackage without features.
fn without_features(connection: &Connection, path: &Path) -> Error {
    let named = |sql: &str, what: &str| {
        let rows = connection.prepare(sql).and_then(|mut statement| {
            statement.query_map([], |row| row.get::<_, String>(0))?.collect::<rusqlite::Result<Vec<_>>>()
        });
        let names: Vec<String> = rows.unwrap_or_default().iter().map(|name| format!("`{name}`")).collect();
        let more = if names.len() > MOST_NAMES { ", ..." } else { "" };
        let told = names.iter().take(MOST_NAMES).cloned().collect::<Vec<_>>().join(", ");
        (!names.is_empty()).then(|| format!("{what} {told}{more}"))
    };
    let tiles = "SELECT table_name FROM gpkg_contents WHERE data_type LIKE '%tile%' OR data_type LIKE '%coverage%' ORDER BY table_name";
    let tables = "SELECT table_name FROM gpkg_contents WHERE data_type = 'attributes' ORDER BY table_name";
    let (tiles, tables) =
        (named(tiles, "tiles (pictures or heights)"), named(tables, "tables without shapes"));
    let help = match tiles.is_some() {
        true => format!("make a GeoTIFF of tiles: gdal_translate {} OUT.tif", path.display()),
        false => "name a GeoPackage with a layer of polygons or lines".to_owned(),
    };
    let held: Vec<String> = tables.into_iter().chain(tiles).collect();
    let held = if held.is_empty() { String::new() } else { format!("; it holds {}", held.join(" and ")) };
    Error::new(format!("the GeoPackage has no layer of features{held}")).help(help)
}

/// The most tables that an error names.
const MOST_NAMES: usize = 8;

fn chosen<'a>(tables: &'a [Table], layer: Option<&str>) -> Result<&'a Table> {
    let names: Vec<String> = tables.iter().map(|t| format!("'{}'", t.name)).collect();
    let listed = format!("its layers are {}", names.join(", "));
    match (tables, layer) {
        ([only], None) => Ok(only),
        (_, None) => Err(Error::new("the GeoPackage has several layers and none is named")
            .help(format!("name one as layer; {listed}"))),
        (_, Some(wanted)) => tables
            .iter()
            .find(|t| t.name == wanted)
            .ok_or_else(|| Error::new(format!("the GeoPackage has no layer '{wanted}'")).help(listed)),
    }
}

/// The CRS of a spatial reference id; -1 and 0 mean none by the standard.
fn crs_of(connection: &Connection, srs: i64) -> Option<Result<Crs>> {
    if srs <= 0 {
        return None;
    }
    let sql = "SELECT organization, organization_coordsys_id, definition FROM gpkg_spatial_ref_sys WHERE srs_id = ?1";
    let row = |row: &rusqlite::Row<'_>| {
        Ok((row.get::<_, String>(0)?, row.get::<_, i64>(1)?, row.get::<_, String>(2)?))
    };
    match connection.query_row(sql, [srs], row) {
        // Some writers give a number of their own to what is in no system.
        Ok((_, _, definition)) if definition.to_ascii_lowercase().contains("\"undefined srs") => None,
        Ok((organization, id, definition)) => Some(crs_of_row(&organization, id, &definition)),
        Err(e) => Some(Err(damaged(e))),
    }
}

fn crs_of_row(organization: &str, id: i64, definition: &str) -> Result<Crs> {
    let code = u32::try_from(id).ok().filter(|_| organization.eq_ignore_ascii_case("EPSG"));
    match code.map(Crs::from_epsg) {
        Some(Ok(crs)) => Ok(crs),
        _ => Crs::parse(definition),
    }
}

fn quoted(name: &str) -> String {
    format!("\"{}\"", name.replace('"', "\"\""))
}

/// A column of attributes.
struct Field {
    name: String,
    /// Its number among the attributes.
    slot: usize,
    is_flag: bool,
}

fn read_rows(connection: &Connection, table: &Table, found: &mut Collector) -> Result<()> {
    let order =
        primary_key(connection, table)?.map_or_else(String::new, |key| format!(" ORDER BY {}", quoted(&key)));
    let fields = if found.attributes.are_read() { fields(connection, table, found)? } else { Vec::new() };
    let names: String = fields.iter().map(|field| format!(", {}", quoted(&field.name))).collect();
    let sql = format!("SELECT {}{names} FROM {}{order}", quoted(&table.geometry), quoted(&table.name));
    let mut statement = connection.prepare(&sql).map_err(damaged)?;
    let mut rows = statement.query([]).map_err(damaged)?;
    loop {
        let index = found.current();
        let Some(row) = rows.next().map_err(|e| damaged(e).in_feature(index))? else {
            return Ok(());
        };
        read_row(row, &fields, found).map_err(|e| e.in_feature(index))?;
        found.next_feature();
    }
}

fn read_row(row: &rusqlite::Row<'_>, fields: &[Field], found: &mut Collector) -> Result<()> {
    read_geometry(row.get_ref(0).map_err(damaged)?, found)?;
    for (at, field) in fields.iter().enumerate() {
        let stored = row.get_ref(at + 1).map_err(damaged)?;
        read_value(stored, field, found)?;
    }
    Ok(())
}

/// The columns beside the geometry whose values are wanted.
fn fields(connection: &Connection, table: &Table, found: &mut Collector) -> Result<Vec<Field>> {
    let sql = "SELECT name, type FROM pragma_table_info(?1) ORDER BY cid";
    let mut statement = connection.prepare(sql).map_err(damaged)?;
    let column = |row: &rusqlite::Row<'_>| Ok((row.get::<_, String>(0)?, row.get::<_, String>(1)?));
    let columns = statement.query_map([&table.name], column).map_err(damaged)?;
    let mut fields = Vec::new();
    for column in columns {
        let (name, kind) = column.map_err(damaged)?;
        if name.eq_ignore_ascii_case(&table.geometry) {
            continue;
        }
        let slot = found.attributes.column(&name);
        if found.attributes.reads(slot) {
            fields.push(Field { name, slot, is_flag: kind.eq_ignore_ascii_case("BOOLEAN") });
        }
    }
    Ok(fields)
}

fn read_value(stored: ValueRef<'_>, field: &Field, found: &mut Collector) -> Result<()> {
    let feature = found.current();
    let attributes = &mut found.attributes;
    let value = match stored {
        ValueRef::Null => Attribute::Null,
        ValueRef::Integer(number @ (0 | 1)) if field.is_flag => Attribute::Boolean(number == 1),
        ValueRef::Integer(number) => Attribute::Integer(number),
        ValueRef::Real(number) => Attribute::of_number(number),
        ValueRef::Text(bytes) => match std::str::from_utf8(bytes) {
            Ok(text) => Attribute::Text(text.to_owned()),
            Err(_) => return Err(attributes.error(field.slot, "holds a text that is not UTF-8")),
        },
        ValueRef::Blob(_) => return attributes.put_unread(field.slot, "holds a blob, which is not read"),
    };
    attributes.put(field.slot, feature, value);
    Ok(())
}

/// The primary key's column; views have none and keep the order of their query.
fn primary_key(connection: &Connection, table: &Table) -> Result<Option<String>> {
    let sql = "SELECT name FROM pragma_table_info(?1) WHERE pk = 1";
    match connection.query_row(sql, [&table.name], |row| row.get(0)) {
        Ok(name) => Ok(Some(name)),
        Err(rusqlite::Error::QueryReturnedNoRows) => Ok(None),
        Err(e) => Err(damaged(e)),
    }
}

fn read_geometry(value: ValueRef<'_>, found: &mut Collector) -> Result<()> {
    match value {
        ValueRef::Null => {
            found.leave_out_empty();
            Ok(())
        }
        ValueRef::Blob(blob) => {
            let mut cursor = wkb_of_blob(blob).ok_or_else(|| {
                Error::new("the geometry does not begin with a GeoPackage header")
                    .help("write the file again")
            })?;
            wkb::read(&mut cursor, found)
        }
        _ => Err(Error::new("the geometry column holds something else").help("write the file again")),
    }
}

/// Skip the header: 'GP', version, flags, srs_id, and an envelope of a size told by the flags.
fn wkb_of_blob(blob: &[u8]) -> Option<Cursor<'_>> {
    let mut cursor = Cursor::new(blob);
    let [b'G', b'P', _version, flags] = cursor.take(4)? else {
        return None;
    };
    let _srs = cursor.u32(Endian::Little)?;
    let envelope = match (flags >> 1) & 7 {
        0 => 0,
        1 => 32,
        2 | 3 => 48,
        4 => 64,
        _ => return None,
    };
    cursor.take(envelope)?;
    Some(cursor)
}
