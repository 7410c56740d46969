//! The segments that a view may have of dynamic lines, with their boxes on the screen (3.2.2, 3.3, 4.2.2, 4.3).
//!
//! Input: the draw list's strokes in pixels, the terrain, a view. Output: [`Lines`], which tell of a patch of the surface whether an item holds it. Refuses:
//! nothing.

use super::maker::Maker;
use super::patch::{Patch, to_segment};
use super::segment::{Piece, SHARE, Segment};
use crate::allowed::model::{Guess, View};
use crate::certainty::Known;
use crate::draw_list::Chain;
use crate::index::BoxTree;
use crate::math;
use crate::parallel;
use crate::scene::Width;
use crate::space::{Plan, PlanBox, World};
use crate::technique::dynamic_line::Settings;

/// How often a line's segments hold a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Held {
    pub(super) item: u32,
    pub(super) least: u32,
    pub(super) most: u32,
    /// Whether one of two segments does for sure, whichever.
    is_shared: bool,
}

/// A pixel's centre, and what of the surface it may see.
pub(super) struct Place<'a> {
    pub(super) patch: &'a Patch,
    pub(super) centre: Plan,
    /// Whether a place of a segment is seen there, of which thin lines ask; `None`: nothing is done about them.
    pub(super) is_seen: Option<&'a dyn Fn(World) -> Known>,
}

/// All dynamic lines of a view.
pub(super) struct Lines {
    pieces: Vec<Piece>,
    /// Of what pieces may reach in the plan.
    plan: BoxTree,
    /// Of their pictures with what thin lines reach beside them.
    screen: BoxTree,
    central: bool,
    pixel: f64,
    shift: f64,
    single: f64,
}

/// Half a pixel: a pixel whose centre is no farther from a segment's picture is in a thin line (Fig. 4.9).
const THIN: f64 = 0.5;

/// Chains that one piece of parallel work looks at.
const CHAINS_AT_A_TIME: usize = 64;

impl Lines {
    /// The lines of a view by a technique's settings. `is_thin`: thin lines are corrected.
    pub(super) fn new(view: &View, guess: &Guess, settings: &Settings, is_thin: bool) -> Self {
        let mesh = &*view.stage.mesh;
        let maker = Maker::new(view, guess, settings, (mesh, is_thin));
        let list = &view.stage.draw_list;
        let of_item = |(item, of)| {
            let half_px = half_px(view, item)?;
            Some(list.strokes(of).iter().map(move |chain| (item, half_px, *chain)))
        };
        let chains: Vec<(u32, f64, Chain)> = list.numbered().filter_map(of_item).flatten().collect();
        let made = parallel::map_indices(chains.len().div_ceil(CHAINS_AT_A_TIME), |k| {
            let first = k * CHAINS_AT_A_TIME;
            let some = &chains[first..chains.len().min(first + CHAINS_AT_A_TIME)];
            let numbered = (first as u32..).zip(some);
            numbered
                .flat_map(|(k, (item, half_px, chain))| maker.pieces((*item, *half_px), (k, chain)))
                .collect::<Vec<_>>()
        });
        let pieces: Vec<Piece> = made.into_iter().flatten().collect();
        let plan: Vec<PlanBox> = parallel::map(&pieces, |piece| maker.reach_of(piece));
        let screen: Vec<PlanBox> =
            if is_thin { pieces.iter().map(Piece::picture).collect() } else { Vec::new() };
        Self {
            pieces,
            plan: BoxTree::new(&plan),
            screen: BoxTree::new(&screen),
            central: maker.eye.is_some(),
            pixel: maker.pixel,
            shift: maker.shift,
            single: guess.envelope.single(),
        }
    }

    /// Whether some line may reach a box of the plan, or its thin picture a place of the screen.
    pub(super) fn may_reach(&self, plan: &PlanBox, at: Plan) -> bool {
        !self.plan.query(plan, |_| false) || !self.screen.query(&PlanBox::around([at]), |_| false)
    }

    /// The items that hold a place or may hold it, in draw order.
    pub(super) fn holding(&self, place: &Place) -> Vec<Held> {
        let mut near: Vec<u32> = Vec::new();
        let mut add = |piece: u32| {
            near.push(piece);
            true
        };
        self.plan.query(&place.patch.bounds(), &mut add);
        if place.is_seen.is_some() {
            self.screen.query(&PlanBox::around([place.centre]), &mut add);
        }
        near.sort_unstable();
        near.dedup();
        let mut held: Vec<Held> = Vec::new();
        for (k, piece) in near.iter().map(|k| (*k as usize, &self.pieces[*k as usize])) {
            let (least, most) = self.often(piece, place);
            if most == 0 {
                continue;
            }
            let next = self.pieces.get(k + 1).filter(|next| next.chain == piece.chain);
            let is_shared = || next.is_some_and(|next| self.share(piece, next, place));
            if held.last().is_none_or(|last| last.item != piece.item) {
                held.push(Held { item: piece.item, least: 0, most: 0, is_shared: false });
            }
            if let Some(last) = held.last_mut() {
                (last.least, last.most) = (last.least + least, last.most + most);
                last.is_shared |= last.least == 0 && is_shared();
            }
        }
        for of in &mut held {
            of.least = of.least.max(u32::from(of.is_shared));
        }
        held
    }

    /// How many segments of a piece hold a place: at least, at most.
    fn often(&self, piece: &Piece, place: &Place) -> (u32, u32) {
        let mut all: Option<(u32, u32)> = None;
        for way in &piece.ways {
            let known = way.iter().map(|segment| self.holds(segment, piece.half_px, place));
            let (mut least, mut most) = (0, 0);
            known.for_each(|known| {
                least += u32::from(known == Known::In);
                most += u32::from(known != Known::Out);
            });
            let (a, b) = all.unwrap_or((least, most));
            all = Some((a.min(least), b.max(most)));
        }
        match all {
            Some((_, most)) if piece.is_wild => (0, most),
            of => of.unwrap_or((0, 0)),
        }
    }

    /// Whether two pieces that follow one another hold a place that lies near the face that their boxes have in common: one of them does, whichever.
    fn share(&self, first: &Piece, second: &Piece, place: &Place) -> bool {
        let ([one], [other]) = (&first.ways[..], &second.ways[..]) else { return false };
        let (Some(one), Some(other)) = (one.last(), other.first()) else { return false };
        let is_near = |segment: &Segment| {
            segment.kept == Known::In && self.is_near(segment, first.half_px, place) == Known::In
        };
        let sides = |segment: &Segment, faces: [[usize; 2]; 3]| {
            faces.iter().all(|[from, to]| place.patch.is_left_of([segment.plan[*from], segment.plan[*to]]))
        };
        // Corners run right round: from the start's left one over its right one.
        is_near(one)
            && is_near(other)
            && sides(one, [[0, 1], [1, 2], [3, 0]])
            && sides(other, [[1, 2], [2, 3], [3, 0]])
    }

    /// Whether a place is near enough to a segment.
    fn is_near(&self, segment: &Segment, half_px: f64, place: &Place) -> Known {
        let patch = place.patch;
        let [low, high] = patch.distance.map(|r| half_px * self.pixel * if self.central { r } else { 1.0 });
        let [least, most] = patch.distances(segment.ends.map(World::plan));
        let rounding = high * SHARE;
        match () {
            () if most + rounding <= low => Known::In,
            () if least - rounding > high => Known::Out,
            () => Known::Open,
        }
    }

    fn holds(&self, segment: &Segment, half_px: f64, place: &Place) -> Known {
        let near = self.is_near(segment, half_px, place).or(self.is_thin(segment, place));
        if near == Known::Out || segment.kept == Known::Out {
            return Known::Out;
        }
        near.and(segment.kept).and(segment.covers(place.centre, self.shift))
    }

    /// Whether a pixel is in a line because its centre is near a segment's picture.
    fn is_thin(&self, segment: &Segment, place: &Place) -> Known {
        let (Some(is_seen), Some(picture)) = (place.is_seen, segment.picture) else { return Known::Out };
        let ([a, b], [from, to], [first, last]) = (picture.screen, picture.world, picture.depth);
        let distance = to_segment(place.centre, [a, b]);
        let doubt =
            self.single + SHARE * math::max(math::max(a.x.abs(), a.y.abs()), math::max(b.x.abs(), b.y.abs()));
        if distance > THIN + doubt {
            return Known::Out;
        }
        let along = b - a;
        let length = along.length_squared();
        let t = if length > 0.0 {
            math::min(math::max((place.centre - a).dot(along) / length, 0.0), 1.0)
        } else {
            0.0
        };
        // The perspective: shares of the picture weigh with the depth of the other end.
        let share = t * first / ((1.0 - t) * last + t * first);
        let near = if distance < THIN - doubt { Known::In } else { Known::Open };
        near.and(is_seen(from + (to - from) * share))
    }
}

/// Half the width in pixels of an item's stroke, where it is in pixels.
fn half_px(view: &View, item: u32) -> Option<f64> {
    match view.stage.draw_list.style_of(item).stroke?.width {
        Width::Pixels(width) => Some(width / 2.0),
        Width::Metres(_) => None,
    }
}
