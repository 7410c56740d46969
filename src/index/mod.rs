//! What finds the few among many that are near a place: lists of cells, tiles' bins, a tree of boxes, a curve to sort by.
//!
//! Input: boxes, or what lies in which cell. Output: [`BoxTree`], [`CellLists`], [`bins`]. What is found is a superset of what meets
//! the place asked for, in a fixed order; whoever asks decides. Refuses: nothing.

mod box_tree;
mod cell_lists;
mod morton;

pub use box_tree::{BoxTree, packed_levels};
pub use cell_lists::{CellLists, Entries, bins};
pub use morton::morton;
