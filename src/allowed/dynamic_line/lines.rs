//! The segments that a view may have of dynamic lines, with their boxes on the screen (3.2.2, 3.3, 4.2.2, 4.3).
//!
//! Input: the draw list's strokes in pixels, the terrain, a view. Output: [`Lines`], which tell of a patch of the surface whether an item holds it. Refuses:
//! nothing.

use super::kept::{Pixels, Stretch, stretches};
use super::outline::{Outline, screen};
use super::patch::{Patch, to_segment};
use crate::allowed::model::{Guess, View};
use crate::certainty::Known;
use crate::draw_list::Chain;
use crate::index::BoxTree;
use crate::math;
use crate::parallel;
use crate::scene::Width;
use crate::space::{Lens, Plan, PlanBox, ViewFrame, World};
use crate::technique::dynamic_line::{Boxes, Culling, Settings, Simplification};
use crate::terrain::Mesh;
use glam::DVec2;

/// A segment that a view may have.
#[derive(Debug, Clone)]
pub(super) struct Segment {
    ends: [World; 2],
    /// Whether it is kept by the vertices that the frustum holds.
    kept: Known,
    /// What its box may cover, by its neighbours; none: the whole screen.
    outlines: Vec<Option<Outline>>,
    /// Its box's corners in the plan by its first neighbours: at the start left and right, at the end right and left.
    plan: [Plan; 4],
    /// What of it lies before the near plane.
    picture: Option<Picture>,
}

/// A segment on the screen.
#[derive(Debug, Clone, Copy)]
struct Picture {
    screen: [Plan; 2],
    world: [World; 2],
    /// View depths; 1 where rays are parallel.
    depth: [f64; 2],
}

/// What may be drawn between two vertices that are surely kept.
#[derive(Debug)]
struct Piece {
    item: u32,
    /// The number of its chain.
    chain: u32,
    /// Half the line's width, pixels.
    half_px: f64,
    /// Each way that it may be made of segments.
    ways: Vec<Vec<Segment>>,
    is_wild: bool,
}

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

/// How far a box is grown for thin lines (ours: `docs/semantics.md`).
const THIN_MARGIN: f64 = 0.75;

/// Chains that one piece of parallel work looks at.
const CHAINS_AT_A_TIME: usize = 64;

/// What single precision does to a place, as a share of its coordinates: some roundings.
const SHARE: f64 = 1.0 / (1 << 21) as f64;

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

impl Segment {
    fn covers(&self, centre: Plan, shift: f64) -> Known {
        let told = self
            .outlines
            .iter()
            .map(|outline| outline.as_ref().map_or(Known::Out, |of| of.holds(centre, shift)));
        told.reduce(|a, b| if a == b { a } else { Known::Open }).unwrap_or(Known::In)
    }
}

impl Piece {
    /// What its picture and thin lines' reach beside it may cover of the screen.
    fn picture(&self) -> PlanBox {
        let ends = self
            .ways
            .iter()
            .flatten()
            .filter_map(|segment| segment.picture)
            .flat_map(|picture| picture.screen);
        let around = PlanBox::around(ends);
        if around.is_empty() { around } else { around.grown(THIN_MARGIN) }
    }
}

/// Half the width in pixels of an item's stroke, where it is in pixels.
fn half_px(view: &View, item: u32) -> Option<f64> {
    match view.stage.draw_list.style_of(item).stroke?.width {
        Width::Pixels(width) => Some(width / 2.0),
        Width::Metres(_) => None,
    }
}

/// A vertex of a part.
struct Vertex {
    at: World,
    /// Whether the frustum holds it.
    inside: Known,
}

/// Makes pieces of chains.
struct Maker<'a> {
    frame: &'a ViewFrame,
    list: &'a crate::draw_list::DrawList,
    mesh: &'a Mesh,
    settings: &'a Settings,
    /// The longest part, metres.
    l_max: f64,
    /// Between which heights boxes stand.
    walls: [f64; 2],
    /// What a vertex without terrain under it stands at.
    middle: f64,
    eye: Option<World>,
    pixel: f64,
    shift: f64,
    single: f64,
    is_thin: bool,
}

impl<'a> Maker<'a> {
    fn new(
        view: &View<'a>,
        guess: &Guess,
        settings: &'a Settings,
        (mesh, is_thin): (&'a Mesh, bool),
    ) -> Self {
        let frame = view.frame;
        let (low, high) = mesh.heights().unwrap_or_default();
        // 4.3.2: a small offset.
        let offset = (high - low) / 1024.0 + mesh.resolution() / 64.0;
        let is_central = matches!(frame.lens(), Lens::Central { .. });
        Self {
            frame,
            list: &view.stage.draw_list,
            mesh,
            settings,
            l_max: settings.l_max.unwrap_or_else(|| mesh.resolution() / 2.0),
            walls: [low - offset, high + offset],
            middle: (low + high) / 2.0,
            eye: is_central.then(|| frame.eye()),
            pixel: frame.lens().pixel(),
            shift: guess.envelope.shift(),
            single: guess.envelope.single(),
            is_thin,
        }
    }

    /// The pieces of a chain.
    fn pieces(&self, (item, half_px): (u32, f64), (number, chain): (u32, &Chain)) -> Vec<Piece> {
        let vertices: Vec<Vertex> = self.places(chain).into_iter().map(|at| self.vertex(at)).collect();
        let pixels: Vec<Pixels> = vertices.iter().map(|vertex| self.pixels(vertex.at)).collect();
        let stretches = stretches(&pixels, chain.is_closed);
        let at = |k: u32| &vertices[k as usize % vertices.len()];
        let count = stretches.len();
        let mut pieces = Vec::with_capacity(count);
        for (k, stretch) in stretches.iter().enumerate() {
            let neighbour = |step: usize, pick: &dyn Fn(&Vec<u32>) -> Option<u32>| -> Vec<Option<u32>> {
                let is_end = if step == 1 { k + 1 == count } else { k == 0 };
                if is_end && !chain.is_closed {
                    return vec![None];
                }
                let mut all: Vec<Option<u32>> = stretches[(k + step) % count].rows.iter().map(pick).collect();
                all.dedup();
                all
            };
            let before = neighbour(count - 1 + usize::from(count == 1), &|row| {
                row.len().checked_sub(2).map(|k| row[k])
            });
            let after = neighbour(1, &|row| row.get(1).copied());
            let pairs = |stretch: &Stretch, row: &Vec<u32>| -> Vec<[usize; 2]> {
                match (row.len(), stretch.is_wild) {
                    (1, _) if vertices.len() == 1 => vec![[0, 0]],
                    (len, true) => (0..len).flat_map(|p| (p + 1..len).map(move |q| [p, q])).collect(),
                    (len, false) => (1..len).map(|q| [q - 1, q]).collect(),
                }
            };
            let way = |row: &Vec<u32>| -> Vec<Segment> {
                let segment = |[p, q]: [usize; 2]| {
                    let befores = if p > 0 { vec![Some(row[p - 1])] } else { before.clone() };
                    let afters = if q + 1 < row.len() { vec![Some(row[q + 1])] } else { after.clone() };
                    let plans = |of: Vec<Option<u32>>| -> Vec<Option<Plan>> {
                        of.into_iter().map(|k| k.map(|k| at(k).at.plan())).collect()
                    };
                    self.segment([at(row[p]), at(row[q])], half_px, [plans(befores), plans(afters)])
                };
                pairs(stretch, row).into_iter().map(segment).collect()
            };
            let ways = stretch.rows.iter().map(way).collect();
            pieces.push(Piece { item, chain: number, half_px, ways, is_wild: stretch.is_wild });
        }
        pieces.retain(|piece| piece.ways.iter().flatten().any(|segment| segment.kept != Known::Out));
        pieces
    }

    /// Algorithm 3.1: the ends of a chain's parts, on the terrain. A closed chain's last one is its first, which is left out.
    fn places(&self, chain: &Chain) -> Vec<World> {
        let path = self.list.path_of(chain);
        let mut places = Vec::new();
        for ends in path.windows(2) {
            let length = (ends[1] - ends[0]).length();
            let count = if length > self.l_max { (length / self.l_max).floor() + 1.0 } else { 1.0 };
            let step = (ends[1] - ends[0]) / count;
            places.extend((0..count as u64).map(|k| ends[0] + step * k as f64));
        }
        if !chain.is_closed || path.len() < 2 {
            places.extend(path.last().copied());
        }
        let on_terrain = |at: Plan| World::new(at.x, at.y, self.mesh.height_at(at).unwrap_or(self.middle));
        places.into_iter().map(on_terrain).collect()
    }

    fn vertex(&self, at: World) -> Vertex {
        let (depth, doubt) = (self.frame.depth(at), self.doubt(at));
        let is_between = depth >= self.frame.near() && depth < self.frame.far();
        let inside = match screen(self.frame, at).filter(|_| is_between) {
            None => Known::Out,
            Some(on) => {
                let size = [self.frame.width() as f64, self.frame.height() as f64];
                let within =
                    |by: f64| on.x >= by && on.y >= by && on.x <= size[0] - by && on.y <= size[1] - by;
                match [within(doubt), within(-doubt)] {
                    [true, _] => Known::In,
                    [_, true] => Known::Open,
                    _ => Known::Out,
                }
            }
        };
        Vertex { at, inside }
    }

    /// How far from its place on the screen single precision may put a point, pixels.
    fn doubt(&self, at: World) -> f64 {
        let size = |p: World| p.to_vec().abs().max_element();
        self.single + SHARE * (size(at) + size(self.frame.eye())) / self.frame.pixel_m(at)
    }

    /// The pixels that a vertex may lie in, where it matters.
    fn pixels(&self, at: World) -> Pixels {
        let on = screen(self.frame, at).filter(|_| self.settings.simplification == Simplification::SamePixel);
        Pixels::of(on, self.doubt(at))
    }

    fn segment(&self, [start, end]: [&Vertex; 2], half_px: f64, around: [Vec<Option<Plan>>; 2]) -> Segment {
        let kept = match self.settings.culling {
            Culling::Vertices => start.inside.or(end.inside),
            Culling::Boxes => Known::In,
        };
        let ends = [start.at, end.at];
        let mut outlines = Vec::new();
        if self.settings.boxes != Boxes::Enclosing {
            for before in &around[0] {
                let plans = around[1].iter().map(|after| self.corners(ends, half_px, [*before, *after]));
                outlines.extend(plans.map(|plan| self.outline(&plan)));
            }
            outlines.dedup();
        }
        let plan = self.corners(ends, half_px, [around[0][0], around[1][0]]);
        let picture = if self.is_thin { self.picture(ends) } else { None };
        Segment { ends, kept, outlines, plan, picture }
    }

    /// Algorithms 3.3 and 3.4: the corners of a segment's box in the plan.
    fn corners(&self, ends: [World; 2], half_px: f64, around: [Option<Plan>; 2]) -> [Plan; 4] {
        let [start, end] = ends.map(World::plan);
        let sizes = ends.map(|p| self.frame.pixel_m(p));
        let half = half_px * math::max(sizes[0], sizes[1]);
        let along = unit(end - start).unwrap_or(DVec2::X);
        let is_mitred = self.settings.boxes == Boxes::Mitred;
        let mitre = |points: Option<[Plan; 3]>| points.filter(|_| is_mitred).and_then(mitre);
        let front = mitre(around[0].map(|before| [before, start, end])).unwrap_or(along.perp()) * half;
        let back = mitre(around[1].map(|after| [start, end, after])).unwrap_or(along.perp()) * half;
        let on = |neighbour: Option<Plan>| {
            if neighbour.is_none() || !is_mitred { along * half } else { DVec2::ZERO }
        };
        let (from, to) = (start + -on(around[0]), end + on(around[1]));
        [from + front, from + -front, to + -back, to + back]
    }

    /// What the box over some corners may cover of the screen.
    fn outline(&self, corners: &[Plan; 4]) -> Option<Outline> {
        let points: Vec<World> =
            corners.iter().flat_map(|p| self.walls.map(|z| World::new(p.x, p.y, z))).collect();
        Outline::of_solid(self.frame, &points, if self.is_thin { THIN_MARGIN } else { 0.0 })
    }

    fn picture(&self, mut world: [World; 2]) -> Option<Picture> {
        let frame = self.frame;
        let off = world.map(|p| frame.depth(p) - frame.near());
        if off[0] < 0.0 && off[1] < 0.0 {
            return None;
        }
        let cut = world[0] + (world[1] - world[0]) * (off[0] / (off[0] - off[1]));
        (0..2).filter(|k| off[*k] < 0.0).for_each(|k| world[k] = cut);
        let on = world.map(|p| frame.screen_from_world(p).map(|at| Plan::new(at.x, at.y)));
        let depth = world.map(|p| if self.eye.is_some() { frame.depth(p) } else { 1.0 });
        Some(Picture { screen: [on[0]?, on[1]?], world, depth })
    }

    /// What a piece may reach in the plan: reach = growth * r, r <= the distance of (far + reach, away).
    fn reach_of(&self, piece: &Piece) -> PlanBox {
        let ends = piece.ways.iter().flatten().flat_map(|segment| segment.ends);
        let around = PlanBox::around(ends.clone().map(World::plan));
        let growth = piece.half_px * self.pixel;
        let Some(eye) = self.eye else { return around.grown(growth * (1.0 + 1e-6)) };
        let away = self.walls.iter().map(|z| (z - eye.z).abs()).fold(0.0, math::max);
        let far = ends.map(|p| (p.plan() - eye.plan()).length()).fold(0.0, math::max);
        let reach = growth * (far + away) / (1.0 - growth);
        around.grown(if growth < 1.0 { reach * (1.0 + 1e-6) } else { f64::INFINITY })
    }
}

fn unit(v: DVec2) -> Option<DVec2> {
    let length = v.length();
    (length > 0.0).then(|| v / length)
}

/// 1 + cos of a turn below which a line runs straight back, and has no mitre (`docs/semantics.md`).
const STRAIGHT_BACK: f64 = 1e-6;

/// From a vertex to where the left sides of both its segments meet, for a line of half width 1.
fn mitre([before, at, after]: [Plan; 3]) -> Option<DVec2> {
    let (into, out) = (unit(at - before)?, unit(after - at)?);
    let share = 1.0 + into.dot(out);
    (share > STRAIGHT_BACK).then(|| (into + out).perp() / share)
}
