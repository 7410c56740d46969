//! A ring divided: breadth first, with a queue.

use super::borders::{Borders, DEEPEST, Quad};
use super::crossing::{Exact, turns_above};
use super::node::{Kind, Leaf, Node};
use crate::math::{max, min};
use crate::space::{Plan, PlanBox};

/// When a node is divided no further (Zechmeister 2020, section 4.2.1; tried in section 5.2.3).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// The most edges of a leaf, but at the deepest level; 0 counts as 1.
    pub capacity: u32,
    /// The deepest level; more than 16 counts as 16.
    pub depth: u32,
}

/// The edges in undecided nodes for each of the ring's, when the ring is divided no further. Rings of maps have up to eight (a vertex's two
/// edges in four nodes); thousands of needles side by side would need memory without end. The answers are the same.
const MOST_ENTRIES_AN_EDGE: usize = 32;

/// So many are always well.
const FEW_ENTRIES: usize = 1 << 16;

/// A divided ring.
#[derive(Debug)]
pub(super) struct Division {
    pub(super) borders: Borders,
    /// Breadth first; the root is the first.
    pub(super) nodes: Vec<Node>,
    /// In the order of their nodes.
    pub(super) leaves: Vec<Leaf>,
    /// The edges of the leaves, each by the place of its first vertex in the ring.
    pub(super) edges: Vec<u32>,
}

/// A node in the queue.
struct Waiting {
    node: u32,
    quad: Quad,
    /// The winding number of its south-east corner.
    corner: i32,
    /// Behind its last edge among those of its level.
    end: usize,
}

/// Divides a ring whose box has an area.
pub(super) fn divide(path: &[Plan], bounds: &PlanBox, limits: Limits) -> Division {
    let edge = |k: u32| (path[k as usize], path[k as usize + 1]);
    let (capacity, depth) = (limits.capacity.max(1) as usize, limits.depth);
    let borders = Borders::new(bounds);
    let (mut nodes, mut leaves, mut edges) = (vec![Node::new(Kind::Full(0))], Vec::new(), Vec::new());
    // An edge of no length is never crossed.
    let mut current: Vec<u32> = (0..path.len() as u32 - 1).filter(|k| edge(*k).0 != edge(*k).1).collect();
    let most_entries = MOST_ENTRIES_AN_EDGE * current.len() + FEW_ENTRIES;
    // East of the root's box, and so at its corner, there is nothing to wind around.
    let mut queue = vec![Waiting { node: 0, quad: Quad::ROOT, corner: 0, end: current.len() }];
    let mut quarters: [Vec<u32>; 4] = Default::default();
    while !queue.is_empty() {
        // Leaves count their edges in 32 bits; a division makes four entries of one at most.
        let is_countable = edges.len() + 4 * current.len() < u32::MAX as usize && nodes.len() < Node::MOST;
        let goes_on = is_countable && current.len() <= most_entries;
        let (mut below, mut next, mut begin) = (Vec::new(), Vec::new(), 0);
        for waiting in &queue {
            let own = &current[begin..waiting.end];
            begin = waiting.end;
            let is_leaf = own.len() <= capacity
                || u32::from(waiting.quad.level()) >= depth.min(u32::from(DEEPEST))
                || !goes_on;
            let cut = (!is_leaf).then(|| Cut::new(&borders, waiting.quad)).filter(Cut::has_an_area);
            let Some(cut) = cut else {
                nodes[waiting.node as usize] = match own.is_empty() {
                    true => Node::new(Kind::Full(waiting.corner)),
                    false => {
                        edges.extend_from_slice(own);
                        leaves.push(Leaf { end: edges.len() as u32, corner: waiting.corner });
                        Node::new(Kind::Partial(leaves.len() as u32 - 1))
                    }
                };
                continue;
            };
            quarters.iter_mut().for_each(Vec::clear);
            for k in own {
                let (a, b) = edge(*k);
                let met = cut.quarters_met(a, b);
                for (quarter, entries) in quarters.iter_mut().enumerate() {
                    if met[quarter] {
                        entries.push(*k);
                    }
                }
            }
            let children = nodes.len() as u32;
            nodes[waiting.node as usize] = Node::new(Kind::Internal(children));
            nodes.resize(nodes.len() + 4, Node::new(Kind::Full(0)));
            // The corners of all quarters lie on the border of the one in the south-east: its edges say how they differ.
            let south_east = || quarters[1].iter().map(|k| edge(*k));
            for (quarter, entries) in (0..).zip(&quarters) {
                let quad = waiting.quad.child(quarter);
                let at = cut.corner(quarter);
                let turns = turns_above::<Exact>(south_east(), cut.corner(1), at);
                next.extend_from_slice(entries);
                let node = children + u32::from(quarter);
                below.push(Waiting { node, quad, corner: waiting.corner + turns, end: next.len() });
            }
        }
        (queue, current) = (below, next);
    }
    Division { borders, nodes, leaves, edges }
}

/// A node's borders and those between its quarters, from west to east and from south to north.
struct Cut {
    x: [f64; 3],
    y: [f64; 3],
}

impl Cut {
    fn new(borders: &Borders, quad: Quad) -> Self {
        let (whole, middle) = (borders.of(quad), borders.middle(quad));
        Self { x: [whole.min.x, middle.x, whole.max.x], y: [whole.min.y, middle.y, whole.max.y] }
    }

    /// Whether all quarters have an area: a node of a few units in the last place is divided no further.
    fn has_an_area(&self) -> bool {
        [self.x, self.y].iter().all(|[low, middle, high]| low < middle && middle < high)
    }

    /// The south-east corner of a quarter.
    fn corner(&self, quarter: u16) -> Plan {
        Plan::new(self.x[1 + usize::from(quarter % 2)], self.y[usize::from(quarter / 2)])
    }

    /// Which quarters, with their borders, an edge meets that meets the node: at least these.
    #[inline]
    fn quarters_met(&self, a: Plan, b: Plan) -> [bool; 4] {
        let (middle_x, middle_y) = (self.x[1], self.y[1]);
        let column = [min(a.x, b.x) <= middle_x, middle_x <= max(a.x, b.x)];
        let row = [min(a.y, b.y) <= middle_y, middle_y <= max(a.y, b.y)];
        let mut met = [column[0] && row[0], column[1] && row[0], column[0] && row[1], column[1] && row[1]];
        // An edge whose box meets one quarter meets the node there; one that is upright or level is its box.
        let is_in_one = column != [true; 2] && row != [true; 2];
        if is_in_one || a.x == b.x || a.y == b.y {
            return met;
        }
        // Separating axes: the edge's line has all of a quarter on one side. A point's side is u - v.
        let (dx, dy) = (b.x - a.x, b.y - a.y);
        let u = self.y.map(|y| dx * (y - a.y));
        let v = self.x.map(|x| dy * (x - a.x));
        // Each product has four roundings, and each difference one; products may be too small for doubles.
        let largest = max(u[0].abs(), u[2].abs()) + max(v[0].abs(), v[2].abs());
        let error = 8.0 * f64::EPSILON * largest + f64::MIN_POSITIVE;
        for (quarter, met) in met.iter_mut().enumerate() {
            let (i, j) = (quarter % 2, quarter / 2);
            let highest = max(u[j], u[j + 1]) - min(v[i], v[i + 1]);
            let lowest = min(u[j], u[j + 1]) - max(v[i], v[i + 1]);
            // Not a number: it may meet it.
            if highest < -error || lowest > error {
                *met = false;
            }
        }
        met
    }
}
