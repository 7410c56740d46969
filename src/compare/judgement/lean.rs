//! To which side open pixels lean.
//!
//! A right program decides what is open now so, now so: its edges lie a little off to either side. One whose lines are a little too
//! wide, or whose samples are a little off, decides almost all of it one way, though each pixel by itself is allowed.

use super::fit::{Fit, Picture};
use crate::compare::allowed::{Extremes, Hypothesis};
use serde::Serialize;

/// Ends of an open pixel that are nearer tell nothing of it: three 8-bit codes, in codes of 16 bits.
const LEAST_APART: u16 = 3 * 257;
/// So few open pixels tell nothing.
const FEWEST: usize = 30;
/// The share of them that has to lie on one side.
const SHARE: f64 = 0.9;
/// A lean that a fair coin would have so often is chance.
const SIGNIFICANCE: f64 = 1e-6;

/// The open pixels whose two ends are at least three 8-bit codes apart, by the end that they are nearer to. Pixels that fail do not count.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct Lean {
    /// Nearer to the colour of all that is open left out.
    pub out: usize,
    /// Nearer to the colour of all that is open drawn.
    pub drawn: usize,
    /// Right between.
    pub between: usize,
}

/// A lean that is no chance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lopsided {
    /// Whether to the side where more is drawn.
    pub to_drawn: bool,
    /// The pixels on that side.
    pub pixels: usize,
    /// Of so many.
    pub of: usize,
    /// How probable as many heads of a fair coin are.
    pub probability: f64,
}

impl Lean {
    pub(super) fn of(hypothesis: &Hypothesis, picture: &Picture, fit: &Fit) -> Self {
        let mut lean = Self::default();
        for extremes in &hypothesis.extremes {
            let pixel = extremes.pixel as usize;
            if fit.fails[pixel] || !picture.counts(pixel) {
                continue;
            }
            match position(extremes, &picture.pixels[pixel]) {
                None => {}
                Some(at) if at < 0.5 => lean.out += 1,
                Some(at) if at > 0.5 => lean.drawn += 1,
                Some(_) => lean.between += 1,
            }
        }
        lean
    }

    /// How many pixels these are.
    pub fn open(self) -> usize {
        self.out + self.drawn + self.between
    }

    /// Whether they lean so far that it is no chance: at least 30 pixels, at least 90 % of them to one side, and a fair coin would
    /// do so less than once in a million times.
    pub fn lopsided(self) -> Option<Lopsided> {
        let (to_drawn, pixels, of) = (self.drawn > self.out, self.drawn.max(self.out), self.open());
        if of < FEWEST || (pixels as f64) < SHARE * of as f64 {
            return None;
        }
        let probability = heads(pixels, of);
        (probability < SIGNIFICANCE).then_some(Lopsided { to_drawn, pixels, of, probability })
    }
}

/// Where a pixel lies between its ends, by the channel in which they are farthest apart: 0 at the one with everything out, 1 at
/// the other. `None` where they are too near.
fn position(extremes: &Extremes, pixel: &[f32; 4]) -> Option<f64> {
    let Extremes { least, most, .. } = extremes;
    let apart = |k: usize| least[k].abs_diff(most[k]);
    // The first of equal ones.
    let channel = (0..4).rev().max_by_key(|k| apart(*k))?;
    let (from, to) = (f64::from(least[channel]), f64::from(most[channel]));
    (apart(channel) >= LEAST_APART).then(|| (f64::from(pixel[channel]) - from) / (to - from))
}

/// The probability of at least `k` heads in `n` throws of a fair coin, at least half of them heads.
fn heads(k: usize, n: usize) -> f64 {
    // The number of ways to have so many tails, over all ways: its logarithm, which no n makes overflow.
    let mut ln = -(n as f64) * std::f64::consts::LN_2;
    let mut sum = 0.0;
    for tails in 0..=n - k {
        if tails > 0 {
            ln += crate::math::ln((n - tails + 1) as f64 / tails as f64);
        }
        sum += crate::math::exp(ln);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::Image;

    fn lean(out: usize, drawn: usize, between: usize) -> Option<bool> {
        Lean { out, drawn, between }.lopsided().map(|lopsided| lopsided.to_drawn)
    }

    #[test]
    fn heads_are_as_probable_as_counting_says() {
        assert_eq!(heads(2, 2), 0.25);
        assert!((heads(2, 3) - 0.5).abs() < 1e-15);
        // 30 over 0, 1 and 2, of 2^30.
        assert!((heads(28, 30) * f64::from(1 << 30) - 466.0).abs() < 1e-9);
        assert!(heads(1_000_000, 1_000_000) < 1e-300 && heads(510_000, 1_000_000) > 0.0);
    }

    #[test]
    fn a_lean_is_no_chance_from_28_of_30_pixels_and_90_of_100_on() {
        assert_eq!([lean(2, 28, 0), lean(28, 2, 0)], [Some(true), Some(false)]);
        assert_eq!([lean(3, 27, 0), lean(0, 29, 0), lean(0, 28, 2)], [None, None, Some(true)]);
        assert_eq!([lean(100, 900, 0), lean(101, 899, 0), lean(0, 899, 101)], [Some(true), None, None]);
    }

    #[test]
    fn a_pixel_is_nearer_to_one_end_by_the_channel_in_which_they_are_farthest_apart() {
        let extremes = |pixel| Extremes { pixel, least: [0, 9000, 0, 0], most: [1000, 1000, 0, 0] };
        let open = Hypothesis {
            lo: vec![[0; 4]; 5],
            hi: vec![[u16::MAX; 4]; 5],
            extremes: vec![
                extremes(0),
                extremes(1),
                extremes(2),
                Extremes { pixel: 3, least: [0; 4], most: [770; 4] },
                Extremes { pixel: 4, least: [0; 4], most: [771; 4] },
            ],
            ..Hypothesis::default()
        };
        let codes = [[900.0, 8000.0], [100.0, 2000.0], [0.0, 5000.0], [770.0, 770.0], [771.0, 771.0]];
        let values = codes.iter().flat_map(|[r, g]| [r / 65535.0, g / 65535.0, 0.0, 0.0]).collect();
        let image = Image::new(5, 1, 4, values).unwrap();
        let found = |ignored: Option<&[bool]>| {
            let picture = Picture::of(&image, ignored);
            Lean::of(&open, &picture, &Fit::of(&open, &picture))
        };
        assert_eq!(found(None), Lean { out: 1, drawn: 2, between: 1 });
        assert_eq!(found(Some(&[true; 5])), Lean::default());
    }
}
