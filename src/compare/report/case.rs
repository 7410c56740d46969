//! One judged frame, as all reports tell it.

use super::numbers::Row;
use crate::compare::judgement::Ruling;
use crate::compare::metrics::Window;
use crate::error::{Error, Result};
use serde::Serialize;
use serde_json::{Value, json};

/// The version of the JSON's layout.
pub const COMPARE_SCHEMA: u32 = 1;

/// One judged frame: what its text, its JSON, a test report and a page are made of.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Its name.
    pub name: String,
    /// What the case is there for, in a sentence.
    pub exposes: Option<String>,
    /// What is expected: a file, a folder, or two files.
    pub expected: String,
    /// What was judged.
    pub actual: String,
    /// The verdict.
    pub ruling: Ruling,
    /// Why, where it failed.
    pub failure: Option<Failure>,
    /// The verdict in a line.
    pub headline: String,
    /// How many pixels fail, where they could be counted.
    pub failing: Option<usize>,
    /// Which hypothesis fits.
    pub hypothesis: Option<String>,
    /// Windows in which most pixels fail, apart from one another, most first.
    pub windows: Vec<Window>,
    /// The features that have a say in failing pixels, and in how many, most first.
    pub features: Vec<(String, usize)>,
    pub(in crate::compare) rows: Vec<Row>,
    pub(super) document: Value,
}

/// A failure: its name, and it in words.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Failure {
    /// What programs know it by.
    pub name: String,
    /// What people read.
    pub text: String,
}

impl Failure {
    pub(super) fn of(name: &str, headline: &str) -> Self {
        Self { name: name.to_owned(), text: headline.trim_start_matches("FAIL: ").to_owned() }
    }
}

impl Case {
    /// A frame of a set that is missing or cannot be read.
    pub fn unread(expected: &str, actual: &str, error: &Error) -> Self {
        let failure = Failure { name: "no-frame".into(), text: error.to_string() };
        let document = json!({
            "schema": COMPARE_SCHEMA,
            "kind": "bundle",
            "expected": expected,
            "actual": actual,
            "verdict": "fail",
            "failure": failure,
        });
        Self {
            name: actual.to_owned(),
            exposes: None,
            expected: expected.to_owned(),
            actual: actual.to_owned(),
            ruling: Ruling::Fail,
            headline: format!("FAIL: {}", failure.text),
            failure: Some(failure),
            failing: None,
            hypothesis: None,
            windows: Vec::new(),
            features: Vec::new(),
            rows: vec![("expected", expected.to_owned()), ("actual", actual.to_owned())],
            document,
        }
    }

    /// The same, as a case of a set: by the set's name of it, and what it is there for.
    #[must_use]
    pub fn of_set(mut self, name: &str, exposes: &str) -> Self {
        self.name = name.to_owned();
        self.rows.push(("exposes", exposes.to_owned()));
        self.exposes = Some(exposes.to_owned());
        self
    }

    /// The verdict in a line, then a line for each number.
    pub fn text(&self) -> String {
        let widest = self.rows.iter().map(|(name, _)| name.len()).max().unwrap_or(0).max(9);
        let line = |(name, text): &Row| format!("  {name:<widest$} {text}\n");
        format!("{}\n{}", self.headline, self.rows.iter().map(line).collect::<String>())
    }

    /// The JSON document. Numbers are written so that they are read back as they were; an infinite one is `"inf"`.
    ///
    /// # Errors
    /// Internal errors only.
    pub fn json(&self) -> Result<String> {
        pretty(&self.document)
    }
}

pub(super) fn pretty(document: &Value) -> Result<String> {
    let text = serde_json::to_string_pretty(document);
    text.map(|text| text + "\n")
        .map_err(|error| Error::internal(format!("the verdict as JSON: {error}")).caused_by(error))
}
