//! The edges of members, and what lies around a point of them.

use super::contact::contact;
use super::edge::Edge;
use crate::index::BoxTree;
use crate::space::{Plan, PlanBox};

/// The rings of a polygon.
pub type Rings = Vec<Vec<Plan>>;

/// Pairs of edges that are compared at most.
pub(super) const MOST_PAIRS: usize = 1 << 28;

/// Fewer vertices enclose nothing.
const FEWEST: usize = 3;

/// The members whose boxes overlap with another's.
pub(super) fn entangled(members: &[Rings]) -> Vec<usize> {
    let around = |rings: &Rings| PlanBox::around(borders(rings).flatten().copied());
    let boxes: Vec<PlanBox> = members.iter().map(around).collect();
    let overlap = |a: &PlanBox, b: &PlanBox| {
        a.min.x < b.max.x && b.min.x < a.max.x && a.min.y < b.max.y && b.min.y < a.max.y
    };
    let tree = BoxTree::new(&boxes);
    let is_entangled = |member: &usize| {
        let own = &boxes[*member];
        !tree.query(own, |other| other as usize == *member || !overlap(own, &boxes[other as usize]))
    };
    (0..members.len()).filter(|member| !boxes[*member].is_empty() && is_entangled(member)).collect()
}

fn borders(rings: &Rings) -> impl Iterator<Item = &Vec<Plan>> {
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

    /// Whether edges of different members share a point; true also where that would take long to know.
    pub(super) fn are_in_contact(&self) -> bool {
        let mut pairs = MOST_PAIRS;
        self.all.iter().any(|edge| {
            !self.tree.query(&edge.bounds(), |other| {
                let other = &self.all[other as usize];
                pairs -= 1;
                pairs > 0 && (other.member == edge.member || contact(edge, other).is_none())
            })
        })
    }

    /// Whether a ring of a member lies in another member, where edges of different ones share no point.
    pub(super) fn lie_in_another(
        &self,
        members: &[Rings],
        among: &[usize],
        is_inside: &(dyn Fn(i32) -> bool + Sync),
    ) -> bool {
        let mut around = Windings::default();
        let mut lies_in_another = |member: u32, at: Plan| {
            self.turns_around(at, None, &mut around);
            around.0.iter().any(|(other, turns)| *other != member && is_inside(*turns))
        };
        among
            .iter()
            .any(|&member| borders(&members[member]).any(|ring| lies_in_another(member as u32, ring[0])))
    }

    /// How often each member turns around what is just above a point; `along`: and just right of the way to another one, where edges
    /// share ends alone.
    pub(super) fn turns_around(&self, at: Plan, along: Option<Plan>, windings: &mut Windings) {
        windings.0.clear();
        let level = PlanBox { min: at, max: Plan::new(self.east, at.y) };
        self.tree.query(&level, |edge| {
            let edge = &self.all[edge as usize];
            if edge.is_east_of(at, along) {
                windings.add(edge.member, edge.turns);
            }
            true
        });
    }
}

/// How often members turn around a place: those that do, in their order.
#[derive(Debug, Default)]
pub(super) struct Windings(pub(super) Vec<(u32, i32)>);

impl Windings {
    pub(super) fn add(&mut self, member: u32, turns: i32) {
        match self.0.binary_search_by_key(&member, |entry| entry.0) {
            Ok(at) => self.0[at].1 += turns,
            Err(at) => self.0.insert(at, (member, turns)),
        }
    }
}
