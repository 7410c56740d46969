//! Between the plan and columns and rows of posts (which need not be whole).
//!
//! Input: the posts of a grid or a globe. Output: [`GridMap`]. Refuses: nothing.

use super::dag::GridPoint;
use crate::scene::Posts;
use crate::space::Plan;
use crate::terrain::{GlobeMesh, Lattice};
use glam::DVec2;

/// Cells at a seam or a pole that differ from the others by less than this share do not.
const SAME_WIDTH: f64 = 1e-9;

/// The map of a terrain.
#[derive(Debug, Clone)]
pub(super) enum GridMap {
    /// Over a plane all cells are alike.
    Even {
        /// The south-western post.
        first: Plan,
        /// The step to the next column.
        east: DVec2,
        /// The step to the next row.
        north: DVec2,
    },
    /// Over a globe those that close the circle, and those at the poles, may be smaller.
    Globe {
        /// From west to east.
        columns: Axis,
        /// From south to north.
        rows: Axis,
    },
}

/// Places along an axis of the plan that are numbered: evenly spaced but for the first and the last step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Axis {
    /// Where numbers 0, 1, `last - 1` and `last` are.
    at: [f64; 4],
    last: f64,
}

impl Axis {
    fn of(last: usize, at: impl Fn(usize) -> f64) -> Self {
        Self { at: [at(0), at(1), at(last - 1), at(last)], last: last as f64 }
    }

    /// The number of a place; beyond the ends numbers go on.
    fn number(&self, place: f64) -> f64 {
        let [start, first, last, end] = self.at;
        if place <= first {
            1.0 - (first - place) / (first - start)
        } else if place > last {
            self.last - 1.0 + (place - last) / (end - last)
        } else {
            1.0 + (place - first) / (last - first) * (self.last - 2.0)
        }
    }

    /// Places where the spacing changes: a straight line bends there.
    fn bends(&self) -> impl Iterator<Item = f64> {
        let [start, first, last, end] = self.at;
        let step = if last > first { (last - first) / (self.last - 2.0) } else { first - start };
        let differs = move |own: f64| (own - step).abs() > SAME_WIDTH * step;
        let both = [(first, differs(first - start)), (last, differs(end - last))];
        both.into_iter().filter(|(_, differs)| *differs).map(|(at, _)| at)
    }
}

impl GridMap {
    pub(super) fn new(lattice: &Lattice) -> Self {
        match lattice {
            Lattice::Plane(grid) => Self::even(grid.posts()),
            Lattice::Globe(globe) => Self::of_globe(globe),
        }
    }

    fn even(posts: &Posts) -> Self {
        Self::Even { first: posts.first, east: posts.east(), north: posts.north() }
    }

    fn of_globe(globe: &GlobeMesh) -> Self {
        let [columns, rows] = globe.size();
        Self::Globe {
            columns: Axis::of(columns - 1, |column| globe.posts().column(column)),
            rows: Axis::of(rows - 1, |row| globe.y_of(row)),
        }
    }

    /// Where a plan point lies among the posts, rounded: what is cut at triangles is the line through these points.
    pub(super) fn grid_from_plan(&self, at: Plan) -> GridPoint {
        match self {
            Self::Even { first, east, north } => {
                let from = at - *first;
                let area = east.perp_dot(*north);
                [from.perp_dot(*north) / area, east.perp_dot(from) / area]
            }
            Self::Globe { columns, rows } => [columns.number(at.x), rows.number(at.y)],
        }
    }

    /// A line of the plan among the posts: with vertices where it bends.
    pub(super) fn path(&self, line: &[Plan]) -> Vec<GridPoint> {
        let Self::Globe { columns, rows } = self else {
            return line.iter().map(|at| self.grid_from_plan(*at)).collect();
        };
        let mut all = Vec::with_capacity(line.len());
        for (k, at) in line.iter().enumerate() {
            all.push(self.grid_from_plan(*at));
            let Some(&next) = line.get(k + 1) else { break };
            let shares = |bends: &mut dyn Iterator<Item = f64>, from: f64, to: f64| {
                let shares = bends.map(|bend| ((bend - from) / (to - from), bend));
                shares.filter(|(share, _)| *share > 0.0 && *share < 1.0).collect::<Vec<_>>()
            };
            let mut bends: Vec<(f64, Plan)> = Vec::new();
            let on = |share: f64| *at + (next - *at) * share;
            for (share, x) in shares(&mut columns.bends(), at.x, next.x) {
                bends.push((share, Plan::new(x, on(share).y)));
            }
            for (share, y) in shares(&mut rows.bends(), at.y, next.y) {
                bends.push((share, Plan::new(on(share).x, y)));
            }
            bends.sort_by(|(a, _), (b, _)| a.total_cmp(b));
            all.extend(bends.into_iter().map(|(_, bend)| self.grid_from_plan(bend)));
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_have_the_numbers_of_the_posts_that_stand_there_and_lines_bend_where_cells_change() {
        // Half cells at both ends of the rows, a narrower last column.
        let columns = [0.0, 4.0, 8.0, 12.0, 13.0];
        let rows = [-3.0, -1.0, 3.0, 7.0, 9.0];
        let map = GridMap::Globe {
            columns: Axis::of(4, |column| columns[column]),
            rows: Axis::of(4, |row| rows[row]),
        };
        for (i, x) in columns.iter().enumerate() {
            for (j, y) in rows.iter().enumerate() {
                assert_eq!(map.grid_from_plan(Plan::new(*x, *y)), [i as f64, j as f64]);
            }
        }
        assert_eq!(map.grid_from_plan(Plan::new(14.0, -4.0)), [5.0, -0.5]);
        let line = [Plan::new(2.0, -3.0), Plan::new(2.0, 9.0), Plan::new(14.0, 9.0), Plan::new(10.0, 9.0)];
        let expected =
            [[0.5, 0.0], [0.5, 1.0], [0.5, 3.0], [0.5, 4.0], [3.0, 4.0], [5.0, 4.0], [3.0, 4.0], [2.5, 4.0]];
        assert_eq!(map.path(&line), expected);
    }
}
