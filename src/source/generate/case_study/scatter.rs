//! Places that are spread evenly over a window, each with room of its own.

use super::super::random::{at, scramble, signed};
use crate::math::min;
use crate::space::{Plan, PlanBox};
use glam::DVec2;

/// A lattice of at least so many cells, one thing in each of the first.
pub(super) struct Scatter {
    seed: u64,
    window: PlanBox,
    columns: usize,
    /// The number of cells and of things: things are spread over the cells.
    cells: usize,
    count: usize,
    cell: DVec2,
}

impl Scatter {
    pub(super) fn new(count: usize, seed: u64, window: PlanBox) -> Self {
        let (size, count) = (window.max - window.min, count.max(1));
        let columns = ((count as f64 * size.x / size.y).sqrt().ceil() as usize).clamp(1, count);
        let rows = count.div_ceil(columns);
        let cell = DVec2::new(size.x / columns as f64, size.y / rows as f64);
        Self { seed: scramble(seed), window, columns, cells: columns * rows, count, cell }
    }

    /// Half the shorter side of a cell: nobody's reach may be longer.
    pub(super) fn room(&self) -> f64 {
        0.5 * min(self.cell.x, self.cell.y)
    }

    /// Where the thing with a number is, if it reaches so far.
    pub(super) fn place(&self, number: usize, reach: f64) -> Plan {
        let cell = number * self.cells / self.count;
        let (column, row) = (cell % self.columns, cell / self.columns);
        let hash = at(self.seed, column as i64, row as i64);
        let middle = DVec2::new(column as f64 + 0.5, row as f64 + 0.5) * self.cell;
        let play = (self.cell * 0.5 - DVec2::splat(reach)).max(DVec2::ZERO);
        self.window.min + middle + DVec2::new(signed(hash), signed(scramble(hash))) * play
    }
}
