//! Strips along borders, and what they may change of a pixel's mean paint.

use crate::certainty::PaintRange;
use crate::math;
use crate::terrain::SKY;
use crate::truth::Sample;
use std::f64::consts::{PI, SQRT_2};

/// How far a chord may be off a round border, pixels: what the technique promises.
pub(super) const CHORD: f64 = 1.0 / 512.0;

/// How far a border may be off because a width that grows with the distance is taken as linear, pixels.
pub(super) const BEND: f64 = 1.0 / 256.0;

/// How much may change across a border in a square, by channel.
#[derive(Debug, Clone, Copy)]
pub(super) struct Contrast {
    /// Whatever it is between.
    pub(super) all: [f64; 4],
    /// Between two grounds below the same items.
    pub(super) ground: [f64; 4],
    /// The square's area, pixels.
    area: f64,
}

impl Contrast {
    /// In a square of a side, of which a sample says what may be seen anywhere.
    pub(super) fn of(sample: &Sample, side: f64) -> Self {
        let width = |of: PaintRange| std::array::from_fn(|c| of.high[c] - of.low[c]);
        let grounds = sample.outcomes.iter().filter(|of| of.triangle != SKY).map(|of| of.ground);
        let ground = grounds.reduce(|a, b| a.hull(&b)).map_or([0.0; 4], width);
        let all = width(sample.paint());
        // What is painted over both makes them more alike.
        let ground = std::array::from_fn(|c| math::min(ground[c], all[c]));
        Self { all, ground, area: side * side }
    }

    /// Of an item that covers so much of what it is painted over.
    pub(super) fn at_most(&self, alpha: f64) -> [f64; 4] {
        self.all.map(|of| math::min(of, alpha))
    }
}

/// How far a border may stray, pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Off(pub(super) f64);

impl Off {
    /// A straight one whose ends may stray so far along each axis.
    pub(super) fn straight(shift: f64) -> Self {
        Self(SQRT_2 * shift)
    }
}

/// What all borders of a pixel may change.
#[derive(Debug)]
pub(super) struct Strips {
    contrasts: Vec<Contrast>,
    shift: f64,
    /// Border by border, each counted where it shows.
    sum: [f64; 4],
    /// Square by square.
    of_squares: Vec<[f64; 4]>,
}

impl Strips {
    /// None yet, in squares of these contrasts, whose vertices may stray by a shift.
    pub(super) fn new(contrasts: Vec<Contrast>, shift: f64) -> Self {
        let of_squares = vec![[0.0; 4]; contrasts.len()];
        Self { contrasts, shift, sum: [0.0; 4], of_squares }
    }

    /// Adds a border that is no longer than `whole`, and than its parts in some squares together.
    pub(super) fn add(
        &mut self,
        Off(off): Off,
        whole: f64,
        parts: &[(usize, f64)],
        contrast: impl Fn(&Contrast) -> [f64; 4],
    ) {
        // The strip beside it and round its ends, in a square that is as much larger.
        let strip = |length: f64| off * (length * (1.0 + 6.0 * self.shift) + PI * off);
        let (mut sum, mut most) = ([0.0; 4], [0.0; 4]);
        for (square, length) in parts {
            let across = contrast(&self.contrasts[*square]);
            for c in 0..4 {
                let here = strip(*length) * across[c];
                self.of_squares[*square][c] += here;
                sum[c] += here;
                most[c] = math::max(most[c], across[c]);
            }
        }
        for c in 0..4 {
            self.sum[c] += math::min(sum[c], strip(whole) * most[c]);
        }
    }

    /// All of a square may be anything that may be seen there.
    pub(super) fn open(&mut self, square: usize) {
        let Contrast { all, area, .. } = self.contrasts[square];
        for sum in [&mut self.of_squares[square], &mut self.sum] {
            sum.iter_mut().zip(all).for_each(|(sum, of)| *sum += of * area);
        }
    }

    /// How far each channel of the mean paint may be off: no more than all of each square is open.
    pub(super) fn doubt(&self) -> [f64; 4] {
        std::array::from_fn(|c| {
            let of_squares = self.contrasts.iter().zip(&self.of_squares);
            let by_square: f64 = of_squares.map(|(of, sum)| math::min(sum[c], of.all[c] * of.area)).sum();
            math::min(self.sum[c], by_square)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn strips() -> Strips {
        let contrast = Contrast { all: [1.0; 4], ground: [0.25; 4], area: 0.5 };
        Strips::new(vec![contrast; 2], 0.0)
    }

    #[test]
    fn a_border_changes_its_length_times_how_far_it_strays_times_what_it_is_between() {
        let mut of = strips();
        of.add(Off(1e-3), 1.2, &[(0, 0.8), (1, 0.8)], |contrast| contrast.all);
        assert!((of.doubt()[0] - 1.2e-3).abs() < 1e-5, "no longer than it is in all: {:?}", of.doubt());
        of.add(Off(1e-3), 9.0, &[(1, 0.4)], |contrast| contrast.ground);
        assert!((of.doubt()[0] - 1.3e-3).abs() < 1e-5, "and than its parts: {:?}", of.doubt());
    }

    #[test]
    fn no_more_than_all_of_a_square_is_open() {
        let mut of = strips();
        (0..4).for_each(|_| of.add(Off(0.5), 1.0, &[(1, 1.0)], |contrast| contrast.all));
        of.open(1);
        assert_eq!(of.doubt(), [0.5; 4]);
    }
}
