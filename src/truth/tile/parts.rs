//! Pixels that see more triangles than are looked at together, done in parts.

use super::{BLOCK, SMALLEST, Work, narrowed};
use crate::truth::Centre;
use crate::truth::knowledge::Pixel;
use crate::truth::refine::PartSum;

/// Triangles that a part looks at before it is quartered.
const MOST_OF_A_PART: usize = 8192;

/// No part is smaller than this, pixels.
const LEAST_PART: f64 = 1.0 / 4096.0;

/// A pixel's parts together.
#[derive(Debug, Default)]
struct Whole {
    sum: PartSum,
    centre: Option<Centre>,
}

impl Work<'_> {
    /// Does the open pixels of a block, whose first pixel this is, in parts.
    pub(super) fn in_parts(&mut self, [x, y]: [usize; 2], open: &[[bool; BLOCK]; BLOCK], leaves: &[usize]) {
        for (k, _) in open.as_flattened().iter().enumerate().filter(|(_, is_open)| **is_open) {
            let at = [x + k % BLOCK, y + k / BLOCK];
            if at[0] < self.size[0] && at[1] < self.size[1] {
                self.pixel_in_parts(at, leaves);
            }
        }
    }

    /// Does a pixel that sees more triangles than are looked at together. Its parts share no triangles' data, so that memory does not grow
    /// with what a pixel sees.
    fn pixel_in_parts(&mut self, [x, y]: [usize; 2], leaves: &[usize]) {
        let pixel = [x as f64, y as f64];
        let kept = (std::mem::take(&mut self.facets), std::mem::take(&mut self.boxes));
        let mut whole = Whole::default();
        self.part(pixel, ([0.0, 0.0], 1.0), leaves, &mut whole);
        (self.facets, self.boxes) = kept;
        // What is in it is of the last part's triangles.
        self.sight.clear();
        self.smallest = SMALLEST;
        let index = y * self.size[0] + x;
        self.out.colors[index] = whole.sum.colors(&self.setting.compositor);
        self.out.centres[index] = whole.centre;
        if self.setting.budget.coverage {
            self.out.coverage[index] = whole.sum.coverage();
        }
    }

    /// Does a square of a pixel, or its quarters. `leaves`: those that it may see, and others, nearest first.
    fn part(
        &mut self,
        pixel: [f64; 2],
        (corner, side): ([f64; 2], f64),
        leaves: &[usize],
        whole: &mut Whole,
    ) {
        let at = [pixel[0] + corner[0], pixel[1] + corner[1]];
        let near: Vec<usize> = leaves.iter().copied().filter(|&k| self.leaves[k].meets(at, side)).collect();
        if !self.see_part(pixel, (corner, side), &near) {
            let half = side / 2.0;
            for (dx, dy) in [(0.0, 0.0), (half, 0.0), (0.0, half), (half, half)] {
                self.part(pixel, ([corner[0] + dx, corner[1] + dy], half), &near, whole);
            }
            return;
        }
        let has_centre = (0..2).all(|axis| (corner[axis]..corner[axis] + side).contains(&0.5));
        if has_centre {
            whole.centre = self.centre(pixel);
        }
        self.out.tally.fragments += self.sight.fragments.len() as u64;
        self.out.tally.triangles += self.facets.len() as u64;
        let pixel = Pixel { setting: self.setting, rays: &self.rays, facets: &self.facets, corner: pixel };
        self.refinery.refine_part(&pixel, (&mut self.pieces, side * side), &self.sight, &mut whole.sum);
    }

    /// Finds what a square of a pixel sees with triangles of its own; false: they are too many, and it is not the smallest.
    fn see_part(&mut self, pixel: [f64; 2], (corner, side): ([f64; 2], f64), near: &[usize]) -> bool {
        let at = [pixel[0] + corner[0], pixel[1] + corner[1]];
        self.facets.clear();
        self.boxes.clear();
        self.smallest = side / 32.0;
        let mut seen = 0;
        loop {
            while seen < near.len() && self.facets.len() < MOST_OF_A_PART {
                self.open_leaf(near[seen], (at, side));
                seen += 1;
            }
            if seen < near.len() && side <= LEAST_PART {
                near[seen..].iter().for_each(|leaf| self.open_leaf(*leaf, (at, side)));
                seen = near.len();
            }
            let all: Vec<u32> = (0..self.facets.len() as u32).collect();
            let few = narrowed((&self.facets, &self.boxes), &all, at, side);
            if self.see(pixel, (corner, side), &few, &near[seen..]) {
                return true;
            }
            if self.facets.len() >= MOST_OF_A_PART {
                return false;
            }
        }
    }
}
