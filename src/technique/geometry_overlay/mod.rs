//! Geometry overlay: Z. Wartell, E. Kang, T. Wasilewski, W. Ribarsky, N. Faust (2003), "Rendering vector data over global, multi-resolution 3D terrain",
//! VisSym '03.
//!
//! Input: a [`Stage`]. Output: a picture whose lines are cut to the triangles of the mesh in use and drawn as lines of the screen:
//! 1. preprocessing: each line is cut at all triangles that a quad's mesh may be made of (`dag`, 3.1, 3.2), when a view first uses the quad (`store`);
//! 2. the view: of the quads in use, walks along their clippings follow the mesh (`strips`; Algorithm 1, 3.2.1), within a triangle a line may be
//!    simplified (3.2.2);
//! 3. drawing: lines as OpenGL draws them, moved before the mesh by polygon offset (`drawing`, `tile`; 3.2.1).
//!
//! Polygons are drawn as their outlines: a fill without one by its border, one pixel wide, in its colour; an outline on its border, whichever side of
//! it the style asks for. As an option, fills are triangles, cut to those of the mesh as lines are (`fill`; the paper has lines alone). A mesh without levels (`terrain.lod`) has only
//! the smallest triangles; cells may be split in any way then. Where the paper is silent, see `dag` and `docs/semantics.md`.
//!
//! Over a globe the places of lines among the posts are those of the plan; at a pole, where all columns meet, lines go along with them.
//!
//! Refuses: terrains that are no grid (there are no quads), points (there are no lines).

mod dag;
mod drawing;
mod fill;
mod frame;
mod grid_map;
mod line_strips;
mod mesh;
mod settings;
mod step;
mod store;
mod stored;
mod strips;
mod structures;
mod sweep;
#[cfg(test)]
mod tests;
mod tile;

pub use dag::{Bytes, Counts, PointForm, Storage, StoredLayers};
pub use line_strips::{FillPiece, LineStrip};
pub use settings::{Borrowed, Lines, Polygons, Primitives, Settings, Widths};
pub use step::Step;
pub use stored::StoredQuad;

use super::{Declaration, Explanation, Frame, FrameOptions, Parameters, Prepared};
use crate::buffer::{Look, PlaneKind};
use crate::draw_list::Role;
use crate::error::{Error, Result};
use crate::scene::{Line, StrokeForm, TechniqueSettings};
use crate::space::ViewFrame;
use crate::stage::Stage;
use fill::{Fills, Patch};
use grid_map::GridMap;
use mesh::MeshInUse;
use store::Store;

/// The technique, said once.
pub const DECLARATION: Declaration = Declaration {
    parameters: Parameters::of::<Settings>(),
    further: &[],
    paper: "Wartell et al. 2003, \"Rendering vector data over global, multi-resolution 3D terrain\".",
    title: "Geometry overlay (Wartell et al.)",
    contradiction: |_| None,
    planes: &[
        PlaneKind::structure("quads"),
        PlaneKind::structure("polylines"),
        PlaneKind::structure("quad-clippings"),
        PlaneKind::structure("triangle-clippings"),
        PlaneKind::structure("line-vertices"),
        PlaneKind::structure("crossings"),
        PlaneKind::structure("directions"),
        PlaneKind::structure("fill-vertices"),
        PlaneKind::structure("fill-triangles"),
        PlaneKind::DEPTH,
        PlaneKind::TRIANGLE,
        PlaneKind::PLAN,
        PlaneKind::new("layer", Look::Number),
        PlaneKind::new("clipping", Look::Number),
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

/// Lines of the screen, segment by segment.
fn stroke_form(_said: &TechniqueSettings, _line: &Line) -> StrokeForm {
    StrokeForm { join: "none", miter_limit: None, cap: "butt" }
}

/// The technique with its lines indexed.
#[derive(Debug)]
pub struct Prepare<'s> {
    stage: &'s Stage,
    settings: Settings,
    store: Store,
    /// None where polygons are their outlines.
    fills: Fills,
}

impl<'s> Prepare<'s> {
    /// Indexes the scene's lines, and triangulates fills where they are drawn. The lines' clippings are made when a view first uses a quad.
    ///
    /// # Errors
    /// When the technique does not draw such a scene.
    pub fn new(stage: &'s Stage) -> Result<Self> {
        applies(stage)?;
        let settings: Settings = stage.scene.technique.get();
        let (list, map) = (&stage.draw_list, GridMap::new(&stage.mesh.lattice().ok_or_else(no_quads)?));
        let has_fills = settings.polygons != Polygons::Outlines;
        let is_line = |item: u32| !has_fills || !fill::is_area(list.style_of(item));
        let store = Store::new(list, &map, is_line);
        let fills = if has_fills { Fills::new(list, &map)? } else { Fills::default() };
        Ok(Self { stage, settings, store, fills })
    }

    /// What a view draws of fills.
    fn patches(&self, mesh: &MeshInUse, view: &ViewFrame) -> Vec<Patch> {
        self.fills.patches(mesh, &self.quads(mesh, view))
    }
}

fn no_quads() -> Error {
    Error::unsupported(
        "geometry-overlay cuts lines at the triangles of a grid's quads, and this terrain is no grid",
    )
    .help("leave the technique out")
}

/// Whether the technique can draw the scene.
///
/// # Errors
/// The reason why it cannot.
pub fn applies(stage: &Stage) -> Result<()> {
    if stage.mesh.lattice().is_none() {
        return Err(no_quads());
    }
    let is_point = |number: u32| {
        let style = stage.draw_list.style_of(number);
        style.role == Role::Point || style.swath.is_some_and(|of| of.is_of_points)
    };
    match stage.draw_list.numbered().find(|(number, _)| is_point(*number)) {
        None => Ok(()),
        Some((_, item)) => Err(Error::unsupported(format!(
            "geometry-overlay draws lines, layer `{}` has points",
            stage.scene.layers[item.layer as usize].name
        ))
        .help("leave the technique out")),
    }
}

impl Prepared for Prepare<'_> {
    fn frame(&self, view: &ViewFrame, options: &FrameOptions) -> Result<Frame> {
        frame::draw(self, view, options)
    }

    fn steps(&self, view: &ViewFrame, pixel: [usize; 2]) -> Result<Explanation> {
        let (steps, code) = frame::explain(self, view, &[pixel]).pop().unwrap_or_default();
        Ok(Explanation::new(steps, code))
    }

    fn steps_of_all(&self, view: &ViewFrame, pixels: &[[usize; 2]]) -> Result<Vec<Explanation>> {
        Ok(Explanation::all(frame::explain(self, view, pixels)))
    }

    fn structure_bytes(&self) -> usize {
        self.store.bytes() + self.fills.bytes()
    }
}
