//! The tests of a segment's parts in exact arithmetic, for points so near to a border that doubles do not tell.
//!
//! All quantities are polynomials of the stored coordinates but for lengths, which are square roots of such: a comparison with one root is
//! squared, the bevel's chord with two roots is squared twice.

use super::kind::{Corner, End};
use crate::predicate::{Displacement, Expansion};
use crate::space::Plan;

/// A segment's parts as they are stored.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Parts {
    /// The vertex before it; `from` where there is no corner.
    pub(super) before: Plan,
    pub(super) from: Plan,
    /// `from` itself for a dot.
    pub(super) to: Plan,
    /// Half the width.
    pub(super) half: f64,
    pub(super) ends: [End; 2],
    /// What is at its start.
    pub(super) corner: Corner,
    /// 1 where the corner's gap is on the left, -1 on the right.
    pub(super) outer: f64,
}

impl Parts {
    /// Whether a point is in one of them.
    #[cold]
    pub(super) fn hold(&self, at: Plan) -> bool {
        let to_start = Displacement::new(at, self.from);
        let half_squared = Expansion::exactly(self.half).scaled(self.half);
        let disc = |end: End, from: &Displacement| end == End::Round && from.is_within(&half_squared);
        disc(self.ends[0], &to_start)
            || disc(self.ends[1], &Displacement::new(at, self.to))
            || self.rectangle_holds(at, &to_start)
            || self.wedge_holds(&to_start)
    }

    fn rectangle_holds(&self, at: Plan, from_start: &Displacement) -> bool {
        let is_square = |end: End| end == End::Square;
        if self.from == self.to && !is_square(self.ends[0]) {
            return false;
        }
        // A dot's square lies along the axes.
        let along =
            if self.from == self.to { Displacement::east() } else { Displacement::new(self.to, self.from) };
        let length = along.dot(&along);
        let is_near = |distance: &Expansion| is_at_most(distance, self.half, &length);
        let across = along.cross(from_start);
        let back = Expansion::exactly(0.0).minus(&along.dot(from_start));
        let on = along.dot(&Displacement::new(at, self.to));
        let ends = |end: End, beyond: &Expansion| match end {
            End::Square => is_near(beyond),
            _ => beyond.sign() <= 0.0,
        };
        is_near(&across)
            && is_near(&Expansion::exactly(0.0).minus(&across))
            && ends(self.ends[0], &back)
            && ends(self.ends[1], &on)
    }

    fn wedge_holds(&self, u: &Displacement) -> bool {
        if !matches!(self.corner, Corner::Miter | Corner::Bevel) {
            return false;
        }
        let (into, along) =
            (Displacement::new(self.from, self.before), Displacement::new(self.to, self.from));
        if into.dot(u).sign() < 0.0 || along.dot(u).sign() > 0.0 {
            return false;
        }
        let outside = |d: &Displacement| d.cross(u).scaled(self.outer);
        let (a, b) = (outside(&into), outside(&along));
        let (e, d) = (into.dot(&into), along.dot(&along));
        match self.corner {
            Corner::Miter => is_at_most(&a, self.half, &e) && is_at_most(&b, self.half, &d),
            _ => is_inside_chord([&a, &b], [&e, &d], &into.dot(&along), self.half),
        }
    }
}

/// Whether a miter reaches at most `limit` half widths: whether 2 |e| |d| <= limit^2 (|e| |d| + e . d).
#[cold]
pub(super) fn is_within_limit(before: Plan, at: Plan, after: Plan, limit: f64) -> bool {
    let (into, along) = (Displacement::new(at, before), Displacement::new(after, at));
    let square = Expansion::exactly(limit).scaled(limit);
    let excess = square.minus(&Expansion::exactly(2.0));
    let product = into.dot(&along).times(&square);
    sign_with_root(&product, &excess, &into.dot(&into).times(&along.dot(&along))) >= 0.0
}

/// Twice the area of three points' triangle, positive where they turn left, good to a rounding however small.
#[cold]
pub(super) fn area_doubled(a: Plan, b: Plan, c: Plan) -> f64 {
    Displacement::new(b, a).cross(&Displacement::new(c, b)).rounded()
}

/// Whether a point is inside of the chord between the corners of two rectangles at h n1, h n2 from their common vertex, n1 and n2 the
/// outer unit normals of e and d: whether (n1 + n2) . u <= h (1 + cos turn). With a = |e| n1 . u, b = |d| n2 . u this is
/// a |d| + b |e| - h |e| |d| - h e . d <= 0.
fn is_inside_chord([a, b]: [&Expansion; 2], [e, d]: [&Expansion; 2], product: &Expansion, half: f64) -> bool {
    // |d| (a - h |e|) + (b |e| - h e . d): each bracket with one root, that of e.
    let hf = product.scaled(half);
    let negative = |v: &Expansion| v.scaled(-1.0);
    let first = sign_with_root(a, &Expansion::exactly(-half), e);
    let second = sign_with_root(&negative(&hf), b, e);
    if first == second || second == 0.0 {
        return first <= 0.0;
    }
    if first == 0.0 {
        return second <= 0.0;
    }
    // Of different signs: the larger square's tells.
    let he = e.scaled(half).scaled(half);
    let squares = d.times(&a.times(a).plus(&he)).minus(&e.times(&b.times(b))).minus(&hf.times(&hf));
    let roots = b.times(&hf).minus(&d.times(a).scaled(half)).scaled(2.0);
    first * sign_with_root(&squares, &roots, e) <= 0.0
}

/// Whether `value <= half * sqrt(square)`.
fn is_at_most(value: &Expansion, half: f64, square: &Expansion) -> bool {
    value.sign() <= 0.0 || value.times(value).minus(&square.scaled(half).scaled(half)).sign() <= 0.0
}

/// The sign of `plain + factor * sqrt(square)`.
fn sign_with_root(plain: &Expansion, factor: &Expansion, square: &Expansion) -> f64 {
    let (p, f) = (plain.sign(), factor.sign() * square.sign());
    if p == f || f == 0.0 {
        return p;
    }
    if p == 0.0 {
        return f;
    }
    p * plain.times(plain).minus(&factor.times(factor).times(square)).sign()
}
