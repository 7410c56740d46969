//! Screen triangles -> samples: edge functions, the top-left rule, linear depth, the depth test.

use super::depth::DepthBuffer;
use super::number::{Coordinate, GRID_BITS, Real};
use super::{Lattice, Samples};
use crate::math;
use std::ops::Range;

/// A triangle on the screen.
#[derive(Debug, Clone, Copy)]
pub struct Primitive<T> {
    /// The terrain's triangle that it is (a part of).
    pub id: u32,
    /// Screen x, screen y (pixels, snapped) and depth (0..=1) of each corner.
    pub corners: [[T; 3]; 3],
}

/// Columns and rows of a lattice.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Window {
    /// Columns.
    pub columns: Range<usize>,
    /// Rows.
    pub rows: Range<usize>,
}

impl Window {
    pub(super) fn shared_with(&self, other: &Self) -> Self {
        let shared = |a: &Range<usize>, b: &Range<usize>| a.start.max(b.start)..a.end.min(b.end);
        Self { columns: shared(&self.columns, &other.columns), rows: shared(&self.rows, &other.rows) }
    }
}

impl<T: Real> Primitive<T> {
    /// The samples in the box around it; `None`: none, or a corner is not finite.
    pub fn window(&self, lattice: &Lattice) -> Option<Window> {
        if !self.corners.iter().flatten().all(|v| v.get().is_finite()) {
            return None;
        }
        let span = |axis: usize, first: f64, count: usize| {
            let v = self.corners.map(|c| c[axis].get());
            let low = math::min(math::min(v[0], v[1]), v[2]);
            let high = math::max(math::max(v[0], v[1]), v[2]);
            // Samples may lie half a unit of the grid beside their place, and single-precision ones a rounding.
            let hair = 1.0 / f64::from(1u32 << GRID_BITS) + 1e-6 * math::max(low.abs(), high.abs());
            let from = ((low - hair - first) / lattice.step).ceil();
            let to = ((high + hair - first) / lattice.step).floor() + 1.0;
            // Casts saturate: what lies before the first sample becomes 0.
            let range = from as usize..(to as usize).min(count);
            (!range.is_empty()).then_some(range)
        };
        Some(Window {
            columns: span(0, lattice.x, lattice.columns)?,
            rows: span(1, lattice.y, lattice.rows)?,
        })
    }
}

/// Draws primitives in order into the samples of a window of the lattice, by edge functions of `N`s.
pub(super) fn draw<'p, T: Real + 'p, N: Coordinate>(
    primitives: impl Iterator<Item = &'p Primitive<T>>,
    (lattice, window): (&Lattice, &Window),
    depth: DepthBuffer,
    samples: &mut Samples,
) {
    let xs = positions::<N>(&window.columns, lattice.x, lattice.step);
    let ys = positions::<N>(&window.rows, lattice.y, lattice.step);
    for primitive in primitives {
        let Some(part) = primitive.window(lattice) else {
            continue;
        };
        let Some(edges) = Edges::<T, N>::new(primitive) else {
            continue;
        };
        let part = part.shared_with(window);
        for row in part.rows {
            let r = row - window.rows.start;
            let start = r * samples.stride();
            for column in part.columns.clone() {
                let c = column - window.columns.start;
                let Some(z) = edges.depth_at([xs[c], ys[r]]) else {
                    continue;
                };
                let stored = depth.store(z);
                if depth.passes(stored, samples.keys[start + c]) {
                    samples.keys[start + c] = stored;
                    samples.ids[start + c] = primitive.id;
                }
            }
        }
    }
}

/// Calls `visit` with the column, the row, the facing (1: the corners run counter-clockwise on the screen, else -1) and the depth,
/// which may lie beyond 0..=1, of each sample of a window that a primitive covers.
pub(super) fn visit<T: Real, N: Coordinate>(
    primitive: &Primitive<T>,
    (lattice, window): (&Lattice, &Window),
    visit: &mut dyn FnMut((usize, usize), i32, T),
) {
    let Some(part) = primitive.window(lattice).map(|all| all.shared_with(window)) else { return };
    let Some(edges) = Edges::<T, N>::new(primitive) else { return };
    let xs = positions::<N>(&part.columns, lattice.x, lattice.step);
    let ys = positions::<N>(&part.rows, lattice.y, lattice.step);
    for (row, y) in part.rows.zip(ys) {
        for (column, x) in part.columns.clone().zip(&xs) {
            if let Some(depth) = edges.depth_at([*x, y]) {
                visit((column, row), edges.facing, depth);
            }
        }
    }
}

/// Screen coordinates of some columns or rows.
fn positions<N: Coordinate>(range: &Range<usize>, first: f64, step: f64) -> Vec<N> {
    range.clone().map(|k| N::of_pixels(first + k as f64 * step)).collect()
}

/// A triangle whose corners run clockwise on the screen (y down): edge functions are positive inside.
struct Edges<T, N> {
    corners: [[N; 2]; 3],
    depths: [T; 3],
    /// -1: the corners were given in this order; 1: in the other one.
    facing: i32,
}

impl<T: Real, N: Coordinate> Edges<T, N> {
    /// `None` for a triangle without area.
    fn new(primitive: &Primitive<T>) -> Option<Self> {
        let [a, b, c] = primitive.corners;
        let place = |p: [T; 3]| [N::of_pixels(p[0].get()), N::of_pixels(p[1].get())];
        let (area, zero) = (edge(place(a), place(b), place(c)), N::of_pixels(0.0));
        let ([a, b, c], facing) = if area > zero {
            ([a, b, c], -1)
        } else if area < zero {
            ([a, c, b], 1)
        } else {
            return None;
        };
        Some(Self { corners: [place(a), place(b), place(c)], depths: [a[2], b[2], c[2]], facing })
    }

    /// The depth at a sample, `None` where the triangle does not cover it.
    fn depth_at(&self, p: [N; 2]) -> Option<T> {
        let [a, b, c] = self.corners;
        let weights = [covered_side(b, c, p)?, covered_side(c, a, p)?, covered_side(a, b, p)?];
        let [u, v, w] = weights.map(|weight| T::of(weight.rounded()));
        let sum = u + v + w;
        let [first, second, third] = self.depths;
        (sum > T::of(0.0)).then(|| first + ((second - first) * v + (third - first) * w) / sum)
    }
}

/// Twice the area of (a, b, p): positive when they run clockwise on the screen (y down). Both directions of an edge give the
/// same number but for its sign, in floating-point arithmetic too, since the edge always starts at its lesser end.
fn edge<N: Coordinate>(a: [N; 2], b: [N; 2], p: [N; 2]) -> N {
    let from = |a: [N; 2], b: [N; 2]| (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
    if a <= b { from(a, b) } else { N::of_pixels(0.0) - from(b, a) }
}

/// The edge function of a -> b where `p` is on the inner side, or on a left or a top edge itself (the top-left rule: the
/// sample on an edge belongs to the triangle right of it, on a level edge to the one below).
fn covered_side<N: Coordinate>(a: [N; 2], b: [N; 2], p: [N; 2]) -> Option<N> {
    let (side, zero) = (edge(a, b, p), N::of_pixels(0.0));
    let is_top_left = b[1] < a[1] || b[1] == a[1] && b[0] > a[0];
    (side > zero || side == zero && is_top_left).then_some(side)
}
