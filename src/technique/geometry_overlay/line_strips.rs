//! What a view draws of lines on the mesh, before any of it is on the screen: data that a bundle can hand out.
//!
//! Input: a view. Output: [`LineStrip`]s. Refuses: nothing.

use super::Prepare;
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

impl Prepare<'_> {
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
