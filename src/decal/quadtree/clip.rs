//! The thesis's own leaves: polygons that are cut at the nodes' borders and closed there (Zechmeister 2020, section 4.2.1, Figure 2.12a).

use super::borders::Quad;
use super::build::Division;
use super::node::Kind;
use crate::math::{max, min};
use crate::space::Plan;

/// The polygons of all leaves that edges meet, with vertices of their own.
#[derive(Debug)]
pub(super) struct LeafPolygons {
    pub(super) vertices: Vec<Plan>,
    /// The numbers of each segment's two vertices.
    pub(super) segments: Vec<[u32; 2]>,
    /// Behind which segment each leaf's end.
    pub(super) ends: Vec<u32>,
}

/// Cuts a divided ring: what is beyond a line that divides a node is put on the line, so that the winding number of no point of the other
/// side changes, but by the rounding of where an edge meets the line. Those pieces on the line are the segments that close the polygon.
pub(super) fn leaf_polygons(path: &[Plan], division: &Division) -> LeafPolygons {
    let mut all = LeafPolygons { vertices: Vec::new(), segments: Vec::new(), ends: Vec::new() };
    let mut queue = vec![(0, Quad::ROOT, path[..path.len() - 1].to_vec())];
    while !queue.is_empty() {
        let mut below = Vec::new();
        for (node, quad, polygon) in queue {
            match division.nodes[node as usize].kind() {
                Kind::Full(_) => {}
                Kind::Partial(_) => all.add(&polygon),
                Kind::Internal(children) => {
                    let middle = division.borders.middle(quad);
                    let [west, east] = halves(&polygon, Axis::X, middle.x);
                    let [[south_west, north_west], [south_east, north_east]] =
                        [west, east].map(|half| halves(&half, Axis::Y, middle.y));
                    let quarters = [south_west, south_east, north_west, north_east];
                    below.extend(
                        (0..).zip(quarters).map(|(k, part)| (children + u32::from(k), quad.child(k), part)),
                    );
                }
            }
        }
        queue = below;
    }
    all
}

/// The coordinate that a line has one value of.
#[derive(Clone, Copy)]
enum Axis {
    X,
    Y,
}

impl Axis {
    fn along(self, of: Plan) -> f64 {
        match self {
            Self::X => of.x,
            Self::Y => of.y,
        }
    }

    fn across(self, of: Plan) -> f64 {
        match self {
            Self::X => of.y,
            Self::Y => of.x,
        }
    }

    fn point(self, along: f64, across: f64) -> Plan {
        match self {
            Self::X => Plan::new(along, across),
            Self::Y => Plan::new(across, along),
        }
    }
}

impl LeafPolygons {
    fn add(&mut self, polygon: &[Plan]) {
        let (first, count) = (self.vertices.len() as u32, polygon.len() as u32);
        self.vertices.extend_from_slice(polygon);
        self.segments.extend((0..count).map(|k| [first + k, first + (k + 1) % count]));
        self.ends.push(self.segments.len() as u32);
    }
}

/// The parts of a polygon on both sides of a line of an axis, each closed along it.
fn halves(polygon: &[Plan], axis: Axis, line: f64) -> [Vec<Plan>; 2] {
    let (mut low, mut high) = (Vec::new(), Vec::new());
    let mut before = polygon.last();
    for vertex in polygon {
        let from = *before.replace(vertex).unwrap_or(vertex);
        let (start, end) = (axis.along(from), axis.along(*vertex));
        if (start < line && line < end) || (end < line && line < start) {
            let on = if start < end {
                meeting(from, *vertex, axis, line)
            } else {
                meeting(*vertex, from, axis, line)
            };
            low.push(on);
            high.push(on);
        }
        if end <= line {
            low.push(*vertex);
        }
        if end >= line {
            high.push(*vertex);
        }
    }
    [low, high].map(|half| without_repeats(half, axis, line))
}

/// Where an edge meets a line that lies between its ends.
fn meeting(from: Plan, to: Plan, axis: Axis, line: f64) -> Plan {
    let (start, end) = (axis.along(from), axis.along(to));
    let (a, b) = (axis.across(from), axis.across(to));
    // Halves: the difference may be too large for a double.
    let share = (0.5 * line - 0.5 * start) / (0.5 * end - 0.5 * start);
    axis.point(line, max(min(a, b), min(max(a, b), a * (1.0 - share) + b * share)))
}

/// A polygon without vertices that repeat the one before them; nothing is left of one that lies on the line.
fn without_repeats(mut polygon: Vec<Plan>, axis: Axis, line: f64) -> Vec<Plan> {
    polygon.dedup();
    if polygon.iter().all(|vertex| axis.along(*vertex) == line) {
        polygon.clear();
    }
    polygon
}
