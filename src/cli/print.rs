//! What goes to stdout and stderr.

use super::refusal;
use super::stop::{Outcome, Status, Stop};
use drapery::output::write_whole;
use drapery::{Error, Result};
use std::io::Write;
use std::path::Path;

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

/// Whether a path means stdout.
fn is_stdout(path: &Path) -> bool {
    path == Path::new("-")
}

/// Refuses files that two options name, and those whose folder is not there, before work is done for them.
pub(super) fn check_files(named: &[(&str, Option<&Path>)]) -> Result<()> {
    let files: Vec<_> = named.iter().filter_map(|(option, path)| Some((option, (*path)?))).collect();
    for (at, (option, path)) in files.iter().enumerate() {
        if let Some((other, _)) = files[..at].iter().find(|(_, other)| other == path) {
            return Err(Error::usage(format!("{other} and {option} name the same file")).help("name two"));
        }
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        if folder.is_some_and(|folder| !folder.is_dir()) {
            return Err(Error::usage("this file cannot be written: its folder is not there").in_file(path));
        }
    }
    Ok(())
}

/// Writes a text into a file, or on stdout where that is `-`. Returns whether it was stdout.
pub(super) fn deliver(path: &Path, text: &str) -> std::result::Result<bool, Stop> {
    if !is_stdout(path) {
        write_whole(path, |to: &mut dyn Write| to.write_all(text.as_bytes()))?;
        return Ok(false);
    }
    print(text)?;
    Ok(true)
}
