//! What a triangle of the hierarchy and the full surface over it surely lie in.
//!
//! Input: a triangle, its error. Output: [`Around`]. Refuses: nothing.

use crate::math;
use crate::space::World;
use crate::terrain::Bounds;
use glam::DVec3;

/// A convex body.
#[derive(Debug, Clone, Copy)]
pub(super) enum Around {
    /// Over a plane, where distances are heights.
    Box(Bounds),
    /// In space.
    Hull(Hull),
}

/// All points that are no farther from a triangle than some distance.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hull {
    /// The triangle; it may be a point.
    pub corners: [World; 3],
    /// The distance, metres.
    pub reach: f64,
}

impl Hull {
    /// How far it is from a point at least.
    pub fn distance_from(&self, point: World) -> f64 {
        math::max(distance(self.corners.map(|corner| corner - point)) - self.reach, 0.0)
    }
}

/// How far a triangle is from the origin.
fn distance([a, b, c]: [DVec3; 3]) -> f64 {
    let normal = (b - a).cross(c - a);
    // The origin lies over the triangle's inside where it is on the left of each side, seen along the normal.
    let is_left = |p: DVec3, q: DVec3| (q - p).cross(-p).dot(normal) >= 0.0;
    let area = normal.length();
    if area > 0.0 && is_left(a, b) && is_left(b, c) && is_left(c, a) {
        return (a.dot(normal) / area).abs();
    }
    math::min(math::min(from_side(a, b), from_side(b, c)), from_side(c, a))
}

/// How far a segment is from the origin.
fn from_side(p: DVec3, q: DVec3) -> f64 {
    let along = q - p;
    let square = along.length_squared();
    let share = if square > 0.0 { (-p.dot(along) / square).clamp(0.0, 1.0) } else { 0.0 };
    (p + along * share).length()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hull_is_as_far_as_its_nearest_point() {
        let corners = [World::new(2.0, -3.0, 1.0), World::new(5.0, 4.0, 0.0), World::new(-1.0, 2.0, 6.0)];
        let [a, b, c] = corners.map(World::to_vec);
        let shares = || {
            (0..=200).flat_map(|i| (0..=200 - i).map(move |j| (f64::from(i) / 200.0, f64::from(j) / 200.0)))
        };
        for point in
            [[0.0; 3], [2.0, 1.0, 9.0], [2.2, 1.1, 2.0], [9.0, 9.0, -3.0], [-8.0, 1.0, 7.0], [3.0, -9.0, 2.0]]
        {
            let point = DVec3::from(point);
            let nearest = shares().map(|(s, t)| (a + (b - a) * s + (c - a) * t - point).length());
            let nearest = nearest.fold(f64::INFINITY, math::min);
            let found = Hull { corners, reach: 0.0 }.distance_from(World::from(point));
            assert!(found <= nearest + 1e-12 && found > nearest - 0.06, "{found} {nearest}");
            let wider = Hull { corners, reach: 0.5 }.distance_from(World::from(point));
            assert!((wider - math::max(found - 0.5, 0.0)).abs() < 1e-12);
            // A point, and a segment.
            let of = |corners| Hull { corners, reach: 0.0 }.distance_from(World::from(point));
            assert!((of([corners[0]; 3]) - (a - point).length()).abs() < 1e-12);
            assert!(of([corners[0], corners[1], corners[1]]) >= found - 1e-12);
        }
    }
}
