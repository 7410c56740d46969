//! What lies in a box of the plan.

use super::build::{Run, SEGMENTS_OF_A_RUN, Source};
use super::bvh::Bvh;
use super::cell::{AreaPart, Cell, FillLeaf, LineLeaf, NOTHING, RingPart, Turns};
use super::quadtree::{Cut, south_east};
use super::settings::{Hierarchy, Outlines};
use super::stroke::Segment;
use crate::draw_list::Role;
use crate::index::morton;
use crate::space::{Plan, PlanBox, SmallBox};
use std::cmp::Reverse;

/// The most edges of a ring that is kept by its edges in each cell, without a quadtree.
const FEW_EDGES: usize = 64;

/// The box of what may lie in all of a cell.
const EVERYWHERE: PlanBox = PlanBox {
    min: Plan { x: f64::NEG_INFINITY, y: f64::NEG_INFINITY },
    max: Plan { x: f64::INFINITY, y: f64::INFINITY },
};

/// As what rings are kept in cells; no answer depends on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum RingsAs {
    /// Where their quadtrees are entered, as the thesis has it.
    Trees,
    /// What tells exact points soonest: a number where no edge is near, the edges of rings that have few; quadtrees of the others.
    Turns,
}

/// What a cell is made of.
#[derive(Debug, Default)]
pub(super) struct Contents {
    /// Segments with their boxes.
    pub(super) lines: Vec<(LineLeaf, SmallBox)>,
    /// Fills with the boxes of what they are made of.
    pub(super) fills: Vec<(FillLeaf, SmallBox)>,
    /// By owner.
    pub(super) areas: Vec<AreaPart>,
    pub(super) rings: Vec<RingPart>,
    /// The vertices of [`Turns::Own`].
    pub(super) vertices: Vec<Plan>,
}

impl Contents {
    /// The cell; none where there is nothing in it.
    pub(super) fn into_cell(mut self, hierarchy: Hierarchy, plan: &PlanBox) -> Option<Cell> {
        if self.lines.is_empty() && self.fills.is_empty() {
            return None;
        }
        let bits = if hierarchy == Hierarchy::Wide { 3 } else { 1 };
        // Segments of a line keep their order, so that those of one line are next to each other (4.4.1).
        let by_draw_order = |(leaf, _): &(LineLeaf, SmallBox)| (Reverse(leaf.item), leaf.chain, leaf.vertex);
        match hierarchy {
            Hierarchy::Curve => {
                self.lines.sort_by_cached_key(|entry| (curve_place(plan, &entry.1), by_draw_order(entry)))
            }
            Hierarchy::Binary | Hierarchy::Wide => self.lines.sort_unstable_by_key(by_draw_order),
        }
        self.fills.sort_unstable_by_key(|(leaf, _)| Reverse(leaf.item));
        let (segments, line_boxes): (Vec<LineLeaf>, Vec<SmallBox>) = self.lines.into_iter().unzip();
        let (fills, fill_boxes): (Vec<FillLeaf>, Vec<SmallBox>) = self.fills.into_iter().unzip();
        Some(Cell {
            lines: Bvh::new(&line_boxes, bits),
            segments: segments.into(),
            polygons: Bvh::new(&fill_boxes, bits),
            fills: fills.into(),
            areas: self.areas.into(),
            rings: self.rings.into(),
            vertices: self.vertices.into(),
            corner: south_east(plan),
        })
    }

    /// What tells it from the contents of other cells, where that is which fills hold all of the cell: their items in order.
    pub(super) fn fills_throughout(&self) -> Option<Vec<u32>> {
        let is_throughout =
            self.lines.is_empty() && self.rings.iter().all(|part| matches!(part.turns, Turns::Throughout(_)));
        is_throughout.then(|| {
            let mut items: Vec<u32> = self.fills.iter().map(|(leaf, _)| leaf.item).collect();
            items.sort_unstable();
            items
        })
    }
}

impl Source<'_> {
    /// What lies in a box of the plan.
    pub(super) fn contents(&self, plan: &PlanBox, rings_as: RingsAs) -> Contents {
        let mut contents = Contents::default();
        self.add_areas(plan, rings_as, &mut contents);
        self.add_lines(plan, &mut contents);
        contents
    }

    /// Rings by owner, and the fills that they make.
    fn add_areas(&self, plan: &PlanBox, rings_as: RingsAs, contents: &mut Contents) {
        let mut near = Vec::new();
        self.ring_boxes.query(plan, |ring| {
            near.push(ring);
            true
        });
        near.sort_unstable();
        let rings = self.rings();
        for of_owner in near.chunk_by(|a, b| rings[*a as usize].owner == rings[*b as usize].owner) {
            let (owner, first) = (rings[of_owner[0] as usize].owner, contents.rings.len());
            let bounds = match rings_as {
                RingsAs::Trees => self.add_trees(plan, of_owner, contents),
                RingsAs::Turns => self.add_turns(plan, of_owner, contents),
            };
            if contents.rings.len() == first {
                continue;
            }
            let (area, style) = (contents.areas.len() as u32, self.list.items()[owner as usize].style);
            contents.areas.push(AreaPart { owner, first: first as u32 });
            if self.list.style_of(owner).role == Role::Fill {
                contents.fills.push((FillLeaf { item: owner, style, area }, SmallBox::around(&bounds)));
            }
        }
        for &item in &self.everywhere {
            let area = contents.areas.iter().position(|part| part.owner == item);
            let first = area.map(|area| &contents.rings[contents.areas[area].first as usize]);
            if first.is_some_and(|part| part.opens_member && matches!(part.turns, Turns::Throughout(_))) {
                // Nothing of the box is outside.
                continue;
            }
            let area = area.map_or(NOTHING, |area| area as u32);
            let style = self.list.items()[item as usize].style;
            let around = if rings_as == RingsAs::Turns { EVERYWHERE } else { *plan };
            contents.fills.push((FillLeaf { item, style, area }, SmallBox::around(&around)));
        }
    }

    /// Adds where the quadtrees of an owner's rings are entered (quadtree culling); the box around what they bound.
    fn add_trees(&self, plan: &PlanBox, of_owner: &[u32], contents: &mut Contents) -> PlanBox {
        let (mut bounds, mut member) = (PlanBox::EMPTY, None);
        for &ring in of_owner {
            let quadtree = self.quadtree(ring);
            let Some(start) = quadtree.start_in(plan) else { continue };
            let own = self.chain_of(ring).member;
            let opens_member = member.replace(own) != Some(own);
            contents.rings.push(RingPart { opens_member, turns: Turns::Tree { ring, start } });
            bounds.include_box(&quadtree.bounds());
        }
        bounds
    }

    /// Adds an owner's rings as the turns that they add, member by member; the box around what they bound. Nothing is added of what is outside
    /// in all of the box, and one part alone where all of it is inside.
    fn add_turns(&self, plan: &PlanBox, of_owner: &[u32], contents: &mut Contents) -> PlanBox {
        let style = self.list.style_of(self.rings()[of_owner[0] as usize].owner);
        if style.role == Role::Outline && self.outlines == Outlines::Side {
            // Nobody asks for it.
            return PlanBox::EMPTY;
        }
        let (first, first_vertex) = (contents.rings.len(), contents.vertices.len());
        let mut bounds = PlanBox::EMPTY;
        let member_of = |ring: &u32| self.chain_of(*ring).member;
        for of_member in of_owner.chunk_by(|a, b| member_of(a) == member_of(b)) {
            let (start, mut throughout) = (contents.rings.len(), 0);
            for &ring in of_member {
                throughout += self.add_ring(plan, ring, contents, &mut bounds);
            }
            let is_uniform = contents.rings.len() == start;
            if is_uniform && style.rule.contains(throughout) {
                contents.rings.truncate(first);
                contents.vertices.truncate(first_vertex);
                contents.rings.push(RingPart { opens_member: true, turns: Turns::Throughout(1) });
                return EVERYWHERE;
            }
            if !is_uniform && throughout != 0 {
                contents.rings.push(RingPart { opens_member: false, turns: Turns::Throughout(throughout) });
                bounds = EVERYWHERE;
            }
            if let Some(part) = contents.rings.get_mut(start) {
                part.opens_member = true;
            }
        }
        bounds
    }

    /// Adds a ring if an edge of it may meet the box; its turns around all of the box if none does.
    fn add_ring(&self, plan: &PlanBox, ring: u32, contents: &mut Contents, bounds: &mut PlanBox) -> i32 {
        let path = self.list.path_of(self.chain_of(ring));
        if path.len() - 1 > FEW_EDGES {
            let quadtree = self.quadtree(ring);
            let Some(start) = quadtree.start_in(plan) else { return 0 };
            let turns = quadtree.turns_in(self.list.vertices(), start, plan);
            if turns.is_none() {
                contents.rings.push(RingPart { opens_member: false, turns: Turns::Tree { ring, start } });
                bounds.include_box(&quadtree.bounds());
            }
            return turns.unwrap_or(0);
        }
        let cut = Cut::new(path, plan);
        if cut.runs.is_empty() {
            return cut.corner;
        }
        bounds.include_box(&PlanBox::around(path.iter().copied()));
        // The corner's turns are counted with the first run.
        let mut corner = cut.corner;
        for run in cut.runs {
            let first = contents.vertices.len() as u32;
            contents.vertices.extend_from_slice(run);
            let turns = Turns::Own { first, count: run.len() as u32, corner: std::mem::take(&mut corner) };
            contents.rings.push(RingPart { opens_member: false, turns });
        }
        0
    }

    /// Segments whose widened quadrilaterals meet the box (4.2.1, *Line Segments*).
    fn add_lines(&self, plan: &PlanBox, contents: &mut Contents) {
        self.run_boxes.query(plan, |run| {
            let Run { item, chain: place, first } = self.runs[run as usize];
            let of = &self.list.items()[item as usize];
            let Some(rules) = &self.rules[of.style as usize] else { return true };
            let chain = &self.list.strokes(of)[place as usize];
            let path = self.list.path_of(chain);
            let end = chain.segments().max(1).min(first + SEGMENTS_OF_A_RUN);
            let reach = rules.reach();
            for k in first..end {
                let ends = [path[k as usize], path[(k as usize + 1).min(path.len() - 1)]];
                if !PlanBox::around(ends).grown(reach).meets(plan) {
                    continue;
                }
                let segment = Segment::new(path, chain.is_closed, k as usize, rules);
                let bounds = segment.bounds();
                if bounds.meets(plan) && segment.may_meet(plan) {
                    let leaf = LineLeaf { item, chain: place, vertex: k };
                    contents.lines.push((leaf, SmallBox::around(&bounds)));
                }
            }
            true
        });
    }
}

/// The place of a box's middle on a curve through the cell (Thöny et al. 2017).
fn curve_place(plan: &PlanBox, of: &SmallBox) -> u64 {
    let (middle, size) = (of.middle(), plan.max - plan.min);
    // Casts saturate: what reaches out of the cell is put on its border.
    let place = |d: f64, size: f64| (d / size * 65536.0) as u32;
    morton(place(middle.x - plan.min.x, size.x).min(65535), place(middle.y - plan.min.y, size.y).min(65535))
}
