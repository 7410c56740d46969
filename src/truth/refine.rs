//! A pixel cut into pieces until what is unknown of its colour is small.
//!
//! A piece sees one triangle and knows, of each item near it, whether it lies in or out of it, or which primitives could still
//! tell. The piece with the most unknown in it is cut first: along a primitive's line, so that the two halves know more.

use super::form::Line;
use super::kept::KeptParts;
use super::knowledge::{Edges, Middle, Pixel, State};
use super::near::{MOST_PARTS, Near};
use super::outcome::{Outcome, Sample};
use super::polygon::{self, Halves, Pieces, Polygon, ROUNDING};
use super::setting::Setting;
use super::shape::{Cut, PixelGround, Verdict};
use super::shapes::{Shapes, Told};
use super::visible::{Fragment, SPECK, Sight};
use super::{ItemCoverage, PixelCoverage};
use crate::certainty::{Known, PaintMean, PaintRange};
use crate::footprint::{BorderPart, Primitive};
use crate::math;
use crate::resolve::{Compositor, Paint, Stack};
use crate::space::PlanBox;
use crate::terrain::SKY;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// How many times more parts than [`MOST_PARTS`] (as a power of two) are looked at of a piece that has been cut for there being too many:
/// where all parts lie on one another cutting does not help.
const MOST_LEVEL: u32 = 8;

/// Room for one pixel's work, used again for the next.
#[derive(Debug, Default)]
pub(super) struct Refinery {
    shapes: Shapes,
    /// Indices into `shapes`, a run for each state.
    lists: Vec<u32>,
    states: Vec<State>,
    /// The pieces of which something is open, and those that have been cut since.
    open: Vec<FragmentPiece>,
    /// Which of them is to be cut next.
    heap: BinaryHeap<Rank>,
    near: Near,
    parts: KeptParts,
    fresh: Vec<State>,
    /// Pieces of which nothing is open, where coverage is asked for.
    closed: Vec<FragmentPiece>,
    /// The area of the pieces that may lie in or out of some item.
    open_area: f64,
    slop: f64,
    /// Pieces made.
    pub(super) pieces: u64,
    /// Pieces of this pixel.
    count: u64,
    /// The share of the pixel's area that is refined: its part of the budget.
    share: f64,
    /// The paint of the triangle that was settled last, where it is the same on all of the triangle.
    bare: Option<(u32, PaintRange)>,
    /// The pixel's colours, where they have been looked at since its last piece.
    colors: Option<[[f64; 4]; 3]>,
}

/// A piece of a pixel.
#[derive(Debug)]
pub(super) struct Part {
    pub(super) shape: Polygon,
    /// What all of it sees and is held by; `None`: that is not known.
    pub(super) outcome: Option<Outcome>,
}

/// What parts of a pixel come to.
#[derive(Debug)]
pub(super) struct PartSum {
    mean: PaintMean,
    slop: f64,
    coverage: PixelCoverage,
}

impl Default for PartSum {
    fn default() -> Self {
        Self { mean: PaintMean::NOTHING, slop: 0.0, coverage: PixelCoverage::default() }
    }
}

impl PartSum {
    /// The pixel's colour: lower bounds, upper bounds, estimate.
    pub(super) fn colors(&self, compositor: &Compositor) -> [[f64; 4]; 3] {
        self.mean.colors(compositor, self.slop)
    }

    /// How much each item covers of the pixel.
    pub(super) fn coverage(self) -> PixelCoverage {
        self.coverage.joined()
    }
}

/// A convex piece of a pixel that sees one triangle.
#[derive(Debug, Clone, Copy)]
struct FragmentPiece {
    shape: Polygon,
    facet: u32,
    area: f64,
    paint: PaintRange,
    /// Its items, in `states`; `None`: too many to have been looked at.
    states: Option<(u32, u32)>,
    /// Where to cut it; `None`: nothing helps.
    cut: Option<Line>,
    /// How often it has been cut because it was near too many parts.
    level: u32,
    /// Whether it may lie in or out of some item; kept only where coverage is asked for.
    is_open: bool,
}

impl FragmentPiece {
    fn new(fragment: &Fragment, area: f64) -> Self {
        let (shape, facet) = (fragment.shape, fragment.facet);
        let paint = PaintRange::ANY;
        Self { shape, facet, area, paint, states: None, cut: None, level: 0, is_open: false }
    }
}

/// An open piece's place in the order of work.
#[derive(Debug, Clone, Copy)]
struct Rank {
    /// What is unknown of it: its area times the widest channel.
    weight: f64,
    /// Breaks ties, so that the order is always the same.
    number: u64,
    /// Its place among the open ones.
    place: u32,
}

impl Ord for Rank {
    fn cmp(&self, other: &Self) -> Ordering {
        self.weight.total_cmp(&other.weight).then(other.number.cmp(&self.number))
    }
}
impl PartialOrd for Rank {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl PartialEq for Rank {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Rank {}

impl Refinery {
    /// The colour of a pixel that sees this: lower bounds, upper bounds, estimate.
    pub(super) fn refine(&mut self, pixel: &Pixel, pieces: &mut Pieces, sight: &Sight) -> [[f64; 4]; 3] {
        let mean = self.mean_of(pixel, pieces, sight, 1.0);
        self.colors.unwrap_or_else(|| mean.colors(&pixel.setting.compositor, self.slop))
    }

    /// Adds what a part of a pixel that sees this, so much of its area, comes to.
    pub(super) fn refine_part(
        &mut self,
        pixel: &Pixel,
        (pieces, share): (&mut Pieces, f64),
        sight: &Sight,
        sum: &mut PartSum,
    ) {
        let mean = self.mean_of(pixel, pieces, sight, share);
        sum.mean.join(&mean);
        sum.slop += self.slop + ROUNDING;
        if pixel.setting.budget.coverage {
            let PixelCoverage { items, others } = self.counted();
            sum.coverage.items.extend(items);
            sum.coverage.others += others;
        }
    }

    fn mean_of(&mut self, pixel: &Pixel, pieces: &mut Pieces, sight: &Sight, share: f64) -> PaintMean {
        self.share = share;
        let most = (f64::from(1u32 << pixel.setting.budget.depth) * share).ceil() as u64;
        self.refine_to(pixel, pieces, sight, most)
    }

    /// Cuts a pixel that sees this, beyond its fragments, into at most 2^depth pieces.
    pub(super) fn refine_further(&mut self, pixel: &Pixel, pieces: &mut Pieces, sight: &Sight, depth: u32) {
        self.share = 1.0;
        let most = sight.fragments.len() as u64 + (1 << depth);
        self.refine_to(pixel, pieces, sight, most);
    }

    fn refine_to(&mut self, pixel: &Pixel, pieces: &mut Pieces, sight: &Sight, most: u64) -> PaintMean {
        self.clear(sight.slop);
        let mut mean = PaintMean::NOTHING;
        for sky in &sight.sky {
            let area = pieces.area(*sky);
            mean.add(&PaintRange::exact(pixel.setting.sky), area);
            // A speck may lie wholly in the doubtful strip of a border.
            self.slop += ROUNDING + if area < SPECK { area } else { 0.0 };
        }
        for fragment in &sight.fragments {
            self.look(pixel, pieces, FragmentPiece::new(fragment, pieces.area(fragment.shape)), &mut mean);
        }
        while !self.is_enough(pixel.setting, &mean) && self.count < most {
            let Some(first) = self.heap.pop() else { break };
            let piece = self.open[first.place as usize];
            self.open_area -= if piece.is_open { piece.area } else { 0.0 };
            self.halve(pixel, pieces, piece, &mut mean);
        }
        self.pieces += self.count;
        mean
    }

    /// Whether what is open of the pixel is within the budget.
    fn is_enough(&mut self, setting: &Setting, mean: &PaintMean) -> bool {
        self.colors = None;
        let width = setting.budget.width * self.share;
        let doubt = 2.0 * self.slop;
        // Where the doubt alone is over the budget, the rest is still brought down to it.
        let target = if doubt < width { width - doubt } else { width };
        if mean.open() > target || self.open_area > target {
            return false;
        }
        if self.share < 1.0 {
            // A part has no colour of its own.
            return true;
        }
        let colors @ [low, high, _] = mean.colors(&setting.compositor, self.slop);
        self.colors = Some(colors);
        doubt >= width || (0..4).all(|c| high[c] - low[c] <= width)
    }

    /// How much each item covers of the pixel refined last; asked for by the budget.
    pub(super) fn coverage(&self) -> PixelCoverage {
        self.counted().joined()
    }

    /// The same piece by piece.
    fn counted(&self) -> PixelCoverage {
        let mut all = PixelCoverage { items: Vec::new(), others: self.slop };
        for piece in self.all() {
            let Some((first, count)) = piece.states else {
                all.others += piece.area;
                continue;
            };
            for state in &self.states[first as usize..(first + count) as usize] {
                let low = if state.known() == Known::In { piece.area } else { 0.0 };
                all.items.push(ItemCoverage { item: state.item, low, high: piece.area });
            }
        }
        all
    }

    /// What may be seen and held in a square, however small, that sees this; depths are those of the triangles' planes all over the square: a
    /// machine that snaps which triangle covers a sample need not snap what it interpolates.
    pub(super) fn outcomes(
        &mut self,
        pixel: &Pixel,
        pieces: &mut Pieces,
        sight: &Sight,
        square: ([f64; 2], f64),
    ) -> Sample {
        self.refine(pixel, pieces, sight);
        let mut sample = Sample::default();
        if !sight.sky.is_empty() {
            sample.add(Outcome::of_sky(PaintRange::exact(pixel.setting.sky)));
        }
        let corners = polygon::corners(square);
        for piece in self.all() {
            let mut outcome = self.outcome_of(pixel, pieces, piece);
            let on_plane = depths(&pixel.ground(piece.facet), &corners);
            // A plane may pass the eye beside the triangle.
            if on_plane.0 > 0.0 && on_plane.1.is_finite() {
                outcome.depth = on_plane;
            }
            sample.add(outcome);
        }
        sample
    }

    fn outcome_of(&self, pixel: &Pixel, pieces: &Pieces, piece: &FragmentPiece) -> Outcome {
        let ground = pixel.ground(piece.facet);
        let points = pieces.of(piece.shape);
        let depth = depths(&ground, points);
        let states =
            piece.states.map(|(first, count)| &self.states[first as usize..(first + count) as usize]);
        let items = states.map(|states| states.iter().map(|s| (s.item, s.known())).collect());
        let (triangle, plan) = (ground.facet.id, ground.plan_box(points));
        let (bare, _) = pixel.setting.ground_paint(&ground, points, &mut 0.0);
        Outcome { triangle, paint: piece.paint, ground: bare, items, plan, depth }
    }

    /// The pieces of the pixel refined last, and its sky.
    pub(super) fn parts(&self, pixel: &Pixel, pieces: &Pieces, sight: &Sight) -> Vec<Part> {
        let of_piece = |piece: &FragmentPiece| {
            let outcome = (piece.paint.width() == 0.0 && !piece.is_open && piece.states.is_some())
                .then(|| self.outcome_of(pixel, pieces, piece));
            Part { shape: piece.shape, outcome }
        };
        let of_sky = |sky: &Polygon| Part {
            shape: *sky,
            outcome: Some(Outcome::of_sky(PaintRange::exact(pixel.setting.sky))),
        };
        let ground = self.all().map(of_piece);
        ground.chain(sight.sky.iter().map(of_sky)).collect()
    }

    /// The pieces of the pixel refined last, each with its facet and with what is known of its items (`None`: nothing).
    #[cfg(test)]
    pub(super) fn claims(&self) -> Vec<Claim> {
        let told = |state: &State| match state.known() {
            Known::Open => (state.item, None),
            known => (state.item, Some(known == Known::In)),
        };
        let known = self.all().filter_map(|piece| {
            let (first, count) = piece.states?;
            let states = &self.states[first as usize..(first + count) as usize];
            Some((piece.shape, piece.facet, states.iter().map(told).collect()))
        });
        known.collect()
    }

    fn clear(&mut self, slop: f64) {
        self.shapes.clear();
        self.lists.clear();
        self.states.clear();
        self.open.clear();
        self.heap.clear();
        self.closed.clear();
        (self.slop, self.count, self.open_area) = (slop, 0, 0.0);
    }

    /// The pixel's pieces as they are.
    fn all(&self) -> impl Iterator<Item = &FragmentPiece> {
        self.closed.iter().chain(self.heap.iter().map(|rank| &self.open[rank.place as usize]))
    }

    /// Cuts a piece in two.
    fn halve(&mut self, pixel: &Pixel, pieces: &mut Pieces, piece: FragmentPiece, mean: &mut PaintMean) {
        let Some(line) = piece.cut else { return self.closed.push(piece) };
        mean.remove(&piece.paint, piece.area);
        let mut halves = pieces.cut(piece.shape, &line, &mut self.slop);
        if !matches!(halves, Some(Halves { inner: Some(_), outer: Some(_) })) {
            let line = pixel.ground(piece.facet).halving_line(pieces.of(piece.shape));
            halves = pieces.cut(piece.shape, &line, &mut self.slop);
        }
        let Some(Halves { inner: Some(inner), outer: Some(outer) }) = halves else {
            // No cut helps: nothing more can be learnt of this piece.
            return self.keep(pixel.setting, FragmentPiece { cut: None, ..piece }, mean);
        };
        for shape in [inner, outer] {
            let half = FragmentPiece { shape, area: pieces.area(shape), ..piece };
            match piece.states {
                Some(states) => self.settle(pixel, pieces, half, states, mean),
                None => self.look(pixel, pieces, half, mean),
            }
        }
    }

    /// Finds the items near a piece that has not been looked at.
    fn look(&mut self, pixel: &Pixel, pieces: &Pieces, piece: FragmentPiece, mean: &mut PaintMean) {
        if piece.area < SPECK {
            return self.doubt(piece, mean);
        }
        let ground = pixel.ground(piece.facet);
        let points = pieces.of(piece.shape);
        let plan = ground.plan_box(points);
        let middle = Middle::new(pixel, &ground, points);
        let most = MOST_PARTS << piece.level.min(MOST_LEVEL);
        let mut near = std::mem::take(&mut self.near);
        if near.find((&middle, &plan), most, (&mut self.parts, &mut self.slop)) {
            let states = self.first_states(&middle, &plan, &mut near);
            self.settle(pixel, pieces, piece, states, mean);
        } else {
            let paint = pixel.setting.crowd_paint(&ground, points);
            let cut = Some(ground.halving_line(points));
            let level = piece.level + 1;
            self.keep(
                pixel.setting,
                FragmentPiece { paint, cut, states: None, is_open: true, level, ..piece },
                mean,
            );
        }
        self.near = near;
    }

    /// A speck: it may have any colour.
    fn doubt(&mut self, piece: FragmentPiece, mean: &mut PaintMean) {
        mean.add(&PaintRange::exact(Paint::CLEAR), piece.area);
        self.slop += piece.area + ROUNDING;
    }

    /// What a fragment knows of the items near it: those of the parts, and those whose polygon may hold it whole.
    fn first_states(&mut self, middle: &Middle, plan: &PlanBox, near: &mut Near) -> (u32, u32) {
        let mut fresh = std::mem::take(&mut self.fresh);
        fresh.clear();
        self.shapes.begin_fragment();
        for run in near.runs() {
            fresh.push(self.shapes_near(middle, plan, run, near));
        }
        let with_parts = fresh.len();
        for item in near.covering() {
            if fresh[..with_parts].binary_search_by_key(item, |s| s.item).is_err() {
                let mut state = middle.first_state(*item, Edges::Beyond(plan, None), (0, 0));
                state.stroke = Known::In;
                fresh.push(state);
            }
        }
        fresh.sort_unstable_by_key(|state| state.item);
        let count = fresh.len();
        let at = || middle.hit().plan;
        near.areas(middle.pixel.setting, (plan, &at), |item, holds| {
            if fresh[..count].binary_search_by_key(&item, |s| s.item).is_err() {
                let mut state = middle.first_state(item, Edges::Beyond(plan, holds), (0, 0));
                state.stroke = if state.stroke == Known::Open { Known::Out } else { state.stroke };
                fresh.push(state);
            }
        });
        fresh.retain(|state| state.known() != Known::Out);
        fresh.sort_unstable_by_key(|state| state.item);
        debug_assert!(fresh.windows(2).all(|pair| pair[0].item < pair[1].item), "an item is known once");
        let first = self.states.len() as u32;
        self.states.extend_from_slice(&fresh);
        self.fresh = fresh;
        (first, self.states.len() as u32 - first)
    }

    /// What a fragment knows of an item that has these parts near it. Of a crowd those that the fragment is wholly in or out of are not kept.
    fn shapes_near(&mut self, middle: &Middle, plan: &PlanBox, parts: &[BorderPart], near: &Near) -> State {
        let first = self.lists.len() as u32;
        let item = parts[0].item;
        let mut edges = Edges::Beyond(plan, None);
        let mut stroke = if near.covering().contains(&item) { Known::In } else { Known::Out };
        self.shapes.begin_item();
        for part in parts {
            let primitives = self.parts.of(middle.pixel.setting.footprints, *part);
            for (number, primitive) in primitives.iter().enumerate() {
                let is_edge = matches!(primitive, Primitive::Edge { .. });
                if (stroke == Known::In && !is_edge) || primitive.misses(plan) {
                    continue;
                }
                let piece = (middle.ground, middle.points);
                let of = (primitive, (*part, number));
                match self.shapes.tell(of, near.is_crowd(), piece, &mut self.slop) {
                    Told::In => stroke = Known::In,
                    Told::Out if is_edge && matches!(edges, Edges::Beyond(..)) => edges = Edges::Near,
                    Told::Out => {}
                    Told::Open(index) => {
                        match is_edge {
                            true => edges = Edges::Across,
                            false => stroke = stroke.or(Known::Open),
                        }
                        self.lists.push(index);
                    }
                }
            }
        }
        let count = self.lists.len() as u32 - first;
        let mut state = middle.first_state(item, edges, (first, count));
        if state.stroke == Known::Open {
            state.stroke = stroke;
        }
        state
    }

    /// Brings a piece's knowledge up to date with its shape, and decides its colour and where to cut it.
    fn settle(
        &mut self,
        pixel: &Pixel,
        pieces: &Pieces,
        mut piece: FragmentPiece,
        (first, count): (u32, u32),
        mean: &mut PaintMean,
    ) {
        if piece.area < SPECK {
            return self.doubt(piece, mean);
        }
        let ground = pixel.ground(piece.facet);
        let points = pieces.of(piece.shape);
        let middle = Middle::new(pixel, &ground, points);
        self.shapes.begin_piece();
        let start = self.states.len() as u32;
        let mut cut = None;
        let mut is_hidden = false;
        // From the top down: below an opaque item nothing matters.
        for k in (first..first + count).rev() {
            let mut state = self.states[k as usize];
            if state.known() == Known::Open {
                let wish = self.update(&middle, (&ground, points), &mut state);
                cut = cut.or(wish);
            }
            if state.known() == Known::Out {
                continue;
            }
            self.states.push(state);
            if state.known() == Known::In && pixel.setting.hides(state.item) {
                is_hidden = true;
                break;
            }
        }
        self.states[start as usize..].reverse();
        piece.states = Some((start, self.states.len() as u32 - start));
        let (base, ground_cut) = match is_hidden {
            true => (PaintRange::exact(Paint::CLEAR), None),
            false => self.ground_paint(pixel.setting, &ground, points),
        };
        let settled = &self.states[start as usize..];
        piece.is_open = settled.iter().any(|state| state.known() == Known::Open);
        piece.paint = composed(pixel.setting, base, settled);
        piece.cut = cut.or(ground_cut);
        self.keep(pixel.setting, piece, mean);
    }

    /// The terrain's own paint on a piece, and where to cut it to know more.
    fn ground_paint(
        &mut self,
        setting: &Setting,
        ground: &PixelGround,
        points: &[[f64; 2]],
    ) -> (PaintRange, Option<Line>) {
        let triangle = ground.facet.id;
        match self.bare {
            Some((before, paint)) if before == triangle => (paint, None),
            _ => {
                let (paint, cut) = setting.ground_paint(ground, points, &mut self.slop);
                self.bare = (!setting.has_texels()).then_some((triangle, paint));
                (paint, cut)
            }
        }
    }

    /// Brings what a piece knows of one item up to date; returns where to cut to learn more.
    fn update(
        &mut self,
        middle: &Middle,
        (ground, points): (&PixelGround, &[[f64; 2]]),
        state: &mut State,
    ) -> Option<Line> {
        let first = self.lists.len() as u32;
        let (mut cut, mut has_edges, mut stroke) = (None, false, Known::Out);
        let is_crowd = state.count as usize > MOST_PARTS;
        let mut deepest: Option<(Cut, usize)> = None;
        for k in state.first..state.first + state.count {
            let index = self.lists[k as usize];
            let is_edge = self.shapes.is_edge(index);
            let known = if is_edge { state.polygon } else { state.stroke };
            if known != Known::Open || (is_crowd && stroke == Known::In && !is_edge) {
                continue;
            }
            match self.shapes.verdict(index, (ground, points), &mut self.slop) {
                Verdict::Out => continue,
                Verdict::In => {
                    stroke = Known::In;
                    continue;
                }
                Verdict::Cut(at) if is_crowd && !is_edge => {
                    if deepest.is_none_or(|(before, _)| at.depth > before.depth) {
                        deepest = Some((at, self.lists.len()));
                    }
                }
                Verdict::Cut(at) => cut = cut.or(Some(at.line)),
                Verdict::Stuck => {}
            }
            if is_edge {
                has_edges = true
            } else {
                stroke = stroke.or(Known::Open)
            }
            self.lists.push(index);
        }
        if let Some((at, place)) = deepest {
            // Most of the piece is in this one, if in any: its parts ask it first.
            self.lists.swap(first as usize, place);
            cut = cut.or(Some(at.line));
        }
        (state.first, state.count) = (first, self.lists.len() as u32 - first);
        if state.stroke == Known::Open {
            state.stroke = stroke;
        }
        if state.polygon == Known::Open && !has_edges {
            state.polygon = middle.polygon(state.item);
            if state.polygon == Known::Open {
                return Some(ground.halving_line(points));
            }
        }
        cut
    }

    /// Counts a piece as it is, and remembers it if more can be learnt.
    fn keep(&mut self, setting: &Setting, mut piece: FragmentPiece, mean: &mut PaintMean) {
        self.count += 1;
        self.slop += ROUNDING;
        mean.add(&piece.paint, piece.area);
        piece.is_open &= setting.budget.coverage;
        let width = if piece.is_open { 1.0 } else { piece.paint.width() };
        if width > 0.0 {
            self.open_area += if piece.is_open { piece.area } else { 0.0 };
            let place = self.open.len() as u32;
            self.heap.push(Rank { weight: piece.area * width, number: self.count, place });
            self.open.push(piece);
        } else if setting.budget.coverage {
            self.closed.push(piece);
        }
    }
}

/// A piece's shape, its facet, and what it says of its items.
#[cfg(test)]
pub(super) type Claim = (Polygon, u32, Vec<(u32, Option<bool>)>);

/// The least and the largest view depth of a triangle's plane at some points.
fn depths(ground: &PixelGround, points: &[[f64; 2]]) -> (f64, f64) {
    let depths = points.iter().map(|p| ground.rays.frame.depth(ground.hit(*p).world));
    depths.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (math::min(v, low), math::max(v, high)))
}

/// Adds to what a sample may see each of its triangles with each of its sets of items: a machine decides on the one by the terrain's vertices and on
/// the other by other vertices, or by a point of the triangle's plane beyond its border.
pub(super) fn cross(setting: &Setting, sample: &mut Sample) {
    const MOST: usize = 256;
    let ground = |outcome: &&Outcome| outcome.triangle != SKY;
    let first = sample.outcomes.iter().find(ground).map(|outcome| outcome.ground);
    if sample.outcomes.iter().filter(ground).all(|outcome| Some(outcome.ground) == first) {
        return;
    }
    let all: Vec<Outcome> = sample.outcomes.iter().filter(ground).cloned().collect();
    if all.len() * all.len() > MOST {
        return;
    }
    for seen in &all {
        for items in all.iter().filter_map(|outcome| outcome.items.as_ref()) {
            let paint = composed_of(setting, seen.ground, items.iter().copied());
            sample.add(Outcome { paint, items: Some(items.clone()), ..seen.clone() });
        }
    }
}

/// The paint of a piece's items over a base.
fn composed(setting: &Setting, base: PaintRange, states: &[State]) -> PaintRange {
    composed_of(setting, base, states.iter().map(|state| (state.item, state.known())))
}

fn composed_of(setting: &Setting, base: PaintRange, items: impl Iterator<Item = (u32, Known)>) -> PaintRange {
    let mut stack = Stack::on(base);
    for (item, known) in items {
        let paint = setting.paint_of(item);
        stack.draw(setting.group_of(item), |below| below.under_known(known, paint, setting.mode));
    }
    stack.finished()
}
