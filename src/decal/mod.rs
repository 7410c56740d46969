//! Static decals: which items of a draw list hold a point of the plan. S. Zechmeister (2020), "Interactive visualization of vector data on
//! heightfields" (the thesis), chapters 3 and 4, after M. Thöny, M. Billeter, R. Pajarola (2017) for lines and A. Frasson, T. A. Engel,
//! C. T. Pozzer (2018) for polygons.
//!
//! Input: a [`DrawList`](crate::draw_list::DrawList), the terrain's box in the plan. Output: [`Decals`], which answer for the samples of a pixel
//! with [`Hits`]; [`Palette`] composes them. Refuses: nothing. From the sample inwards, as Algorithm 3.5 goes:
//! 1. the sample's cell of the decal grid (`grid`);
//! 2. what the cell refers to (`cell`), in two trees sorted by draw order (`bvh`), walked together from the front (`lookup`, `search`);
//! 3. a leaf (`leaf`) is a segment of a stroke, widened (`stroke`), or a polygon: of each of its rings a winding number, the edges that meet the cell, or the
//!    part of its quadtree that lies in the cell (`quadtree`);
//! 4. what holds the samples (`hits`) is composed (`palette`).
//!
//! Cells (`decals`, of `contents`) and quadtrees are built from an index of boxes (`build`) when a sample first lies in them, or all beforehand: the bits are the same. With exact mathematics every
//! decision is exact: boxes only leave out what surely misses, the tests in leaves are predicates. Widths in pixels are no static decals: such
//! strokes are passed over.

mod arrays;
mod build;
mod bvh;
mod cell;
mod contents;
mod coverage;
mod decals;
mod grid;
mod hits;
mod leaf;
mod lookup;
mod memory;
mod packet;
mod palette;
pub(crate) mod quadtree;
mod search;
mod settings;
mod share;
mod side;
pub(crate) mod stroke;

pub use arrays::Arrays;
pub use decals::Decals;
pub use hits::{Hit, Hits, MOST_TOGETHER};
pub use memory::Memory;
pub use packet::LookupCounts;
pub use palette::{Mean, Palette};
pub use settings::{Edges, Hierarchy, Joins, LeafPolygons, Outlines, Overlaps, Preparation, Settings};
pub use share::{PlanPixel, Shares};

#[cfg(test)]
mod tests;
