//! `drapery compare EXPECTED ACTUAL`

mod arguments;
mod bundle;
mod files;
mod judged;
mod outputs;
mod pictures;
mod run;
mod set;

pub(super) use arguments::Arguments;
pub(super) use run::run;
