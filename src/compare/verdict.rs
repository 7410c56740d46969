//! The verdict on a picture.

use super::difference::Difference;
use super::expected::{Expected, Mismatch};
use super::image::Image;
use super::metrics::Metrics;
use crate::buffer::Buffer;
use crate::error::{Error, Result};
use std::fmt;

/// What a picture may be off by.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Limits {
    tolerance: f64,
    allow: usize,
}

impl Limits {
    /// A pixel fails when one of its values is off by more than `tolerance`; a picture fails when more than `allow`
    /// pixels do. The default is 0 and 0.
    ///
    /// # Errors
    /// When the tolerance is negative, infinite or not a number.
    pub fn new(tolerance: f64, allow: usize) -> Result<Self> {
        if !(tolerance >= 0.0 && tolerance.is_finite()) {
            return Err(Error::usage(format!("{tolerance} is no tolerance"))
                .help("it is a distance in units of 1, such as 0, 0.01 or 2/255"));
        }
        Ok(Self { tolerance, allow })
    }

    /// How far a value may be off.
    pub fn tolerance(self) -> f64 {
        self.tolerance
    }

    /// How many pixels may be off by more.
    pub fn allow(self) -> usize {
        self.allow
    }
}

/// A picture, judged.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// What it may be off by.
    pub limits: Limits,
    /// How far it is off, or why that cannot be measured.
    pub outcome: std::result::Result<Measured, Mismatch>,
}

/// How far a picture is off.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// Value by value.
    pub difference: Difference,
    /// In numbers.
    pub metrics: Metrics,
}

impl Verdict {
    /// Judges a picture.
    pub fn on(actual: &Image, expected: &Expected, limits: Limits) -> Self {
        let measured = |difference: Difference| {
            let metrics = difference.metrics(limits.tolerance);
            Measured { difference, metrics }
        };
        Self { limits, outcome: Difference::of(expected, actual).map(measured) }
    }

    /// Whether it passed. What cannot be measured has not.
    pub fn passed(&self) -> bool {
        self.outcome.as_ref().is_ok_and(|measured| measured.metrics.failing <= self.limits.allow)
    }

    /// The name of the failure in reports, where it failed.
    pub fn failure(&self) -> Option<&'static str> {
        match &self.outcome {
            Err(mismatch) => Some(mismatch.name()),
            Ok(_) if self.passed() => None,
            Ok(_) => Some("over-tolerance"),
        }
    }

    /// Where and how far it is off, as a picture.
    pub fn heat_map(&self) -> Option<Buffer<[u8; 4]>> {
        let measured = self.outcome.as_ref().ok()?;
        Some(measured.difference.heat_map(self.limits.tolerance))
    }
}

/// The verdict in a line.
impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let measured = match &self.outcome {
            Ok(measured) => measured,
            Err(mismatch) => return write!(f, "FAIL: {mismatch}"),
        };
        let distances = measured.difference.distances();
        write!(
            f,
            "{}: {} of {} pixels are over the tolerance {} ({} allowed)",
            if self.passed() { "PASS" } else { "FAIL" },
            measured.metrics.failing,
            distances.width() * distances.height(),
            self.limits.tolerance,
            self.limits.allow
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn verdict(values: &[f64], limits: Limits) -> Verdict {
        let image = |values: Vec<f64>| Image::new(values.len(), 1, 1, values).unwrap();
        let expected = Expected::exactly(image(vec![0.5; values.len()]));
        Verdict::on(&image(values.to_vec()), &expected, limits)
    }

    #[test]
    fn one_pixel_too_many_fails() {
        let limits = |allow| Limits::new(0.125, allow).unwrap();
        let values = [0.5, 0.625, 0.375, 0.75, 0.0];
        assert!(verdict(&values, limits(2)).passed());
        let failed = verdict(&values, limits(1));
        assert_eq!((failed.passed(), failed.failure()), (false, Some("over-tolerance")));
        assert_eq!(failed.to_string(), "FAIL: 2 of 5 pixels are over the tolerance 0.125 (1 allowed)");
    }

    #[test]
    fn what_cannot_be_measured_fails_whatever_is_allowed() {
        let all = Limits::new(1e300, usize::MAX).unwrap();
        let failed = verdict(&[0.5, f64::NAN], all);
        assert_eq!((failed.passed(), failed.failure()), (false, Some("not-a-number")));
        assert_eq!(failed.heat_map(), None);
        let small = Expected::exactly(Image::new(1, 1, 1, vec![0.5]).unwrap());
        let wide = Image::new(2, 1, 1, vec![0.5; 2]).unwrap();
        assert_eq!(Verdict::on(&wide, &small, all).failure(), Some("another-size"));
    }

    #[test]
    fn what_was_measured_has_a_heat_map_by_the_same_tolerance() {
        let limits = Limits::new(0.125, 0).unwrap();
        let judged = verdict(&[0.5, 0.75, 0.5625], limits);
        let measured = judged.outcome.as_ref().unwrap();
        let [passing, failing] = [1.0, limits.tolerance()].map(|most| measured.difference.heat_map(most));
        assert_ne!(passing, failing);
        assert_eq!(judged.heat_map(), Some(failing));
    }

    #[test]
    fn limits_are_told_as_they_were_set() {
        let limits = Limits::new(0.125, 7).unwrap();
        assert_eq!((limits.tolerance(), limits.allow()), (0.125, 7));
        assert_eq!(Limits::new(0.0, 0).unwrap(), Limits::default());
    }

    #[test]
    fn a_tolerance_is_a_distance() {
        for wrong in [-0.5, f64::NAN, f64::INFINITY] {
            assert!(Limits::new(wrong, 0).unwrap_err().what().ends_with("is no tolerance"));
        }
    }
}
