//! What two triangles share: one of a fill, whose corners are moved points, and one of the terrain's, whose corners are posts.
//!
//! Which corners the shared polygon has is decided by exact signs alone: so pieces of neighbours share the corners that lie on their common side, whichever
//! of the two triangulations it is of, and cover all of the fill once.

use super::super::dag::{Crossing, GridPoint, edge_of, is_left_of_edge, is_left_of_way};
use crate::terrain::lod::RightTriangle;

/// A corner of a piece.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Corner {
    /// A corner of the fill's triangle.
    Vertex(GridPoint),
    /// A corner of the terrain's, 0 being the apex.
    Post(usize),
    /// A crossing of two sides.
    Crossing(Crossing),
}

/// No two triangles share more corners.
pub const MOST_CORNERS: usize = 6;

/// A side of the fill's triangle, as it enters and leaves the other one: by which of that one's edges.
#[derive(Debug, Clone, Copy, Default)]
struct Passage {
    entrance: Option<usize>,
    exit: Option<usize>,
}

/// The corners of what the triangle of three moved points and another triangle share, both counter-clockwise; fewer than three: nothing.
pub fn shared(fill: [GridPoint; 3], triangle: &RightTriangle) -> Vec<Corner> {
    let edges = [0, 1, 2].map(|edge| edge_of(triangle, edge));
    let side = |k: usize| [fill[k], fill[(k + 1) % 3]];
    // Which edges of the triangle each vertex of the fill lies left of; which sides of the fill each post does.
    let inner = fill.map(|vertex| edges.map(|edge| is_left_of_edge(edge, vertex)));
    let posts = triangle.corners().map(|post| {
        [0, 1, 2].map(|k| {
            let [from, to] = side(k);
            is_left_of_way(from, to, post)
        })
    });
    let all = |is: [bool; 3]| is == [true; 3];
    if posts.iter().all(|is| all(*is)) {
        return (0..3).map(Corner::Post).collect();
    }
    let passages = [0, 1, 2].map(|k| {
        let (from, to) = (inner[k], inner[(k + 1) % 3]);
        let crossed =
            (0..3).filter(|&m| from[m] != to[m] && posts[m][k] != posts[(m + 1) % 3][k]).collect::<Vec<_>>();
        let find = |is_entrance: bool| crossed.iter().copied().find(|&m| to[m] == is_entrance);
        Passage { entrance: find(true), exit: find(false) }
    });
    let mut corners = Vec::with_capacity(MOST_CORNERS);
    for k in 0..3 {
        if all(inner[k]) {
            corners.push(Corner::Vertex(fill[k]));
        }
        let [from, to] = side(k);
        let crossing = |m: usize| Corner::Crossing(Crossing::new(from, to, edges[m]));
        corners.extend(passages[k].entrance.map(crossing));
        let Some(exit) = passages[k].exit else { continue };
        corners.push(crossing(exit));
        // On along the triangle's edges, to where the fill's next side enters.
        let next = (1..=3).find_map(|step| passages[(k + step) % 3].entrance).unwrap_or(exit);
        corners.extend((0..(next + 3 - exit) % 3).map(|step| Corner::Post((exit + 1 + step) % 3)));
    }
    corners
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const TRIANGLE: RightTriangle = RightTriangle { apex: [0, 0], left: [4, 0], right: [0, 4] };

    fn place(corner: &Corner) -> GridPoint {
        match corner {
            Corner::Vertex(at) => *at,
            Corner::Post(k) => TRIANGLE.corners()[*k].map(f64::from),
            Corner::Crossing(crossing) => crossing.at,
        }
    }

    fn area(polygon: &[GridPoint]) -> f64 {
        let next = polygon.iter().cycle().skip(1);
        polygon.iter().zip(next).map(|(a, b)| a[0] * b[1] - b[0] * a[1]).sum::<f64>() / 2.0
    }

    /// The area of what the fill's triangle has in the other one, cut edge by edge.
    fn cut_area(fill: [GridPoint; 3]) -> f64 {
        let lines: [&dyn Fn(GridPoint) -> f64; 3] = [&|p| p[0], &|p| p[1], &|p| 4.0 - p[0] - p[1]];
        let mut polygon = fill.to_vec();
        for inside in lines {
            let mut out = Vec::new();
            for (k, p) in polygon.iter().enumerate() {
                let q = polygon[(k + 1) % polygon.len()];
                let (at_p, at_q) = (inside(*p), inside(q));
                if at_p >= 0.0 {
                    out.push(*p);
                }
                if (at_p >= 0.0) != (at_q >= 0.0) {
                    let share = at_p / (at_p - at_q);
                    out.push([0, 1].map(|k| p[k] + (q[k] - p[k]) * share));
                }
            }
            polygon = out;
        }
        if polygon.is_empty() { 0.0 } else { area(&polygon) }
    }

    fn coordinate() -> impl Strategy<Value = f64> {
        prop_oneof![
            (-4..9i32).prop_map(f64::from),
            -4.0..9.0f64,
            (-8..18i32).prop_map(|k| f64::from(k) / 2.0)
        ]
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]
        #[test]
        fn a_piece_has_the_area_of_the_cut_and_turns_left_wherever_corners_lie(
            points in prop::array::uniform3(prop::array::uniform2(coordinate())),
        ) {
            let twice = area(&points);
            prop_assume!(twice.abs() > 1e-9);
            let fill = if twice > 0.0 { points } else { [points[0], points[2], points[1]] };
            let corners = shared(fill, &TRIANGLE);
            prop_assert!(corners.is_empty() || (3..=MOST_CORNERS).contains(&corners.len()), "{corners:?}");
            let polygon: Vec<GridPoint> = corners.iter().map(place).collect();
            let found = if polygon.is_empty() { 0.0 } else { area(&polygon) };
            prop_assert!((found - cut_area(fill)).abs() < 1e-9, "{found} {} {corners:?}", cut_area(fill));
            for k in 0..polygon.len() {
                let [a, b, c] = [0, 1, 2].map(|step| polygon[(k + step) % polygon.len()]);
                prop_assert!(area(&[a, b, c]) > -1e-9, "{corners:?}");
            }
        }
    }

    #[test]
    fn a_corner_in_a_post_and_a_side_along_an_edge_are_moved_off_them() {
        // Moved east and a little north: what touches from the west has a piece without area, or none.
        let beside = shared([[0.0, 0.0], [0.0, 4.0], [-4.0, 0.0]], &TRIANGLE);
        assert_eq!(beside.iter().map(place).map(|[x, _]| x.abs()).sum::<f64>(), 0.0);
        let same = shared([[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]], &TRIANGLE);
        let polygon: Vec<GridPoint> = same.iter().map(place).collect();
        assert_eq!(area(&polygon), 8.0);
    }
}
