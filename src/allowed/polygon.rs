//! Convex polygons cut by what is linear: on the screen, in space.

use crate::math;
use glam::DVec2;
use std::ops::{Add, Mul, Sub};

/// What a convex polygon has where a linear function is at least 0.
pub(super) fn cut<P, V>(polygon: &[P], inside: impl Fn(P) -> f64) -> Vec<P>
where
    P: Copy + Sub<Output = V> + Add<V, Output = P>,
    V: Mul<f64, Output = V>,
{
    let mut out = Vec::with_capacity(polygon.len() + 1);
    for (k, p) in polygon.iter().enumerate() {
        let q = polygon[(k + 1) % polygon.len()];
        let (at_p, at_q) = (inside(*p), inside(q));
        if at_p >= 0.0 {
            out.push(*p);
        }
        if (at_p >= 0.0) != (at_q >= 0.0) {
            out.push(*p + (q - *p) * (at_p / (at_p - at_q)));
        }
    }
    out
}

/// The area of a convex polygon.
pub(super) fn area_of(polygon: &[DVec2]) -> f64 {
    let Some(first) = polygon.first() else { return 0.0 };
    let twice: f64 = polygon.windows(2).map(|pair| (pair[0] - *first).perp_dot(pair[1] - *first)).sum();
    twice.abs() / 2.0
}

/// The part of a convex polygon, or of a segment, in the rectangle between two corners.
pub(super) fn clipped(polygon: &[DVec2], [low, high]: [DVec2; 2]) -> Vec<DVec2> {
    let west = cut(polygon, |p| p.x - low.x);
    let both = cut(&west, |p| high.x - p.x);
    let south = cut(&both, |p| p.y - low.y);
    cut(&south, |p| high.y - p.y)
}

/// The largest distance between two of some points.
pub(super) fn diameter(points: &[DVec2]) -> f64 {
    let pairs =
        points.iter().enumerate().flat_map(|(k, a)| points[..k].iter().map(move |b| (*a - *b).length()));
    pairs.fold(0.0, math::max)
}
