//! The conformance set: small scenes each of which exposes faults that clients make, as a bundle for each technique that draws it.
//!
//! Input: which technique, or all. Output: `CASE/TECHNIQUE/` with a bundle's files, and `conformance.json`, which tells what each shows. Refuses: nothing
//! but what writing refuses.

mod cases;

pub use cases::{CASES, Case};

use super::Bundle;
use crate::error::{Error, Result};
use crate::measure::Watch;
use crate::open::Opened;
use crate::output::Batch;
use crate::scene_file::{Override, SceneText};
use crate::technique::Kind;
use crate::truth::Budget;

/// What all its scenes have: small pictures, and structures that are not larger than they need be.
const SETTINGS: [&str; 5] = [
    "image.width=160",
    "image.height=120",
    "technique.clipmap.virtual_size=2048",
    "technique.static-decal.grid=32",
    "technique.static-decal.depth=5",
];

/// The conformance set to be made.
#[derive(Debug, Clone, Copy)]
pub struct Conformance<'a> {
    /// The technique that it is for; `None`: all.
    pub technique: Option<Kind>,
    /// What is changed in each scene, such as the device.
    pub changes: &'a [Override],
    /// How exact the truth is.
    pub budget: Budget,
    /// Whether bundles hold what pictures would be by other choices.
    pub alternatives: bool,
}

/// A bundle of the set, as `conformance.json` tells of it.
#[derive(serde::Serialize)]
struct Told {
    name: String,
    bundle: String,
    exposes: &'static str,
}

#[derive(serde::Serialize)]
struct Table {
    schema: u32,
    cases: Vec<Told>,
}

impl Case {
    /// Its scene, changed.
    ///
    /// # Errors
    /// When the changes do not fit it.
    pub fn open(&self, changes: &[Override]) -> Result<Opened> {
        let own = SETTINGS.iter().map(|text| Override::parse(text)).collect::<Result<Vec<Override>>>()?;
        Opened::load(SceneText::parse(self.scene, None, &[&own, changes].concat())?, &|_| {})
    }
}

impl Conformance<'_> {
    /// Writes all bundles; the files are in their places when it returns how many there are.
    ///
    /// # Errors
    /// When the changes do not fit, or a file cannot be written: then no file is.
    pub fn write(&self, mut batch: Batch, watch: &dyn Watch) -> Result<usize> {
        let mut table = Table { schema: 1, cases: Vec::new() };
        for case in &CASES {
            let is_wanted = |kind: &&Kind| self.technique.is_none_or(|wanted| wanted == **kind);
            let techniques: Vec<Kind> = case.techniques.iter().filter(is_wanted).copied().collect();
            if techniques.is_empty() {
                continue;
            }
            let scene = case.open(self.changes)?;
            for kind in techniques {
                let bundle = format!("{}/{}", case.name, kind.name());
                batch.enter(&bundle);
                let hash = &scene.text.file.hash;
                let (budget, alternatives) = (self.budget, self.alternatives);
                let made = Bundle { hash, budget, alternatives, ..Bundle::of(&scene.stage, kind) };
                made.stage_into(&mut batch, watch)?;
                let name = format!("{}.{}", case.name, kind.name());
                table.cases.push(Told { name, bundle, exposes: case.exposes });
            }
        }
        batch.enter("");
        let text = serde_json::to_string_pretty(&table);
        let text =
            text.map_err(|error| Error::internal(format!("conformance.json: {error}")).caused_by(error))?;
        batch.stage("conformance.json", |to| {
            to.write_all(text.as_bytes()).and_then(|()| to.write_all(b"\n"))
        })?;
        batch.commit()?;
        Ok(table.cases.len())
    }
}

#[cfg(test)]
mod tests;
