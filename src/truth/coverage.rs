//! What items cover of a pixel.

use crate::math;

/// What an item covers of a pixel, as a share of the pixel's area.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ItemCoverage {
    /// The item's number in [`Truth::items`](super::Truth::items).
    pub item: u32,
    /// At least.
    pub low: f64,
    /// At most.
    pub high: f64,
}

/// What the items cover of a pixel.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PixelCoverage {
    /// Those that were looked at, in draw order.
    pub items: Vec<ItemCoverage>,
    /// What any other item covers at most.
    pub others: f64,
}

impl PixelCoverage {
    /// The same with one entry an item.
    pub(super) fn joined(mut self) -> Self {
        self.items.sort_by_key(|entry| entry.item);
        let mut all: Vec<ItemCoverage> = Vec::new();
        for entry in &self.items {
            match all.last_mut().filter(|last| last.item == entry.item) {
                Some(last) => (last.low, last.high) = (last.low + entry.low, last.high + entry.high),
                None => all.push(*entry),
            }
        }
        for entry in &mut all {
            entry.low = math::max(entry.low - self.others, 0.0);
            entry.high = math::min(entry.high + self.others, 1.0);
        }
        Self { items: all, others: math::min(self.others, 1.0) }
    }
}
