//! Pictures as numbers, and how they differ.

use crate::buffer::Buffer;
use crate::math;
use crate::truth::Truth;

/// A picture: encoded RGBA of straight alpha, 0 to 1.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Picture {
    pub(super) width: usize,
    pub(super) values: Vec<[f64; 4]>,
}

/// A step of an 8-bit code.
pub(super) const STEP: f64 = 1.0 / 255.0;
/// What the rounding of sums may do.
const ROUNDING: f64 = 1e-9;

impl Picture {
    /// Code values.
    pub(super) fn of_codes(image: &Buffer<[u8; 4]>) -> Self {
        let of = |code: &[u8; 4]| code.map(|c| f64::from(c) / 255.0);
        Self { width: image.width(), values: image.values().iter().map(of).collect() }
    }

    /// The truth's estimate, not rounded.
    pub(super) fn of_truth(truth: &Truth) -> Self {
        Self { width: truth.estimate.width(), values: truth.estimate.values().to_vec() }
    }

    pub(super) fn height(&self) -> usize {
        self.values.len() / self.width.max(1)
    }

    /// The red channel of a pixel: what is covered, in white on black.
    pub(super) fn shade(&self, x: usize, y: usize) -> f64 {
        self.values[y * self.width + x][0]
    }

    /// All that is covered, in pixels.
    pub(super) fn covered(&self) -> f64 {
        self.values.iter().map(|value| value[0]).sum()
    }

    /// What is covered of a column.
    pub(super) fn column(&self, x: usize) -> f64 {
        (0..self.height()).map(|y| self.shade(x, y)).sum()
    }

    /// Where what is covered has its middle, pixels.
    pub(super) fn middle(&self) -> [f64; 2] {
        let mut sums = [0.0; 3];
        for (k, value) in self.values.iter().enumerate() {
            let place = [(k % self.width) as f64 + 0.5, (k / self.width) as f64 + 0.5, 1.0];
            (0..3).for_each(|c| sums[c] += value[0] * place[c]);
        }
        [sums[0] / sums[2], sums[1] / sums[2]]
    }

    /// The indices of a pixel and those around it, up to `radius` away.
    pub(super) fn around(&self, k: usize, radius: usize) -> impl Iterator<Item = usize> {
        let (x, y, width) = (k % self.width, k / self.width, self.width);
        let columns = x.saturating_sub(radius)..(x + radius + 1).min(width);
        let rows = y.saturating_sub(radius)..(y + radius + 1).min(self.height());
        rows.flat_map(move |row| columns.clone().map(move |column| row * width + column))
    }

    /// Whether all pixels around one look as it does.
    pub(super) fn is_even(&self, k: usize, radius: usize) -> bool {
        self.around(k, radius).all(|other| distance(&self.values[k], &self.values[other]) <= STEP + ROUNDING)
    }
}

/// How far apart two values are in any channel.
pub(super) fn distance(a: &[f64; 4], b: &[f64; 4]) -> f64 {
    (0..4).fold(0.0, |most, c| math::max(most, (a[c] - b[c]).abs()))
}

/// How many pixels differ.
pub(super) fn differing(a: &Picture, b: &Picture) -> usize {
    differing_by(ROUNDING, a, b)
}

/// How many pixels differ by more than so much.
pub(super) fn differing_by(more_than: f64, a: &Picture, b: &Picture) -> usize {
    let differ = |(a, b): &(&[f64; 4], &[f64; 4])| distance(a, b) > more_than;
    a.values.iter().zip(&b.values).filter(differ).count() + a.values.len().abs_diff(b.values.len())
}

/// The largest difference of any pixel.
pub(super) fn farthest(a: &Picture, b: &Picture) -> f64 {
    a.values.iter().zip(&b.values).fold(0.0, |most, (a, b)| math::max(most, distance(a, b)))
}

/// How many pixels of a picture are wrong by more than three code values where the right one is the same all around: no border, no sampling and
/// no rounding excuses them.
pub(super) fn wrong_inside(picture: &Picture, right: &Picture) -> usize {
    let is_wrong =
        |k: &usize| distance(&picture.values[*k], &right.values[*k]) > 3.0 * STEP && right.is_even(*k, 1);
    (0..picture.values.len()).filter(is_wrong).count()
}

/// How many pixels show something although nothing is covered within two pixels of them.
pub(super) fn stray(picture: &Picture, right: &Picture) -> usize {
    let is_stray = |k: &usize| {
        picture.values[*k][0] > 3.0 * STEP
            && right.around(*k, 2).all(|other| right.values[other][0] < ROUNDING)
    };
    (0..picture.values.len()).filter(is_stray).count()
}

/// The root mean square of all channels' differences.
pub(super) fn rmse(a: &Picture, b: &Picture) -> f64 {
    let square = |(a, b): (&[f64; 4], &[f64; 4])| (0..4).map(|c| (a[c] - b[c]) * (a[c] - b[c])).sum::<f64>();
    let sum: f64 = a.values.iter().zip(&b.values).map(square).sum();
    (sum / (4 * a.values.len().max(1)) as f64).sqrt()
}
