//! Convex polygons of the screen cut at lines, and how much is left.

use crate::math;
use std::ops::Range;

/// What a convex polygon has where a linear function is at least 0.
pub(super) fn cut(polygon: &[[f64; 2]], inside: impl Fn([f64; 2]) -> f64) -> Vec<[f64; 2]> {
    let mut out = Vec::with_capacity(polygon.len() + 1);
    for (k, &p) in polygon.iter().enumerate() {
        let q = polygon[(k + 1) % polygon.len()];
        let (at_p, at_q) = (inside(p), inside(q));
        if at_p >= 0.0 {
            out.push(p);
        }
        if (at_p >= 0.0) != (at_q >= 0.0) {
            let t = at_p / (at_p - at_q);
            out.push([p[0] + (q[0] - p[0]) * t, p[1] + (q[1] - p[1]) * t]);
        }
    }
    out
}

/// The area of a polygon whose corners run as the pixel's were given.
pub(super) fn area(polygon: &[[f64; 2]]) -> f64 {
    let Some((first, others)) = polygon.split_first() else { return 0.0 };
    let from_first = |p: &[f64; 2]| [p[0] - first[0], p[1] - first[1]];
    let twice: f64 = others
        .windows(2)
        .map(|pair| {
            let (p, q) = (from_first(&pair[0]), from_first(&pair[1]));
            p[0] * q[1] - p[1] * q[0]
        })
        .sum();
    twice / 2.0
}

/// The least and the greatest of some numbers.
pub(super) fn extent(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [math::min(v, low), math::max(v, high)])
}

/// The pixels of a range that numbers between two lie in, or are a rounding beside.
pub(super) fn pixels(low: f64, high: f64, range: &Range<usize>) -> Range<usize> {
    const HAIR: f64 = 1e-6;
    // Casts saturate: what lies before the first pixel becomes 0.
    range.start.max((low - HAIR).floor() as usize)..range.end.min((high + HAIR).ceil() as usize)
}
