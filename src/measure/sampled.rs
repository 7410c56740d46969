//! Plain supersampling, timed.

use super::{Times, Watch, timed, unequal};
use crate::error::Result;
use crate::sampling::{Sampled, sample};
use crate::space::ViewFrame;
use crate::stage::Stage;

/// A picture of n x n samples a pixel, drawn `repeat` times (at least once).
///
/// # Errors
/// An internal error where two of them differ.
pub fn supersampled(
    (stage, view): (&Stage, &ViewFrame),
    n: usize,
    repeat: u32,
    watch: &dyn Watch,
) -> Result<(Sampled, Times)> {
    let once = || timed(watch, || Ok(sample(stage, view, n, &|share| watch.done(share))));
    let (sampled, first) = once()?;
    let mut times = vec![first];
    for _ in 1..repeat {
        let (again, ms) = once()?;
        if again.colors != sampled.colors {
            return Err(unequal("supersampling"));
        }
        times.push(ms);
    }
    Ok((sampled, Times::of(times)))
}
