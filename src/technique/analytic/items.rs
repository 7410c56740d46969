//! What items do to one fragment: N, P or F of each, and of those that are P what their edges cut.

use super::boxes::{Held, held, with_hem};
use super::coverage::{Class, Coverage, Inside, Membership};
use super::facet::{Facet, FromPlan};
use super::features::Edge;
use super::look::{Look, Looks, even_half};
use super::near::{Local, Near};
use super::pieces::{self, HalfWidth, Pieces, stroke_pieces};
use super::step::Fallback;
use crate::math;
use crate::predicate::orient2d;
use crate::resolve::{Compositor, Paint, Stack};
use crate::scene::{Line, Width};
use crate::space::{Plan, PlanBox, ViewFrame};
use crate::terrain::Mesh;
use glam::DVec2;
use std::ops::Range;

/// How far a chord of a round part may be off, in pixels.
pub(super) const SAGITTA: f64 = 1.0 / 512.0;

/// How far a width in pixels may be off in a fragment in which it is taken as linear, in pixels.
const BEND: f64 = 1.0 / 256.0;

/// A fragment of a pixel, or a sample.
#[derive(Debug)]
pub(super) struct Place<'a> {
    pub(super) facet: &'a Facet,
    /// Its corners on the screen; of a sample the one point.
    pub(super) screen: &'a [DVec2],
    /// The same in the plan.
    pub(super) plan: &'a [Plan],
    /// The pixel's corner, from which the closed forms count.
    pub(super) pixel: DVec2,
}

impl Place<'_> {
    /// A place inside, on which data hardly have an edge.
    fn inside(&self) -> DVec2 {
        let (mut sum, mut all, mut weight) = (DVec2::ZERO, 0.0, 1.0);
        for p in self.screen {
            sum += *p * weight;
            all += weight;
            weight = 0.618_033_988_749_895 * weight + 0.3;
        }
        sum / all
    }
}

/// What an item does to a fragment.
#[derive(Debug, Clone)]
struct Entry {
    /// Its place among those near.
    local: usize,
    /// Its area's edges that cut the fragment; none where all of the fragment is in the area, or there is none.
    edges: Range<usize>,
    /// Its stroke's pieces that cut the fragment; none where one holds all of it, or there is no stroke.
    rings: Range<usize>,
}

impl Entry {
    fn is_partial(&self) -> bool {
        !(self.edges.is_empty() && self.rings.is_empty())
    }
}

/// Half a stroke's width in a fragment, metres.
#[derive(Debug, Clone, Copy)]
struct Span {
    /// As linear in the plan.
    half: HalfWidth,
    /// How far that is off at most.
    bend: f64,
    /// Not more than the least.
    least: f64,
    /// The most.
    most: f64,
}

/// What was found out about a fragment.
#[derive(Debug, Clone, Copy)]
pub(super) struct Painted {
    pub(super) paint: Paint,
    pub(super) class: Class,
    /// Parts of edges in it.
    pub(super) edges: usize,
}

/// Lists that are used again from fragment to fragment.
#[derive(Debug, Default)]
pub(super) struct Lists {
    entries: Vec<Entry>,
    edges: Vec<Edge>,
    /// Where each piece's corners end.
    rings: Vec<usize>,
    corners: Vec<Plan>,
    pub(super) pieces: Pieces,
    cover: Coverage,
    projected: Vec<DVec2>,
    /// The ground and the paint of the plain fragment before, of the same block.
    pub(super) plain: Option<(Paint, Paint)>,
    /// Whether the items of each set are to be told.
    pub(super) wants_sets: bool,
    /// The items of each set that was found, with its share, if they are to be told.
    pub(super) sets: Vec<(Vec<u32>, f64)>,
}

impl Lists {
    /// Adds a piece that cuts a fragment to those from the `first` on; where it holds all of the fragment, takes these away and returns true.
    fn add_ring(&mut self, ring: &[Plan], plan: &[Plan], first: usize) -> bool {
        match held(ring, plan) {
            Held::None => false,
            Held::Some => {
                self.corners.extend_from_slice(ring);
                self.rings.push(self.corners.len());
                false
            }
            Held::All => {
                self.forget_rings(first);
                true
            }
        }
    }

    /// Forgets the pieces from a number on.
    fn forget_rings(&mut self, first: usize) {
        self.rings.truncate(first);
        self.corners.truncate(self.rings.last().copied().unwrap_or(0));
    }
}

/// Paints fragments over the ground.
#[derive(Debug)]
pub(super) struct Items<'a> {
    pub(super) view: &'a ViewFrame,
    pub(super) mesh: &'a Mesh,
    pub(super) looks: &'a Looks<'a>,
    pub(super) compositor: Compositor,
    /// The most parts of edges in a fragment.
    pub(super) crowd: usize,
}

impl Items<'_> {
    /// The mean paint of a fragment over a ground of one paint.
    ///
    /// # Errors
    /// Why areas cannot tell.
    pub(super) fn paint(
        &self,
        place: &Place,
        near: &Near,
        ground: Paint,
        lists: &mut Lists,
    ) -> Result<Painted, Fallback> {
        lists.sets.clear();
        self.classify(place, near, lists)?;
        if lists.entries.iter().any(Entry::is_partial) {
            return self.measure(place, near, ground, lists).ok_or(Fallback::Crowd);
        }
        let paint = self.composed(near, lists, 0, ground);
        if lists.wants_sets {
            lists.sets.push((items_of(near, &lists.entries, 0), 1.0));
        }
        Ok(Painted { paint, class: Class::Point, edges: 0 })
    }

    /// The paint of a fragment of a block all of whose items cover all of it.
    pub(super) fn paint_plain(&self, near: &Near, ground: Paint, lists: &mut Lists) -> Painted {
        let paint = match lists.plain {
            Some((below, paint)) if below == ground => paint,
            _ => {
                let mut stack = Stack::on(ground);
                for local in &near.items {
                    let look = self.looks.of(local.item);
                    stack.draw(look.group, |below| self.compositor.over(below, look.paint));
                }
                stack.finished()
            }
        };
        lists.plain = Some((ground, paint));
        lists.sets.clear();
        if lists.wants_sets {
            lists.sets.push((near.items.iter().map(|local| local.item).collect(), 1.0));
        }
        Painted { paint, class: Class::Point, edges: 0 }
    }

    /// Finds the items that cover some of a fragment, from the top down to one that hides the others.
    fn classify(&self, place: &Place, near: &Near, lists: &mut Lists) -> Result<(), Fallback> {
        lists.entries.clear();
        lists.edges.clear();
        lists.rings.clear();
        lists.corners.clear();
        let bounds = PlanBox::around(place.plan.iter().copied());
        let touching = with_hem(&bounds);
        let inside = match place.plan {
            [at] => *at,
            _ => place.facet.plan_at(place.inside()),
        };
        for (local, of) in near.items.iter().enumerate().rev() {
            let look = self.looks.of(of.item);
            let edges = lists.edges.len();
            if let Some(area) = look.area {
                if near.edges(of).iter().any(|edge| cuts(edge, place.plan, &bounds)) {
                    // What comes from a corner of the fragment has another edge that ends there.
                    lists.edges.extend(near.edges(of).iter().filter(|edge| edge.meets(&touching)));
                } else if !area.holds(near.turns_at(of, inside)) {
                    continue;
                }
            }
            let rings = lists.rings.len();
            if look.line.is_some() {
                let finest = || place.facet.finest_at(place.inside());
                if !self.add_pieces((near, of, look), place, (&bounds, &finest), lists)? {
                    lists.edges.truncate(edges);
                    continue;
                }
            }
            let entry = Entry { local, edges: edges..lists.edges.len(), rings: rings..lists.rings.len() };
            let hides = look.is_opaque && !entry.is_partial();
            lists.entries.push(entry);
            if hides {
                break;
            }
        }
        lists.entries.reverse();
        Ok(())
    }

    /// Adds the pieces of an item's stroke that cut a fragment; none where one holds it. Returns whether the stroke may cover any of it.
    fn add_pieces(
        &self,
        (near, of, look): (&Near, &Local, &Look),
        place: &Place,
        (bounds, finest): (&PlanBox, &dyn Fn() -> f64),
        lists: &mut Lists,
    ) -> Result<bool, Fallback> {
        let Some(line) = &look.line else { return Ok(false) };
        if of.is_held {
            return Ok(true);
        }
        let first = lists.rings.len();
        for (ring, around) in near.pieces(of) {
            if around.meets(bounds) && lists.add_ring(ring, place.plan, first) {
                return Ok(true);
            }
        }
        let mut strokes = near.strokes(of).iter().filter(|stroked| stroked.meets(bounds)).peekable();
        if strokes.peek().is_none() {
            return Ok(lists.rings.len() > first);
        }
        let width = self.width(line, place);
        let finest = finest();
        let around = pieces::Near { plan: *bounds, sagitta: SAGITTA * finest };
        for stroked in strokes {
            // Near the eye a width in pixels grows too fast for pieces, but most fragments are clearly in the stroke or clearly not.
            if !stroked.comes_within(width.most, bounds) {
                continue;
            }
            if stroked.holds_within(width.least, place.plan) {
                lists.forget_rings(first);
                return Ok(true);
            }
            lists.pieces.clear();
            if !stroke_pieces(&stroked.segment, line, &width.half, &around, &mut lists.pieces) {
                return Err(Fallback::Width);
            }
            let pieces = std::mem::take(&mut lists.pieces);
            let is_held = pieces.rings().any(|ring| lists.add_ring(ring, place.plan, first));
            lists.pieces = pieces;
            if is_held {
                return Ok(true);
            }
        }
        let is_cut = lists.rings.len() > first;
        if is_cut && width.bend > BEND * finest { Err(Fallback::Width) } else { Ok(is_cut) }
    }

    /// Half a stroke's width in a place: of one in pixels the tangent of how it grows with the distance from the eye
    /// (Zechmeister 2020, eq. 4.1).
    fn width(&self, line: &Line, place: &Place) -> Span {
        let at = if let [at] = place.plan { *at } else { place.facet.plan_at(place.inside()) };
        let even = |half: f64| Span {
            half: HalfWidth { at, half, gradient: DVec2::ZERO },
            bend: 0.0,
            least: half,
            most: half,
        };
        if let Some(half) = even_half(line, self.view.lens()) {
            return even(half);
        }
        let Width::Pixels(width) = line.width else { return even(0.0) };
        let pixel = self.view.lens().pixel();
        let triangle = self.mesh.surface_triangle(place.facet.id);
        let Some((triangle, [east, north])) = triangle.and_then(|of| Some((of, of.world_from_plan()?)))
        else {
            return even(0.0);
        };
        let away = |p: Plan| {
            let from = p - triangle.plan()[0];
            triangle.world[0] + (east * from.x + north * from.y) - self.view.eye()
        };
        let growth = 0.5 * width * pixel;
        let (middle, distance) = (away(at), away(at).length());
        if place.plan.len() == 1 {
            return even(growth * distance);
        }
        let gradient = DVec2::new(middle.dot(east), middle.dot(north)) * (growth / distance);
        let half = HalfWidth { at, half: growth * distance, gradient };
        let (mut bend, mut least, mut most) = (0.0, f64::INFINITY, 0.0);
        for p in place.plan {
            let away = away(*p);
            bend = math::max(growth * away.length() - half.of(*p), bend);
            // A distance is convex: corners have the most, and their tangents less than the least.
            most = math::max(growth * away.length(), most);
            least = math::min(growth * (away.dot(middle) / distance), least);
        }
        Span { half, bend, least, most }
    }

    /// The mean paint of a fragment that edges cut.
    fn measure(&self, place: &Place, near: &Near, ground: Paint, lists: &mut Lists) -> Option<Painted> {
        let mut cover = std::mem::take(&mut lists.cover);
        let class = self.fill(place, near, lists, &mut cover).and_then(|()| cover.measure(self.crowd));
        lists.cover = cover;
        let class = class?;
        let (mut paint, mut all) = (Paint::CLEAR, 0.0);
        for &(set, area) in lists.cover.areas() {
            paint = paint.plus(self.composed(near, lists, set, ground).times(area));
            all += area;
        }
        if lists.wants_sets {
            let share = |&(set, area): &(u64, f64)| (items_of(near, &lists.entries, set), area / all);
            lists.sets = lists.cover.areas().iter().map(share).collect();
        }
        Some(Painted { paint: paint.divided_by(all), class, edges: lists.cover.edges() })
    }

    /// Tells the closed forms what cuts a fragment.
    fn fill(&self, place: &Place, near: &Near, lists: &mut Lists, cover: &mut Coverage) -> Option<()> {
        lists.projected.clear();
        lists.projected.extend(place.screen.iter().map(|p| *p - place.pixel));
        cover.begin(&lists.projected);
        let least = 0.5 * place.facet.least_w(place.screen);
        let from_plan = FromPlan::new(place.facet);
        let is_mirrored = from_plan.is_mirrored();
        let map = (&from_plan, place.pixel);
        let partial = lists.entries.iter().filter(|entry| entry.is_partial());
        for entry in partial.clone() {
            let area = self.looks.of(near.items[entry.local].item).area.filter(|_| !entry.edges.is_empty());
            let area = area.map(|area| Inside { rule: area.rule, is_wanted: area.is_wanted });
            let number = cover.item(Membership { area, has_stroke: !entry.rings.is_empty() })?;
            for edge in &lists.edges[entry.edges.clone()] {
                lists.projected.clear();
                project(map, &[edge.from, edge.to], least, &mut lists.projected);
                if let [from, to] = lists.projected[..] {
                    let (from, to) = if is_mirrored { (to, from) } else { (from, to) };
                    cover.edge(number, from, to);
                }
            }
            for ring in entry.rings.clone() {
                let first = ring.checked_sub(1).map_or(0, |before| lists.rings[before]);
                lists.projected.clear();
                project(map, &lists.corners[first..lists.rings[ring]], least, &mut lists.projected);
                if lists.projected.len() > 2 {
                    cover.piece(number, &lists.projected);
                }
            }
        }
        let at = place.facet.plan_at(cover.reference()? + place.pixel);
        for (number, entry) in (0..).zip(partial).filter(|(_, entry)| !entry.edges.is_empty()) {
            cover.winding(number, near.turns_at(&near.items[entry.local], at));
        }
        Some(())
    }

    /// The items of a set over a ground.
    fn composed(&self, near: &Near, lists: &Lists, set: u64, ground: Paint) -> Paint {
        let mut stack = Stack::on(ground);
        for_each_of(near, &lists.entries, set, |item| {
            let look = self.looks.of(item);
            stack.draw(look.group, |below| self.compositor.over(below, look.paint));
        });
        stack.finished()
    }
}

/// Calls `visit` with the items of a set, whose bits are those of the partial ones, and with those that cover all.
fn for_each_of(near: &Near, entries: &[Entry], set: u64, mut visit: impl FnMut(u32)) {
    let mut bit = 0;
    for entry in entries {
        let is_in = if entry.is_partial() {
            bit += 1;
            set >> (bit - 1) & 1 == 1
        } else {
            true
        };
        if is_in {
            visit(near.items[entry.local].item);
        }
    }
}

fn items_of(near: &Near, entries: &[Entry], set: u64) -> Vec<u32> {
    let mut items = Vec::new();
    for_each_of(near, entries, set, |item| items.push(item));
    items
}

/// Whether an edge cuts a fragment: has some of its corners on either side.
fn cuts(edge: &Edge, plan: &[Plan], bounds: &PlanBox) -> bool {
    if !edge.meets(bounds) {
        return false;
    }
    let mut sides = plan.iter().map(|p| orient2d(edge.from, edge.to, *p));
    let Some(first) = sides.find(|side| *side != 0.0) else { return false };
    sides.any(|side| side * first < 0.0)
}

/// Adds the picture of a convex polygon or an edge of the plan, counted from the pixel's corner, as far as it lies clearly before the eye.
fn project((from_plan, pixel): (&FromPlan, DVec2), points: &[Plan], least: f64, out: &mut Vec<DVec2>) {
    let is_closed = points.len() > 2;
    let mut before = is_closed.then(|| from_plan.at(points[points.len() - 1]));
    for p in points {
        let h = from_plan.at(*p);
        if let Some(was) = before.filter(|was| (was.z < least) != (h.z < least)) {
            let share = (least - was.z) / (h.z - was.z);
            let at = was + (h - was) * share;
            out.push(at.truncate() / least - pixel);
        }
        if h.z >= least {
            out.push(h.truncate() / h.z - pixel);
        }
        before = Some(h);
    }
}
