//! Edges cut until they meet at their ends alone, and what of them bounds a union.

use super::contact::{Contact, contact};
use super::edge::{Edge, order};
use super::edges::{Edges, MOST_PAIRS, Rings, Windings};
use crate::error::{Error, Result};
use crate::parallel;
use crate::space::Plan;

/// Rounds of cutting: the second finds what the first one's rounding made cross, and hardly any is left for a third.
const MOST_ROUNDS: usize = 64;

/// Pieces that edges are cut into.
const MOST_PIECES: usize = 1 << 22;

fn too_often() -> Error {
    Error::unsupported("these polygons cross one another too often to be united")
        .help("repair or simplify them; give each polygon of a multi-polygon a feature of its own")
}

/// The edges cut where they meet: each one's pieces meet others at their ends alone, and equal ones of a member are one.
pub(super) fn cut(edges: Edges) -> Result<Edges> {
    let mut pieces: Vec<(Edge, bool)> = edges.all.into_iter().map(|edge| (edge, true)).collect();
    let mut pairs = MOST_PAIRS;
    for _ in 0..MOST_ROUNDS {
        merge(&mut pieces);
        let (all, is_new): (Vec<Edge>, Vec<bool>) = pieces.into_iter().unzip();
        let edges = Edges::new(all);
        let cuts = cuts(&edges, &is_new, &mut pairs)?;
        if cuts.is_empty() {
            return Ok(edges);
        }
        pieces = Vec::with_capacity(edges.all.len() + cuts.len());
        let mut cuts = cuts.as_slice();
        for (k, edge) in (0..).zip(&edges.all) {
            let own = cuts.partition_point(|(edge, _)| *edge <= k);
            let (at, rest) = cuts.split_at(own);
            cuts = rest;
            add_pieces(edge, at, &mut pieces);
        }
    }
    Err(too_often())
}

/// Where edges are to be cut, by edge: only pairs with a new one are compared.
fn cuts(edges: &Edges, is_new: &[bool], pairs: &mut usize) -> Result<Vec<(u32, Plan)>> {
    let mut cuts: Vec<(u32, Plan)> = Vec::new();
    for (k, edge) in (0..).zip(&edges.all).filter(|(k, _)| is_new[*k as usize]) {
        let has_budget = edges.tree.query(&edge.bounds(), |other| {
            // Of two new ones, the first asks.
            if other == k || other < k && is_new[other as usize] {
                return true;
            }
            let found = contact(edge, &edges.all[other as usize]);
            let mut cut = |edge: u32, at: Plan| {
                let Edge { low, high, .. } = edges.all[edge as usize];
                if at != low && at != high {
                    cuts.push((edge, at));
                }
            };
            match found {
                Some(Contact::Crossing(at)) => {
                    cut(k, at);
                    cut(other, at);
                }
                Some(Contact::Touch { in_first, in_second }) => {
                    in_first.into_iter().flatten().for_each(|at| cut(k, at));
                    in_second.into_iter().flatten().for_each(|at| cut(other, at));
                }
                Some(Contact::Ends) | None => {}
            }
            *pairs -= 1;
            *pairs > 0 && cuts.len() < MOST_PIECES
        });
        if !has_budget {
            return Err(too_often());
        }
    }
    cuts.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(order(a.1, b.1)));
    cuts.dedup();
    Ok(cuts)
}

/// The pieces of an edge that is cut at some points, in their order along it.
fn add_pieces(edge: &Edge, at: &[(u32, Plan)], pieces: &mut Vec<(Edge, bool)>) {
    let mut from = edge.low;
    let ends = at.iter().map(|(_, at)| *at).chain([edge.high]);
    for to in ends {
        let piece = Edge::between(edge.member, from, to, edge.turns);
        pieces.extend(piece.map(|piece| (piece, !at.is_empty())));
        from = to;
    }
}

/// Makes equal pieces of a member one; those that its rings run up as often as down bound nothing of it.
fn merge(pieces: &mut Vec<(Edge, bool)>) {
    let place =
        |a: &Edge, b: &Edge| order(a.low, b.low).then(order(a.high, b.high)).then(a.member.cmp(&b.member));
    pieces.sort_by(|a, b| place(&a.0, &b.0));
    pieces.dedup_by(|later, kept| {
        let is_same = place(&later.0, &kept.0).is_eq();
        if is_same {
            kept.0.turns += later.0.turns;
            kept.1 |= later.1;
        }
        is_same
    });
    pieces.retain(|(edge, _)| edge.turns != 0);
}

/// Pieces of edges, each once, and how many members hold what is on each of its sides.
pub(super) struct Sides {
    pieces: Vec<(Plan, Plan)>,
    /// Left and right of each piece.
    held: Vec<(usize, usize)>,
}

/// The sides of edges that meet at their ends alone.
pub(super) fn sides(edges: &Edges, is_inside: &(dyn Fn(i32) -> bool + Sync)) -> Sides {
    // Those of several members that lie upon one another are one piece of the border.
    let is_same = |a: &Edge, b: &Edge| a.low == b.low && a.high == b.high;
    let groups: Vec<&[Edge]> = edges.all.chunk_by(is_same).collect();
    let held = parallel::map(&groups, |group| {
        let Edge { low, high, .. } = group[0];
        let mut windings = Windings::default();
        let count = |windings: &Windings| windings.0.iter().filter(|(_, turns)| is_inside(*turns)).count();
        edges.turns_around(low, Some(high), &mut windings);
        let right = count(&windings);
        group.iter().for_each(|edge| windings.add(edge.member, edge.turns));
        (count(&windings), right)
    });
    Sides { pieces: groups.iter().map(|group| (group[0].low, group[0].high)).collect(), held }
}

impl Sides {
    /// Whether a point is in two members.
    pub(super) fn overlap(&self) -> bool {
        self.held.iter().any(|(left, right)| *left > 1 || *right > 1)
    }

    /// The rings around what is inside of any member, on their left.
    pub(super) fn border(&self) -> Rings {
        let directed = self.pieces.iter().zip(&self.held).filter_map(|((low, high), (left, right))| {
            match (*left > 0, *right > 0) {
                (true, false) => Some((*low, *high)),
                (false, true) => Some((*high, *low)),
                _ => None,
            }
        });
        rings(directed.collect())
    }
}

/// Edges, of which as many leave each vertex as come to it, put together to rings.
fn rings(mut edges: Vec<(Plan, Plan)>) -> Rings {
    edges.sort_unstable_by(|a, b| order(a.0, b.0).then(order(a.1, b.1)));
    // How many of those that leave a vertex have been taken, at the place of its first one.
    let mut taken = vec![0; edges.len()];
    let mut leave = |vertex: Plan| {
        let start = edges.partition_point(|(from, _)| order(*from, vertex).is_lt());
        let (_, to) = edges.get(start + taken.get(start)?).filter(|(from, _)| *from == vertex)?;
        taken[start] += 1;
        Some(*to)
    };
    let mut rings = Vec::new();
    for (start, _) in &edges {
        let mut ring = Vec::new();
        let mut at = *start;
        while let Some(to) = leave(at) {
            ring.push(at);
            at = to;
        }
        if !ring.is_empty() {
            rings.push(ring);
        }
    }
    rings
}
