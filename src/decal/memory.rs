//! What the structures hold, in bytes.

use super::cell::Cell;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Bytes of the structures by what they are for (Fig. 4.2), as far as they have been built.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Memory {
    /// How many cells have been built that have something in them.
    pub cells: usize,
    /// Bytes of the decal grid: its list of cells, and what each refers to its parts by.
    pub grid: usize,
    /// Bytes of the cells' line segments and of the trees over them.
    pub lines: usize,
    /// Bytes of the cells' polygons, of their parts of rings, and of the trees over polygons.
    pub polygons: usize,
    /// Bytes of the rings' quadtrees.
    pub quadtrees: usize,
    /// Bytes of the index that finds what lies in a cell while it is built; drawing does not need it.
    pub index: usize,
}

impl Memory {
    /// All bytes.
    pub fn bytes(&self) -> usize {
        self.grid + self.lines + self.polygons + self.quadtrees + self.index
    }
}

/// Sums over the cells that have been built, kept while threads build them: nobody has to look at each cell for them.
#[derive(Debug, Default)]
pub(super) struct Built {
    cells: AtomicUsize,
    /// Several cells may share one.
    structures: AtomicUsize,
    line_bytes: AtomicUsize,
    polygon_bytes: AtomicUsize,
}

impl Built {
    /// Adds what a cell holds.
    pub(super) fn added(&self, cell: Cell) -> Arc<Cell> {
        self.structures.fetch_add(1, Ordering::Relaxed);
        self.line_bytes.fetch_add(cell.line_bytes(), Ordering::Relaxed);
        self.polygon_bytes.fetch_add(cell.polygon_bytes(), Ordering::Relaxed);
        Arc::new(cell)
    }

    /// Counts a place that has a cell.
    pub(super) fn count(&self) {
        self.cells.fetch_add(1, Ordering::Relaxed);
    }

    /// Bytes of what the cells refer to their parts by.
    pub(super) fn cell_bytes(&self) -> usize {
        self.structures.load(Ordering::Relaxed) * size_of::<Cell>()
    }

    /// How many places have a cell.
    pub(super) fn cells(&self) -> usize {
        self.cells.load(Ordering::Relaxed)
    }

    /// Bytes of their lines.
    pub(super) fn line_bytes(&self) -> usize {
        self.line_bytes.load(Ordering::Relaxed)
    }

    /// Bytes of their polygons.
    pub(super) fn polygon_bytes(&self) -> usize {
        self.polygon_bytes.load(Ordering::Relaxed)
    }
}
