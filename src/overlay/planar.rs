//! Edges cut until they meet at their ends alone, and what of them bounds a union.

use super::contact::{Contact, contact};
use super::edge::{Edge, order};
use super::edges::{Edges, Rings, too_often};
use super::faces::{Side, Sides};
use crate::error::Result;
use crate::space::Plan;

/// Rounds of cutting: the second finds what the first one's rounding made cross, and hardly any is left for a third.
const MOST_ROUNDS: usize = 64;

/// Pairs of edges that are compared at most: so many, and so many for each edge. Boxes of neighbours meet; that of each edge meets those of
/// many others only where much lies over much, and then whoever waits for it is told within seconds.
const MOST_PAIRS: usize = 1 << 25;
const MOST_PAIRS_OF_AN_EDGE: usize = 32;

/// Pieces that edges are cut into.
const MOST_PIECES: usize = 1 << 22;

/// The edges cut where they meet: each one's pieces meet others at their ends alone, and equal ones of a member are one.
pub(super) fn cut(edges: Vec<Edge>) -> Result<Edges> {
    let mut pieces: Vec<(Edge, bool)> = edges.into_iter().map(|edge| (edge, true)).collect();
    let mut pairs = pieces.len().saturating_mul(MOST_PAIRS_OF_AN_EDGE).saturating_add(MOST_PAIRS);
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

/// The rings around what is inside of those members that `is_of` names, on their left; of those that share more than points,
/// all or none.
pub(super) fn border(edges: &Edges, sides: &Sides, is_of: impl Fn(u32) -> bool) -> Rings {
    let directed = sides.pieces.iter().filter_map(|(first, side)| {
        let Edge { low, high, .. } = edges.all[*first];
        match side {
            Side::Left(member) if is_of(*member) => Some((low, high)),
            Side::Right(member) if is_of(*member) => Some((high, low)),
            _ => None,
        }
    });
    rings(directed.collect())
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
