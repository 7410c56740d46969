//! The joints of the paper: methods 1, 2, 3a and 3b, and the special situations that it leaves to the reader (4.2.4).

use super::strip::Strips;
use crate::predicate::orient2d;
use crate::space::Plan;
use glam::DVec2;

/// A corner farther from its vertex than this many half widths is taken for that of parallel lines, which have none: far beyond
/// what anyone would draw, near enough that its coordinates mean something. (Turns of more than 179.99988 degrees.)
pub(super) const FARTHEST_CORNER: f64 = 1e6;

/// A vertex between two segments.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Corner {
    pub(super) at: Plan,
    /// The left offsets of the segment before and of the one after: `o` and `o'` of Algorithm 1.
    pub(super) before: DVec2,
    pub(super) after: DVec2,
    /// Half the width.
    pub(super) half: f64,
    /// The lengths of both segments.
    pub(super) lengths: (f64, f64),
    /// Positive where the line turns left, negative where it turns right; 0 where it runs straight on or straight back. Exact.
    pub(super) turn: f64,
}

/// The left offset of a direction: `o` of 4.2.1, by Hill's perp operator.
pub(super) fn offset(direction: DVec2, half: f64) -> DVec2 {
    (direction / direction.length()).perp() * half
}

impl Corner {
    /// The corner of three vertices.
    pub(super) fn new([v1, v2, v3]: [Plan; 3], half: f64) -> Self {
        let (s1, s2) = (v2 - v1, v3 - v2);
        Self {
            at: v2,
            before: offset(s1, half),
            after: offset(s2, half),
            half,
            lengths: (s1.length(), s2.length()),
            turn: orient2d(v1, v2, v3),
        }
    }

    /// The cosine of the angle between both segments (`ang` of Algorithm 1: 180 degrees where the line runs straight on).
    pub(super) fn cosine(&self) -> f64 {
        -self.before.dot(self.after) / (self.half * self.half)
    }

    /// From the vertex to the intersection of the left offset lines; that of the right ones is opposite. `None` where they are as good
    /// as parallel and run back ([`FARTHEST_CORNER`]).
    ///
    /// `isect` of Algorithm 1, as the sum of both offsets over 1 + cos(turn): where the line runs nearly straight on, nothing cancels,
    /// so that collinear segments are no special situation.
    pub(super) fn intersection(&self) -> Option<DVec2> {
        let one_plus_cosine = 1.0 - self.cosine();
        // The distance is half / cos(turn / 2), and cos^2(turn / 2) = (1 + cos turn) / 2.
        (one_plus_cosine * (FARTHEST_CORNER * FARTHEST_CORNER) > 2.0)
            .then(|| (self.before + self.after) / one_plus_cosine)
    }

    /// How much of each segment the inner intersection cuts off: half * tan(turn / 2).
    pub(super) fn cut_off(&self) -> f64 {
        let half = self.half;
        let sine = (self.before.perp_dot(self.after) / (half * half)).abs();
        half * sine / (1.0 - self.cosine())
    }

    /// Method 2: both intersections; parallel lines that run back are bevelled.
    pub(super) fn intersections(&self, out: &mut Strips) {
        match self.intersection() {
            Some(m) => out.push(self.at, m, -m),
            None => self.bevel(out),
        }
    }

    /// Method 3a: both segments' own vertices.
    pub(super) fn bevel(&self, out: &mut Strips) {
        out.push(self.at, self.before, -self.before);
        out.push(self.at, self.after, -self.after);
    }

    /// Method 3b: the inner intersection twice; where the inner boundaries do not meet, method 3a (4.2.3).
    pub(super) fn bevel_inner(&self, out: &mut Strips) {
        let (s1, s2) = self.lengths;
        let Some(m) = self.intersection().filter(|_| self.cut_off() <= s1 && self.cut_off() <= s2) else {
            return self.bevel(out);
        };
        if self.turn > 0.0 {
            out.push(self.at, m, -self.before);
            out.push(self.at, m, -self.after);
        } else {
            out.push(self.at, self.before, -m);
            out.push(self.at, self.after, -m);
        }
    }

    /// Method 1 for both segments: one strip ends, another begins (Fig. 5).
    pub(super) fn isolated(&self, out: &mut Strips) {
        out.push(self.at, self.before, -self.before);
        out.end();
        out.push(self.at, self.after, -self.after);
    }
}
