//! When a stored number means "no data".

/// How a file's numbers are stored, as far as comparing them goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Precision {
    /// Whole numbers: the declared value must be one of them.
    Whole,
    /// Single precision: the declared value is rounded to it.
    Single,
    /// Double precision.
    Double,
}

/// A file's nodata value, ready to compare with samples. NaN is no data whatever is declared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Nodata {
    value: Option<f64>,
}

impl Nodata {
    /// The declared value, as it reads after rounding to the samples' own precision.
    pub(super) fn new(declared: Option<f64>, precision: Precision) -> Self {
        let value = match precision {
            Precision::Single => declared.map(to_single),
            Precision::Whole | Precision::Double => declared,
        };
        Self { value }
    }

    /// The sample as a height: NaN where it means no data.
    #[inline]
    pub(super) fn height(self, sample: f64) -> f64 {
        match self.value {
            Some(v) if sample == v || nearly(sample, v) => f64::NAN,
            _ => sample,
        }
    }

    /// Turns samples into heights in place; what is no void is scaled by a factor and an offset.
    pub(super) fn apply(self, samples: &mut [f64], scaling: Option<(f64, f64)>) {
        let (factor, offset) = scaling.unwrap_or((1.0, 0.0));
        for sample in samples {
            *sample = self.height(*sample);
            if scaling.is_some() {
                *sample = *sample * factor + offset;
            }
        }
    }

    /// What a block that the file leaves out stands for: no data if a value is declared for that, else 0 (as GDAL).
    pub(super) fn left_out(self) -> f64 {
        if self.value.is_some() { f64::NAN } else { 0.0 }
    }
}

/// Rounds to single precision; a finite value beyond its range becomes its largest, not infinity.
fn to_single(v: f64) -> f64 {
    let single = f64::from(v as f32);
    if single.is_infinite() && v.is_finite() { f64::from(f32::MAX).copysign(v) } else { single }
}

/// Whether two huge numbers differ by careless printing only, as 3.4028e38 and the largest single-precision number.
#[inline]
fn nearly(sample: f64, value: f64) -> bool {
    const HUGE: f64 = 1e30;
    value.is_finite() && value.abs() >= HUGE && (sample - value).abs() <= value.abs() * 1e-4
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn single_precision_nodata_matches_after_rounding() {
        let nodata = Nodata::new(Some(-9999.9), Precision::Single);
        assert!(nodata.height(f64::from(-9999.9_f32)).is_nan());
        assert_eq!(nodata.height(-9999.0), -9999.0);
    }

    #[test]
    fn carelessly_printed_huge_nodata_matches() {
        let nodata = Nodata::new(Some(-3.4028e38), Precision::Single);
        assert!(nodata.height(f64::from(f32::MIN)).is_nan());
        let overflowing = Nodata::new(Some(3.402_823_6e38), Precision::Double);
        assert!(overflowing.height(f64::from(f32::MAX)).is_nan());
    }

    #[test]
    fn a_fraction_never_matches_whole_numbers() {
        let nodata = Nodata::new(Some(-9999.5), Precision::Whole);
        assert_eq!(nodata.height(-9999.0), -9999.0);
        assert!(!nodata.left_out().is_finite());
    }
}
