//! Files that may be missing, and documents of a schema that may be another.

use crate::error::{Error, Result};
use serde::de::DeserializeOwned;
use serde_json::Value;
use std::io;
use std::path::Path;

/// Why a file cannot be read: a missing one is called missing.
pub(super) fn unreadable(error: io::Error, path: &Path) -> Error {
    let is_missing = error.kind() == io::ErrorKind::NotFound;
    let error = Error::io("this file cannot be read", error).in_file(path);
    if is_missing { error.reworded(|_| "this file is missing".into()) } else { error }
}

/// A JSON document of the schema that this program reads.
pub(super) fn document<T: DeserializeOwned>(bytes: &[u8], path: &Path, schema: u64) -> Result<T> {
    let refuse = |error: serde_json::Error| {
        Error::new(format!("this is not what a bundle has here: {error}"))
            .caused_by(error)
            .in_file(path)
            .help("export it again: it may be half written, or by another program")
    };
    let value: Value = serde_json::from_slice(bytes).map_err(refuse)?;
    let found = &value["schema"];
    if found.as_u64() != Some(schema) {
        let by =
            value["program"].as_str().map(|program| format!(", written by {program}")).unwrap_or_default();
        return Err(Error::unsupported(format!(
            "it has the schema {found}{by}; this program reads {schema}"
        ))
        .in_file(path)
        .help("export it again with this program, or judge with the one that wrote it"));
    }
    serde_json::from_value(value).map_err(refuse)
}
