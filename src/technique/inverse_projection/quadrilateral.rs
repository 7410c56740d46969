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

    /// Whether a segment has a point in it or on its border; `bounds` are its own.
    #[inline]
    pub fn meets(&self, bounds: &PlanBox, a: Plan, b: Plan) -> bool {
        if !bounds.meets(&PlanBox::around([a, b])) {
            return false;
        }
        // Where the corners lie of the segment's line.
        let of_line = self.0.map(|p| orient2d(a, b, p));
        if of_line.iter().all(|side| *side > 0.0) || of_line.iter().all(|side| *side < 0.0) {
            return false;
        }
        let meets_side = |k: usize| {
            let next = (k + 1) % 4;
            segments_meet((a, b), (self.0[k], self.0[next]), (of_line[k], of_line[next]))
        };
        (0..4).any(meets_side) || self.contains(a)
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
}

/// Whether two closed segments share a point, a b and p q, of whose ends the latter two lie so of the former's line.
#[inline]
fn segments_meet((a, b): (Plan, Plan), (p, q): (Plan, Plan), (of_p, of_q): (f64, f64)) -> bool {
    let apart = |s: f64, t: f64| (s > 0.0 && t > 0.0) || (s < 0.0 && t < 0.0);
    if apart(of_p, of_q) || apart(orient2d(p, q, a), orient2d(p, q, b)) {
        return false;
    }
    // On one line: they meet when their boxes do.
    of_p != 0.0 || of_q != 0.0 || PlanBox::around([a, b]).meets(&PlanBox::around([p, q]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quad(points: [(f64, f64); 4]) -> Quadrilateral {
        Quadrilateral(points.map(|(x, y)| Plan::new(x, y)))
    }

    #[test]
    fn a_segment_that_passes_through_inside_or_along_a_side_meets_a_quadrilateral() {
        let square = quad([(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]);
        let meets = |a: (f64, f64), b: (f64, f64)| {
            square.meets(&square.bounds(), Plan::new(a.0, a.1), Plan::new(b.0, b.1))
        };
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
