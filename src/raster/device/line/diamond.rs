//! The diamond-exit rule (OpenGL 2.1, section 3.4.1; 4.6, section 14.5.1), decided exactly.
//!
//! A fragment is produced where the segment leaves the diamond |x - column| + |y - row| < 1/2 around a pixel's centre:
//! the segment meets the diamond and does not end in it. In each column of pixels a segment whose slope is at most 1
//! meets only one diamond, the one in which it crosses the line through the centres (where it crosses that line at
//! height h off the centre, |h| < 1/2, it is at most |h| + |dx| off beside it, and the neighbours' diamonds begin at
//! 1/2 + |dx|). So a fragment is produced in each column from the first whose diamond the start has not left to the
//! last whose diamond the end has left.
//!
//! End points are moved by an infinitesimal step, left and by much less down the screen (see `line/mod.rs`): so a
//! diamond owns its two right sides with the tip between them, but neither the upper nor the lower tip; and a segment
//! that passes between two rows through their diamonds' tips belongs to the row that its slope says.

use super::super::scan::Window;
use super::segment::Plane;
use super::style::Stipple;
use crate::math;
use crate::predicate::orient2d;
use crate::space::Plan;
use std::cmp::Ordering;
use std::ops::Range;

/// The diamonds that a segment leaves. Points are (major, minor) coordinates: (x, y) of a segment with a slope of at
/// most 1 ("x-major"), else (y, x); a place along the major axis is called a column here whichever it is.
pub(super) struct Diamonds {
    ends: Plane,
    /// Whether the major axis is y.
    is_steep: bool,
    /// 1: the major coordinate grows from the start to the end; else -1.
    direction: i64,
    width: u32,
    /// What is added to the minor coordinate, instead of moving the segment, so that no rounding enters.
    shift: f64,
    slope: f64,
    /// A bound of the error of minor coordinates that are computed from the slope.
    hair: f64,
    /// Columns of the first and of the last fragment; the last may lie before the first: there is none.
    first: i64,
    last: i64,
}

impl Diamonds {
    /// Of a segment that is as wide as so many pixels; `None` for one of no length. Its coordinates are below 2^40, and
    /// 0 or above 2^-100 (on a screen they are sums with half the picture's size: no digit of theirs is as small).
    pub(super) fn new([a, b]: Plane, width: u32) -> Option<Self> {
        if a == b {
            return None;
        }
        // Rounding keeps an order but for equality.
        let is_steep = distance(a[1], b[1]) > distance(a[0], b[0]);
        let turned = |p: [f64; 2]| if is_steep { [p[1], p[0]] } else { p };
        let (a, b) = (turned(a), turned(b));
        let middle = (f64::from(width) - 1.0) / 2.0;
        let largest = [a[0], a[1], b[0], b[1]].into_iter().fold(0.0, |most, v| math::max(most, v.abs()));
        let mut diamonds = Self {
            ends: [a, b],
            is_steep,
            direction: if b[0] > a[0] { 1 } else { -1 },
            width,
            // "y0 - (w - 1) / 2" is down the screen, "x0 - (w - 1) / 2" to the left.
            shift: if is_steep { -middle } else { middle },
            slope: (b[1] - a[1]) / (b[0] - a[0]),
            // At most 20 roundings of numbers that are no larger than this.
            hair: (largest + f64::from(width) + 2.0) * (32.0 * f64::EPSILON),
            first: 0,
            last: 0,
        };
        diamonds.first = diamonds.first_column();
        diamonds.last = diamonds.last_column();
        Some(diamonds)
    }

    fn first_column(&self) -> i64 {
        let mut column = self.ends[0][0].floor() as i64 - self.direction;
        while self.has_left(self.ends[0], column) {
            column += self.direction;
        }
        column
    }

    fn last_column(&self) -> i64 {
        let mut column = self.ends[1][0].floor() as i64 + self.direction;
        while !self.has_left(self.ends[1], column) {
            column -= self.direction;
        }
        column
    }

    /// How many columns have a fragment.
    pub(super) fn steps(&self) -> u64 {
        u64::try_from((self.last - self.first) * self.direction + 1).unwrap_or(0)
    }

    /// Calls `visit` with the pixels of a window that are drawn.
    pub(super) fn visit(
        &self,
        stipple: Stipple,
        counter: u64,
        window: &Window,
        visit: &mut dyn FnMut([usize; 2]),
    ) {
        let (majors, minors) =
            if self.is_steep { (&window.rows, &window.columns) } else { (&window.columns, &window.rows) };
        let at = |step: i64| self.first + step * self.direction;
        for step in self.steps_in(majors) {
            let Ok(major) = usize::try_from(at(step)) else { continue };
            if !stipple.is_on(counter + step as u64) {
                continue;
            }
            for minor in self.covered(self.minor_at(at(step)), minors) {
                visit(if self.is_steep { [minor, major] } else { [major, minor] });
            }
        }
    }

    /// The steps from the first column on whose columns are in a range.
    fn steps_in(&self, columns: &Range<usize>) -> Range<i64> {
        let (low, high) = (columns.start as i64, columns.end as i64);
        let (from, to) = match self.direction {
            1 => (low - self.first, high - self.first),
            _ => (self.first - high + 1, self.first - low + 1),
        };
        from.max(0)..to.min(self.steps() as i64)
    }

    /// The pixels that a column has, of those in a range: as many as the line is wide, from the one that the moved
    /// segment draws on: that is the lowest on the screen, or the leftmost.
    fn covered(&self, minor: i64, range: &Range<usize>) -> Range<usize> {
        let more = i64::from(self.width) - 1;
        let (from, to) = if self.is_steep { (minor, minor + more) } else { (minor - more, minor) };
        let clamped = |v: i64| usize::try_from(v).unwrap_or(0);
        range.start.max(clamped(from))..range.end.min(clamped(to + 1))
    }

    /// The pixel in whose diamond the segment's straight line crosses a column's centres.
    fn minor_at(&self, column: i64) -> i64 {
        let [a, _] = self.ends;
        let near = a[1] + (column as f64 + 0.5 - a[0]) * self.slope + self.shift;
        let mut minor = near.floor() as i64;
        let above = near - near.floor();
        if above > self.hair && above < 1.0 - self.hair {
            return minor;
        }
        while !self.passes_over(column, minor) {
            minor -= 1;
        }
        while self.passes_over(column, minor + 1) {
            minor += 1;
        }
        minor
    }

    /// Whether the moved straight line crosses a column's centres at more than the tip between a pixel and the one
    /// before it.
    fn passes_over(&self, column: i64, minor: i64) -> bool {
        let [a, b] = self.ends;
        let tip = [column as f64 + 0.5, minor as f64 - self.shift];
        let side = side(a, b, tip);
        if side != 0.0 {
            // The determinant is the major extent times how far the tip lies above the line.
            return (side < 0.0) == (self.direction > 0);
        }
        // Moved by (-e, +e^2) the line crosses at slope * e + e^2 more; a steep one, at e less.
        !self.is_steep && (b[1] == a[1] || (b[1] > a[1]) == (self.direction > 0))
    }

    /// Whether a moved end point lies beyond the diamond that the segment's straight line has in a column.
    fn has_left(&self, p: [f64; 2], column: i64) -> bool {
        let centre = column as f64 + 0.5;
        // A point on the centres' line moves off it: to the left, or down a steep segment's column.
        let is_after = match p[0].total_cmp(&centre) {
            Ordering::Greater => true,
            Ordering::Less => false,
            Ordering::Equal => self.is_steep,
        };
        if is_after != (self.direction > 0) {
            return false;
        }
        !self.is_in_diamond(p, [centre, self.minor_at(column) as f64 + 0.5 - self.shift])
    }

    /// Whether a moved point lies in the diamond around a centre.
    fn is_in_diamond(&self, p: [f64; 2], centre: [f64; 2]) -> bool {
        let sign = |axis: usize| if p[axis] >= centre[axis] { 1.0 } else { -1.0 };
        let (i, j) = (sign(0), sign(1));
        let side = side([centre[0] + 0.5 * i, centre[1]], [centre[0], centre[1] + 0.5 * j], p) * i * j;
        let x = usize::from(self.is_steep);
        // On the border the step to the left decides.
        side > 0.0 || side == 0.0 && p[x] > centre[x]
    }
}

/// The distance of two numbers without any rounding: a double, and what it lacks (Knuth's two-sum).
fn distance(a: f64, b: f64) -> [f64; 2] {
    let (low, high) = if a < b { (a, b) } else { (b, a) };
    let rounded = high - low;
    let of_low = high - rounded;
    let of_high = rounded + of_low;
    [rounded, (high - of_high) + (of_low - low)]
}

/// Twice the area of (a, b, p), with its right sign.
fn side(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> f64 {
    let plan = |p: [f64; 2]| Plan::new(p[0], p[1]);
    orient2d(plan(a), plan(b), plan(p))
}
