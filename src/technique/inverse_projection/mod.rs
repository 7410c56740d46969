//! Inverse projection: J. She, X. Tan, X. Guo, J. Tan, J. Liu (2016), "Rendering 2D lines on 3D terrain model with
//! optimization in visual quality and running performance", Transactions in GIS.
//!
//! Input: a [`Stage`]. Output: a picture whose every pixel asks the plan for its colour:
//! 1. preprocess: lines are expanded to polygons of edges with normals (`expansion`, 3.1);
//! 2. the depth buffer gives each pixel a quadrilateral in the plan (`quadrilateral`, 3.2);
//! 3. pixels are N (no area), F (wholly in areas) or P (an edge meets the quadrilateral) (`pixel`, 3.3);
//! 4. P pixels take n x n samples, bilinear in the quadrilateral (`samples`, 3.4), judged by edge normals (`judgment`, 3.5)
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
mod pixel;
mod quadrilateral;
mod samples;
mod settings;
mod step;
mod structures;
mod sweep;
mod touched;

pub use expansion::AreaId;
pub use settings::{Corners, PointInPolygon, Settings, Silhouette};
pub use step::{EdgeOf, PixelClass, Refusal, Step};

use super::{Declaration, Explanation, Frame, FrameOptions, Parameters, Prepared};
use crate::buffer::{Look, PlaneKind};
use crate::error::{Error, Result};
use crate::parameter::Named;
use crate::scene::{Cap, Line, StrokeForm, TechniqueSettings};
use crate::space::ViewFrame;
use crate::stage::Stage;
use edge_index::EdgeIndex;

/// The technique, said once.
pub const DECLARATION: Declaration = Declaration {
    parameters: Parameters::of::<Settings>(),
    further: &[],
    paper: "She et al. 2016, \"Rendering 2D lines on 3D terrain model\".",
    title: "Inverse projection (She)",
    contradiction: |_| None,
    planes: &[
        PlaneKind::structure("areas"),
        PlaneKind::structure("area-edges").in_plan(),
        PlaneKind::structure("edge-areas"),
        PlaneKind::structure("edge-sides"),
        PlaneKind::DEPTH,
        PlaneKind::TRIANGLE,
        PlaneKind::PLAN,
        PlaneKind::new("quad", Look::Place).in_plan(),
        PlaneKind::new("class", Look::Class),
        PlaneKind::new("edges", Look::Count),
        PlaneKind::ID,
        PlaneKind::ID_STARTS,
        PlaneKind::IDS,
        PlaneKind::COLOR,
    ],
    client: include_str!("client.md"),
    stroke_form,
    sweep: sweep::SWEEP,
    applies,
    prepare: |stage, _| Ok(Box::new(Prepare::new(stage)?)),
};

/// Fig. 4: mitres and flat ends.
fn stroke_form(_said: &TechniqueSettings, line: &Line) -> StrokeForm {
    let cap = if line.cap == Cap::Square { line.cap } else { Cap::Butt };
    StrokeForm { join: "miter", miter_limit: Some(expansion::MITER_LIMIT), cap: cap.word() }
}

/// The technique with its index built.
#[derive(Debug)]
pub struct Prepare<'s> {
    stage: &'s Stage,
    settings: Settings,
    index: EdgeIndex<'s>,
}

impl<'s> Prepare<'s> {
    /// Expands lines and builds the index of edges.
    ///
    /// # Errors
    /// When a layer's width is in pixels, or there are more edges than can be numbered.
    pub fn new(stage: &'s Stage) -> Result<Self> {
        applies(stage)?;
        let index = EdgeIndex::new(&stage.draw_list, &stage.mesh.plan_bounds())?;
        Ok(Self { stage, settings: stage.scene.technique.get(), index })
    }

    /// The steps of a pixel (column, row) of a view's picture, and its code values; see [`super::explain`].
    pub fn steps_of(&self, view: &ViewFrame, pixel: [usize; 2]) -> (Vec<Step>, [u8; 4]) {
        frame::explain((self.stage, view), &self.settings, &self.index, &[pixel]).pop().unwrap_or_default()
    }
}

/// Whether the technique can draw the scene.
///
/// # Errors
/// The reason why it cannot.
pub fn applies(stage: &Stage) -> Result<()> {
    match stage.scene.layers.iter().find(|layer| layer.has_width_in_pixels()) {
        None => Ok(()),
        Some(layer) => Err(Error::unsupported(format!(
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

    fn steps(&self, view: &ViewFrame, pixel: [usize; 2]) -> Result<Explanation> {
        let (steps, code) = self.steps_of(view, pixel);
        Ok(Explanation::new(steps, code))
    }

    fn steps_of_all(&self, view: &ViewFrame, pixels: &[[usize; 2]]) -> Result<Vec<Explanation>> {
        let all = frame::explain((self.stage, view), &self.settings, &self.index, pixels);
        Ok(Explanation::all(all))
    }

    fn structure_bytes(&self) -> usize {
        self.index.bytes()
    }
}
