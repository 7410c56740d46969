//! Polygon quad-trees: a ring cut into leaves with few edges each (Zechmeister 2020, section 4.2.1, Figure 2.12; Frasson et al. 2018).
//!
//! Input: one ring, exterior or interior alike, among the draw list's vertices, and [`Limits`]. Output: a [`Quadtree`], which tells the
//! ring's winding number around a plan point; whoever asks sums those of an item's rings and applies the item's rule. Refuses: nothing; a
//! ring without an area winds around no point.
//!
//! All of it stands on one convention: a point stands for the one a little to its north-east, moved east by a step that is smaller than
//! anything that is there, and north by one that is still smaller. The moved point lies on no edge and no border, so that its winding number can
//! be counted along any path. What the convention says of a ray to the east is the half-open rule: an edge is crossed when one end is higher
//! than the point and the other is not, and the point lies strictly west of it.

mod borders;
mod build;
mod clip;
mod crossing;
mod cut;
mod node;
mod throughout;
mod tree;

pub use build::Limits;
pub use cut::{Cut, run_misses, south_east, turns_of_run};
pub use node::Kind;
pub use tree::{Counts, LeafEdges, Quadtree, Start};

#[cfg(test)]
mod tests;
