//! Borders of what is drawn into a tile: directed edges in the tile's texels, whose sum of windings says how often a point is covered.
//!
//! y points south. An edge that runs south adds one to the winding of the points east of it: what is inside lies on the left of an edge on the
//! map.

use crate::space::Texel;
use crate::technique::clipmap::Joints;

/// A directed edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Edge {
    pub(super) from: Texel,
    pub(super) to: Texel,
}

/// So near to a line, in texels, that its side is a matter of rounding.
const ON_LINE: f64 = 1e-7;

/// A triangle of this many slacks' height may be turned over by them.
const THIN: f64 = 3.0;

impl Edge {
    /// Whether a point lies on the edge's inner side.
    pub(super) fn has_inside(&self, at: Texel) -> bool {
        (self.to - self.from).perp_dot(at - self.from) < 0.0
    }

    /// Whether a point lies on its line, but for rounding.
    pub(super) fn is_on(&self, at: Texel) -> bool {
        let d = self.to - self.from;
        d.perp_dot(at - self.from).abs() <= ON_LINE * d.length()
    }

    /// Its lowest and highest y.
    pub(super) fn rows(&self) -> (f64, f64) {
        let (a, b) = (self.from.y, self.to.y);
        if a < b { (a, b) } else { (b, a) }
    }

    /// Between which x it runs where y is between two, if it does there.
    pub(super) fn columns_within(&self, north: f64, south: f64) -> Option<(f64, f64)> {
        let (low, high) = self.rows();
        if high < north || low > south {
            return None;
        }
        let x = |y: f64| {
            let y = y.clamp(low, high);
            let d = self.to - self.from;
            if d.y == 0.0 { self.from.x } else { self.from.x + d.x * ((y - self.from.y) / d.y) }
        };
        let (a, b) = if low == high { (self.from.x, self.to.x) } else { (x(north), x(south)) };
        Some(if a < b { (a, b) } else { (b, a) })
    }

    /// How much of its length lies within a square of texels.
    pub(super) fn length_in(&self, [west, north]: [f64; 2], [east, south]: [f64; 2]) -> f64 {
        let d = self.to - self.from;
        let (mut start, mut end) = (0.0f64, 1.0f64);
        for (from, by, low, high) in [(self.from.x, d.x, west, east), (self.from.y, d.y, north, south)] {
            if by == 0.0 {
                if from < low || from > high {
                    return 0.0;
                }
                continue;
            }
            let (p, q) = ((low - from) / by, (high - from) / by);
            start = crate::math::max(start, crate::math::min(p, q));
            end = crate::math::min(end, crate::math::max(p, q));
        }
        crate::math::max(end - start, 0.0) * d.length()
    }
}

/// Edges of triangles, those between two of them left out.
#[derive(Debug, Default)]
pub(super) struct Outline {
    /// Each edge, and whether it is of a triangle so thin that it may be turned over.
    edges: Vec<(Edge, bool)>,
}

impl Outline {
    /// Adds a triangle, however it turns; `slack`: how far corners may lie elsewhere.
    pub(super) fn triangle(&mut self, [a, b, c]: [Texel; 3], slack: f64) {
        let double = (b - a).perp_dot(c - a);
        if a == b || b == c || c == a {
            return;
        }
        let longest = [(a, b), (b, c), (c, a)]
            .iter()
            .fold(0.0, |most, (p, q)| crate::math::max((*q - *p).length(), most));
        let is_thin = double.abs() <= THIN * slack * longest;
        let [a, b, c] = if double < 0.0 { [a, b, c] } else { [a, c, b] };
        self.edges.extend([(a, b), (b, c), (c, a)].map(|(from, to)| (Edge { from, to }, is_thin)));
    }

    /// Adds a strip of pairs as triangles.
    pub(super) fn strip(&mut self, pairs: &[[Texel; 2]], joints: Joints, slack: f64) {
        for pair in pairs.windows(2) {
            let ([a, b], [c, d]) = (pair[0], pair[1]);
            let knot = if joints == Joints::BevelQuads { knot([a, b, d, c]) } else { None };
            match knot {
                // A polygon that crosses itself, as one is filled.
                Some([first, second]) => {
                    self.triangle(first, slack);
                    self.triangle(second, slack);
                }
                None => {
                    self.triangle([a, b, c], slack);
                    self.triangle([b, d, c], slack);
                }
            }
        }
    }

    /// Adds a ring of few corners that turns counter-clockwise on the map.
    pub(super) fn ring(&mut self, ring: &[Texel]) {
        let ends = ring.iter().cycle().skip(1);
        self.edges.extend(ring.iter().zip(ends).map(|(from, to)| (Edge { from: *from, to: *to }, false)));
    }

    /// Adds an edge of a ring.
    pub(super) fn edge(&mut self, from: Texel, to: Texel) {
        self.edges.push((Edge { from, to }, false));
    }

    /// The edges, without those of two triangles that are drawn as one.
    pub(super) fn edges(mut self) -> Vec<Edge> {
        let bits = |p: Texel| (p.x.to_bits(), p.y.to_bits());
        let key = |edge: &Edge| {
            let (a, b) = (bits(edge.from), bits(edge.to));
            if a < b { (a, b) } else { (b, a) }
        };
        self.edges.sort_by_key(|(edge, _)| key(edge));
        let mut kept = Vec::new();
        for of_one in self.edges.chunk_by(|(a, _), (b, _)| key(a) == key(b)) {
            let is_first = |edge: &Edge| bits(edge.from) == key(edge).0;
            let (forth, back): (Vec<_>, Vec<_>) = of_one.iter().partition(|(edge, _)| is_first(edge));
            let is_sure = of_one.iter().all(|(_, is_thin)| !is_thin);
            let same = if is_sure { forth.len().min(back.len()) } else { 0 };
            let edges = forth.into_iter().skip(same).chain(back.into_iter().skip(same));
            kept.extend(edges.map(|(edge, _)| edge));
        }
        kept
    }
}

/// The two triangles of a polygon of four corners two of whose opposite sides cross.
fn knot(corners: [Texel; 4]) -> Option<[[Texel; 3]; 2]> {
    (0..2).find_map(|k| {
        let [a, b, c, d] = [0, 1, 2, 3].map(|n| corners[(n + k) % 4]);
        let (ab, cd) = (b - a, d - c);
        let across = ab.perp_dot(cd);
        let (t, s) = ((c - a).perp_dot(cd) / across, (c - a).perp_dot(ab) / across);
        let at = a + ab * t;
        let is_within = |v: f64| v > 0.0 && v < 1.0;
        (is_within(t) && is_within(s)).then_some([[b, c, at], [d, a, at]])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f64, y: f64) -> Texel {
        Texel::new(x, y)
    }

    #[test]
    fn what_two_triangles_share_is_no_border() {
        let mut outline = Outline::default();
        outline.strip(
            &[[at(0.0, 0.0), at(0.0, 2.0)], [at(3.0, 0.0), at(3.0, 2.0)], [at(6.0, 1.0), at(6.0, 3.0)]],
            Joints::Combined,
            0.01,
        );
        assert_eq!(outline.edges().len(), 6);
    }

    #[test]
    fn a_folded_quadrilateral_keeps_all_its_borders() {
        let pairs = [[at(0.0, 0.0), at(0.0, 2.0)], [at(3.0, 2.0), at(3.0, 0.0)]];
        let count = |joints| {
            let mut outline = Outline::default();
            outline.strip(&pairs, joints, 0.01);
            outline.edges().len()
        };
        assert_eq!([Joints::Combined, Joints::BevelQuads].map(count), [6, 6]);
    }

    #[test]
    fn a_triangle_that_may_be_turned_over_keeps_its_borders() {
        let mut outline = Outline::default();
        outline.triangle([at(0.0, 0.0), at(3.0, 0.0), at(0.0, 3.0)], 0.01);
        outline.triangle([at(3.0, 0.0), at(0.0, 3.0), at(1.5, 1.51)], 0.01);
        assert_eq!(outline.edges().len(), 6);
    }
}
