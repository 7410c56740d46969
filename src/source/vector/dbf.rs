//! Attributes of shapefiles: the dBASE table (.dbf) beside the .shp, one row for each of its records.
//!
//! Layout: *dBASE III, IV and FoxPro*: a header of 32 bytes, 32 more for each field, rows of one length. dBASE 7 lays its
//! header out otherwise and is refused. Fields of type C, N, F, L, D are read, and as FoxPro writes them (least
//! significant byte first) I and + (whole numbers of 4 bytes), B and O (doubles), T and @ (day and milliseconds); memos are not:
//! their text is in another file.
//!
//! A row that is marked as deleted keeps its place: its record is left out. Texts are in the code page that the .cpg names, else in
//! that of the header's language driver; without either they are UTF-8 where all texts of the table are, else Windows-1252.

use super::bytes::{Cursor, Endian};
use super::code_page::CodePage;
use super::collector::Collector;
use crate::error::{Error, Result};
use crate::scene::Attribute;

const HEADER_BYTES: usize = 32;
const FIELD_BYTES: usize = 32;
/// Of a language driver in the header.
const DRIVER_AT: usize = 29;

/// Reads the columns that are wanted of the table of a shapefile whose records have been read.
pub(super) fn read(rows: Result<Option<Rows<'_>>>, cpg: Option<&[u8]>, found: &mut Collector) -> Result<()> {
    let is_read = found.attributes.are_read();
    let rows = match rows? {
        Some(rows) => rows,
        None if !is_read => return Ok(()),
        None => {
            return Err(Error::new("there is no .dbf beside the file, so its features have no columns")
                .help("put the .dbf beside it, or ask for no column"));
        }
    };
    let table = is_read.then(|| rows.table()).transpose()?;
    if rows.count != found.seen {
        return Err(damaged(&format!(
            "it has {} rows and the .shp {} features, so that which belong together is not known",
            rows.count, found.seen
        )));
    }
    table.map_or(Ok(()), |table| read_values(&table, cpg, found))
}

fn damaged(why: &str) -> Error {
    Error::new(format!("the table of attributes is damaged: {why}")).help("write it again from its source")
}

fn read_values(table: &Table<'_>, cpg: Option<&[u8]>, found: &mut Collector) -> Result<()> {
    let page = code_page(cpg, table, found);
    let slots = slots(table, page, found);
    let rows = &table.rows;
    for (index, row) in rows.iter().enumerate().filter(|(index, _)| !rows.is_deleted(*index)) {
        for (field, slot) in table.fields.iter().zip(&slots) {
            if let Some(slot) = *slot {
                read_value(field, page, row, (slot, index), found).map_err(|e| e.in_feature(index))?;
            }
        }
    }
    Ok(())
}

/// Where each field's values go: fields that nobody wants, and others of a name that has been met, go nowhere.
fn slots(table: &Table<'_>, page: CodePage, found: &mut Collector) -> Vec<Option<usize>> {
    let mut met = Vec::with_capacity(table.fields.len());
    for field in &table.fields {
        let name =
            page.decode(field.name).unwrap_or_else(|| String::from_utf8_lossy(field.name).into_owned());
        let slot = found.attributes.column(&name);
        let is_first = !met.contains(&Some(slot));
        met.push((is_first && found.attributes.reads(slot)).then_some(slot));
    }
    met
}

fn read_value(
    field: &Field<'_>,
    page: CodePage,
    row: &[u8],
    (slot, index): (usize, usize),
    found: &mut Collector,
) -> Result<()> {
    let bytes = row.get(field.start..field.start + field.length).unwrap_or_default();
    match value(field, bytes, page) {
        Ok(Some(value)) => found.attributes.put(slot, index, value),
        Ok(None) => {
            let what = format!("is of type {}, which is not read", field.kind.escape_ascii());
            found.attributes.put_unread(slot, &what)?;
        }
        Err(what) => return Err(found.attributes.error(slot, &what)),
    }
    Ok(())
}

/// The rows of a table, all of which are in the file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rows<'a> {
    /// How many there are.
    pub(super) count: usize,
    header: &'a [u8],
    row_bytes: usize,
    data: &'a [u8],
}

impl<'a> Rows<'a> {
    /// Those of a table's bytes. All versions of dBASE agree on where these are.
    pub(super) fn of(bytes: &'a [u8]) -> Result<Self> {
        let header = bytes.get(..HEADER_BYTES).and_then(|header| {
            let mut at_rows = Cursor::new(header.get(4..)?);
            let rows = at_rows.u32(Endian::Little)? as usize;
            Some((rows, at_rows.u16(Endian::Little)?, at_rows.u16(Endian::Little)?))
        });
        let (count, header_bytes, row_bytes) = header.ok_or_else(|| damaged("it ends within its header"))?;
        let split = bytes
            .split_at_checked(usize::from(header_bytes))
            .filter(|(header, _)| header.len() >= HEADER_BYTES);
        let (header, data) = split.ok_or_else(|| damaged("its header is longer than it"))?;
        let row_bytes = usize::from(row_bytes);
        if row_bytes == 0 {
            return Err(damaged("its rows have no bytes"));
        }
        let whole = count.checked_mul(row_bytes).and_then(|length| data.get(..length));
        let data = whole
            .ok_or_else(|| damaged("it ends within this row's values").in_feature(data.len() / row_bytes))?;
        Ok(Self { count, header, row_bytes, data })
    }

    fn iter(&self) -> impl Iterator<Item = &'a [u8]> + use<'a> {
        self.data.chunks_exact(self.row_bytes)
    }

    /// Whether a row is marked as deleted.
    pub(super) fn is_deleted(&self, row: usize) -> bool {
        self.data.get(row * self.row_bytes) == Some(&b'*')
    }

    /// The table with its fields.
    fn table(&self) -> Result<Table<'a>> {
        if self.header[0] & 7 == 4 {
            return Err(Error::unsupported("the .dbf is a table of dBASE 7, whose fields are not read")
                .help("save it as dBASE IV or III, which are what a shapefile has; without columns the shapes are drawn"));
        }
        let fields = fields(&self.header[HEADER_BYTES..]);
        if fields.last().is_some_and(|last| last.start + last.length > self.row_bytes) {
            return Err(damaged(&format!(
                "its rows of {} bytes are too short for its fields",
                self.row_bytes
            )));
        }
        Ok(Table { fields, rows: *self, driver: self.header[DRIVER_AT] })
    }
}

/// A table whose fields are known.
struct Table<'a> {
    fields: Vec<Field<'a>>,
    rows: Rows<'a>,
    driver: u8,
}

impl<'a> Table<'a> {
    /// The bytes of all texts.
    fn texts(&self) -> impl Iterator<Item = &'a [u8]> + '_ {
        let texts = || self.fields.iter().filter(|field| field.kind == b'C');
        self.rows
            .iter()
            .flat_map(move |row| texts().filter_map(move |f| row.get(f.start..f.start + f.length)))
    }
}

/// A column of the table.
struct Field<'a> {
    name: &'a [u8],
    kind: u8,
    /// Its first byte in a row.
    start: usize,
    length: usize,
    decimals: u8,
}

/// The fields that a header describes, up to its end mark.
fn fields(described: &[u8]) -> Vec<Field<'_>> {
    // A row begins with the mark of deleted ones.
    let mut start = 1;
    let described = described.chunks_exact(FIELD_BYTES).take_while(|field| field[0] != 0x0d);
    described
        .map(|field| {
            let length = usize::from(field[16]);
            let this = start;
            start += length;
            Field { name: c_string(&field[..11]), kind: field[11], start: this, length, decimals: field[17] }
        })
        .collect()
}

/// Bytes up to a zero, without the spaces at their end.
fn c_string(bytes: &[u8]) -> &[u8] {
    bytes.split(|b| *b == 0).next().unwrap_or_default().trim_ascii_end()
}

/// See the module.
fn code_page(cpg: Option<&[u8]>, table: &Table<'_>, found: &mut Collector) -> CodePage {
    let text = |bytes| String::from_utf8_lossy(bytes).trim_start_matches('\u{feff}').trim().to_owned();
    let cpg = cpg.map(text);
    let named = cpg.as_deref().map(CodePage::named);
    if let (Some(None), Some(name)) = (named, &cpg) {
        let name: String = name.chars().take(40).collect();
        found
            .notes
            .push(format!("the code page '{name}' that the .cpg names is not known and taken for unsaid"));
    }
    named.flatten().or_else(|| CodePage::of_driver(table.driver)).unwrap_or_else(|| {
        let all_utf8 = table.texts().all(|text| CodePage::Utf8.decode(text).is_some());
        if all_utf8 { CodePage::Utf8 } else { CodePage::western() }
    })
}

/// The value that some bytes are; `None` where the field's type is not read.
fn value(field: &Field<'_>, bytes: &[u8], page: CodePage) -> std::result::Result<Option<Attribute>, String> {
    Ok(Some(match (field.kind, bytes.len()) {
        (b'C', _) => text(c_string(bytes), page)?,
        (b'N' | b'F', _) => number(bytes.trim_ascii(), field.decimals)?,
        (b'L', _) => flag(bytes)?,
        (b'D', _) => date(c_string(bytes).trim_ascii())?,
        (b'I' | b'+', 4) => Attribute::Integer(i64::from(whole(bytes))),
        (b'B' | b'O', 8) => Attribute::of_number(Cursor::new(bytes).f64(Endian::Little).unwrap_or(f64::NAN)),
        (b'T' | b'@', 8) => time(whole(&bytes[..4]), whole(&bytes[4..]))?,
        _ => return Ok(None),
    }))
}

/// A text; one without characters is no value.
fn text(bytes: &[u8], page: CodePage) -> std::result::Result<Attribute, String> {
    if bytes.is_empty() {
        return Ok(Attribute::Null);
    }
    let decoded = page.decode(bytes).map(Attribute::Text);
    decoded.ok_or_else(|| {
        format!("holds \"{}\", which is no text in the table's code page", bytes.escape_ascii())
    })
}

/// A number in digits. Asterisks stand for one that was too long for the field.
fn number(bytes: &[u8], decimals: u8) -> std::result::Result<Attribute, String> {
    if bytes.is_empty() || bytes[0] == b'*' || bytes.iter().all(|b| *b == 0) {
        return Ok(Attribute::Null);
    }
    let digits = std::str::from_utf8(bytes).ok();
    let whole = digits.filter(|_| decimals == 0).and_then(|digits| digits.parse().ok());
    let any = || digits.and_then(|digits| digits.parse().ok()).map(Attribute::of_number);
    whole
        .map(Attribute::Integer)
        .or_else(any)
        .ok_or_else(|| format!("holds \"{}\", which is no number", bytes.escape_ascii()))
}

fn flag(bytes: &[u8]) -> std::result::Result<Attribute, String> {
    match bytes {
        [b'T' | b't' | b'Y' | b'y'] => Ok(Attribute::Boolean(true)),
        [b'F' | b'f' | b'N' | b'n'] => Ok(Attribute::Boolean(false)),
        [b'?' | b' ' | 0] => Ok(Attribute::Null),
        _ => Err(format!("holds \"{}\", which is neither true nor false", bytes.escape_ascii())),
    }
}

/// `20260131`, as a text with hyphens.
fn date(bytes: &[u8]) -> std::result::Result<Attribute, String> {
    if bytes.iter().all(|b| *b == b'0') {
        return Ok(Attribute::Null);
    }
    match std::str::from_utf8(bytes) {
        Ok(digits) if digits.len() == 8 && digits.bytes().all(|b| b.is_ascii_digit()) => {
            Ok(Attribute::Text(format!("{}-{}-{}", &digits[..4], &digits[4..6], &digits[6..])))
        }
        _ => Err(format!("holds \"{}\", which is no date", bytes.escape_ascii())),
    }
}

/// The whole number of 4 bytes.
fn whole(bytes: &[u8]) -> i32 {
    Cursor::new(bytes).u32(Endian::Little).map_or(0, u32::cast_signed)
}

/// A Julian day and the milliseconds of it; a day 0 is none.
fn time(day: i32, milliseconds: i32) -> std::result::Result<Attribute, String> {
    if day == 0 {
        return Ok(Attribute::Null);
    }
    if day < 0 || !(0..86_400_000).contains(&milliseconds) {
        return Err(format!("holds the day {day} and the millisecond {milliseconds}, which is no time"));
    }
    let (year, month, day) = calendar_day(i64::from(day));
    let seconds = milliseconds / 1000;
    let (hour, minute, second) = (seconds / 3600, seconds / 60 % 60, seconds % 60);
    Ok(Attribute::Text(format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}")))
}

/// Year, month and day of a Julian day number: Richards 2013, *Calendars*, in the Explanatory Supplement to the Astronomical
/// Almanac, 15.11.3, Gregorian.
fn calendar_day(day: i64) -> (i64, i64, i64) {
    let f = day + 1401 + (4 * day + 274_277) / 146_097 * 3 / 4 - 38;
    let e = 4 * f + 3;
    let h = 5 * (e % 1461 / 4) + 2;
    let month = (h / 153 + 2) % 12 + 1;
    (e / 1461 - 4716 + (14 - month) / 12, month, h % 153 / 5 + 1)
}
