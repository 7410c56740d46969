//! Preprocess: line expansion (She 3.1, Fig. 4), and polygons as they are.
//!
//! A line becomes a polygon of two chains of parallel edges, cut and extended to where neighbours meet (Fig. 4c), and two caps
//! (Fig. 4d); every edge keeps the side that faces away from the line (Fig. 4e). The paper draws no round caps or joins ("in order to
//! eradicate heavy loss in performance"), so a layer's `join` and `cap` are not asked, but for `square` caps.

use crate::scene::{Cap, Feature, Layer, Line, OutlineMode, Rule, Shape, Style, Width, distinct_vertices};
use crate::space::Plan;
use glam::DVec2;

/// A directed edge of an area. Its outside is on the right for expanded lines; rings tell in `outside_is_left`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// Start.
    pub a: Plan,
    /// End.
    pub b: Plan,
    /// The area that it bounds.
    pub area: u32,
    /// Whether the edge's normal (pointing out of the area) is on its left.
    pub outside_is_left: bool,
}

/// A set of plan points that is painted in one go, bounded by edges: a fill, a line, an outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Area {
    /// The layer and the feature in it.
    pub layer: u32,
    /// The feature's place in the layer.
    pub feature: u32,
    /// What it is painted with; `None`: it only cuts an outline.
    pub color: Option<crate::scene::Color>,
    /// Which windings are inside.
    pub rule: Rule,
    /// For an outline: the polygon's area, and whether the points in it (or those outside) count.
    pub cut: Option<(u32, bool)>,
    /// Whether its edges come from rings, whose orientation says nothing about the inside.
    pub is_rings: bool,
}

/// Areas in draw order and their edges, sorted by area.
#[derive(Debug, Default)]
pub struct Areas {
    /// Areas in draw order.
    pub areas: Vec<Area>,
    /// Edges in the order of their areas.
    pub edges: Vec<Edge>,
}

/// Where a miter would reach farther than this many half-widths, the corner is cut off (the paper is silent on
/// lines that turn back, where parallel edges meet far away or nowhere).
const MITER_LIMIT: f64 = 10.0;

impl Areas {
    /// The areas of all layers.
    pub fn of_layers(layers: &[Layer]) -> Self {
        let mut all = Self::default();
        for (layer_index, layer) in layers.iter().enumerate() {
            for (feature_index, feature) in layer.features.iter().enumerate() {
                all.add_feature((layer_index as u32, feature_index as u32), layer.style_of(feature), feature);
            }
        }
        all
    }

    fn add_feature(&mut self, from: (u32, u32), style: &Style, feature: &Feature) {
        match &feature.shape {
            Shape::Polygon(rings) => self.add_polygon(from, style, rings),
            Shape::Line(parts) => {
                if let Some(line) = &style.line {
                    self.begin(from, Some(line.color), Rule::NonZero);
                    parts.iter().for_each(|part| self.add_line(part, line));
                }
            }
        }
    }

    fn add_polygon(&mut self, from: (u32, u32), style: &Style, rings: &[Vec<Plan>]) {
        let (fill, outline) = (style.fill, style.outline);
        let needs_inside = outline.is_some_and(|o| o.mode != OutlineMode::Normal);
        let mut inside = None;
        if fill.is_some() || needs_inside {
            inside = Some(self.areas.len() as u32);
            self.begin(from, fill.map(|f| f.color), fill.map_or(Rule::EvenOdd, |f| f.rule));
            if let Some(area) = self.areas.last_mut() {
                area.is_rings = true;
            }
            rings.iter().for_each(|ring| self.add_chain(ring.iter().copied(), true));
        }
        if let Some(outline) = outline {
            let cut = match outline.mode {
                OutlineMode::Normal => None,
                OutlineMode::Inset => inside.map(|area| (area, true)),
                OutlineMode::Offset => inside.map(|area| (area, false)),
            };
            self.begin(from, Some(outline.line.color), Rule::NonZero);
            if let Some(area) = self.areas.last_mut() {
                area.cut = cut;
            }
            rings.iter().for_each(|ring| self.add_loop(ring, &outline.line));
        }
    }

    fn begin(&mut self, (layer, feature): (u32, u32), color: Option<crate::scene::Color>, rule: Rule) {
        self.areas.push(Area { layer, feature, color, rule, cut: None, is_rings: false });
    }

    /// Adds the edges between consecutive points (and back to the first), outside on the right.
    fn add_chain(&mut self, points: impl Iterator<Item = Plan> + Clone, is_closed: bool) {
        let area = self.areas.len() as u32 - 1;
        let next = points.clone().skip(1).chain(points.clone().take(usize::from(is_closed)));
        let edges = points.zip(next).filter(|(a, b)| a != b);
        self.edges.extend(edges.map(|(a, b)| Edge { a, b, area, outside_is_left: false }));
    }

    /// Expands an open polyline (Fig. 4a to 4e); one that is closed has no caps.
    fn add_line(&mut self, points: &[Plan], line: &Line) {
        let points = distinct_vertices(points);
        if points.len() > 3 && points.first() == points.last() {
            return self.add_loop(&points[..points.len() - 1], line);
        }
        let Some(half) = half_width(line) else { return };
        let Some(points) = with_square_ends(points, line, half) else {
            return;
        };
        let mut outline = side_chain(&points, half, false);
        let back: Vec<Plan> = points.iter().rev().copied().collect();
        outline.extend(side_chain(&back, half, false));
        self.add_chain(outline.into_iter(), true);
    }

    /// Expands a closed ring: one chain on each side, no caps.
    fn add_loop(&mut self, ring: &[Plan], line: &Line) {
        let mut points = distinct_vertices(ring);
        while points.len() > 1 && points.first() == points.last() {
            points.pop();
        }
        let Some(half) = half_width(line).filter(|_| points.len() > 1) else {
            return;
        };
        self.add_chain(side_chain(&points, half, true).into_iter(), true);
        points.reverse();
        self.add_chain(side_chain(&points, half, true).into_iter(), true);
    }
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
    use crate::scene::{Color, Join};

    fn expanded(points: &[(f64, f64)], cap: Cap) -> Vec<Edge> {
        let line = Line { color: Color([1.0; 4]), width: Width::Metres(2.0), join: Join::Bevel, cap };
        let part = points.iter().map(|&(x, y)| Plan::new(x, y)).collect();
        let style = Style { line: Some(line), ..Style::default() };
        let feature = Feature { index: 0, style: 0, shape: Shape::Line(vec![part]) };
        let layer = Layer::uniform("line", style, vec![feature]);
        Areas::of_layers(&[layer]).edges
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
