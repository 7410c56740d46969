//! Anti-aliased lines: the exact area of the rectangle around a segment (OpenGL 2.1, section 3.4.2 "Antialiasing") in
//! each pixel's square.
//!
//! The rectangle is as wide as the line and ends at the segment's ends, square to it. A stippled line is a row of
//! rectangles one pixel long, of which the last may be shorter, and its counter counts them; those that touch are one
//! here, so that nothing is covered twice. Areas are good to 1e-9: that is what doubles lose over the guard band's
//! length.

use super::super::convex::{area, cut, extent, pixels};
use super::super::scan::Window;
use super::segment::Plane;
use super::style::{LineStyle, Stipple};
use crate::math;
use std::ops::Range;

/// A line's own coordinates: along it from its start, and to its left or right.
#[derive(Debug, Clone, Copy)]
struct Axis {
    start: [f64; 2],
    along: [f64; 2],
    length: f64,
}

impl Axis {
    fn new([a, b]: Plane) -> Option<Self> {
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let length = (dx * dx + dy * dy).sqrt();
        (length > 0.0).then(|| Self { start: a, along: [dx / length, dy / length], length })
    }

    /// A point's coordinates.
    fn of(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (x, y) = (x - self.start[0], y - self.start[1]);
        [x * self.along[0] + y * self.along[1], y * self.along[0] - x * self.along[1]]
    }

    /// The point that has these coordinates.
    fn at(&self, [s, side]: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.along;
        [self.start[0] + s * x - side * y, self.start[1] + s * y + side * x]
    }
}

/// How many rectangles a line is cut into.
pub(super) fn steps(plane: Plane) -> u64 {
    Axis::new(plane).map_or(0, |axis| axis.length.ceil() as u64)
}

/// Calls `visit` with each pixel of a window that the line covers, and how much of it.
pub(super) fn visit(
    plane: Plane,
    style: &LineStyle,
    counter: u64,
    window: &Window,
    visit: &mut dyn FnMut([usize; 2], f64),
) {
    let Some(axis) = Axis::new(plane) else { return };
    for part in dashes(style.stipple(), counter, near(&axis, window)) {
        let part = Part {
            axis,
            from: part.start as f64,
            to: math::min(part.end as f64, axis.length),
            half: style.width() / 2.0,
        };
        part.visit(window, visit);
    }
}

/// The numbers of the rectangles that may reach into a window.
fn near(axis: &Axis, window: &Window) -> Range<u64> {
    // Far more than what rounding can do.
    let reach = 1.0;
    let mut all = [axis.length, 0.0];
    for x in [window.columns.start as f64 - reach, window.columns.end as f64 + reach] {
        for y in [window.rows.start as f64 - reach, window.rows.end as f64 + reach] {
            let [s, _] = axis.of([x, y]);
            all = [math::min(s, all[0]), math::max(s, all[1])];
        }
    }
    // Casts saturate: a window before the start begins with the first rectangle.
    all[0].floor() as u64..math::min(all[1], axis.length).ceil() as u64
}

/// Runs of those numbered rectangles that the stipple draws.
fn dashes(stipple: Stipple, counter: u64, numbers: Range<u64>) -> Vec<Range<u64>> {
    let mut runs: Vec<Range<u64>> = Vec::new();
    for k in numbers.filter(|k| stipple.is_on(counter + k)) {
        match runs.last_mut() {
            Some(run) if run.end == k => run.end = k + 1,
            _ => runs.push(k..k + 1),
        }
    }
    runs
}

/// A part of the line's rectangle.
struct Part {
    axis: Axis,
    from: f64,
    to: f64,
    half: f64,
}

impl Part {
    fn visit(&self, window: &Window, visit: &mut dyn FnMut([usize; 2], f64)) {
        let (from, to, half) = (self.from, self.to, self.half);
        let corners = [[from, -half], [to, -half], [to, half], [from, half]].map(|p| self.axis.at(p));
        let [low, high] = extent(corners.into_iter().map(|p| p[1]));
        for row in pixels(low, high, &window.rows) {
            let [low, high] = across(&corners, row as f64, row as f64 + 1.0);
            for column in pixels(low, high, &window.columns) {
                let area = self.area_in([column as f64, row as f64]);
                if area > 0.0 {
                    visit([column, row], area);
                }
            }
        }
    }

    /// How much of a pixel is covered, given its upper left corner.
    fn area_in(&self, [x, y]: [f64; 2]) -> f64 {
        // Corners in the line's coordinates: as large as the line is long, but cut by numbers alone.
        let square = [[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0]].map(|p| self.axis.of(p));
        let is_inside = |[s, side]: [f64; 2]| s >= self.from && s <= self.to && side.abs() <= self.half;
        if square.into_iter().all(is_inside) {
            return 1.0;
        }
        let mut polygon = square.to_vec();
        for (index, limit, sign) in
            [(0, self.from, 1.0), (0, self.to, -1.0), (1, -self.half, 1.0), (1, self.half, -1.0)]
        {
            polygon = cut(&polygon, |p| (p[index] - limit) * sign);
        }
        math::min(math::max(area(&polygon), 0.0), 1.0)
    }
}

/// The x coordinates that a convex polygon has between two heights.
fn across(polygon: &[[f64; 2]; 4], top: f64, bottom: f64) -> [f64; 2] {
    let mut xs = Vec::with_capacity(8);
    for (k, p) in polygon.iter().enumerate() {
        let q = polygon[(k + 1) % 4];
        if p[1] >= top && p[1] <= bottom {
            xs.push(p[0]);
        }
        for y in [top, bottom] {
            if (p[1] < y) != (q[1] < y) {
                xs.push(p[0] + (q[0] - p[0]) * ((y - p[1]) / (q[1] - p[1])));
            }
        }
    }
    extent(xs.into_iter())
}
