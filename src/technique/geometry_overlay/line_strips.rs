//! What a view draws of lines and fills on the mesh, before any of it is on the screen: data that a bundle can hand out.
//!
//! Input: a view. Output: [`LineStrip`]s and [`FillPiece`]s. Refuses: nothing.

use super::Prepare;
use super::fill::Patch;
use super::mesh::MeshInUse;
use crate::space::{ViewFrame, World};

/// A primitive: what is drawn of a quad clipping (3.2.1).
#[derive(Debug, Clone, PartialEq)]
pub struct LineStrip {
    /// The item that it is of.
    pub item: u32,
    /// Its segments on the mesh, from the line's start on, those of each triangle clipping after those of the one before.
    pub segments: Vec<[World; 2]>,
}

/// What a fill has on a triangle of the mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct FillPiece {
    /// The item that it is of.
    pub item: u32,
    /// The mesh's triangle.
    pub triangle: [World; 3],
    /// Its corners on that, at least three: a convex polygon. Pieces that meet have the same corners there.
    pub corners: Vec<World>,
}

impl Prepare<'_> {
    /// The pieces of fills of a view in the order in which they are drawn.
    pub fn fill_pieces(&self, view: &ViewFrame) -> Vec<FillPiece> {
        let shown = self.stage.mesh_for(view);
        let Some(mesh) = MeshInUse::of(&self.stage.mesh, &shown) else { return Vec::new() };
        let piece = |patch: &Patch| FillPiece {
            item: patch.item,
            triangle: patch.ground,
            corners: patch.corners().to_vec(),
        };
        self.patches(&mesh, view).iter().map(piece).collect()
    }

    /// The primitives of a view in the order in which they are drawn.
    pub fn line_strips(&self, view: &ViewFrame) -> Vec<LineStrip> {
        let shown = self.stage.mesh_for(view);
        let Some(mesh) = MeshInUse::of(&self.stage.mesh, &shown) else { return Vec::new() };
        let strips = self.overlay(&mesh, view).strips.into_iter().map(|strip| {
            let of_clipping = |points: &std::ops::Range<u32>| {
                let points = &strip.points[points.start as usize..points.end as usize];
                points.windows(2).map(|ends| [ends[0], ends[1]]).collect::<Vec<_>>()
            };
            let segments = strip.clippings.iter().flat_map(|(_, points)| of_clipping(points)).collect();
            LineStrip { item: strip.item, segments }
        });
        strips.collect()
    }
}
