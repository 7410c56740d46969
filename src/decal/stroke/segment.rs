//! A segment of a stroke made ready: which points it holds.

use super::exact::Parts;
use super::kind::{Corner, End};
use super::rules::{Link, StrokeRules, corner, left, unit};
use crate::math::max;
use crate::predicate::orient2d;
use crate::space::Plan;
use glam::DVec2;

/// How far plain doubles may be off, in sizes of what goes into them. A component of a unit vector is good to 6 roundings (of half an
/// epsilon), the difference of two coordinates to 1, the product and the sum of a pair to 2: 9 for a distance from a line. The bevel's
/// normal is the sum of two units (14), its offset half (1 + cos) is good to 18: 40 together. So 64 are enough.
pub(super) const TOLERANCE: f64 = 32.0 * f64::EPSILON;

/// By how much squares of distances may be off, of themselves: each is good to 5 roundings.
const SQUARE_TOLERANCE: f64 = 8.0 * f64::EPSILON;

/// The square of the radius of no disc.
const NO_DISC: f64 = -1.0;

/// The points u, measured from a segment's start, with `normal . u <= offset`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct HalfPlane {
    pub(super) normal: DVec2,
    pub(super) offset: f64,
}

impl HalfPlane {
    #[inline(always)]
    fn beyond(&self, u: DVec2) -> f64 {
        self.normal.dot(u) - self.offset
    }
}

/// A segment of a stroke, ready for many points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    pub(super) parts: Parts,
    /// Its direction, and its length in metres.
    pub(super) unit: DVec2,
    pub(super) length: f64,
    /// Along it, where its rectangle starts and ends, metres from its start; no number is between them where it has none.
    pub(super) span: [f64; 2],
    /// The squared radii of the discs around its ends, [`NO_DISC`] for none.
    discs: [f64; 2],
    /// The direction of the segment before it.
    pub(super) into: DVec2,
    /// Of the corner at its start the outer borders: both sides of a miter, twice the chord of a bevel. `into` and `unit` bound it, too.
    pub(super) outer: [HalfPlane; 2],
}

/// What plain doubles say of a point.
#[derive(Clone, Copy)]
struct Told {
    is_inside: bool,
    is_outside: bool,
}

impl Segment {
    /// The k-th segment of a chain, whose vertices are as [`crate::draw_list::DrawList::path_of`] has them: a closed one ends with its
    /// first vertex again, none is the same as the next; a chain of one vertex is a dot.
    ///
    /// # Panics
    /// When the path has no vertex k.
    #[inline]
    pub fn new(path: &[Plan], is_closed: bool, k: usize, rules: &StrokeRules) -> Self {
        let link = Link::new(path, is_closed, k);
        let (from, to, half) = (link.from, link.to, rules.half);
        let ends = link.ends(rules);
        let (unit_along, length) = unit(to - from);
        let mut parts = Parts { before: from, from, to, half, ends, corner: Corner::None, outer: 0.0 };
        let mut into = unit_along;
        let nothing = HalfPlane { normal: DVec2::ZERO, offset: 0.0 };
        let mut outer = [nothing; 2];
        if let Some(before) = link.before {
            parts.before = before;
            (parts.corner, parts.outer) = corner(before, from, to, rules);
            if matches!(parts.corner, Corner::Miter | Corner::Bevel) {
                into = unit(from - before).0;
                let normals = [into, unit_along].map(|d| left(d) * parts.outer);
                outer = match parts.corner {
                    Corner::Miter => normals.map(|normal| HalfPlane { normal, offset: half }),
                    _ => {
                        [HalfPlane {
                            normal: normals[0] + normals[1],
                            offset: half * (1.0 + into.dot(unit_along)),
                        }; 2]
                    }
                };
            }
        }
        // A sharp corner that is round instead of a miter.
        if parts.corner == Corner::Round {
            parts.ends[0] = End::Round;
        }
        let disc = |end: End| if end == End::Round { half * half } else { NO_DISC };
        let beyond = |end: End| if end == End::Square { half } else { 0.0 };
        // A dot has a rectangle only where its cap is one.
        let span = match from == to && parts.ends[0] != End::Square {
            true => [f64::INFINITY, f64::NEG_INFINITY],
            false => [-beyond(parts.ends[0]), length + beyond(parts.ends[1])],
        };
        Self { discs: parts.ends.map(disc), parts, unit: unit_along, length, span, into, outer }
    }

    /// Whether it holds a point, exactly; its border is its own.
    #[inline]
    pub fn holds(&self, at: Plan) -> bool {
        let u = at - self.parts.from;
        let (along, across) = (self.unit.dot(u), self.unit.perp_dot(u).abs());
        let tolerance = self.tolerance(u);
        let beside = across - self.parts.half;
        // Nothing of a segment is farther from its line than half the width.
        if beside > tolerance {
            return false;
        }
        let beyond = max(self.span[0] - along, along - self.span[1]);
        if max(beside, beyond) < -tolerance {
            return true;
        }
        let told = if self.has_wedge() { self.told::<true>(at) } else { self.told::<false>(at) };
        told.is_inside || (!told.is_outside && self.parts.hold(at))
    }

    /// Which of up to 64 points it holds, as [`Self::holds`]: the k-th point, its coordinates `x[k]` and `y[k]`, is the k-th lowest bit.
    ///
    /// # Panics
    /// When there are more than 64, or not as many of x as of y.
    pub fn mask_of(&self, x: &[f64], y: &[f64]) -> u64 {
        assert!(x.len() <= 64 && x.len() == y.len(), "64 points have a bit");
        let (inside, unsure) =
            if self.has_wedge() { self.masks::<true>(x, y) } else { self.masks::<false>(x, y) };
        let (mut mask, mut open) = (inside, unsure);
        while open != 0 {
            let k = open.trailing_zeros();
            if self.parts.hold(Plan::new(x[k as usize], y[k as usize])) {
                mask |= 1 << k;
            }
            open &= open - 1;
        }
        mask
    }

    /// Which points surely are in it, and of which that is not known.
    #[inline(always)]
    fn masks<const HAS_WEDGE: bool>(&self, x: &[f64], y: &[f64]) -> (u64, u64) {
        let (mut inside, mut unsure) = ([0u8; 64], [0u8; 64]);
        for (((x, y), inside), unsure) in x.iter().zip(y).zip(&mut inside).zip(&mut unsure) {
            let told = self.told::<HAS_WEDGE>(Plan::new(*x, *y));
            *inside = u8::from(told.is_inside);
            *unsure = u8::from(!(told.is_inside | told.is_outside));
        }
        (bits(&inside), bits(&unsure))
    }

    #[inline(always)]
    fn has_wedge(&self) -> bool {
        matches!(self.parts.corner, Corner::Miter | Corner::Bevel)
    }

    /// How far distances from its lines may be off for a point that is `u` from its start.
    #[inline(always)]
    fn tolerance(&self, u: DVec2) -> f64 {
        TOLERANCE * ((u.x.abs() + u.y.abs()) + (self.length + self.parts.half))
    }

    /// What plain doubles say of a point; neither where it is too near to a border. No branches: the compiler takes several at once.
    #[inline(always)]
    fn told<const HAS_WEDGE: bool>(&self, at: Plan) -> Told {
        let (u, w) = (at - self.parts.from, at - self.parts.to);
        let tolerance = self.tolerance(u);
        let along = self.unit.dot(u);
        let beside = self.unit.perp_dot(u).abs() - self.parts.half;
        let rectangle = max(beside, max(self.span[0] - along, along - self.span[1]));
        let mut is_inside = rectangle < -tolerance;
        let mut is_outside = rectangle > tolerance;
        for (square, radius) in [u, w].map(|v| v.x * v.x + v.y * v.y).into_iter().zip(self.discs) {
            is_inside |= square < radius * (1.0 - SQUARE_TOLERANCE);
            is_outside &= square > radius * (1.0 + SQUARE_TOLERANCE);
        }
        if HAS_WEDGE {
            let sides = max(self.outer[0].beyond(u), self.outer[1].beyond(u));
            let wedge = max(max(along, -self.into.dot(u)), sides);
            is_inside |= wedge < -tolerance;
            is_outside &= wedge > tolerance;
        }
        Told { is_inside, is_outside }
    }

    /// Whether a point is left (positive) of the segment's line, right of it (negative) or on it, exactly: in which part of an outline it
    /// is by the "left-right-test" (4.4.1, Fig. 4.8).
    #[inline]
    pub fn side(&self, at: Plan) -> f64 {
        orient2d(self.parts.from, self.parts.to, at)
    }

    /// The direction from the nearest point of its centre line to a point; across the line where that is on it.
    pub fn normal_to(&self, at: Plan) -> DVec2 {
        let along = self.unit.dot(at - self.parts.from).clamp(0.0, self.length);
        let away = at - (self.parts.from + self.unit * along);
        let (unit_away, length) = unit(away);
        if length > 0.0 { unit_away } else { left(self.unit) }
    }

    /// Its width, metres.
    pub fn width(&self) -> f64 {
        2.0 * self.parts.half
    }

    /// How far a point is inside of its border (negative: outside), metres, in plain doubles. Where another segment goes on the
    /// rectangle has no border; a corner's outside is measured from the lines of its sides.
    pub fn depth_inside(&self, at: Plan) -> f64 {
        let (u, w) = (at - self.parts.from, at - self.parts.to);
        let along = self.unit.dot(u);
        let beside = self.unit.perp_dot(u).abs() - self.parts.half;
        let mut depth = f64::NEG_INFINITY;
        if self.span[0] <= self.span[1] {
            let past = [self.span[0] - along, along - self.span[1]];
            let is_in_span = past[0] <= 0.0 && past[1] <= 0.0;
            let border = |end: usize| match self.parts.ends[end] {
                End::Joined | End::Round if is_in_span => f64::NEG_INFINITY,
                _ => past[end],
            };
            depth = -outside_of_corner(beside, max(border(0), border(1)));
        }
        for (v, end) in [u, w].into_iter().zip(self.parts.ends) {
            if end == End::Round {
                depth = max(depth, self.parts.half - v.length());
            }
        }
        if self.has_wedge() {
            let side = |side: HalfPlane| match side.normal.length() {
                length if length > 0.0 => side.beyond(u) / length,
                _ => f64::INFINITY,
            };
            let sides = self.outer.map(side);
            let cone = max(along, -self.into.dot(u));
            let sides = max(sides[0], sides[1]);
            depth = max(depth, -if cone <= 0.0 { sides } else { max(cone, sides) });
        }
        depth
    }
}

/// How far outside of a right angle is what is so far outside of each of its sides; the farther one where it is inside.
fn outside_of_corner(a: f64, b: f64) -> f64 {
    if a > 0.0 && b > 0.0 { (a * a + b * b).sqrt() } else { max(a, b) }
}

/// The lowest bits of 64 bytes.
#[inline(always)]
fn bits(bytes: &[u8; 64]) -> u64 {
    let (eights, _) = bytes.as_chunks::<8>();
    // The product's top byte has a bit of each of the eight.
    let byte = |eight: &[u8; 8]| u64::from_le_bytes(*eight).wrapping_mul(0x0102_0408_1020_4080) >> 56;
    eights.iter().rev().fold(0, |all, eight| all << 8 | byte(eight))
}
