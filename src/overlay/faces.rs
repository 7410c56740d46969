//! What lies on the sides of edges that meet at their ends alone, found by walking from face to face.
//!
//! From a vertex to the next, and around each: every edge is crossed from either end, and what turns around a face changes by what is crossed.
//! Only where a walk starts, once for all edges that hang together, is it asked what turns around the place.

use super::edge::{Edge, order};
use super::edges::{Edges, too_often};
use crate::error::Result;
use crate::predicate::orient2d;
use crate::space::Plan;
use std::cmp::Ordering;
use std::ops::Range;

/// Edges that are looked at where walks start, all together.
const MOST_PASSED: usize = 1 << 28;

/// Which side of a piece is in a member, where the other is in none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Side {
    /// Both, or neither.
    Same,
    /// The left one alone, and one of the members that it is in.
    Left(u32),
    /// The right one alone, and one of the members that it is in.
    Right(u32),
}

/// What is known of edges after the walk.
pub(super) struct Sides {
    /// Edges that lie upon one another are one piece: the number of its first one, and its sides.
    pub(super) pieces: Vec<(usize, Side)>,
    /// Which members share a point inside with another, or lie along an edge of another on its other side.
    pub(super) takes_part: Vec<bool>,
}

/// A piece as it leaves a vertex.
struct Half {
    from: Plan,
    to: Plan,
    piece: u32,
    is_up: bool,
}

impl Half {
    /// Vertex by vertex; of one vertex against the clock from the east.
    fn order(&self, other: &Self) -> Ordering {
        let turn = || 0.0.partial_cmp(&orient2d(self.from, self.to, other.to)).unwrap_or(Ordering::Equal);
        order(self.from, other.from).then(other.is_up.cmp(&self.is_up)).then_with(turn)
    }
}

/// A vertex that the walk goes around.
struct Visit {
    halves: Range<usize>,
    /// The next one to cross.
    at: usize,
    left: usize,
}

/// What lies on the sides of edges of so many members.
///
/// # Errors
/// When too many lie beside the places where walks start.
pub(super) fn sides(edges: &Edges, members: usize, is_inside: &dyn Fn(i32) -> bool) -> Result<Sides> {
    let groups: Vec<&[Edge]> = edges.all.chunk_by(|a, b| a.low == b.low && a.high == b.high).collect();
    let halves = halves(&groups);
    // Where the halves of a piece are: the one that goes down, the one that goes up.
    let mut places = vec![[0; 2]; groups.len()];
    // Where the halves of a half's vertex start.
    let mut starts = vec![0; halves.len()];
    let mut ends = vec![0; halves.len()];
    let mut start = 0;
    for fan in halves.chunk_by(|a, b| a.from == b.from) {
        ends[start] = start + fan.len();
        for (k, half) in (start..).zip(fan) {
            places[half.piece as usize][usize::from(half.is_up)] = k;
            starts[k] = start;
        }
        start += fan.len();
    }
    let mut is_visited = vec![false; halves.len()];
    let mut visit = |at: usize| {
        let start = starts[at];
        let halves = start..ends[start];
        let left = halves.len();
        (!std::mem::replace(&mut is_visited[start], true)).then_some(Visit { halves, at, left })
    };
    let mut found = vec![Side::Same; groups.len()];
    let mut face = Face::new(members, is_inside);
    let mut passed = 0;
    for start in 0..halves.len() {
        let Some(first) = visit(start) else { continue };
        face.clear();
        // Right of all that go up from there and left of all that go down: where the first one is next.
        passed += edges.turns_above(halves[start].from, |member, turns| face.start(member, turns));
        if passed > MOST_PASSED {
            return Err(too_often());
        }
        let mut way = vec![first];
        while let Some(here) = way.last_mut() {
            // All around, the face is the one that the walk came by.
            if here.left == 0 {
                way.pop();
                continue;
            }
            let half = &halves[here.at];
            here.left -= 1;
            here.at = if here.at + 1 == here.halves.end { here.halves.start } else { here.at + 1 };
            let side = face.cross(groups[half.piece as usize], half.is_up);
            if half.is_up {
                found[half.piece as usize] = side;
            }
            way.extend(visit(places[half.piece as usize][usize::from(!half.is_up)]));
        }
    }
    let mut first = 0;
    let pieces = groups.iter().zip(found).map(|(group, side)| {
        first += group.len();
        (first - group.len(), side)
    });
    Ok(Sides { pieces: pieces.collect(), takes_part: face.takes_part })
}

fn halves(groups: &[&[Edge]]) -> Vec<Half> {
    let of_piece = |(piece, group): (u32, &&[Edge])| {
        let Edge { low, high, .. } = group[0];
        [Half { from: low, to: high, piece, is_up: true }, Half { from: high, to: low, piece, is_up: false }]
    };
    let mut halves: Vec<Half> = (0..).zip(groups).flat_map(of_piece).collect();
    halves.sort_by(Half::order);
    halves
}

/// The face that the walk is in.
struct Face<'a> {
    is_inside: &'a dyn Fn(i32) -> bool,
    /// How often each member turns around it.
    turns: Vec<i32>,
    /// Those that turned around the place where the walk started.
    started: Vec<u32>,
    /// How many members it is in.
    held: usize,
    /// Members that it may be in, of which it is not known yet that they take part: all such ones that it is in.
    unknown: Vec<u32>,
    takes_part: Vec<bool>,
    /// Those that the last crossing led into or out of.
    changed: Vec<u32>,
}

impl<'a> Face<'a> {
    fn new(members: usize, is_inside: &'a dyn Fn(i32) -> bool) -> Self {
        Self {
            is_inside,
            turns: vec![0; members],
            started: Vec::new(),
            held: 0,
            unknown: Vec::new(),
            takes_part: vec![false; members],
            changed: Vec::new(),
        }
    }

    /// The face far away from all.
    fn clear(&mut self) {
        for member in self.started.drain(..) {
            self.turns[member as usize] = 0;
        }
        self.unknown.clear();
        self.held = 0;
    }

    fn start(&mut self, member: u32, turns: i32) {
        self.started.push(member);
        self.add(member, turns);
    }

    /// Adds turns of a member; whether it led into it or out of it.
    fn add(&mut self, member: u32, turns: i32) -> bool {
        let own = &mut self.turns[member as usize];
        let was_in = (self.is_inside)(*own);
        *own += turns;
        let is_in = (self.is_inside)(*own);
        if is_in && !was_in {
            self.held += 1;
            if !self.takes_part[member as usize] {
                self.unknown.push(member);
            }
        } else if was_in && !is_in {
            self.held -= 1;
        }
        is_in != was_in
    }

    /// Crosses a piece to the left of the way along it, up or down; its sides, as seen on the way up.
    fn cross(&mut self, piece: &[Edge], is_up: bool) -> Side {
        let right = self.held;
        self.changed.clear();
        for edge in piece {
            if self.add(edge.member, if is_up { edge.turns } else { -edge.turns }) {
                self.changed.push(edge.member);
            }
        }
        let left = self.held;
        if left > 1 {
            for member in self.unknown.drain(..) {
                self.takes_part[member as usize] |= (self.is_inside)(self.turns[member as usize]);
            }
        }
        if left > 0 && right > 0 {
            // Out of one and into another; or what is in more than one, which is known.
            self.changed.iter().for_each(|member| self.takes_part[*member as usize] = true);
        }
        match (left > 0, right > 0, self.changed.first()) {
            (true, false, Some(member)) => Side::Left(*member),
            (false, true, Some(member)) => Side::Right(*member),
            _ => Side::Same,
        }
    }
}
