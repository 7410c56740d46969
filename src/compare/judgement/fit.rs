//! Whether each pixel is within what a hypothesis allows, and how far it is off.

use crate::compare::allowed::{Choice, Hypothesis};
use crate::compare::image::Image;

/// Codes of 16 bits of 1.
const CODES: f64 = 65535.0;

/// A picture in codes of 16 bits, and which of its pixels count.
#[derive(Debug)]
pub(super) struct Picture<'a> {
    /// Code values: whole ones where the file has codes.
    pub pixels: Vec<[f64; 4]>,
    /// Of each pixel, whether it is not to be looked at.
    ignored: Option<&'a [bool]>,
}

impl<'a> Picture<'a> {
    /// Of a colour, whose alpha is 1 where it has none.
    pub(super) fn of(image: &Image, ignored: Option<&'a [bool]>) -> Self {
        let channels = image.channels();
        let pixel = |values: &[f64]| {
            let alpha = values.get(3).copied().unwrap_or(1.0);
            [values[0], values[1], values[2], alpha].map(|value| value * CODES)
        };
        Self { pixels: image.values().chunks_exact(channels).map(pixel).collect(), ignored }
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

    /// How far each value of the failing pixels is off, in units of 1; 0 everywhere else. Of few colours the nearest counts.
    pub(super) fn distances(&self, hypothesis: &Hypothesis, picture: &Picture) -> Vec<f64> {
        let mut distances = vec![0.0; 4 * self.fails.len()];
        let failing = self.fails.iter().enumerate().filter(|(_, fails)| **fails);
        for (at, _) in failing {
            let pixel = &picture.pixels[at];
            let among = choices_of(&hypothesis.choices, at);
            let ranges = among.iter().map(|row| (row.lo, row.hi));
            let whole = (hypothesis.lo[at], hypothesis.hi[at]);
            let nearest =
                ranges.map(|(lo, hi)| off(pixel, &lo, &hi)).min_by(|a, b| largest(a).total_cmp(&largest(b)));
            let off = nearest.unwrap_or_else(|| off(pixel, &whole.0, &whole.1));
            distances[4 * at..4 * at + 4].copy_from_slice(&off);
        }
        distances
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

fn is_within(pixel: &[f64; 4], lo: &[u16; 4], hi: &[u16; 4]) -> bool {
    let fits = |k: usize| pixel[k] >= f64::from(lo[k]) && pixel[k] <= f64::from(hi[k]);
    fits(0) & fits(1) & fits(2) & fits(3)
}

fn off(pixel: &[f64; 4], lo: &[u16; 4], hi: &[u16; 4]) -> [f64; 4] {
    let channels = [0, 1, 2, 3];
    channels.map(|k| {
        let (lo, hi) = (f64::from(lo[k]), f64::from(hi[k]));
        if pixel[k] < lo {
            (lo - pixel[k]) / CODES
        } else if pixel[k] > hi {
            (pixel[k] - hi) / CODES
        } else {
            0.0
        }
    })
}

fn largest(channels: &[f64; 4]) -> f64 {
    channels.iter().copied().fold(0.0, crate::math::max)
}
