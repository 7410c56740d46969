//! Stencil volumes: M. Schneider, R. Klein (2007), "Efficient and accurate rendering of vector data on virtual landscapes",
//! Journal of WSCG.
//!
//! Input: a [`Stage`]. Output: a picture whose features are masks that faces of polyhedra have counted:
//! 1. extrusion: vector data becomes polyhedra between levels just below and above the terrain (`extrusion`, `stroke`, `heights`; 4.1);
//! 2. the view: which method counts each polyhedron (`view`, 4.2.1);
//! 3. counting: the faces' fragments before or behind the terrain go into the stencil (`face`, `fragments`, `solid`, `block`, `stencil`; 3.1, 4.2.1);
//! 4. the mask is applied through the polyhedra's boxes and zeroed on the way (`passes`, 4.2.2).
//!
//! With exact mathematics (the default device) the mask is the footprint: a sample is in it exactly when its surface
//! point's plan point is. Where the paper is silent, see `extrusion`, `view` and `docs/semantics.md`.
//!
//! Refuses: scenes with widths in pixels (5: "available vector data is static"; a volume stands on a footprint that does not
//! depend on the view), terrains that are not draped vertically (walls stand upright on the plan), and outlines that are cut to
//! their polygon where the stencil has one bit.

mod block;
mod context;
mod extrusion;
mod face;
mod fragments;
mod frame;
mod heights;
mod passes;
mod points;
mod settings;
mod solid;
mod stencil;
mod step;
mod stroke;
mod structures;
mod sweep;
#[cfg(test)]
mod tests;
mod tile;
mod view;

pub use settings::{Counting, FarPlane, Grouping, Overflow, Settings, VolumeCaps, VolumeJoins};
pub use step::Step;

use super::{Declaration, Explanation, Frame, FrameOptions, Parameters, Prepared};
use crate::buffer::{Look, PlaneKind};
use crate::error::{Error, Result};
use crate::parameter::Named;
use crate::scene::{Cap, Layer, Line, OutlineMode, StrokeForm, TechniqueSettings};
use crate::space::ViewFrame;
use crate::stage::Stage;
use crate::terrain::Drape;
use extrusion::Extrusion;

/// The most samples of a picture: each takes 20 bytes while a frame is drawn.
const MOST_SAMPLES: usize = 1 << 27;

/// The technique, said once.
pub const DECLARATION: Declaration = Declaration {
    parameters: Parameters::of::<Settings>(),
    further: &[],
    paper: "Schneider & Klein 2007, \"Efficient and accurate rendering of vector data on virtual landscapes\".",
    title: "Stencil volumes (Schneider & Klein)",
    contradiction: |_| None,
    planes: &[
        PlaneKind::structure("objects"),
        PlaneKind::structure("volumes"),
        PlaneKind::structure("volume-levels"),
        PlaneKind::structure("volume-rings"),
        PlaneKind::structure("volume-corners").in_plan(),
        PlaneKind::DEPTH,
        PlaneKind::TRIANGLE,
        PlaneKind::PLAN,
        PlaneKind::COLOR,
        PlaneKind::new("stencil", Look::Count),
        PlaneKind::new("stencil-front", Look::Count),
        PlaneKind::new("stencil-back", Look::Count),
        PlaneKind::new("overdraw", Look::Count),
        PlaneKind::ID,
        PlaneKind::ID_STARTS,
        PlaneKind::IDS,
    ],
    client: include_str!("client.md"),
    stroke_form,
    sweep: sweep::SWEEP,
    applies,
    prepare: |stage, _| Ok(Box::new(Prepare::new(stage)?)),
};

/// A box a segment, unless `joins` asks for more; round caps are drawn flat then.
fn stroke_form(said: &TechniqueSettings, line: &Line) -> StrokeForm {
    match said.get::<Settings>().joins {
        VolumeJoins::Style => StrokeForm::of_style(line),
        VolumeJoins::None => {
            let cap = if line.cap == Cap::Square { line.cap } else { Cap::Butt };
            StrokeForm { join: "none", miter_limit: None, cap: cap.word() }
        }
    }
}

/// The technique with its volumes built.
#[derive(Debug)]
pub struct Prepare<'s> {
    stage: &'s Stage,
    settings: Settings,
    extrusion: Extrusion<'s>,
}

impl<'s> Prepare<'s> {
    /// Extrudes the scene's items.
    ///
    /// # Errors
    /// When the technique does not draw such a scene, or there is too much in it.
    pub fn new(stage: &'s Stage) -> Result<Self> {
        applies(stage)?;
        let settings: Settings = stage.scene.technique.get();
        // A coarse triangle may lie above or below all of the full surface in a volume.
        let terrain = (&*stage.mesh, stage.scene.lod.is_none());
        let extrusion = Extrusion::new(&stage.draw_list, terrain, &settings);
        if extrusion.corners.len() > u32::MAX as usize / 2 {
            return Err(Error::unsupported("more corners of volumes than this program can number")
                .help("give the terrain a `window`"));
        }
        if let Some(object) = settings.object.filter(|o| *o as usize >= extrusion.objects.len()) {
            return Err(Error::new(format!(
                "stencil-volume has {} objects, there is no object {object}",
                extrusion.objects.len()
            ))
            .help(
                "objects are counted from 0 in draw order: fills, outlines and lines, feature by feature",
            ));
        }
        Ok(Self { stage, settings, extrusion })
    }

    /// The steps of a pixel (column, row) of a view's picture, and its code values; see [`super::explain`].
    ///
    /// # Errors
    /// When there is no room for the samples of the picture.
    pub fn steps_of(&self, view: &ViewFrame, pixel: [usize; 2]) -> Result<(Vec<Step>, [u8; 4])> {
        Ok(self.explained(view, &[pixel])?.pop().unwrap_or_default())
    }

    fn explained(&self, view: &ViewFrame, pixels: &[[usize; 2]]) -> Result<Vec<(Vec<Step>, [u8; 4])>> {
        has_room((view.width(), view.height()), self.settings.samples)?;
        Ok(frame::explain((self.stage, view), &self.extrusion, pixels))
    }
}

/// Whether the technique can draw the scene.
///
/// # Errors
/// The reason why it cannot.
pub fn applies(stage: &Stage) -> Result<()> {
    if stage.mesh.drape() != Drape::Vertical {
        return Err(Error::unsupported(
            "stencil-volume's walls are vertical, this terrain's points do not lie straight over their plan points",
        )
        .help("leave the technique out"));
    }
    if let Some(layer) = stage.scene.layers.iter().find(|layer| layer.has_width_in_pixels()) {
        return Err(Error::unsupported(format!(
            "stencil-volume extrudes footprints that do not depend on the view, layer `{}` has width_px",
            layer.name
        ))
        .help("give the layer width_m, or leave the technique out"));
    }
    let image = &stage.scene.image;
    has_room((image.width, image.height), stage.scene.technique.get::<Settings>().samples)?;
    let is_cut = |layer: &&Layer| {
        let mut outlines = layer.styles.iter().filter_map(|style| style.outline);
        outlines.any(|outline| outline.mode != OutlineMode::Normal)
    };
    match stage.scene.layers.iter().find(is_cut) {
        Some(layer) if stage.scene.device.stencil_bits < 2 => Err(Error::unsupported(format!(
            "the outline of layer `{}` needs a second bit of the stencil, to be cut to its polygon",
            layer.name
        ))
        .help("use device.stencil_bits = 8, or mode = \"normal\"")),
        _ => Ok(()),
    }
}

/// Whether there is room for n x n samples in each pixel of a picture.
///
/// # Errors
/// When there is not.
fn has_room((width, height): (usize, usize), n: u32) -> Result<()> {
    let samples = width * height * n as usize * n as usize;
    if samples <= MOST_SAMPLES {
        return Ok(());
    }
    Err(Error::unsupported(format!("stencil-volume has no room for {samples} samples: at most 2^27 in all"))
        .help("use fewer samples a pixel, or a smaller image"))
}

impl Prepared for Prepare<'_> {
    fn frame(&self, view: &ViewFrame, options: &FrameOptions) -> Result<Frame> {
        has_room((view.width(), view.height()), self.settings.samples)?;
        Ok(frame::draw((self.stage, view), &self.extrusion, options))
    }

    fn steps(&self, view: &ViewFrame, pixel: [usize; 2]) -> Result<Explanation> {
        let (steps, code) = self.steps_of(view, pixel)?;
        Ok(Explanation::new(steps, code))
    }

    fn steps_of_all(&self, view: &ViewFrame, pixels: &[[usize; 2]]) -> Result<Vec<Explanation>> {
        Ok(Explanation::all(self.explained(view, pixels)?))
    }

    fn structure_bytes(&self) -> usize {
        self.extrusion.bytes()
    }
}
