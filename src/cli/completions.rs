//! `drapery completions SHELL`

use super::print::print;
use super::stop::Outcome;

#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// The shell.
    shell: clap_complete::Shell,
}

pub(super) fn run(arguments: &Arguments, program: &mut clap::Command) -> Outcome {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, program, "drapery", &mut script);
    print(&String::from_utf8_lossy(&script))
}
