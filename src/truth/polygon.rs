//! Convex pieces of a pixel, and cutting them.

use super::form::{Line, Side};

/// What the rounding of a cut's two new points can do to the areas on its sides, in pixels' areas; the same bounds the
/// rounding of an area's sum.
pub(super) const ROUNDING: f64 = 4e-15;

/// A convex polygon among the points of a [`Pieces`].
#[derive(Debug, Clone, Copy)]
pub(super) struct Polygon {
    start: u32,
    count: u32,
}

/// The points of all pieces of a pixel.
#[derive(Debug, Default)]
pub(super) struct Pieces {
    points: Vec<[f64; 2]>,
    distances: Vec<f64>,
}

/// A piece cut by a line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Halves {
    pub(super) inner: Option<Polygon>,
    pub(super) outer: Option<Polygon>,
}

impl Pieces {
    pub(super) fn clear(&mut self) {
        self.points.clear();
    }

    /// A square.
    pub(super) fn square(&mut self, [x, y]: [f64; 2], side: f64) -> Polygon {
        self.push(&corners(([x, y], side)))
    }

    fn push(&mut self, points: &[[f64; 2]]) -> Polygon {
        let start = self.points.len() as u32;
        self.points.extend_from_slice(points);
        Polygon { start, count: points.len() as u32 }
    }

    #[inline(always)]
    pub(super) fn of(&self, polygon: Polygon) -> &[[f64; 2]] {
        &self.points[polygon.start as usize..(polygon.start + polygon.count) as usize]
    }

    /// A piece's area in pixels' areas.
    pub(super) fn area(&self, polygon: Polygon) -> f64 {
        let points = self.of(polygon);
        let [ox, oy] = points[0];
        let mut twice = 0.0;
        for pair in points[1..].windows(2) {
            let ([ax, ay], [bx, by]) = (pair[0], pair[1]);
            twice += (ax - ox) * (by - oy) - (bx - ox) * (ay - oy);
        }
        let area = 0.5 * twice;
        if area > 0.0 { area } else { 0.0 }
    }

    /// Cuts a piece along a line; `slop` grows by what is doubtful. `None`: the line is not known well enough.
    pub(super) fn cut(&mut self, polygon: Polygon, line: &Line, slop: &mut f64) -> Option<Halves> {
        match line.side(self.of(polygon), slop) {
            Side::In => Some(Halves { inner: Some(polygon), outer: None }),
            Side::Out => Some(Halves { inner: None, outer: Some(polygon) }),
            Side::Unknown => None,
            Side::Both => Some(self.split(polygon, line, slop)),
        }
    }

    /// Splits a piece that has corners on both sides of a line.
    fn split(&mut self, polygon: Polygon, line: &Line, slop: &mut f64) -> Halves {
        let (start, count) = (polygon.start as usize, polygon.count as usize);
        let mut distances = std::mem::take(&mut self.distances);
        distances.clear();
        distances.extend(self.of(polygon).iter().map(|p| line.at(*p)));
        let half = |points: &mut Vec<[f64; 2]>, sign: f64| {
            let first = points.len() as u32;
            for k in 0..count {
                let next = if k + 1 < count { k + 1 } else { 0 };
                let (a, b) = (points[start + k], points[start + next]);
                let (s, t) = (distances[k], distances[next]);
                if s * sign >= 0.0 {
                    points.push(a);
                }
                if (s > 0.0 && t < 0.0) || (s < 0.0 && t > 0.0) {
                    // From the inner corner to the outer one, so that both halves get the same point.
                    let (from, to, s, t) = if s > 0.0 { (a, b, s, t) } else { (b, a, t, s) };
                    let along = s / (s - t);
                    points.push([from[0] + (to[0] - from[0]) * along, from[1] + (to[1] - from[1]) * along]);
                }
            }
            Polygon { start: first, count: points.len() as u32 - first }
        };
        let inner = half(&mut self.points, 1.0);
        let outer = half(&mut self.points, -1.0);
        self.distances = distances;
        *slop += ROUNDING;
        Halves { inner: Some(inner), outer: Some(outer) }
    }
}

/// A point in a convex piece: the mean of its corners.
pub(super) fn middle(piece: &[[f64; 2]]) -> [f64; 2] {
    let [x, y] = piece.iter().fold([0.0, 0.0], |[x, y], p| [x + p[0], y + p[1]]);
    [x / piece.len() as f64, y / piece.len() as f64]
}

/// The corners of a square, around it.
pub(super) fn corners(([x, y], side): ([f64; 2], f64)) -> [[f64; 2]; 4] {
    [[x, y], [x + side, y], [x + side, y + side], [x, y + side]]
}

/// Whether a convex piece may meet a square; false where they are surely apart.
pub(super) fn meets_square(piece: &[[f64; 2]], [x, y]: [f64; 2], side: f64) -> bool {
    // Far above the rounding of coordinates of a pixel.
    const SLACK: f64 = 1e-12;
    let square = corners(([x, y], side));
    let reach = |points: &[[f64; 2]], axis: usize| {
        points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| {
            (crate::math::min(p[axis], low), crate::math::max(p[axis], high))
        })
    };
    let is_apart = |axis: usize| {
        let ((a, b), (c, d)) = (reach(piece, axis), reach(&square, axis));
        b < c - SLACK || d < a - SLACK
    };
    let inside = middle(piece);
    let is_beyond = |p: [f64; 2], q: [f64; 2]| {
        let beside = |at: [f64; 2]| (q[0] - p[0]) * (at[1] - p[1]) - (q[1] - p[1]) * (at[0] - p[0]);
        let sign = if beside(inside) < 0.0 { -1.0 } else { 1.0 };
        square.iter().all(|at| beside(*at) * sign < -SLACK)
    };
    let edges = piece.iter().zip(piece.iter().cycle().skip(1));
    !is_apart(0) && !is_apart(1) && !edges.into_iter().any(|(p, q)| is_beyond(*p, *q))
}

/// Whether a convex piece holds a point, its border included.
pub(super) fn holds(piece: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let next = piece.iter().cycle().skip(1);
    piece.iter().zip(next).all(|(a, b)| (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]) >= 0.0)
}
