//! Which machine is this? Small pictures whose pixels tell how a device rounds, and the `[device]` table that they make.
//!
//! Input: a folder of pictures that a client has drawn. Output: instructions for these pictures ([`write_instructions`]), and from them the keys of
//! `[device]` with what was seen ([`read`]); tables of known devices ([`KNOWN`], [`changes`]). Each picture asks one question, in cells that do not
//! touch one another (`pictures`); `reading` answers it. Refuses: pictures that contradict one another or themselves, other sizes, folders without any.

mod answers;
mod drawing;
mod instructions;
mod pictures;
mod reading;
mod sheet;
mod table;
#[cfg(test)]
mod tests;
mod weights;

pub use instructions::write_instructions;
pub use reading::read;
pub use table::{KNOWN, changes};
