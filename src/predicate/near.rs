//! Distances from segments of the plan, compared exactly.
//!
//! All that is compared is a polynomial of stored numbers, or a square. Refuses: nothing.

use super::Expansion;
use crate::space::{Plan, World};

/// A difference of two plan points, exact.
#[derive(Debug, Clone)]
pub struct Displacement([Expansion; 2]);

impl Displacement {
    /// From one point to another.
    pub fn new(of: Plan, minus: Plan) -> Self {
        Self([Expansion::difference(of.x, minus.x), Expansion::difference(of.y, minus.y)])
    }

    /// A metre to the east.
    pub fn east() -> Self {
        Self([1.0, 0.0].map(Expansion::exactly))
    }

    /// The scalar product.
    pub fn dot(&self, other: &Self) -> Expansion {
        self.0[0].times(&other.0[0]).plus(&self.0[1].times(&other.0[1]))
    }

    /// The product that is positive where `other` lies to the left.
    pub fn cross(&self, other: &Self) -> Expansion {
        self.0[0].times(&other.0[1]).minus(&self.0[1].times(&other.0[0]))
    }

    /// Whether the square of its length is at most this.
    pub fn is_within(&self, reach_squared: &Expansion) -> bool {
        self.dot(self).minus(reach_squared).sign() <= 0.0
    }
}

/// The square of the distance of two points of the world.
pub fn distance_squared(a: World, b: World) -> Expansion {
    let square = |of: f64, minus: f64| {
        let d = Expansion::difference(of, minus);
        d.times(&d)
    };
    square(a.x, b.x).plus(&square(a.y, b.y)).plus(&square(a.z, b.z))
}

/// Whether a point is no farther from a segment than a reach, of which the square is given; a segment of no length is a point.
pub fn is_near_segment(at: Plan, [from, to]: [Plan; 2], reach_squared: &Expansion) -> bool {
    let (along, from_start) = (Displacement::new(to, from), Displacement::new(at, from));
    if along.dot(&from_start).sign() <= 0.0 {
        return from_start.is_within(reach_squared);
    }
    let from_end = Displacement::new(at, to);
    if along.dot(&from_end).sign() >= 0.0 {
        return from_end.is_within(reach_squared);
    }
    let across = along.cross(&from_start);
    across.times(&across).minus(&along.dot(&along).times(reach_squared)).sign() <= 0.0
}
