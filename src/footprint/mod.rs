//! Features as sets of plan points, for the truth.
//!
//! Input: the layers of a scene, the view (widths in pixels depend on it) and which boxes of the plan can be seen. Output:
//! [`Footprints`]: [`Item`]s in draw order, each a set of plan points of one colour, their boundaries as small [`Part`]s in a
//! tree of boxes, and exact winding numbers. Refuses: nothing; degenerate rings and segments of no length have no points, or
//! those that `docs/semantics.md` says.

mod area;
mod box_tree;
mod pixel_size;
mod primitive;
mod stroke;

pub use box_tree::BoxTree;
pub use pixel_size::PixelSize;
pub use primitive::{Convex, HalfPlane, MOST_SIDES, Primitive, Sides};

use crate::scene::{Color, Feature, Layer, Line, OutlineMode, Rule, SAME_VERTEX, Shape, Style};
use crate::space::{Plan, PlanBox};
use area::Area;

/// A set of plan points of one colour.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Item {
    /// The layer's number in the scene.
    pub layer: u32,
    /// The feature's number in the layer.
    pub feature: u32,
    /// Whether it is a fill, an outline or a line.
    pub role: Role,
    /// Its colour.
    pub color: Color,
    /// The polygon that bounds it, if one does.
    area: Option<u32>,
    rule: Rule,
    stroke: Option<Line>,
}

/// What an item is of its feature.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Role {
    /// The inside of a polygon.
    Fill,
    /// The border of a polygon, or the part of it on one side.
    Outline(OutlineSide),
    /// A line.
    Line,
}

/// Which part of an outline's stroke counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum OutlineSide {
    /// The part in the polygon.
    Inside,
    /// All of it.
    Both,
    /// The part out of the polygon.
    Outside,
}

/// A piece of an item's boundary: an edge of its polygon, or a segment of its stroke with the join at its start and the
/// caps at its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Part {
    /// The item that it bounds.
    pub item: u32,
    chain: u32,
    vertex: u32,
}

/// Consecutive vertices of [`Footprints::points`]; the first stands again at the end of a closed one.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Chain {
    first: u32,
    /// Points, the repeated one too.
    count: u32,
    is_closed: bool,
    is_stroke: bool,
}

/// The items of a scene.
#[derive(Debug)]
pub struct Footprints {
    items: Vec<Item>,
    points: Vec<Plan>,
    chains: Vec<Chain>,
    areas: Vec<Area>,
    /// The item of each entry of `area_boxes`.
    area_items: Vec<u32>,
    area_boxes: BoxTree,
    parts: Vec<Part>,
    part_boxes: BoxTree,
    pixel: PixelSize,
}

impl Footprints {
    /// The items of all layers; parts and polygons whose box `is_seen` denies are left out.
    pub fn new(layers: &[Layer], pixel: PixelSize, is_seen: &(dyn Fn(&PlanBox) -> bool + Sync)) -> Self {
        let mut all = Building { pixel, ..Building::default() };
        for (l, layer) in layers.iter().enumerate() {
            for (f, feature) in layer.features.iter().enumerate() {
                all.add_feature((l as u32, f as u32), layer.style_of(feature), feature);
            }
        }
        all.finish(is_seen)
    }

    /// The items in draw order.
    pub fn items(&self) -> &[Item] {
        &self.items
    }

    /// Calls `visit` with each part whose box meets `plan`, until it returns false. Returns whether it saw all.
    #[inline]
    pub fn parts_near(&self, plan: &PlanBox, mut visit: impl FnMut(Part) -> bool) -> bool {
        self.part_boxes.query(plan, |k| visit(self.parts[k as usize]))
    }

    /// Calls `visit` with each item that a polygon bounds whose box meets `plan`.
    #[inline]
    pub fn areas_near(&self, plan: &PlanBox, mut visit: impl FnMut(u32)) {
        self.area_boxes.query(plan, |k| {
            visit(self.area_items[k as usize]);
            true
        });
    }

    /// Whether an item's polygon holds a point that lies on none of its edges, exactly; false for an item without one.
    pub fn polygon_holds(&self, item: u32, at: Plan) -> bool {
        let item = &self.items[item as usize];
        item.area.is_some_and(|area| item.rule.contains(self.areas[area as usize].winding(&self.points, at)))
    }

    /// What a part is made of.
    pub fn primitives(&self, part: Part, out: &mut Vec<Primitive>) {
        let (item, chain) = (&self.items[part.item as usize], &self.chains[part.chain as usize]);
        let at = part.vertex as usize;
        match item.stroke.filter(|_| chain.is_stroke) {
            Some(line) => stroke::primitives(&self.stroke_segment(chain, at), &line, &self.pixel, out),
            None => out.push(Primitive::Edge { from: self.points[at], to: self.points[at + 1] }),
        }
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.items[..])
            + size_of_val(&self.points[..])
            + size_of_val(&self.chains[..])
            + size_of_val(&self.parts[..])
            + self.areas.iter().map(Area::bytes).sum::<usize>()
            + self.part_boxes.bytes()
            + self.area_boxes.bytes()
    }

    /// A stroke's segment that starts at a point, with what is before and after it.
    fn stroke_segment(&self, chain: &Chain, at: usize) -> stroke::Segment {
        segment_of(&self.points, chain, at)
    }
}

impl Item {
    /// Whether a point of this item must lie in (or out of) its polygon; `None`: no matter.
    pub fn wants_polygon(&self) -> Option<bool> {
        match self.role {
            Role::Fill | Role::Outline(OutlineSide::Inside) => Some(true),
            Role::Outline(OutlineSide::Outside) => Some(false),
            Role::Outline(OutlineSide::Both) | Role::Line => None,
        }
    }

    /// Whether a point of this item must lie in its stroke.
    pub fn wants_stroke(&self) -> bool {
        self.stroke.is_some()
    }
}

fn segment_of(points: &[Plan], chain: &Chain, at: usize) -> stroke::Segment {
    let (first, last) = (chain.first as usize, (chain.first + chain.count - 1) as usize);
    let before = match at > first {
        true => Some(points[at - 1]),
        false => chain.is_closed.then(|| points[last - 1]),
    };
    let is_dot = first == last;
    let is_last = is_dot || (at + 1 == last && !chain.is_closed);
    stroke::Segment { before, from: points[at], to: points[if is_dot { at } else { at + 1 }], is_last }
}

/// Footprints being collected.
#[derive(Default)]
struct Building {
    items: Vec<Item>,
    points: Vec<Plan>,
    chains: Vec<Chain>,
    /// The item of each chain.
    chain_items: Vec<u32>,
    areas: Vec<Area>,
    pixel: PixelSize,
}

impl Building {
    fn add_feature(&mut self, (layer, feature): (u32, u32), style: &Style, what: &Feature) {
        let none = Color([0.0; 4]);
        let mut item = Item {
            layer,
            feature,
            role: Role::Line,
            color: none,
            area: None,
            rule: Rule::EvenOdd,
            stroke: None,
        };
        match &what.shape {
            Shape::Line(parts) => {
                let Some(line) = style.line else { return };
                (item.color, item.stroke) = (line.color, Some(line));
                self.items.push(item);
                parts.iter().for_each(|part| self.add_stroke(part, StrokeEnds::AsWritten));
            }
            Shape::Polygon(rings) => {
                item.rule = style.fill.map_or(Rule::EvenOdd, |fill| fill.rule);
                if let Some(fill) = style.fill {
                    item.area = Some(self.areas.len() as u32);
                    (item.role, item.color) = (Role::Fill, fill.color);
                    self.items.push(item);
                    self.add_borders(rings);
                }
                let Some(outline) = style.outline else { return };
                (item.role, item.area) = (Role::Outline(side_of(outline.mode)), None);
                (item.color, item.stroke) = (outline.line.color, Some(outline.line));
                item.area = item.wants_polygon().map(|_| self.areas.len() as u32);
                self.items.push(item);
                if item.area.is_some() {
                    self.add_borders(rings);
                }
                rings.iter().for_each(|ring| self.add_stroke(ring, StrokeEnds::Closed));
            }
        }
    }

    /// Adds the edges of a polygon's rings to the last item, and its area.
    fn add_borders(&mut self, rings: &[Vec<Plan>]) {
        let (start, item) = (self.chains.len(), self.items.len() as u32 - 1);
        for ring in rings.iter().filter(|ring| ring.len() > 1) {
            let first = self.points.len() as u32;
            self.points.extend(ring);
            self.points.push(ring[0]);
            let count = ring.len() as u32 + 1;
            self.push_chain(Chain { first, count, is_closed: true, is_stroke: false }, item);
        }
        let ranges = self.chains[start..].iter().map(|c| c.first..c.first + c.count - 1);
        self.areas.push(Area::new(&self.points, ranges, item));
    }

    /// Adds a polyline's stroke to the last item.
    fn add_stroke(&mut self, points: &[Plan], ends: StrokeEnds) {
        let (first, item) = (self.points.len(), self.items.len() as u32 - 1);
        let Some(&start) = points.first() else { return };
        self.points.push(start);
        let mut last = start;
        for &p in points {
            if !is_same_vertex(p, last) {
                self.points.push(p);
                last = p;
            }
        }
        let distinct = self.points.len() - first;
        let returns = distinct > 1 && is_same_vertex(start, last);
        let is_closed = match ends {
            // A line that ends where it begins is a ring (a loop of Taibo 4.2): joined there, without caps.
            StrokeEnds::AsWritten => returns && distinct > 3,
            StrokeEnds::Closed => distinct > 1,
        };
        if is_closed && returns {
            self.points.pop();
        }
        if is_closed {
            self.points.push(start);
        }
        let count = (self.points.len() - first) as u32;
        self.push_chain(Chain { first: first as u32, count, is_closed, is_stroke: true }, item);
    }

    fn push_chain(&mut self, chain: Chain, item: u32) {
        self.chains.push(chain);
        self.chain_items.push(item);
    }

    fn finish(self, is_seen: &(dyn Fn(&PlanBox) -> bool + Sync)) -> Footprints {
        let found = crate::parallel::map_indices(self.chains.len().div_ceil(CHAINS_AT_A_TIME), |k| {
            let end = ((k + 1) * CHAINS_AT_A_TIME).min(self.chains.len());
            let mut found = Vec::new();
            (k * CHAINS_AT_A_TIME..end).for_each(|chain| self.find_parts(chain, is_seen, &mut found));
            found
        });
        let (parts, boxes): (Vec<Part>, Vec<PlanBox>) = found.into_iter().flatten().unzip();
        let seen: Vec<(u32, PlanBox)> =
            self.areas.iter().map(|a| (a.item(), a.bounds())).filter(|(_, plan)| is_seen(plan)).collect();
        let (area_items, area_boxes): (Vec<u32>, Vec<PlanBox>) = seen.into_iter().unzip();
        Footprints {
            items: self.items,
            points: self.points,
            chains: self.chains,
            areas: self.areas,
            area_items,
            area_boxes: BoxTree::new(&area_boxes),
            parts,
            part_boxes: BoxTree::new(&boxes),
            pixel: self.pixel,
        }
    }

    /// The seen parts of a chain and their boxes.
    fn find_parts(
        &self,
        chain: usize,
        is_seen: &(dyn Fn(&PlanBox) -> bool + Sync),
        found: &mut Vec<(Part, PlanBox)>,
    ) {
        let (item, index, chain) = (self.chain_items[chain], chain as u32, &self.chains[chain]);
        let line = self.items[item as usize].stroke.filter(|_| chain.is_stroke);
        let vertices = chain.first..chain.first + (chain.count - 1).max(u32::from(chain.is_stroke));
        for vertex in vertices {
            let at = vertex as usize;
            if line.is_none() && self.points[at] == self.points[at + 1] {
                continue;
            }
            let plan = match line {
                Some(line) => stroke::bounds(&segment_of(&self.points, chain, at), &line, &self.pixel),
                None => PlanBox::around([self.points[at], self.points[at + 1]]),
            };
            if !plan.is_empty() && is_seen(&plan) {
                found.push((Part { item, chain: index, vertex }, plan));
            }
        }
    }
}

/// Chains that one piece of parallel work looks at.
const CHAINS_AT_A_TIME: usize = 256;

/// How a stroke ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum StrokeEnds {
    /// With caps, unless it ends where it begins.
    AsWritten,
    /// It runs back to its start.
    Closed,
}

fn is_same_vertex(a: Plan, b: Plan) -> bool {
    (a - b).length() <= SAME_VERTEX
}

fn side_of(mode: OutlineMode) -> OutlineSide {
    match mode {
        OutlineMode::Inset => OutlineSide::Inside,
        OutlineMode::Normal => OutlineSide::Both,
        OutlineMode::Offset => OutlineSide::Outside,
    }
}

#[cfg(test)]
mod tests;
