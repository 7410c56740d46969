//! The items of the draw list as sets of plan points, for the truth and for supersampling.
//!
//! Input: the draw list, the view and the terrain (widths in pixels depend on them) and which boxes of the plan can be seen. Output:
//! [`Footprints`]: each item's boundary as small [`BorderPart`]s in a tree of boxes, and exact winding numbers. It borrows the list's
//! vertices. Refuses: nothing; degenerate rings and segments of no length have no points, or those that `docs/semantics.md` says.

mod area;
mod primitive;
mod rings;
mod stroke;

pub use primitive::{HalfPlane, MOST_SIDES, Primitive};
pub use stroke::Strokes;

use crate::draw_list::{Chain, DrawList, Item, Role, Side};
use crate::index::BoxTree;
use crate::math::min;
use crate::parallel;
use crate::scene::{Line, Width};
use crate::space::{Globe, Lens, Plan, PlanBox, SmallBox, ViewFrame, World};
use crate::terrain::Mesh;
use area::Area;
use glam::DVec2;
use std::collections::BTreeMap;
use std::ops::Range;

/// A piece of an item's boundary: an edge of its polygon, or a segment of its stroke with the join at its start and the
/// caps at its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct BorderPart {
    /// The item that it bounds.
    pub item: u32,
    /// The place of its chain among the item's: first those of its area, then those of its stroke.
    chain: u32,
    vertex: u32,
}

impl BorderPart {
    /// A number that hardly any other part near it has.
    pub fn mixed(self) -> u64 {
        (u64::from(self.item) << 32 | u64::from(self.vertex)) ^ u64::from(self.chain) << 16
    }
}

/// How widths in pixels become metres: what the view says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PixelSize {
    /// A pixel's size at distance 1 (perspective) or everywhere (orthographic).
    pub pixel: f64,
    /// The eye, when a pixel's size grows with the distance from it.
    pub eye: Option<World>,
    /// How far from the eye the surface may be over a point of the plan.
    pub away: Away,
    /// The globe on whose ground those metres are; `None`: they are metres of the plan.
    pub ground: Option<Globe>,
}

/// How far from an eye the surface may be over a point of the plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Away {
    /// It is draped vertically: as far as the point is in the plan, and at most so far above or below, metres.
    Over(f64),
    /// At most so far wherever the point is, metres.
    Within(f64),
}

impl PixelSize {
    /// The size in a view of a terrain.
    pub fn of(view: &ViewFrame, mesh: &Mesh) -> Self {
        let eye = view.eye();
        let above = |(low, high): (f64, f64)| crate::math::max((high - eye.z).abs(), (low - eye.z).abs());
        let away = match mesh.heights() {
            Some(heights) => Away::Over(above(heights)),
            None => Away::Within(mesh.farthest_from(eye)),
        };
        let ground = mesh.globe().copied();
        match view.lens() {
            Lens::Central { pixel } => Self { pixel, eye: Some(eye), away, ground },
            Lens::Parallel { pixel } => Self { pixel, eye: None, away, ground },
        }
    }

    /// How many metres of a stroke's width a metre of the plan is beside a segment, to the east and to the north.
    fn scale(&self, from: Plan, to: Plan) -> DVec2 {
        self.ground.map_or(DVec2::ONE, |globe| globe.ground_scale(from, to))
    }

    /// So many metres around a segment in the plan, in each coordinate: no more than a turn, beside which a copy lies.
    fn in_plan(&self, reach: f64, from: Plan, to: Plan) -> DVec2 {
        let Some(globe) = &self.ground else { return DVec2::splat(reach) };
        let far = DVec2::splat(reach) / globe.ground_scale(from, to);
        DVec2::new(min(far.x, globe.turn()), min(far.y, globe.turn())) * (1.0 + 1e-9)
    }
}

/// The items of a draw list as sets of plan points.
#[derive(Debug)]
pub struct Footprints<'l> {
    list: &'l DrawList,
    pixel: PixelSize,
    strokes: Strokes,
    sides: Sides,
    areas: Vec<Area>,
    /// The number of each item's area; [`NO_AREA`]: it has none.
    area_of: Vec<u32>,
    /// The item of each entry of `area_boxes`.
    area_items: Vec<u32>,
    area_boxes: BoxTree,
    parts: Vec<BorderPart>,
    part_boxes: BoxTree,
}

/// Tells whether a box of the plan can be seen.
pub type IsSeen<'s> = dyn Fn(&PlanBox) -> bool + Sync + 's;

/// By item and place of a chain among its own, on which side of the chain the item's polygon lies.
type Sides = BTreeMap<(u32, u32), Option<bool>>;

/// No number of an area.
const NO_AREA: u32 = u32::MAX;

impl<'l> Footprints<'l> {
    /// The items of a list, by definition; parts and polygons whose box `is_seen` denies are left out.
    pub fn new(list: &'l DrawList, pixel: PixelSize, is_seen: &IsSeen) -> Self {
        Self::stroked(list, pixel, Strokes::Style, is_seen)
    }

    /// The same with strokes as a technique has them.
    pub fn stroked(list: &'l DrawList, pixel: PixelSize, strokes: Strokes, is_seen: &IsSeen) -> Self {
        let is_outside = |item: u32| list.style_of(item).role == Role::Outside;
        // What is outside of no polygon is everywhere.
        let has_area = |(number, item): &(u32, &Item)| !item.area.is_empty() || is_outside(*number);
        let with_area = || list.numbered().filter(has_area).map(|(number, _)| number);
        let owners: Vec<u32> = with_area().filter(|item| list.area_owner(*item) == *item).collect();
        let areas = parallel::map(&owners, |owner| Area::new(list, &list.items()[*owner as usize]));
        let mut area_of = vec![NO_AREA; list.items().len()];
        for (area, owner) in (0..).zip(owners) {
            area_of[owner as usize] = area;
        }
        for item in with_area() {
            area_of[item as usize] = area_of[list.area_owner(item) as usize];
        }
        let bounds = |item: u32| match is_outside(item) {
            true => bounds_of_border(list, &list.items()[item as usize]),
            false => areas[area_of[item as usize] as usize].bounds(),
        };
        let seen = with_area().map(|item| (item, bounds(item))).filter(|(_, plan)| is_seen(plan));
        let (area_items, area_boxes): (Vec<u32>, Vec<PlanBox>) = seen.unzip();
        let long = Long::of(list);
        let (parts, part_boxes) = Parts { list, pixel: &pixel, strokes, long, is_seen }.all();
        let (area_boxes, part_boxes) = (BoxTree::new(&area_boxes), BoxTree::new(&part_boxes));
        let sides = Sides::new();
        let mut all =
            Self { list, pixel, strokes, sides, areas, area_of, area_items, area_boxes, parts, part_boxes };
        all.sides = all.sides_of_cut_outlines();
        all
    }

    /// The draw list.
    pub fn list(&self) -> &'l DrawList {
        self.list
    }

    /// Calls `visit` with each part whose box meets `plan`, until it returns false. Returns whether it saw all.
    #[inline]
    pub fn parts_near(&self, plan: &PlanBox, mut visit: impl FnMut(BorderPart) -> bool) -> bool {
        self.part_boxes.query(plan, |k| visit(self.parts[k as usize]))
    }

    /// As [`Self::parts_near`] with each part's box as it is kept: of what is near a box those that meet a smaller one in it are near that.
    #[inline]
    pub fn part_boxes_near(
        &self,
        plan: &PlanBox,
        mut visit: impl FnMut(BorderPart, &SmallBox) -> bool,
    ) -> bool {
        self.part_boxes.query_boxes(plan, |k, small| visit(self.parts[k as usize], small))
    }

    /// Calls `visit` with each item that a polygon bounds whose box meets `plan`.
    #[inline]
    pub fn areas_near(&self, plan: &PlanBox, mut visit: impl FnMut(u32)) {
        self.area_boxes_near(plan, |item, _| visit(item));
    }

    /// As [`Self::areas_near`] with the boxes as they are kept.
    #[inline]
    pub fn area_boxes_near(&self, plan: &PlanBox, mut visit: impl FnMut(u32, &SmallBox)) {
        self.area_boxes.query_boxes(plan, |k, small| {
            visit(self.area_items[k as usize], small);
            true
        });
    }

    /// Whether a point of an item must lie in (or out of) its polygon; `None`: no matter.
    #[inline]
    pub fn wants_polygon(&self, item: u32) -> Option<bool> {
        let style = self.list.style_of(item);
        match (style.role, style.cut.filter(|_| !self.strokes.is_cut_by_side())) {
            (Role::Fill, _) | (_, Some(Side::Inside)) => Some(true),
            (Role::Outside, _) | (_, Some(Side::Outside)) => Some(false),
            (Role::Outline | Role::Line | Role::Point, None) => None,
        }
    }

    /// Whether a point of an item must lie in its stroke.
    #[inline]
    pub fn wants_stroke(&self, item: u32) -> bool {
        self.list.style_of(item).stroke.is_some()
    }

    /// Whether an item's polygon holds a point that lies on none of its edges, exactly; false for an item without one.
    pub fn polygon_holds(&self, item: u32, at: Plan) -> bool {
        let area = self.areas.get(self.area_of[item as usize] as usize);
        let rule = self.list.style_of(item).rule;
        area.is_some_and(|area| area.holds(self.list.vertices(), rule, at))
    }

    /// The ends of the edge of a polygon that a part is; `None`: it is of a stroke.
    #[inline]
    pub fn edge(&self, part: BorderPart) -> Option<[Plan; 2]> {
        let is_edge = (part.chain as usize) < self.list.items()[part.item as usize].area.len();
        is_edge.then(|| self.segment(part))
    }

    /// The ends of the segment or edge that a part is of.
    pub fn segment(&self, part: BorderPart) -> [Plan; 2] {
        let (vertices, at) = (self.list.vertices(), part.vertex as usize);
        match stroke_of(self.list, part.item, part.chain) {
            Some((chain, _)) => {
                let segment = segment_of(vertices, chain, at);
                [segment.from, segment.to]
            }
            None => [vertices[at], vertices[at + 1]],
        }
    }

    /// What a part is made of.
    pub fn primitives(&self, part: BorderPart, out: &mut Vec<Primitive>) {
        let (vertices, at) = (self.list.vertices(), part.vertex as usize);
        match stroke_of(self.list, part.item, part.chain) {
            Some((chain, line)) => {
                let segment = segment_of(vertices, chain, at);
                let of = (&self.pixel, self.strokes.of(self.list.style_of(part.item).role));
                match self.list.style_of(part.item).cut.filter(|_| self.strokes.is_cut_by_side()) {
                    Some(cut) => {
                        let is_left = self.sides.get(&(part.item, part.chain)).copied().flatten();
                        let is_left = is_left.map(|is_left| is_left == (cut == Side::Inside));
                        stroke::side_primitives(&segment, line, of, is_left, out);
                    }
                    None => stroke::primitives(&segment, line, of, out),
                }
            }
            None => out.push(Primitive::Edge { from: vertices[at], to: vertices[at + 1] }),
        }
    }

    /// Whether a part surely has nothing to do with a box that meets its own: none of its points are there. `room` is used.
    pub fn misses(&self, part: BorderPart, plan: &PlanBox, room: &mut Vec<Primitive>) -> bool {
        room.clear();
        self.primitives(part, room);
        room.iter().all(|primitive| primitive.misses(plan))
    }

    /// Of each chain of an outline that is cut, where it is cut by side: on which side of it the polygon lies.
    fn sides_of_cut_outlines(&self) -> Sides {
        let is_cut = |item: &u32| self.list.style_of(*item).cut.is_some();
        let items = self.list.numbered().filter(|(item, _)| is_cut(item) && self.strokes.is_cut_by_side());
        let chains = items.flat_map(|(item, of)| {
            let (first, rings) = (of.area.len() as u32, rings::Sides::of(self.list, of));
            let of_chain = move |(place, chain): (u32, &Chain)| ((item, place), rings.left_of(chain.part));
            (first..).zip(self.list.strokes(of)).map(of_chain)
        });
        chains.collect()
    }

    /// Bytes held, without the draw list.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.area_of[..])
            + size_of_val(&self.area_items[..])
            + size_of_val(&self.parts[..])
            + self.areas.iter().map(Area::bytes).sum::<usize>()
            + self.part_boxes.bytes()
            + self.area_boxes.bytes()
    }
}

/// The box around an item's border.
fn bounds_of_border(list: &DrawList, item: &Item) -> PlanBox {
    PlanBox::around(list.border(item).iter().flat_map(|ring| list.vertices_of(ring)).copied())
}

/// A chain of an item by its place among them and how it is drawn, if it is one of the item's stroke.
#[inline]
fn stroke_of(list: &DrawList, item: u32, place: u32) -> Option<(&Chain, &Line)> {
    let of = &list.items()[item as usize];
    let place = place.checked_sub(of.area.len() as u32)?;
    Some((&list.strokes(of)[place as usize], list.style_of(item).stroke.as_ref()?))
}

/// The segment of a stroke that starts at a vertex, with what is before and after it.
fn segment_of(vertices: &[Plan], chain: &Chain, at: usize) -> stroke::Segment {
    let (first, last) = (chain.first as usize, (chain.first + chain.count - 1) as usize);
    let before = match at > first {
        true => Some(vertices[at - 1]),
        false => chain.is_closed.then(|| vertices[last]),
    };
    // A closed chain's first vertex stands behind its last one; a dot has no other.
    let is_end = at == last && !chain.is_closed;
    let to = if is_end { vertices[at] } else { vertices[at + 1] };
    let is_last = !chain.is_closed && at + 1 >= last;
    stroke::Segment { before, from: vertices[at], to, is_last }
}

/// Chains that one piece of parallel work looks at.
const CHAINS_AT_A_TIME: usize = 256;

/// The parts of a draw list being found.
struct Parts<'a> {
    list: &'a DrawList,
    pixel: &'a PixelSize,
    strokes: Strokes,
    long: Long,
    is_seen: &'a IsSeen<'a>,
}

impl Parts<'_> {
    /// All that are seen, and their boxes. The work is cut by chains: one item may have most of them.
    fn all(&self) -> (Vec<BorderPart>, Vec<PlanBox>) {
        let mut ends = Vec::with_capacity(self.list.items().len());
        let mut count = 0;
        for item in self.list.items() {
            count += item.area.len() + item.strokes.len();
            ends.push(count);
        }
        let found = parallel::map_indices(count.div_ceil(CHAINS_AT_A_TIME), |k| {
            let first = k * CHAINS_AT_A_TIME;
            self.of_chains(first..count.min(first + CHAINS_AT_A_TIME), &ends)
        });
        found.into_iter().flatten().unzip()
    }

    /// Those of some of all items' chains; `ends` counts the chains up to each item's last one.
    fn of_chains(&self, chains: Range<usize>, ends: &[usize]) -> Vec<(BorderPart, PlanBox)> {
        let mut found = Vec::new();
        let mut item = ends.partition_point(|end| *end <= chains.start);
        for chain in chains {
            while ends[item] <= chain {
                item += 1;
            }
            let start = if item == 0 { 0 } else { ends[item - 1] };
            self.of_chain(item as u32, (chain - start) as u32, &mut found);
        }
        found
    }

    /// Those of the chain at a place among an item's.
    fn of_chain(&self, item: u32, place: u32, found: &mut Vec<(BorderPart, PlanBox)>) {
        let vertices = self.list.vertices();
        let mut add = |vertex: u32, ends: [Plan; 2], reach: DVec2| {
            for plan in self.long.boxes(ends, reach).filter(|plan| !plan.is_empty() && (self.is_seen)(plan)) {
                found.push((BorderPart { item, chain: place, vertex }, plan));
            }
        };
        if let Some((chain, line)) = stroke_of(self.list, item, place) {
            let strokes = self.strokes.of(self.list.style_of(item).role);
            // A dot is a part too.
            for vertex in chain.first..chain.first + chain.segments().max(1) {
                let segment = segment_of(vertices, chain, vertex as usize);
                if let Some(reach) = stroke::reach(&segment, line, (self.pixel, strokes)) {
                    add(vertex, [segment.from, segment.to], reach);
                }
            }
            return;
        }
        let border = &self.list.area(&self.list.items()[item as usize])[place as usize];
        for vertex in border.first..border.first + border.count {
            let (from, to) = (vertices[vertex as usize], vertices[vertex as usize + 1]);
            if from != to {
                add(vertex, [from, to], DVec2::ZERO);
            }
        }
    }
}

/// Which segments are long: a box around all of such a one would hold much that it is far from, so it has several along it.
#[derive(Debug, Clone, Copy)]
struct Long {
    /// Shorter ones have one box.
    least: f64,
    /// The most boxes of one.
    most: f64,
}

impl Long {
    /// A segment of this share of all that is drawn is long.
    const SHARE: f64 = 1.0 / 256.0;
    /// The most boxes of a segment, and about the most of all beyond one each.
    const BOXES: (usize, usize) = (64, 1 << 20);

    fn of(list: &DrawList) -> Self {
        let all = PlanBox::around(list.vertices().iter().copied());
        let size = if all.is_empty() { 0.0 } else { (all.max - all.min).max_element() };
        let most = (Self::BOXES.1 / list.vertices().len().max(1)).clamp(1, Self::BOXES.0);
        Self { least: size * Self::SHARE, most: most as f64 }
    }

    /// Boxes along a segment, with all within `reach` of it in each coordinate.
    fn boxes(self, [from, to]: [Plan; 2], reach: DVec2) -> impl Iterator<Item = PlanBox> {
        let along = to - from;
        let (wide, tall) = (along.x.abs(), along.y.abs());
        let narrow = crate::math::min(wide, tall);
        let is_long = along.length() > self.least && self.most > 1.0 && narrow.is_finite();
        // One along an axis, or one that is hardly longer than wide, is as well in one box.
        let wished = narrow / (4.0 * reach.max_element() + (wide + tall) / self.most);
        let count = if is_long { crate::math::min(wished.ceil(), self.most) as usize } else { 1 };
        let at = move |k: usize| match k {
            0 => from,
            _ if k == count.max(1) => to,
            _ => from + along * (k as f64 / count as f64),
        };
        // What is between two places is rounded by far less than this.
        let size = from.to_vec().abs().max_element() + to.to_vec().abs().max_element();
        let slack = if count > 1 { 16.0 * f64::EPSILON * size } else { 0.0 };
        let reach = reach + DVec2::splat(slack);
        (0..count.max(1)).map(move |k| {
            let PlanBox { min, max } = PlanBox::around([at(k), at(k + 1)]);
            PlanBox { min: min + -reach, max: max + reach }
        })
    }
}

/// Whether a line's width grows with the distance from the eye.
fn grows_with_distance(line: &Line, pixel: &PixelSize) -> bool {
    matches!(line.width, Width::Pixels(_)) && pixel.eye.is_some()
}

#[cfg(test)]
mod tests;
