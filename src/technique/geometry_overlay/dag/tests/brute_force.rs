//! Chains cut at the triangles of a mesh in rational arithmetic, one triangle and one segment after the other.

use super::super::grid::GridPoint;
use crate::terrain::lod::{Post, RightTriangle};
use dashu::integer::IBig;
use dashu::rational::RBig;
use std::collections::BTreeSet;

pub type Exact = [RBig; 2];

pub fn rational(v: f64) -> RBig {
    RBig::try_from(v).unwrap()
}

pub fn exact(point: GridPoint) -> Exact {
    point.map(rational)
}

/// A point of a chain that is moved by a step that no determinant of the tests' points is as small as.
fn moved([x, y]: GridPoint) -> Exact {
    let step = RBig::from(1) / RBig::from(IBig::from(1) << 400);
    [rational(x) + step.clone(), rational(y) + step.clone() * step]
}

/// A mesh without cracks: triangles of the hierarchy that are split one by one, each with the neighbours that it forces.
#[derive(Debug, Clone)]
pub struct Mesh {
    pub triangles: BTreeSet<RightTriangle>,
    smallest_layer: u32,
}

impl Mesh {
    /// The two halves of each of a block of squares, `side` posts wide; nothing below `smallest_layer` is split.
    pub fn of_squares(low: Post, side: u32, count: u32, smallest_layer: u32) -> Self {
        let first = low.map(|at| at / side);
        let squares = (0..count * count).map(|k| [first[0] + k % count, first[1] + k / count]);
        let triangles = squares.flat_map(|square| RightTriangle::of_cell(square, side)).collect();
        Self { triangles, smallest_layer }
    }

    /// Splits a triangle of the mesh, if it is none of the smallest.
    pub fn split(&mut self, triangle: RightTriangle) {
        if triangle.layer() <= self.smallest_layer || !self.triangles.contains(&triangle) {
            return;
        }
        let RightTriangle { apex, left, right } = triangle;
        // Beyond post 0 there is no neighbour.
        let opposite = [0, 1].map(|k| (left[k] + right[k]).checked_sub(apex[k]));
        let other = match opposite {
            [Some(x), Some(y)] => Some(RightTriangle { apex: [x, y], left: right, right: left }),
            _ => None,
        };
        if let Some(other) = other.filter(|other| !self.triangles.contains(other)) {
            self.split(other.whole());
        }
        for half in [Some(triangle), other].into_iter().flatten() {
            if self.triangles.remove(&half) {
                self.triangles.extend(half.halves().unwrap());
            }
        }
    }

    pub fn vertices(&self) -> BTreeSet<Post> {
        self.triangles.iter().flat_map(RightTriangle::corners).collect()
    }
}

/// What of a chain lies in a triangle.
#[derive(Debug, Clone, PartialEq)]
pub struct Piece {
    pub triangle: RightTriangle,
    pub entrance: Option<GridPoint>,
    pub vertices: Vec<usize>,
    pub exit: Option<GridPoint>,
}

/// A chain cut at triangles that do not overlap: pieces in its order, crossings rounded to the nearest doubles.
pub fn cut(chain: &[GridPoint], triangles: &BTreeSet<RightTriangle>) -> Vec<Piece> {
    let mut pieces = Vec::new();
    let Some(start) = chain.first() else { return pieces };
    let is_in = |t: &&RightTriangle| sides(t, &moved(*start)).iter().all(|side| *side > RBig::ZERO);
    let first = |t: &RightTriangle| Piece { triangle: *t, entrance: None, vertices: vec![0], exit: None };
    let mut here = triangles.iter().find(is_in).map(first);
    for (k, ends) in chain.windows(2).enumerate() {
        if ends[0] == ends[1] {
            if let Some(piece) = &mut here {
                piece.vertices.push(k + 1);
            }
            continue;
        }
        let spans = triangles.iter().filter_map(|t| Some((span(t, ends)?, t)));
        let mut spans: Vec<_> = spans.collect();
        spans.sort();
        let at = |t: &RBig| {
            let [p, q] = [exact(ends[0]), exact(ends[1])];
            Some([0, 1].map(|k| (p[k].clone() + (q[k].clone() - p[k].clone()) * t.clone()).to_f64().value()))
        };
        for ([[_, low], [moved_high, high]], triangle) in spans {
            let mut piece = here.take().unwrap_or_else(|| Piece {
                entrance: at(&low),
                vertices: vec![],
                ..first(triangle)
            });
            assert_eq!(piece.triangle, *triangle);
            if moved_high == RBig::ONE {
                piece.vertices.push(k + 1);
                here = Some(piece);
            } else {
                piece.exit = at(&high);
                pieces.push(piece);
            }
        }
    }
    pieces.extend(here);
    pieces
}

/// The parameters of a moved segment between which it lies in a triangle, each with that of the segment that is not moved.
fn span(triangle: &RightTriangle, ends: &[GridPoint]) -> Option<[[RBig; 2]; 2]> {
    let [from, to] = [0, 1].map(|k| sides(triangle, &moved(ends[k])));
    let start = sides(triangle, &exact(ends[0]));
    let (mut low, mut high) = ([RBig::ZERO, RBig::ZERO], [RBig::ONE, RBig::ONE]);
    for ((from, to), start) in from.into_iter().zip(to).zip(start) {
        if from <= RBig::ZERO && to <= RBig::ZERO {
            return None;
        }
        if from == to {
            continue;
        }
        let change = from.clone() - to.clone();
        let at = [from.clone() / change.clone(), start / change];
        if to > from { low = low.max(at) } else { high = high.min(at) }
    }
    (low < high).then_some([low, high])
}

/// On which sides of a triangle's edges a point lies: positive inside.
fn sides(triangle: &RightTriangle, p: &Exact) -> [RBig; 3] {
    let corners = triangle.corners().map(|corner| exact(corner.map(f64::from)));
    [0, 1, 2].map(|k| {
        let (a, b) = (&corners[k], &corners[(k + 1) % 3]);
        let [along, to] = [b, p].map(|end| [0, 1].map(|k| end[k].clone() - a[k].clone()));
        along[0].clone() * to[1].clone() - along[1].clone() * to[0].clone()
    })
}
