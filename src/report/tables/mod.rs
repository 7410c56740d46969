//! The papers' own tables, measured anew: a folder a paper.
//!
//! Input: opened scenes. Output: of each paper `tables.html` (one page that needs no network), `tables.csv` and `tables.json`. Refuses: scenes that
//! have nothing of what a paper measures.

mod change;
mod files;
mod grouped;
pub mod she;
pub mod taibo;
pub mod wartell;
pub mod zechmeister;
