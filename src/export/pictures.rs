//! A scene drawn into a folder: what `drapery render` writes.

use super::Buffers;
use super::run_files::RunFiles;
use crate::error::Result;
use crate::measure::{Certified, Watch, scene_result};
use crate::output::{Batch, RESULT_SCHEMA, RenderResult, RunResult};
use crate::stage::Stage;
use crate::technique::Kind;
use crate::truth::Budget;

/// Pictures to be made: `T.png` and the wanted buffers of each technique T, and `result.json`.
#[derive(Debug, Clone, Copy)]
pub struct Pictures<'a> {
    /// What is drawn.
    pub stage: &'a Stage,
    /// The hash of its scene file (`SceneFile::hash`), for `result.json`.
    pub hash: &'a str,
    /// Whether the truth's own picture is written. (It is computed in any case: errors are distances from it.)
    pub truth: bool,
    /// By what it is drawn.
    pub techniques: &'a [Kind],
    /// The buffers that are written beside the pictures.
    pub buffers: &'a Buffers,
    /// How exact the truth is.
    pub budget: &'a Budget,
    /// How many runs are timed, at least 1; told are the medians.
    pub repeat: u32,
}

impl Pictures<'_> {
    /// Draws and writes; the files are in their places when it returns what `result.json` says.
    ///
    /// # Errors
    /// When a technique does not draw such a scene, or a file cannot be written: then no file is.
    pub fn write(&self, mut batch: Batch, watch: &dyn Watch) -> Result<RenderResult> {
        let view = self.stage.view()?;
        let truths = if self.truth { self.repeat } else { 1 };
        let certified = Certified::of((self.stage, &view), self.budget, truths, watch)?;
        let mut files = RunFiles {
            stage: self.stage,
            view: &view,
            certified: &certified,
            buffers: self.buffers,
            batch: &mut batch,
            watch,
        };
        let truth = if self.truth { Some(files.truth()) } else { None };
        let techniques = self.techniques.iter().map(|kind| Ok(files.technique(*kind, self.repeat)?.0));
        let runs: Result<Vec<RunResult>> = truth.into_iter().chain(techniques).collect();
        let result = RenderResult {
            schema: RESULT_SCHEMA,
            scene: scene_result(self.stage, self.hash),
            notes: self.stage.scene.notes.clone(),
            runs: runs?,
        };
        let text = result.to_json()?;
        batch.stage("result.json", |to| to.write_all(text.as_bytes()))?;
        batch.commit()?;
        Ok(result)
    }
}
