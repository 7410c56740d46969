//! Level-of-detail meshes: restricted quadtree triangulations of a grid or a globe (Wartell et al. 2003, 2.1; Lindstrom et al. 1996).
//!
//! Input: the posts of a grid or a globe, a view, what detail is wanted. Output: [`LodMesh`], a [`Mesh`](super::Mesh) of some of the posts; its triangles and quads as
//! posts. Refuses: grids that do not nest in the hierarchy, or are smaller than a quad.
//!
//! Each post is the middle of the longest sides of two triangles ([`RightTriangle`]). `errors` bounds how far each triangle is from the full
//! surface; `selection` decides by a view which to split, `refinement` splits what that needs to be without cracks, `mesh` collects what is left.

mod deviation;
mod errors;
mod extent;
mod hierarchy;
mod horizon;
mod hull;
mod mesh;
mod places;
mod quad;
mod refinement;
mod right_triangle;
mod search;
mod selection;
mod sight;
mod tile;
mod vertices;

pub use hierarchy::Hierarchy;
pub use mesh::{Deviation, LodMesh};
pub use quad::{CELLS, Quad, QuadInUse};
pub use right_triangle::{Post, RightTriangle, splits_sw_ne};

#[cfg(test)]
mod tests;
