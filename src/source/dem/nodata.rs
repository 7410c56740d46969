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

/// The values that mean no data, ready to compare with samples. NaN is no data whatever is declared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Nodata {
    /// NaN, which is equal to nothing, where there are fewer.
    values: [f64; 3],
    /// Whether the file declares one.
    is_declared: bool,
}

impl Nodata {
    /// What the file, what lies beside it and what the user declares, as it reads after rounding to the samples' own precision.
    pub(super) fn new([file, beside, user]: [Option<f64>; 3], precision: Precision) -> Self {
        let rounded = |declared: Option<f64>| match precision {
            Precision::Single => declared.map_or(f64::NAN, to_single),
            Precision::Whole | Precision::Double => declared.unwrap_or(f64::NAN),
        };
        Self { values: [file, beside, user].map(rounded), is_declared: file.is_some() || beside.is_some() }
    }

    /// The sample as a height: NaN where it means no data.
    #[inline]
    pub(super) fn height(self, sample: f64) -> f64 {
        let is_void = self.values.iter().any(|v| sample == *v || nearly(sample, *v));
        if is_void { f64::NAN } else { sample }
    }

    /// Turns samples into heights in place.
    pub(super) fn apply(self, samples: &mut [f64]) {
        samples.iter_mut().for_each(|sample| *sample = self.height(*sample));
    }

    /// What a block that the file leaves out stands for: no data if a value is declared for that, else 0 (as GDAL).
    pub(super) fn left_out(self) -> f64 {
        if self.is_declared { f64::NAN } else { 0.0 }
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

    fn of(declared: f64, precision: Precision) -> Nodata {
        Nodata::new([Some(declared), None, None], precision)
    }

    #[test]
    fn single_precision_nodata_matches_after_rounding() {
        let nodata = of(-9999.9, Precision::Single);
        assert!(nodata.height(f64::from(-9999.9_f32)).is_nan());
        assert_eq!(nodata.height(-9999.0), -9999.0);
    }

    #[test]
    fn carelessly_printed_huge_nodata_matches() {
        let nodata = of(-3.4028e38, Precision::Single);
        assert!(nodata.height(f64::from(f32::MIN)).is_nan());
        let overflowing = of(3.402_823_6e38, Precision::Double);
        assert!(overflowing.height(f64::from(f32::MAX)).is_nan());
    }

    #[test]
    fn a_fraction_never_matches_whole_numbers() {
        let nodata = of(-9999.5, Precision::Whole);
        assert_eq!(nodata.height(-9999.0), -9999.0);
        assert!(!nodata.left_out().is_finite());
    }
}
