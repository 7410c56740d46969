//! What is inside of rings as triangles: a constrained Delaunay triangulation of their edges.

use super::edges::{Edges, Rings, of_member, too_often};
use super::planar;
use crate::error::{Error, Result};
use crate::space::Plan;
use spade::handles::DirectedEdgeHandle;
use spade::{CdtEdge, ConstrainedDelaunayTriangulation, InsertionError, Point2, Triangulation as _};

/// Triangles, counter-clockwise, over vertices.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Triangulation {
    /// The vertices of the rings and where they cross, from the lowest up.
    pub vertices: Vec<Plan>,
    /// Numbers of their corners.
    pub triangles: Vec<[u32; 3]>,
}

/// No coordinate nearer to 0 than this can be triangulated, and none farther from it than its reciprocal.
const NEAREST: f64 = 1.0 / (1u128 << 100) as f64;

/// The triangles that cover what is inside of rings (closed, the first vertex once), by a rule that tells what windings are inside. Each edge of a ring is a
/// side of triangles; where edges cross, both have a corner there, rounded to doubles. Coordinates of less than 2^-100 count as 0, those of
/// more than 2^100 as that.
///
/// # Errors
/// When edges meet more often than can be held, or told in seconds.
pub fn triangulated(rings: &[Vec<Plan>], is_inside: &dyn Fn(i32) -> bool) -> Result<Triangulation> {
    let known = |v: f64| if v.abs() < NEAREST { 0.0 } else { v.clamp(-1.0 / NEAREST, 1.0 / NEAREST) };
    let rings: Rings =
        rings.iter().map(|ring| ring.iter().map(|p| Plan::new(known(p.x), known(p.y))).collect()).collect();
    let edges = planar::cut(of_member(&[rings], 0).collect())?;
    let vertices = vertices_of(&edges);
    if vertices.len() < 3 {
        return Ok(Triangulation::default());
    }
    if vertices.len() > u32::MAX as usize / 4 {
        return Err(too_often());
    }
    let number = |p: Plan| vertices.partition_point(|v| super::edge::order(*v, p).is_lt());
    let sides: Vec<([usize; 2], i32)> =
        edges.all.iter().map(|edge| ([number(edge.low), number(edge.high)], edge.turns)).collect();
    let points = vertices.iter().map(|p| Point2::new(p.x, p.y)).collect();
    let mut missed = 0;
    let mesh =
        Mesh::try_bulk_load_cdt(points, sides.iter().map(|(ends, _)| *ends).collect(), |_| missed += 1)
            .map_err(refused)?;
    // Edges meet at their ends alone, exactly, and no two vertices are the same.
    if missed > 0 || mesh.num_vertices() != vertices.len() {
        return Err(Error::new("a polygon cannot be triangulated: its edges cross"));
    }
    let triangles = inside(&mesh, &sides, is_inside);
    Ok(Triangulation { vertices, triangles })
}

type Mesh = ConstrainedDelaunayTriangulation<Point2<f64>>;
type Side<'m> = DirectedEdgeHandle<'m, Point2<f64>, (), CdtEdge<()>, ()>;

fn refused(error: InsertionError) -> Error {
    Error::new("a polygon cannot be triangulated").caused_by(error)
}

/// The ends of edges, each once, from the lowest up.
fn vertices_of(edges: &Edges) -> Vec<Plan> {
    let mut all: Vec<Plan> = edges.all.iter().flat_map(|edge| [edge.low, edge.high]).collect();
    all.sort_unstable_by(|a, b| super::edge::order(*a, *b));
    all.dedup_by(|a, b| super::edge::order(*a, *b).is_eq());
    all
}

/// The triangles inside: from the outside, which no ring turns around, from triangle to triangle; what turns around them changes by the sides that are crossed.
fn inside(mesh: &Mesh, sides: &[([usize; 2], i32)], is_inside: &dyn Fn(i32) -> bool) -> Vec<[u32; 3]> {
    // By how much the winding left of a side exceeds that on its right. Sides are sorted by their ends, the lower one first.
    let more_on_the_left = |side: Side| {
        let [from, to] = [side.from().index(), side.to().index()];
        let find = |ends: [usize; 2]| sides.binary_search_by_key(&ends, |(ends, _)| *ends);
        match find([from.min(to), from.max(to)]) {
            Ok(place) if from < to => sides[place].1,
            Ok(place) => -sides[place].1,
            Err(_) => 0,
        }
    };
    let mut windings: Vec<Option<i32>> = vec![None; mesh.num_all_faces()];
    windings[mesh.outer_face().index()] = Some(0);
    let mut way: Vec<Side> = mesh.convex_hull().collect();
    while let Some(side) = way.pop() {
        // The side has a face on its left whose winding is known; what lies on its right may not be.
        let beyond = side.rev().face();
        let Some(winding) = windings[side.face().index()] else { continue };
        if windings[beyond.index()].is_some() {
            continue;
        }
        windings[beyond.index()] = Some(winding - more_on_the_left(side));
        if let Some(face) = beyond.as_inner() {
            way.extend(face.adjacent_edges());
        }
    }
    let is_held = |winding: Option<i32>| winding.is_some_and(is_inside);
    let held = mesh.inner_faces().filter(|face| is_held(windings[face.index()]));
    held.map(|face| face.vertices().map(|vertex| vertex.index() as u32)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn ring(points: &[(f64, f64)]) -> Vec<Plan> {
        points.iter().map(|(x, y)| Plan::new(*x, *y)).collect()
    }

    fn even_odd(turns: i32) -> bool {
        turns % 2 != 0
    }

    fn non_zero(turns: i32) -> bool {
        turns != 0
    }

    fn area(of: &Triangulation) -> f64 {
        let corners = |triangle: &[u32; 3]| triangle.map(|k| of.vertices[k as usize]);
        let twice = |[a, b, c]: [Plan; 3]| (b - a).perp_dot(c - a);
        let twice: Vec<f64> = of.triangles.iter().map(|triangle| twice(corners(triangle))).collect();
        assert!(twice.iter().all(|area| *area > 0.0), "counter-clockwise");
        twice.iter().sum::<f64>() / 2.0
    }

    #[test]
    fn holes_islands_and_crossings_are_what_the_rule_says() {
        let square = |half: f64| ring(&[(-half, -half), (half, -half), (half, half), (-half, half)]);
        let nested = [square(4.0), square(3.0), square(1.0)];
        let bow = [ring(&[(0.0, 0.0), (4.0, 4.0), (4.0, 0.0), (0.0, 4.0)])];
        let twice = [square(1.0), square(1.0)];
        let there_and_back = [ring(&[(0.0, 0.0), (4.0, 0.0), (2.0, 0.0)])];
        let of = |rings: &[Vec<Plan>], rule: fn(i32) -> bool| area(&triangulated(rings, &rule).unwrap());
        assert_eq!([of(&nested, even_odd), of(&nested, non_zero)], [64.0 - 36.0 + 4.0, 64.0]);
        assert_eq!([of(&bow, even_odd), of(&bow, non_zero)], [8.0, 8.0]);
        assert_eq!([of(&twice, even_odd), of(&twice, non_zero)], [0.0, 4.0]);
        assert_eq!(of(&there_and_back, non_zero), 0.0);
        assert_eq!(of(&[], non_zero), 0.0);
    }

    #[test]
    fn coordinates_that_are_next_to_nothing_or_next_to_infinite_are_taken() {
        let rings = [ring(&[(1e-300, 0.0), (1e200, -1e-310), (1e200, 1e200)])];
        assert_eq!(triangulated(&rings, &non_zero).unwrap().triangles.len(), 1);
    }

    fn coordinate() -> impl Strategy<Value = f64> {
        prop_oneof![(-6..7i32).prop_map(f64::from), -6.0..6.0f64]
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]
        #[test]
        fn a_point_lies_in_one_triangle_where_the_rule_has_it_inside_and_in_none_elsewhere(
            rings in prop::collection::vec(
                prop::collection::vec((coordinate(), coordinate()).prop_map(|(x, y)| Plan::new(x, y)), 3..9), 1..4),
            is_even_odd in any::<bool>(),
            points in prop::collection::vec((-6.5..6.5f64, -6.5..6.5f64).prop_map(|(x, y)| Plan::new(x, y)), 40),
        ) {
            let rule = if is_even_odd { even_odd } else { non_zero };
            let found = triangulated(&rings, &rule).unwrap();
            area(&found);
            let sides = || rings.iter().flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)));
            let far = |p: Plan, (a, b): (&Plan, &Plan)| {
                let along = (*b - *a).normalize_or_zero();
                let share = (p - *a).dot(along).clamp(0.0, (*b - *a).length());
                (p - *a - along * share).length() > 1e-9
            };
            for p in points.into_iter().filter(|p| sides().all(|side| far(*p, side))) {
                let crossed = sides().filter(|(a, b)| (a.y <= p.y) != (b.y <= p.y));
                let east = crossed.filter(|(a, b)| a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) > p.x);
                let turns: i32 = east.map(|(a, b)| if a.y < b.y { 1 } else { -1 }).sum();
                let holds = |triangle: &&[u32; 3]| {
                    let [a, b, c] = triangle.map(|k| found.vertices[k as usize]);
                    [(a, b), (b, c), (c, a)].iter().all(|(a, b)| (*b - *a).perp_dot(p - *a) > 0.0)
                };
                let count = found.triangles.iter().filter(holds).count();
                prop_assert!(count <= 1 && (count == 1 || !rule(turns) || on_a_side(&found, p)), "{} at {:?}", count, p);
                prop_assert!(rule(turns) || count == 0, "{:?}", p);
            }
        }
    }

    /// Whether a point may lie on a side of a triangle.
    fn on_a_side(of: &Triangulation, p: Plan) -> bool {
        let sides = of.triangles.iter().flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]);
        sides.into_iter().any(|ends| {
            let [a, b] = ends.map(|k| of.vertices[k as usize]);
            (b - a).perp_dot(p - a).abs() < 1e-9
        })
    }
}
