//! The edges of members, and what turns around a point.

use super::edge::Edge;
use crate::error::Error;
use crate::index::BoxTree;
use crate::space::{Plan, PlanBox};

/// The rings of a polygon.
pub type Rings = Vec<Vec<Plan>>;

/// Fewer vertices enclose nothing.
const FEWEST: usize = 3;

/// The refusal of polygons that would take too long, or too much memory.
pub(super) fn too_often() -> Error {
    Error::unsupported("these polygons lie over one another too often to be united").help(
        "unite them beforehand, as `ogr2ogr -dialect sqlite -sql \"SELECT ST_UnaryUnion(geometry) FROM layer\" united.gpkg file` does, \
         or simplify them, or give each polygon of a multi-polygon a feature of its own",
    )
}

/// Those of some members whose boxes meet another one's.
pub(super) fn entangled(members: &[Rings], among: &[usize]) -> Vec<usize> {
    let around = |member: &usize| PlanBox::around(borders(&members[*member]).flatten().copied());
    let boxes: Vec<PlanBox> = among.iter().map(around).collect();
    let tree = BoxTree::new(&boxes);
    let is_entangled = |k: usize| {
        let own = &boxes[k];
        !own.is_empty() && !tree.query(own, |other| other as usize == k || !own.meets(&boxes[other as usize]))
    };
    (0..among.len()).filter(|k| is_entangled(*k)).map(|k| among[k]).collect()
}

/// The rings that enclose something.
pub(super) fn borders(rings: &Rings) -> impl Iterator<Item = &Vec<Plan>> {
    rings.iter().filter(|ring| ring.len() >= FEWEST)
}

/// The edges of a member.
pub(super) fn of_member(members: &[Rings], member: usize) -> impl Iterator<Item = Edge> {
    borders(&members[member]).flat_map(move |ring| {
        let next = ring.iter().cycle().skip(1);
        ring.iter().zip(next).filter_map(move |(from, to)| Edge::between(member as u32, *from, *to, 1))
    })
}

/// Edges, and a tree of their boxes.
pub(super) struct Edges {
    pub(super) all: Vec<Edge>,
    pub(super) tree: BoxTree,
    east: f64,
}

impl Edges {
    pub(super) fn new(all: Vec<Edge>) -> Self {
        let boxes: Vec<PlanBox> = all.iter().map(Edge::bounds).collect();
        let east = boxes.iter().fold(f64::NEG_INFINITY, |east, plan| crate::math::max(plan.max.x, east));
        Self { tree: BoxTree::new(&boxes), all, east }
    }

    /// Calls `visit` with a member and how often it turns around what is just above a point, for each edge that a line to the east from
    /// there crosses; returns how many edges were looked at.
    pub(super) fn turns_above(&self, at: Plan, mut visit: impl FnMut(u32, i32)) -> usize {
        let level = PlanBox { min: at, max: Plan::new(self.east, at.y) };
        let mut passed = 0;
        self.tree.query(&level, |edge| {
            let edge = &self.all[edge as usize];
            if edge.is_east_of(at) {
                visit(edge.member, edge.turns);
            }
            passed += 1;
            true
        });
        passed
    }
}
