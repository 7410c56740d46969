//! How often texels' centres are covered, at least and at most, where corners may lie a little elsewhere.
//!
//! A point's winding does not change as long as no edge comes over it. Corners that move by no more than the slack along each axis move no point of
//! an edge farther: only texels whose centres are that near to an edge are open.

use super::edges::Edge;
use crate::space::Texel;
use std::ops::Range;

/// Windings of the points of a rectangle of texels.
#[derive(Debug)]
pub(super) struct Windings {
    /// Columns and rows; beyond them nothing is covered.
    pub(super) columns: Range<usize>,
    pub(super) rows: Range<usize>,
    /// Rows of the rectangle.
    of: Vec<i32>,
    /// Sorted by texel (column + size * row): those that are open, by how much less and more.
    open: Vec<(u32, i32, i32)>,
    size: usize,
}

/// Columns or rows whose points lie between two places, of so many.
pub(super) fn between(low: f64, high: f64, point: f64, size: usize) -> Range<usize> {
    let within = |v: f64| v.clamp(0.0, size as f64) as usize;
    let (first, end) = (within((low - point).ceil()), within((high - point).floor() + 1.0));
    first..end.max(first)
}

impl Windings {
    /// Of a tile of some texels a side, at a point of each texel; `slack`: how far corners may lie elsewhere along each axis.
    pub(super) fn new(edges: &[Edge], (size, point): (usize, [f64; 2]), slack: f64) -> Self {
        let around = |of: &dyn Fn(&Texel) -> f64, point: f64| {
            let all = edges.iter().flat_map(|edge| [of(&edge.from), of(&edge.to)]);
            let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
                (crate::math::min(low, v), crate::math::max(high, v))
            });
            between(low - slack, high + slack, point, size)
        };
        let (columns, rows) = (around(&|p| p.x, point[0]), around(&|p| p.y, point[1]));
        let mut windings =
            Self { of: vec![0; columns.len() * rows.len()], columns, rows, open: Vec::new(), size };
        if windings.of.is_empty() {
            return windings;
        }
        for edge in edges {
            windings.cross(edge, point);
            windings.open_along(edge, point, slack);
        }
        let width = windings.columns.len();
        for row in windings.of.chunks_mut(width) {
            let mut sum = 0;
            for winding in row {
                sum += *winding;
                *winding = sum;
            }
        }
        windings.open.sort_unstable();
        windings
    }

    /// Changes the winding where an edge crosses rows; windings are differences to the texel before, for now.
    fn cross(&mut self, edge: &Edge, point: [f64; 2]) {
        let by = if edge.from.y < edge.to.y { 1 } else { -1 };
        let (low, high) = edge.rows();
        let d = edge.to - edge.from;
        for row in between(low, high, point[1], self.size) {
            let y = row as f64 + point[1];
            if !(self.rows.contains(&row) && low <= y && y < high) {
                continue;
            }
            let x = edge.from.x + d.x * ((y - edge.from.y) / d.y);
            let column = (x - point[0]).ceil().clamp(self.columns.start as f64, self.columns.end as f64);
            let column = column as usize - self.columns.start;
            if column < self.columns.len() {
                self.of[(row - self.rows.start) * self.columns.len() + column] += by;
            }
        }
    }

    fn open_along(&mut self, edge: &Edge, point: [f64; 2], slack: f64) {
        let (low, high) = edge.rows();
        for row in between(low - slack, high + slack, point[1], self.size) {
            let y = row as f64 + point[1];
            let Some((west, east)) = edge.columns_within(y - slack, y + slack) else { continue };
            for column in between(west - slack, east + slack, point[0], self.size) {
                let at = Texel::new(column as f64 + point[0], y);
                let (less, more) = match (edge.is_on(at), edge.has_inside(at)) {
                    // Whichever way it was counted.
                    (true, _) => (1, 1),
                    (false, true) => (1, 0),
                    (false, false) => (0, 1),
                };
                self.open.push(((column + self.size * row) as u32, less, more));
            }
        }
    }

    /// The winding of a texel within the rectangle as the edges lie.
    pub(super) fn at(&self, column: usize, row: usize) -> i32 {
        let (columns, rows) = (&self.columns, &self.rows);
        self.of[(row - rows.start) * columns.len() + (column - columns.start)]
    }

    /// Calls `visit` with each texel of the rectangle, its least and its greatest winding.
    pub(super) fn for_each(&self, visit: &mut dyn FnMut(usize, i32, i32)) {
        let mut open = self.open.iter().peekable();
        for row in self.rows.clone() {
            for column in self.columns.clone() {
                let (texel, winding) = (column + self.size * row, self.at(column, row));
                let (mut least, mut most) = (winding, winding);
                while let Some((_, less, more)) = open.next_if(|(at, ..)| *at as usize <= texel) {
                    (least, most) = (least - less, most + more);
                }
                visit(texel, least, most);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::edges::Outline;
    use super::*;

    /// The texels of a tile: least and most windings.
    fn windings(edges: &[Edge], slack: f64) -> Vec<(i32, i32)> {
        let mut all = vec![(0, 0); 64];
        Windings::new(edges, (8, [0.5; 2]), slack)
            .for_each(&mut |texel, least, most| all[texel] = (least, most));
        all
    }

    fn triangle(corners: [[f64; 2]; 3]) -> Vec<Edge> {
        let mut outline = Outline::default();
        outline.triangle(corners.map(|[x, y]| Texel::new(x, y)), 0.01);
        outline.edges()
    }

    #[test]
    fn centres_far_from_all_edges_are_known() {
        let all = windings(&triangle([[1.0, 1.0], [7.0, 1.0], [1.0, 7.0]]), 0.1);
        // The diagonal runs through centres (3.5, 4.5).
        assert!(all[8 * 4 + 3].0 <= 0 && all[8 * 4 + 3].1 >= 1);
        assert_eq!(
            [all[8 * 4 + 2], all[8 + 1], all[8 * 6 + 6], all[8 * 3 + 3]],
            [(1, 1), (1, 1), (0, 0), (1, 1)]
        );
        let open = all.iter().filter(|(least, most)| least != most).count();
        assert_eq!(open, 6);
    }

    #[test]
    fn moved_corners_stay_within_the_windings() {
        let corners = [[1.3, 0.4], [7.7, 2.6], [2.4, 6.9]];
        let slack = 0.2;
        let all = windings(&triangle(corners), slack);
        for k in 0..64 {
            let off = |bit: usize| if k >> bit & 1 == 0 { -slack } else { slack };
            let mut moved = corners;
            for (n, corner) in moved.iter_mut().enumerate() {
                *corner = [corner[0] + off(2 * n), corner[1] + off(2 * n + 1)];
            }
            let exact = windings(&triangle(moved), 0.0);
            assert!(all.iter().zip(&exact).all(|((low, high), (_, exact))| low <= exact && exact <= high));
        }
    }
}
