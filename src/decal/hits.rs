//! Which items hold which of a pixel's samples.

/// The most samples that are looked up together.
pub const MOST_TOGETHER: usize = 64;

/// An item that holds samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Hit {
    /// The item.
    pub item: u32,
    /// A bit for each of the samples that it holds.
    pub samples: u64,
}

/// What was found for some samples: the items that hold any of them, but not what lies below opaque ones.
#[derive(Debug, Default)]
pub struct Hits {
    /// What is drawn last comes first.
    found: Vec<Hit>,
}

impl Hits {
    /// Nothing is found yet.
    pub fn clear(&mut self) {
        self.found.clear();
    }

    /// What was found, what is drawn last first.
    pub fn found(&self) -> &[Hit] {
        &self.found
    }

    /// Whether nothing was.
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    /// Adds what an item holds.
    #[inline(always)]
    pub fn push(&mut self, item: u32, samples: u64) {
        self.found.push(Hit { item, samples });
    }

    /// Adds samples to the last item, if it is this one; else the item.
    #[inline(always)]
    pub fn push_once(&mut self, item: u32, samples: u64) {
        match self.found.last_mut() {
            Some(last) if last.item == item => last.samples |= samples,
            _ => self.push(item, samples),
        }
    }

    /// Which of the items hold a sample, a bit each; `None`: there are more.
    #[inline(always)]
    pub(super) fn pattern(&self, sample: usize) -> Option<u64> {
        let bits = self.found.iter().enumerate().map(|(k, hit)| (hit.samples >> sample & 1) << k);
        (self.found.len() <= 64).then(|| bits.fold(0, |all, bit| all | bit))
    }

    /// Sorts what was found in several places, or out of order, by draw order.
    pub fn sort(&mut self) {
        self.found.sort_by_key(|hit| std::cmp::Reverse(hit.item));
    }

    /// Makes one of each item that was found several times; they have been sorted.
    pub fn join(&mut self) {
        self.found.dedup_by(|next, kept| {
            let is_same = next.item == kept.item;
            if is_same {
                kept.samples |= next.samples;
            }
            is_same
        });
    }
}
