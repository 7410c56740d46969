//! Level-of-detail meshes: restricted quadtree triangulations of a grid (Wartell et al. 2003, 2.1; Lindstrom et al. 1996).

mod quad;
mod right_triangle;

pub use quad::{CELLS, Quad, QuadInUse};
pub use right_triangle::{Post, RightTriangle, splits_sw_ne};
