//! How a run ends: exit status and last words.

use super::refusal;
use clap::ColorChoice;
use drapery::Error;
use std::io::{self, Write};
use std::panic::{self, PanicHookInfo, UnwindSafe};
use std::process::ExitCode;
use std::sync::Once;

const FAILED: u8 = 1;
const REFUSED: u8 = 2;
const BUG: u8 = 3;
const HOW_TO_REPORT: &str =
    "this is a bug in drapery: please report it with the command, the scene and this message";

/// What a subcommand comes to.
pub(super) type Outcome = Result<Status, Stop>;

/// The judgement of a run that came to its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Status {
    /// Done and, where something was judged, it passed.
    Passed,
    /// Judged and failed.
    Failed,
}

/// Why a run did not come to its end.
#[derive(Debug)]
pub(super) enum Stop {
    /// The call or an input is wrong, or there is a bug.
    Refused {
        error: Error,
        /// The text that the error speaks of, where it is not in a file.
        text: Option<String>,
    },
    /// Nobody reads the output any more.
    PipeClosed,
}

impl From<Error> for Stop {
    fn from(error: Error) -> Self {
        Stop::Refused { error, text: None }
    }
}

impl Stop {
    /// Why stdout could not be written.
    pub(super) fn stdout(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::BrokenPipe => Stop::PipeClosed,
            _ => Error::io("stdout cannot be written", error).into(),
        }
    }
}

/// Says the last words and gives the exit status.
pub(super) fn exit(outcome: Outcome, color: ColorChoice) -> ExitCode {
    match outcome {
        Ok(Status::Passed) | Err(Stop::PipeClosed) => ExitCode::SUCCESS,
        Ok(Status::Failed) => ExitCode::from(FAILED),
        Err(Stop::Refused { error, text }) => {
            let internal = error.is_internal();
            let mut message = refusal::message(&error, text.as_deref());
            if internal {
                message.push_str(&format!("{HOW_TO_REPORT}\n"));
            }
            say(&message, color);
            ExitCode::from(if internal { BUG } else { REFUSED })
        }
    }
}

/// Prints a message; a stderr that nobody reads is no reason to fail.
fn say(message: &str, color: ColorChoice) {
    let choice = match color {
        ColorChoice::Auto => anstream::ColorChoice::Auto,
        ColorChoice::Always => anstream::ColorChoice::Always,
        ColorChoice::Never => anstream::ColorChoice::Never,
    };
    let mut stderr = anstream::AutoStream::new(io::stderr(), choice);
    let _ = stderr.write_all(message.as_bytes());
}

/// Ends after what the argument parser has to say: help, the version or a usage error.
pub(super) fn usage(error: &clap::Error) -> ExitCode {
    // A closed pipe is a quiet end here too.
    let _ = error.print();
    u8::try_from(error.exit_code()).map_or(ExitCode::from(REFUSED), ExitCode::from)
}

/// Runs the program to its end, a bug's too: what it has begun to write is cleaned up on the way out.
pub(super) fn guarded(program: impl FnOnce() -> ExitCode + UnwindSafe) -> ExitCode {
    panic::set_hook(Box::new(panicked));
    panic::catch_unwind(program).unwrap_or(ExitCode::from(BUG))
}

/// The last words of a bug that nobody caught, in whatever thread it shows; one bug may show in several.
fn panicked(info: &PanicHookInfo<'_>) {
    static SAID: Once = Once::new();
    SAID.call_once(|| {
        let _ = writeln!(io::stderr(), "internal error: {info}\n{HOW_TO_REPORT}");
    });
}
