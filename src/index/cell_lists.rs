//! What lies in each of many cells, one list after another in memory.

use crate::tiling::Tiling;
use std::ops::Range;

/// A list for each of some cells. What a list holds is in the order in which it was put there.
#[derive(Debug, Clone, PartialEq)]
pub struct CellLists<T> {
    /// Where each cell's list starts in `entries`; one more than cells.
    starts: Vec<u32>,
    entries: Vec<T>,
}

impl<T> Default for CellLists<T> {
    /// No cells.
    fn default() -> Self {
        Self { starts: vec![0], entries: Vec::new() }
    }
}

/// Takes what lies in which cell.
#[derive(Debug)]
pub struct Entries<'a, T> {
    /// How many entries each cell has, or where its next one goes.
    places: &'a mut [u32],
    /// Empty while entries are counted.
    entries: &'a mut [T],
}

impl<T: Copy> Entries<'_, T> {
    /// Puts a value into a cell.
    #[inline(always)]
    pub fn put(&mut self, cell: usize, value: T) {
        let place = &mut self.places[cell];
        if let Some(entry) = self.entries.get_mut(*place as usize) {
            *entry = value;
        }
        *place += 1;
    }
}

impl<T: Copy + Default> CellLists<T> {
    /// The lists of `cells` cells that `put_all` fills. It is called twice, to count and to fill, and has to put the same both times.
    pub fn new(cells: usize, put_all: impl Fn(&mut Entries<T>)) -> Self {
        let mut starts = vec![0; cells + 1];
        put_all(&mut Entries { places: &mut starts[1..], entries: &mut [] });
        for cell in 0..cells {
            starts[cell + 1] += starts[cell];
        }
        let mut entries = vec![T::default(); starts[cells] as usize];
        let mut next = starts[..cells].to_vec();
        put_all(&mut Entries { places: &mut next, entries: &mut entries });
        Self { starts, entries }
    }

    /// Adds the cells of other lists after its own.
    pub fn append(&mut self, other: &Self) {
        let before = self.entries.len() as u32;
        self.starts.extend(other.starts[1..].iter().map(|start| before + start));
        self.entries.extend_from_slice(&other.entries);
    }
}

impl<T> CellLists<T> {
    /// What lies in a cell.
    ///
    /// # Panics
    /// When there is no such cell.
    #[inline(always)]
    pub fn of(&self, cell: usize) -> &[T] {
        &self.entries[self.starts[cell] as usize..self.starts[cell + 1] as usize]
    }

    /// How many cells there are.
    pub fn cells(&self) -> usize {
        self.starts.len() - 1
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.starts[..]) + size_of_val(&self.entries[..])
    }
}

/// What may touch each tile: of each entry the columns and rows of the picture that it may touch (not empty).
pub fn bins<T: Copy + Default>(
    tiling: &Tiling,
    entries: impl Iterator<Item = (T, [Range<usize>; 2])> + Clone,
) -> CellLists<T> {
    CellLists::new(tiling.count(), |bins| {
        for (entry, [columns, rows]) in entries.clone() {
            tiling.tiles_in(columns, rows).for_each(|tile| bins.put(tile, entry));
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_cell_has_what_was_put_there_in_order(puts in prop::collection::vec((0..7usize, any::<u16>()), 0..60)) {
            let lists = CellLists::new(7, |out| puts.iter().for_each(|(cell, value)| out.put(*cell, *value)));
            prop_assert_eq!(lists.cells(), 7);
            for cell in 0..7 {
                let own: Vec<u16> = puts.iter().filter(|(c, _)| *c == cell).map(|(_, v)| *v).collect();
                prop_assert_eq!(lists.of(cell), own);
            }
            let mut twice = lists.clone();
            twice.append(&lists);
            prop_assert_eq!(twice.cells(), 14);
            prop_assert!((0..7).all(|cell| twice.of(cell + 7) == lists.of(cell) && twice.of(cell) == lists.of(cell)));
        }
    }

    #[test]
    fn a_bin_has_what_may_touch_its_tile() {
        let tiling = Tiling::new(7, 5, 3);
        let windows = [(1u32, [0..7, 0..1]), (2, [2..4, 2..4]), (3, [6..7, 4..5])];
        let bins = bins(&tiling, windows.into_iter());
        let tiles: Vec<&[u32]> = (0..bins.cells()).map(|k| bins.of(k)).collect();
        assert_eq!(tiles, [&[1, 2][..], &[1, 2], &[1], &[2], &[2], &[3]]);
    }
}
