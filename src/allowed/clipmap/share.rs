//! Exact shares of texels: how much of a texel is covered so and so often.
//!
//! Within a texel the windings of a point and of another differ by the edges between them. Between heights at which edges end, cross one another or
//! leave the texel, the lengths of a row's pieces are linear in the height, so that the row in the middle has their mean.

use super::edges::Edge;
use crate::math;
use crate::space::Texel;

/// A texel with more edges than this is not looked at.
const MOST_EDGES: usize = 40;

/// The sum of `weight` of the winding over a texel with its corner at (column, row), as a share of its area; `reference` is a point of it with its
/// winding. `None`: it has too many edges.
pub(super) fn share(
    edges: &[Edge],
    [column, row]: [f64; 2],
    (reference, winding): (Texel, i32),
    weight: &dyn Fn(i32) -> f64,
) -> Option<f64> {
    if edges.len() > MOST_EDGES {
        return None;
    }
    let heights = heights(edges, [column, row]);
    let mut sum = 0.0;
    let mut cuts: Vec<f64> = Vec::new();
    for pair in heights.windows(2) {
        let (height, y) = (pair[1] - pair[0], 0.5 * (pair[0] + pair[1]));
        if height <= 0.0 {
            continue;
        }
        cuts.clear();
        cuts.extend([column, column + 1.0]);
        let at = edges.iter().filter(|edge| {
            let (low, high) = edge.rows();
            low <= y && y <= high && low < high
        });
        let crossing = |edge: &Edge| {
            edge.from.x + (edge.to.x - edge.from.x) * ((y - edge.from.y) / (edge.to.y - edge.from.y))
        };
        cuts.extend(at.map(crossing).filter(|x| *x > column && *x < column + 1.0));
        cuts.sort_unstable_by(f64::total_cmp);
        for piece in cuts.windows(2).filter(|piece| piece[1] > piece[0]) {
            let middle = Texel::new(0.5 * (piece[0] + piece[1]), y);
            let winding = winding + difference(edges, reference, middle);
            sum += weight(winding) * (piece[1] - piece[0]) * height;
        }
    }
    Some(sum)
}

/// The heights between which rows of a texel have the same edges in the same order.
fn heights(edges: &[Edge], [column, row]: [f64; 2]) -> Vec<f64> {
    let mut heights = vec![row, row + 1.0];
    for (k, edge) in edges.iter().enumerate() {
        heights.extend([edge.from.y, edge.to.y]);
        let d = edge.to - edge.from;
        for x in [column, column + 1.0] {
            heights.push(edge.from.y + d.y * ((x - edge.from.x) / d.x));
        }
        for other in &edges[k + 1..] {
            let e = other.to - other.from;
            let t = (other.from - edge.from).perp_dot(e) / d.perp_dot(e);
            heights.push(edge.from.y + d.y * t);
        }
    }
    heights.retain(|y| *y >= row && *y <= row + 1.0);
    heights.sort_unstable_by(f64::total_cmp);
    heights
}

/// By how much more a point is wound around than another, by the edges between them.
fn difference(edges: &[Edge], from: Texel, to: Texel) -> i32 {
    let way = to - from;
    let side = |p: Texel| way.perp_dot(p - from) > 0.0;
    let mut sum = 0;
    for edge in edges {
        let (starts, ends) = (side(edge.from), side(edge.to));
        if starts != ends && edge.has_inside(from) != edge.has_inside(to) {
            sum += if edge.has_inside(to) { 1 } else { -1 };
        }
    }
    sum
}

/// The area that a convex ring shares with a texel with its corner at (column, row).
pub(super) fn convex_area(ring: &[Texel; 4], [column, row]: [f64; 2]) -> f64 {
    let mut shape: Vec<Texel> = ring.to_vec();
    let sides: [(f64, f64, f64); 4] =
        [(1.0, 0.0, column), (-1.0, 0.0, -column - 1.0), (0.0, 1.0, row), (0.0, -1.0, -row - 1.0)];
    for (a, b, c) in sides {
        let over = |p: Texel| a * p.x + b * p.y - c;
        let mut cut = Vec::with_capacity(shape.len() + 1);
        for (k, from) in shape.iter().enumerate() {
            let to = shape[(k + 1) % shape.len()];
            let (p, q) = (over(*from), over(to));
            if p >= 0.0 {
                cut.push(*from);
            }
            if (p > 0.0 && q < 0.0) || (p < 0.0 && q > 0.0) {
                cut.push(*from + (to - *from) * (p / (p - q)));
            }
        }
        shape = cut;
    }
    let Some(first) = shape.first().copied() else { return 0.0 };
    let double: f64 = shape.windows(2).map(|pair| (pair[0] - first).perp_dot(pair[1] - first)).sum();
    math::min(0.5 * double.abs(), 1.0)
}

#[cfg(test)]
mod tests {
    use super::super::edges::Outline;
    use super::*;

    fn ring(points: &[[f64; 2]]) -> Vec<Edge> {
        let mut outline = Outline::default();
        outline.ring(&points.iter().map(|p| Texel::new(p[0], p[1])).collect::<Vec<_>>());
        outline.edges()
    }

    #[test]
    fn half_of_a_square_is_half() {
        let edges = ring(&[[0.0, 0.0], [0.0, 1.0], [1.0, 1.0]]);
        let once = |k: i32| f64::from(k.clamp(0, 1));
        let found = share(&edges, [0.0, 0.0], (Texel::new(0.2, 0.7), 1), &once).unwrap();
        assert!((found - 0.5).abs() < 1e-12, "{found}");
        let square = [[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [0.5, 0.0]].map(|[x, y]| Texel::new(x, y));
        assert!((convex_area(&square, [0.0, 0.0]) - 0.75).abs() < 1e-12);
    }

    #[test]
    fn overlaps_count_as_often_as_they_are_asked_to() {
        let mut edges = ring(&[[-1.0, -1.0], [-1.0, 0.6], [2.0, 0.6], [2.0, -1.0]]);
        edges.extend(ring(&[[-1.0, 0.3], [-1.0, 2.0], [2.0, 2.0], [2.0, 0.3]]));
        let of = |weight: &dyn Fn(i32) -> f64| {
            share(&edges, [0.0, 0.0], (Texel::new(0.4, 0.1), 1), weight).unwrap()
        };
        assert!((of(&|k| f64::from(k.min(1))) - 1.0).abs() < 1e-12);
        assert!((of(&f64::from) - 1.3).abs() < 1e-12);
        assert!((of(&|k| f64::from(k % 2)) - 0.7).abs() < 1e-12);
    }
}
