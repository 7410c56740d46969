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
        if paint != self.paint {
            *self = Self::new(compositor, paint);
        }
        self.code
    }
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
