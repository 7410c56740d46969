//! The spatial range of a pixel on the plane of the vectors (She 3.2, Fig. 6) and sample positions in it (3.4, Fig. 8).

use crate::math;
use crate::predicate::orient2d;
use crate::space::{Plan, PlanBox};

/// A pixel's range in the plan: the corners self, right, upper right, upper. Anything from convex to self-crossing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quadrilateral(pub [Plan; 4]);

impl Quadrilateral {
    /// A range of no extent: what a pixel has whose quadrilateral means nothing.
    pub fn point(p: Plan) -> Self {
        Self([p; 4])
    }

    /// The rectangle around it.
    #[inline]
    pub fn bounds(&self) -> PlanBox {
        let [a, b, c, d] = self.0;
        let low = |a, b, c, d| math::min(math::min(a, b), math::min(c, d));
        let high = |a, b, c, d| math::max(math::max(a, b), math::max(c, d));
        PlanBox {
            min: Plan::new(low(a.x, b.x, c.x, d.x), low(a.y, b.y, c.y, d.y)),
            max: Plan::new(high(a.x, b.x, c.x, d.x), high(a.y, b.y, c.y, d.y)),
        }
    }

    /// The sides, in order.
    #[inline]
    fn sides(&self) -> [(Plan, Plan); 4] {
        let [a, b, c, d] = self.0;
        [(a, b), (b, c), (c, d), (d, a)]
    }

    /// The western and eastern end of its part between two latitudes; `None` when it has no point there.
    pub fn span(&self, south: f64, north: f64) -> Option<(f64, f64)> {
        let (mut west, mut east) = (f64::INFINITY, f64::NEG_INFINITY);
        for (p, q) in self.sides() {
            let (low, high) = if p.y <= q.y { (p, q) } else { (q, p) };
            if high.y < south || low.y > north {
                continue;
            }
            let x_at = |y: f64| {
                if y <= low.y {
                    low.x
                } else if y >= high.y {
                    high.x
                } else {
                    low.x + (high.x - low.x) * ((y - low.y) / (high.y - low.y))
                }
            };
            for x in [x_at(south), x_at(north)] {
                west = math::min(x, west);
                east = math::max(x, east);
            }
        }
        (west <= east).then_some((west, east))
    }

    /// Whether a segment has a point in it or on its border.
    pub fn meets(&self, a: Plan, b: Plan) -> bool {
        let bounds = self.bounds();
        if !bounds.meets(&PlanBox::around([a, b])) {
            return false;
        }
        // All corners strictly on one side of the segment's line?
        let (mut all_left, mut all_right) = (true, true);
        for p in self.0 {
            let side = orient2d(a, b, p);
            all_left &= side > 0.0;
            all_right &= side < 0.0;
        }
        if all_left || all_right {
            return false;
        }
        self.sides().iter().any(|(p, q)| segments_meet(a, b, *p, *q)) || self.contains(a)
    }

    /// Whether a point lies in it (crossings of a ray to the east, half-open).
    fn contains(&self, p: Plan) -> bool {
        let crosses =
            |(a, b): &(Plan, Plan)| (a.y > p.y) != (b.y > p.y) && (orient2d(*a, *b, p) > 0.0) == (b.y > a.y);
        self.sides().iter().filter(|side| crosses(side)).count() % 2 == 1
    }

    /// She 3.4, Fig. 8b: the point at (u, v) by bilinear interpolation of the corners, u to the right, v up.
    #[inline]
    pub fn sample(&self, u: f64, v: f64) -> Plan {
        let [a, b, c, d] = self.0;
        let mix = |a: f64, b: f64, c: f64, d: f64| {
            let (lower, upper) = (a + (b - a) * u, d + (c - d) * u);
            lower + (upper - lower) * v
        };
        Plan::new(mix(a.x, b.x, c.x, d.x), mix(a.y, b.y, c.y, d.y))
    }

    /// She 3.4: calls `visit` with the n x n positions of mean sampling, rows from the lower edge.
    #[inline(always)]
    pub fn for_each_sample(&self, n: u32, mut visit: impl FnMut(Plan)) {
        let at = |k: u32| (f64::from(k) + 0.5) / f64::from(n);
        for row in 0..n {
            for column in 0..n {
                visit(self.sample(at(column), at(row)));
            }
        }
    }
}

/// Whether two closed segments share a point.
fn segments_meet(a: Plan, b: Plan, p: Plan, q: Plan) -> bool {
    let (ap, aq) = (orient2d(a, b, p), orient2d(a, b, q));
    let (pa, pb) = (orient2d(p, q, a), orient2d(p, q, b));
    let apart = |s: f64, t: f64| (s > 0.0 && t > 0.0) || (s < 0.0 && t < 0.0);
    if apart(ap, aq) || apart(pa, pb) {
        return false;
    }
    // On one line: they meet when their boxes do.
    ap != 0.0 || aq != 0.0 || PlanBox::around([a, b]).meets(&PlanBox::around([p, q]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quad(points: [(f64, f64); 4]) -> Quadrilateral {
        Quadrilateral(points.map(|(x, y)| Plan::new(x, y)))
    }

    #[test]
    fn the_samples_of_a_square_are_the_middles_of_its_parts() {
        let square = quad([(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]);
        let mut samples = Vec::new();
        square.for_each_sample(2, |p| samples.push((p.x, p.y)));
        assert_eq!(samples, [(0.5, 0.5), (1.5, 0.5), (0.5, 1.5), (1.5, 1.5)]);
    }

    #[test]
    fn a_segment_that_passes_through_inside_or_along_a_side_meets_a_quadrilateral() {
        let square = quad([(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]);
        let meets = |a: (f64, f64), b: (f64, f64)| square.meets(Plan::new(a.0, a.1), Plan::new(b.0, b.1));
        assert!(meets((-1.0, 1.0), (3.0, 1.5)), "through");
        assert!(meets((0.5, 0.5), (1.0, 1.0)), "inside");
        assert!(meets((0.5, 0.0), (5.0, 0.0)), "along a side");
        assert!(meets((2.0, 2.0), (3.0, 3.0)), "at a corner");
        assert!(!meets((-1.0, 1.5), (1.0, 3.5)), "past a corner");
        assert!(!meets((3.0, 0.0), (3.0, 2.0)), "beside");
    }

    #[test]
    fn a_band_cuts_a_span_out_of_a_slanted_quadrilateral() {
        let slanted = quad([(0.0, 0.0), (1.0, 0.0), (11.0, 10.0), (10.0, 10.0)]);
        assert_eq!(slanted.span(2.0, 4.0), Some((2.0, 5.0)));
        assert_eq!(slanted.span(10.5, 11.0), None);
    }
}
