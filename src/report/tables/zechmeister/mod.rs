//! The tables and figures of Zechmeister 2020, chapter 5, measured anew: what the data has (Tables 5.1 to 5.3), what memory, preparing and drawing
//! take while one thing is varied (Figs. 5.5 to 5.17), and whether they grow or shrink as the thesis found (Table 5.4).
//!
//! Input: data sets, each an opened scene ([`measure()`]); without scenes those of [`SCENES`], generated in the likeness of the thesis's. Output:
//! [`Tables`], as `tables.json`, `tables.csv` and a page. Refuses: a scene without polygons, lines and outlines.
//!
//! Memory is bytes of structures, and work counts what frames look at: they are the same in every run. Times are this machine's.

mod amounts;
mod bench;
mod decals;
mod figures;
mod page;
mod rows;
mod thesis;
mod trends;

pub use amounts::{Amount, Amounts, Groups, amounts, groups};
pub use figures::{FIGURES, Figure};
pub use page::page;
pub use rows::{DataSet, Row};
pub use thesis::{STUDIES, Study, study_of};
pub use trends::{METRICS, Sign, Trend, trends};

use super::files;
use crate::error::{Error, Result};
use crate::measure::Watch;
use crate::open::Opened;
use crate::output::Batch;
use bench::Bench;

/// The version of the layout of `tables.json` and of the columns of `tables.csv`.
pub const TABLES_SCHEMA: u32 = 1;

/// Scene files in the likeness of the thesis's studies, in its order; each has a fiftieth of the data.
pub const SCENES: [&str; 8] = [
    include_str!("il.toml"),
    include_str!("osm.toml"),
    include_str!("wachau.toml"),
    include_str!("graz.toml"),
    include_str!("rll.toml"),
    include_str!("sa.toml"),
    include_str!("fa.toml"),
    include_str!("rc.toml"),
];

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
    /// Table 5.4.
    pub trends: Vec<Trend>,
}

/// Measures a scene, each thing `repeat` times (at least once): all figures, or of a generated study those that the thesis has of it.
///
/// # Errors
/// When the scene has nothing to measure; internal errors.
pub fn measure(scene: Opened, is_generated: bool, repeat: u32, watch: &dyn Watch) -> Result<DataSet> {
    let Opened { text, stage } = scene;
    let all = amounts(&stage);
    if all.exterior.decals + all.lines.decals == 0 {
        return Err(Error::new("there are no polygons, lines or outlines to measure").help(
            "give a layer `fill`, `outline` or `line`, or leave the scene out: then there are studies like the thesis's",
        ));
    }
    let name = stage.scene.name.clone();
    let mut bench = Bench { text, stage, repeat, watch, rows: Vec::new() };
    let is_part = |figure: &Figure| {
        !is_generated || figure.studies.is_empty() || figure.studies.contains(&name.as_str())
    };
    figures::run(&mut bench, is_part)?;
    Ok(bench.data_set(study_of(&name).filter(|_| is_generated).copied()))
}

impl Tables {
    /// The tables of some data sets.
    pub fn of(data_sets: Vec<DataSet>, repeat: u32) -> Self {
        let trends = trends(&data_sets);
        Self { schema: TABLES_SCHEMA, paper: "zechmeister", repeat, data_sets, trends }
    }

    /// Writes `tables.html`, `tables.csv` and `tables.json`; they are in their places when it returns.
    ///
    /// # Errors
    /// When a file cannot be written: then none is.
    pub fn write(&self, batch: Batch) -> Result<()> {
        files::write(batch, &page(self), &self.to_csv(), &files::json(self)?)
    }

    /// The text of `tables.csv`: a row a measurement.
    pub fn to_csv(&self) -> String {
        let head = "data_set,figure,decals,factors,memory_bytes,update_ms,render_ms,render_ms_min,render_ms_max,work\n";
        let mut text = head.to_owned();
        for set in &self.data_sets {
            for row in &set.rows {
                let factors: Vec<String> =
                    row.factors.iter().map(|(name, value)| format!("{name}={value}")).collect();
                let cells = [
                    super::super::table::escaped(&set.scene.name),
                    row.figure.into(),
                    row.decals.into(),
                    factors.join(" "),
                    row.memory_bytes.to_string(),
                    row.update_ms.median.to_string(),
                    row.render_ms.median.to_string(),
                    row.render_ms.min.to_string(),
                    row.render_ms.max.to_string(),
                    row.work.to_string(),
                ];
                text.push_str(&(cells.join(",") + "\n"));
            }
        }
        text
    }
}

#[cfg(test)]
mod tests;
