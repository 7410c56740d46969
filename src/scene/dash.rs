//! Dashes of strokes.

/// Which parts of a stroke are drawn: lengths along it in metres of the plan, in turn drawn and left out, over and over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dash {
    lengths: [f64; Dash::MOST],
    count: usize,
    offset: f64,
}

impl Dash {
    /// The most lengths.
    pub const MOST: usize = 16;

    /// No length is as short, metres: far above what two vertices must be apart.
    pub const SHORTEST: f64 = 1e-6;

    /// No length is as long, metres.
    pub const LONGEST: f64 = 1e12;

    /// The lengths of a pattern, and how far into it a stroke begins; `None` unless there is an even count of lengths, [`Self::MOST`] at most, all
    /// between the shortest and the longest, and the offset is finite.
    pub fn new(lengths: &[f64], offset: f64) -> Option<Self> {
        let is_pattern =
            !lengths.is_empty() && lengths.len().is_multiple_of(2) && lengths.len() <= Self::MOST;
        let is_length = |length: &f64| Self::SHORTEST < *length && *length < Self::LONGEST;
        if !is_pattern || !lengths.iter().all(is_length) || !offset.is_finite() {
            return None;
        }
        let mut all = [0.0; Self::MOST];
        all[..lengths.len()].copy_from_slice(lengths);
        Some(Self { lengths: all, count: lengths.len(), offset })
    }

    /// What is drawn, what is left out, and so on.
    pub fn lengths(&self) -> &[f64] {
        &self.lengths[..self.count]
    }

    /// How far into the pattern a stroke begins, metres.
    pub fn offset(&self) -> f64 {
        self.offset
    }

    /// The length after which it repeats itself.
    pub fn period(&self) -> f64 {
        self.lengths().iter().sum()
    }
}
