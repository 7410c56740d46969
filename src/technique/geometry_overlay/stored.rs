//! What walks find and what quads take, without a picture: for tables and measurements.
//!
//! Input: a quad, a view. Output: [`StoredQuad`], a number of points. Refuses: nothing.

use super::Prepare;
use super::dag::Storage;
use super::mesh::MeshInUse;
use crate::space::ViewFrame;
use crate::terrain::lod::Quad;

/// The triangle-clipping DAG of a quad in the forms that the paper compares (3.3), and as it is held here.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StoredQuad {
    /// What is to be stored.
    pub storage: Storage,
    /// Bytes that are held here of a quad that a view uses.
    pub held_bytes: usize,
}

impl Prepare<'_> {
    /// Makes the structure of a quad with all its layers (3.2), whether a view uses it or not, and tells how large it is; a root has no larger quad.
    pub fn stored(&self, quad: Quad, is_root: bool) -> StoredQuad {
        let lods = self.store.with_all_layers(quad);
        StoredQuad { storage: Storage::of(&lods, is_root), held_bytes: lods.bytes() }
    }

    /// Walks along the clippings over a view's mesh (Algorithm 1) as a frame does before it draws; returns how many points that gives.
    pub fn walk(&self, view: &ViewFrame) -> u64 {
        let shown = self.stage.mesh_for(view);
        MeshInUse::of(&self.stage.mesh, &shown).map_or(0, |mesh| self.overlay(&mesh, view).points)
    }
}
