//! Who looks on while something is measured.

use crate::error::Result;

/// Lends a clock, and is told what is going on. Nothing that it says or does changes a pixel.
pub trait Watch: Sync {
    /// Milliseconds since any fixed moment.
    fn milliseconds(&self) -> f64;

    /// Another piece of work begins.
    fn start(&self, _what: &str) {}

    /// Another part of that piece of work begins.
    fn part(&self, _what: &str) {}

    /// This share (0..=1) of the work, or of its part, is done; called from any thread.
    fn done(&self, _share: f64) {}

    /// Something that a person should know.
    fn note(&self, _text: &str) {}
}

/// Nobody looks on, and all times are 0.
#[derive(Debug, Clone, Copy)]
pub struct Unwatched;

impl Watch for Unwatched {
    fn milliseconds(&self) -> f64 {
        0.0
    }
}

/// What `f` returns, and the milliseconds it took.
///
/// # Errors
/// Those of `f`.
pub fn timed<T>(watch: &dyn Watch, f: impl FnOnce() -> Result<T>) -> Result<(T, f64)> {
    let start = watch.milliseconds();
    let done = f()?;
    Ok((done, watch.milliseconds() - start))
}
