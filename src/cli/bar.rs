//! What long work shows: a bar where stderr is a terminal, a line now and then where it is none; and the only clock there is.

use super::lines::Lines;
use super::refusal::harmless;
use drapery::measure::Watch;
use drapery::parallel::Beat;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{self, IsTerminal, Write};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Steps of the bar.
const STEPS: f64 = 1000.0;

/// How often a bar shows that the program lives.
const TICK: Duration = Duration::from_millis(200);

/// How often it is looked whether a line is due.
const LOOK: Duration = Duration::from_millis(500);

/// What is being done, and how much of it is done, on stderr.
pub(super) struct Bar {
    began: Instant,
    shown: Shown,
}

enum Shown {
    Bar(ProgressBar, Mutex<String>),
    Lines(Arc<Mutex<Lines>>, Option<Beat>),
}

impl Bar {
    #[expect(clippy::disallowed_methods, reason = "this is the clock that the library is lent")]
    pub(super) fn new() -> Self {
        let began = Instant::now();
        let shown = if io::stderr().is_terminal() {
            let bar = ProgressBar::with_draw_target(Some(STEPS as u64), ProgressDrawTarget::stderr());
            if let Ok(style) =
                ProgressStyle::with_template("{spinner} {msg:28} {wide_bar} {percent:>3} % {elapsed:>4}")
            {
                bar.set_style(style);
            }
            bar.enable_steady_tick(TICK);
            Shown::Bar(bar, Mutex::default())
        } else {
            let lines = Arc::new(Mutex::new(Lines::default()));
            let seen = Arc::clone(&lines);
            // Some steps tell nothing until they are done, so somebody else must look whether a line is due.
            let look = Beat::every(LOOK, move || {
                let due = locked(&seen).due(began.elapsed().as_secs_f64());
                if let Some(line) = due {
                    let _ = writeln!(io::stderr(), "{}", harmless(&line));
                }
            });
            Shown::Lines(lines, look)
        };
        Self { began, shown }
    }

    /// Prints a line for people; a stderr that nobody reads is no reason to fail.
    pub(super) fn say(&self, line: &str) {
        let print = || {
            let _ = writeln!(io::stderr(), "{line}");
        };
        match &self.shown {
            Shown::Bar(bar, _) => bar.suspend(print),
            Shown::Lines(..) => print(),
        }
    }
}

impl Watch for Bar {
    fn milliseconds(&self) -> f64 {
        self.began.elapsed().as_secs_f64() * 1000.0
    }

    fn start(&self, what: &str) {
        match &self.shown {
            Shown::Bar(bar, step) => {
                *locked(step) = what.to_owned();
                bar.set_position(0);
                bar.reset_elapsed();
                bar.set_message(harmless(what));
            }
            Shown::Lines(lines, _) => locked(lines).start(what),
        }
    }

    fn part(&self, what: &str) {
        match &self.shown {
            Shown::Bar(bar, step) => {
                bar.set_position(0);
                bar.set_message(harmless(&format!("{}, {what}", locked(step))));
            }
            Shown::Lines(lines, _) => locked(lines).part(what),
        }
    }

    fn done(&self, share: f64) {
        match &self.shown {
            Shown::Bar(bar, _) => bar.set_position((share * STEPS) as u64),
            Shown::Lines(lines, _) => locked(lines).done(share),
        }
    }

    fn note(&self, text: &str) {
        self.say(&format!("note: {}", harmless(text)));
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        match &mut self.shown {
            Shown::Bar(bar, _) => bar.finish_and_clear(),
            Shown::Lines(_, look) => drop(look.take()),
        }
    }
}

/// What is guarded; what another thread left when it died is as good as any.
fn locked<T>(guarded: &Mutex<T>) -> MutexGuard<'_, T> {
    guarded.lock().unwrap_or_else(PoisonError::into_inner)
}
