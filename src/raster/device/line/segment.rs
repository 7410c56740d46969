//! A line segment on the screen, and what its fragments are.

use super::super::number::Real;
use super::super::scan::Window;
use super::style::LineStyle;
use crate::math;

/// Screen coordinates of a line's ends, in pixels.
pub(super) type Plane = [[f64; 2]; 2];

/// A line segment on the screen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinePrimitive<T> {
    /// Screen x, screen y (pixels, snapped) and depth (0..=1) of the start and of the end.
    pub ends: [[T; 3]; 2],
}

impl<T: Real> LinePrimitive<T> {
    /// The ends' places.
    pub(super) fn plane(&self) -> Plane {
        self.ends.map(|[x, y, _]| [x.get(), y.get()])
    }

    /// The depth where a screen point, projected on the segment, lies (2.1, eq. 3.5): interpolated linearly, in the
    /// machine's numbers.
    pub(super) fn depth_at(&self, x: f64, y: f64) -> T {
        let [[ax, ay, az], [bx, by, bz]] = self.ends;
        let (dx, dy) = (bx - ax, by - ay);
        let t = ((T::of(x) - ax) * dx + (T::of(y) - ay) * dy) / (dx * dx + dy * dy);
        az + (bz - az) * t
    }

    /// The pixels of a window among which all fragments are (a few more may be in it); `None`: there are none.
    pub fn window(&self, style: &LineStyle, within: &Window) -> Option<Window> {
        let [a, b] = self.plane();
        let reach = style.reach();
        let span = |axis: usize, limit: &std::ops::Range<usize>| {
            let from = (math::min(a[axis], b[axis]) - reach).floor();
            let to = (math::max(a[axis], b[axis]) + reach).ceil();
            // Casts saturate: what lies before the first pixel becomes 0.
            let range = limit.start.max(from as usize)..limit.end.min(to as usize);
            (!range.is_empty()).then_some(range)
        };
        Some(Window { columns: span(0, &within.columns)?, rows: span(1, &within.rows)? })
    }
}
