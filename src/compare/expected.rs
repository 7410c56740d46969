//! What is expected of a picture, and what cannot be measured against it.

use super::image::{Image, ValuePlace};
use crate::error::{Error, Result};
use std::fmt;

/// What is expected: an interval for each value of a picture. One picture is the interval of no width.
///
/// # Guarantees
/// Both ends are of one size, and no lower end lies above its upper end.
#[derive(Debug, Clone, PartialEq)]
pub struct Expected {
    lo: Image,
    /// `None`: the same as `lo`.
    hi: Option<Image>,
}

impl Expected {
    /// This picture and no other.
    pub fn exactly(image: Image) -> Self {
        Self { lo: image, hi: None }
    }

    /// Every picture between these two, ends included.
    ///
    /// # Errors
    /// When they differ in size, or a lower end lies above its upper end.
    pub fn between(lo: Image, hi: Image) -> Result<Self> {
        if shape(&lo) != shape(&hi) {
            return Err(Error::usage("the two ends of the expected intervals differ in size or channels"));
        }
        if let Some(index) = lo.values().zip(hi.values()).position(|(lo, hi)| lo > hi) {
            let ValuePlace { x, y, channel } = lo.place(index);
            return Err(Error::usage(format!(
                "the expected interval of pixel {x},{y}, channel {channel} is upside down: {} to {}",
                lo.value(index),
                hi.value(index)
            )));
        }
        Ok(Self { lo, hi: Some(hi) })
    }

    /// The same, each end moved outward by a share of itself. Infinite ends stay.
    pub(super) fn widened(&self, share: f64) -> Self {
        let moved = |image: &Image, sign: f64| {
            image.map(|value| if value.is_finite() { value + sign * share * value.abs() } else { value })
        };
        Self { lo: moved(&self.lo, -1.0), hi: Some(moved(self.hi(), 1.0)) }
    }

    /// The same, and of some pixels whatever there is.
    ///
    /// # Panics
    /// When it is not told of each pixel.
    #[must_use]
    pub fn ignoring(&self, ignored: &[bool]) -> Self {
        let (lo, hi) = (self.lo.with(f64::NEG_INFINITY, ignored), self.hi().with(f64::INFINITY, ignored));
        Self { lo, hi: Some(hi) }
    }

    /// The lower ends.
    pub fn lo(&self) -> &Image {
        &self.lo
    }

    /// The upper ends.
    pub fn hi(&self) -> &Image {
        self.hi.as_ref().unwrap_or(&self.lo)
    }
}

/// Width, height and channels.
fn shape(image: &Image) -> [usize; 3] {
    [image.width(), image.height(), image.channels()]
}

/// One of the two sides of a comparison.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// What is expected.
    Expected,
    /// What is judged.
    Actual,
}

/// Why two pictures have no distance: each is a failure of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Mismatch {
    /// They differ in size: columns and rows of both.
    Size {
        /// What is expected.
        expected: (usize, usize),
        /// What is judged.
        actual: (usize, usize),
    },
    /// They differ in the number of channels, and not by an alpha.
    Channels {
        /// What is expected.
        expected: usize,
        /// What is judged.
        actual: usize,
    },
    /// A value is not a number.
    NotANumber {
        /// Whose.
        side: Side,
        /// The first such value.
        place: ValuePlace,
    },
}

impl Mismatch {
    /// Its name in reports.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Size { .. } => "another-size",
            Self::Channels { .. } => "other-channels",
            Self::NotANumber { .. } => "not-a-number",
        }
    }

    /// What there is between the two, if anything.
    pub(super) fn between(expected: &Expected, actual: &Image) -> Option<Self> {
        let size = |image: &Image| (image.width(), image.height());
        if size(&expected.lo) != size(actual) {
            return Some(Self::Size { expected: size(&expected.lo), actual: size(actual) });
        }
        let channels = (expected.lo.channels(), actual.channels());
        if channels.0 != channels.1 && ![(3, 4), (4, 3)].contains(&channels) {
            return Some(Self::Channels { expected: channels.0, actual: channels.1 });
        }
        let wrong = [(Side::Expected, &expected.lo), (Side::Expected, expected.hi()), (Side::Actual, actual)];
        let found =
            |(side, image): (Side, &Image)| Some(Self::NotANumber { side, place: image.first_nan()? });
        wrong.into_iter().find_map(found)
    }
}

impl std::error::Error for Mismatch {}

impl fmt::Display for Mismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Size { expected, actual } => write!(
                f,
                "another size: {} x {} pixels are expected, the picture has {} x {}",
                expected.0, expected.1, actual.0, actual.1
            ),
            Self::Channels { expected, actual } => {
                write!(f, "other channels: {expected} a pixel are expected, the picture has {actual}")
            }
            Self::NotANumber { side, place: ValuePlace { x, y, channel } } => {
                let whose = match side {
                    Side::Expected => "the expected picture",
                    Side::Actual => "the picture",
                };
                write!(f, "not a number: {whose} has a NaN at pixel {x},{y}, channel {channel}")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::{Limits, Verdict};

    #[test]
    fn ignored_pixels_may_be_anything() {
        let image = |values: [f64; 4]| Image::new(2, 1, 2, values.to_vec()).unwrap();
        let expected = Expected::exactly(image([0.0, 0.5, 0.25, 1.0]));
        let ignored = [true, false];
        let judged = |values| {
            Verdict::on(&image(values).without(&ignored), &expected.ignoring(&ignored), Limits::default())
        };
        assert!(judged([f64::NAN, f64::INFINITY, 0.25, 1.0]).passed());
        assert!(!judged([0.0, 0.5, 0.25, 0.9]).passed());
    }
}
