//! A call from its arguments to its verdict.

use super::arguments::Arguments;
use super::judged::Call;
use super::{bundle, outputs, pictures, set};
use crate::cli::stop::{Outcome, Status, Stop};
use drapery::Result;
use drapery::compare::{ConformanceSet, Ruling};

pub(in crate::cli) fn run(arguments: &Arguments) -> Outcome {
    outputs::check_names(arguments)?;
    let call = judged(arguments)?;
    outputs::check_inputs(arguments, &call)?;
    match outputs::write(arguments, &call) {
        // Nobody reads the verdict; the exit status still tells it.
        Ok(()) | Err(Stop::PipeClosed) => {}
        Err(stop) => return Err(stop),
    }
    Ok(match call.cases.ruling() {
        Ruling::Pass | Ruling::Weak => Status::Passed,
        Ruling::Fail => Status::Failed,
    })
}

/// A folder is a bundle or a set of them.
fn judged(arguments: &Arguments) -> Result<Call> {
    match arguments.expected.as_deref() {
        Some(folder) if folder.is_dir() => {
            bundle::check_options(arguments)?;
            if ConformanceSet::is_one(folder) {
                set::judged(arguments, folder)
            } else {
                bundle::judged(arguments, folder)
            }
        }
        _ => pictures::judged(arguments),
    }
}
