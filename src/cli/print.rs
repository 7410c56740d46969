//! What goes to stdout and stderr.

use super::refusal;
use super::stop::{Outcome, Status, Stop};
use std::io::Write;

/// Prints data on stdout.
pub(super) fn print(text: &str) -> Outcome {
    let mut stdout = std::io::stdout().lock();
    stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()).map_err(Stop::stdout)?;
    Ok(Status::Passed)
}

/// Prints a line for people; a stderr that nobody reads is no reason to fail.
pub(super) fn say(line: &str) {
    let _ = writeln!(std::io::stderr(), "{}", refusal::harmless(line));
}
