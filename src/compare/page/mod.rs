//! One page that shows what was judged: expected, actual, where they differ, and which windows and features fail. It needs no network.

mod case;
mod shown;
mod sign;
mod whole;

pub use shown::Shown;
pub use whole::page;
