//! Dynamic lines: S. Zechmeister (2020), "Interactive visualization of vector data on heightfields" (the thesis): lines whose
//! widths are in pixels.
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
//! Fills and widths in metres of such a scene are static decals ([`decal`]), looked up at pixels' centres and composed with
//! the lines in draw order (`statics`).
//!
//! Refuses: scenes without a width in pixels, outlines in pixels that are inset or offset (3.6: those are of static lines), terrains that are not
//! draped vertically (boxes stand upright on the plan), parts of segments without number.

mod border;
mod camera;
mod frame;
mod fxaa;
mod in_line;
mod lists;
mod matching;
mod segment_box;
mod settings;
mod simplify;
mod statics;
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
use crate::decal::{self, Decals, Edges, LeafPolygons};
use crate::error::{Error, Result};
use crate::scene::{Line, Precision, StrokeForm, TechniqueSettings, Width};
use crate::space::ViewFrame;
use crate::stage::Stage;
use crate::terrain::Drape;
use matching::MatchedLines;

/// The technique, said once.
pub const DECLARATION: Declaration = Declaration {
    parameters: Parameters::of::<Settings>(),
    further: &[Parameters::of::<decal::Settings>()],
    paper: "Zechmeister 2020, \"Interactive visualization of vector data on heightfields\".",
    title: "Dynamic lines (Zechmeister)",
    contradiction,
    planes: &[
        PlaneKind::DEPTH,
        PlaneKind::TRIANGLE,
        PlaneKind::PLAN,
        PlaneKind::new("boxes", Look::Count),
        PlaneKind::new("list-length", Look::Count),
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

/// Edges that are analytic know distances from a centre line, and from borders that leaves have kept.
fn contradiction(said: &TechniqueSettings) -> Option<Contradiction> {
    let settings: Settings = said.get();
    let is_styled = settings.corners == Corners::Style;
    let is_clipped = said.get::<decal::Settings>().leaf_polygons == LeafPolygons::Clipped;
    let (what, help) = match settings.antialiasing {
        Antialiasing::Analytic if is_styled => (
            "analytic edges are those of round corners",
            "use corners = \"round\", or antialiasing = \"fxaa\"",
        ),
        Antialiasing::Analytic if is_clipped => (
            "static decals' leaves that are clipped do not know the border that analytic edges measure from",
            "use technique.static-decal.leaf_polygons = \"corner\"",
        ),
        _ => return None,
    };
    Some(Contradiction { parameter: "antialiasing", what: what.into(), help: help.into() })
}

/// Lines in pixels are round, or as the style says; what is in metres is as decals have it.
fn stroke_form(said: &TechniqueSettings, line: &Line) -> StrokeForm {
    match (line.width, said.get::<Settings>().corners) {
        (Width::Metres(_), _) => said.get::<decal::Settings>().stroke_form(line),
        (Width::Pixels(_), Corners::Round) => StrokeForm::ROUND,
        (Width::Pixels(_), Corners::Style) => StrokeForm::of_style(line),
    }
}

/// The technique with its lines found.
#[derive(Debug)]
pub struct Prepare<'s> {
    stage: &'s Stage,
    prepared: frame::Prepared<'s>,
}

impl<'s> Prepare<'s> {
    /// Cuts lines into pieces, and puts them on the terrain if that is wanted beforehand; the rest of the scene becomes static decals.
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
        let has_statics = stage.draw_list.numbered().any(|(item, _)| !is_dynamic(stage, item));
        let decals = has_statics.then(|| {
            let is_single = stage.scene.device.precision == Precision::F32;
            let is_analytic = settings.antialiasing == Antialiasing::Analytic;
            let edges = if is_analytic { Edges::Analytic } else { Edges::Sampled };
            let of_decals = decal::Settings { edges, ..stage.scene.technique.get() };
            Decals::new(&stage.draw_list, &stage.mesh.plan_bounds(), &of_decals, is_single, &|_| {})
        });
        Ok(Self { stage, prepared: frame::Prepared { lines, decals } })
    }

    /// The steps of a pixel (column, row) of a view's picture, and its code values; see [`super::explain`].
    ///
    /// # Errors
    /// When the view has more segments than there is room for.
    pub fn steps_of(&self, view: &ViewFrame, pixel: [usize; 2]) -> Result<(Vec<Step>, [u8; 4])> {
        let all = frame::explain((self.stage, view), &self.prepared, &[pixel])?;
        Ok(all.into_iter().next().unwrap_or_default())
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
    let is_cut = |item: u32| is_dynamic(stage, item) && stage.draw_list.style_of(item).cut.is_some();
    match stage.draw_list.numbered().find(|(number, _)| is_cut(*number)) {
        None => Ok(()),
        Some((_, item)) => Err(Error::unsupported(format!(
            "dynamic-line draws outlines in pixels on both sides (3.6), that of layer `{}` is inset or offset",
            stage.scene.layers[item.layer as usize].name
        ))
        .help("use mode = \"normal\", or width_m")),
    }
}

/// Whether an item is a stroke whose width is in pixels.
fn is_dynamic(stage: &Stage, item: u32) -> bool {
    let stroke = stage.draw_list.style_of(item).stroke;
    stroke.is_some_and(|line| matches!(line.width, Width::Pixels(_)))
}

impl Prepared for Prepare<'_> {
    fn frame(&self, view: &ViewFrame, options: &FrameOptions) -> Result<Frame> {
        frame::draw((self.stage, view), &self.prepared, options)
    }

    fn steps(&self, view: &ViewFrame, pixel: [usize; 2]) -> Result<Explanation> {
        let (steps, code) = self.steps_of(view, pixel)?;
        Ok(Explanation::new(steps, code))
    }

    fn steps_of_all(&self, view: &ViewFrame, pixels: &[[usize; 2]]) -> Result<Vec<Explanation>> {
        Ok(Explanation::all(frame::explain((self.stage, view), &self.prepared, pixels)?))
    }

    fn structure_bytes(&self) -> usize {
        self.prepared.lines.bytes()
            + self.prepared.decals.as_ref().map_or(0, |decals| decals.memory().bytes())
    }
}

#[cfg(test)]
mod tests;
