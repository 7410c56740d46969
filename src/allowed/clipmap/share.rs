//! Exact shares of texels: how much of a texel is covered so and so often.
//!
//! Within a texel the windings of a point and of another differ by the edges between them. Between heights at which edges end, cross one another or
//! leave the texel, the lengths of a row's pieces are linear in the height, so that the row in the middle has their mean.

use super::edges::Edge;
use crate::math;
use crate::space::Texel;

/// In a texel with more edges than this, rows at even distances stand for the exact ones.
const MOST_EDGES: usize = 24;

/// So many of them.
const ROWS: usize = 64;

/// The sum of `weight` of the winding over a texel with its corner at (column, row), as a share of its area, and how far it may be off; `reference` is a
/// point of it with its winding.
pub(super) fn share(
    edges: &[Edge],
    [column, row]: [f64; 2],
    reference: (Texel, i32),
    weight: &dyn Fn(i32) -> f64,
) -> [f64; 2] {
    let (heights, off) = match edges.len() <= MOST_EDGES {
        true => (heights(edges, [column, row]), 0.0),
        false => {
            // Between two rows an edge moves by its slope.
            let across = edges.iter().map(|edge| edge.columns_within(row, row + 1.0));
            let across: f64 = across.flatten().map(|(west, east)| math::min(east - west, 1.0)).sum();
            let at = |k: usize| row + k as f64 / ROWS as f64;
            ((0..=ROWS).map(at).collect(), (across + 1.0) / ROWS as f64)
        }
    };
    let mut cuts = Vec::new();
    let mut sum = 0.0;
    for pair in heights.windows(2).filter(|pair| pair[0] < pair[1]) {
        let y = 0.5 * (pair[0] + pair[1]);
        cuts.clear();
        for edge in edges {
            let (low, high) = edge.rows();
            if low <= y && y < high {
                let d = edge.to - edge.from;
                let x = edge.from.x + d.x * ((y - edge.from.y) / d.y);
                if x > column && x < column + 1.0 {
                    cuts.push((x, if d.y > 0.0 { 1 } else { -1 }));
                }
            }
        }
        cuts.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let first = cuts.first().map_or(column + 1.0, |cut| cut.0);
        let start = Texel::new(0.5 * (column + first), y);
        let (mut at, mut winding) = (column, reference.1 + difference(edges, reference.0, start));
        let mut width = 0.0;
        for (x, by) in &cuts {
            width += weight(winding) * (x - at);
            (at, winding) = (*x, winding + by);
        }
        width += weight(winding) * (column + 1.0 - at);
        sum += width * (pair[1] - pair[0]);
    }
    [sum, off]
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
        let [found, _] = share(&edges, [0.0, 0.0], (Texel::new(0.2, 0.7), 1), &once);
        assert!((found - 0.5).abs() < 1e-12, "{found}");
        let square = [[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [0.5, 0.0]].map(|[x, y]| Texel::new(x, y));
        assert!((convex_area(&square, [0.0, 0.0]) - 0.75).abs() < 1e-12);
    }

    #[test]
    fn overlaps_count_as_often_as_they_are_asked_to() {
        let mut edges = ring(&[[-1.0, -1.0], [-1.0, 0.6], [2.0, 0.6], [2.0, -1.0]]);
        edges.extend(ring(&[[-1.0, 0.3], [-1.0, 2.0], [2.0, 2.0], [2.0, 0.3]]));
        let of =
            |weight: &dyn Fn(i32) -> f64| share(&edges, [0.0, 0.0], (Texel::new(0.4, 0.1), 1), weight)[0];
        assert!((of(&|k| f64::from(k.min(1))) - 1.0).abs() < 1e-12);
        assert!((of(&f64::from) - 1.3).abs() < 1e-12);
        assert!((of(&|k| f64::from(k % 2)) - 0.7).abs() < 1e-12);
    }

    #[test]
    fn many_edges_are_told_to_within_their_doubt() {
        // A comb of slanted teeth, each half a pitch wide.
        let teeth = 20;
        let pitch = 1.0 / f64::from(teeth);
        let tooth = |k: i32| {
            let x = pitch * f64::from(k);
            ring(&[[x, -0.5], [x - 0.3 * pitch, 1.5], [x + 0.2 * pitch, 1.5], [x + 0.5 * pitch, -0.5]])
        };
        let edges: Vec<Edge> = (-2..teeth + 2).flat_map(tooth).collect();
        let once = |k: i32| f64::from(k.clamp(0, 1));
        let [found, off] = share(&edges, [0.0, 0.0], (Texel::new(0.2 * pitch, 0.0), 1), &once);
        assert!((found - 0.5).abs() <= off && off < 0.05, "{found} {off}");
    }
}
