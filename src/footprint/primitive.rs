//! What footprints are made of: half planes, convex shapes, discs.

use crate::interval::Ball;
use crate::space::{Plan, PlanBox};
use glam::DVec2;

/// The most half planes of a [`Convex`].
pub const MOST_SIDES: usize = 5;

/// The plan points p with `normal . (p - at) + offset >= 0`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfPlane {
    /// A point to measure from.
    pub at: Plan,
    /// The direction of what is inside.
    pub normal: [Ball; 2],
    /// How far `at` is inside, in lengths of the normal.
    pub offset: Ball,
}

impl HalfPlane {
    /// Whether no point of a box is in it, surely.
    pub fn excludes(&self, plan: &PlanBox) -> bool {
        let [x, y] = self.normal;
        let dx = if x.mid > 0.0 { plan.max.x } else { plan.min.x } - self.at.x;
        let dy = if y.mid > 0.0 { plan.max.y } else { plan.min.y } - self.at.y;
        let most = x.mid * dx + y.mid * dy + self.offset.mid;
        let reach = |low: f64, high: f64, at: f64| (low - at).abs() + (high - at).abs();
        let (wide, tall) =
            (reach(plan.min.x, plan.max.x, self.at.x), reach(plan.min.y, plan.max.y, self.at.y));
        let doubt = x.radius * wide + y.radius * tall + self.offset.radius;
        let rounding =
            16.0 * f64::EPSILON * (x.mid.abs() * wide + y.mid.abs() * tall + self.offset.mid.abs());
        most + doubt + rounding < 0.0
    }
}

/// The points in some half planes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Convex {
    sides: [HalfPlane; MOST_SIDES],
    count: usize,
}

/// The half planes of a [`Convex`].
pub type Sides<'a> = &'a [HalfPlane];

impl Convex {
    /// The points in all of these.
    ///
    /// # Panics
    /// When there are none, or more than [`MOST_SIDES`].
    pub fn new(sides: &[HalfPlane]) -> Self {
        let mut all = [sides[0]; MOST_SIDES];
        all[..sides.len()].copy_from_slice(sides);
        Self { sides: all, count: sides.len() }
    }

    /// The points of it that are in another half plane, too.
    ///
    /// # Panics
    /// When it has [`MOST_SIDES`] already.
    pub(super) fn cut(&self, by: HalfPlane) -> Self {
        let mut all = *self;
        all.sides[all.count] = by;
        all.count += 1;
        all
    }

    /// The half planes.
    pub fn sides(&self) -> Sides<'_> {
        &self.sides[..self.count]
    }
}

/// Whether all of a box is surely farther from a segment than `reach`.
fn is_beyond(from: Plan, to: Plan, reach: f64, plan: &PlanBox) -> bool {
    let middle = plan.min.to_vec() / 2.0 + plan.max.to_vec() / 2.0;
    let half = plan.max.to_vec() / 2.0 - plan.min.to_vec() / 2.0;
    let (along, to_middle) = (to - from, middle - from.to_vec());
    let squared = along.length_squared();
    let share = if squared > 0.0 { (to_middle.dot(along) / squared).clamp(0.0, 1.0) } else { 0.0 };
    let size =
        middle.abs().max_element() + half.max_element() + from.to_vec().abs().max_element() + along.length();
    (to_middle - along * share).length() > reach + half.length() + 64.0 * f64::EPSILON * (size + reach)
}

/// A piece of an item's boundary, or of its inside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Primitive {
    /// An edge of the item's polygon: across it the winding number changes.
    Edge {
        /// Where it starts.
        from: Plan,
        /// Where it ends.
        to: Plan,
    },
    /// Points of the item's stroke.
    Convex(Convex),
    /// Points of the item's stroke: those within `reach + growth * r` of the segment from -> to where coordinates are as many times as large as `scale` says, r
    /// their distance from the eye in space, metres.
    Near {
        /// Where the segment starts.
        from: Plan,
        /// Where it ends; for a disc where it starts.
        to: Plan,
        /// Metres of the width in a metre of the plan to the east and to the north: 1 but on a globe.
        scale: DVec2,
        /// The part of the distance that is the same everywhere, metres.
        reach: f64,
        /// The part that grows with the distance from the eye.
        growth: f64,
    },
    /// Points that may be of the item's stroke: a join on the verge of its miter limit.
    Perhaps(Convex),
}

impl Primitive {
    /// All within a distance of a point.
    pub fn disc(at: Plan, radius: f64) -> Self {
        Self::Near { from: at, to: at, scale: DVec2::ONE, reach: radius, growth: 0.0 }
    }

    /// An edge's line, and the lines across it at its ends: the edge lies on their inner sides.
    pub fn edge_sides(from: Plan, to: Plan) -> [HalfPlane; 3] {
        let x = Ball::exact(to.x) - Ball::exact(from.x);
        let y = Ball::exact(to.y) - Ball::exact(from.y);
        let side = |at, normal| HalfPlane { at, normal, offset: Ball::ZERO };
        [side(from, [-y, x]), side(from, [x, y]), side(to, [-x, -y])]
    }

    /// Whether it surely has nothing to do with a box: none of its points are there, and no edge crosses it.
    pub fn misses(&self, plan: &PlanBox) -> bool {
        match self {
            Self::Edge { from, to } => {
                let [along, start, end] = Self::edge_sides(*from, *to);
                let other = HalfPlane { normal: along.normal.map(|n| -n), ..along };
                [along, other, start, end].iter().any(|side| side.excludes(plan))
            }
            Self::Convex(shape) | Self::Perhaps(shape) => {
                shape.sides().iter().any(|side| side.excludes(plan))
            }
            // One that grows reaches as far as it grows.
            Self::Near { from, to, scale, reach, growth } => {
                let scaled = |p: Plan| Plan::from(p.to_vec() * *scale);
                let plan = PlanBox { min: scaled(plan.min), max: scaled(plan.max) };
                *growth == 0.0 && is_beyond(scaled(*from), scaled(*to), *reach, &plan)
            }
        }
    }
}
