//! One pixel: its quadrilateral, its class, its samples, their mean.

use super::edge_index::{EdgeIndex, Winding};
use super::expansion::AreaId;
use super::judgment::{Judge, NearEdge};
use super::quadrilateral::Quadrilateral;
use super::step::{EdgeOf, PixelClass, Refusal, Step};
use crate::canvas::{Backdrop, GBuffer, LastGround, Record};
use crate::raster::Lattice;
use crate::resolve::{Paint, Stack};
use crate::space::{Plan, PlanBox, ViewFrame};
use crate::stage::Stage;
use crate::technique::inverse_projection::{Corners, Settings, Silhouette};
use crate::terrain::Mesh;
use crate::visibility::hit;
use std::ops::Range;

/// Up to so many areas partly in a pixel, samples are told apart by which of them they lie in.
const FEW: usize = 4;

/// A quadrilateral's side may be so many times longer than the longer of the sides that the planes of its two ends
/// would give it, before it counts as spanning a silhouette.
const SILHOUETTE_RATIO: f64 = 8.0;

/// Pixels around the picture whose centres are looked at too: neighbours of those at its border.
pub const GUARD: usize = 1;

/// Everything that pixels are made from.
pub struct PixelPainter<'a> {
    mesh: &'a Mesh,
    view: &'a ViewFrame,
    settings: &'a Settings,
    judge: Judge<'a>,
    backdrop: Backdrop<'a>,
    /// The paint of each style of items.
    paints: Vec<Paint>,
    /// Whether quadrilaterals are asked for of pixels without edges too.
    keeps_quads: bool,
    /// What the pixels' centres see, and those of the pixels around the picture.
    centres: GBuffer<'a>,
    /// What the pixels' corners see, where those are asked for.
    corners: Option<GBuffer<'a>>,
}

/// A finished pixel.
pub struct Pixel {
    /// Its colour.
    pub paint: Paint,
    /// Its class.
    pub class: PixelClass,
    /// How many edges meet its quadrilateral.
    pub edges: u32,
    /// What it sees of the plan.
    pub quad: Quadrilateral,
}

/// What was done.
#[derive(Debug, Default, Clone, Copy)]
pub struct Counts {
    /// Pixels by class.
    pub classes: [u64; 3],
    /// Pixels without a meaningful quadrilateral where edges are near.
    pub refused: u64,
    /// Samples of P pixels.
    pub samples: u64,
    /// Edges that samples were compared with.
    pub edge_tests: u64,
}

/// Room for the lists of one pixel, used again from pixel to pixel.
pub struct Lists {
    ground: LastGround,
    /// A part of the plan that no edge and no area has a part in.
    empty: PlanBox,
    near: Vec<u32>,
    /// The near edges made ready for many samples.
    ready: Vec<NearEdge>,
    windings: Vec<Winding>,
    involved: Vec<Involved>,
}

/// An area that has a part in a pixel.
struct Involved {
    area: AreaId,
    /// Its edges that meet the pixel, as a range of the list of near edges; empty: the whole pixel lies in the area.
    near: Range<usize>,
}

/// What a pixel's centre sees.
struct Centre {
    plan: Plan,
    /// The terrain's own paint there.
    ground: Paint,
}

impl Lists {
    /// The areas with an edge in the pixel.
    fn partly(&self) -> impl Iterator<Item = &Involved> {
        self.involved.iter().filter(|involved| !involved.near.is_empty())
    }

    /// The areas with a part in the pixel, as a step.
    fn areas(&self) -> Step {
        let (whole, partly): (Vec<&Involved>, _) = self.involved.iter().partition(|i| i.near.is_empty());
        let numbers = |areas: Vec<&Involved>| areas.iter().map(|involved| involved.area).collect();
        Step::Areas { whole: numbers(whole), partly: numbers(partly) }
    }
}

impl<'a> PixelPainter<'a> {
    /// Finds what a view of a terrain sees, in tiles of `tile` samples a side; `keeps_quads`: a quadrilateral means something of every pixel.
    pub fn new(
        (stage, mesh, view): (&'a Stage, &'a Mesh, &'a ViewFrame),
        settings: &'a Settings,
        index: &'a EdgeIndex,
        (tile, keeps_quads): (usize, bool),
    ) -> Self {
        let see = |lattice| GBuffer::new(view, mesh, &stage.scene.device, lattice, tile);
        let backdrop = Backdrop::of(&stage.scene, mesh);
        let styles = stage.draw_list.styles().iter();
        Self {
            mesh,
            view,
            settings,
            judge: Judge { index, rule: settings.point_in_polygon },
            paints: styles.map(|style| backdrop.compositor.paint(style.paint)).collect(),
            backdrop,
            keeps_quads,
            centres: see(Lattice::centres(view, GUARD)),
            corners: (settings.corners == Corners::True).then(|| see(Lattice::corners(view))),
        }
    }

    /// What features are painted over.
    pub fn backdrop(&self) -> &Backdrop<'a> {
        &self.backdrop
    }

    /// What the pixels' centres see, and those of [`GUARD`] pixels around the picture.
    pub fn centres(&self) -> &GBuffer<'a> {
        &self.centres
    }

    /// Room for the lists of a pixel.
    pub fn lists(&self) -> Lists {
        Lists {
            ground: self.backdrop.no_ground(),
            empty: PlanBox::EMPTY,
            near: Vec::new(),
            ready: Vec::new(),
            windings: Vec::new(),
            involved: Vec::new(),
        }
    }

    /// Decides a pixel.
    #[inline(always)]
    pub fn pixel<R: Record<Step>>(
        &self,
        at: (usize, usize),
        lists: &mut Lists,
        counts: &mut Counts,
        record: &mut R,
    ) -> Pixel {
        // The lattice of centres starts before the picture.
        let (column, row) = (at.0 + GUARD, at.1 + GUARD);
        let plan = self.centres.plan(column, row);
        if !plan.is_finite() {
            record.step(|| Step::Sky);
            let quad = Quadrilateral::point(plan);
            return Pixel { paint: self.backdrop.sky, class: PixelClass::N, edges: 0, quad };
        }
        let triangle = self.centres.triangle(column, row);
        let ground = self.backdrop.paint_at(&mut lists.ground, triangle, || plan);
        let centre = Centre { plan, ground };
        record.step(|| Step::Ground { triangle, plan, paint: ground });
        let Some(quad) = self.range(at) else {
            counts.refused += 1;
            record.step(|| Step::Refused(Refusal::Sky));
            return self.whole(Quadrilateral::point(plan), &centre, lists, record);
        };
        record.step(|| Step::Range(quad.0));
        // Only where edges may be near does it matter whether the range means anything.
        let bounds = quad.bounds();
        if !self.keeps_quads && lists.empty.contains(&bounds) {
            return Pixel { paint: ground, class: PixelClass::N, edges: 0, quad };
        }
        let may_meet_edges = self.judge.index.has_edges_near(&bounds);
        let is_doubtful =
            (may_meet_edges || self.keeps_quads) && self.settings.silhouette == Silhouette::Centre;
        if is_doubtful && self.spans_silhouette(at) {
            counts.refused += u64::from(may_meet_edges);
            record.step(|| Step::Refused(Refusal::Silhouette));
            return self.whole(Quadrilateral::point(plan), &centre, lists, record);
        }
        lists.near.clear();
        if may_meet_edges {
            self.classify(&quad, lists);
        } else if let Some(empty) = self.judge.index.empty_cell(plan) {
            lists.empty = empty;
        }
        if lists.near.is_empty() {
            return self.whole(quad, &centre, lists, record);
        }
        let (samples, edges) = (u64::from(self.settings.samples * self.settings.samples), lists.near.len());
        counts.samples += samples;
        counts.edge_tests += samples * edges as u64;
        record.step(|| Step::NearEdges(lists.near.iter().map(|&edge| self.edge_of(edge)).collect()));
        record.step(|| Step::Class(PixelClass::P));
        let paint = self.mean(&quad, &centre, lists, record);
        Pixel { paint, class: PixelClass::P, edges: edges as u32, quad }
    }

    /// She 3.2, Fig. 6b: the quadrilateral of a pixel from the centres of itself and its right, upper right and upper
    /// neighbours, or from its corners; `None` where one of them sees the sky.
    fn range(&self, at: (usize, usize)) -> Option<Quadrilateral> {
        let seen = self.corners.as_ref().unwrap_or(&self.centres);
        let [a, b, c, d] = self.corner_samples(at);
        let plan = |(column, row)| seen.plan(column, row);
        let quad = Quadrilateral([plan(a), plan(b), plan(c), plan(d)]);
        quad.0.iter().all(|p| p.is_finite()).then_some(quad)
    }

    /// The samples that make a pixel's quadrilateral, in the order of [`Quadrilateral`].
    fn corner_samples(&self, (x, y): (usize, usize)) -> [(usize, usize); 4] {
        match self.corners {
            None => [(x + 1, y + 1), (x + 2, y + 1), (x + 2, y), (x + 1, y)],
            Some(_) => [(x, y + 1), (x + 1, y + 1), (x + 1, y), (x, y)],
        }
    }

    fn spans_silhouette(&self, at: (usize, usize)) -> bool {
        let seen = self.corners.as_ref().unwrap_or(&self.centres);
        let samples = self.corner_samples(at);
        (0..4).any(|k| self.is_silhouette(seen, samples[k], samples[(k + 1) % 4]))
    }

    /// Whether the side between two neighbours is too long for the planes that its ends lie on.
    fn is_silhouette(&self, seen: &GBuffer, from: (usize, usize), to: (usize, usize)) -> bool {
        let ids = [from, to].map(|(column, row)| seen.triangle(column, row));
        if ids[0] == ids[1] {
            return false;
        }
        let [start, end] = [from, to].map(|(column, row)| seen.plan(column, row));
        let length = (end - start).length_squared();
        let limit = SILHOUETTE_RATIO * SILHOUETTE_RATIO;
        let expected = |id: u32, at: Plan, (column, row): (usize, usize)| {
            let ray = self.view.ray(seen.sight().lattice().at(column, row));
            let hit = self.mesh.surface_triangle(id).map(|t| hit(self.view, &ray, &t));
            // A plane that the neighbour's ray misses would reach to the horizon.
            hit.filter(|h| h.depth > 0.0).map_or(f64::INFINITY, |h| (h.plan - at).length_squared())
        };
        length > limit * expected(ids[0], start, to) && length > limit * expected(ids[1], end, from)
    }

    /// She 3.3: finds the edges that meet the quadrilateral; none: the pixel is N or F.
    fn classify(&self, quad: &Quadrilateral, lists: &mut Lists) {
        self.judge.index.edges_near(quad, &mut lists.near);
        lists.near.retain(|&e| {
            let edge = self.judge.index.edge(e);
            quad.meets(edge.a, edge.b)
        });
    }

    fn edge_of(&self, edge: u32) -> EdgeOf {
        let edge = self.judge.index.edge(edge);
        EdgeOf { area: edge.area, from: edge.a, to: edge.b }
    }

    /// A pixel without edges: N, or F in the areas around its centre.
    fn whole<R: Record<Step>>(
        &self,
        quad: Quadrilateral,
        centre: &Centre,
        lists: &mut Lists,
        record: &mut R,
    ) -> Pixel {
        lists.near.clear();
        self.involve(centre.plan, lists);
        let is_covered = lists.involved.iter().any(|i| self.judge.index.painted_by(i.area).is_some());
        let class = if is_covered { PixelClass::F } else { PixelClass::N };
        record.step(|| Step::Class(class));
        record.step(|| lists.areas());
        let paint = self.compose(centre.ground, &lists.involved, |_| true);
        Pixel { paint, class, edges: 0, quad }
    }

    /// She 3.5: the mean of the composed colours of the samples (3.4).
    fn mean<R: Record<Step>>(
        &self,
        quad: &Quadrilateral,
        centre: &Centre,
        lists: &mut Lists,
        record: &mut R,
    ) -> Paint {
        self.involve(centre.plan, lists);
        record.step(|| lists.areas());
        lists.ready.clear();
        lists.ready.extend(lists.near.iter().map(|&e| NearEdge::new(self.judge.index.edge(e))));
        let n = self.settings.samples;
        let sum = if lists.partly().count() <= FEW {
            self.sum_of_kinds(quad, centre.ground, lists, record)
        } else {
            let mut sum = Paint::CLEAR;
            quad.for_each_sample(n, |at| {
                let is_in = |k: usize| self.is_in(&lists.involved[k], at, lists);
                record.step(|| {
                    let within = lists.partly().filter(|involved| self.is_in(involved, at, lists));
                    Step::Sample { at, within: within.map(|involved| involved.area).collect() }
                });
                sum = sum.plus(self.compose(centre.ground, &lists.involved, is_in));
            });
            sum
        };
        let mean = sum.divided_by(f64::from(n * n));
        record.step(|| Step::Mean(mean));
        mean
    }

    /// The sum of the samples' colours where few areas are partly in the pixel: samples in the same areas have the same colour,
    /// which is composed once.
    fn sum_of_kinds<R: Record<Step>>(
        &self,
        quad: &Quadrilateral,
        ground: Paint,
        lists: &Lists,
        record: &mut R,
    ) -> Paint {
        let mut counts = [0u32; 1 << FEW];
        quad.for_each_sample(self.settings.samples, |at| {
            let mut kind = 0;
            for (bit, involved) in lists.partly().enumerate() {
                kind |= usize::from(self.is_in(involved, at, lists)) << bit;
            }
            counts[kind] += 1;
            record.step(|| {
                let within = lists.partly().enumerate().filter(|(bit, _)| kind >> bit & 1 == 1);
                Step::Sample { at, within: within.map(|(_, involved)| involved.area).collect() }
            });
        });
        let mut sum = Paint::CLEAR;
        for (kind, count) in counts.into_iter().enumerate().filter(|(_, count)| *count > 0) {
            let partial_before =
                |at: usize| lists.involved[..at].iter().filter(|i| !i.near.is_empty()).count();
            let is_in = |at: usize| lists.involved[at].near.is_empty() || kind >> partial_before(at) & 1 == 1;
            sum = sum.plus(self.compose(ground, &lists.involved, is_in).times(f64::from(count)));
        }
        sum
    }

    /// Lists the areas with a part in the pixel, in draw order: those whose edges meet it, and those that contain all of it.
    fn involve(&self, plan: Plan, lists: &mut Lists) {
        let index = self.judge.index;
        index.windings_at(plan, &mut lists.windings);
        lists.involved.clear();
        let mut start = 0;
        let mut windings = lists.windings.iter().peekable();
        let mut take_whole_below = |limit: AreaId, involved: &mut Vec<Involved>| {
            while let Some(w) = windings.next_if(|w| w.area <= limit) {
                if w.area < limit && index.rule_of(w.area).contains(w.turns) {
                    involved.push(Involved { area: w.area, near: 0..0 });
                }
            }
        };
        while start < lists.near.len() {
            let area = index.edge(lists.near[start]).area;
            let end = start + lists.near[start..].partition_point(|&e| index.edge(e).area == area);
            take_whole_below(area, &mut lists.involved);
            lists.involved.push(Involved { area, near: start..end });
            start = end;
        }
        take_whole_below(AreaId::LAST, &mut lists.involved);
    }

    /// The colour of the ground and every involved area that `is_in` says contains the sample, in draw order.
    fn compose(&self, ground: Paint, involved: &[Involved], is_in: impl Fn(usize) -> bool) -> Paint {
        let mut stack = Stack::on(ground);
        for (at, Involved { area, .. }) in involved.iter().enumerate() {
            let Some(style) = self.judge.index.painted_by(*area) else { continue };
            let cut = self.judge.index.cut_of(*area);
            let is_kept = |(area, wanted): (AreaId, bool)| {
                involved.binary_search_by_key(&area, |i| i.area).is_ok_and(&is_in) == wanted
            };
            if is_in(at) && cut.is_none_or(is_kept) {
                let paint = self.paints[style as usize];
                stack.draw(self.judge.index.group_of(style), |below| {
                    self.backdrop.compositor.over(below, paint)
                });
            }
        }
        stack.finished()
    }

    #[inline]
    fn is_in(&self, involved: &Involved, sample: Plan, lists: &Lists) -> bool {
        involved.near.is_empty()
            || self.judge.contains(involved.area, &lists.ready[involved.near.clone()], sample)
    }
}
