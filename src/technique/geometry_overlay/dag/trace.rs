//! A polyline traced through the smallest triangles of a quad (3.2), without a rounded decision.
//!
//! Input: the points of a part of a chain, the quad's cells. Output: [`Section`]s, each with one entrance and one exit. Refuses: nothing.

use super::cells::{AtEdge, Cells, edge_of};
use super::crossing::Crossing;
use super::grid::GridPoint;
use super::side::{is_left_of_edge, is_left_of_way};
use crate::terrain::lod::RightTriangle;

/// What of a polyline lies in a quad from an entrance, or the polyline's start, to the next exit or its end.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Section {
    /// The number of the first point that lies in the quad, or would: that at which a segment that passes through ends.
    pub first: usize,
    /// Whether it comes from outside: the first crossing is the entrance.
    pub enters: bool,
    /// The smallest triangles in the order of the walk, and where each one's points end, counted from `first`.
    pub triangles: Vec<(RightTriangle, u32)>,
    /// Where it crosses edges: the entrance, between one triangle and the next, the exit.
    pub crossings: Vec<Crossing>,
}

impl Section {
    fn add(&mut self, triangle: RightTriangle) {
        let end = self.triangles.last().map_or(0, |(_, end)| *end);
        self.triangles.push((triangle, end));
    }

    /// The next point lies in the last triangle.
    fn add_point(&mut self) {
        if let Some((_, end)) = self.triangles.last_mut() {
            *end += 1;
        }
    }
}

/// Traces consecutive points of a chain; the first is outside of the quad or the chain's first.
pub fn trace(cells: &Cells, points: &[GridPoint]) -> Vec<Section> {
    let mut sections = Vec::new();
    let Some(start) = points.first() else { return sections };
    // The section on the way and the triangle where it is.
    let mut here = cells.holding(*start).map(|triangle| {
        let mut section = Section::default();
        section.add(triangle);
        section.add_point();
        (section, triangle)
    });
    for (k, ends) in (1..).zip(points.windows(2)) {
        let [p, q] = [ends[0], ends[1]];
        let mut entered = None;
        if here.is_none()
            && let Some((triangle, edge)) = cells.entered(p, q)
        {
            let crossings = vec![Crossing::new(p, q, edge_of(&triangle, edge))];
            let mut section = Section { first: k, enters: true, crossings, ..Section::default() };
            section.add(triangle);
            here = Some((section, triangle));
            entered = Some(edge);
        }
        if let Some((mut section, triangle)) = here.take() {
            match walk(cells, &mut section, [p, q], (triangle, entered)) {
                Some(triangle) => {
                    section.add_point();
                    here = Some((section, triangle));
                }
                None => sections.push(section),
            }
        }
    }
    sections.extend(here.map(|(section, _)| section));
    sections
}

/// Walks from a point in a triangle, or from where that was entered, to a point: the triangle that holds it; `None` if it lies outside.
fn walk(
    cells: &Cells,
    section: &mut Section,
    [p, q]: [GridPoint; 2],
    start: (RightTriangle, Option<usize>),
) -> Option<RightTriangle> {
    let (mut triangle, mut entered) = start;
    if p == q {
        return Some(triangle);
    }
    loop {
        let edge = exit(&triangle, entered, [p, q]);
        let ends = edge_of(&triangle, edge);
        if is_left_of_edge(ends, q) {
            return Some(triangle);
        }
        section.crossings.push(Crossing::new(p, q, ends));
        let (next, edge): AtEdge = cells.across((triangle, edge))?;
        section.add(next);
        (triangle, entered) = (next, Some(edge));
    }
}

/// The edge by which a way leaves a triangle: it comes from a point in there, or entered by an edge. The edge's first end is on the right, its
/// second on the left.
fn exit(triangle: &RightTriangle, entered: Option<usize>, [p, q]: [GridPoint; 2]) -> usize {
    let corners = triangle.corners();
    if let Some(edge) = entered {
        // Of the edge that was entered by it is the other way round: only the corner beyond is asked.
        return if is_left_of_way(p, q, corners[(edge + 2) % 3]) { (edge + 1) % 3 } else { (edge + 2) % 3 };
    }
    let lefts = corners.map(|corner| is_left_of_way(p, q, corner));
    (0..3).find(|&k| !lefts[k] && lefts[(k + 1) % 3]).unwrap_or(0)
}
