//! The distance of each value from its interval.

use super::expected::{Expected, Mismatch};
use super::image::{Image, Samples};
use std::borrow::Cow;
use std::ops::Sub;

/// How far each value of a picture lies outside its expected interval.
///
/// # Guarantees
/// Every distance is a number, 0 inside the interval and never negative; it may be infinite. Between codes it is a whole number of them, whichever
/// two they are.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference(Image);

impl Difference {
    /// The distances of a picture. A colour without alpha has the alpha 1.
    ///
    /// # Errors
    /// The reason why there are none.
    pub fn of(expected: &Expected, actual: &Image) -> Result<Self, Mismatch> {
        if let Some(mismatch) = Mismatch::between(expected, actual) {
            return Err(mismatch);
        }
        let (lo, hi) = (expected.lo(), expected.hi());
        let channels = lo.channels().max(actual.channels());
        let samples = if let Some(codes) = each([lo, hi, actual], |image| image.codes8(channels)) {
            Samples::Codes8(distances(&codes))
        } else if let Some(codes) = each([lo, hi, actual], |image| image.codes16(channels)) {
            Samples::Codes16(distances(&codes))
        } else {
            Samples::Reals(distances(&[lo, hi, actual].map(|image| image.reals(channels))))
        };
        Ok(Self(Image::filled(actual.width(), actual.height(), channels, samples)))
    }

    /// Distances that are known already.
    pub(super) fn known(distances: Image) -> Self {
        Self(distances)
    }

    /// The distances as a picture.
    pub fn distances(&self) -> &Image {
        &self.0
    }

    /// Those of some pixels alone, in a row; `None` where there are none. `is_kept` tells it of each pixel in row order.
    ///
    /// # Panics
    /// When it does not tell of each.
    pub fn among(&self, is_kept: &[bool]) -> Option<Self> {
        let channels = self.0.channels();
        assert_eq!(self.0.width() * self.0.height(), is_kept.len(), "pixels and what is told of them");
        let kept = self.0.values().enumerate().filter(|(index, _)| is_kept[index / channels]);
        let values: Vec<f64> = kept.map(|(_, value)| value).collect();
        Image::new(values.len() / channels, 1, channels, values).ok().map(Self)
    }

    /// Of the largest distance of each pixel's channels, what this makes of it.
    pub(super) fn of_pixels<T: Copy>(&self, made: impl Fn(f64) -> T) -> Vec<T> {
        let channels = self.0.channels();
        match self.0.samples() {
            Samples::Codes8(codes) => {
                let made: Vec<T> = (0..=u8::MAX).map(|code| made(f64::from(code) / 255.0)).collect();
                largest(codes, channels).map(|code| made[usize::from(code)]).collect()
            }
            Samples::Codes16(codes) => {
                largest(codes, channels).map(|code| made(f64::from(code) / 65535.0)).collect()
            }
            Samples::Reals(values) => {
                let largest = |pixel: &[f64]| pixel.iter().copied().fold(0.0, crate::math::max);
                values.chunks_exact(channels).map(|pixel| made(largest(pixel))).collect()
            }
        }
    }
}

/// The largest code of each pixel.
fn largest<T: Copy + Ord + Default>(codes: &[T], channels: usize) -> impl Iterator<Item = T> {
    codes.chunks_exact(channels).map(|pixel| pixel.iter().copied().fold(T::default(), T::max))
}

/// What this finds in all three, where it finds it in each.
fn each<'a, T: ToOwned + ?Sized>(
    [lo, hi, actual]: [&'a Image; 3],
    found: impl Fn(&'a Image) -> Option<Cow<'a, T>>,
) -> Option<[Cow<'a, T>; 3]> {
    Some([found(lo)?, found(hi)?, found(actual)?])
}

/// The distances of values from their intervals: the lower ends, the upper ends, the values.
fn distances<T: Copy + PartialOrd + Sub<Output = T> + Default>([lo, hi, actual]: &[Cow<[T]>; 3]) -> Vec<T>
where
    [T]: ToOwned,
{
    lo.iter().zip(&**hi).zip(&**actual).map(|((lo, hi), v)| outside(*lo, *hi, *v)).collect()
}

/// The distance of `v` from the interval. Comparing first keeps infinities that are expected at the distance 0.
fn outside<T: PartialOrd + Sub<Output = T> + Default>(lo: T, hi: T, v: T) -> T {
    if v < lo {
        lo - v
    } else if v > hi {
        v - hi
    } else {
        T::default()
    }
}

/// Whether a distance is over a tolerance, and not by the rounding alone of the values that it is the difference of: one
/// step of 8 bits is not over 1/255. Over the tolerance 0 is whatever is not 0.
pub(super) fn is_over(distance: f64, tolerance: f64) -> bool {
    // Values up to 1 and their difference are each rounded by at most 2^-53.
    const ROUNDING: f64 = 1.0 / (1_u64 << 50) as f64;
    distance > if tolerance > 0.0 { tolerance + ROUNDING } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::{Side, ValuePlace};

    fn row(values: &[f64]) -> Image {
        Image::new(values.len(), 1, 1, values.to_vec()).unwrap()
    }

    fn distances(lo: &[f64], hi: &[f64], actual: &[f64]) -> Vec<f64> {
        let expected = Expected::between(row(lo), row(hi)).unwrap();
        Difference::of(&expected, &row(actual)).unwrap().distances().values().collect()
    }

    #[test]
    fn a_value_is_as_far_as_it_lies_outside_its_interval() {
        let (lo, hi) = ([0.25, 0.25, 0.25, 0.25, 0.5], [0.5, 0.5, 0.5, 0.5, 0.5]);
        assert_eq!(distances(&lo, &hi, &[0.0, 0.25, 0.375, 1.0, 0.5]), [0.25, 0.0, 0.0, 0.5, 0.0]);
    }

    #[test]
    fn an_infinity_that_is_expected_is_no_distance_and_one_that_is_not_is_infinite() {
        const INF: f64 = f64::INFINITY;
        let found = distances(&[INF, -INF, INF, 1.0], &[INF, INF, INF, 1.0], &[INF, INF, 3.0, INF]);
        assert_eq!(found, [0.0, 0.0, INF, INF]);
    }

    #[test]
    fn a_colour_without_alpha_is_opaque_on_either_side() {
        let rgb = || Image::new(1, 1, 3, vec![0.0, 0.5, 1.0]).unwrap();
        let rgba = |alpha| Image::new(1, 1, 4, vec![0.0, 0.5, 1.0, alpha]).unwrap();
        let of = |e: Image, a: Image| Difference::of(&Expected::exactly(e), &a).unwrap();
        assert_eq!(of(rgb(), rgba(1.0)).distances().reals(4)[..], [0.0; 4]);
        assert_eq!(of(rgb(), rgba(0.25)).distances().reals(4)[..], [0.0, 0.0, 0.0, 0.75]);
        assert_eq!(of(rgba(0.25), rgb()).distances().reals(4)[..], [0.0, 0.0, 0.0, 0.75]);
    }

    #[test]
    fn a_step_of_codes_is_the_same_between_any_two() {
        let codes = |codes: Vec<u8>| Image::of(255, 1, 1, Samples::Codes8(codes)).unwrap();
        let (from, to) = (codes((0..255).collect()), codes((1..=255).collect()));
        let difference = Difference::of(&Expected::exactly(from), &to).unwrap();
        assert!(difference.distances().values().all(|distance| distance == 1.0 / 255.0));
    }

    #[test]
    fn codes_of_8_bits_are_measured_by_codes_of_16_and_by_any_value() {
        let eight = Image::of(2, 1, 1, Samples::Codes8(vec![0, 100])).unwrap();
        let sixteen = Image::of(2, 1, 1, Samples::Codes16(vec![1, 25_700])).unwrap();
        let of = |e: &Image, a: &Image| {
            let difference = Difference::of(&Expected::exactly(e.clone()), a).unwrap();
            difference.distances().values().collect::<Vec<_>>()
        };
        assert_eq!(of(&eight, &sixteen), [1.0 / 65535.0, 0.0]);
        assert_eq!(of(&row(&[-0.5, 100.0 / 255.0]), &eight), [0.5, 0.0]);
    }

    #[test]
    fn what_cannot_be_measured_is_named() {
        let of = |e: &Image, a: &Image| Difference::of(&Expected::exactly(e.clone()), a).unwrap_err();
        let (two, three) = (row(&[0.0, 0.0]), row(&[0.0, 0.0, 0.0]));
        assert_eq!(of(&two, &three), Mismatch::Size { expected: (2, 1), actual: (3, 1) });
        let pair = Image::new(1, 1, 2, vec![0.0; 2]).unwrap();
        assert_eq!(of(&row(&[0.0]), &pair), Mismatch::Channels { expected: 1, actual: 2 });
        let wrong = row(&[0.0, f64::NAN]);
        let place = ValuePlace { x: 1, y: 0, channel: 0 };
        assert_eq!(of(&two, &wrong), Mismatch::NotANumber { side: Side::Actual, place });
        assert_eq!(of(&wrong, &two), Mismatch::NotANumber { side: Side::Expected, place });
        assert_eq!(of(&wrong, &wrong), Mismatch::NotANumber { side: Side::Expected, place });
    }

    #[test]
    fn some_pixels_are_measured_alone() {
        let picture = Image::new(2, 2, 1, vec![0.0, 0.5, 0.25, 1.0]).unwrap();
        let black = Expected::exactly(Image::new(2, 2, 1, vec![0.0; 4]).unwrap());
        let difference = Difference::of(&black, &picture).unwrap();
        let some = difference.among(&[false, true, true, false]).unwrap().metrics(0.0);
        assert_eq!((some.max, some.mean), (0.5, 0.375));
        assert!(difference.among(&[false; 4]).is_none());
        let colors = Image::new(1, 3, 3, vec![0.0, 0.5, 0.25, 1.0, 1.0, 1.0, 0.125, 0.0, 0.5]).unwrap();
        let black = Expected::exactly(Image::new(1, 3, 3, vec![0.0; 9]).unwrap());
        let some = Difference::of(&black, &colors).unwrap().among(&[true, false, true]).unwrap();
        assert_eq!(some.distances().reals(3)[..], [0.0, 0.5, 0.25, 0.125, 0.0, 0.5]);
        assert_eq!((some.distances().width(), some.distances().channels()), (2, 3));
    }

    #[test]
    fn intervals_that_are_upside_down_or_of_two_sizes_are_refused() {
        let error = Expected::between(row(&[0.0, 0.5]), row(&[0.0, 0.25])).unwrap_err();
        assert!(error.what().contains("pixel 1,0, channel 0 is upside down: 0.5 to 0.25"), "{error}");
        assert!(Expected::between(row(&[0.0]), row(&[0.0, 0.25])).is_err());
    }

    #[test]
    fn one_step_of_a_code_is_not_over_one_step_and_two_are() {
        for codes in [255_u32, 65535] {
            let value = |code: u32| f64::from(code) / f64::from(codes);
            for code in 2..=codes {
                assert!(!is_over(value(code) - value(code - 1), value(1)), "{code} of {codes}");
                assert!(is_over(value(code) - value(code - 2), value(1)), "{code} of {codes}");
            }
        }
        assert!(is_over(5e-324, 0.0) && !is_over(0.0, 0.0));
    }
}
