//! Tables 2 to 5 and Fig. 14 of She et al. 2016, measured anew: frames of inverse projection over tiles, sizes of the picture, terrains and lines, and
//! beside stencil volumes.
//!
//! Input: data sets, each an opened scene ([`measure()`]); without scenes [`SCENE`] as the [`STUDIES`] change it, generated in the likeness of the
//! paper's. Output: [`Tables`], as `tables.json`, `tables.csv` and a page. Refuses: scenes that inverse projection or stencil volumes do not draw.
//!
//! Counts are the same in every run, times are this machine's.

mod measuring;
mod page;
mod studies;

pub use measuring::measure;
pub use page::page;
pub use studies::{SCENE, STUDIES, Study, Table};

use super::files;
use crate::error::Result;
use crate::measure::Times;
use crate::output::{Batch, SceneResult};

/// The version of the layout of `tables.json` and of the columns of `tables.csv`.
pub const TABLES_SCHEMA: u32 = 1;

/// All data sets.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Tables {
    /// [`TABLES_SCHEMA`].
    pub schema: u32,
    /// Whose tables they are.
    pub paper: &'static str,
    /// How many times each thing was timed.
    pub repeat: u32,
    /// The data sets.
    pub data_sets: Vec<DataSet>,
}

/// A scene with all that was measured of it.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct DataSet {
    /// The scene.
    pub scene: SceneResult,
    /// Pixels a row of its picture.
    pub width: usize,
    /// Rows of its picture.
    pub height: usize,
    /// Triangles of its terrain.
    pub triangles: usize,
    /// Vertices (as many as edges) of its expanded areas.
    pub vertices: usize,
    /// A row a setting.
    pub rows: Vec<Row>,
}

/// A setting's numbers.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Row {
    /// The number of the paper's table.
    pub table: &'static str,
    /// What is varied, in words.
    pub setting: String,
    /// By which technique.
    pub technique: &'static str,
    /// Milliseconds of a frame.
    pub frame_ms: Times,
    /// What the paper has for it, frames a second.
    pub paper_fps: Option<f64>,
    /// Vertices of expanded areas (0: another technique).
    pub vertices: usize,
    /// Pixels of class P.
    pub border_pixels: u64,
    /// Samples that were taken in them.
    pub samples: u64,
    /// How often an edge was asked for a sample.
    pub edge_tests: u64,
}

impl Tables {
    /// The tables of some data sets.
    pub fn of(data_sets: Vec<DataSet>, repeat: u32) -> Self {
        Self { schema: TABLES_SCHEMA, paper: "she", repeat, data_sets }
    }

    /// Writes `tables.html`, `tables.csv` and `tables.json`; they are in their places when it returns.
    ///
    /// # Errors
    /// When a file cannot be written: then none is.
    pub fn write(&self, batch: Batch) -> Result<()> {
        files::write(batch, &page(self), &self.to_csv(), &files::json(self)?)
    }

    /// The text of `tables.csv`: a row a setting of a data set.
    pub fn to_csv(&self) -> String {
        let head = "data_set,triangles,vertices,table,setting,technique,frame_ms,frame_ms_min,frame_ms_max,paper_fps,border_pixels,samples,edge_tests";
        let mut text = format!("{head}\n");
        for set in &self.data_sets {
            for row in &set.rows {
                let escaped = super::super::table::escaped;
                let cells = [
                    escaped(&set.scene.name),
                    set.triangles.to_string(),
                    set.vertices.to_string(),
                    row.table.into(),
                    escaped(&row.setting),
                    row.technique.into(),
                    row.frame_ms.median.to_string(),
                    row.frame_ms.min.to_string(),
                    row.frame_ms.max.to_string(),
                    row.paper_fps.map(|fps| fps.to_string()).unwrap_or_default(),
                    row.border_pixels.to_string(),
                    row.samples.to_string(),
                    row.edge_tests.to_string(),
                ];
                text.push_str(&(cells.join(",") + "\n"));
            }
        }
        text
    }
}

#[cfg(test)]
mod tests;
