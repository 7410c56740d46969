//! Static decals as a structure that answers which items of the draw list hold a plan point (Zechmeister 2020, sections 3.2.1 and 4.2.1, after
//! Thöny et al. 2017 and Frasson et al. 2018).
//!
//! Input: the draw list's vertices, and rings of them. Output: a [`quadtree::Quadtree`] of a ring: its winding number around any point,
//! exactly. Refuses: nothing; rings without an area hold no point.

pub mod quadtree;
