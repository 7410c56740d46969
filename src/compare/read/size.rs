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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_is_too_large_from_one_pixel_or_channel_more_than_the_most() {
        assert!(check_size(MOST_PIXELS / 4, 4, MOST_CHANNELS).is_ok());
        for (width, height, channels) in
            [(MOST_PIXELS + 1, 1, 1), (1, 1, MOST_CHANNELS + 1), (usize::MAX, usize::MAX, 1)]
        {
            let error = check_size(width, height, channels).unwrap_err();
            assert!(error.what().ends_with("is too large to compare"), "{error}");
        }
        assert_eq!((MOST_PIXELS, MOST_CHANNELS), (67_108_864, 64));
    }

    #[test]
    fn a_file_holds_no_more_than_2064_bytes_of_pixels_a_byte() {
        assert!(check_promise(10 * 2064, 10).is_ok());
        let error = check_promise(10 * 2064 + 1, 10).unwrap_err();
        assert_eq!(error.what(), "its 10 bytes cannot hold the 20641 bytes of pixels that it promises");
    }
}
