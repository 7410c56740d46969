//! The decal grid: equal cells over what decals there are (4.2.1, *Decal Grid*).

use crate::math;
use crate::space::{Plan, PlanBox};
use glam::DVec2;

/// How far the box of a cell reaches beyond its borders, as a share of the coordinates' size: which cell a point lies in is found with a few
/// roundings of 2^-53 each.
const SLACK: f64 = 1.0 / (1u64 << 48) as f64;

/// A regular grid of the plan.
#[derive(Debug, Clone, Copy)]
pub(super) struct DecalGrid {
    origin: Plan,
    cell: DVec2,
    side: u32,
    /// Metres.
    slack: f64,
}

impl DecalGrid {
    /// `side` x `side` cells over a box, which may be empty.
    pub(super) fn new(bounds: &PlanBox, side: u32) -> Self {
        let bounds = if bounds.is_empty() { PlanBox::around([Plan::default()]) } else { *bounds };
        let size = bounds.max - bounds.min;
        // A grid of no width has cells of some width all the same, so that no point is divided by 0.
        let cell_size = |extent: f64| math::max(extent / f64::from(side), f64::MIN_POSITIVE);
        let largest = [bounds.min.x, bounds.min.y, bounds.max.x, bounds.max.y]
            .iter()
            .fold(0.0, |most, v| math::max(most, v.abs()));
        let slack = math::max((largest + size.x + size.y) * SLACK, f64::MIN_POSITIVE);
        Self { origin: bounds.min, cell: DVec2::new(cell_size(size.x), cell_size(size.y)), side, slack }
    }

    /// Cells in all.
    pub(super) fn count(&self) -> usize {
        self.side as usize * self.side as usize
    }

    /// Its south-west corner and its north-east one.
    pub(super) fn bounds(&self) -> PlanBox {
        PlanBox { min: self.origin, max: self.origin + self.cell * f64::from(self.side) }
    }

    /// Cells a side.
    pub(super) fn side(&self) -> u32 {
        self.side
    }

    /// The cell that a point lies in; `None` outside the grid (Eqs. 4.3, 4.4). A point on the far border lies in the last cell: decals that
    /// are closed sets reach it.
    #[inline(always)]
    pub(super) fn cell_of(&self, at: Plan) -> Option<u32> {
        let d = at - self.origin;
        let (x, y) = (d.x / self.cell.x, d.y / self.cell.y);
        let side = f64::from(self.side);
        // False for what is no number, too.
        let is_inside = (x >= 0.0) & (y >= 0.0) & (x <= side) & (y <= side);
        is_inside.then(|| self.index((x as u32).min(self.side - 1), (y as u32).min(self.side - 1)))
    }

    /// The same as a graphics processor finds it, in single precision.
    #[inline(always)]
    pub(super) fn cell_of_f32(&self, [x, y]: [f32; 2]) -> Option<u32> {
        let x = (x - self.origin.x as f32) / self.cell.x as f32;
        let y = (y - self.origin.y as f32) / self.cell.y as f32;
        let side = self.side as f32;
        let is_inside = (x >= 0.0) & (y >= 0.0) & (x <= side) & (y <= side);
        is_inside.then(|| self.index((x as u32).min(self.side - 1), (y as u32).min(self.side - 1)))
    }

    #[inline(always)]
    fn index(&self, column: u32, row: u32) -> u32 {
        column + self.side * row
    }

    /// The cells between two, the first of which lies in the south-west; `None`: they are many.
    #[inline(always)]
    pub(super) fn cells_between(&self, first: u32, last: u32) -> Option<impl Iterator<Item = u32>> {
        let side = self.side;
        let (west, east) = (first % side, last % side);
        let (south, north) = (first / side, last / side);
        let is_few = east - west < 2 && north - south < 2;
        is_few.then(|| {
            (south..=north).flat_map(move |row| (west..=east).map(move |column| column + side * row))
        })
    }

    /// The cells that points of a box lie in; `None`: they are more than `most`.
    pub(super) fn cells_in(&self, plan: &PlanBox, most: usize) -> Option<Vec<u32>> {
        let range = |low: f64, high: f64, origin: f64, cell: f64| {
            // Casts saturate at 0.
            let (first, last) = (((low - origin) / cell) as u32, ((high - origin) / cell) as u32);
            let is_beside = (high - origin) / cell < 0.0 || first > self.side;
            if is_beside { 0..0 } else { first.min(self.side - 1)..last.min(self.side - 1) + 1 }
        };
        let columns = range(plan.min.x, plan.max.x, self.origin.x, self.cell.x);
        let rows = range(plan.min.y, plan.max.y, self.origin.y, self.cell.y);
        let is_few = columns.len() * rows.len() <= most;
        is_few.then(|| {
            rows.flat_map(|row| columns.clone().map(move |column| self.index(column, row))).collect()
        })
    }

    /// A box around all cells that points of a box lie in; `None`: they lie in none.
    pub(super) fn box_around(&self, plan: &PlanBox) -> Option<PlanBox> {
        let bounds = self.bounds();
        if !plan.meets(&bounds.grown(self.slack)) {
            return None;
        }
        let clamped = |at: Plan| {
            Plan::new(at.x.clamp(bounds.min.x, bounds.max.x), at.y.clamp(bounds.min.y, bounds.max.y))
        };
        let cell = |at: Plan| self.cell_of(clamped(at)).map(|cell| self.box_of(cell));
        let whole = || bounds.grown(self.slack);
        let (low, high) = (cell(plan.min).unwrap_or_else(whole), cell(plan.max).unwrap_or_else(whole));
        Some(PlanBox { min: low.min, max: high.max })
    }

    /// A box around all points that lie in a cell.
    pub(super) fn box_of(&self, cell: u32) -> PlanBox {
        let (column, row) = (cell % self.side, cell / self.side);
        let corner = |column: u32, row: u32| {
            self.origin + DVec2::new(f64::from(column) * self.cell.x, f64::from(row) * self.cell.y)
        };
        PlanBox { min: corner(column, row), max: corner(column + 1, row + 1) }.grown(self.slack)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_points_cell_holds_it(
            (x0, y0) in (-1e7..1e7f64, -1e7..1e7f64), (w, h) in (0.0..1e6f64, 0.0..1e6f64),
            side in 1..2000u32, (s, t) in (0.0..=1.0f64, 0.0..=1.0f64),
        ) {
            let bounds = PlanBox { min: Plan::new(x0, y0), max: Plan::new(x0 + w, y0 + h) };
            let grid = DecalGrid::new(&bounds, side);
            let at = Plan::new(x0 + s * w, y0 + t * h);
            if let Some(cell) = grid.cell_of(at) {
                let plan = grid.box_of(cell);
                prop_assert!(plan.contains(&PlanBox::around([at])), "{at:?} {plan:?}");
            } else {
                prop_assert!(at.x > bounds.max.x - grid.slack || at.y > bounds.max.y - grid.slack);
            }
        }
    }

    #[test]
    fn corners_of_the_grid_lie_in_its_corner_cells_and_what_is_outside_in_none() {
        let bounds = PlanBox { min: Plan::new(0.0, 0.0), max: Plan::new(30.0, 60.0) };
        let grid = DecalGrid::new(&bounds, 3);
        let cell = |x, y| grid.cell_of(Plan::new(x, y));
        assert_eq!(
            [cell(0.0, 0.0), cell(30.0, 0.0), cell(0.0, 60.0), cell(30.0, 60.0)],
            [Some(0), Some(2), Some(6), Some(8)]
        );
        assert_eq!(
            [cell(-0.1, 0.0), cell(0.0, 60.1), cell(f64::NAN, 0.0), cell(f64::INFINITY, 0.0)],
            [None; 4]
        );
        assert_eq!(cell(10.0, 20.0), Some(4));
        let cells_in = |low: f64, high: f64| {
            grid.cells_in(&PlanBox { min: Plan::new(low, low), max: Plan::new(high, high) }, 6)
        };
        assert_eq!(cells_in(-5.0, 19.0), Some(vec![0, 1]));
        assert_eq!(cells_in(11.0, 40.0), Some(vec![1, 2, 4, 5, 7, 8]));
        assert_eq!([cells_in(-9.0, -1.0), cells_in(61.0, 70.0)], [Some(Vec::new()), Some(Vec::new())]);
        assert_eq!(cells_in(-1e300, 1e300), None, "more than six");
        let nothing = DecalGrid::new(&PlanBox::EMPTY, 5);
        assert_eq!([(0.0, 0.0), (1.0, 1.0)].map(|(x, y)| nothing.cell_of(Plan::new(x, y))), [Some(0), None]);
    }

    #[test]
    fn a_point_that_rounding_puts_into_the_next_cell_is_in_the_box_around_its_points() {
        let mut beyond = 0;
        for (low, size, side) in [(0.1, 9.7, 7), (-431.7, 1000.3, 500), (5.1e6, 777.7, 93)] {
            let bounds = PlanBox { min: Plan::new(low, low), max: Plan::new(low + size, low + size) };
            let grid = DecalGrid::new(&bounds, side);
            for column in 1..side {
                let border = low + f64::from(column) * grid.cell.x;
                for at in [border.next_down(), border, border.next_up()].map(|x| Plan::new(x, low)) {
                    let (plan, point) = (grid.box_of(grid.cell_of(at).unwrap()), PlanBox::around([at]));
                    assert!(plan.contains(&point), "{at:?} {plan:?}");
                    beyond += u32::from(!plan.grown(-grid.slack).contains(&point));
                }
            }
        }
        assert!(beyond > 0, "no point tells");
    }
}
