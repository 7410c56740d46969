//! How large a feature is in the plan: a number to order by, the same bits on every machine.

use crate::overlay::union_border;
use crate::scene::{Rule, Shape};
use crate::source::vector::{inner_point, signed_area};
use crate::space::{Plan, PlanBox};

/// The length of a shape's polylines, or of its rings: the sum over the segments in their order.
pub(super) fn length(shape: &Shape) -> f64 {
    if matches!(shape, Shape::Points(_)) {
        return 0.0;
    }
    let is_closed = shape.is_area();
    let of_part = |part: &Vec<Plan>| {
        let closing = part.last().zip(part.first()).filter(|_| is_closed);
        let segments = part.windows(2).map(|pair| (pair[0], pair[1])).chain(closing.map(|(a, b)| (*a, *b)));
        segments.map(|(a, b)| (b - a).length()).sum::<f64>()
    };
    shape.parts().map(of_part).sum()
}

/// The area of polygons, given by their members: of their union, where members overlap.
pub(super) fn area_of_members(members: &[Vec<Vec<Plan>>], rule: Rule) -> f64 {
    match union_border(members, &|turns| rule.contains(turns)) {
        Ok(Some(border)) => area(&border, rule),
        // What can not be united can not be drawn: whoever draws says so.
        Ok(None) | Err(_) => area(&members.concat(), rule),
    }
}

/// The area that rings enclose by a rule, where they do not cross themselves or one another.
///
/// A ring lies in a larger one, by the absolute of its signed area, when a point inside it does; the turns of all rings in which it
/// lies are the turns around it. Inside it there is one turn more or less. Its area is added where the rule has its inside in and what
/// is around it out (an island), taken off where it is the other way (a hole), and left out where both are the same. Rings that
/// cross make a number of this kind, too, but not their area.
pub(super) fn area(rings: &[Vec<Plan>], rule: Rule) -> f64 {
    let mut rings: Vec<Ring<'_>> =
        rings.iter().map(|ring| Ring::new(ring)).filter(|r| r.area != 0.0).collect();
    rings.sort_by(|a, b| b.area.abs().total_cmp(&a.area.abs()));
    let enclosed = |(at, ring): (usize, &Ring<'_>)| {
        let around: i32 = match inner_point(ring.points) {
            Some(p) => rings[..at].iter().map(|larger| larger.turns_around(p)).sum(),
            None => 0,
        };
        let turn = if ring.area > 0.0 { 1 } else { -1 };
        let inside = i32::from(rule.contains(around + turn));
        f64::from(inside - i32::from(rule.contains(around))) * ring.area.abs()
    };
    rings.iter().enumerate().map(enclosed).sum()
}

struct Ring<'a> {
    points: &'a [Plan],
    /// Positive where it runs against the clock.
    area: f64,
    bounds: PlanBox,
}

impl<'a> Ring<'a> {
    fn new(points: &'a [Plan]) -> Self {
        Self { points, area: 0.5 * signed_area(points), bounds: PlanBox::around(points.iter().copied()) }
    }

    fn edges(&self) -> impl Iterator<Item = (Plan, Plan)> {
        let next = self.points.iter().cycle().skip(1);
        self.points.iter().zip(next).map(|(a, b)| (*a, *b))
    }

    /// The edges that cross the horizontal line at `y`, with where they do.
    fn crossings(&self, y: f64) -> impl Iterator<Item = (Plan, Plan, f64)> {
        let crossing = self.edges().filter(move |(a, b)| (a.y <= y) != (b.y <= y));
        crossing.map(move |(a, b)| (a, b, a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x)))
    }

    /// How often the ring turns around a point, against the clock.
    fn turns_around(&self, p: Plan) -> i32 {
        if !PlanBox::around([p]).meets(&self.bounds) {
            return 0;
        }
        let east = self.crossings(p.y).filter(|(_, _, x)| *x > p.x);
        east.map(|(a, b, _)| if a.y < b.y { 1 } else { -1 }).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(points: &[(f64, f64)]) -> Vec<Plan> {
        points.iter().map(|(x, y)| Plan::new(*x, *y)).collect()
    }

    /// A square around a point, against the clock.
    fn square(x: f64, y: f64, half: f64) -> Vec<Plan> {
        ring(&[(x - half, y - half), (x + half, y - half), (x + half, y + half), (x - half, y + half)])
    }

    fn reversed(mut ring: Vec<Plan>) -> Vec<Plan> {
        ring.reverse();
        ring
    }

    #[test]
    fn holes_are_taken_off_and_islands_in_them_added_however_rings_turn() {
        let (outer, hole, island) = (square(0.0, 0.0, 4.0), square(1.0, 1.0, 2.0), square(1.0, 1.0, 1.0));
        for turned in 0..8 {
            let mut rings = vec![outer.clone(), hole.clone(), island.clone()];
            for (k, ring) in rings.iter_mut().enumerate().filter(|(k, _)| turned >> k & 1 == 1) {
                *ring = reversed(std::mem::take(ring));
                assert!(k < 3);
            }
            rings.rotate_left(turned % 3);
            assert_eq!(area(&rings, Rule::EvenOdd), 64.0 - 16.0 + 4.0, "{turned}");
        }
    }

    #[test]
    fn by_the_nonzero_rule_only_a_ring_that_turns_back_is_a_hole() {
        let (outer, inner) = (square(0.0, 0.0, 4.0), square(1.0, 1.0, 2.0));
        assert_eq!(area(&[outer.clone(), inner.clone()], Rule::NonZero), 64.0);
        assert_eq!(area(&[outer, reversed(inner)], Rule::NonZero), 48.0);
    }

    #[test]
    fn parts_that_touch_are_beside_each_other_and_holes_that_touch_are_holes() {
        let beside = [square(-1.0, 0.0, 1.0), square(1.0, 0.0, 1.0), square(0.0, 2.0, 1.0)];
        assert_eq!(area(&beside, Rule::EvenOdd), 12.0);
        let touching =
            [square(0.0, 0.0, 4.0), square(3.0, 3.0, 1.0), ring(&[(-4.0, 0.0), (0.0, -2.0), (0.0, 2.0)])];
        assert_eq!(area(&touching, Rule::EvenOdd), 64.0 - 4.0 - 8.0);
    }

    #[test]
    fn what_encloses_nothing_has_no_area() {
        for rings in
            [vec![], vec![ring(&[])], vec![ring(&[(1.0, 2.0)])], vec![ring(&[(0.0, 0.0), (1.0, 1.0)])]]
        {
            assert_eq!(area(&rings, Rule::EvenOdd), 0.0);
        }
    }

    #[test]
    fn rings_are_as_long_as_they_are_closed() {
        let points = ring(&[(0.0, 0.0), (3.0, 4.0)]);
        assert_eq!(length(&Shape::Line(vec![points.clone(), points.clone()])), 10.0);
        assert_eq!(length(&Shape::Polygon(vec![points])), 10.0);
        assert_eq!(length(&Shape::Polygon(vec![square(0.0, 0.0, 1.0)])), 8.0);
        assert_eq!(length(&Shape::Line(vec![vec![]])), 0.0);
    }
}
