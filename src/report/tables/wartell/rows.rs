//! What is measured of a scene: frames, and what its lines take in storage.
//!
//! Input: numbers. Output: [`DataSet`]. Refuses: nothing.

use crate::measure::Times;
use crate::output::SceneResult;
use std::collections::BTreeMap;

/// The name of the rows of Table 1 among what is varied.
pub const POLYLINES: &str = "polylines";

/// What frames count, by the technique's names.
pub const COUNTS: [&str; 11] = [
    "quads",
    "borrowed_quads",
    "clippings_visited",
    "clippings_tested",
    "clippings_drawn",
    "primitives",
    "points",
    "points_drawn",
    "segments",
    "fragments",
    "fragments_drawn",
];

/// A scene with all that was measured of it.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct DataSet {
    /// The scene.
    pub scene: SceneResult,
    /// Pixels a row of its picture.
    pub width: usize,
    /// Rows of its picture.
    pub height: usize,
    /// Columns and rows of its terrain's posts.
    pub posts: [usize; 2],
    /// Lines and rings that are drawn as lines.
    pub polylines: usize,
    /// Their points.
    pub points: usize,
    /// Storage (3.3).
    pub storage: StorageTable,
    /// Table 1: with polylines and without them; then the sweeps.
    pub rows: Vec<Row>,
}

/// A setting's numbers.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Row {
    /// What is varied.
    pub varied: &'static str,
    /// Its value in words.
    pub setting: &'static str,
    /// Milliseconds to make the view's mesh.
    pub mesh_ms: Times,
    /// Milliseconds of the walks along the clippings over it, which a frame takes too.
    pub walk_ms: Times,
    /// Milliseconds of the first frame, which makes the structures of its quads.
    pub first_frame_ms: f64,
    /// Milliseconds of a frame after it, its mesh made before.
    pub frame_ms: Times,
    /// Triangles of the mesh.
    pub triangles: usize,
    /// Vertices of the mesh.
    pub vertices: usize,
    /// How far the mesh may be from the full surface, metres.
    pub deviation_m: f64,
    /// The same in pixels of the view.
    pub deviation_px: f64,
    /// What the last frame counted ([`COUNTS`]).
    pub counts: BTreeMap<&'static str, u64>,
    /// Pixels that differ from the picture of the first setting.
    pub changed_pixels: usize,
}

/// What lines take in storage (3.3).
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct StorageTable {
    /// Triangles that cover a point of a quad: one of each layer.
    pub covering_triangles: u32,
    /// Milliseconds until all lines are there in columns and rows of posts.
    pub index_ms: Times,
    /// The quad that holds all.
    pub root: Stored,
    /// All quads that lines cross, of every level.
    pub all: Stored,
}

/// What quads take.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Stored {
    /// How many.
    pub quads: usize,
    /// Milliseconds to make their triangle-clipping DAGs from the indexed lines.
    pub build_ms: Times,
    /// Vertices and crossings, each once a quad.
    pub points: u64,
    /// Points of all triangle clippings.
    pub clipping_points: u64,
    /// Triangle clippings.
    pub clippings: u64,
    /// In the paper's forms: the one that it measured, then with projectors, with the two finest layers, with both.
    pub forms: [Form; 4],
    /// Bytes that are held here: points once, in double precision, all layers.
    pub held_bytes: u64,
}

/// A form of storage.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Form {
    /// How points are stored.
    pub points: &'static str,
    /// Which layers are stored of a quad that is no root.
    pub layers: &'static str,
    /// Bytes of coordinates.
    pub coordinate_bytes: u64,
    /// Bytes of the rest.
    pub topology_bytes: u64,
    /// How many times as much the first form takes.
    pub factor: f64,
}

impl DataSet {
    /// The rows over what is varied.
    pub fn of(&self, varied: &str) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(move |row| row.varied == varied)
    }
}

impl Row {
    /// What the last frame counted.
    pub fn count(&self, name: &str) -> u64 {
        self.counts.get(name).copied().unwrap_or(0)
    }

    /// The share of fragments that the depth test kept.
    pub fn survival(&self) -> f64 {
        self.count("fragments_drawn") as f64 / self.count("fragments").max(1) as f64
    }
}

impl Form {
    /// Bytes of all.
    pub fn bytes(&self) -> u64 {
        self.coordinate_bytes + self.topology_bytes
    }

    /// The share of coordinates.
    pub fn coordinate_share(&self) -> f64 {
        self.coordinate_bytes as f64 / self.bytes().max(1) as f64
    }
}
