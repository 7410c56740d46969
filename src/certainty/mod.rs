//! What is known where an answer may still be open, and how such knowledge composes.
//!
//! Input: answers that are in, out or open ([`Known`]), paints between bounds ([`PaintRange`]). Output: the same of what they are put together
//! to, sound (whatever the open answers turn out to be, the result allows for it). It says how uncertainty composes and not who decides,
//! so that judges and what they judge may share it. Refuses: nothing.

mod known;
mod paint;

pub use known::Known;
pub use paint::{PaintMean, PaintRange};
