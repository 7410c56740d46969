//! Goldens: scenes whose every buffer is known, replayed.
//!
//! Input: a folder of small scenes, `<topic>/<case>.toml`, each with its pictures `<case>.<technique>.png` beside it, and
//! one `manifest.toml` with the hash of every buffer's pixels. Output: what differs ([`check`]), or the manifest and the
//! pictures anew ([`bless`]). Every technique that applies to a scene is replayed, so that a new technique is a golden of
//! every scene it can draw; each picture is drawn twice, with other tiles and threads, and must keep its bits.
//!
//! A case that needs more has a `<case>.golden.toml` beside it: `set`, overrides that the golden is drawn with, and
//! `[[variant]]`s (`name`, `set`, `buffers`, `techniques`), each a change that must not change those buffers of those
//! techniques (where they are not named: any of any).
//!
//! Refuses: a folder without cases, a manifest or settings that cannot be read. What is wrong with a golden is a
//! [`Failure`], each by its own name.

mod bless;
mod case;
mod check;
mod failure;
mod manifest;
mod replay;
mod selection;

pub use bless::{Blessed, bless};
pub use case::{Case, Variant, cases, selected};
pub use check::{Checked, check};
pub use failure::{Failure, Fault};
pub use manifest::{BufferHash, Entry, MANIFEST, Manifest};
pub use replay::{IMAGE, Replay};
pub use selection::Selection;
