//! A segment as a graphics processor tests it: in single precision, with vectors that were worked out beforehand.

use super::kind::{Corner, End};
use super::rules::{Link, StrokeRules, corner, left, unit};
use crate::space::Plan;
use glam::{DVec2, Vec2};

/// The point-in-line tests of the thesis (4.3.2, *Linked Lists*, for static lines 4.4.1): its vertices and corner vectors (3.6,
/// Fig. 3.10) are rounded to single precision, and so is every step of a test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SingleSegment {
    vertices: [Vec2; 2],
    half: f32,
    /// Which ends are round.
    is_round: [bool; 2],
    /// Whether it has a rectangle (or a miter's quadrilateral): a dot need not.
    has_quad: bool,
    /// Where the quadrilateral ends: the vertices, or half a width on.
    quad_ends: [Vec2; 2],
    /// From there to its left corners: the miter vector or the normal, as long as half the width; the right ones are opposite.
    miters: [Vec2; 2],
    /// From a vertex to the corners of the gap there, which a bevel closes, or of a miter's half before the vertex; both the same where there is none.
    bevels: [[Vec2; 2]; 2],
}

impl SingleSegment {
    /// The k-th segment of a chain, as [`super::Segment::new`].
    ///
    /// # Panics
    /// When the path has no vertex k.
    pub fn new(path: &[Plan], is_closed: bool, k: usize, rules: &StrokeRules) -> Self {
        let link = Link::new(path, is_closed, k);
        let (from, to, half) = (link.from, link.to, rules.half);
        let along = unit(to - from).0;
        let mut ends = link.ends(rules);
        let mut miters = [left(along) * half; 2];
        let mut bevels = [[DVec2::ZERO; 2]; 2];
        let corners =
            [link.before.map(|before| [before, from, to]), link.after.map(|after| [from, to, after])];
        for (end, three) in corners.into_iter().enumerate() {
            let Some([a, b, c]) = three else { continue };
            let (kind, outer) = corner(a, b, c, rules);
            let [n1, n2] = [b - a, c - b].map(|d| left(unit(d).0));
            match kind {
                Corner::None => {}
                Corner::Round => ends[end] = End::Round,
                // The angle bisector, as long as to where the sides meet (Fig. 3.10c).
                Corner::Miter => {
                    miters[end] = (n1 + n2) * (half / (1.0 + n1.dot(n2)));
                    // Cells refer to the segment behind a join for the whole of it: it holds the other half, too.
                    if end == 0 {
                        bevels[0] = [n1 * half, miters[0]].map(|to| to * outer);
                    }
                }
                Corner::Bevel => bevels[end] = [n1, n2].map(|n| n * (outer * half)),
            }
        }
        let beyond = |end: End| if end == End::Square { half } else { 0.0 };
        Self {
            vertices: [single(from.to_vec()), single(to.to_vec())],
            half: half as f32,
            is_round: ends.map(|end| end == End::Round),
            has_quad: from != to || ends[0] == End::Square,
            quad_ends: [
                single((from + -along * beyond(ends[0])).to_vec()),
                single((to + along * beyond(ends[1])).to_vec()),
            ],
            miters: miters.map(single),
            bevels: bevels.map(|pair| pair.map(single)),
        }
    }

    /// Whether it holds a point, as far as single precision tells.
    pub fn holds(&self, at: [f32; 2]) -> bool {
        let p = Vec2::from_array(at);
        let [from, to] = self.vertices;
        if self.is_round == [true; 2] {
            // "The distance between the [...] position and the segment center line is smaller than half the [...] width".
            return distance(from, to, p) <= self.half;
        }
        let [start, end] = self.quad_ends;
        let [m0, m1] = self.miters;
        // "The segment is divided into two triangles that are spanned by the two miter vectors of the two segment vertices."
        let in_quad = || {
            is_in_triangle(p, [start + m0, start - m0, end + m1])
                || is_in_triangle(p, [end + m1, end - m1, start - m0])
        };
        let at_end = |k: usize| {
            let (vertex, [b0, b1]) = (self.vertices[k], self.bevels[k]);
            (self.is_round[k] && (p - vertex).length() <= self.half)
                || is_in_triangle(p, [vertex, vertex + b0, vertex + b1])
        };
        (self.has_quad && in_quad()) || at_end(0) || at_end(1)
    }
}

fn single(v: DVec2) -> Vec2 {
    Vec2::new(v.x as f32, v.y as f32)
}

/// The distance of a point from a segment.
fn distance(from: Vec2, to: Vec2, p: Vec2) -> f32 {
    let (d, u) = (to - from, p - from);
    let square = d.dot(d);
    let share = if square > 0.0 { d.dot(u) / square } else { 0.0 };
    (u - d * share.clamp(0.0, 1.0)).length()
}

/// Whether a triangle, however it turns, holds a point; one without an area holds none.
fn is_in_triangle(p: Vec2, [a, b, c]: [Vec2; 3]) -> bool {
    let sides = [(a, b), (b, c), (c, a)].map(|(from, to)| (to - from).perp_dot(p - from));
    let has_area = (b - a).perp_dot(c - a) != 0.0;
    has_area && (sides.iter().all(|side| *side >= 0.0) || sides.iter().all(|side| *side <= 0.0))
}
