//! Table 1 and the figures of storage (3.3) of Wartell et al. 2003, measured anew, and geometry overlay over what its mesh and its lines can be told.
//!
//! Input: data sets, each an opened scene with a level-of-detail mesh ([`measure()`]); without scenes [`SCENES`], generated in the likeness of the paper's.
//! Output: [`Tables`], as `tables.json`, `tables.csv` and a page. Refuses: scenes that geometry overlay does not draw, without lines, without levels.
//!
//! Counts and bytes are the same in every run, times are this machine's.

mod measuring;
mod page;
mod paper;
mod rows;
mod storing;
mod sweeps;

pub use measuring::measure;
pub use page::page;
pub use rows::{COUNTS, DataSet, Form, POLYLINES, Row, StorageTable, Stored};
pub use sweeps::{SWEEPS, Setting, Sweep};

use super::files;
use crate::error::Result;
use crate::output::Batch;

/// The version of the layout of `tables.json` and of the columns of `tables.csv`.
pub const TABLES_SCHEMA: u32 = 1;

/// The paper's scene, generated: a scene file.
pub const SCENES: [&str; 1] = [include_str!("counties.toml")];

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

impl Tables {
    /// The tables of some data sets.
    pub fn of(data_sets: Vec<DataSet>, repeat: u32) -> Self {
        Self { schema: TABLES_SCHEMA, paper: "wartell", repeat, data_sets }
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
        let head = "data_set,polylines,line_points,varied,setting,mesh_ms,walk_ms,first_frame_ms,frame_ms,frame_ms_min,frame_ms_max,triangles,\
                    vertices,deviation_m,deviation_px,changed_pixels,";
        let mut text = head.to_owned() + &COUNTS.join(",") + "\n";
        for set in &self.data_sets {
            for row in &set.rows {
                let escaped = super::super::table::escaped;
                let mut cells = vec![
                    escaped(&set.scene.name),
                    set.polylines.to_string(),
                    set.points.to_string(),
                    row.varied.into(),
                    escaped(row.setting),
                    row.mesh_ms.median.to_string(),
                    row.walk_ms.median.to_string(),
                    row.first_frame_ms.to_string(),
                    row.frame_ms.median.to_string(),
                    row.frame_ms.min.to_string(),
                    row.frame_ms.max.to_string(),
                    row.triangles.to_string(),
                    row.vertices.to_string(),
                    row.deviation_m.to_string(),
                    row.deviation_px.to_string(),
                    row.changed_pixels.to_string(),
                ];
                cells.extend(COUNTS.map(|name| row.count(name).to_string()));
                text.push_str(&(cells.join(",") + "\n"));
            }
        }
        text
    }
}

#[cfg(test)]
mod tests;
