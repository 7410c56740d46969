//! What long work shows on a terminal, and on a terminal only.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{self, IsTerminal, Write};

/// Steps of the bar.
const STEPS: f64 = 1000.0;

/// A bar on stderr: what is being done, and how much of it is done.
pub(super) struct Bar(ProgressBar);

impl Bar {
    pub(super) fn new() -> Self {
        let target = if io::stderr().is_terminal() {
            ProgressDrawTarget::stderr()
        } else {
            ProgressDrawTarget::hidden()
        };
        let bar = ProgressBar::with_draw_target(Some(STEPS as u64), target);
        if let Ok(style) = ProgressStyle::with_template("{msg:20} {wide_bar} {percent:>3} %") {
            bar.set_style(style);
        }
        Self(bar)
    }

    /// Starts another piece of work.
    pub(super) fn start(&self, what: &str) {
        self.0.set_position(0);
        self.0.set_message(what.to_owned());
    }

    /// Shows the share (0..=1) of the work that is done.
    pub(super) fn done(&self, share: f64) {
        self.0.set_position((share * STEPS) as u64);
    }

    /// Prints a line for people; a stderr that nobody reads is no reason to fail.
    pub(super) fn say(&self, line: &str) {
        self.0.suspend(|| {
            let _ = writeln!(io::stderr(), "{line}");
        });
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
