//! Analytic coverage (ours): each pixel's mean colour from the areas of polygons, without samples.
//!
//! Input: a [`Stage`]. Output: a picture. Within one triangle the map from the plan to the screen is a homography, so a straight border stays
//! straight and what a pixel shows is a matter of areas:
//! 1. preprocess: runs of edges and segments in trees of boxes (`features`);
//! 2. fragments: each pixel is cut into the convex parts of triangles that it sees (`gather`, `sheet`);
//! 3. N, P, F: which items cover nothing, some or all of what a tile, a block and a fragment see of the plan (`near`, `items`); what is opaque and covers
//!    all ends the search;
//! 4. P: the areas of each set of items in closed form (`coverage`), strokes as convex pieces (`pieces`); the mean of the composed paints.
//!
//! Pixels with more fragments or edges than the settings allow are sampled, and counted. Refuses: nothing that can be drawn.

mod boxes;
mod cells;
mod convex;
mod coverage;
mod facet;
mod features;
mod frame;
mod gather;
mod items;
mod look;
mod near;
mod pieces;
mod samples;
mod settings;
mod sheet;
mod step;
mod sweep;
mod texels;
mod tile;

pub use coverage::Class;
pub use settings::Settings;
pub use step::{Fallback, Step};

use super::{Declaration, Explanation, Frame, FrameOptions, Parameters, Prepared};
use crate::buffer::{Look, PlaneKind};
use crate::error::{Error, Result};
use crate::scene::StrokeForm;
use crate::space::ViewFrame;
use crate::stage::Stage;
use features::Features;

/// The technique, said once.
pub const DECLARATION: Declaration = Declaration {
    parameters: Parameters::of::<Settings>(),
    further: &[],
    paper: "Ours.",
    title: "Analytic coverage: areas in closed form (ours)",
    contradiction: |_| None,
    planes: &[
        PlaneKind::DEPTH,
        PlaneKind::TRIANGLE,
        PlaneKind::PLAN,
        PlaneKind::new("fragments", Look::Count),
        PlaneKind::new("class", Look::Number),
        PlaneKind::new("edges", Look::Count),
        PlaneKind::new("fallback", Look::Number),
        PlaneKind::COLOR,
        PlaneKind::ID,
        PlaneKind::ID_STARTS,
        PlaneKind::IDS,
    ],
    client: include_str!("client.md"),
    stroke_form: |_, line| StrokeForm::of_style(line),
    sweep: sweep::SWEEP,
    applies,
    prepare: |stage, _| Ok(Box::new(Prepare::new(stage)?)),
};

/// The technique with its structures built.
#[derive(Debug)]
pub struct Prepare<'s> {
    stage: &'s Stage,
    settings: Settings,
    features: Features<'s>,
}

impl<'s> Prepare<'s> {
    /// Indexes the scene's items.
    ///
    /// # Errors
    /// When the technique does not draw such a scene.
    pub fn new(stage: &'s Stage) -> Result<Self> {
        applies(stage)?;
        let settings = stage.scene.technique.get();
        Ok(Self { stage, settings, features: Features::new(&stage.draw_list) })
    }
}

/// Whether the technique can draw the scene.
///
/// # Errors
/// The reason why it cannot.
pub fn applies(stage: &Stage) -> Result<()> {
    let in_pixels = || stage.scene.layers.iter().find(|layer| layer.has_width_in_pixels());
    match stage.mesh.globe().and_then(|_| in_pixels()) {
        None => Ok(()),
        Some(layer) => Err(Error::unsupported(format!(
            "analytic measures widths in pixels in the plan, and on a globe they are measured on the ground: layer `{}` has width_px",
            layer.name
        ))
        .help("give the layer width_m, or leave the technique out")),
    }
}

impl Prepared for Prepare<'_> {
    fn frame(&self, view: &ViewFrame, options: &FrameOptions) -> Result<Frame> {
        Ok(frame::draw(self, view, options))
    }

    fn steps(&self, view: &ViewFrame, pixel: [usize; 2]) -> Result<Explanation> {
        let (steps, code) = frame::explain(self, view, pixel);
        Ok(Explanation::new(steps, code))
    }

    fn structure_bytes(&self) -> usize {
        self.features.bytes()
    }
}
