//! How large a picture may be.

use crate::error::{Error, Result};

/// The largest picture that is read, in pixels.
pub(super) const MOST_PIXELS: usize = 1 << 26;
/// The most values a pixel may have.
const MOST_CHANNELS: usize = 64;

/// Refuses a picture that is too large to compare, before memory is taken for it.
pub(super) fn check_size(width: usize, height: usize, channels: usize) -> Result<()> {
    let pixels = width.checked_mul(height);
    if channels > MOST_CHANNELS || pixels.is_none_or(|pixels| pixels > MOST_PIXELS) {
        return Err(Error::unsupported(format!(
            "a picture of {width} x {height} pixels of {channels} channels is too large to compare"
        ))
        .help(format!("at most {MOST_PIXELS} pixels of {MOST_CHANNELS} channels can be")));
    }
    Ok(())
}
