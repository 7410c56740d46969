//! Preprocess: line expansion (She 3.1, Fig. 4), and polygons as they are.
//!
//! A line becomes a polygon of two chains of parallel edges, cut and extended to where neighbours meet (Fig. 4c), and two caps
//! (Fig. 4d); every edge keeps the side that faces away from the line (Fig. 4e). The paper draws no round caps or joins ("in order to
//! eradicate heavy loss in performance"), so a layer's `join` and `cap` are not asked, but for `square` caps.

use crate::draw_list::{Chain, DrawList, Item, Role};
use crate::scene::{Cap, Line, Width};
use crate::space::{Plan, PlanBox, disc_corners};
use glam::DVec2;
use std::fmt;

/// A set of plan points that edges bound: an item's polygon, or its expanded stroke. In draw order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub struct AreaId(u32);

impl AreaId {
    /// After all others.
    pub const LAST: Self = Self(u32::MAX);

    /// An item's polygon; of an outline, what it is cut to.
    pub fn polygon_of(item: u32) -> Self {
        Self(2 * item)
    }

    /// An item's expanded stroke.
    pub fn stroke_of(item: u32) -> Self {
        Self(2 * item + 1)
    }

    /// The item.
    #[inline]
    pub fn item(self) -> u32 {
        self.0 / 2
    }

    /// Whether it is a stroke.
    #[inline]
    pub fn is_stroke(self) -> bool {
        self.0 % 2 == 1
    }
}

impl fmt::Display for AreaId {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let what = if self.is_stroke() { "stroke" } else { "polygon" };
        write!(f, "the {what} of item {}", self.item())
    }
}

/// A directed edge of an area. Its outside is on the right for expanded lines; rings tell in `outside_is_left`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// Start.
    pub a: Plan,
    /// End.
    pub b: Plan,
    /// The area that it bounds.
    pub area: AreaId,
    /// Whether the edge's normal (pointing out of the area) is on its left.
    pub outside_is_left: bool,
}

impl Edge {
    /// Whether a rectangle surely lies on one side of its line.
    #[inline]
    pub fn passes_by(&self, bounds: &PlanBox) -> bool {
        let along = self.b - self.a;
        // The corners farthest to the line's left and to its right.
        let (x, y) = (
            if along.y > 0.0 { (bounds.min.x, bounds.max.x) } else { (bounds.max.x, bounds.min.x) },
            if along.x > 0.0 { (bounds.max.y, bounds.min.y) } else { (bounds.min.y, bounds.max.y) },
        );
        // How far to the left a corner lies, times the edge's length, and what that may be off: three roundings of each product, and one more.
        let side = |corner: Plan| {
            let to = corner - self.a;
            let (p, q) = (along.x * to.y, along.y * to.x);
            (p - q, 4.0 * f64::EPSILON * (p.abs() + q.abs()))
        };
        let ((left, left_error), (right, right_error)) =
            (side(Plan::new(x.0, y.0)), side(Plan::new(x.1, y.1)));
        left < -left_error || right > right_error
    }
}

/// Where a miter would reach farther than this many half-widths, the corner is cut off (the paper is silent on
/// lines that turn back, where parallel edges meet far away or nowhere).
pub const MITER_LIMIT: f64 = 10.0;

/// The edges of all items, in the order of their areas. A polygon has its edges once: of an outline that is cut to it, only where
/// it has no fill.
pub fn expanded(list: &DrawList) -> Vec<Edge> {
    let mut all = Expansion { list, edges: Vec::new() };
    list.numbered().for_each(|(number, item)| all.add_item(number, item));
    all.edges
}

/// Edges being collected.
struct Expansion<'l> {
    list: &'l DrawList,
    edges: Vec<Edge>,
}

impl Expansion<'_> {
    fn add_item(&mut self, number: u32, item: &Item) {
        if self.list.area_owner(number) == number {
            for ring in self.list.border(item) {
                self.add_edges(AreaId::polygon_of(number), self.list.path_of(ring));
            }
        }
        let Some(line) = self.list.style_of(number).stroke else { return };
        for chain in self.list.strokes(item) {
            match self.list.style_of(number).role {
                Role::Point => self.add_disc(AreaId::stroke_of(number), chain, &line),
                _ => self.add_stroke(AreaId::stroke_of(number), chain, &line),
            }
        }
    }

    /// Adds the edges between consecutive points, outside on the right.
    fn add_edges(&mut self, area: AreaId, path: &[Plan]) {
        let edges = path.windows(2).filter(|pair| pair[0] != pair[1]);
        self.edges.extend(edges.map(|pair| Edge { a: pair[0], b: pair[1], area, outside_is_left: false }));
    }

    /// Adds the polygon that stands for the disc around a point, which the paper does not have.
    fn add_disc(&mut self, area: AreaId, chain: &Chain, line: &Line) {
        let ([at, ..], Some(half)) = (self.list.vertices_of(chain), half_width(line)) else { return };
        let corners = disc_corners(*at, half);
        self.add_edges(area, &ring_of(corners.to_vec()));
    }

    /// Expands an open polyline (Fig. 4a to 4e), or a closed one: a chain on each side, no caps.
    fn add_stroke(&mut self, area: AreaId, chain: &Chain, line: &Line) {
        let vertices = self.list.vertices_of(chain);
        let Some(half) = half_width(line) else { return };
        if chain.is_closed {
            self.add_edges(area, &ring_of(side_chain(vertices, half, true)));
            self.add_edges(area, &ring_of(side_chain(&reversed(vertices), half, true)));
            return;
        }
        let Some(points) = with_square_ends(vertices.to_vec(), line, half) else {
            return;
        };
        let mut outline = side_chain(&points, half, false);
        outline.extend(side_chain(&reversed(&points), half, false));
        self.add_edges(area, &ring_of(outline));
    }
}

fn reversed(points: &[Plan]) -> Vec<Plan> {
    points.iter().rev().copied().collect()
}

/// Points and the first of them once more.
fn ring_of(mut points: Vec<Plan>) -> Vec<Plan> {
    points.extend_from_within(..points.len().min(1));
    points
}

/// Half the width in metres; `None` for widths on the screen, which the technique refuses beforehand.
fn half_width(line: &Line) -> Option<f64> {
    match line.width {
        Width::Metres(width) => Some(width / 2.0),
        Width::Pixels(_) => None,
    }
}

/// The polyline with square caps as longer end segments; `None` when it has no length.
fn with_square_ends(mut points: Vec<Plan>, line: &Line, half: f64) -> Option<Vec<Plan>> {
    let n = points.len();
    let direction = |from: Plan, to: Plan| (to - from).try_normalize();
    let (first, last) = (direction(*points.get(1)?, points[0])?, direction(points[n - 2], points[n - 1])?);
    if line.cap == Cap::Square {
        points[0] = points[0] + first * half;
        points[n - 1] = points[n - 1] + last * half;
    }
    Some(points)
}

/// The parallel chain on the right of a polyline, neighbours cut or extended to where they meet (Fig. 4b and 4c).
fn side_chain(points: &[Plan], half: f64, is_closed: bool) -> Vec<Plan> {
    let n = points.len();
    let mut chain = Vec::with_capacity(n + 2);
    for k in 0..n {
        let before = if k > 0 { Some(k - 1) } else { is_closed.then_some(n - 1) };
        let after = if k + 1 < n { Some(k + 1) } else { is_closed.then_some(0) };
        let into = before.and_then(|b| (points[k] - points[b]).try_normalize());
        let out = after.and_then(|a| (points[a] - points[k]).try_normalize());
        let right = |d: DVec2| DVec2::new(d.y, -d.x) * half;
        match (into, out) {
            (Some(into), Some(out)) => {
                // The parallels meet on the bisector: m = (r1 + r2) / (1 + r1 . r2) for unit right-hand normals.
                let cosine = into.dot(out);
                let miter_squared = 2.0 / (1.0 + cosine);
                if miter_squared < MITER_LIMIT * MITER_LIMIT {
                    chain.push(points[k] + (right(into) + right(out)) / (1.0 + cosine));
                } else {
                    chain.extend([points[k] + right(into), points[k] + right(out)]);
                }
            }
            (Some(only), None) | (None, Some(only)) => chain.push(points[k] + right(only)),
            (None, None) => {}
        }
    }
    chain
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Color, Feature, Join, Layer, Shape, Style};

    fn expanded(points: &[(f64, f64)], cap: Cap) -> Vec<Edge> {
        let line = Line { color: Color([1.0; 4]), width: Width::Metres(2.0), join: Join::Bevel, cap };
        let part = points.iter().map(|&(x, y)| Plan::new(x, y)).collect();
        let style = Style { line: Some(line), ..Style::default() };
        let feature = Feature { index: 0, style: 0, shape: Shape::Line(vec![part]) };
        super::expanded(
            &DrawList::new(&mut [Layer::uniform("line", style, vec![feature])], &PlanBox::EMPTY).unwrap(),
        )
    }

    fn corners(edges: &[Edge]) -> Vec<(f64, f64)> {
        edges.iter().map(|e| (e.a.x, e.a.y)).collect()
    }

    #[test]
    fn a_segment_becomes_a_rectangle_with_its_outside_on_the_right() {
        let edges = expanded(&[(0.0, 0.0), (4.0, 0.0)], Cap::Butt);
        assert_eq!(corners(&edges), [(0.0, -1.0), (4.0, -1.0), (4.0, 1.0), (0.0, 1.0)]);
    }

    #[test]
    fn a_right_angle_is_cut_inside_and_extended_outside() {
        let edges = expanded(&[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0)], Cap::Butt);
        assert_eq!(
            corners(&edges),
            [(0.0, -1.0), (5.0, -1.0), (5.0, 4.0), (3.0, 4.0), (3.0, 1.0), (0.0, 1.0)]
        );
    }

    #[test]
    fn a_line_that_turns_back_stays_finite_and_short() {
        let edges = expanded(&[(0.0, 0.0), (10.0, 0.0), (2.0, 0.0)], Cap::Butt);
        assert!(edges.iter().all(|e| e.a.x.abs() <= 10.0 && e.a.y.abs() <= 1.0), "{edges:?}");
    }

    #[test]
    fn square_caps_reach_half_a_width_on() {
        let edges = expanded(&[(0.0, 0.0), (4.0, 0.0)], Cap::Square);
        assert_eq!(corners(&edges)[0], (-1.0, -1.0));
    }

    #[test]
    fn points_without_length_make_no_edges() {
        assert!(expanded(&[(1.0, 1.0), (1.0, 1.0)], Cap::Square).is_empty());
        assert!(expanded(&[], Cap::Butt).is_empty());
    }
}
