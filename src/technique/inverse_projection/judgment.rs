//! Is a sample in an area? (She 3.5, Fig. 9, Codes A and B.)

use super::expansion::{AreaId, Edge};
use crate::space::Plan;
use glam::DVec2;
use std::ops::Range;

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
    fn code_a(&self, sample: Plan) -> i64 {
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

/// An area that is partly in a pixel.
#[derive(Debug, Clone)]
pub struct Part {
    /// The area.
    pub area: AreaId,
    /// Its edges that meet the pixel, as a range of the pixel's.
    pub near: Range<usize>,
}

/// She's FLAG of each sample for the edges of one area that meet the pixel: positive inside, else outside.
#[inline(always)]
pub fn flags<const N: usize>(samples: &[Plan; N], edges: &[NearEdge]) -> [i64; N] {
    let mut flags = [0; N];
    for edge in edges {
        for (flag, sample) in flags.iter_mut().zip(samples) {
            *flag += if edge.is_correlated(*sample) { edge.code_a(*sample) } else { 0 };
        }
    }
    flags
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
        assert_eq!(flags(&[Plan::new(4.0, 0.5)], &line), [2]);
        assert_eq!(flags(&[Plan::new(4.0, 1.5)], &line), [0], "one for, one against: outside");
    }

    #[test]
    fn an_edge_whose_pedal_lies_beyond_its_end_is_not_asked() {
        // Fig. 10, right: the edge ends before the sample; asked, it would call the sample inside.
        let stub = [edge((0.0, -1.0), (1.0, -1.0))];
        assert_eq!(flags(&[Plan::new(3.0, 0.0)], &stub), [0]);
        assert_eq!(stub[0].code_a(Plan::new(3.0, 0.0)), 1, "Code A alone");
    }
}
