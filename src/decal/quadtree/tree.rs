//! The quadtree of a ring, and what it answers.

use super::borders::{Borders, Quad};
use super::build::{Limits, divide};
use super::clip::leaf_polygons;
use super::crossing::{Arithmetic, Exact, Single, turns_above};
use super::node::{Kind, Leaf, Node};
use crate::decal::LeafPolygons;
use crate::space::{Plan, PlanBox, SmallBox};
use std::ops::Range;

/// What an answer took.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counts {
    /// Nodes that were visited.
    pub nodes: u64,
    /// Edges that were tested.
    pub edges: u64,
}

/// The subtree in which an answer is looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Start {
    pub(super) node: u32,
    pub(super) quad: Quad,
}

impl Start {
    /// The whole tree.
    pub const ROOT: Self = Self { node: 0, quad: Quad::ROOT };

    /// The number of its node in the tree.
    pub fn node(self) -> u32 {
        self.node
    }
}

/// The edges of a tree's leaves.
#[derive(Debug)]
pub enum LeafEdges<'a> {
    /// The numbers of their first vertices among the draw list's; each ends at the next vertex.
    Numbers(&'a [u32]),
    /// Vertices of their own, and of each segment the numbers of its two vertices among these.
    Segments(&'a [Plan], &'a [[u32; 2]]),
}

#[derive(Debug)]
pub(super) enum Edges {
    Numbers(Box<[u32]>),
    Segments(Box<[Plan]>, Box<[[u32; 2]]>),
}

/// The nodes of a ring that has more edges than a leaf may have.
#[derive(Debug)]
pub(super) struct Nodes {
    pub(super) borders: Borders,
    pub(super) nodes: Box<[Node]>,
    leaves: Box<[Leaf]>,
    pub(super) edges: Edges,
}

/// The quadtree of a ring.
///
/// A ring that is not divided, as most are, is a leaf at the root, and holds nothing but its bounds and which vertices it has.
#[derive(Debug)]
pub struct Quadtree {
    pub(super) bounds: PlanBox,
    pub(super) first: u32,
    /// How many edges the ring has; 0 for a ring without an area.
    pub(super) count: u32,
    pub(super) nodes: Option<Box<Nodes>>,
}

impl Quadtree {
    /// The tree of a ring. `path` has its vertices, scene-local metres, the first once more at the end; `first` is the number of the first among
    /// the draw list's.
    pub fn new(path: &[Plan], first: u32, limits: Limits, closing: LeafPolygons) -> Self {
        let bounds = PlanBox::around(path.iter().copied());
        let has_area = bounds.min.x < bounds.max.x && bounds.min.y < bounds.max.y;
        let count = if has_area { path.len() as u32 - 1 } else { 0 };
        let is_leaf = count <= limits.capacity.max(1) || limits.depth == 0;
        let nodes = (!is_leaf).then(|| Box::new(Nodes::new(path, &bounds, first, limits, closing)));
        Self { bounds, first, count, nodes }
    }

    /// The ring's box.
    pub fn bounds(&self) -> PlanBox {
        self.bounds
    }

    /// Quadtree culling (Figure 2.12b): the smallest subtree that has all that the ring has in a box; `None`: the ring winds around no point
    /// in it. Points of the box get the same answers from the subtree as from the whole tree.
    pub fn start_in(&self, cell: &PlanBox) -> Option<Start> {
        let shared = Borders::shared(&self.bounds, cell).filter(|_| self.count > 0)?;
        match &self.nodes {
            Some(nodes) => nodes.start_in(&shared),
            None => Some(Start::ROOT),
        }
    }

    /// The ring's winding number around a point, exactly, but for leaves that are clipped; 0 for a point outside of the subtree. `vertices`
    /// are all of the draw list.
    pub fn winding(&self, vertices: &[Plan], start: Start, at: Plan, counts: &mut Counts) -> i32 {
        if !(holds::<Exact>(&self.bounds, at) && self.count > 0) {
            return 0;
        }
        let Some(nodes) = &self.nodes else {
            return self.turns_of_all::<Exact>(vertices, at, counts);
        };
        let place = nodes.borders.place(at);
        if place.quad(start.quad.level()) != start.quad {
            return 0;
        }
        let (mut node, mut level) = (start.node, start.quad.level());
        loop {
            counts.nodes += 1;
            match nodes.nodes[node as usize].kind() {
                Kind::Internal(children) => {
                    level += 1;
                    node = children + place.quarter(level);
                }
                Kind::Full(turns) => return turns,
                Kind::Partial(leaf) => {
                    let corner = nodes.borders.corner(place.quad(level));
                    return nodes.turns_in_leaf::<Exact>(leaf, corner, vertices, at, counts);
                }
            }
        }
    }

    /// As [`Self::winding`], by a machine of single precision: the nodes' borders, the vertices and the point are rounded to it, and so is
    /// all that is computed of them.
    pub fn winding_f32(&self, vertices: &[Plan], start: Start, at: [f32; 2], counts: &mut Counts) -> i32 {
        let at = Plan::new(f64::from(at[0]), f64::from(at[1]));
        if !(holds::<Single>(&self.bounds, at) && self.count > 0) {
            return 0;
        }
        let Some(nodes) = &self.nodes else {
            return self.turns_of_all::<Single>(vertices, at, counts);
        };
        let Start { mut node, mut quad } = start;
        if !holds::<Single>(&nodes.borders.of(quad), at) {
            return 0;
        }
        loop {
            counts.nodes += 1;
            match nodes.nodes[node as usize].kind() {
                Kind::Internal(children) => {
                    let middle = nodes.borders.middle(quad);
                    let is_beyond = |at: f64, line: f64| u16::from(at as f32 >= line as f32);
                    let quarter = is_beyond(at.x, middle.x) + 2 * is_beyond(at.y, middle.y);
                    (node, quad) = (children + u32::from(quarter), quad.child(quarter));
                }
                Kind::Full(turns) => return turns,
                Kind::Partial(leaf) => {
                    let corner = nodes.borders.corner(quad);
                    return nodes.turns_in_leaf::<Single>(leaf, corner, vertices, at, counts);
                }
            }
        }
    }

    /// Calls `visit` with the ends of each edge of a subtree's leaves that meet a box: all that meet the box themselves, and some that miss it; an
    /// edge of several leaves comes several times. Leaves that are clipped tell nothing.
    pub fn edges_near(
        &self,
        vertices: &[Plan],
        start: Start,
        wanted: &SmallBox,
        visit: &mut dyn FnMut(Plan, Plan),
    ) {
        let meets = |plan: &PlanBox| SmallBox::around(plan).meets(wanted);
        let mut visit = |k: u32| visit(vertices[k as usize], vertices[k as usize + 1]);
        let Some(nodes) = &self.nodes else {
            if meets(&self.bounds) {
                (self.first..self.first + self.count).for_each(visit);
            }
            return;
        };
        let Edges::Numbers(edges) = &nodes.edges else { return };
        let mut stack = vec![(start.node, start.quad)];
        while let Some((node, quad)) = stack.pop() {
            if !meets(&nodes.borders.of(quad)) {
                continue;
            }
            match nodes.nodes[node as usize].kind() {
                Kind::Internal(children) => {
                    stack.extend(
                        (0..4u16).map(|quarter| (children + u32::from(quarter), quad.child(quarter))),
                    );
                }
                Kind::Full(_) => {}
                Kind::Partial(leaf) => edges[nodes.edges_of(leaf)].iter().copied().for_each(&mut visit),
            }
        }
    }

    /// The winding number of a point in the ring's box by all edges.
    fn turns_of_all<A: Arithmetic>(&self, vertices: &[Plan], at: Plan, counts: &mut Counts) -> i32 {
        counts.nodes += 1;
        counts.edges += u64::from(self.count);
        let path = &vertices[self.first as usize..][..self.count as usize + 1];
        let corner = Plan::new(self.bounds.max.x, self.bounds.min.y);
        turns_above::<A>(path.windows(2).map(|edge| (edge[0], edge[1])), corner, at)
    }

    /// All nodes, breadth first: rectangle and kind.
    pub fn nodes(&self) -> Vec<(PlanBox, Kind)> {
        let Some(nodes) = &self.nodes else {
            return vec![(self.bounds, if self.count > 0 { Kind::Partial(0) } else { Kind::Full(0) })];
        };
        let mut quads = vec![Quad::ROOT; nodes.nodes.len()];
        for (k, node) in nodes.nodes.iter().enumerate() {
            if let Kind::Internal(children) = node.kind() {
                for quarter in 0..4 {
                    quads[children as usize + usize::from(quarter)] = quads[k].child(quarter);
                }
            }
        }
        let boxes = quads.into_iter().map(|quad| nodes.borders.of(quad));
        boxes.zip(nodes.nodes.iter().map(|node| node.kind())).collect()
    }

    /// The place of a leaf's edges among those of all leaves that edges meet, by its number, and the winding number of its south-east corner.
    /// `None` when the ring is not divided: the leaf has all its edges.
    pub fn leaf(&self, leaf: u32) -> Option<(Range<usize>, i32)> {
        self.nodes.as_ref().map(|nodes| (nodes.edges_of(leaf), nodes.leaves[leaf as usize].corner))
    }

    /// The edges of all leaves, one leaf after another. `None` when the ring is not divided.
    pub fn leaf_edges(&self) -> Option<LeafEdges<'_>> {
        self.nodes.as_ref().map(|nodes| match &nodes.edges {
            Edges::Numbers(numbers) => LeafEdges::Numbers(numbers),
            Edges::Segments(vertices, segments) => LeafEdges::Segments(vertices, segments),
        })
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        size_of::<Self>() + self.nodes.as_ref().map_or(0, |nodes| nodes.bytes())
    }
}

/// Whether a box, with its border, holds a point.
#[inline]
fn holds<A: Arithmetic>(plan: &PlanBox, at: Plan) -> bool {
    let is_between = |low: f64, at: f64, high: f64| {
        let at = A::number(at);
        A::number(low) <= at && at <= A::number(high)
    };
    is_between(plan.min.x, at.x, plan.max.x) && is_between(plan.min.y, at.y, plan.max.y)
}

impl Nodes {
    fn new(path: &[Plan], bounds: &PlanBox, first: u32, limits: Limits, closing: LeafPolygons) -> Self {
        let mut division = divide(path, bounds, limits);
        let edges = match closing {
            LeafPolygons::Corner => Edges::Numbers(division.edges.iter().map(|k| first + k).collect()),
            LeafPolygons::Clipped => {
                let polygons = leaf_polygons(path, &division);
                for (leaf, end) in division.leaves.iter_mut().zip(&polygons.ends) {
                    leaf.end = *end;
                }
                Edges::Segments(polygons.vertices.into(), polygons.segments.into())
            }
        };
        Self {
            borders: division.borders,
            nodes: division.nodes.into(),
            leaves: division.leaves.into(),
            edges,
        }
    }

    /// The smallest subtree that has all that the ring has in a part of its box.
    fn start_in(&self, part: &PlanBox) -> Option<Start> {
        let mut start = self.is_wanted(Start::ROOT, part).then_some(Start::ROOT)?;
        while let Some(children) = self.children(start) {
            let mut wanted = children.into_iter().filter(|child| self.is_wanted(*child, part));
            match (wanted.next(), wanted.next()) {
                (Some(only), None) => start = only,
                _ => break,
            }
        }
        Some(start)
    }

    /// Whether the ring may wind around a point of a part of the ring's box that lies in a subtree.
    fn is_wanted(&self, start: Start, part: &PlanBox) -> bool {
        let level = start.quad.level();
        let (low, high) = (self.borders.place(part.min), self.borders.place(part.max));
        if !start.quad.is_between(low.quad(level), high.quad(level)) {
            return false;
        }
        match self.children(start) {
            Some(children) => children.into_iter().any(|child| self.is_wanted(child, part)),
            None => !matches!(self.nodes[start.node as usize].kind(), Kind::Full(0)),
        }
    }

    pub(super) fn children(&self, start: Start) -> Option<[Start; 4]> {
        let Kind::Internal(children) = self.nodes[start.node as usize].kind() else { return None };
        let child =
            |quarter: u16| Start { node: children + u32::from(quarter), quad: start.quad.child(quarter) };
        Some([child(0), child(1), child(2), child(3)])
    }

    pub(super) fn edges_of(&self, leaf: u32) -> Range<usize> {
        let before = leaf.checked_sub(1).map_or(0, |before| self.leaves[before as usize].end);
        before as usize..self.leaves[leaf as usize].end as usize
    }

    /// The winding number of a point in a leaf whose south-east corner is given.
    #[inline]
    pub(super) fn turns_in_leaf<A: Arithmetic>(
        &self,
        leaf: u32,
        corner: Plan,
        vertices: &[Plan],
        at: Plan,
        counts: &mut Counts,
    ) -> i32 {
        let own = self.edges_of(leaf);
        counts.edges += own.len() as u64;
        match &self.edges {
            Edges::Numbers(numbers) => {
                let edge = |k: &u32| (vertices[*k as usize], vertices[*k as usize + 1]);
                self.leaves[leaf as usize].corner
                    + turns_above::<A>(numbers[own].iter().map(edge), corner, at)
            }
            Edges::Segments(own_vertices, segments) => {
                let segment =
                    |[from, to]: &[u32; 2]| (own_vertices[*from as usize], own_vertices[*to as usize]);
                // Nothing of a closed polygon lies east of the leaf.
                turns_above::<A>(segments[own].iter().map(segment), corner, at)
            }
        }
    }

    fn bytes(&self) -> usize {
        let edges = match &self.edges {
            Edges::Numbers(numbers) => size_of_val(&numbers[..]),
            Edges::Segments(vertices, segments) => size_of_val(&vertices[..]) + size_of_val(&segments[..]),
        };
        size_of::<Self>() + size_of_val(&self.nodes[..]) + size_of_val(&self.leaves[..]) + edges
    }
}
