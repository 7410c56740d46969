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

/// Refuses a picture whose pixels cannot come out of a file of so many bytes, before memory is taken for them.
pub(super) fn check_promise(pixel_bytes: u64, file: usize) -> Result<()> {
    /// The most that a byte of a file stands for: deflate's 1032, and its half for methods that halve the samples first.
    const MOST_FROM_BYTE: u64 = 2064;
    if pixel_bytes > (file as u64).saturating_mul(MOST_FROM_BYTE) {
        return Err(Error::new(format!(
            "its {file} bytes cannot hold the {pixel_bytes} bytes of pixels that it promises"
        ))
        .help("it may be half a download: fetch or write it again"));
    }
    Ok(())
}
