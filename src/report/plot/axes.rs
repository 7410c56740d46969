//! The plot's rectangle, and where runs lie in it.

use super::super::axis::LogAxis;
use super::super::{Metric, Run};

/// The plot's rectangle in the picture: left, top, right, bottom.
pub(super) const FIELD: [f64; 4] = [74.0, 26.0, 724.0, 496.0];

/// Where a run lies.
pub(super) struct Axes {
    pub(super) time: LogAxis,
    pub(super) error: LogAxis,
    pub(super) metric: Metric,
}

impl Axes {
    pub(super) fn x(&self, ms: f64) -> f64 {
        FIELD[0] + self.time.place(ms) * (FIELD[2] - FIELD[0])
    }

    pub(super) fn y(&self, error: f64) -> f64 {
        FIELD[3] - self.error.place(error) * (FIELD[3] - FIELD[1])
    }

    pub(super) fn at(&self, run: &Run) -> [f64; 2] {
        [self.x(run.frame_ms.median), self.y(self.metric.of(run))]
    }
}

/// `M x y L x y ...`
pub(super) fn polyline(points: &[[f64; 2]]) -> String {
    let point = |(k, [x, y]): (usize, &[f64; 2])| {
        format!("{}{} {}", if k == 0 { 'M' } else { 'L' }, fixed(*x), fixed(*y))
    };
    points.iter().enumerate().map(point).collect()
}

/// A coordinate to a hundredth.
pub(super) fn fixed(v: f64) -> String {
    format!("{v:.2}")
}
