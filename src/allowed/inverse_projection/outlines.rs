//! What lines and polygons are in inverse projection: closed outlines whose edges know their outside (She 3.1, Fig. 4).

use crate::draw_list::{DrawList, Role};
use crate::index::BoxTree;
use crate::math;
use crate::predicate::orient2d;
use crate::scene::{Cap, Line, Rule, Width};
use crate::space::{Plan, PlanBox, disc_corners};
use glam::DVec2;

/// Which of an item's two sets of plan points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Part {
    /// What its rings bound.
    Polygon,
    /// What its line is expanded to.
    Stroke,
}

/// A set of plan points that edges bound, in draw order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Area {
    pub(super) item: u32,
    pub(super) part: Part,
}

/// An edge of an area.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    pub(super) area: Area,
    pub(super) from: Plan,
    pub(super) to: Plan,
    /// Its direction, of length 1.
    pub(super) way: DVec2,
    pub(super) length: f64,
    /// The direction out of the area across it, of length 1.
    pub(super) outward: DVec2,
}

/// The edges of all areas, and where they are.
#[derive(Debug)]
pub(super) struct Outlines<'l> {
    pub(super) list: &'l DrawList,
    edges: Vec<Edge>,
    boxes: BoxTree,
    /// No edge reaches farther east.
    east: f64,
}

/// Corners that would reach farther than this many half widths are cut off (`docs/semantics.md`).
const FARTHEST_CORNER: f64 = 10.0;

impl<'l> Outlines<'l> {
    /// The outlines of a list over terrain that covers `terrain` of the plan.
    pub(super) fn new(list: &'l DrawList, terrain: &PlanBox) -> Self {
        let mut edges = Vec::new();
        for (item, of) in list.numbered() {
            if list.area_owner(item) == item {
                let area = Area { item, part: Part::Polygon };
                list.border(of).iter().for_each(|ring| add_path(area, list.path_of(ring), &mut edges));
            }
            let area = Area { item, part: Part::Stroke };
            let style = list.style_of(item);
            let Some((line, half)) = style.stroke.as_ref().and_then(|line| Some((line, half_width(line)?)))
            else {
                continue;
            };
            for chain in list.strokes(of) {
                let vertices = list.vertices_of(chain);
                if style.role == Role::Point {
                    add_ring(area, disc_corners(vertices[0], half).to_vec(), &mut edges);
                } else if chain.is_closed {
                    for left in [false, true] {
                        add_ring(area, beside(&Bends::closed(vertices, left), half), &mut edges);
                    }
                } else if vertices.len() > 1 {
                    let points = lengthened(vertices, line, half);
                    let mut ring = beside(&Bends::open(&points, false), half);
                    ring.extend(beside(&Bends::open(&points, true), half));
                    add_ring(area, ring, &mut edges);
                }
            }
        }
        let boxes: Vec<PlanBox> = edges.iter().map(|e| PlanBox::around([e.from, e.to])).collect();
        let east = boxes.iter().fold(f64::NEG_INFINITY, |east, plan| math::max(plan.max.x, east));
        let mut all = Self { list, edges, boxes: BoxTree::new(&boxes), east };
        all.turn_outward(terrain);
        all
    }

    pub(super) fn edge(&self, edge: u32) -> &Edge {
        &self.edges[edge as usize]
    }

    /// Collects the edges whose boxes meet one, by areas.
    pub(super) fn near(&self, plan: &PlanBox, found: &mut Vec<u32>) {
        found.clear();
        self.boxes.query(plan, |edge| {
            found.push(edge);
            true
        });
        // Edges are made area by area.
        found.sort_unstable();
    }

    /// Whether no edge's box meets one.
    pub(super) fn is_clear(&self, plan: &PlanBox) -> bool {
        self.boxes.query(plan, |_| false)
    }

    /// Collects the areas that hold a point: a ray to the east counts the edges that it crosses. A point on an edge is moved a little east
    /// and a little less north.
    pub(super) fn holding(&self, at: Plan, found: &mut Vec<Area>) {
        found.clear();
        let mut crossed: Vec<(Area, i32)> = Vec::new();
        let ray = PlanBox { min: at, max: Plan::new(math::max(self.east, at.x), at.y) };
        self.boxes.query(&ray, |edge| {
            let edge = self.edge(edge);
            let is_upward = edge.to.y > at.y;
            if is_upward != (edge.from.y > at.y) && is_left(edge, at) == is_upward {
                crossed.push((edge.area, if is_upward { 1 } else { -1 }));
            }
            true
        });
        crossed.sort_unstable();
        for run in crossed.chunk_by(|a, b| a.0 == b.0) {
            let turns = run.iter().map(|(_, turn)| turn).sum();
            if self.rule_of(run[0].0).contains(turns) {
                found.push(run[0].0);
            }
        }
    }

    fn rule_of(&self, area: Area) -> Rule {
        match area.part {
            Part::Stroke => Rule::NonZero,
            Part::Polygon => self.list.style_of(area.item).rule,
        }
    }

    /// Whether an area is painted; else it only cuts an outline.
    pub(super) fn is_painted(&self, area: Area) -> bool {
        let role = self.list.style_of(area.item).role;
        area.part == Part::Stroke || matches!(role, Role::Fill | Role::Outside)
    }

    /// Turns the normals of rings outward: the outside is on the right of lines' outlines, of rings where it is found to be
    /// beside the middle of what lies over the terrain.
    fn turn_outward(&mut self, terrain: &PlanBox) {
        let turned = crate::parallel::map(&self.edges, |edge| {
            let middle = middle_within(edge, terrain).filter(|_| edge.area.part == Part::Polygon);
            let mut holding = Vec::new();
            middle.is_some_and(|middle| {
                self.holding(middle, &mut holding);
                holding.contains(&edge.area) != is_left(edge, middle)
            })
        });
        for (edge, _) in self.edges.iter_mut().zip(turned).filter(|(_, is_turned)| *is_turned) {
            edge.outward = -edge.outward;
        }
    }
}

fn half_width(line: &Line) -> Option<f64> {
    match line.width {
        Width::Metres(width) => Some(width / 2.0),
        Width::Pixels(_) => None,
    }
}

/// Adds the edges along a path; the outside is on the right.
fn add_path(area: Area, path: &[Plan], edges: &mut Vec<Edge>) {
    for pair in path.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let Some(way) = (to - from).try_normalize() else { continue };
        let outward = DVec2::new(way.y, -way.x);
        edges.push(Edge { area, from, to, way, length: (to - from).length(), outward });
    }
}

fn add_ring(area: Area, mut ring: Vec<Plan>, edges: &mut Vec<Edge>) {
    ring.extend(ring.first().copied());
    add_path(area, &ring, edges);
}

/// A line's points with its square caps as longer ends.
fn lengthened(points: &[Plan], line: &Line, half: f64) -> Vec<Plan> {
    let mut points = points.to_vec();
    let last = points.len() - 1;
    if line.cap == Cap::Square {
        let beyond = |from: Plan, to: Plan| to + (to - from).try_normalize().unwrap_or(DVec2::ZERO) * half;
        let ends = [beyond(points[1], points[0]), beyond(points[last - 1], points[last])];
        (points[0], points[last]) = (ends[0], ends[1]);
    }
    points
}

/// A line's points in the order of one of its directions, each with the directions into and out of it.
struct Bends(Vec<(Plan, [Option<DVec2>; 2])>);

impl Bends {
    fn open(points: &[Plan], backwards: bool) -> Self {
        Self::of(points, backwards, false)
    }

    fn closed(points: &[Plan], backwards: bool) -> Self {
        Self::of(points, backwards, true)
    }

    fn of(points: &[Plan], backwards: bool, is_closed: bool) -> Self {
        let mut points = points.to_vec();
        if backwards {
            points.reverse();
        }
        let count = points.len();
        // The way from each point to the next.
        let ways: Vec<Option<DVec2>> = (0..count)
            .map(|k| (points[(k + 1) % count] - points[k]).try_normalize())
            .enumerate()
            .map(|(k, way)| way.filter(|_| is_closed || k + 1 < count))
            .collect();
        let bends = points.iter().enumerate().map(|(k, at)| (*at, [ways[(k + count - 1) % count], ways[k]]));
        Self(bends.collect())
    }
}

/// The corners of the parallel on the right of a line.
fn beside(Bends(bends): &Bends, half: f64) -> Vec<Plan> {
    let mut corners = Vec::new();
    for (at, ways) in bends {
        let mut offsets = ways.iter().flatten().map(|way| DVec2::new(way.y, -way.x) * half);
        match (offsets.next(), offsets.next()) {
            (Some(one), Some(other)) => {
                // The parallels meet where both offsets' feet see a right angle: on their bisector, half / cos(half the bend) away.
                let bisector = one + other;
                let share = 2.0 * half * half / bisector.length_squared();
                match share * bisector.length() < FARTHEST_CORNER * half {
                    true => corners.push(*at + bisector * share),
                    false => corners.extend([*at + one, *at + other]),
                }
            }
            (Some(only), None) => corners.push(*at + only),
            _ => {}
        }
    }
    corners
}

/// Whether a point, moved a little east and a little less north, lies left of an edge.
fn is_left(edge: &Edge, at: Plan) -> bool {
    match orient2d(edge.from, edge.to, at) {
        0.0 if edge.from.y == edge.to.y => edge.to.x > edge.from.x,
        0.0 => edge.to.y < edge.from.y,
        side => side > 0.0,
    }
}

/// The middle of what lies in a box of an edge.
fn middle_within(edge: &Edge, bounds: &PlanBox) -> Option<Plan> {
    let (from, step) = (edge.from, edge.to - edge.from);
    let (mut first, mut last) = (0.0, 1.0);
    let axes = [(from.x, step.x, bounds.min.x, bounds.max.x), (from.y, step.y, bounds.min.y, bounds.max.y)];
    for (start, step, low, high) in axes {
        if step == 0.0 && !(low..=high).contains(&start) {
            return None;
        }
        if step != 0.0 {
            let ends = [(low - start) / step, (high - start) / step];
            first = math::max(math::min(ends[0], ends[1]), first);
            last = math::min(math::max(ends[0], ends[1]), last);
        }
    }
    (first <= last).then(|| from + step * ((first + last) / 2.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Color, Feature, Fill, Join, Layer, Shape, Style};

    fn list(style: Style, shape: Shape) -> DrawList {
        let feature = Feature { index: 0, style: 0, shape };
        DrawList::new(&mut [Layer::uniform("one", style, vec![feature])], &PlanBox::EMPTY).unwrap()
    }

    fn points(of: &[(f64, f64)]) -> Vec<Plan> {
        of.iter().map(|&(x, y)| Plan::new(x, y)).collect()
    }

    const EVERYWHERE: PlanBox = PlanBox { min: Plan::new(-1e3, -1e3), max: Plan::new(1e3, 1e3) };

    #[test]
    fn a_line_around_a_corner_has_mitred_sides_and_flat_ends_whose_normals_lead_away() {
        let line =
            Line { color: Color([1.0; 4]), width: Width::Metres(2.0), join: Join::Bevel, cap: Cap::Butt };
        let shape = Shape::Line(vec![points(&[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0)])]);
        let list = list(Style { line: Some(line), ..Style::default() }, shape);
        let outlines = Outlines::new(&list, &EVERYWHERE);
        let starts: Vec<(f64, f64)> = outlines.edges.iter().map(|e| (e.from.x, e.from.y)).collect();
        let expected = [(0.0, -1.0), (5.0, -1.0), (5.0, 4.0), (3.0, 4.0), (3.0, 1.0), (0.0, 1.0)];
        let is_near = |(a, b): (&(f64, f64), &(f64, f64))| (a.0 - b.0).abs() + (a.1 - b.1).abs() < 1e-12;
        assert!(starts.iter().zip(&expected).all(is_near) && starts.len() == 6, "{starts:?}");
        let mut holding = Vec::new();
        for edge in &outlines.edges {
            let middle = edge.from + (edge.to - edge.from) * 0.5;
            for (side, is_in) in [(1e-3, false), (-1e-3, true)] {
                outlines.holding(middle + edge.outward * side, &mut holding);
                assert_eq!(!holding.is_empty(), is_in, "{edge:?}");
            }
        }
    }

    #[test]
    fn the_normals_of_rings_lead_out_of_the_polygon_and_into_its_holes_whichever_way_they_turn() {
        let fill = Fill { color: Color([1.0; 4]), rule: Rule::EvenOdd };
        let square = points(&[(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)]);
        let hole = points(&[(3.0, 3.0), (6.0, 3.0), (6.0, 6.0), (3.0, 6.0)]);
        let list = list(Style { fill: Some(fill), ..Style::default() }, Shape::Polygon(vec![square, hole]));
        let outlines = Outlines::new(&list, &EVERYWHERE);
        assert_eq!(outlines.edges.len(), 8);
        let mut holding = Vec::new();
        for edge in &outlines.edges {
            let middle = edge.from + (edge.to - edge.from) * 0.5;
            for (side, is_in) in [(1e-3, false), (-1e-3, true)] {
                outlines.holding(middle + edge.outward * side, &mut holding);
                assert_eq!(!holding.is_empty(), is_in, "{edge:?}");
            }
        }
    }
}
