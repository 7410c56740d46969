//! Values -> files: pictures, buffers, `result.json`, the frame of pages; each file appears whole or not at all.
//!
//! Input: pictures, [`Plane`](crate::buffer::Plane)s and what is to be told of a run. Output: the bytes of PNG, .npy
//! and JSON files, written beside their place and renamed; the files of one run appear together ([`Batch`]).
//! Refuses: values that are not a number and planes whose values do not fill them (bugs of ours), and places that
//! cannot be written.

mod base64;
mod batch;
mod look;
mod npy;
#[cfg(feature = "render")]
mod page;
mod part;
mod picture;
mod result;
mod whole;

pub use base64::base64;
pub use batch::{Batch, StagedFile};
pub use look::look;
pub use npy::{Npy, absolute};
#[cfg(feature = "render")]
pub use page::document;
pub use picture::{small_png, write_codes16, write_png};
pub use result::{
    BufferResult, ByName, ErrorResult, ImageResult, ItemResult, PickResult, PickedItem, PickedRun,
    RESULT_SCHEMA, RenderResult, RunResult, SceneResult, SurfaceError,
};
pub use whole::write_whole;
