//! The polylines, and which parts of them may meet a square.
//!
//! Input: points in grid coordinates. Output: [`Chains`]. Refuses: nothing.

use super::grid::{GridPoint, Square};
use crate::index::BoxTree;
use crate::space::{Plan, PlanBox};

/// Segments of which it is known together whether they may meet a square.
const SEGMENTS: usize = 32;

/// Coordinates beyond are taken to be here, and those nearer to 0 than its reciprocal to be 0: products of them stay exact.
const FARTHEST: f64 = (1u128 << 100) as f64;

/// A polyline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Chain {
    /// What it is to whoever draws it.
    pub id: u32,
    /// Its first point.
    first: u32,
    /// How many it has.
    count: u32,
}

/// All polylines.
#[derive(Debug, Default)]
pub struct Chains {
    points: Vec<GridPoint>,
    chains: Vec<Chain>,
    /// Consecutive segments of a chain: chain, first point.
    pieces: Vec<[u32; 2]>,
    /// Over the boxes of `pieces`.
    tree: BoxTree,
}

impl Chains {
    /// Polylines: what they are (an id that comes back with the clippings) and their points, which are finite. A closed one ends with its
    /// first point.
    pub fn new<P: IntoIterator<Item = GridPoint>>(lines: impl IntoIterator<Item = (u32, P)>) -> Self {
        let mut all = Self::default();
        let mut boxes = Vec::new();
        for (id, points) in lines {
            let first = all.points.len();
            all.points.extend(points.into_iter().map(|point| point.map(as_known)));
            let (number, count) = (all.chains.len() as u32, all.points.len() - first);
            all.chains.push(Chain { id, first: first as u32, count: count as u32 });
            for start in (0..count.saturating_sub(1).max(count.min(1))).step_by(SEGMENTS) {
                let piece = &all.points[first + start..first + count.min(start + SEGMENTS + 1)];
                boxes.push(PlanBox::around(piece.iter().map(|&[x, y]| Plan::new(x, y))));
                all.pieces.push([number, start as u32]);
            }
        }
        all.tree = BoxTree::new(&boxes);
        all
    }

    /// The polylines, in the order they came.
    pub fn all(&self) -> &[Chain] {
        &self.chains
    }

    /// The points of a polyline.
    pub fn points_of(&self, chain: &Chain) -> &[GridPoint] {
        &self.points[chain.first as usize..][..chain.count as usize]
    }

    /// Parts of chains that hold all that meets a square, in their order: number of the chain, its point where the part begins, and the part's
    /// points. Where a part ends and its chain goes on, the chain is outside of the square.
    pub(super) fn near(&self, square: Square) -> Vec<(u32, u32, &[GridPoint])> {
        let corner = |post: [u32; 2]| Plan::new(f64::from(post[0]), f64::from(post[1]));
        let [low, high] = square.corners();
        let mut found = Vec::new();
        self.tree.query(&PlanBox::around([corner(low), corner(high)]), |piece| {
            found.push(self.pieces[piece as usize]);
            true
        });
        found.sort_unstable();
        let follows = |a: &[u32; 2], b: &[u32; 2]| a[0] == b[0] && a[1] + SEGMENTS as u32 == b[1];
        let part = |pieces: &[[u32; 2]]| {
            let ([number, first], last) = (pieces[0], pieces[pieces.len() - 1][1] as usize);
            let points = self.points_of(&self.chains[number as usize]);
            (number, first, &points[first as usize..points.len().min(last + SEGMENTS + 1)])
        };
        found.chunk_by(follows).map(part).collect()
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        let own = size_of_val(&self.points[..]) + size_of_val(&self.chains[..]);
        own + size_of_val(&self.pieces[..]) + self.tree.bytes()
    }
}

/// A coordinate that predicates are exact for.
fn as_known(v: f64) -> f64 {
    if v.abs() < 1.0 / FARTHEST { 0.0 } else { v.clamp(-FARTHEST, FARTHEST) }
}
