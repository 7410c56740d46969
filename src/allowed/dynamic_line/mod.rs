//! Dynamic lines (Zechmeister 2020): a pixel's centre is in a line where its surface point is near enough to a segment that the view keeps and whose box covers the
//! pixel; then the picture is smoothed.
//!
//! Input: a view, a guess. Output: the picture and its stages. Refuses: settings of which nobody knows what they draw.

mod filter;
mod frame;
mod kept;
mod lines;
mod maker;
mod order;
mod outline;
mod patch;
mod segment;

pub(super) use frame::picture;
