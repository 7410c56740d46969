//! Chains of dynamic lines made into the pieces that a view may have of them, with their boxes on the screen (3.2.2, 3.3, 4.2.2, 4.3).

use super::kept::{Pixels, Stretch, stretches};
use super::outline::{Outline, screen};
use super::segment::{Picture, Piece, SHARE, Segment, THIN_MARGIN};
use crate::allowed::model::{Guess, View};
use crate::certainty::Known;
use crate::draw_list::Chain;
use crate::math;
use crate::space::{Lens, Plan, PlanBox, ViewFrame, World};
use crate::technique::dynamic_line::{Boxes, Culling, Settings, Simplification};
use crate::terrain::Mesh;
use glam::DVec2;

/// A vertex of a part.
struct Vertex {
    at: World,
    /// Whether the frustum holds it.
    inside: Known,
}

/// Makes pieces of chains.
pub(super) struct Maker<'a> {
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
    pub(super) eye: Option<World>,
    pub(super) pixel: f64,
    pub(super) shift: f64,
    single: f64,
    is_thin: bool,
}

impl<'a> Maker<'a> {
    /// By a technique's settings; `is_thin`: thin lines are corrected.
    pub(super) fn new(
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
    pub(super) fn pieces(&self, (item, half_px): (u32, f64), (number, chain): (u32, &Chain)) -> Vec<Piece> {
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
    pub(super) fn reach_of(&self, piece: &Piece) -> PlanBox {
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
