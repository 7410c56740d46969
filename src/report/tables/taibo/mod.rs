//! The tables of Taibo et al. 2014, section 5, measured anew: memory, generation and rendering of each solution on data sets of the
//! paper's three kinds, and what a change of the width takes.
//!
//! Input: data sets, each an opened scene ([`measure()`] runs every [`Variant`] and [`WidthChange`] on it). Output: [`Tables`], as
//! `tables.json`, `tables.csv` and a page. Refuses: a scene without lines and outlines.

mod measuring;
mod page;

pub use measuring::measure;
pub use page::page;

use super::files;
use crate::error::Result;
use crate::measure::Times;
use crate::output::{Batch, SceneResult};

/// The version of the layout of `tables.json` and of the columns of `tables.csv`.
pub const TABLES_SCHEMA: u32 = 1;

/// The paper's data sets, generated: scene files.
pub const DATA_SETS: [&str; 3] =
    [include_str!("cadastre.toml"), include_str!("rivers.toml"), include_str!("paths.toml")];

/// A solution as it is measured: a strategy alone, or together with line primitives for what is thin (Algorithm 2).
#[derive(Debug, Clone, Copy)]
pub struct Variant {
    /// The solution's name in the scene file.
    pub solution: &'static str,
    /// Whether thin lines are drawn otherwise.
    pub is_combined: bool,
    /// Changes of the scene file.
    pub changes: &'static [&'static str],
}

macro_rules! variant {
    ($name:literal, combined) => {
        Variant {
            solution: $name,
            is_combined: true,
            changes: &[concat!("technique.clipmap.solution=", $name)],
        }
    };
    ($name:literal, threshold = $threshold:literal) => {
        Variant {
            solution: $name,
            is_combined: false,
            changes: &[
                concat!("technique.clipmap.solution=", $name),
                concat!("technique.clipmap.threshold_texels=", $threshold),
                // What is too wide for a line primitive would cost nothing.
                "technique.clipmap.wide_lines=clamp",
            ],
        }
    };
}

/// What is measured: the solutions as they are, then the strategies of 3b and 4 alone, whatever the width.
pub const VARIANTS: [Variant; 9] = [
    variant!("1-lines", threshold = "0"),
    variant!("2-polygons", threshold = "0"),
    variant!("3a-both", combined),
    variant!("3b-wireframe", combined),
    variant!("4a-adjacency", combined),
    variant!("4b-offsets", combined),
    variant!("3b-wireframe", threshold = "1e9"),
    variant!("4a-adjacency", threshold = "0"),
    variant!("4b-offsets", threshold = "0"),
];

/// A way to change the width of lines that are kept (5.1).
#[derive(Debug, Clone, Copy)]
pub struct WidthChange {
    /// What it is.
    pub name: &'static str,
    /// Changes of the scene file that make it so.
    pub changes: &'static [&'static str],
}

/// All of them; with joints of method 3b, lines have to be kept beside the polygons.
pub const WIDTH_CHANGES: [WidthChange; 3] = [
    WidthChange {
        name: "lines, or tessellated on the fly (1, 4a, 4b): a number is set",
        changes: &["technique.clipmap.solution=4a-adjacency"],
    },
    WidthChange {
        name: "methods 1, 2, 3a: pairs are scaled about their middles",
        changes: &["technique.clipmap.solution=3a-both", "technique.clipmap.joints=method-3a-strip"],
    },
    WidthChange {
        name: "method 3b: tessellated anew from the lines",
        changes: &["technique.clipmap.solution=3a-both", "technique.clipmap.joints=algorithm-1"],
    },
];

/// All data sets.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Tables {
    /// [`TABLES_SCHEMA`].
    pub schema: u32,
    /// How many times each thing was timed.
    pub repeat: u32,
    /// The data sets.
    pub data_sets: Vec<DataSet>,
}

/// A data set.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct DataSet {
    /// The scene.
    pub scene: SceneResult,
    /// Lines and outlined polygons.
    pub features: usize,
    /// Their segments.
    pub segments: usize,
    /// Their vertices.
    pub vertices: usize,
    /// The terrain's area in square kilometres.
    pub area_km2: f64,
    /// The solutions.
    pub solutions: Vec<SolutionRow>,
    /// Changes of the width.
    pub width_changes: Vec<WidthRow>,
}

/// A solution's numbers.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct SolutionRow {
    /// Its name in the scene file.
    pub solution: String,
    /// Whether thin lines are drawn otherwise.
    pub is_combined: bool,
    /// Bytes that are kept of lines and outlines, without fills (Fig. 10).
    pub geometry_bytes: usize,
    /// Bytes of the index that finds a tile's lines, the same for all.
    pub index_bytes: usize,
    /// Milliseconds to make what is kept, and the index (Fig. 11).
    pub generation_ms: Times,
    /// Milliseconds to make all tiles of the clipmap, fills too (Fig. 12).
    pub rendering_ms: Times,
    /// How many tiles that are.
    pub tiles: usize,
    /// Line primitives that were drawn.
    pub line_primitives: u64,
    /// Quadrilaterals that were drawn.
    pub quads: u64,
}

/// What a change of the width takes.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct WidthRow {
    /// How it is done.
    pub name: String,
    /// Milliseconds.
    pub ms: Times,
}

impl DataSet {
    /// The least of a number over all solutions: 100 % of the paper's figures.
    fn best(&self, of: impl Fn(&SolutionRow) -> f64) -> f64 {
        self.solutions.iter().map(of).fold(f64::INFINITY, crate::math::min)
    }
}

impl Tables {
    /// Writes `tables.html`, `tables.csv` and `tables.json`; they are in their places when it returns.
    ///
    /// # Errors
    /// When a file cannot be written: then none is.
    pub fn write(&self, batch: Batch) -> Result<()> {
        files::write(batch, &page(self), &self.to_csv(), &files::json(self)?)
    }

    /// The text of `tables.csv`: a row a solution of a data set.
    pub fn to_csv(&self) -> String {
        let head = "data_set,features,segments,vertices,area_km2,solution,is_combined,geometry_bytes,geometry_percent,\
                    index_bytes,generation_ms,generation_percent,rendering_ms,rendering_percent,tiles,line_primitives,quads\n";
        let mut text = head.to_owned();
        for set in &self.data_sets {
            let percent = |of: &dyn Fn(&SolutionRow) -> f64, row| 100.0 * of(row) / set.best(of);
            for row in &set.solutions {
                let cells = [
                    super::super::table::escaped(&set.scene.name),
                    set.features.to_string(),
                    set.segments.to_string(),
                    set.vertices.to_string(),
                    set.area_km2.to_string(),
                    row.solution.clone(),
                    row.is_combined.to_string(),
                    row.geometry_bytes.to_string(),
                    percent(&|row| row.geometry_bytes as f64, row).to_string(),
                    row.index_bytes.to_string(),
                    row.generation_ms.median.to_string(),
                    percent(&|row| row.generation_ms.median, row).to_string(),
                    row.rendering_ms.median.to_string(),
                    percent(&|row| row.rendering_ms.median, row).to_string(),
                    row.tiles.to_string(),
                    row.line_primitives.to_string(),
                    row.quads.to_string(),
                ];
                text.push_str(&(cells.join(",") + "\n"));
            }
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene_file::{Override, SceneFile};

    #[test]
    fn every_data_set_and_every_change_is_understood() {
        for text in DATA_SETS {
            for changes in VARIANTS.iter().map(|v| v.changes).chain(WIDTH_CHANGES.iter().map(|c| c.changes)) {
                let changes: Vec<Override> = changes.iter().map(|c| Override::parse(c).unwrap()).collect();
                let file = SceneFile::parse(text, None, &changes).unwrap();
                assert!(["cadastre", "rivers", "paths"].contains(&file.name.as_str()));
            }
        }
        let solution = |v: &Variant| v.changes[0] == format!("technique.clipmap.solution={}", v.solution);
        assert!(VARIANTS.iter().all(solution));
    }
}
