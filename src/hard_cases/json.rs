//! The suite as JSON.

use super::case::Row;
use super::stability::Curve;
use super::suite::Suite;
use crate::error::{Error, Result};
use serde::Serialize;

/// The version of `hard-cases.json`.
const SCHEMA: u32 = 1;

#[derive(Serialize)]
struct Document<'a> {
    schema: u32,
    cases: Vec<CaseJson<'a>>,
    stability: &'a [Curve],
}

#[derive(Serialize)]
struct CaseJson<'a> {
    number: u32,
    title: &'a str,
    reports: &'a str,
    answer: &'a str,
    rows: &'a [Row],
}

impl Suite {
    /// The text of `hard-cases.json`.
    ///
    /// # Errors
    /// Internal errors only.
    pub fn json(&self) -> Result<String> {
        let cases = self.cases.iter().map(|result| {
            let case = &result.case;
            CaseJson {
                number: case.number,
                title: case.title,
                reports: case.reports,
                answer: case.answer,
                rows: &result.rows,
            }
        });
        let document = Document { schema: SCHEMA, cases: cases.collect(), stability: &self.curves };
        let text = serde_json::to_string_pretty(&document);
        Ok(text.map_err(|error| Error::internal(format!("hard-cases.json: {error}")).caused_by(error))?
            + "\n")
    }
}
