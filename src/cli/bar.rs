//! What long work shows on a terminal, and on a terminal only; and the only clock there is.

use super::refusal::harmless;
use drapery::measure::Watch;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{self, IsTerminal, Write};
use std::time::Instant;

/// Steps of the bar.
const STEPS: f64 = 1000.0;

/// A bar on stderr: what is being done, and how much of it is done.
pub(super) struct Bar {
    bar: ProgressBar,
    began: Instant,
}

impl Bar {
    #[expect(clippy::disallowed_methods, reason = "this is the clock that the library is lent")]
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
        Self { bar, began: Instant::now() }
    }

    /// Prints a line for people; a stderr that nobody reads is no reason to fail.
    pub(super) fn say(&self, line: &str) {
        self.bar.suspend(|| {
            let _ = writeln!(io::stderr(), "{line}");
        });
    }
}

impl Watch for Bar {
    fn milliseconds(&self) -> f64 {
        self.began.elapsed().as_secs_f64() * 1000.0
    }

    fn start(&self, what: &str) {
        self.bar.set_position(0);
        self.bar.set_message(what.to_owned());
    }

    fn done(&self, share: f64) {
        self.bar.set_position((share * STEPS) as u64);
    }

    fn note(&self, text: &str) {
        self.say(&format!("note: {}", harmless(text)));
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
