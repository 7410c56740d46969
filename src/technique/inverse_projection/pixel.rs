//! One pixel: its quadrilateral, its class, its samples, their mean.

use super::edge_index::{Around, EdgeIndex};
use super::expansion::AreaId;
use super::judgment::{NearEdge, Part};
use super::quadrilateral::Quadrilateral;
use super::samples::{Places, Within};
use super::step::{EdgeOf, PixelClass, Refusal, Step};
use crate::canvas::{Backdrop, GBuffer, LastGround, Record};
use crate::raster::Lattice;
use crate::resolve::{Paint, Stack};
use crate::space::{Plan, PlanBox, ViewFrame};
use crate::stage::Stage;
use crate::technique::inverse_projection::{Corners, PointInPolygon, Settings, Silhouette};
use crate::terrain::Mesh;
use crate::visibility::hit;
use std::ops::Range;

/// Up to so many areas partly in a pixel, samples are told apart by which of them they lie in.
const FEW: usize = 4;

/// So many neighbours in a row are looked at together for the edges around them.
const NEIGHBOURS: usize = 16;

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
    index: &'a EdgeIndex<'a>,
    places: Places,
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
    neighbourhood: Neighbourhood,
    /// What winds around the centre of the pixel, or of the one before.
    around: Around,
    near: Vec<u32>,
    /// The near edges made ready for many samples.
    ready: Vec<NearEdge>,
    involved: Vec<Involved>,
    /// The areas with an edge in the pixel, in draw order.
    parts: Vec<Part>,
    within: Within,
}

/// Neighbours in a row, and the edges that may meet the quadrilaterals of any of them.
struct Neighbourhood {
    row: usize,
    columns: Range<usize>,
    edges: Vec<u32>,
    /// Whether they lie close together; if not, each looks for its own edges.
    is_close: bool,
}

/// An area that has a part in a pixel.
struct Involved {
    area: AreaId,
    /// Its place among the areas with an edge in the pixel; `None`: the whole pixel lies in the area.
    part: Option<usize>,
}

/// What a pixel's centre sees.
struct Centre {
    plan: Plan,
    /// The terrain's own paint there.
    ground: Paint,
}

impl Lists {
    /// The areas with a part in the pixel, as a step.
    fn areas(&self) -> Step {
        let whole = self.involved.iter().filter(|involved| involved.part.is_none());
        Step::Areas {
            whole: whole.map(|involved| involved.area).collect(),
            partly: self.parts.iter().map(|part| part.area).collect(),
        }
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
            index,
            places: Places::new(settings.samples),
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
            neighbourhood: Neighbourhood { row: 0, columns: 0..0, edges: Vec::new(), is_close: false },
            around: Around::nowhere(),
            near: Vec::new(),
            ready: Vec::new(),
            involved: Vec::new(),
            parts: Vec::new(),
            within: Within::default(),
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
        let may_meet_edges = self.index.has_edges_near(&bounds);
        let is_doubtful =
            (may_meet_edges || self.keeps_quads) && self.settings.silhouette == Silhouette::Centre;
        if is_doubtful && self.spans_silhouette(at) {
            counts.refused += u64::from(may_meet_edges);
            record.step(|| Step::Refused(Refusal::Silhouette));
            return self.whole(Quadrilateral::point(plan), &centre, lists, record);
        }
        lists.near.clear();
        if may_meet_edges {
            self.classify(at, (&quad, &bounds), lists);
        } else if let Some(empty) = self.index.empty_cell(plan) {
            lists.empty = empty;
        }
        if lists.near.is_empty() {
            let pixel = self.whole(quad, &centre, lists, record);
            self.move_on(&quad, lists);
            return pixel;
        }
        let (samples, edges) = (u64::from(self.settings.samples * self.settings.samples), lists.near.len());
        counts.samples += samples;
        counts.edge_tests += samples * edges as u64;
        record.step(|| Step::NearEdges(lists.near.iter().map(|&edge| self.edge_of(edge)).collect()));
        record.step(|| Step::Class(PixelClass::P));
        let paint = self.mean(&quad, &centre, lists, record);
        self.move_on(&quad, lists);
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
    fn classify(&self, at: (usize, usize), (quad, bounds): (&Quadrilateral, &PlanBox), lists: &mut Lists) {
        let around = &mut lists.neighbourhood;
        if around.row != at.1 || !around.columns.contains(&at.0) {
            self.look_around(at, around);
        }
        if around.is_close {
            lists.near.extend_from_slice(&around.edges);
        } else {
            self.index.edges_near(quad, &mut lists.near);
        }
        lists.near.retain(|&e| {
            let edge = self.index.edge(e);
            !edge.passes_by(bounds) && quad.meets(bounds, edge.a, edge.b)
        });
    }

    /// Finds the edges around a pixel and its neighbours to the right.
    fn look_around(&self, (column, row): (usize, usize), around: &mut Neighbourhood) {
        around.row = row;
        around.columns = column..self.view.width().min(column + NEIGHBOURS);
        let mut bounds = PlanBox::EMPTY;
        for quad in around.columns.clone().filter_map(|column| self.range((column, row))) {
            bounds.include_box(&quad.bounds());
        }
        around.is_close = self.index.edges_in(&bounds, &mut around.edges);
    }

    /// What winds around the next pixel's centre: it is a corner of this one's quadrilateral, so that whatever lies between meets that.
    fn move_on(&self, quad: &Quadrilateral, lists: &mut Lists) {
        if self.corners.is_none() {
            self.index.move_straight(quad.0[1], &lists.near, &mut lists.around);
        }
    }

    fn edge_of(&self, edge: u32) -> EdgeOf {
        let edge = self.index.edge(edge);
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
        let is_covered = lists.involved.iter().any(|i| self.index.painted_by(i.area).is_some());
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
        lists.ready.extend(lists.near.iter().map(|&e| NearEdge::new(self.index.edge(e))));
        let at = (&self.places, quad);
        match self.settings.point_in_polygon {
            PointInPolygon::EdgeNormals => lists.within.judge(at, &lists.parts, &lists.ready),
            PointInPolygon::Winding => lists.within.wind(at, &lists.parts, self.index),
        }
        for k in 0..self.places.count() {
            record.step(|| {
                let parts = lists.parts.iter().enumerate();
                let within = parts.filter(|(part, _)| lists.within.holds(*part, k));
                let within = within.map(|(_, part)| part.area).collect();
                Step::Sample { at: self.places.at(quad, k), within }
            });
        }
        let sum = if lists.parts.len() <= FEW {
            self.sum_of_kinds(centre.ground, lists)
        } else {
            self.sum_of_samples(centre.ground, lists)
        };
        let mean = sum.divided_by(self.places.count() as f64);
        record.step(|| Step::Mean(mean));
        mean
    }

    /// The sum of the samples' colours where few areas are partly in the pixel: samples in the same areas have the same colour,
    /// which is composed once.
    fn sum_of_kinds(&self, ground: Paint, lists: &Lists) -> Paint {
        let mut counts = [0u32; 1 << FEW];
        let samples = self.places.count();
        if lists.parts.len() == 1 {
            let held = (0..samples).map(|k| lists.within.first_parts(k) as u32).sum();
            (counts[0], counts[1]) = (samples as u32 - held, held);
        } else {
            (0..samples).for_each(|k| counts[lists.within.first_parts(k) as usize] += 1);
        }
        let mut sum = Paint::CLEAR;
        for (kind, count) in counts.into_iter().enumerate().filter(|(_, count)| *count > 0) {
            let is_in = |at: usize| lists.involved[at].part.is_none_or(|part| kind >> part & 1 == 1);
            sum = sum.plus(self.compose(ground, &lists.involved, is_in).times(f64::from(count)));
        }
        sum
    }

    /// The sum of the samples' colours, one by one; what lies in the same areas as the one before has its colour.
    fn sum_of_samples(&self, ground: Paint, lists: &Lists) -> Paint {
        let (mut sum, mut paint) = (Paint::CLEAR, Paint::CLEAR);
        for k in 0..self.places.count() {
            if k == 0 || !lists.within.are_alike(k - 1, k) {
                let is_in =
                    |at: usize| lists.involved[at].part.is_none_or(|part| lists.within.holds(part, k));
                paint = self.compose(ground, &lists.involved, is_in);
            }
            sum = sum.plus(paint);
        }
        sum
    }

    /// Lists the areas with a part in the pixel, in draw order: those whose edges meet it, and those that contain all of it.
    fn involve(&self, plan: Plan, lists: &mut Lists) {
        let index = self.index;
        index.move_to(plan, &mut lists.around);
        lists.involved.clear();
        lists.parts.clear();
        let mut start = 0;
        let mut windings = lists.around.windings().iter().peekable();
        let mut take_whole_below = |limit: AreaId, involved: &mut Vec<Involved>| {
            while let Some(w) = windings.next_if(|w| w.area <= limit) {
                if w.area < limit && index.rule_of(w.area).contains(w.turns) {
                    involved.push(Involved { area: w.area, part: None });
                }
            }
        };
        while start < lists.near.len() {
            let area = index.edge(lists.near[start]).area;
            let end = start + lists.near[start..].partition_point(|&e| index.edge(e).area == area);
            take_whole_below(area, &mut lists.involved);
            lists.involved.push(Involved { area, part: Some(lists.parts.len()) });
            lists.parts.push(Part { area, near: start..end });
            start = end;
        }
        take_whole_below(AreaId::LAST, &mut lists.involved);
    }

    /// The colour of the ground and every involved area that `is_in` says contains the sample, in draw order.
    fn compose(&self, ground: Paint, involved: &[Involved], is_in: impl Fn(usize) -> bool) -> Paint {
        let mut stack = Stack::on(ground);
        for (at, Involved { area, .. }) in involved.iter().enumerate() {
            let Some(style) = self.index.painted_by(*area) else { continue };
            let cut = self.index.cut_of(*area);
            let is_kept = |(area, wanted): (AreaId, bool)| {
                involved.binary_search_by_key(&area, |i| i.area).is_ok_and(&is_in) == wanted
            };
            if is_in(at) && cut.is_none_or(is_kept) {
                let paint = self.paints[style as usize];
                stack.draw(self.index.group_of(style), |below| self.backdrop.compositor.over(below, paint));
            }
        }
        stack.finished()
    }
}
