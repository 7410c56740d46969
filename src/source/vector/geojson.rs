//! GeoJSON: RFC 7946, and the `crs` member of its predecessor of 2008; several texts one after the other, as newline-delimited
//! GeoJSON and RFC 8142 have them.
//!
//! Each property is a column of attributes; a nested one is its JSON text. A feature that does not have it has no value.
//!
//! Parsed by `serde_json` straight into vertices, a feature at a time: the `geojson` crate's reader keeps all
//! properties and takes the first `[` of the file for the features, which a `bbox` before them breaks. Nesting is
//! bounded by `serde_json` (128).

mod coordinates;
mod geometry;
mod object;
mod properties;

use super::collector::Collector;
use crate::crs::Crs;
use crate::error::{Error, Position, Result};
use object::{OrNull, Reading, add_object};
use serde::de::DeserializeSeed;

/// The separator of RFC 8142, which no text of JSON can hold.
pub(super) const RECORD_SEPARATOR: u8 = 0x1e;

/// Reads GeoJSON, and of its properties what is wanted.
pub(super) fn read(mut bytes: Vec<u8>, found: Collector) -> Result<Collector> {
    bytes.iter_mut().filter(|byte| **byte == RECORD_SEPARATOR).for_each(|byte| *byte = b' ');
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes);
    let mut reading = Reading { found, ..Reading::default() };
    let mut json = serde_json::Deserializer::from_slice(text);
    let mut first_crs = None;
    loop {
        let parsed = OrNull(&mut reading).deserialize(&mut json);
        let mut object = match (parsed, reading.failure.take()) {
            (_, Some(failure)) => return Err(failure),
            (Err(e), None) => return Err(malformed(e, &reading)),
            (Ok(Some(object)), None) => object,
            (Ok(None), None) => {
                reading.nulls += 1;
                reading.found.next_feature();
                if json.end().is_ok() {
                    break;
                }
                continue;
            }
        };
        let crs = object.crs.take();
        if *first_crs.get_or_insert_with(|| crs.clone()) != crs {
            return Err(Error::new("the texts of this file are in different reference systems")
                .help("write a file for each")
                .in_feature(reading.found.current()));
        }
        add_object(object, &mut reading)?;
        if json.end().is_ok() {
            break;
        }
    }
    let mut found = note_what_is_odd(reading);
    if let Some(read) = crs_of(first_crs.flatten().as_ref()) {
        found.state_crs(read, "in the crs member");
    }
    found.finish();
    Ok(found)
}

fn malformed(e: serde_json::Error, reading: &Reading) -> Error {
    let whole = e.to_string();
    let place = format!(" at line {} column {}", e.line(), e.column());
    let error = Error::new(format!("this is not GeoJSON: {}", whole.strip_suffix(&place).unwrap_or(&whole)))
        .help("check that the file was copied whole; numbers and not NaN are coordinates")
        .at(Position { line: e.line(), column: if e.column() == 0 { 1 } else { e.column() }, length: 1 });
    let error = error.caused_by(e);
    let is_in_features = reading.depth > 0 || reading.found.current() > 0;
    if is_in_features { error.in_feature(reading.found.current()) } else { error }
}

fn note_what_is_odd(reading: Reading) -> Collector {
    let Reading { mut found, nulls, nested, bare, .. } = reading;
    let told = [
        (nulls, "`null` in the place of a feature: left out"),
        (nested, "FeatureCollection in the place of a feature: its features are read"),
        (bare, "geometry in the place of a feature: read as one without properties"),
    ];
    let told = told.into_iter().filter(|(count, _)| *count > 0);
    found.notes.extend(told.map(|(count, what)| format!("{count} x {what}")));
    found
}

/// No `crs` member means longitude and latitude on WGS 84; one that is null, that nothing is known.
fn crs_of(member: Option<&serde_json::Value>) -> Option<Result<Crs>> {
    let Some(member) = member else {
        return Some(Crs::crs84());
    };
    if member.is_null() {
        return None;
    }
    let name = member.get("properties").and_then(|p| p.get("name")).and_then(|n| n.as_str());
    Some(match name {
        Some(name) => Crs::parse(name),
        None => Err(Error::new("it names none")),
    })
}
