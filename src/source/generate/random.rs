//! Numbers that look random and are the same on every machine: a hash of integers, and a counter run through it.

pub(super) use crate::math::scramble;

/// A hash of a place on a lattice.
pub(super) const fn at(seed: u64, i: i64, j: i64) -> u64 {
    scramble(scramble(scramble(seed) ^ i as u64) ^ j as u64)
}

/// The hash as a number 0 <= x < 1: its upper 53 bits.
pub(super) fn unit(hash: u64) -> f64 {
    (hash >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0)
}

/// The hash as a number -1 <= x < 1.
pub(super) fn signed(hash: u64) -> f64 {
    2.0 * unit(hash) - 1.0
}

/// A sequence of numbers.
pub(super) struct Sequence {
    seed: u64,
    drawn: u64,
}

impl Sequence {
    pub(super) const fn new(seed: u64) -> Self {
        Self { seed: scramble(seed), drawn: 0 }
    }

    pub(super) const fn next(&mut self) -> u64 {
        self.drawn += 1;
        scramble(self.seed ^ self.drawn)
    }

    /// The next number 0 <= x < 1.
    pub(super) fn unit(&mut self) -> f64 {
        unit(self.next())
    }

    /// The next number -1 <= x < 1.
    pub(super) fn signed(&mut self) -> f64 {
        signed(self.next())
    }

    /// The next number 0 <= n < `end` (0 when `end` is 0).
    pub(super) fn below(&mut self, end: usize) -> usize {
        ((u128::from(self.next()) * end as u128) >> 64) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hashes_keep_their_bits() {
        assert_eq!(scramble(0), 0xe220_a839_7b1d_cdaf);
        let mut sequence = Sequence::new(7);
        assert_eq!(
            [at(1, -2, 3), sequence.next(), sequence.next()],
            [12056474070484764355, 4414019431610648415, 5090977316425868581]
        );
    }

    #[test]
    fn units_stay_below_one() {
        assert_eq!(unit(0), 0.0);
        assert!(unit(u64::MAX) < 1.0);
    }

    #[test]
    fn below_reaches_every_number_and_no_other() {
        let mut sequence = Sequence::new(1);
        let mut seen = [false; 5];
        (0..200).for_each(|_| seen[sequence.below(5)] = true);
        assert_eq!(seen, [true; 5]);
        assert_eq!(sequence.below(0), 0);
    }
}
