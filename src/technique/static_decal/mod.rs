//! Static decals: S. Zechmeister (2020), "Interactive visualization of vector data on heightfields" (the thesis), after Thöny et al. 2017 and
//! Frasson et al. 2018.
//!
//! Input: a [`Stage`]. Output: a picture whose every sample asks the plan which decals hold it:
//! 1. preprocess: a grid of cells with trees of line segments and of polygons' quadtrees (3.2.1, 4.2.1): the room [`decal`](crate::decal);
//! 2. samples: where they lie in the pixel (4.5), what they see, where that is in the plan (`frame`; 3.4.1);
//! 3. search and composition, from the front until nothing more shows (Algorithm 3.5).
//!
//! The structures can be asked for as buffers (`structures`; Fig. 4.2): then all cells are built.
//!
//! Where the thesis is silent, see `docs/semantics.md`. Refuses: scenes with widths in pixels (those are dynamic lines).

mod analytic;
mod frame;
mod step;
mod structures;
mod sweep;
#[cfg(test)]
mod tests;

pub use crate::decal::{Edges, Hierarchy, Joins, LeafPolygons, Outlines, Overlaps, Preparation, Settings};
pub use step::Step;

use super::{Contradiction, Declaration, Explanation, Frame, FrameOptions, Parameters, Prepared};
use crate::buffer::{Look, PlaneKind};
use crate::canvas::SamplePattern;
use crate::decal::Decals;
use crate::error::{Error, Result};
use crate::scene::{Line, Precision, StrokeForm, TechniqueSettings};
use crate::space::ViewFrame;
use crate::stage::Stage;

/// The technique, said once.
pub const DECLARATION: Declaration = Declaration {
    parameters: Parameters::of::<Settings>(),
    further: &[],
    paper: "Zechmeister 2020, \"Interactive visualization of vector data on heightfields\", after Thöny et al. 2017 and Frasson et al. 2018.",
    title: "Static decals (Zechmeister, after Thöny and Frasson)",
    contradiction,
    planes: &[
        PlaneKind::structure("grid").in_plan(),
        PlaneKind::structure("cells"),
        PlaneKind::structure("line-nodes"),
        PlaneKind::structure("line-boxes").in_plan(),
        PlaneKind::structure("segments"),
        PlaneKind::structure("polygon-nodes"),
        PlaneKind::structure("polygon-boxes").in_plan(),
        PlaneKind::structure("polygons"),
        PlaneKind::structure("areas"),
        PlaneKind::structure("ring-parts"),
        PlaneKind::structure("rings"),
        PlaneKind::structure("quadtree-boxes").in_plan(),
        PlaneKind::structure("quadtree-nodes"),
        PlaneKind::structure("quadtree-leaves"),
        PlaneKind::structure("quadtree-edges"),
        PlaneKind::structure("decal-vertices").in_plan(),
        PlaneKind::structure("items"),
        PlaneKind::structure("styles"),
        PlaneKind::structure("style-values"),
        PlaneKind::DEPTH,
        PlaneKind::TRIANGLE,
        PlaneKind::PLAN,
        PlaneKind::COLOR,
        PlaneKind::new("cell", Look::Number),
        PlaneKind::new("nodes", Look::Count),
        PlaneKind::new("tests", Look::Count),
        PlaneKind::ID,
        PlaneKind::ID_STARTS,
        PlaneKind::IDS,
    ],
    client: include_str!("client.md"),
    stroke_form,
    sweep: sweep::SWEEP,
    applies,
    prepare: |stage, progress| Ok(Box::new(Prepare::new(stage, progress)?)),
};

fn contradiction(said: &TechniqueSettings) -> Option<Contradiction> {
    let Settings { edges, leaf_polygons, .. } = said.get();
    let is_blind = edges == Edges::Analytic && leaf_polygons == LeafPolygons::Clipped;
    is_blind.then(|| Contradiction {
        parameter: "leaf_polygons",
        what: "leaves that are clipped do not know the border that edges = \"analytic\" measures from".into(),
        help: "use leaf_polygons = \"corner\"".into(),
    })
}

/// As decals have it.
fn stroke_form(said: &TechniqueSettings, line: &Line) -> StrokeForm {
    said.get::<Settings>().stroke_form(line)
}

/// The technique with its structures built, or ready to be built where a frame needs them.
#[derive(Debug)]
pub struct Prepare<'s> {
    stage: &'s Stage,
    settings: Settings,
    pattern: SamplePattern,
    decals: Decals<'s>,
}

impl<'s> Prepare<'s> {
    /// Indexes the scene's items, and builds all cells if they are asked for beforehand; `progress` is told the share that is done.
    ///
    /// # Errors
    /// When the technique does not draw such a scene.
    pub fn new(stage: &'s Stage, progress: &(dyn Fn(f64) + Sync)) -> Result<Self> {
        applies(stage)?;
        let settings: Settings = stage.scene.technique.get();
        let pattern = if settings.edges == Edges::Analytic { 1 } else { settings.samples };
        let pattern = SamplePattern::of(pattern).unwrap_or(SamplePattern::Grid(1));
        let is_single = stage.scene.device.precision == Precision::F32;
        let bounds = stage.mesh.plan_bounds();
        let decals = Decals::new(&stage.draw_list, &bounds, &settings, is_single, progress);
        Ok(Self { stage, settings, pattern, decals })
    }

    /// The structures.
    pub fn decals(&self) -> &Decals<'s> {
        &self.decals
    }
}

/// Whether the technique can draw the scene.
///
/// # Errors
/// The reason why it cannot.
pub fn applies(stage: &Stage) -> Result<()> {
    match stage.scene.layers.iter().find(|layer| layer.has_width_in_pixels()) {
        Some(layer) => Err(Error::unsupported(format!(
            "static-decal draws widths in metres, layer `{}` has width_px",
            layer.name
        ))
        .help("give the layer width_m, or use dynamic-line")),
        None => Ok(()),
    }
}

impl Prepared for Prepare<'_> {
    fn frame(&self, view: &ViewFrame, options: &FrameOptions) -> Result<Frame> {
        frame::draw(self, view, options)
    }

    fn steps(&self, view: &ViewFrame, pixel: [usize; 2]) -> Result<Explanation> {
        let (steps, code) = frame::explain(self, view, pixel);
        Ok(Explanation::new(steps, code))
    }

    fn structure_bytes(&self) -> usize {
        self.decals.memory().bytes()
    }
}
