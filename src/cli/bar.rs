//! What long work shows: a bar where stderr is a terminal, a line now and then where it is none; and the only clock there is.

use super::lines::Lines;
use super::refusal::harmless;
use drapery::measure::Watch;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{self, IsTerminal, Write};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};
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
    Lines(Arc<Mutex<Lines>>, Option<Looking>),
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
            let looking = Looking::at(Arc::clone(&lines), began);
            Shown::Lines(lines, looking)
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
            Shown::Lines(_, looking) => drop(looking.take()),
        }
    }
}

/// A thread that looks whether a line is due: some steps tell nothing until they are done.
struct Looking {
    stop: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl Looking {
    /// `None` where there are no threads: then there are no lines either.
    fn at(lines: Arc<Mutex<Lines>>, began: Instant) -> Option<Self> {
        let (stop, stopped) = mpsc::channel::<()>();
        let look = move || {
            while stopped.recv_timeout(LOOK) == Err(RecvTimeoutError::Timeout) {
                let due = locked(&lines).due(began.elapsed().as_secs_f64());
                if let Some(line) = due {
                    let _ = writeln!(io::stderr(), "{}", harmless(&line));
                }
            }
        };
        let thread = thread::Builder::new().name("progress".into()).spawn(look).ok()?;
        Some(Self { stop: Some(stop), thread: Some(thread) })
    }
}

impl Drop for Looking {
    fn drop(&mut self) {
        drop(self.stop.take());
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

/// What is guarded; what another thread left when it died is as good as any.
fn locked<T>(guarded: &Mutex<T>) -> MutexGuard<'_, T> {
    guarded.lock().unwrap_or_else(PoisonError::into_inner)
}
