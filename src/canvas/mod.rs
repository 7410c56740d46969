//! What every picture of samples needs around it: what the samples see, what lies below the features, pixels and buffers.
//!
//! Input: a stage, a view, the names of the buffers that are wanted. Output: the parts of a [`Frame`]: a [`GBuffer`] and its planes, a
//! [`Backdrop`], [`Pixels`], [`Kept`] values; a way to [`Record`] why a pixel has its colour. What a pixel shows between the backdrop and its code value is the technique's own. Refuses:
//! nothing.

mod backdrop;
mod frame;
mod g_buffer;
mod pattern;
mod pixels;
mod record;

pub use backdrop::{Backdrop, LastGround};
pub use frame::{Frame, FrameOptions, Kept, joined, picture_plane, table};
pub use g_buffer::{GBuffer, sight_counts, surface_plane};
pub use pattern::{BlockSamples, MOST_SAMPLES, SamplePattern};
pub use pixels::{Pixels, mean};
pub use record::Record;
