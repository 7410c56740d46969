//! Whether each pixel is within what a hypothesis allows, and how far it is off.

use crate::compare::allowed::{Choice, Hypothesis};
use crate::compare::image::Image;

/// Codes of 16 bits of 1.
const CODES: f64 = 65535.0;

/// A picture in codes of 16 bits, and which of its pixels count.
#[derive(Debug)]
pub(super) struct Picture<'a> {
    /// Code values: whole ones where the file has codes, which single precision holds as they are.
    pub pixels: Vec<[f32; 4]>,
    /// Of each pixel, whether it is not to be looked at.
    ignored: Option<&'a [bool]>,
}

impl<'a> Picture<'a> {
    /// Of a colour, whose alpha is 1 where it has none.
    pub(super) fn of(image: &Image, ignored: Option<&'a [bool]>) -> Self {
        let pixels = match image.codes16(4) {
            Some(codes) => codes.as_chunks().0.iter().map(|pixel| pixel.map(f32::from)).collect(),
            None => {
                let code = |value: f64| (value * CODES) as f32;
                image.reals(4).as_chunks().0.iter().map(|pixel| pixel.map(code)).collect()
            }
        };
        Self { pixels, ignored }
    }
}

/// Pixels outside of what a hypothesis allows.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Fit {
    /// Of each pixel, whether it is one.
    pub fails: Vec<bool>,
    /// How many.
    pub failing: usize,
}

impl Fit {
    pub(super) fn of(hypothesis: &Hypothesis, picture: &Picture) -> Self {
        let ends = hypothesis.lo.iter().zip(&hypothesis.hi);
        let mut fails: Vec<bool> =
            picture.pixels.iter().zip(ends).map(|(pixel, (lo, hi))| !is_within(pixel, lo, hi)).collect();
        for rows in hypothesis.choices.chunk_by(|a, b| a.pixel == b.pixel) {
            let at = rows[0].pixel as usize;
            let pixel = &picture.pixels[at];
            fails[at] |= !rows.iter().any(|row| is_within(pixel, &row.lo, &row.hi));
        }
        if let Some(ignored) = picture.ignored {
            fails.iter_mut().zip(ignored).for_each(|(fails, ignored)| *fails &= !ignored);
        }
        let failing = fails.iter().filter(|fails| **fails).count();
        Self { fails, failing }
    }

    /// How far each channel of the failing pixels is off, in units of 1, by pixel. Of few colours the nearest counts.
    pub(super) fn distances(&self, hypothesis: &Hypothesis, picture: &Picture) -> Vec<(usize, [f64; 4])> {
        let distance = |at: usize| {
            let pixel = &picture.pixels[at];
            let choices = choices_of(&hypothesis.choices, at).iter();
            let nearest = choices
                .map(|choice| off(pixel, &choice.lo, &choice.hi))
                .min_by(|a, b| largest(a).total_cmp(&largest(b)));
            (at, nearest.unwrap_or_else(|| off(pixel, &hypothesis.lo[at], &hypothesis.hi[at])))
        };
        let failing = self.fails.iter().enumerate().filter(|(_, fails)| **fails);
        failing.map(|(at, _)| distance(at)).collect()
    }
}

impl Picture<'_> {
    /// Whether a pixel is looked at.
    pub(super) fn counts(&self, pixel: usize) -> bool {
        self.ignored.is_none_or(|ignored| !ignored[pixel])
    }
}

fn choices_of(choices: &[Choice], pixel: usize) -> &[Choice] {
    let from = choices.partition_point(|choice| (choice.pixel as usize) < pixel);
    let to = choices.partition_point(|choice| choice.pixel as usize <= pixel);
    &choices[from..to]
}

#[inline(always)]
fn is_within(pixel: &[f32; 4], lo: &[u16; 4], hi: &[u16; 4]) -> bool {
    let fits = |k: usize| (pixel[k] >= f32::from(lo[k])) & (pixel[k] <= f32::from(hi[k]));
    fits(0) & fits(1) & fits(2) & fits(3)
}

fn off(pixel: &[f32; 4], lo: &[u16; 4], hi: &[u16; 4]) -> [f64; 4] {
    [0, 1, 2, 3].map(|k| {
        let (value, lo, hi) = (f64::from(pixel[k]), f64::from(lo[k]), f64::from(hi[k]));
        if value < lo {
            (lo - value) / CODES
        } else if value > hi {
            (value - hi) / CODES
        } else {
            0.0
        }
    })
}

fn largest(channels: &[f64; 4]) -> f64 {
    channels.iter().copied().fold(0.0, crate::math::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A row of pixels whose first channel is these codes; the others are 0, alpha too.
    fn row(codes: &[f64]) -> Image {
        let values = codes.iter().flat_map(|code| [code / CODES, 0.0, 0.0, 0.0]).collect();
        Image::new(codes.len(), 1, 4, values).unwrap()
    }

    fn hypothesis(ends: &[[u16; 2]], choices: &[(u32, [u16; 2])]) -> Hypothesis {
        let end = |which: usize| ends.iter().map(|ends| [ends[which], 0, 0, 0]).collect();
        let choice =
            |&(pixel, [lo, hi]): &(u32, [u16; 2])| Choice { pixel, lo: [lo, 0, 0, 0], hi: [hi, 0, 0, 0] };
        Hypothesis {
            lo: end(0),
            hi: end(1),
            choices: choices.iter().map(choice).collect(),
            ..Hypothesis::default()
        }
    }

    fn fails(hypothesis: &Hypothesis, codes: &[f64]) -> Vec<bool> {
        Fit::of(hypothesis, &Picture::of(&row(codes), None)).fails
    }

    #[test]
    fn both_ends_of_an_interval_are_allowed_and_the_codes_beside_them_are_not() {
        let between = hypothesis(&[[100, 200]; 6], &[]);
        let found = fails(&between, &[99.0, 100.0, 150.0, 200.0, 201.0, 200.01]);
        assert_eq!(found, [true, false, false, false, true, true]);
    }

    #[test]
    fn every_code_of_a_file_is_itself() {
        let codes: Vec<f64> = (0..=u16::MAX).map(f64::from).collect();
        let exact: Vec<[u16; 2]> = (0..=u16::MAX).map(|code| [code, code]).collect();
        assert_eq!(Fit::of(&hypothesis(&exact, &[]), &Picture::of(&row(&codes), None)).failing, 0);
    }

    #[test]
    fn a_pixel_of_few_colours_is_one_of_them_and_as_far_off_as_from_the_nearest() {
        let few = hypothesis(&[[0, 300]; 4], &[(1, [0, 10]), (1, [200, 300]), (3, [0, 0])]);
        let codes = [150.0, 50.0, 299.0, 0.0];
        assert_eq!(fails(&few, &codes), [false, true, false, false]);
        let picture = row(&codes);
        let picture = Picture::of(&picture, None);
        let distances = Fit::of(&few, &picture).distances(&few, &picture);
        assert_eq!(distances, [(1, [40.0 / CODES, 0.0, 0.0, 0.0])]);
    }

    #[test]
    fn a_choice_does_not_widen_the_interval() {
        assert_eq!(fails(&hypothesis(&[[0, 5]], &[(0, [0, 300])]), &[100.0]), [true]);
    }

    #[test]
    fn a_picture_without_alpha_is_opaque_and_ignored_pixels_do_not_fail() {
        let rgb = Image::new(2, 1, 3, vec![0.0; 6]).unwrap();
        let opaque = Hypothesis {
            lo: vec![[0, 0, 0, 65535]; 2],
            hi: vec![[0, 0, 0, 65535]; 2],
            ..Hypothesis::default()
        };
        assert_eq!(Fit::of(&opaque, &Picture::of(&rgb, None)).failing, 0);
        let clear = Hypothesis { lo: vec![[0; 4]; 2], hi: vec![[0; 4]; 2], ..Hypothesis::default() };
        assert_eq!(Fit::of(&clear, &Picture::of(&rgb, Some(&[true, false]))).fails, [false, true]);
    }
}
