//! The stencil planes of a tile: counts, the two-sided operations, the test.
//!
//! Input: fragments of faces in draw order. Output: the count of each sample, and for those who ask the counts of front
//! and back faces and of all fragments. Refuses: nothing.

use super::block::{COLUMNS, SIZE};
use super::face::Fragment;
use crate::scene::Rule;
use crate::technique::stencil_volume::Overflow;

/// How a volume's faces are counted (3.1).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// Faces before the surface point: fronts up, backs down.
    ZPass,
    /// Faces behind it: backs up, fronts down.
    ZFail,
}

impl Method {
    /// What a fragment does to the count.
    #[inline(always)]
    pub fn step(self, fragment: Fragment) -> i32 {
        match (self, fragment.is_behind) {
            (Self::ZPass, false) => fragment.facing,
            (Self::ZFail, true) => -fragment.facing,
            _ => 0,
        }
    }
}

/// What the stencil can hold.
#[derive(Debug, Clone, Copy)]
pub struct Width {
    /// Bits.
    pub bits: u32,
    /// What happens beyond them.
    pub overflow: Overflow,
}

impl Width {
    /// The largest value.
    fn most(self) -> i32 {
        (1 << self.bits) - 1
    }

    /// A count after a step.
    #[inline(always)]
    fn stepped(self, count: i32, step: i32) -> i32 {
        match self.overflow {
            Overflow::Wrap => (count + step) & self.most(),
            Overflow::Saturate => (count + step).clamp(0, self.most()),
        }
    }
}

/// The planes that show how the stencil came about.
pub const TRACES: [&str; 4] = ["stencil", "stencil-front", "stencil-back", "overdraw"];

/// The planes of [`TRACES`] over all samples of a tile.
#[derive(Debug, Clone)]
pub struct Traces {
    /// The count when the mask was applied.
    pub stencil: Vec<[u16; SIZE]>,
    /// Front faces that were counted.
    pub front: Vec<[u32; SIZE]>,
    /// Back faces that were counted.
    pub back: Vec<[u32; SIZE]>,
    /// Fragments before the depth test.
    pub overdraw: Vec<[u32; SIZE]>,
}

impl Traces {
    /// Nothing has happened in so many blocks.
    pub fn new(blocks: usize) -> Self {
        let none = || vec![[0; SIZE]; blocks];
        Self { stencil: vec![[0; SIZE]; blocks], front: none(), back: none(), overdraw: none() }
    }
}

/// The stencil planes of a tile.
#[derive(Debug)]
pub struct Stencil {
    /// A count for each sample of each block. Where counts wrap and are added up without being looked at, they are taken
    /// modulo 2^bits when they are.
    pub counts: Vec<[i32; SIZE]>,
    /// Whether a sample lies in the part of the plan that the next mask is cut to.
    pub inside: Vec<[bool; SIZE]>,
    /// Blocks whose counts may not be 0.
    pub touched: Vec<bool>,
    /// What the stencil can hold now.
    pub width: Width,
}

impl Stencil {
    /// All zero.
    pub fn new(blocks: usize, width: Width) -> Self {
        Self { counts: vec![[0; SIZE]; blocks], inside: Vec::new(), touched: vec![false; blocks], width }
    }

    /// Counts one fragment; returns the step that was made.
    #[inline]
    pub fn count(&mut self, (block, at): (usize, usize), method: Method, fragment: Fragment) -> i32 {
        let step = method.step(fragment);
        if step != 0 {
            let count = &mut self.counts[block][at];
            *count = self.width.stepped(*count, step);
            self.touched[block] = true;
        }
        step
    }

    /// Adds steps to a row of a block: wrapping, so that their order does not matter.
    #[inline(always)]
    pub fn add(&mut self, block: usize, r: usize, steps: &[i32; COLUMNS]) {
        if let Some(row) = self.counts[block][r * COLUMNS..].first_chunk_mut::<COLUMNS>() {
            for (count, step) in row.iter_mut().zip(steps) {
                *count += step;
            }
        }
    }

    /// The value of a sample, which becomes zero (4.2.2).
    #[inline(always)]
    pub fn take(&mut self, (block, at): (usize, usize)) -> u16 {
        let value = std::mem::take(&mut self.counts[block][at]) & self.width.most();
        value as u16
    }
}

/// Whether a value passes the test "not equal zero" under a rule's read mask.
#[inline(always)]
pub fn passes(value: u16, rule: Rule) -> bool {
    match rule {
        Rule::NonZero => value != 0,
        Rule::EvenOdd => value & 1 != 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_of_eight_bits_wrap_or_stay() {
        let by = |overflow| Width { bits: 8, overflow };
        assert_eq!(by(Overflow::Wrap).stepped(255, 1), 0);
        assert_eq!(by(Overflow::Wrap).stepped(0, -1), 255);
        assert_eq!(by(Overflow::Saturate).stepped(255, 1), 255);
        assert_eq!(by(Overflow::Saturate).stepped(0, -1), 0);
    }

    #[test]
    fn z_pass_counts_what_is_before_the_point_and_z_fail_what_is_behind() {
        let front = |is_behind| Fragment { facing: 1, is_behind };
        assert_eq!((Method::ZPass.step(front(false)), Method::ZPass.step(front(true))), (1, 0));
        assert_eq!((Method::ZFail.step(front(false)), Method::ZFail.step(front(true))), (0, -1));
    }
}
