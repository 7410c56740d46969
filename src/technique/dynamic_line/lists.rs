//! Per-pixel lists of the lines that cover a pixel (4.3.2, *Linked Lists*), and their sorting (3.3.3, 4.3.3, Fig. 4.5).
//!
//! Input: entries, in the row of the segments. Output: each pixel's entries, what was found last first, as an atomic exchange of the head would leave them if
//! segments came one after another; sorted by draw order, the line on top first, as far as it can be seen. A list has as many entries as there are: it
//! grows. Refuses: nothing.

use crate::technique::dynamic_line::Sorting;

/// The end of a list.
const END: u32 = u32::MAX;

/// Pixels a side of the blocks in which an imitated machine finds lines in one order.
const BLOCK: usize = 8;

/// A line that covers a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Entry {
    /// Its item: the draw order.
    pub item: u32,
    /// The segment that covers it, in the row of the view's segments.
    pub segment: u32,
    /// How much of the pixel it covers.
    pub share: f64,
}

/// The lists of some pixels.
#[derive(Debug)]
pub struct PixelLists {
    heads: Vec<u32>,
    counts: Vec<u32>,
    next: Vec<u32>,
    data: Vec<Entry>,
}

impl PixelLists {
    /// Empty lists.
    pub fn new(pixels: usize) -> Self {
        Self { heads: vec![END; pixels], counts: vec![0; pixels], next: Vec::new(), data: Vec::new() }
    }

    /// Adds an entry before the others of a pixel.
    #[inline]
    pub fn push(&mut self, pixel: usize, entry: Entry) {
        let place = self.data.len() as u32;
        self.next.push(std::mem::replace(&mut self.heads[pixel], place));
        self.data.push(entry);
        self.counts[pixel] += 1;
    }

    /// How many entries there are in all lists.
    pub fn len(&self) -> usize {
        self.data.len()
    }

    /// How many entries a pixel has.
    pub fn count(&self, pixel: usize) -> u32 {
        self.counts[pixel]
    }

    /// The entries of a pixel in the order of its list.
    pub fn of(&self, pixel: usize) -> impl Iterator<Item = Entry> + '_ {
        Places { lists: self, at: self.heads[pixel] }.map(|place| self.data[place as usize])
    }

    /// Brings the list of a pixel (column and row of the picture) into the order in which it is composed; `alpha` says how opaque an entry is.
    pub fn sort(
        &mut self,
        pixel: usize,
        (column, row): (usize, usize),
        sorting: Sorting,
        alpha: impl Fn(&Entry) -> f64,
    ) {
        match sorting {
            Sorting::Selection => self.select(self.heads[pixel], alpha),
            Sorting::None => {
                // A parallel machine finds segments in any order; this one in an order for each block of pixels.
                let block = (row / BLOCK * 65_537 + column / BLOCK) as u64;
                let found = |entry: &Entry| mixed(block << 32 | u64::from(entry.segment / 4));
                let places: Vec<u32> = Places { lists: self, at: self.heads[pixel] }.collect();
                let mut entries: Vec<Entry> = places.iter().map(|place| self.data[*place as usize]).collect();
                entries.sort_by_key(found);
                for (place, entry) in places.into_iter().zip(entries) {
                    self.data[place as usize] = entry;
                }
            }
        }
    }

    /// A selection sort that exchanges data and leaves the links (Fig. 4.5). It ends early where all that follows cannot be seen, and where all that
    /// follows is in order.
    fn select(&mut self, head: u32, alpha: impl Fn(&Entry) -> f64) {
        let (mut at, mut through, mut before) = (head, 1.0, None);
        while at != END {
            let (mut top, mut is_sorted, mut last) = (at, true, at);
            let mut place = self.next[at as usize];
            while place != END {
                let item = self.data[place as usize].item;
                if item > self.data[top as usize].item {
                    top = place;
                }
                is_sorted &= item <= self.data[last as usize].item;
                (last, place) = (place, self.next[place as usize]);
            }
            if is_sorted {
                return;
            }
            self.data.swap(at as usize, top as usize);
            let entry = self.data[at as usize];
            if before != Some(entry.item) {
                through *= 1.0 - alpha(&entry);
            }
            if through <= 0.0 {
                return;
            }
            (before, at) = (Some(entry.item), self.next[at as usize]);
        }
    }
}

/// The places of a list's entries.
struct Places<'l> {
    lists: &'l PixelLists,
    at: u32,
}

impl Iterator for Places<'_> {
    type Item = u32;

    #[inline]
    fn next(&mut self) -> Option<u32> {
        let place = (self.at != END).then_some(self.at)?;
        self.at = self.lists.next[place as usize];
        Some(place)
    }
}

/// A number without pattern for each number (the finalizer of SplitMix64, Steele et al. 2014).
fn mixed(number: u64) -> u64 {
    let x = number.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn list(items: &[u32]) -> PixelLists {
        let mut lists = PixelLists::new(2);
        for (segment, item) in (0..).zip(items) {
            lists.push(1, Entry { item: *item, segment, share: 1.0 });
        }
        lists
    }

    fn items(lists: &PixelLists) -> Vec<u32> {
        lists.of(1).map(|entry| entry.item).collect()
    }

    #[test]
    fn a_list_has_what_was_found_last_first() {
        let lists = list(&[3, 1, 2]);
        assert_eq!((items(&lists), lists.count(1), lists.count(0)), (vec![2, 1, 3], 3, 0));
    }

    #[test]
    fn the_line_on_top_comes_first_and_its_links_stay() {
        // Fig. 4.5: three entries with the orders 1, 0, 2; two change places.
        let mut lists = list(&[0, 2, 1]);
        let links = lists.next.clone();
        lists.sort(1, (0, 0), Sorting::Selection, |_| 0.5);
        assert_eq!((items(&lists), lists.next), (vec![2, 1, 0], links));
    }

    #[test]
    fn sorting_ends_where_what_lies_on_top_is_opaque() {
        let mut lists = list(&[0, 1, 4, 2, 3]);
        lists.sort(1, (0, 0), Sorting::Selection, |entry| if entry.item == 4 { 1.0 } else { 0.0 });
        assert_eq!(items(&lists), [4, 2, 3, 1, 0], "the first has its place, the others were not looked at");
        lists.sort(1, (0, 0), Sorting::Selection, |_| 0.5);
        assert_eq!(items(&lists), [4, 3, 2, 1, 0]);
    }

    #[test]
    fn an_unsorted_list_has_one_order_in_a_block_and_others_in_other_blocks() {
        let items_at = |at| {
            let mut lists = list(&[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]);
            lists.sort(1, at, Sorting::None, |_| 1.0);
            items(&lists)
        };
        assert_eq!(items_at((0, 0)), items_at((7, 7)));
        assert_ne!(items_at((0, 0)), items_at((8, 0)));
        let mut sorted = items_at((8, 0));
        sorted.sort_unstable();
        assert_eq!(sorted, (0..13).collect::<Vec<_>>(), "nothing is lost");
    }
}
