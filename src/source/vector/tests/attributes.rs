//! Attributes: what is read of them, and what is refused.

use super::*;
use crate::scene::Attribute;
use ::flatgeobuf::{ColumnType, FgbWriter};
use geozero::{ColumnValue, PropertyProcessor};

fn names(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

fn text(text: &str) -> Attribute {
    Attribute::Text(text.into())
}

/// The values of one column of a file.
fn column(path: &Path, name: &str) -> Vec<Attribute> {
    let read = read_columns(path, None, &names(&[name])).unwrap_or_else(|e| panic!("{name}: {e}"));
    assert_eq!(read.columns.len(), 1, "{name}");
    read.columns[0].values.clone()
}

fn column_refused(path: &Path, name: &str) -> String {
    read_columns(path, None, &names(&[name])).expect_err(name).to_string()
}

const MIXED: &str = r#"{"type":"FeatureCollection","properties":{"a":9},"features":[
 {"type":"Feature","properties":{"a":1,"b":"x","c":[1,{"z":2,"y":null}],"a":2},"geometry":null},
 {"type":"Feature","geometry":{"type":"GeometryCollection","geometries":[
   {"type":"LineString","coordinates":[[0,0],[1,1]]},{"type":"Polygon","coordinates":[[[0,0],[1,1],[0,1],[0,0]]]}]},"properties":{"a":"2","d":1e300}},
 {"type":"Feature","properties":[],"geometry":{"type":"LineString","coordinates":[[0,0],[1,1]]}},
 {"type":"Feature","properties":null,"geometry":null},
 {"type":"Feature","properties":{"a":2.5,"b":true,"d":18446744073709551615,"":null},"geometry":null}
]}"#;

#[test]
fn geojson_properties_are_values_of_any_mixture_by_the_features_number() {
    let (_folder, path) = file("a.geojson", MIXED.as_bytes());
    let a = [Attribute::Integer(2), text("2"), Attribute::Null, Attribute::Null, Attribute::Number(2.5)];
    assert_eq!(column(&path, "a"), a);
    let flag = Attribute::Boolean(true);
    assert_eq!(column(&path, "b"), [text("x"), Attribute::Null, Attribute::Null, Attribute::Null, flag]);
    assert_eq!(column(&path, "c"), [text(r#"[1,{"y":null,"z":2}]"#)]);
    let d = column(&path, "d");
    assert_eq!(
        &d[1..],
        [
            Attribute::Number(1e300),
            Attribute::Null,
            Attribute::Null,
            Attribute::Number(1.844_674_407_370_955_2e19)
        ]
    );
    let read = read_columns(&path, None, &names(&["d", "no"])).unwrap();
    assert_eq!(read.column_names, ["a", "b", "c", "d", ""]);
    assert_eq!(read.columns.iter().map(|c| c.name.as_str()).collect::<Vec<_>>(), ["d"]);
    let members: Vec<&Attribute> = read.features.iter().map(|f| read.columns[0].value(f.index)).collect();
    assert_eq!(members, [&Attribute::Number(1e300), &Attribute::Number(1e300), &Attribute::Null]);
}

#[test]
fn attributes_that_nobody_asks_for_are_not_looked_at() {
    let (_folder, path) = file("a.geojson", MIXED.replace("null,\"properties\":[]", "3").as_bytes());
    let read = super::super::read(&path, None).unwrap();
    assert!(read.columns.is_empty() && read.column_names.is_empty());
    let odd = MIXED.replace("\"properties\":[]", "\"properties\":3");
    let (_folder, path) = file("a.geojson", odd.as_bytes());
    assert_eq!(super::super::read(&path, None).unwrap().features.len(), 3);
    let refused = column_refused(&path, "a");
    assert!(refused.contains("a.geojson:5:") && refused.contains("feature 2"), "{refused}");
}

#[test]
fn a_single_feature_has_its_properties_too() {
    let line = r#""geometry":{"type":"LineString","coordinates":[[0,0],[1,1]]}"#;
    let (_folder, path) =
        file("a.json", format!(r#"{{"properties":{{"a":1}},"type":"Feature",{line}}}"#).as_bytes());
    assert_eq!(column(&path, "a"), [Attribute::Integer(1)]);
    let (_folder, path) = file("a.json", format!(r#"{{"type":"Feature","properties":7,{line}}}"#).as_bytes());
    assert!(column_refused(&path, "a").contains("a.json:1:"));
}

/// A field of a dBASE table: name, type, length, decimals.
pub(super) type Field<'a> = (&'a str, u8, u8, u8);

/// A dBASE table; rows are without the mark of deleted ones.
pub(super) fn dbf(driver: u8, fields: &[Field<'_>], rows: &[&[u8]]) -> Vec<u8> {
    let width = 1 + fields.iter().map(|f| usize::from(f.2)).sum::<usize>();
    let mut out = vec![0; 32];
    out[0] = 3;
    out[4..8].copy_from_slice(&(rows.len() as u32).to_le_bytes());
    out[8..10].copy_from_slice(&((33 + 32 * fields.len()) as u16).to_le_bytes());
    out[10..12].copy_from_slice(&(width as u16).to_le_bytes());
    out[29] = driver;
    for (name, kind, length, decimals) in fields {
        let mut field = [0; 32];
        field[..name.len()].copy_from_slice(name.as_bytes());
        (field[11], field[16], field[17]) = (*kind, *length, *decimals);
        out.extend(field);
    }
    out.push(0x0d);
    for row in rows {
        assert_eq!(row.len() + 1, width, "{row:?}");
        out.push(b' ');
        out.extend(*row);
    }
    out
}

/// A shapefile of so many squares with a table beside it, and a .cpg where one is given.
fn shapefile(count: usize, table: &[u8], cpg: Option<&str>) -> (tempfile::TempDir, PathBuf) {
    let (folder, path) = file("a.shp", &shp(5, &vec![shp_parts(5, &[&SQUARE]); count]));
    std::fs::write(path.with_extension("dbf"), table).unwrap();
    if let Some(cpg) = cpg {
        std::fs::write(path.with_extension("cpg"), cpg).unwrap();
    }
    (folder, path)
}

#[test]
fn every_type_of_a_dbf_becomes_its_value() {
    let days = 2_461_072_i32.to_le_bytes();
    let time = 45_296_789_i32.to_le_bytes();
    let cases: [(Field<'_>, &[u8], Attribute); 23] = [
        (("C", b'C', 6, 0), b" ab  \0", text(" ab")),
        (("C0", b'C', 4, 0), b"    ", Attribute::Null),
        (("N", b'N', 5, 0), b"  -12", Attribute::Integer(-12)),
        (("N2", b'N', 6, 2), b"  2.50", Attribute::Number(2.5)),
        (("N3", b'N', 19, 0), b"9223372036854775807", Attribute::Integer(i64::MAX)),
        (("N4", b'N', 20, 0), b" 9223372036854775808", Attribute::Number(9_223_372_036_854_775_808.0)),
        (("N5", b'N', 7, 0), b"1.5e+02", Attribute::Number(150.0)),
        (("N6", b'N', 4, 0), b"****", Attribute::Null),
        (("N7", b'N', 4, 2), b"    ", Attribute::Null),
        (("N8", b'N', 2, 0), b"\0\0", Attribute::Null),
        (("F", b'F', 4, 1), b"-0.5", Attribute::Number(-0.5)),
        (("F2", b'F', 4, 1), b" nan", Attribute::Null),
        (("L", b'L', 1, 0), b"T", Attribute::Boolean(true)),
        (("L2", b'L', 1, 0), b"n", Attribute::Boolean(false)),
        (("L3", b'L', 1, 0), b"?", Attribute::Null),
        (("D", b'D', 8, 0), b"20260131", text("2026-01-31")),
        (("D2", b'D', 8, 0), b"00000000", Attribute::Null),
        (("D3", b'D', 8, 0), b"        ", Attribute::Null),
        (("I", b'I', 4, 0), b"\xfe\xff\xff\xff", Attribute::Integer(-2)),
        (("B", b'B', 8, 0), &2.5_f64.to_le_bytes(), Attribute::Number(2.5)),
        (("O", b'O', 8, 0), &f64::NAN.to_le_bytes(), Attribute::Null),
        (("T", b'T', 8, 0), &[days, time].concat(), text("2026-01-31T12:34:56")),
        (("T2", b'@', 8, 0), &[0; 8], Attribute::Null),
    ];
    let fields: Vec<Field<'_>> = cases.iter().map(|(field, ..)| *field).collect();
    let row: Vec<u8> = cases.iter().flat_map(|(_, bytes, _)| bytes.iter().copied()).collect();
    let (_folder, path) = shapefile(1, &dbf(0, &fields, &[&row]), None);
    for ((name, ..), _, value) in cases {
        let read = column(&path, name);
        assert!(read == [value.clone()] || (read.is_empty() && value.is_null()), "{name}: {read:?}");
        assert_eq!(
            matches!(read.first(), Some(Attribute::Integer(_))),
            matches!(value, Attribute::Integer(_)),
            "{name}"
        );
    }
}

#[test]
fn values_that_are_not_what_their_column_says_are_refused_by_file_feature_and_column() {
    let cases: [(Field<'_>, &[u8], &[u8], &str); 8] = [
        (("A", b'N', 2, 0), b" 1", b"1x", "holds \"1x\", which is no number"),
        (("A", b'F', 2, 0), b" 1", b"1\xff", "holds \"1\\xff\", which is no number"),
        (("A", b'L', 1, 0), b"T", b"x", "holds \"x\", which is neither true nor false"),
        (("A", b'D', 8, 0), b"20260131", b"2026-1-1", "holds \"2026-1-1\", which is no date"),
        (("A", b'T', 8, 0), &[0; 8], &[1, 0, 0, 0, 255, 255, 255, 255], "which is no time"),
        (("A", b'C', 3, 0), b"a  ", b"\xe9a ", "holds \"\\xe9a\", which is no text in the table's code page"),
        (("A", b'M', 2, 0), b"  ", b"  ", "is of type M, which is not read"),
        (("A", b'B', 10, 0), &[0; 10], &[0; 10], "is of type B, which is not read"),
    ];
    for (field, good, bad, said) in cases {
        let (_folder, path) = shapefile(2, &dbf(0, &[field], &[good, bad]), Some("UTF-8"));
        let refused = column_refused(&path, "A");
        let feature = if said.contains("type") { "feature 0" } else { "feature 1" };
        for part in ["a.dbf: ", feature, "the column `A`", said, "help: "] {
            assert!(refused.contains(part), "{refused}");
        }
        assert!(super::super::read(&path, None).is_ok(), "the shapes are drawn all the same");
    }
}

#[test]
fn a_deleted_row_of_a_dbf_keeps_its_place_and_has_no_values() {
    let mut table = dbf(0, &[("A", b'N', 1, 0)], &[b"1", b"x", b"3"]);
    let second = table.len() - 4;
    table[second] = b'*';
    let (_folder, path) = shapefile(3, &table, None);
    assert_eq!(column(&path, "A"), [Attribute::Integer(1), Attribute::Null, Attribute::Integer(3)]);
    let notes = read_columns(&path, None, &names(&["A"])).unwrap().notes;
    assert!(notes.iter().any(|n| n == "1 feature left out, marked as deleted in the .dbf"), "{notes:?}");
}

#[test]
fn a_table_that_does_not_go_with_its_shapes_is_refused() {
    let table = dbf(0, &[("A", b'N', 1, 0)], &[b"1", b"2"]);
    let (_folder, path) = shapefile(3, &table, None);
    let refused = column_refused(&path, "A");
    assert!(refused.contains("a.dbf: ") && refused.contains("2 rows and the .shp 3 features"), "{refused}");
    assert!(describe(&path).unwrap()[0].notes.iter().any(|n| n.starts_with("no attributes: ")), "{refused}");
    std::fs::remove_file(path.with_extension("dbf")).unwrap();
    assert!(column_refused(&path, "A").contains("there is no .dbf beside"));
    std::fs::write(path.with_extension("DBF"), dbf(0, &[("A", b'N', 1, 0)], &[b"1", b"2", b"3"])).unwrap();
    assert_eq!(column(&path, "A").len(), 3);
    let mut seventh = table.clone();
    seventh[0] = 0x8c;
    std::fs::write(path.with_extension("dbf"), seventh).unwrap();
    assert!(column_refused(&path, "A").contains("dBASE 7"));
}

#[test]
fn texts_of_a_dbf_are_in_the_code_page_of_the_cpg_else_of_the_driver_else_guessed() {
    let read = |driver: u8, cpg: Option<&str>, bytes: &[u8], more: &[u8]| {
        let pad = |bytes: &[u8]| [bytes, &[b' '; 8][bytes.len()..]].concat();
        let table =
            dbf(driver, &[("A", b'C', 8, 0), ("B", b'C', 8, 0)], &[&[pad(bytes), pad(more)].concat()]);
        let (_folder, path) = shapefile(1, &table, cpg);
        column(&path, "A").remove(0)
    };
    assert_eq!(read(0x57, Some("UTF-8"), "é".as_bytes(), b""), text("é"));
    assert_eq!(read(0x01, Some("ISO-8859-1"), b"\xe9", b""), text("é"));
    assert_eq!(read(0x01, None, b"\x82", b""), text("é"));
    assert_eq!(read(0x01, Some("klingon"), b"\x82", b""), text("é"));
    assert_eq!(read(0, None, "é".as_bytes(), b""), text("é"));
    assert_eq!(read(0, None, b"\xe9", b""), text("é"));
    assert_eq!(read(0, None, "é".as_bytes(), b"\xe9 "), text("Ã©"), "one table has one code page");
    assert_eq!(read(0, None, b"1234567\xc3", b""), text("1234567"), "the field's end cuts a character");
}

#[test]
fn a_dbf_of_which_anything_is_missing_is_refused() {
    let whole = dbf(0, &[("A", b'N', 2, 0), ("B", b'C', 2, 0)], &[b" 1ab", b" 2cd"]);
    for cut in 0..whole.len() {
        let (_folder, path) = shapefile(2, &whole[..cut], None);
        let refused = column_refused(&path, "A");
        assert!(refused.contains("a.dbf: "), "{refused}");
    }
    for (at, bytes) in [(4, &[255; 4][..]), (8, &[255; 2]), (10, &[0; 2]), (10, &[3, 0]), (32 + 16, &[255])] {
        let mut bad = whole.clone();
        bad[at..at + bytes.len()].copy_from_slice(bytes);
        let (_folder, path) = shapefile(2, &bad, None);
        assert!(column_refused(&path, "A").contains("a.dbf: "));
    }
}

/// A GeoPackage with one table of squares, its columns declared and filled as told.
#[cfg(feature = "gpkg")]
fn gpkg_with(columns: &str, rows: &[&str]) -> (tempfile::TempDir, PathBuf) {
    let (folder, path) = file("a.gpkg", &gpkg(&["t"], &wkb_polygon()));
    let db = rusqlite::Connection::open(&path).unwrap();
    let fill: String = rows.iter().map(|row| format!("INSERT INTO t SELECT {row}, geom FROM one;")).collect();
    db.execute_batch(&format!(
        "CREATE TABLE one AS SELECT geom FROM t; DROP TABLE t; CREATE TABLE t ({columns}, Geom BLOB); {fill}"
    ))
    .unwrap();
    drop(db);
    (folder, path)
}

#[cfg(feature = "gpkg")]
#[test]
fn geopackage_columns_have_sqlites_types() {
    let (_folder, path) = gpkg_with(
        "fid INTEGER PRIMARY KEY, name TEXT, \"odd \"\" name\" REAL, flag BOOLEAN, raw BLOB",
        &["7, 'é', 2.5, 1, x'00'", "8, NULL, 'text', 0, NULL", "9, 3, -1e999, 2, 'z'"],
    );
    assert_eq!(column(&path, "fid"), [7, 8, 9].map(Attribute::Integer));
    assert_eq!(column(&path, "name"), [text("é"), Attribute::Null, text("3")]);
    assert_eq!(
        column(&path, "odd \" name"),
        [Attribute::Number(2.5), text("text"), Attribute::Number(f64::NEG_INFINITY)]
    );
    assert_eq!(
        column(&path, "flag"),
        [Attribute::Boolean(true), Attribute::Boolean(false), Attribute::Integer(2)]
    );
    let refused = column_refused(&path, "raw");
    assert!(refused.contains("feature 0: the column `raw` holds a blob"), "{refused}");
    let read = read_columns(&path, None, &names(&["no"])).unwrap();
    assert_eq!(read.column_names, ["fid", "name", "odd \" name", "flag", "raw"]);
    let (_folder, path) = gpkg_with("a TEXT", &["'a'", "CAST(x'ff' AS TEXT)"]);
    let refused = column_refused(&path, "a");
    assert!(refused.contains("feature 1: the column `a` holds a text that is not UTF-8"), "{refused}");
}

/// A FlatGeobuf of lines with one value of each type, then one feature without values.
fn typed_fgb() -> Vec<u8> {
    let columns = [
        ("byte", ColumnType::Byte, ColumnValue::Byte(-3)),
        ("ubyte", ColumnType::UByte, ColumnValue::UByte(200)),
        ("bool", ColumnType::Bool, ColumnValue::Bool(true)),
        ("short", ColumnType::Short, ColumnValue::Short(-300)),
        ("ushort", ColumnType::UShort, ColumnValue::UShort(60000)),
        ("int", ColumnType::Int, ColumnValue::Int(-70000)),
        ("uint", ColumnType::UInt, ColumnValue::UInt(4_000_000_000)),
        ("long", ColumnType::Long, ColumnValue::Long(-5_000_000_000)),
        ("ulong", ColumnType::ULong, ColumnValue::ULong(u64::MAX)),
        ("float", ColumnType::Float, ColumnValue::Float(0.5)),
        ("double", ColumnType::Double, ColumnValue::Double(f64::NAN)),
        ("string", ColumnType::String, ColumnValue::String("é")),
        ("json", ColumnType::Json, ColumnValue::Json("[1]")),
        ("time", ColumnType::DateTime, ColumnValue::DateTime("2026-01-31T00:00:00Z")),
        ("raw", ColumnType::Binary, ColumnValue::Binary(b"abc")),
    ];
    let mut writer = FgbWriter::create("made", ::flatgeobuf::GeometryType::Polygon).unwrap();
    for (name, kind, _) in &columns {
        writer.add_column(name, *kind, |_, _| {});
    }
    let polygon = || geozero::wkb::Wkb(wkb_polygon()[8..].to_vec());
    let fill = |feature: &mut dyn PropertyProcessor| {
        for (at, (name, _, value)) in columns.iter().enumerate() {
            feature.property(at, name, value).unwrap();
        }
    };
    writer.add_feature_geom(polygon(), |feature| fill(feature)).unwrap();
    writer.add_feature_geom(polygon(), |_| {}).unwrap();
    let mut out = Vec::new();
    writer.write(&mut out).unwrap();
    out
}

#[test]
fn flatgeobuf_columns_have_the_types_of_their_schema() {
    let (_folder, path) = file("a.fgb", &typed_fgb());
    let whole = Attribute::Integer;
    for (name, value) in [
        ("byte", whole(-3)),
        ("ubyte", whole(200)),
        ("bool", Attribute::Boolean(true)),
        ("short", whole(-300)),
        ("ushort", whole(60000)),
        ("int", whole(-70000)),
        ("uint", whole(4_000_000_000)),
        ("long", whole(-5_000_000_000)),
        ("ulong", Attribute::Number(18_446_744_073_709_551_615.0)),
        ("float", Attribute::Number(0.5)),
        ("double", Attribute::Null),
        ("string", text("é")),
        ("json", text("[1]")),
        ("time", text("2026-01-31T00:00:00Z")),
    ] {
        let read = read_columns(&path, None, &names(&[name])).unwrap();
        let mut values: Vec<Attribute> = (0..2).map(|index| read.columns[0].value(index).clone()).collect();
        // The spatial index orders the features.
        values.sort();
        assert_eq!(values, [Attribute::Null, value], "{name}");
    }
    assert!(column_refused(&path, "raw").contains("the column `raw` holds bytes"));
}

/// A FlatGeobuf whose feature brings columns of its own, and these bytes as their values.
fn fgb_with_own_columns(properties: &[u8]) -> Vec<u8> {
    use ::flatgeobuf as fgb;
    let mut builder = Default::default();
    let header =
        fgb::Header::create(&mut builder, &fgb::HeaderArgs { index_node_size: 0, ..Default::default() });
    fgb::finish_size_prefixed_header_buffer(&mut builder, header);
    let mut out = b"fgb\x03fgb\x00".to_vec();
    out.extend(builder.finished_data());
    builder.reset();
    let xy = Some(builder.create_vector(&[0.0, 0.0, 1.0, 1.0]));
    let line = fgb::GeometryArgs { xy, type_: fgb::GeometryType::LineString, ..Default::default() };
    let geometry = Some(fgb::Geometry::create(&mut builder, &line));
    let columns = [("own", ColumnType::Short), ("text", ColumnType::String)].map(|(name, type_)| {
        let name = Some(builder.create_string(name));
        fgb::Column::create(&mut builder, &fgb::ColumnArgs { name, type_, ..Default::default() })
    });
    let columns = Some(builder.create_vector(&columns));
    let properties = Some(builder.create_vector(properties));
    let feature = fgb::Feature::create(&mut builder, &fgb::FeatureArgs { geometry, properties, columns });
    fgb::finish_size_prefixed_feature_buffer(&mut builder, feature);
    out.extend(builder.finished_data());
    out
}

#[test]
fn a_feature_of_a_flatgeobuf_may_bring_its_own_columns() {
    let (_folder, path) = file("a.fgb", &fgb_with_own_columns(&[1, 0, 1, 0, 0, 0, b'x', 0, 0, 5, 1]));
    assert_eq!(column(&path, "own"), [Attribute::Integer(261)]);
    assert_eq!(column(&path, "text"), [text("x")]);
    for (bytes, said) in [
        (&[2, 0, 1, 1][..], "its values name a column that there is not"),
        (&[0, 0, 1], "the column `own` holds a value that is longer"),
        (&[1, 0, 255, 255, 255, 255, b'x'], "the column `text` holds a value that is longer"),
        (&[1, 0, 1, 0, 0, 0, 255], "the column `text` holds a text that is not UTF-8"),
    ] {
        let (_folder, path) = file("a.fgb", &fgb_with_own_columns(bytes));
        let refused = column_refused(&path, "text");
        assert!(refused.contains("feature 0") && refused.contains(said), "{refused}");
    }
}

#[test]
fn a_description_sums_up_each_column() {
    let (_folder, path) = file("a.geojson", MIXED.as_bytes());
    let columns = describe(&path).unwrap().remove(0).columns;
    let told: Vec<(String, String, usize)> =
        columns.iter().map(|c| (c.name.clone(), c.kind.to_string(), c.values)).collect();
    let told: Vec<(&str, &str, usize)> = told.iter().map(|(a, b, n)| (a.as_str(), b.as_str(), *n)).collect();
    assert_eq!(
        told,
        [
            ("a", "values of several kinds", 3),
            ("b", "values of several kinds", 2),
            ("c", "text", 1),
            ("d", "numbers", 2),
            ("", "no values", 0)
        ]
    );
    assert_eq!(columns[0].range, Some([2.0, 2.5]));
    assert_eq!(columns[0].distinct.as_ref().unwrap()[0], (Attribute::Integer(2), 1));
}

#[test]
fn a_description_keeps_few_values_of_a_long_column() {
    let features = (0..100).map(|k| {
        format!(r#"{{"type":"Feature","properties":{{"few":"{}","many":{k}}},"geometry":null}}"#, k % 12)
    });
    let features: Vec<String> = features.collect();
    let text = format!(r#"{{"type":"FeatureCollection","features":[{}]}}"#, features.join(","));
    let (_folder, path) = file("a.geojson", text.as_bytes());
    let columns = describe(&path).unwrap().remove(0).columns;
    let few = columns[0].distinct.as_ref().unwrap();
    assert_eq!((few.len(), few[0].1, few[11].1), (12, 9, 8));
    assert!(columns[1].distinct.is_none());
    assert_eq!((columns[1].range, columns[1].examples.len()), (Some([0.0, 99.0]), 3));
}

fn tables() -> Vec<Vec<u8>> {
    let fields =
        [("A", b'N', 2, 0), ("B", b'C', 2, 0), ("D", b'D', 8, 0), ("I", b'I', 4, 0), ("T", b'T', 8, 0)];
    let row: &[u8] = b" 1ab20260131\x01\x00\x00\x00\x00\x00\x25\x00\x00\x00\x01\x00";
    vec![dbf(0, &fields, &[row, row]), dbf(0x7b, &fields, &[row, row])]
}

/// A GeoPackage with attributes, made once.
#[cfg(feature = "gpkg")]
fn sound_gpkg() -> &'static [u8] {
    static MADE: std::sync::OnceLock<Vec<u8>> = std::sync::OnceLock::new();
    MADE.get_or_init(|| {
        let (_folder, path) = gpkg_with("fid INTEGER PRIMARY KEY, a TEXT", &["1, 'é'", "2, 3"]);
        std::fs::read(path).unwrap()
    })
}

/// FlatGeobufs with attributes, made once.
fn sound_fgbs() -> &'static [Vec<u8>; 2] {
    static MADE: std::sync::OnceLock<[Vec<u8>; 2]> = std::sync::OnceLock::new();
    MADE.get_or_init(|| [typed_fgb(), fgb_with_own_columns(&[1, 0, 1, 0, 0, 0, b'x', 0, 0, 5, 1])])
}

#[test]
#[ignore = "writes the seeds for fuzzing into $DRAPERY_SEEDS"]
fn seeds_for_fuzzing_attributes() {
    let shapes = shp(5, &[shp_parts(5, &[&SQUARE]), shp_parts(5, &[&SQUARE])]);
    let with_table =
        |table: &Vec<u8>| seeds::beside(&shapes, &[("dbf", table), ("cpg", b"1252"), ("prj", b"GEOGCS[")]);
    seeds::plant("vector_shapefile/attributes", tables().iter().map(with_table));
    seeds::plant("vector_geojson/attributes", [MIXED]);
    seeds::plant("vector_flatgeobuf/attributes", sound_fgbs());
    #[cfg(feature = "gpkg")]
    seeds::plant("vector_geopackage/attributes", [sound_gpkg()]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn any_damage_to_a_table_gives_values_or_words(which in 0..2_usize, (changes, cut) in changes(), name in "[ABDITN]") {
        let (_folder, path) = shapefile(2, &mutated(tables()[which].clone(), &changes, cut), None);
        match read_columns(&path, None, &[name]) {
            Ok(read) => prop_assert!(read.columns.iter().all(|c| c.values.len() <= 2)),
            Err(e) => prop_assert!(!e.is_internal() && e.path().is_some()),
        }
        if let Err(e) = describe(&path) {
            prop_assert!(!e.is_internal());
        }
    }

    #[test]
    fn any_damage_to_files_with_attributes_gives_values_or_words(which in 0..3_usize, (changes, cut) in changes()) {
        let (name, bytes) = match which {
            0 => ("a.geojson", MIXED.as_bytes()),
            which => ("a.fgb", &*sound_fgbs()[which - 1]),
        };
        let (_folder, path) = file(name, &mutated(bytes.to_vec(), &changes, cut));
        if let Err(e) = read_columns(&path, None, &names(&["a", "own", "text", "string", "ulong"])) {
            prop_assert!(!e.is_internal() && e.path().is_some());
        }
        if let Err(e) = describe(&path) {
            prop_assert!(!e.is_internal() && e.path().is_some());
        }
    }
}

#[cfg(feature = "gpkg")]
proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn any_damage_to_a_geopackages_columns_gives_values_or_words((changes, cut) in changes()) {
        let (_folder, path) = file("a.gpkg", &mutated(sound_gpkg().to_vec(), &changes, cut));
        if let Err(e) = read_columns(&path, None, &names(&["a", "fid"])) {
            prop_assert!(!e.is_internal() && e.path().is_some());
        }
    }
}
