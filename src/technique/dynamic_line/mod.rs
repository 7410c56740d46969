//! Dynamic lines: J. Zechmeister (2020), "Real-time visualization of large-scale vector data on heightfields", master's thesis: lines whose widths are in
//! pixels.
//!
//! Input: a [`Stage`]. Output: a picture whose pixels have lists of the lines that cover them:
//! 1. preprocessing: segments are divided and put on the terrain (`matching`, 3.2.2, 4.2.2);
//! 2. dynamic update of each view: vertices in one pixel go, what lies beside the frustum goes (`update`, `simplify`, 3.3.1, 4.3.1);
//!    a box around each segment is projected (`segment_box`), the pixels that it covers are tested (`in_line`) and have the line put into their
//!    lists (`lists`, 3.3.2, 4.3.2); lists are sorted (`lists`, 3.3.3, 4.3.3);
//! 3. rendering: each pixel's list is composed (`tile`, 3.4.2, 4.4.2), the finished picture is smoothed (`fxaa`, 3.5, 4.5).
//!
//! The default is what the thesis does; its failures (Figs. 3.7a, 4.4a, 4.9b) and what it leaves open are settings. Where it is silent, see these files and
//! `docs/semantics.md`.
//!
//! Refuses: scenes without a width in pixels, scenes that have widths in metres or fills beside them, terrains that are not draped vertically (boxes stand
//! upright on the plan), parts of segments without number.

mod camera;
mod frame;
mod fxaa;
mod in_line;
mod lists;
mod matching;
mod segment_box;
mod settings;
mod simplify;
mod step;
mod sweep;
mod tile;
mod update;

pub use settings::{
    Antialiasing, Boxes, Corners, Culling, LineOverlaps, Preparation, Settings, Simplification, Sorting,
    ThinLines,
};
pub use step::{Step, Verdict};

use super::{Contradiction, Declaration, Explanation, Frame, FrameOptions, Parameters, Prepared};
use crate::buffer::{Look, PlaneKind};
use crate::error::{Error, Result};
use crate::scene::{TechniqueSettings, Width};
use crate::space::ViewFrame;
use crate::stage::Stage;
use crate::terrain::Drape;
use matching::MatchedLines;

/// The technique, said once.
pub const DECLARATION: Declaration = Declaration {
    parameters: Parameters::of::<Settings>(),
    paper: "Zechmeister 2020, dynamic lines.",
    title: "Dynamic lines (Zechmeister)",
    contradiction,
    planes: &[
        PlaneKind::DEPTH,
        PlaneKind::TRIANGLE,
        PlaneKind::PLAN,
        PlaneKind::new("boxes", Look::Count),
        PlaneKind::new("list-length", Look::Count),
        PlaneKind::COLOR,
    ],
    sweep: sweep::SWEEP,
    applies,
    prepare: |stage, _| Ok(Box::new(Prepare::new(stage)?)),
};

/// Edges that are analytic know distances from a centre line alone.
fn contradiction(settings: &TechniqueSettings) -> Option<Contradiction> {
    let settings: Settings = settings.get();
    let is_open = settings.corners == Corners::Style && settings.antialiasing == Antialiasing::Analytic;
    is_open.then(|| Contradiction {
        parameter: "antialiasing",
        what: "analytic edges are those of round corners".into(),
        help: "use corners = \"round\", or antialiasing = \"fxaa\"".into(),
    })
}

/// The technique with its lines found.
#[derive(Debug)]
pub struct Prepare<'s> {
    stage: &'s Stage,
    lines: MatchedLines<'s>,
}

impl<'s> Prepare<'s> {
    /// Cuts lines into pieces, and puts them on the terrain if that is wanted beforehand.
    ///
    /// # Errors
    /// When the technique does not draw such a scene, or segments have too many parts.
    pub fn new(stage: &'s Stage) -> Result<Self> {
        applies(stage)?;
        let settings: Settings = stage.scene.technique.get();
        let lines = MatchedLines::new(&stage.draw_list, &stage.mesh, settings.l_max)?;
        if settings.preparation == Preparation::Whole {
            lines.match_all();
        }
        Ok(Self { stage, lines })
    }

    /// The steps of a pixel (column, row) of a view's picture, and its code values; see [`super::explain`].
    pub fn steps_of(&self, view: &ViewFrame, pixel: [usize; 2]) -> (Vec<Step>, [u8; 4]) {
        frame::explain((self.stage, view), &self.lines, pixel)
    }
}

/// Whether the technique can draw the scene.
///
/// # Errors
/// The reason why it cannot.
pub fn applies(stage: &Stage) -> Result<()> {
    if stage.mesh.drape() != Drape::Vertical {
        return Err(Error::unsupported(
            "dynamic-line's boxes are upright, this terrain's points do not lie straight over their plan points",
        )
        .help("leave the technique out"));
    }
    if !stage.scene.layers.iter().any(|layer| layer.has_width_in_pixels()) {
        return Err(Error::unsupported(
            "there is no width in pixels for dynamic-line; static-decal draws widths in metres",
        )
        .help("give a layer width_px, or leave the technique out"));
    }
    let is_dynamic = |item: u32| {
        let stroke = stage.draw_list.style_of(item).stroke;
        stroke.is_some_and(|line| matches!(line.width, Width::Pixels(_)))
    };
    match stage.draw_list.numbered().find(|(number, _)| !is_dynamic(*number)) {
        None => Ok(()),
        Some((_, item)) => Err(Error::unsupported(format!(
            "dynamic-line draws widths in pixels, layer `{}` has a fill or a width in metres",
            stage.scene.layers[item.layer as usize].name
        ))
        .help("give the layer width_px alone, or leave the technique out")),
    }
}

impl Prepared for Prepare<'_> {
    fn frame(&self, view: &ViewFrame, options: &FrameOptions) -> Result<Frame> {
        frame::draw((self.stage, view), &self.lines, options)
    }

    fn steps(&self, view: &ViewFrame, pixel: [usize; 2]) -> Result<Explanation> {
        let (steps, code) = self.steps_of(view, pixel);
        Ok(Explanation::new(steps, code))
    }

    fn structure_bytes(&self) -> usize {
        self.lines.bytes()
    }
}
