//! What is measured of a scene.

use super::amounts::{Amounts, Groups};
use super::thesis::Study;
use crate::measure::Times;
use crate::output::SceneResult;
use std::collections::BTreeMap;

/// A data set.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct DataSet {
    /// The scene.
    pub scene: SceneResult,
    /// Cells a side of its decal grid.
    pub grid: u32,
    /// The picture's width in pixels.
    pub width: usize,
    /// Its height.
    pub height: usize,
    /// Tables 5.1 and 5.2.
    pub amounts: Amounts,
    /// Table 5.3.
    pub groups: Groups,
    /// The thesis's study of that name; only of the generated ones.
    pub thesis: Option<Study>,
    /// What was measured.
    pub rows: Vec<Row>,
}

/// A measurement.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Row {
    /// The thesis's figure.
    pub figure: &'static str,
    /// Which part of the scene, drawn how.
    pub decals: &'static str,
    /// What is varied, by name.
    pub factors: BTreeMap<&'static str, f64>,
    /// Bytes of structures; of dynamic lines with their lists of pixels as the thesis lays them out.
    pub memory_bytes: u64,
    /// Milliseconds to build what does not depend on the view.
    pub update_ms: Times,
    /// Milliseconds of a frame.
    pub render_ms: Times,
    /// What a frame looked at: nodes, edges, segments, entries of lists.
    pub work: u64,
}
