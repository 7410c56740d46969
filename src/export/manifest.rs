//! `manifest.json`: which files belong together, and what they were when they were written.

use crate::error::{Error, Result};
use crate::output::{Batch, StagedFile};

/// The name of the file that tells of the others.
const NAME: &str = "manifest.json";

#[derive(serde::Serialize)]
struct Manifest<'a> {
    schema: u32,
    program: &'static str,
    kind: &'static str,
    technique: &'a str,
    files: Vec<StagedFile>,
}

/// Stages the manifest of a technique's bundle behind all that has been staged in its folder.
///
/// # Errors
/// When it cannot be written.
pub(super) fn stage_manifest(technique: &str, batch: &mut Batch) -> Result<()> {
    let program = concat!("drapery ", env!("CARGO_PKG_VERSION"));
    let manifest = Manifest { schema: 1, program, kind: "bundle", technique, files: batch.staged() };
    let text = serde_json::to_string_pretty(&manifest);
    let text = text.map_err(|error| Error::internal(format!("{NAME}: {error}")).caused_by(error))?;
    batch.stage(NAME, |to| to.write_all(text.as_bytes()).and_then(|()| to.write_all(b"\n")))
}
