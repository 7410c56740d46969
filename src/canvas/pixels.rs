//! Paints of pixels -> code values and, where they are wanted, colours.

use super::frame::Kept;
use crate::resolve::{Compositor, Paint, code_values};

/// Finished pixels, in the order in which they were pushed.
#[derive(Debug)]
pub struct Pixels {
    compositor: Compositor,
    /// The last paint of features and the last of the ground alone, with their code values: neighbours often have the same.
    features: Coded,
    ground: Coded,
    codes: Vec<[u8; 4]>,
    colors: Kept<[f64; 4]>,
}

#[derive(Debug, Clone, Copy)]
struct Coded {
    paint: Paint,
    code: [u8; 4],
}

impl Coded {
    fn new(compositor: &Compositor, paint: Paint) -> Self {
        Self { paint, code: code_values(compositor.encoded(paint)) }
    }

    #[inline(always)]
    fn code_of(&mut self, compositor: &Compositor, paint: Paint) -> [u8; 4] {
        if !has_same_bits(paint, self.paint) {
            *self = Self::new(compositor, paint);
        }
        self.code
    }
}

/// Whether two paints have the same bits, without a branch a channel.
#[inline(always)]
fn has_same_bits(a: Paint, b: Paint) -> bool {
    let differ = |c: usize| a.0[c].to_bits() ^ b.0[c].to_bits();
    differ(0) | differ(1) | differ(2) | differ(3) == 0
}

impl Pixels {
    /// Room for so many pixels; their encoded colours are kept only where they are wanted.
    pub fn new(compositor: Compositor, count: usize, wants_colors: bool) -> Self {
        let clear = Coded::new(&compositor, Paint::CLEAR);
        let (codes, colors) = (Vec::with_capacity(count), Kept::new(wants_colors));
        Self { compositor, features: clear, ground: clear, codes, colors }
    }

    /// Adds a pixel on which features may have been drawn.
    #[inline(always)]
    pub fn push(&mut self, paint: Paint) {
        let code = self.features.code_of(&self.compositor, paint);
        self.add(code, paint);
    }

    /// Adds a pixel that shows the ground or the sky alone.
    #[inline(always)]
    pub fn push_ground(&mut self, paint: Paint) {
        let code = self.ground.code_of(&self.compositor, paint);
        self.add(code, paint);
    }

    /// Adds neighbours that show the same ground or the sky alone.
    pub fn push_grounds(&mut self, paint: Paint, count: usize) {
        let code = self.ground.code_of(&self.compositor, paint);
        (0..count).for_each(|_| self.add(code, paint));
    }

    #[inline(always)]
    fn add(&mut self, code: [u8; 4], paint: Paint) {
        self.codes.push(code);
        self.colors.push(|| self.compositor.encoded(paint));
    }

    /// Their 8-bit code values.
    pub fn codes(&self) -> &[[u8; 4]] {
        &self.codes
    }

    /// Their encoded colours, where they are wanted.
    pub fn colors(&self) -> &[[f64; 4]] {
        self.colors.values()
    }
}

/// The mean of a pixel's n x n samples, added up row by row from the top.
#[inline(always)]
pub fn mean(n: usize, mut sample: impl FnMut(usize, usize) -> Paint) -> Paint {
    if n == 1 {
        return sample(0, 0);
    }
    let mut sum = Paint::CLEAR;
    for row in 0..n {
        for column in 0..n {
            sum = sum.plus(sample(column, row));
        }
    }
    sum.divided_by((n * n) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Compositing;

    #[test]
    fn pixels_have_the_code_values_of_their_own_paints_whatever_came_before() {
        let compositor = Compositor::new(Compositing::default());
        let paint = |v: f64| Paint([v, 0.5 * v, 0.0, 1.0]);
        let values = [0.25, 0.25, 0.75, 0.0, 0.75, 0.25];
        let mut pixels = Pixels::new(compositor, values.len(), true);
        for (k, v) in values.into_iter().enumerate() {
            if k % 2 == 0 { pixels.push(paint(v)) } else { pixels.push_ground(paint(v)) }
        }
        let colors = values.map(|v| compositor.encoded(paint(v)));
        assert_eq!(pixels.colors(), colors);
        assert_eq!(pixels.codes(), colors.map(code_values));
    }

    #[test]
    fn colours_that_nobody_wants_are_not_kept() {
        let mut pixels = Pixels::new(Compositor::new(Compositing::default()), 1, false);
        pixels.push(Paint::CLEAR);
        assert_eq!((pixels.codes().len(), pixels.colors().len()), (1, 0));
    }

    #[test]
    fn the_mean_asks_for_each_sample_once_row_by_row() {
        let mut asked = Vec::new();
        let mean = mean(2, |column, row| {
            asked.push((column, row));
            Paint([(column + 4 * row) as f64; 4])
        });
        assert_eq!(asked, [(0, 0), (1, 0), (0, 1), (1, 1)]);
        assert_eq!(mean, Paint([2.5; 4]));
    }
}
