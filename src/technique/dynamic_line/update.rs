//! Update indices (3.3.1, 4.3.1, Algorithm 3.2): of a view the segments between the vertices that it keeps.
//!
//! Input: lines on the terrain, a view. Output: [`Segment`]s in draw order, along their lines. Algorithm 3.2 as printed counts new segments
//! and names the start vertex with the same m; the start is the last vertex that was kept, and segments that the frustum culls are left out after
//! that. Pieces of lines whose boxes no line of sight can reach are not looked at, which changes nothing: a tree finds the others, whatever their number.
//!
//! A line of which a view keeps one vertex has no segment, and vanishes (4.3.1 does not speak of it); [`Segments::vanished`] counts them. What
//! has no second vertex by itself, a dot, is a segment of no length.

use super::camera::{Camera, P2, P3};
use super::matching::{LineChain, MatchedLines};
use super::simplify;
use crate::draw_list::ItemStyle;
use crate::error::{Error, Result};
use crate::math;
use crate::parallel;
use crate::raster::device::Real;
use crate::scene::{Join, Width};
use crate::space::{Lens, Plan, PlanBox, ViewFrame, World};
use crate::stage::Stage;
use crate::technique::dynamic_line::{Corners, Settings, Simplification};
use crate::terrain::Mesh;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};

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
    /// The vertex of the draw list at which the segment starts that it is a part of; `None`: it is made of several.
    pub source: Option<u32>,
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
    /// See [`MatchedLines::sources`].
    sources: [u32; 2],
    is_inside: bool,
    /// Whether its piece can be seen.
    is_seen: bool,
    /// A number that the vertices share whose pieces were looked at without a gap between.
    run: usize,
}

/// Chains that one piece of parallel work looks at.
const CHAINS_AT_A_TIME: usize = 64;

/// Finds the segments of a view.
///
/// # Errors
/// When they are more than `most`.
pub fn segments<T: Real>(
    (stage, mesh, view): (&Stage, &Mesh, &ViewFrame),
    lines: &MatchedLines,
    camera: &Camera<T>,
    most: usize,
) -> Result<Segments<T>> {
    let settings: Settings = stage.scene.technique.get();
    let update = Update { stage, lines, camera, settings, frustum: Frustum::new(view, mesh) };
    let widest = stage.draw_list.styles().iter().map(|style| update.growth(style)).fold(0.0, math::max);
    let near = lines.pieces_that(|plan| update.frustum.may_show(plan, widest));
    let of_chains: Vec<&[u32]> = near.chunk_by(|a, b| lines.chain_of(*a) == lines.chain_of(*b)).collect();
    let total = AtomicUsize::new(0);
    let found = parallel::map_indices(of_chains.len().div_ceil(CHAINS_AT_A_TIME), |k| {
        let first = k * CHAINS_AT_A_TIME;
        let mut found = Segments { all: Vec::new(), vertices: 0, vanished: 0 };
        let end = of_chains.len().min(first + CHAINS_AT_A_TIME);
        for near in &of_chains[first..end] {
            if total.load(Ordering::Relaxed) > most {
                break;
            }
            let before = found.all.len();
            update.add_chain(near, &mut found);
            total.fetch_add(found.all.len() - before, Ordering::Relaxed);
        }
        found
    });
    if total.into_inner() > most {
        return Err(Error::unsupported(format!(
            "dynamic-line: the view has more than {most} segments, there is no room for them"
        ))
        .help("look at less, give technique.dynamic-line.l_max more metres, or simplify by technique.dynamic-line.simplification"));
    }
    let mut all = Segments { all: Vec::new(), vertices: 0, vanished: 0 };
    all.all.reserve_exact(found.iter().map(|some| some.all.len()).sum());
    for mut some in found {
        all.all.append(&mut some.all);
        all.vertices += some.vertices;
        all.vanished += some.vanished;
    }
    Ok(all)
}

struct Update<'a, T> {
    stage: &'a Stage,
    lines: &'a MatchedLines<'a>,
    camera: &'a Camera<T>,
    settings: Settings,
    frustum: Frustum,
}

impl<T: Real> Update<'_, T> {
    /// Adds the segments of a chain of which these pieces may be seen.
    fn add_chain(&self, near: &[u32], found: &mut Segments<T>) {
        let chain = &self.lines.chains[self.lines.chain_of(near[0])];
        let growth = self.growth(self.stage.draw_list.style_of(chain.item));
        let is_seen = |piece: &&u32| self.frustum.may_show(&self.lines.pieces[**piece as usize].plan, growth);
        let place = |piece: &u32| (piece - chain.pieces.start) as usize;
        let seen: Vec<usize> = near.iter().filter(is_seen).map(place).collect();
        if seen.is_empty() {
            return;
        }
        let (kept, is_joined) = self.kept_around(chain, &seen, found);
        if let [alone] = &kept[..] {
            let is_dot = chain.chain.segments() == 0;
            if is_dot || self.settings.simplification == Simplification::ScreenError {
                let dot = self.between(chain, [None, Some(alone), Some(alone), None]);
                found.all.push(Segment { source: None, ..dot });
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
        let [source, last] = [start.map(|kept| kept.sources[1]), end.map(|kept| kept.sources[0])];
        Segment {
            item: chain.item,
            before: plan(before),
            start: from,
            end: to,
            after: plan(after),
            source: source.filter(|_| source == last),
            is_inside,
        }
    }

    /// The kept vertices of the pieces that are seen, and beyond each run of them at least two more, in the chain's order: a segment that leaves
    /// the view ends at the first, and its mitre asks for the second. And whether the first one comes after the last.
    fn kept_around(
        &self,
        chain: &LineChain,
        seen: &[usize],
        found: &mut Segments<T>,
    ) -> (Vec<Kept<T>>, bool) {
        let count = chain.pieces.len();
        let mut of_pieces: BTreeMap<usize, Vec<Kept<T>>> = BTreeMap::new();
        let mut need = |piece: usize| -> usize {
            let kept = of_pieces.entry(piece).or_insert_with(|| {
                found.vertices += u64::from(self.lines.pieces[chain.pieces.start as usize + piece].parts) + 1;
                self.kept_of(chain, (piece, count), seen.binary_search(&piece).is_ok())
            });
            kept.len()
        };
        for &piece in seen {
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
        let is_joined =
            chain.chain.is_closed && of_pieces.contains_key(&0) && of_pieces.contains_key(&(count - 1));
        let mut all = Vec::new();
        let (mut run, mut next) = (0, 0);
        for (place, kept) in of_pieces {
            run = if place == next { run } else { place };
            next = place + 1;
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
        let sources = self.lines.sources(chain, chain.pieces.start + place as u32);
        let kept = |k: u32| Kept {
            at: points[k as usize],
            sources: sources[k as usize],
            is_inside: self.camera.is_inside(seen[k as usize]),
            is_seen,
            run: 0,
        };
        places.into_iter().map(kept).collect()
    }

    /// How far from its centre line an item of a style may be seen, for each metre from the eye (perspective), or in metres.
    fn growth(&self, style: &ItemStyle) -> f64 {
        let Some(line) = style.stroke else { return 0.0 };
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
pub(super) struct Frustum {
    view: ViewFrame,
    heights: (f64, f64),
}

impl Frustum {
    pub(super) fn new(view: &ViewFrame, mesh: &Mesh) -> Self {
        Self { view: *view, heights: mesh.heights().unwrap_or_default() }
    }

    /// Whether terrain over a box of the plan, or no farther from that than `growth` for each metre from the eye, may be seen.
    pub(super) fn may_show(&self, plan: &PlanBox, growth: f64) -> bool {
        let (eye, (low, high)) = (self.view.eye(), self.heights);
        let corners = |plan: &PlanBox| -> [World; 8] {
            std::array::from_fn(|k| {
                let x = if k & 1 == 0 { plan.min.x } else { plan.max.x };
                let y = if k & 2 == 0 { plan.min.y } else { plan.max.y };
                World::new(x, y, if k & 4 == 0 { low } else { high })
            })
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene_file::SceneFile;

    #[test]
    fn a_view_of_a_small_part_is_asked_about_few_pieces_and_finds_those_of_a_scan() {
        let features: String = (0..2500)
            .map(|k| (f64::from(k % 50) * 12.0 - 294.0, f64::from(k / 50) * 12.0 - 294.0))
            .map(|(x, y)| format!("{{ line = [[{x}, {y}], [{}, {}]] }},", x + 7.0, y + 4.0))
            .collect();
        let text = format!(
            "schema = 1\nimage = {{ width = 32, height = 32 }}\ncamera = {{ eye = [0, -9, 9], target = [0, 0, 0] }}\n\
             terrain = {{ generate = {{ kind = \"sine\", posts = [65, 65], cell_m = 10.0, height_m = 20.0 }} }}\n\
             [[layer]]\nfeatures = [{features}]\nline = {{ color = \"#aa0000\", width_px = 2.0 }}\n"
        );
        let (scene, surface) =
            crate::source::load::load(&SceneFile::parse(&text, None, &[]).unwrap(), &|_| {}).unwrap();
        let stage = Stage::new(scene, surface).unwrap();
        let lines = MatchedLines::new(&stage.draw_list, &stage.mesh, None).unwrap();
        assert_eq!(lines.pieces.len(), 2500);
        let place = |x, y, z| World::new(x, y, z);
        for (eye, target, is_small) in [
            (place(60.0, 50.0, 60.0), place(60.0, 51.0, 0.0), true),
            (place(-200.0, 100.0, 50.0), place(-190.0, 120.0, 10.0), true),
            (place(-300.0, -300.0, 80.0), place(0.0, 0.0, 0.0), false),
        ] {
            let viewpoint =
                crate::space::Viewpoint { eye, target, up: glam::DVec3::Z, near: 0.5, far: f64::INFINITY };
            let view = ViewFrame::perspective(&viewpoint, 35.0, (32, 32)).unwrap();
            let (frustum, growth) = (Frustum::new(&view, &stage.mesh), view.lens().pixel() * 2.0);
            let mut asked = 0;
            let found = lines.pieces_that(|plan| {
                asked += 1;
                frustum.may_show(plan, growth)
            });
            let is_shown = |piece: &u32| frustum.may_show(&lines.pieces[*piece as usize].plan, growth);
            let scan: Vec<u32> = (0..2500).filter(is_shown).collect();
            assert_eq!(found.into_iter().filter(is_shown).collect::<Vec<_>>(), scan);
            assert!(!scan.is_empty());
            assert!(!is_small || (scan.len() < 60 && asked < 400), "{} of {asked}", scan.len());
        }
    }

    #[test]
    fn more_segments_than_there_is_room_for_are_refused() {
        let text = "schema = 1\nimage = { width = 32, height = 32 }\ncamera = { eye = [0, -90, 90], target = [0, 0, 0] }\n\
             terrain = { generate = { kind = \"sine\", posts = [9, 9], cell_m = 10.0, height_m = 2.0 } }\n\
             technique = { dynamic-line = { l_max = 1e9, simplification = \"none\" } }\n[[layer]]\n\
             features = [{ line = [[-9, 0], [0, 5], [9, 0]] }, { line = [[0, 0], [9, 9]] }]\nline = { color = \"#aa0000\", width_px = 2.0 }\n";
        let (scene, surface) =
            crate::source::load::load(&SceneFile::parse(text, None, &[]).unwrap(), &|_| {}).unwrap();
        let stage = Stage::new(scene, surface).unwrap();
        let (view, settings) = (stage.view().unwrap(), stage.scene.technique.get::<Settings>());
        let lines = MatchedLines::new(&stage.draw_list, &stage.mesh, settings.l_max).unwrap();
        let found = |most| segments::<f64>((&stage, &stage.mesh, &view), &lines, &Camera::new(&view), most);
        assert_eq!(found(3).unwrap().all.len(), 3);
        let said = found(2).unwrap_err().to_string();
        assert!(said.contains("more than 2 segments") && said.contains("l_max"), "{said}");
    }
}
