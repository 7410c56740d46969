//! The files of a paper's tables.

use crate::error::{Error, Result};
use crate::output::Batch;

/// The text of `tables.json`.
///
/// # Errors
/// Internal errors only.
pub(super) fn json(tables: &impl serde::Serialize) -> Result<String> {
    let text = serde_json::to_string_pretty(tables);
    Ok(text.map_err(|error| Error::internal(format!("tables.json: {error}")).caused_by(error))? + "\n")
}

/// Writes `tables.html`, `tables.csv` and `tables.json`; they are in their places when it returns.
///
/// # Errors
/// When a file cannot be written: then none is.
pub(super) fn write(mut batch: Batch, page: &str, csv: &str, json: &str) -> Result<()> {
    for (name, text) in [("tables.html", page), ("tables.csv", csv), ("tables.json", json)] {
        batch.stage(name, |to| to.write_all(text.as_bytes()))?;
    }
    batch.commit()
}
