//! The parameters that a person can set, each said once: name, type, default, range, what it means, where the paper speaks of it.
//!
//! Input: nothing (declarations). Output: of each declaration by `settings!` a struct, whose fields code reads (`settings.samples`), and
//! its [`Settings`]: the table of keys ([`TableShape`]) that the scene file's check, its JSON Schema and its suggestions read, and the way
//! from and to plain values ([`Value`]), which scene files and `result.json` hold. A `words!` enum is said with its words. It refuses
//! nothing itself: `scene_file` does, by the table.

mod color;
mod declare;
mod named;
mod setting;
mod shape;
mod value;

pub(crate) use color::{color, color_names};
pub use declare::Settings;
pub(crate) use declare::settings;
pub use named::Named;
pub(crate) use named::words;
pub use setting::Setting;
pub use shape::{Key, Range, Rule, Shape, TableShape, choice, key};
pub use value::Value;
