//! Is a sample in an area? (She 3.5, Fig. 9, Codes A and B; the winding number as an option.)

use super::edge_index::EdgeIndex;
use super::expansion::{AreaId, Edge};
use crate::space::Plan;
use crate::technique::inverse_projection::PointInPolygon;
use glam::DVec2;

/// An edge that meets the pixel at hand, with what Codes A and B ask of it made once for all samples.
#[derive(Debug, Clone, Copy)]
pub struct NearEdge {
    a: Plan,
    b: Plan,
    along: DVec2,
    outward: DVec2,
    length_squared: f64,
}

impl NearEdge {
    /// An edge made ready.
    #[inline]
    pub fn new(edge: &Edge) -> Self {
        let along = edge.b - edge.a;
        let right = DVec2::new(along.y, -along.x);
        let outward = if edge.outside_is_left { -right } else { right };
        Self { a: edge.a, b: edge.b, along, outward, length_squared: along.length_squared() }
    }

    /// Code A: +1 where the sum of the vectors from the sample to the edge's ends points along the edge's outward normal
    /// (cos of their angle at least 0), else -1.
    #[inline(always)]
    fn code_a(&self, sample: Plan) -> i32 {
        let towards = (self.a - sample) + (self.b - sample);
        if towards.dot(self.outward) >= 0.0 { 1 } else { -1 }
    }

    /// Code B: an edge counts only when the pedal (the foot of the perpendicular from the sample) lies on it.
    #[inline(always)]
    fn is_correlated(&self, sample: Plan) -> bool {
        let foot = (sample - self.a).dot(self.along);
        (foot >= 0.0) & (foot <= self.length_squared)
    }
}

/// She's FLAG for a sample and the edges of one area that meet the pixel: positive inside, else outside.
#[inline]
pub fn flag(sample: Plan, edges: &[NearEdge]) -> i32 {
    edges.iter().map(|edge| if edge.is_correlated(sample) { edge.code_a(sample) } else { 0 }).sum()
}

/// Judges samples of one pixel by the rule of the scene.
#[derive(Debug, Clone, Copy)]
pub struct Judge<'a> {
    /// Areas and edges.
    pub index: &'a EdgeIndex<'a>,
    /// The rule.
    pub rule: PointInPolygon,
}

impl Judge<'_> {
    /// Whether a sample lies in an area, of whose edges `near` meet the pixel.
    #[inline]
    pub fn contains(&self, area: AreaId, near: &[NearEdge], sample: Plan) -> bool {
        match self.rule {
            PointInPolygon::EdgeNormals => flag(sample, near) > 0,
            PointInPolygon::Winding => self.index.rule_of(area).contains(self.index.winding_of(area, sample)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edge(a: (f64, f64), b: (f64, f64)) -> NearEdge {
        NearEdge::new(&Edge {
            a: Plan::new(a.0, a.1),
            b: Plan::new(b.0, b.1),
            area: AreaId::stroke_of(0),
            outside_is_left: false,
        })
    }

    #[test]
    fn a_sample_inside_a_straight_line_has_both_its_edges_for_it() {
        let line = [edge((0.0, -1.0), (9.0, -1.0)), edge((9.0, 1.0), (0.0, 1.0))];
        assert_eq!(flag(Plan::new(4.0, 0.5), &line), 2);
        assert_eq!(flag(Plan::new(4.0, 1.5), &line), 0, "one for, one against: outside");
    }

    #[test]
    fn an_edge_whose_pedal_lies_beyond_its_end_is_not_asked() {
        // Fig. 10, right: the edge ends before the sample; asked, it would call the sample inside.
        let stub = [edge((0.0, -1.0), (1.0, -1.0))];
        assert_eq!(flag(Plan::new(3.0, 0.0), &stub), 0);
        assert_eq!(stub[0].code_a(Plan::new(3.0, 0.0)), 1, "Code A alone");
    }
}
