//! The triangle-clipping DAG: polylines cut in advance at every triangle that a level-of-detail mesh may be made of (Wartell et al. 2003, 3).
//!
//! Input: chains of points in grid coordinates ([`Chains`]: column and row of posts as real numbers), a quad, which layers of triangles it has
//! ([`Layers`]). Output: [`PolylineLods`], one line and section after the other, and walks along them that find what lies over the
//! triangles in use ([`QuadClipping::traverse`], [`Borrowed`]), whose points get heights of any surface over the posts. Refuses: nothing.
//!
//! 1. A chain is traced through the smallest triangles ([`trace`]; 3.2). Every point of it is moved by an infinitesimal step east and a still
//!    smaller one north, as boundary points of areas are: so each point lies in the inside of one triangle, no segment meets a post or runs
//!    along an edge, and all decisions are signs of determinants ([`side`]).
//! 2. From there the triangles that these are halves of are climbed, layer by layer ([`climb`]).
//! 3. Points are stored once, as projectors (3.3): vertices and crossings of the plan. A clipping refers to them, and its triangle says how
//!    high they are.
//!
//! What the paper leaves open: a clipping's `next` is decided by the triangle beyond its exit edge that has this edge as its longest side: that one
//! if its apex is a vertex of the mesh in use, otherwise the one it is a half of. So a leg leads one layer finer or to the same layer, a longest side to
//! the same layer or one layer coarser. A run of pieces in one triangle without a gap is one clipping; a chain that comes back makes another.

mod arrays;
mod blg;
mod borrowed;
mod build;
mod cells;
mod chains;
mod climb;
mod crossing;
mod grid;
mod plane;
mod side;
mod storage;
mod structure;
mod trace;
mod traverse;

#[cfg(test)]
mod tests;

pub use arrays::Arrays;
pub use blg::BlgTree;
pub use borrowed::{Borrowed, SubPolylineLods};
pub use cells::{Layers, edge_of, halves_of_cell};
pub use chains::Chains;
pub use crossing::Crossing;
pub use grid::GridPoint;
pub use plane::Plane;
pub use side::{is_left_of_edge, is_left_of_way};
pub use storage::{Bytes, Counts, PointForm, Storage, StoredLayers};
pub use structure::{PolylineLods, QuadClipping, TriangleClipping};
pub use traverse::Cost;
