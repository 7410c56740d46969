//! What a vector file holds, for people.

use super::attributes::Wanted;
use super::collector::{Collector, is_drawable};
use super::column_summary::ColumnSummary;
use super::{VectorFormat, geopackage, read_collected};
use crate::crs::Crs;
use crate::error::Result;
use crate::scene::{Feature, Shape};
use crate::space::PlanBox;
use std::path::Path;

/// What a vector file, or one layer of it, holds.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct VectorSummary {
    /// The format.
    pub format: VectorFormat,
    /// The layer's name, in a GeoPackage.
    pub layer: Option<String>,
    /// All layers with polygons or lines, in a GeoPackage.
    pub layers: Vec<String>,
    /// Features in the file, with those that are not drawn.
    pub features: usize,
    /// (Multi-)polygons that can be drawn: those with a ring of 3 vertices or more.
    pub polygons: usize,
    /// (Multi-)lines that can be drawn: those with a part of 2 vertices or more.
    pub lines: usize,
    /// (Multi-)points.
    pub points: usize,
    /// Rings of polygons, parts of lines, and (multi-)points.
    pub parts: usize,
    /// Coordinates of polygons and lines as stored, closing vertices counted.
    pub vertices: usize,
    /// The box around polygons and lines, in the file's coordinates.
    pub bounds: PlanBox,
    /// The CRS the file states.
    pub crs: Option<Crs>,
    /// What is wrong with the CRS the file states, where it cannot be used.
    pub crs_not_read: Option<String>,
    /// Its columns of attributes, in the file's order.
    pub columns: Vec<ColumnSummary>,
    /// What the user should know.
    pub notes: Vec<String>,
}

/// What a vector file holds: one summary, or one for each layer of a GeoPackage.
///
/// # Errors
/// As [`super::read`].
pub fn describe(path: &Path) -> Result<Vec<VectorSummary>> {
    describe_layers(path).map_err(|e| e.in_file(path))
}

fn describe_layers(path: &Path) -> Result<Vec<VectorSummary>> {
    if super::is_archive(path)? || super::format_of(path)? != VectorFormat::GeoPackage {
        let (format, found) = read_collected(path, None, Wanted::Summary)?;
        return Ok(vec![summary(format, None, &[], found)]);
    }
    let layers = geopackage::layer_names(path)?;
    let one = |layer: &String| {
        let (format, found) = read_collected(path, Some(layer), Wanted::Summary)?;
        Ok(summary(format, Some(layer.clone()), &layers, found))
    };
    layers.iter().map(one).collect()
}

fn summary(
    format: VectorFormat,
    layer: Option<String>,
    layers: &[String],
    found: Collector,
) -> VectorSummary {
    let is_drawn = |f: &&Feature| f.shape.parts().any(|part| is_drawable(&f.shape, part));
    let drawn =
        |is: fn(&Shape) -> bool| found.features.iter().filter(is_drawn).filter(|f| is(&f.shape)).count();
    let doubts = found.crs.as_ref().map(|crs| super::doubts(crs, &found.features));
    let parts = || found.features.iter().flat_map(|f| f.shape.parts());
    VectorSummary {
        format,
        layer,
        layers: layers.to_vec(),
        features: found.seen,
        polygons: drawn(Shape::is_area),
        lines: drawn(|shape| matches!(shape, Shape::Line(_))),
        points: drawn(|shape| matches!(shape, Shape::Points(_))),
        parts: parts().count(),
        vertices: found.stored_vertices,
        bounds: PlanBox::around(parts().flatten().copied()),
        crs: found.crs,
        crs_not_read: found.crs_not_read,
        columns: found.attributes.into_summaries(),
        notes: found.notes.into_iter().chain(doubts.into_iter().flatten()).collect(),
    }
}
