//! Pictures as a page shows them: 8 bits a channel.

use crate::buffer::Buffer;
use crate::compare::image::Image;
use crate::error::{Error, Result};
use crate::output::{base64, small_png};

/// The pictures of a case on a page.
#[derive(Debug, Clone, PartialEq)]
pub struct Shown {
    pub(super) width: usize,
    pub(super) height: usize,
    /// As `data:` addresses.
    pub(super) expected: String,
    pub(super) actual: String,
    /// Where the two differ, where that can be told.
    pub(super) heat: Option<String>,
}

impl Shown {
    /// What is expected, what was judged, and where they differ. Colours are shown as they are, within 0 and 1; the first channel of
    /// other values in grey, from the least to the most that is expected.
    ///
    /// # Errors
    /// Internal errors only.
    pub fn of(expected: &Image, actual: &Image, heat: Option<&Buffer<[u8; 4]>>) -> Result<Self> {
        let range = range(expected);
        let address = |picture: &Buffer<[u8; 4]>| {
            let png = small_png(picture)
                .map_err(|error| Error::internal(format!("a picture on a page: {error}")))?;
            Ok(format!("data:image/png;base64,{}", base64(&png)))
        };
        Ok(Self {
            width: expected.width(),
            height: expected.height(),
            expected: address(&visible(expected, range))?,
            actual: address(&visible(actual, range))?,
            heat: heat.map(address).transpose()?,
        })
    }

    /// How many bytes of a page they are.
    pub(super) fn bytes(&self) -> usize {
        self.expected.len() + self.actual.len() + self.heat.as_ref().map_or(0, String::len)
    }
}

fn is_color(image: &Image) -> bool {
    [3, 4].contains(&image.channels())
}

/// What is black and what is white.
fn range(image: &Image) -> (f64, f64) {
    if is_color(image) {
        return (0.0, 1.0);
    }
    let values = image.values().step_by(image.channels()).filter(|value| value.is_finite());
    let (lo, hi) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), v| {
        (crate::math::min(lo, v), crate::math::max(hi, v))
    });
    if lo < hi { (lo, hi) } else { (0.0, 1.0) }
}

fn visible(image: &Image, (lo, hi): (f64, f64)) -> Buffer<[u8; 4]> {
    // A cast keeps within 0..=255; what is not a number is black.
    let code = |value: f64| ((value - lo) / (hi - lo) * 255.0 + 0.5).floor() as u8;
    let pixel = |values: &[f64]| match *values {
        [r, g, b] => [code(r), code(g), code(b), 255],
        [r, g, b, a] => [code(r), code(g), code(b), code(a)],
        _ => [code(values[0]), code(values[0]), code(values[0]), 255],
    };
    let pixels = image.reals(image.channels()).chunks_exact(image.channels()).map(pixel).collect();
    Buffer::from_values(image.width(), image.height(), pixels)
}
