//! `drapery info FILE`

use super::stop::Outcome;
use drapery::Error;
use std::path::PathBuf;

#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// A terrain or vector file.
    file: PathBuf,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    std::fs::metadata(&arguments.file)
        .map_err(|error| Error::new(format!("this file cannot be read: {error}")).in_file(&arguments.file))?;
    Err(Error::internal("`info` is not built yet").into())
}
