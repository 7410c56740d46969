//! Update indices (3.3.1, 4.3.1, Algorithm 3.2): of a view the segments between the vertices that it keeps.
//!
//! Input: lines on the terrain, a view. Output: [`Segment`]s in draw order, along their lines. Algorithm 3.2 as printed counts new segments
//! and names the start vertex with the same m; the start is the last vertex that was kept, and segments that the frustum culls are left out after
//! that. Pieces of lines whose boxes no line of sight can reach are not looked at, which changes nothing.
//!
//! A line of which a view keeps one vertex has no segment, and vanishes (4.3.1 does not speak of it); [`Segments::vanished`] counts them. What
//! has no second vertex by itself, a dot, is a segment of no length.

use super::camera::{Camera, P2, P3};
use super::matching::{LineChain, MatchedLines};
use super::simplify;
use crate::math;
use crate::parallel;
use crate::raster::device::Real;
use crate::scene::{Join, Width};
use crate::space::{Lens, Plan, PlanBox, ViewFrame, World};
use crate::stage::Stage;
use crate::technique::dynamic_line::{Corners, Settings, Simplification};
use crate::terrain::Mesh;

/// A segment that a view keeps, with its neighbours' far ends.
#[derive(Debug, Clone, Copy)]
pub struct Segment<T> {
    /// Its item.
    pub item: u32,
    /// The vertex before it; `None` at a line's start.
    pub before: Option<P2<T>>,
    /// Its first vertex.
    pub start: P3<T>,
    /// Its last vertex.
    pub end: P3<T>,
    /// The vertex after it; `None` at a line's end.
    pub after: Option<P2<T>>,
    /// Whether one of its vertices lies in the frustum.
    pub is_inside: bool,
}

/// The segments of a view.
#[derive(Debug)]
pub struct Segments<T> {
    /// Them, in draw order.
    pub all: Vec<Segment<T>>,
    /// How many vertices were looked at.
    pub vertices: u64,
    /// Lines with length, of which one vertex was kept.
    pub vanished: u64,
}

/// A vertex that is kept.
#[derive(Debug, Clone, Copy)]
struct Kept<T> {
    at: P3<T>,
    is_inside: bool,
    /// Whether its piece can be seen.
    is_seen: bool,
    /// A number that the vertices share whose pieces were looked at without a gap between.
    run: usize,
}

/// Chains that one piece of parallel work looks at.
const CHAINS_AT_A_TIME: usize = 64;

/// Finds the segments of a view.
pub fn segments<T: Real>(
    (stage, mesh, view): (&Stage, &Mesh, &ViewFrame),
    lines: &MatchedLines,
    camera: &Camera<T>,
) -> Segments<T> {
    let settings: Settings = stage.scene.technique.get();
    let update = Update { stage, lines, camera, settings, frustum: Frustum::new(view, mesh) };
    let found = parallel::map_indices(lines.chains.len().div_ceil(CHAINS_AT_A_TIME), |k| {
        let first = k * CHAINS_AT_A_TIME;
        let mut found = Segments { all: Vec::new(), vertices: 0, vanished: 0 };
        let end = lines.chains.len().min(first + CHAINS_AT_A_TIME);
        lines.chains[first..end].iter().for_each(|chain| update.add_chain(chain, &mut found));
        found
    });
    let mut all = Segments { all: Vec::new(), vertices: 0, vanished: 0 };
    all.all.reserve_exact(found.iter().map(|some| some.all.len()).sum());
    for mut some in found {
        all.all.append(&mut some.all);
        all.vertices += some.vertices;
        all.vanished += some.vanished;
    }
    all
}

struct Update<'a, T> {
    stage: &'a Stage,
    lines: &'a MatchedLines<'a>,
    camera: &'a Camera<T>,
    settings: Settings,
    frustum: Frustum,
}

impl<T: Real> Update<'_, T> {
    fn add_chain(&self, chain: &LineChain, found: &mut Segments<T>) {
        let growth = self.growth(chain.item);
        let pieces = chain.pieces.clone();
        let seen: Vec<bool> = pieces
            .clone()
            .map(|piece| self.frustum.may_show(&self.lines.pieces[piece as usize].plan, growth))
            .collect();
        if !seen.contains(&true) {
            return;
        }
        let (kept, is_joined) = self.kept_around(chain, &seen, found);
        if let [alone] = &kept[..] {
            let is_dot = chain.chain.segments() == 0;
            if is_dot || self.settings.simplification == Simplification::ScreenError {
                found.all.push(self.between(chain, [None, Some(alone), Some(alone), None]));
            } else {
                found.vanished += u64::from(alone.is_seen);
            }
            return;
        }
        let count = kept.len();
        // The vertex so many places on, if no other can lie between.
        let on = |k: usize, step: usize| -> Option<&Kept<T>> {
            let (from, to) = (&kept[k % count], &kept[(k + step) % count]);
            let wraps = k % count + step >= count;
            (if wraps { is_joined } else { from.run == to.run }).then_some(to)
        };
        for k in 0..count {
            let start = &kept[k];
            let Some(end) = on(k, 1).filter(|end| start.is_seen || end.is_seen) else { continue };
            let before = on(k + count - 1, 1).map(|_| &kept[(k + count - 1) % count]);
            found.all.push(self.between(chain, [before, Some(start), Some(end), on(k + 1, 1)]));
        }
    }

    fn between(&self, chain: &LineChain, [before, start, end, after]: [Option<&Kept<T>>; 4]) -> Segment<T> {
        let nothing = P3::of(World::default());
        let [from, to] = [start, end].map(|kept| kept.map_or(nothing, |kept| kept.at));
        let is_inside = [start, end].iter().flatten().any(|kept| kept.is_inside);
        let plan = |kept: Option<&Kept<T>>| kept.map(|kept| kept.at.plan());
        Segment {
            item: chain.item,
            before: plan(before),
            start: from,
            end: to,
            after: plan(after),
            is_inside,
        }
    }

    /// The kept vertices of the pieces that are seen, and beyond each run of them at least two more, in the chain's order: a segment that leaves
    /// the view ends at the first, and its mitre asks for the second. And whether the first one comes after the last.
    fn kept_around(&self, chain: &LineChain, seen: &[bool], found: &mut Segments<T>) -> (Vec<Kept<T>>, bool) {
        let count = seen.len();
        let mut of_pieces: Vec<Option<Vec<Kept<T>>>> = vec![None; count];
        let mut need = |piece: usize| -> usize {
            let kept = of_pieces[piece].get_or_insert_with(|| {
                let kept = self.kept_of(chain, (piece, count), seen[piece]);
                found.vertices += u64::from(self.lines.pieces[chain.pieces.start as usize + piece].parts) + 1;
                kept
            });
            kept.len()
        };
        for piece in (0..count).filter(|piece| seen[*piece]) {
            need(piece);
            for step in [1, count - 1] {
                let (mut at, mut more, mut steps) = (piece, 0, 1);
                while more < 2 && steps < count {
                    let is_end = if step == 1 { at + 1 == count } else { at == 0 };
                    if is_end && !chain.chain.is_closed {
                        break;
                    }
                    at = (at + step) % count;
                    more += need(at);
                    steps += 1;
                }
            }
        }
        let is_joined = chain.chain.is_closed && of_pieces[0].is_some() && of_pieces[count - 1].is_some();
        let mut all = Vec::new();
        for (run, kept) in of_pieces.into_iter().enumerate().scan(0, |run, (k, kept)| {
            *run = if kept.is_some() { *run } else { k + 1 };
            Some((*run, kept.unwrap_or_default()))
        }) {
            all.extend(kept.into_iter().map(|kept| Kept { run, ..kept }));
        }
        (all, is_joined)
    }

    /// The vertices that a view keeps of a piece. Its first one belongs to the piece before it, but for the line's first; the last one of a closed line is
    /// its first.
    fn kept_of(&self, chain: &LineChain, (place, count): (usize, usize), is_seen: bool) -> Vec<Kept<T>> {
        let vertices = self.lines.vertices(chain, chain.pieces.start + place as u32);
        let points: Vec<P3<T>> = vertices.iter().map(|p| P3::of(*p)).collect();
        let seen: Vec<P3<T>> = points.iter().map(|p| self.camera.view(*p)).collect();
        let screen = || -> Vec<Option<Plan>> {
            let before = |p: &P3<T>| self.camera.is_before(*p).then(|| self.camera.screen(*p).get());
            seen.iter().map(before).collect()
        };
        let mut places: Vec<u32> = if place == 0 { vec![0] } else { Vec::new() };
        match self.settings.simplification {
            Simplification::SamePixel => simplify::same_pixel(&screen(), &mut places),
            Simplification::None => places.extend(1..vertices.len() as u32),
            Simplification::ScreenError => {
                simplify::screen_error(&screen(), self.settings.error_px, &mut places);
            }
        }
        let is_closing =
            |k: u32| chain.chain.is_closed && place + 1 == count && k as usize + 1 == vertices.len();
        places.retain(|k| !is_closing(*k));
        let kept = |k: u32| Kept {
            at: points[k as usize],
            is_inside: self.camera.is_inside(seen[k as usize]),
            is_seen,
            run: 0,
        };
        places.into_iter().map(kept).collect()
    }

    /// How far from its centre line an item may be seen, for each metre from the eye (perspective), or in metres.
    fn growth(&self, item: u32) -> f64 {
        let Some(line) = self.stage.draw_list.style_of(item).stroke else { return 0.0 };
        let Width::Pixels(width) = line.width else { return 0.0 };
        let reach = match (self.settings.corners, line.join) {
            (Corners::Style, Join::Miter { limit }) => math::max(limit, std::f64::consts::SQRT_2),
            _ => std::f64::consts::SQRT_2,
        };
        // A pixel more: what anti-aliasing and the correction of thin lines may reach.
        self.camera.pixel().get() * (width / 2.0 * reach + 1.0)
    }
}

/// The part of the world that a view shows: its planes, and the heights of the terrain.
struct Frustum {
    view: ViewFrame,
    heights: (f64, f64),
}

impl Frustum {
    fn new(view: &ViewFrame, mesh: &Mesh) -> Self {
        Self { view: *view, heights: mesh.heights().unwrap_or_default() }
    }

    /// Whether terrain over a box of the plan, or no farther from that than `growth` for each metre from the eye, may be seen.
    fn may_show(&self, plan: &PlanBox, growth: f64) -> bool {
        let (eye, (low, high)) = (self.view.eye(), self.heights);
        let corners = |plan: &PlanBox| {
            let (a, b) = (plan.min, plan.max);
            [(a.x, a.y), (b.x, a.y), (a.x, b.y), (b.x, b.y)]
                .into_iter()
                .flat_map(move |(x, y)| [World::new(x, y, low), World::new(x, y, high)])
                .collect::<Vec<_>>()
        };
        let reach = match self.view.lens() {
            Lens::Parallel { .. } => growth,
            Lens::Central { .. } if growth >= 1.0 => return true,
            Lens::Central { .. } => {
                let farthest = corners(plan).iter().map(|p| (*p - eye).length()).fold(0.0, math::max);
                growth * farthest / (1.0 - growth)
            }
        };
        let corners = corners(&plan.grown(reach * (1.0 + 1e-9)));
        let (width, height, pixel) =
            (self.view.width() as f64, self.view.height() as f64, self.view.lens().pixel());
        let is_central = matches!(self.view.lens(), Lens::Central { .. });
        // Each plane as a function that is negative beyond it.
        let beyond = |of: &dyn Fn(f64, f64, f64) -> f64| {
            corners.iter().all(|p| {
                let v = self.view.view_from_world(*p);
                let depth = -v.z;
                of(v.x, v.y, if is_central { depth } else { 1.0 }) < 0.0
            })
        };
        let (across, down) = (width / 2.0 * pixel, height / 2.0 * pixel);
        let near = corners.iter().all(|p| self.view.depth(*p) < self.view.near());
        let far = corners.iter().all(|p| self.view.depth(*p) >= self.view.far());
        !(near
            || far
            || beyond(&|x, _, w| x + across * w)
            || beyond(&|x, _, w| across * w - x)
            || beyond(&|_, y, w| y + down * w)
            || beyond(&|_, y, w| down * w - y))
    }
}
