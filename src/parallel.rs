//! Ordered parallel maps: the sole user of rayon.
//!
//! Work is cut by the caller into items whose results depend on the items alone; results come back in the items'
//! order, so that no number depends on the number of threads.

use crate::error::{Error, Result};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// `f` of every item, in the order of the items.
pub fn map<T: Sync, U: Send>(items: &[T], f: impl Fn(&T) -> U + Send + Sync) -> Vec<U> {
    items.par_iter().map(f).collect()
}

/// `f` of every item, which it takes, in the order of the items.
pub fn map_owned<T: Send, U: Send>(items: Vec<T>, f: impl Fn(T) -> U + Send + Sync) -> Vec<U> {
    items.into_par_iter().map(f).collect()
}

/// `f` of every index below `n`, in order.
pub fn map_indices<U: Send>(n: usize, f: impl Fn(usize) -> U + Send + Sync) -> Vec<U> {
    (0..n).into_par_iter().map(f).collect()
}

/// `f` of every index below `n`, in order; `tell` is called with the share that is done (0..=1) after each, from any thread.
pub fn map_telling<U: Send>(
    n: usize,
    tell: &(dyn Fn(f64) + Sync),
    f: impl Fn(usize) -> U + Send + Sync,
) -> Vec<U> {
    let progress = Progress::new(n, tell);
    map_indices(n, |k| {
        let made = f(k);
        progress.step();
        made
    })
}

/// Counts pieces of work as they are done, from any thread.
pub struct Progress<'a> {
    pieces: usize,
    tell: &'a (dyn Fn(f64) + Sync),
    done: AtomicUsize,
}

impl<'a> Progress<'a> {
    /// Nothing is done of so many pieces; `tell` is to be called with the share that is done (0..=1).
    pub fn new(pieces: usize, tell: &'a (dyn Fn(f64) + Sync)) -> Self {
        Self { pieces, tell, done: AtomicUsize::new(0) }
    }

    /// A piece more is done.
    pub fn step(&self) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        (self.tell)(done as f64 / self.pieces as f64);
    }
}

/// A thread that does something again and again beside the work, until it is dropped; no result may depend on it.
#[derive(Debug)]
pub struct Beat {
    stop: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl Beat {
    /// Does `f` after each `pause`; `None` where the machine has no thread for it.
    pub fn every(pause: Duration, f: impl Fn() + Send + 'static) -> Option<Self> {
        let (stop, stopped) = mpsc::channel::<()>();
        let beat = move || {
            while stopped.recv_timeout(pause) == Err(RecvTimeoutError::Timeout) {
                f();
            }
        };
        let thread = thread::Builder::new().name("beat".into()).spawn(beat).ok()?;
        Some(Self { stop: Some(stop), thread: Some(thread) })
    }
}

impl Drop for Beat {
    fn drop(&mut self) {
        drop(self.stop.take());
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

/// `f` of every item, in the order of the items, with something of its own for each thread at work, which no result depends on.
pub fn map_with<T: Sync, U: Send, W>(
    items: &[T],
    own: impl Fn() -> W + Send + Sync,
    f: impl Fn(&mut W, &T) -> U + Send + Sync,
) -> Vec<U> {
    items.par_iter().map_init(own, |own, item| f(own, item)).collect()
}

/// Runs `f` over consecutive chunks of `chunk` values, each with its index.
pub fn for_each_chunk<T: Send>(values: &mut [T], chunk: usize, f: impl Fn(usize, &mut [T]) + Send + Sync) {
    values.par_chunks_mut(chunk).enumerate().for_each(|(i, c)| f(i, c));
}

/// Runs `f` over every item.
pub fn for_each<T: Send>(items: &mut [T], f: impl Fn(&mut T) + Send + Sync) {
    items.par_iter_mut().for_each(f);
}

/// Sorts by a key; equal keys keep their order.
pub fn sort_by_key<T: Send, K: Ord>(values: &mut [T], key: impl Fn(&T) -> K + Sync) {
    values.par_sort_by_key(key);
}

/// More threads than this only wait for one another.
const MOST_THREADS: usize = 1024;

/// Lets the thread rest for so long.
pub fn pause(time: Duration) {
    std::thread::sleep(time);
}

/// Runs `f` with `threads` threads (0: as many as the machine has). On a machine that has none (WebAssembly) `f` does everything
/// itself, to the same result.
///
/// # Errors
/// When there are more than any machine has cores for, or the machine refuses them.
pub fn with_threads<U: Send>(threads: usize, f: impl FnOnce() -> U + Send) -> Result<U> {
    if threads > MOST_THREADS {
        return Err(Error::usage(format!(
            "{threads} threads are more than the {MOST_THREADS} that can be used"
        ))
        .help("leave --threads out: there are then as many as the machine has cores"));
    }
    if cfg!(target_family = "wasm") {
        return Ok(f());
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(|e| {
        Error::io(format!("cannot start {threads} threads"), std::io::Error::other(e))
            .help("use a smaller --threads")
    })?;
    Ok(pool.install(f))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Mutex;

    #[test]
    fn a_beat_ends_when_it_is_dropped() {
        let (tell, told) = mpsc::channel();
        let beat = Beat::every(Duration::from_millis(1), move || {
            let _ = tell.send(());
        })
        .unwrap();
        told.recv().unwrap();
        drop(beat);
        while told.try_recv().is_ok() {}
        assert_eq!(told.recv(), Err(mpsc::RecvError), "nobody is left who could send");
    }

    #[test]
    fn progress_is_told_once_a_piece_and_ends_with_all() {
        let told = Mutex::new(Vec::new());
        let squares = map_telling(5, &|share| told.lock().unwrap().push(share), |k| k * k);
        assert_eq!(squares, [0, 1, 4, 9, 16]);
        let mut told = told.into_inner().unwrap();
        told.sort_by(f64::total_cmp);
        assert_eq!(told, [0.2, 0.4, 0.6, 0.8, 1.0]);
    }
}
