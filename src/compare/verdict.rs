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
    relative: f64,
    allow: usize,
    densest: Option<usize>,
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
        Ok(Self { tolerance, allow, ..Self::default() })
    }

    /// The same, and a value may be off by this share of what is expected besides.
    ///
    /// # Errors
    /// When the share is negative, infinite or not a number.
    pub fn with_relative(self, relative: f64) -> Result<Self> {
        if !(relative >= 0.0 && relative.is_finite()) {
            return Err(Error::usage(format!("{relative} is no relative tolerance"))
                .help("it is a share of what is expected, such as 0.001"));
        }
        Ok(Self { relative, ..self })
    }

    /// The same, and no window of 16 x 16 pixels may have more failing pixels than this.
    #[must_use]
    pub fn with_densest(self, densest: usize) -> Self {
        Self { densest: Some(densest), ..self }
    }

    /// The share of what is expected that a value may be off besides.
    pub fn relative(self) -> f64 {
        self.relative
    }

    /// How many failing pixels a window of 16 x 16 may have, where that is limited.
    pub fn densest(self) -> Option<usize> {
        self.densest
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

impl Measured {
    /// The failing pixels in the densest window.
    fn in_window(&self) -> usize {
        self.metrics.densest.map_or(0, |window| window.failing)
    }
}

impl Verdict {
    /// Judges a picture.
    pub fn on(actual: &Image, expected: &Expected, limits: Limits) -> Self {
        let measured = |difference: Difference| {
            let metrics = difference.metrics(limits.tolerance);
            Measured { difference, metrics }
        };
        let outcome = match limits.relative > 0.0 {
            true => Difference::of(&expected.widened(limits.relative), actual),
            false => Difference::of(expected, actual),
        };
        Self { limits, outcome: outcome.map(measured) }
    }

    /// Whether it passed. What cannot be measured has not.
    pub fn passed(&self) -> bool {
        self.failure().is_none()
    }

    /// The name of the failure in reports, where it failed.
    pub fn failure(&self) -> Option<&'static str> {
        match &self.outcome {
            Err(mismatch) => Some(mismatch.name()),
            Ok(measured) if measured.metrics.failing > self.limits.allow => Some("over-tolerance"),
            Ok(measured) if self.limits.densest.is_some_and(|most| measured.in_window() > most) => {
                Some("dense")
            }
            Ok(_) => None,
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
        if let (Some("dense"), Some(most)) = (self.failure(), self.limits.densest) {
            return write!(
                f,
                "FAIL: {} pixels over the tolerance lie in one window ({most} allowed)",
                measured.in_window()
            );
        }
        let distances = measured.difference.distances();
        let relative = match self.limits.relative {
            0.0 => String::new(),
            relative => format!(" and {relative} of what is expected"),
        };
        write!(
            f,
            "{}: {} of {} pixels are over the tolerance {}{relative} ({} allowed)",
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
    fn a_relative_tolerance_is_of_what_is_expected_and_comes_on_top() {
        let image = |values: [f64; 4]| Image::new(4, 1, 1, values.to_vec()).unwrap();
        let expected = Expected::exactly(image([1000.0, -1000.0, 0.0, f64::INFINITY]));
        let failing = |values, limits: Limits| {
            let verdict = Verdict::on(&image(values), &expected, limits);
            verdict.outcome.unwrap().metrics.failing
        };
        let relative = Limits::default().with_relative(0.001).unwrap();
        assert_eq!(failing([1001.0, -1001.0, 0.0, f64::INFINITY], relative), 0);
        assert_eq!(failing([1001.5, -998.5, 0.5, 1e300], relative), 4);
        let both = Limits::new(0.5, 0).unwrap().with_relative(0.001).unwrap();
        assert_eq!(failing([1001.5, -998.5, 0.5, f64::INFINITY], both), 0);
        for wrong in [-0.5, f64::NAN, f64::INFINITY] {
            assert!(Limits::default().with_relative(wrong).is_err());
        }
    }

    #[test]
    fn a_dense_window_is_a_failure_of_its_own() {
        let limits = Limits::new(0.125, 2).unwrap();
        let values = [0.5, 0.0, 0.5, 0.0];
        assert_eq!(verdict(&values, limits.with_densest(2)).failure(), None);
        let failed = verdict(&values, limits.with_densest(1));
        assert_eq!((failed.passed(), failed.failure()), (false, Some("dense")));
        assert_eq!(failed.to_string(), "FAIL: 2 pixels over the tolerance lie in one window (1 allowed)");
    }

    #[test]
    fn limits_are_told_as_they_were_set() {
        let limits = Limits::new(0.125, 7).unwrap();
        assert_eq!((limits.tolerance(), limits.allow()), (0.125, 7));
        assert_eq!((limits.with_densest(3).densest(), limits.densest()), (Some(3), None));
        assert_eq!(Limits::new(0.0, 0).unwrap(), Limits::default());
    }

    #[test]
    fn a_tolerance_is_a_distance() {
        for wrong in [-0.5, f64::NAN, f64::INFINITY] {
            assert!(Limits::new(wrong, 0).unwrap_err().what().ends_with("is no tolerance"));
        }
    }
}
