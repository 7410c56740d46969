//! Inverse projection: J. She, X. Tan, X. Guo, J. Tan, J. Liu (2016), "Rendering 2D lines on 3D terrain model with
//! optimization in visual quality and running performance", Transactions in GIS.
//!
//! Input: a [`Stage`]. Output: a picture whose every pixel asks the plan for its colour:
//! 1. preprocess: lines are expanded to polygons of edges with normals (`expansion`, 3.1);
//! 2. the depth buffer gives each pixel a quadrilateral in the plan (`quadrilateral`, 3.2);
//! 3. pixels are N (no area), F (wholly in areas) or P (an edge meets the quadrilateral) (`frame`, 3.3);
//! 4. P pixels take n x n samples, bilinear in the quadrilateral (3.4), judged by edge normals (`judgment`, 3.5)
//!    and averaged.
//!
//! Where the paper is silent:
//! - A pixel that sees the sky is sky. A pixel whose quadrilateral has a corner in the sky, or spans a silhouette (a side
//!   longer than `SILHOUETTE_RATIO` times what both its ends would make of it), has no meaningful range in the plan: it takes
//!   one sample at its own centre and is counted in `refused`. `silhouette = "smear"` uses such a quadrilateral all the same
//!   when its corners see terrain.
//! - At the image's border the neighbours' centres lie outside the picture; they are looked at all the same (a guard band of one pixel).
//! - An F pixel needs no sample; which areas contain it is asked once, at its centre's plan point.
//! - Overlapping features are composed in draw order at each sample; the terrain's colour is that of the pixel's triangle.
//!
//! Refuses: scenes with widths in pixels (3.1: "a geo-referenced line has been adopted").

mod edge_index;
mod expansion;
mod frame;
mod judgment;
mod quadrilateral;

use super::{Frame, FrameOptions, Prepared};
use crate::error::{Error, Result};
use crate::scene::InverseProjection;
use crate::scene::file::Named;
use crate::space::ViewFrame;
use crate::stage::Stage;
use edge_index::EdgeIndex;
use expansion::Areas;

/// The technique with its index built.
#[derive(Debug)]
pub struct Prepare<'s> {
    stage: &'s Stage,
    settings: InverseProjection,
    index: EdgeIndex,
}

impl<'s> Prepare<'s> {
    /// Expands lines and builds the index of edges.
    ///
    /// # Errors
    /// When a layer's width is in pixels.
    pub fn new(stage: &'s Stage) -> Result<Self> {
        applies(stage)?;
        let areas = Areas::of_layers(&stage.scene.layers);
        if areas.edges.len() > u32::MAX as usize / 2 {
            return Err(
                Error::new("more edges than this program can number").help("give the terrain a `window`")
            );
        }
        let index = EdgeIndex::new(areas, &stage.mesh.plan_bounds());
        Ok(Self { stage, settings: stage.scene.technique.inverse_projection, index })
    }
}

/// Whether the technique can draw the scene.
///
/// # Errors
/// The reason why it cannot.
pub fn applies(stage: &Stage) -> Result<()> {
    match stage.scene.layers.iter().find(|layer| layer.has_width_in_pixels()) {
        None => Ok(()),
        Some(layer) => Err(Error::new(format!(
            "inverse-projection draws widths in metres (She 3.1), layer `{}` has width_px",
            layer.name
        ))
        .help("give the layer width_m, or leave the technique out")),
    }
}

impl Prepared for Prepare<'_> {
    fn frame(&self, view: &ViewFrame, options: &FrameOptions) -> Result<Frame> {
        Ok(frame::draw((self.stage, view), &self.settings, &self.index, options))
    }

    fn structure_bytes(&self) -> usize {
        self.index.bytes()
    }

    fn parameters(&self) -> Vec<(&'static str, String)> {
        vec![
            ("samples", self.settings.samples.to_string()),
            ("corners", self.settings.corners.word().into()),
            ("point_in_polygon", self.settings.point_in_polygon.word().into()),
            ("silhouette", self.settings.silhouette.word().into()),
        ]
    }

    fn buffer_names(&self) -> &'static [&'static str] {
        &["depth", "triangle", "plan", "quad", "class", "edges", "color"]
    }
}
