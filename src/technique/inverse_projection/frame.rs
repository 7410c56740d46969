//! One frame: quadrilaterals, classes, samples, means.

use super::edge_index::{EdgeIndex, Winding};
use super::judgment::{Judge, NearEdge};
use super::quadrilateral::Quadrilateral;
use crate::buffer::{Buffer, Plane, Values};
use crate::parallel;
use crate::raster::Lattice;
use crate::resolve::{Compositor, GroundPaint, Paint, code_values};
use crate::scene::{Corners, InverseProjection, Silhouette};
use crate::space::{Plan, PlanBox, ViewFrame};
use crate::stage::Stage;
use crate::technique::{Frame, FrameOptions};
use crate::terrain::SKY;
use crate::visibility::{Hit, Sight};
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The classes of pixels (She 3.3), as the `class` buffer holds them.
const N: u8 = 0;
const P: u8 = 1;
const F: u8 = 2;

/// Up to so many areas partly in a pixel, samples are told apart by which of them they lie in.
const FEW: usize = 4;

/// A quadrilateral's side may be so many times longer than the longer of the sides that the planes of its two ends
/// would give it, before it counts as spanning a silhouette.
const SILHOUETTE_RATIO: f64 = 8.0;

/// Draws a frame of a view.
pub fn draw(
    (stage, view): (&Stage, &ViewFrame),
    settings: &InverseProjection,
    index: &EdgeIndex,
    options: &FrameOptions,
) -> Frame {
    let centres = Seen::new((stage, view), &Lattice::centres(view, 1), options.tile);
    let corners = match settings.corners {
        Corners::Centres => None,
        Corners::True => Some(Seen::new((stage, view), &Lattice::corners(view), options.tile)),
    };
    (options.progress)(0.5);
    let compositor = Compositor::new(stage.scene.compositing);
    let wants = |name: &str| options.buffers.iter().any(|b| b == name);
    let drawing = Drawing {
        settings,
        judge: Judge { index, rule: settings.point_in_polygon },
        ground: GroundPaint::new(&stage.scene.ground, &stage.mesh, compositor),
        paints: index.areas().iter().map(|a| a.color.map(|c| compositor.paint(c))).collect(),
        sky: compositor.paint(stage.scene.image.background),
        compositor,
        wants: Wants { colors: wants("color"), quads: wants("quad") },
        centres,
        corners,
    };
    let (width, height) = (view.width(), view.height());
    let done = AtomicUsize::new(0);
    let rows = parallel::map_indices(height, |y| {
        let row = drawing.row(y, width);
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        (options.progress)(0.5 + 0.5 * done as f64 / height as f64);
        row
    });
    drawing.frame((width, height), rows, options)
}

/// Everything that pixels are made from.
struct Drawing<'a> {
    settings: &'a InverseProjection,
    judge: Judge<'a>,
    ground: GroundPaint<'a>,
    /// What each area is painted with.
    paints: Vec<Option<Paint>>,
    sky: Paint,
    compositor: Compositor,
    wants: Wants,
    /// What the pixels' centres see, and those of the pixels around the picture.
    centres: Seen<'a>,
    /// What the pixels' corners see, where those are asked for.
    corners: Option<Seen<'a>>,
}

/// Which buffers are kept on the way because someone asked for them.
struct Wants {
    colors: bool,
    quads: bool,
}

/// What a lattice sees, with the plan points at hand.
struct Seen<'a> {
    stage: &'a Stage,
    view: &'a ViewFrame,
    lattice: Lattice,
    sight: Sight<'a>,
    /// Rows from the top; infinite where the sky is seen.
    plan: Vec<Plan>,
}

/// A row of finished pixels.
#[derive(Default)]
struct Row {
    image: Vec<[u8; 4]>,
    colors: Vec<f64>,
    classes: Vec<u8>,
    edges: Vec<u32>,
    quads: Vec<f64>,
    counts: Counts,
}

#[derive(Default, Clone, Copy)]
struct Counts {
    classes: [u64; 3],
    refused: u64,
    samples: u64,
    edge_tests: u64,
}

/// Room for the lists of one pixel, used again from pixel to pixel.
struct Lists {
    /// The last triangle and its ground.
    ground: (u32, Paint),
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
    area: u32,
    /// Its edges that meet the pixel, as a range of the list of near edges; empty: the whole pixel lies in the area.
    near: Range<usize>,
}

impl<'a> Seen<'a> {
    fn new((stage, view): (&'a Stage, &'a ViewFrame), lattice: &Lattice, tile: usize) -> Self {
        let mut sight = Sight::new(view, &stage.mesh, &stage.scene.device, *lattice, tile);
        sight.see();
        let mut plan = vec![Plan::new(f64::INFINITY, f64::INFINITY); lattice.columns * lattice.rows];
        parallel::for_each_chunk(&mut plan, lattice.columns, |row, points| {
            sight.plan_of_row(row, points);
        });
        Self { stage, view, lattice: *lattice, sight, plan }
    }

    #[inline(always)]
    fn plan(&self, (column, row): (usize, usize)) -> Plan {
        self.plan[row * self.lattice.columns + column]
    }

    /// Whether the side between two neighbours is too long for the planes that its ends lie on.
    fn spans_silhouette(&self, from: (usize, usize), to: (usize, usize)) -> bool {
        let ids = [from, to].map(|(column, row)| self.sight.triangle(column, row));
        if ids[0] == ids[1] {
            return false;
        }
        let length = (self.plan(to) - self.plan(from)).length_squared();
        let limit = SILHOUETTE_RATIO * SILHOUETTE_RATIO;
        let expected = |id: u32, at: (usize, usize), seen_from: (usize, usize)| {
            let ray = self.view.ray(self.lattice.at(seen_from.0, seen_from.1));
            let hit: Option<Hit> =
                self.stage.mesh.triangle(id).map(|t| crate::visibility::hit(self.view, &ray, &t));
            // A plane that the neighbour's ray misses would reach to the horizon.
            hit.filter(|h| h.depth > 0.0).map_or(f64::INFINITY, |h| (h.plan - self.plan(at)).length_squared())
        };
        length > limit * expected(ids[0], from, to) && length > limit * expected(ids[1], to, from)
    }
}

impl Drawing<'_> {
    fn row(&self, y: usize, width: usize) -> Row {
        let mut row =
            Row { image: Vec::with_capacity(width), classes: Vec::with_capacity(width), ..Row::default() };
        let mut lists = Lists {
            ground: (SKY, self.sky),
            empty: PlanBox::EMPTY,
            near: Vec::new(),
            ready: Vec::new(),
            windings: Vec::new(),
            involved: Vec::new(),
        };
        let mut last = (self.sky, code_values(self.compositor.encoded(self.sky)));
        for x in 0..width {
            let pixel = self.pixel((x, y), &mut lists, &mut row.counts);
            if pixel.paint != last.0 {
                last = (pixel.paint, code_values(self.compositor.encoded(pixel.paint)));
            }
            row.image.push(last.1);
            row.classes.push(pixel.class);
            row.edges.push(pixel.edges);
            row.counts.classes[pixel.class as usize] += 1;
            if self.wants.colors {
                row.colors.extend(self.compositor.encoded(pixel.paint));
            }
            if self.wants.quads {
                row.quads.extend(pixel.quad.0.iter().flat_map(|p| [p.x, p.y]));
            }
        }
        row
    }

    fn pixel(&self, at: (usize, usize), lists: &mut Lists, counts: &mut Counts) -> Pixel {
        // The lattice of centres starts one pixel before the picture.
        let centre = (at.0 + 1, at.1 + 1);
        let plan = self.centres.plan(centre);
        if !plan.is_finite() {
            return Pixel { paint: self.sky, class: N, edges: 0, quad: Quadrilateral::point(plan) };
        }
        let id = self.centres.sight.triangle(centre.0, centre.1);
        if !self.ground.is_constant_on_triangles() || lists.ground.0 != id {
            lists.ground = (id, self.ground.at(id, plan));
        }
        let ground = lists.ground.1;
        let Some(quad) = self.range(at) else {
            counts.refused += 1;
            return self.whole(Quadrilateral::point(plan), plan, ground, lists);
        };
        // Only where edges may be near does it matter whether the range means anything.
        let bounds = quad.bounds();
        if !self.wants.quads && lists.empty.contains(&bounds) {
            return Pixel { paint: ground, class: N, edges: 0, quad };
        }
        let may_meet_edges = self.judge.index.has_edges_near(&bounds);
        let is_doubtful =
            (may_meet_edges || self.wants.quads) && self.settings.silhouette == Silhouette::Centre;
        if is_doubtful && self.spans_silhouette(at) {
            counts.refused += u64::from(may_meet_edges);
            return self.whole(Quadrilateral::point(plan), plan, ground, lists);
        }
        lists.near.clear();
        if may_meet_edges {
            self.classify(&quad, lists);
        } else if let Some(empty) = self.judge.index.empty_cell(plan) {
            lists.empty = empty;
        }
        if lists.near.is_empty() {
            return self.whole(quad, plan, ground, lists);
        }
        counts.samples += u64::from(self.settings.samples * self.settings.samples);
        counts.edge_tests +=
            u64::from(self.settings.samples * self.settings.samples) * lists.near.len() as u64;
        Pixel { paint: self.mean(&quad, plan, ground, lists), class: P, edges: lists.near.len() as u32, quad }
    }

    /// She 3.2, Fig. 6b: the quadrilateral of a pixel from the centres of itself and its right, upper right and upper
    /// neighbours, or from its corners; `None` where one of them sees the sky.
    fn range(&self, at: (usize, usize)) -> Option<Quadrilateral> {
        let seen = self.corners.as_ref().unwrap_or(&self.centres);
        let [a, b, c, d] = self.corner_samples(at);
        let quad = Quadrilateral([seen.plan(a), seen.plan(b), seen.plan(c), seen.plan(d)]);
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
        (0..4).any(|k| seen.spans_silhouette(samples[k], samples[(k + 1) % 4]))
    }

    /// She 3.3: finds the edges that meet the quadrilateral; none: the pixel is N or F.
    fn classify(&self, quad: &Quadrilateral, lists: &mut Lists) {
        self.judge.index.edges_near(quad, &mut lists.near);
        lists.near.retain(|&e| {
            let edge = self.judge.index.edge(e);
            quad.meets(edge.a, edge.b)
        });
    }

    /// A pixel without edges: N, or F in the areas around its centre.
    fn whole(&self, quad: Quadrilateral, plan: Plan, ground: Paint, lists: &mut Lists) -> Pixel {
        lists.near.clear();
        self.involve(plan, lists);
        if lists.involved.is_empty() {
            return Pixel { paint: ground, class: N, edges: 0, quad };
        }
        let is_covered = lists.involved.iter().any(|i| self.paints[i.area as usize].is_some());
        let paint = self.compose(ground, &lists.involved, |_| true);
        Pixel { paint, class: if is_covered { F } else { N }, edges: 0, quad }
    }

    /// She 3.5: the mean of the composed colours of the samples (3.4).
    fn mean(&self, quad: &Quadrilateral, plan: Plan, ground: Paint, lists: &mut Lists) -> Paint {
        self.involve(plan, lists);
        lists.ready.clear();
        lists.ready.extend(lists.near.iter().map(|&e| NearEdge::new(self.judge.index.edge(e))));
        let partial = lists.involved.iter().filter(|i| !i.near.is_empty()).count();
        let n = self.settings.samples;
        let sum = if partial <= FEW {
            self.sum_of_kinds(quad.samples(n), ground, lists)
        } else {
            quad.samples(n).fold(Paint::CLEAR, |sum, sample| {
                let is_in = |at: usize| self.is_in(&lists.involved[at], sample, lists);
                sum.plus(self.compose(ground, &lists.involved, is_in))
            })
        };
        sum.divided_by(f64::from(n * n))
    }

    /// The sum of the samples' colours where few areas are partly in the pixel: samples in the same areas have the same colour,
    /// which is composed once.
    fn sum_of_kinds(&self, samples: impl Iterator<Item = Plan>, ground: Paint, lists: &Lists) -> Paint {
        let mut counts = [0u32; 1 << FEW];
        for sample in samples {
            let mut kind = 0;
            for (bit, involved) in lists.involved.iter().filter(|i| !i.near.is_empty()).enumerate() {
                kind |= usize::from(self.is_in(involved, sample, lists)) << bit;
            }
            counts[kind] += 1;
        }
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
        let mut take_whole_below = |limit: u32, involved: &mut Vec<Involved>| {
            while let Some(w) = windings.next_if(|w| w.area <= limit) {
                if w.area < limit && index.areas()[w.area as usize].rule.contains(w.turns) {
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
        take_whole_below(u32::MAX, &mut lists.involved);
    }

    /// The colour of the ground and every involved area that `is_in` says contains the sample, in draw order.
    fn compose(&self, ground: Paint, involved: &[Involved], is_in: impl Fn(usize) -> bool) -> Paint {
        let mut paint = ground;
        for (at, Involved { area, .. }) in involved.iter().enumerate() {
            let Some(source) = self.paints[*area as usize] else { continue };
            let cut = self.judge.index.areas()[*area as usize].cut;
            let is_kept = |(area, wanted): (u32, bool)| {
                involved.binary_search_by_key(&area, |i| i.area).is_ok_and(&is_in) == wanted
            };
            if is_in(at) && cut.is_none_or(is_kept) {
                paint = self.compositor.over(paint, source);
            }
        }
        paint
    }

    #[inline]
    fn is_in(&self, involved: &Involved, sample: Plan, lists: &Lists) -> bool {
        involved.near.is_empty()
            || self.judge.contains(involved.area, &lists.ready[involved.near.clone()], sample)
    }

    fn frame(&self, (width, height): (usize, usize), rows: Vec<Row>, options: &FrameOptions) -> Frame {
        let image = Buffer::from_values(width, height, rows.iter().flat_map(|r| &r.image).copied().collect());
        let wants = |name: &str| options.buffers.iter().any(|b| b == name);
        let plane = |name, components, values| Plane { name, width, height, components, values };
        let mut planes = Vec::new();
        if ["depth", "triangle", "plan"].into_iter().any(wants) {
            planes.extend(self.surface_planes((width, height)).into_iter().filter(|p| wants(p.name)));
        }
        if wants("color") {
            planes.push(plane(
                "color",
                4,
                Values::F64(rows.iter().flat_map(|r| &r.colors).copied().collect()),
            ));
        }
        if wants("class") {
            planes.push(plane(
                "class",
                1,
                Values::U8(rows.iter().flat_map(|r| &r.classes).copied().collect()),
            ));
        }
        if wants("quad") {
            planes.push(plane("quad", 8, Values::F64(rows.iter().flat_map(|r| &r.quads).copied().collect())));
        }
        if wants("edges") {
            planes.push(plane(
                "edges",
                1,
                Values::U32(rows.iter().flat_map(|r| &r.edges).copied().collect()),
            ));
        }
        Frame { image, planes, counts: self.counts(&rows) }
    }

    /// What the pixels' centres see: depth (infinite: sky), triangle, plan point (both infinite in the sky).
    fn surface_planes(&self, (width, height): (usize, usize)) -> [Plane; 3] {
        let (mut depth, mut triangle, mut plan) = (Vec::new(), Vec::new(), Vec::new());
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x + 1, y + 1))) {
            let hit = self.centres.sight.hit(x, y);
            depth.push(hit.map_or(f64::INFINITY, |h| h.depth));
            triangle.push(if hit.is_some() { self.centres.sight.triangle(x, y) } else { SKY });
            let at = hit.map_or(Plan::new(f64::INFINITY, f64::INFINITY), |h| h.plan);
            plan.extend([at.x, at.y]);
        }
        let plane = |name, components, values| Plane { name, width, height, components, values };
        [
            plane("depth", 1, Values::F64(depth)),
            plane("triangle", 1, Values::U32(triangle)),
            plane("plan", 2, Values::F64(plan)),
        ]
    }

    fn counts(&self, rows: &[Row]) -> Vec<(&'static str, u64)> {
        let seen = self.centres.sight.counts();
        let sum = |f: &dyn Fn(&Counts) -> u64| rows.iter().map(|r| f(&r.counts)).sum();
        vec![
            ("areas", self.judge.index.areas().len() as u64),
            ("edges", self.judge.index.edge_count() as u64),
            ("pixels_n", sum(&|c| c.classes[N as usize])),
            ("pixels_p", sum(&|c| c.classes[P as usize])),
            ("pixels_f", sum(&|c| c.classes[F as usize])),
            ("refused", sum(&|c| c.refused)),
            ("samples", sum(&|c| c.samples)),
            ("edge_tests", sum(&|c| c.edge_tests)),
            ("triangles_drawn", seen.triangles),
            ("hidden_nodes", seen.hidden_nodes),
            ("exact_decisions", seen.exact_decisions),
        ]
    }
}

/// A finished pixel.
struct Pixel {
    paint: Paint,
    class: u8,
    /// How many edges meet its quadrilateral.
    edges: u32,
    quad: Quadrilateral,
}
