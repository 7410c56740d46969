//! What of the items matters to a box of the plan: N, P or F of each (tile, then block).
//!
//! An item that covers nothing of the box (N) is left out. One with edges or segments near is P, with the winding number of its area's border
//! at one place; one that covers all of it (F) hides what lies below, if it is opaque.

use super::boxes::{Held, corners_of, held, odd_place};
use super::features::{Edge, Features, Stroked, crossing};
use super::look::{Looks, even_half};
use super::pieces::{self, HalfWidth, Pieces, stroke_pieces};
use crate::scene::Line;
use crate::space::{Lens, Plan, PlanBox};
use glam::DVec2;
use std::ops::Range;

/// An item near a box.
#[derive(Debug, Clone)]
pub(super) struct Local {
    pub(super) item: u32,
    /// How often its area's border turns around [`Near::at`].
    turns: i32,
    edges: Range<u32>,
    strokes: Range<u32>,
    /// The pieces of its stroke, where they are made for all of the box; it has no segments then.
    pieces: Range<u32>,
    /// Whether its stroke covers all of the box.
    pub(super) is_held: bool,
}

impl Local {
    /// Whether it covers all of the box.
    fn is_plain(&self) -> bool {
        self.edges.is_empty() && self.strokes.is_empty() && self.pieces.is_empty()
    }
}

/// The items that may cover some of a box of the plan, in draw order.
#[derive(Debug)]
pub(super) struct Near {
    plan: PlanBox,
    /// Where winding numbers are known: a place in the box.
    at: Plan,
    pub(super) items: Vec<Local>,
    edges: Vec<Edge>,
    strokes: Vec<Stroked>,
    /// Where each piece's corners end, and the box around them.
    pieces: Vec<(u32, PlanBox)>,
    corners: Vec<Plan>,
    is_plain: bool,
}

impl Default for Near {
    fn default() -> Self {
        Self {
            plan: PlanBox::EMPTY,
            at: Plan::default(),
            items: Vec::new(),
            edges: Vec::new(),
            strokes: Vec::new(),
            pieces: Vec::new(),
            corners: Vec::new(),
            is_plain: true,
        }
    }
}

impl Near {
    /// What of all items matters to a box; `most` is half the width that a stroke of one pixel has there at most.
    pub(super) fn find(&mut self, features: &Features, looks: &Looks, plan: &PlanBox, most: f64) {
        self.clear(plan);
        features.edges_near(plan, |edge| self.edges.push(edge));
        features.strokes_near(plan, most, |stroked| self.strokes.push(stroked));
        // Those of both kinds of widths come one after the other.
        self.strokes.sort_by_key(|stroked| stroked.item);
        let mut turns: Vec<(u32, i32)> = Vec::new();
        features.crossings_east_of(self.at, |item, turn| turns.push((item, turn)));
        turns.sort_by_key(|(item, _)| *item);
        let of_edges = self.edges.iter().map(|edge| edge.item);
        let of_strokes = self.strokes.iter().map(|stroked| stroked.item);
        let mut items: Vec<u32> =
            of_edges.chain(of_strokes).chain(turns.iter().map(|(item, _)| *item)).collect();
        items.sort_unstable();
        items.dedup();
        for item in items {
            let edges = range_of(&self.edges, item, |edge| edge.item);
            let strokes = range_of(&self.strokes, item, |stroked| stroked.item);
            let own = range_of(&turns, item, |(item, _)| *item);
            let turns = turns[own.start as usize..own.end as usize].iter().map(|(_, turn)| turn).sum();
            self.keep(looks, Local { item, turns, edges, strokes, pieces: 0..0, is_held: false });
        }
        self.look_anew();
    }

    /// What of what matters to a box matters to a smaller one in it.
    pub(super) fn narrow(&self, looks: &Looks, plan: &PlanBox, out: &mut Self) {
        out.clear(plan);
        let corners = corners_of(plan);
        for local in &self.items {
            let (edges, strokes) = (out.edges.len() as u32, out.strokes.len() as u32);
            let turns = self.turns_at(local, out.at);
            let near = self.edges(local).iter().filter(|edge| edge.meets(plan));
            out.edges.extend(near);
            let mut is_held = local.is_held;
            let pieces = out.pieces.len() as u32;
            for (ring, around) in self.pieces(local) {
                if !around.meets(plan) {
                    continue;
                }
                match held(ring, &corners) {
                    Held::None => {}
                    Held::Some => {
                        out.corners.extend_from_slice(ring);
                        out.pieces.push((out.corners.len() as u32, *around));
                    }
                    Held::All => is_held = true,
                }
                if is_held {
                    out.forget_pieces(pieces);
                    break;
                }
            }
            if !is_held {
                let near = self.strokes(local).iter().filter(|stroked| stroked.meets(plan));
                out.strokes.extend(near);
            }
            let (edges, strokes) = (edges..out.edges.len() as u32, strokes..out.strokes.len() as u32);
            let pieces = pieces..out.pieces.len() as u32;
            out.keep(looks, Local { item: local.item, turns, edges, strokes, pieces, is_held });
        }
        out.look_anew();
    }

    /// Whether no edge, segment or piece may meet a box, so that each item covers all of it or nothing.
    pub(super) fn is_clear(&self, plan: &PlanBox) -> bool {
        !self.edges.iter().any(|edge| edge.meets(plan))
            && !self.pieces.iter().any(|(_, around)| around.meets(plan))
            && !self.strokes.iter().any(|stroked| stroked.meets(plan))
    }

    /// Forgets the pieces from a number on.
    fn forget_pieces(&mut self, first: u32) {
        self.pieces.truncate(first as usize);
        self.corners.truncate(self.pieces.last().map_or(0, |(end, _)| *end as usize));
    }

    fn look_anew(&mut self) {
        self.is_plain = self.items.iter().all(Local::is_plain);
    }

    /// Whether an item has a stroke near.
    pub(super) fn has_strokes(&self) -> bool {
        !self.strokes.is_empty()
    }

    /// Makes the pieces of strokes that are as wide everywhere in the box; `sagitta`: how far a chord may be off, metres.
    pub(super) fn make_pieces(&mut self, looks: &Looks, lens: Lens, sagitta: f64, room: &mut Pieces) {
        let around = pieces::Near { plan: self.plan, sagitta };
        for local in std::mem::take(&mut self.items) {
            let look = looks.of(local.item);
            let half = look.line.as_ref().and_then(|line| even_half(line, lens));
            let Some((line, half)) = look.line.as_ref().zip(half) else {
                self.items.push(local);
                continue;
            };
            let half = HalfWidth { at: self.plan.min, half, gradient: DVec2::ZERO };
            let Some(local) = self.with_pieces(local, (line, &half), &around, room) else { continue };
            if local.is_held && local.edges.is_empty() && look.is_opaque {
                self.items.clear();
            }
            self.items.push(local);
        }
        self.look_anew();
    }

    /// An item with the pieces of its stroke in place of its segments; `None`: it covers nothing of the box.
    fn with_pieces(
        &mut self,
        local: Local,
        (line, half): (&Line, &HalfWidth),
        around: &pieces::Near,
        room: &mut Pieces,
    ) -> Option<Local> {
        let corners = corners_of(&self.plan);
        let first = self.pieces.len() as u32;
        for k in local.strokes.clone() {
            room.clear();
            stroke_pieces(&self.strokes[k as usize].segment, line, half, around, room);
            for ring in room.rings() {
                match held(ring, &corners) {
                    Held::None => {}
                    Held::All => return Some(Local { strokes: 0..0, is_held: true, ..local }),
                    Held::Some => {
                        self.corners.extend_from_slice(ring);
                        let bounds = PlanBox::around(ring.iter().copied());
                        self.pieces.push((self.corners.len() as u32, bounds));
                    }
                }
            }
        }
        let pieces = first..self.pieces.len() as u32;
        (!pieces.is_empty()).then_some(Local { strokes: 0..0, pieces, ..local })
    }

    /// The pieces of an item's stroke that are made for all of the box, each with the box around it.
    pub(super) fn pieces(&self, of: &Local) -> impl Iterator<Item = (&[Plan], &PlanBox)> {
        let mut from = of.pieces.start.checked_sub(1).map_or(0, |before| self.pieces[before as usize].0);
        self.pieces[of.pieces.start as usize..of.pieces.end as usize].iter().map(move |(to, bounds)| {
            let ring = &self.corners[from as usize..*to as usize];
            from = *to;
            (ring, bounds)
        })
    }

    fn clear(&mut self, plan: &PlanBox) {
        (self.plan, self.at) = (*plan, odd_place(plan));
        self.pieces.clear();
        self.corners.clear();
        self.items.clear();
        self.edges.clear();
        self.strokes.clear();
    }

    /// Keeps an item, unless it covers nothing of the box; where it covers all and is opaque, forgets what lies below.
    fn keep(&mut self, looks: &Looks, local: Local) {
        let look = looks.of(local.item);
        let is_in = look.area.is_none_or(|area| area.holds(local.turns));
        let has_edges = !local.edges.is_empty();
        let is_stroked = local.is_held || !(local.strokes.is_empty() && local.pieces.is_empty());
        if (look.line.is_some() && !is_stroked) || !(has_edges || is_in) {
            return;
        }
        if (look.line.is_none() || local.is_held) && !has_edges && look.is_opaque {
            self.items.clear();
        }
        self.items.push(local);
    }

    /// Whether each item covers all of the box.
    pub(super) fn is_plain(&self) -> bool {
        self.is_plain
    }

    /// The edges of an item's area.
    pub(super) fn edges(&self, of: &Local) -> &[Edge] {
        &self.edges[of.edges.start as usize..of.edges.end as usize]
    }

    /// The segments of an item's stroke.
    pub(super) fn strokes(&self, of: &Local) -> &[Stroked] {
        &self.strokes[of.strokes.start as usize..of.strokes.end as usize]
    }

    /// How often the border of an item's area turns around a place in the box.
    pub(super) fn turns_at(&self, of: &Local, at: Plan) -> i32 {
        if of.edges.is_empty() {
            return of.turns;
        }
        let way = PlanBox::around([self.at, at]);
        let crossed = self.edges(of).iter().filter(|edge| edge.bounds.meets(&way));
        of.turns + crossed.map(|edge| crossing(edge, self.at, at)).sum::<i32>()
    }
}

/// Where an item's entries lie in a list sorted by items.
fn range_of<T>(list: &[T], item: u32, of: impl Fn(&T) -> u32) -> Range<u32> {
    let from = list.partition_point(|entry| of(entry) < item);
    from as u32..list.partition_point(|entry| of(entry) <= item) as u32
}
