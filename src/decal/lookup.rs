//! Samples -> the items that hold them (3.4.1, Algorithm 3.5).
//!
//! A pixel's samples are looked up together: nodes are compared with the box around those that lie in one cell, leaves are asked about each.
//! That leaves out no more and no less than asking for each sample alone.

use super::build::Source;
use super::bvh::Walk;
use super::cell::{Cell, FillLeaf, LineLeaf, NOTHING, RingPart};
use super::grid::DecalGrid;
use super::hits::{Hits, MOST_TOGETHER};
use super::memory::{Built, Memory};
use super::palette::Palette;
use super::quadtree::Counts as QuadtreeCounts;
use super::settings::{Hierarchy, Outlines, Overlaps, Preparation, Settings};
use super::side::Sides;
use crate::draw_list::{DrawList, Role, Side};
use crate::parallel;
use crate::space::{Plan, PlanBox, SmallBox};
use std::sync::OnceLock;

/// Static decals: which items hold which points of the plan.
#[derive(Debug)]
pub struct Decals<'l> {
    pub(super) source: Source<'l>,
    pub(super) grid: DecalGrid,
    pub(super) cells: Vec<OnceLock<Option<Box<Cell>>>>,
    /// The sum of what is in the cells that have been built.
    built: Built,
    pub(super) sides: Sides,
    pub(super) settings: Settings,
    /// Whether points, vertices and tests are of single precision.
    is_single: bool,
}

/// What was done for some samples.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct LookupCounts {
    /// Nodes of trees whose boxes were looked at.
    pub nodes: u32,
    /// Segments, and polygons or parts of them, that samples were compared with.
    pub leaves: u32,
    /// Nodes of quadtrees on the way to those.
    pub quadtree_nodes: u64,
    /// Edges of leaf polygons that samples were compared with.
    pub edges: u64,
}

impl LookupCounts {
    /// Both.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self {
            nodes: self.nodes + other.nodes,
            leaves: self.leaves + other.leaves,
            quadtree_nodes: self.quadtree_nodes + other.quadtree_nodes,
            edges: self.edges + other.edges,
        }
    }
}

/// Some samples that lie in one cell.
struct Packet<'a> {
    points: &'a [Plan],
    /// Their coordinates apart.
    x: &'a [f64],
    y: &'a [f64],
    /// The box around those that are looked up.
    plan: PlanBox,
    bounds: SmallBox,
    /// Those that may still show something.
    open: u64,
}

impl<'l> Decals<'l> {
    /// The decals of a list, above a terrain that covers `terrain` of the plan. Cells are built when a point is first looked up in them, or all
    /// at once, as the settings say; `progress` is told the share that is done then.
    pub fn new(
        list: &'l DrawList,
        terrain: &PlanBox,
        settings: &Settings,
        is_single: bool,
        progress: &(dyn Fn(f64) + Sync),
    ) -> Self {
        let source = Source::new(list, settings);
        // Where the terrain is not, nothing is seen; what paints everywhere needs all of it.
        let bounds = match source.is_everywhere() {
            true => *terrain,
            false => source.bounds.common(terrain),
        };
        let grid = DecalGrid::new(&bounds, settings.grid);
        let cells = (0..grid.count()).map(|_| OnceLock::new()).collect();
        let decals = Self {
            sides: Sides::of(list),
            source,
            grid,
            cells,
            built: Built::default(),
            settings: *settings,
            is_single,
        };
        if settings.preparation == Preparation::Whole {
            decals.build_all(progress);
        }
        decals
    }

    /// Builds what has not been built.
    pub(super) fn build_all(&self, progress: &(dyn Fn(f64) + Sync)) {
        let side = self.grid.side();
        parallel::map_telling(side as usize, progress, |row| {
            for column in 0..side {
                self.cell(column + side * row as u32);
            }
        });
    }

    /// The draw list.
    pub fn list(&self) -> &'l DrawList {
        self.source.list
    }

    /// A cell, built when it is first asked for.
    #[inline(always)]
    pub(super) fn cell(&self, number: u32) -> Option<&Cell> {
        let build = || {
            let cell = self.cell_around(&self.grid.box_of(number));
            cell.iter().for_each(|cell| self.built.add(cell));
            cell
        };
        self.cells[number as usize].get_or_init(build).as_deref()
    }

    /// A cell that is built of what meets a box.
    pub(super) fn cell_around(&self, plan: &PlanBox) -> Option<Box<Cell>> {
        self.source.contents(plan).into_cell(self.settings.hierarchy, plan)
    }

    /// The number of the cell that a point lies in; `None` outside the grid.
    #[inline(always)]
    pub fn cell_of(&self, at: Plan) -> Option<u32> {
        if self.is_single { self.grid.cell_of_f32(single(at)) } else { self.grid.cell_of(at) }
    }

    /// Finds the items that hold any of some points, at most [`MOST_TOGETHER`]; points that are infinite lie in none. `hits` is emptied first.
    ///
    /// # Panics
    /// With more points.
    #[inline]
    pub fn find(&self, points: &[Plan], palette: &Palette, hits: &mut Hits, counts: &mut LookupCounts) {
        assert!(points.len() <= MOST_TOGETHER, "too many points are looked up together");
        hits.clear();
        let mut bounds = PlanBox::EMPTY;
        let mut finite = 0u64;
        for (k, at) in points.iter().enumerate() {
            if at.is_finite() {
                bounds.include(*at);
                finite |= 1 << k;
            }
        }
        if finite == 0 {
            return;
        }
        // Cells are found by monotone functions of coordinates: what lies between two points of a cell lies in it.
        let corners = (self.cell_of(bounds.min), self.cell_of(bounds.max));
        if corners.0 == corners.1
            && let Some(cell) = corners.0
        {
            self.find_in((cell, &bounds), points, finite, palette, (hits, counts));
            return;
        }
        if let (Some(first), Some(last)) = corners
            && self
                .grid
                .cells_between(first, last)
                .is_some_and(|mut cells| cells.all(|cell| self.cell(cell).is_none()))
        {
            // Most are empty where decals are sparse.
            return;
        }
        self.find_apart(points, finite, palette, (hits, counts));
    }

    /// As [`Decals::find`], of points that do not all lie in one cell.
    fn find_apart(
        &self,
        points: &[Plan],
        mut left: u64,
        palette: &Palette,
        (hits, counts): (&mut Hits, &mut LookupCounts),
    ) {
        let mut cells = 0;
        while left != 0 {
            let first = self.cell_of(points[left.trailing_zeros() as usize]);
            let mut bounds = PlanBox::EMPTY;
            let mut here = 0u64;
            for k in (0..points.len()).filter(|k| left >> k & 1 == 1) {
                if self.cell_of(points[k]) == first {
                    here |= 1 << k;
                    bounds.include(points[k]);
                }
            }
            left &= !here;
            if let Some(cell) = first {
                self.find_in((cell, &bounds), points, here, palette, (hits, counts));
                cells += 1;
            }
        }
        if cells > 1 {
            hits.sort();
            if self.settings.overlaps == Overlaps::Once {
                hits.join();
            }
        }
    }

    /// Finds the items that hold any of some points of a cell, and adds them.
    #[inline]
    fn find_in(
        &self,
        (number, bounds): (u32, &PlanBox),
        points: &[Plan],
        samples: u64,
        palette: &Palette,
        (hits, counts): (&mut Hits, &mut LookupCounts),
    ) {
        let Some(cell) = self.cell(number) else { return };
        let (mut x, mut y) = ([0.0; MOST_TOGETHER], [0.0; MOST_TOGETHER]);
        // Those that are not looked up here, and may be infinite, are as one that is.
        let any = points[samples.trailing_zeros() as usize];
        for (k, at) in points.iter().enumerate() {
            let at = if samples >> k & 1 == 1 { *at } else { any };
            (x[k], y[k]) = (at.x, at.y);
        }
        let count = points.len();
        let packet = Packet {
            points,
            x: &x[..count],
            y: &y[..count],
            plan: *bounds,
            bounds: SmallBox::around(bounds),
            open: samples,
        };
        let found = match self.settings.hierarchy {
            Hierarchy::Binary | Hierarchy::Wide => self.search(cell, packet, palette, hits),
            Hierarchy::Curve => self.search_unordered(cell, packet, palette, hits),
        };
        *counts = counts.plus(found);
    }

    /// Looks at lines and polygons together in draw order, from the front, until nothing more shows.
    fn search(&self, cell: &Cell, mut packet: Packet, palette: &Palette, hits: &mut Hits) -> LookupCounts {
        let mut counts = LookupCounts::default();
        let mut lines = Walk::new(&cell.lines, packet.bounds);
        let mut polygons = Walk::new(&cell.polygons, packet.bounds);
        let mut line = lines.next().map(|leaf| cell.segments[leaf as usize]);
        let mut fill = polygons.next().map(|leaf| cell.fills[leaf as usize]);
        // Samples that the line at hand holds already.
        let mut of_line = (u32::MAX, 0u64);
        while packet.open != 0 {
            let is_line = match (line, fill) {
                (None, None) => break,
                (Some(line), Some(fill)) => line.item > fill.item,
                (is_there, None) => is_there.is_some(),
                (None, Some(_)) => false,
            };
            let (item, held) = if is_line {
                let leaf = line.unwrap_or_default();
                line = lines.next().map(|leaf| cell.segments[leaf as usize]);
                if of_line.0 != leaf.item {
                    of_line = (leaf.item, 0);
                }
                let is_once = self.settings.overlaps == Overlaps::Once;
                let wanted = if is_once { packet.open & !of_line.1 } else { packet.open };
                if wanted == 0 {
                    continue;
                }
                let held = self.held_by_line(cell, leaf, &packet, wanted, &mut counts);
                of_line.1 |= held;
                (leaf.item, held)
            } else {
                let leaf = fill.unwrap_or_default();
                fill = polygons.next().map(|leaf| cell.fills[leaf as usize]);
                (leaf.item, self.held_by_fill(cell, leaf, &packet, packet.open, &mut counts))
            };
            if held != 0 {
                if is_line && self.settings.overlaps == Overlaps::Double {
                    hits.push(item, held);
                } else {
                    hits.push_once(item, held);
                }
                if palette.is_opaque(item) {
                    packet.open &= !held;
                }
            }
        }
        counts.nodes += lines.visited + polygons.visited;
        counts
    }

    /// Looks at all that is near, in any order, and sorts what is found.
    fn search_unordered(
        &self,
        cell: &Cell,
        packet: Packet,
        palette: &Palette,
        hits: &mut Hits,
    ) -> LookupCounts {
        let mut counts = LookupCounts::default();
        let mut found = Hits::default();
        let mut lines = Walk::new(&cell.lines, packet.bounds);
        for leaf in lines.by_ref() {
            let leaf = cell.segments[leaf as usize];
            let held = self.held_by_line(cell, leaf, &packet, packet.open, &mut counts);
            if held != 0 {
                found.push(leaf.item, held);
            }
        }
        let mut polygons = Walk::new(&cell.polygons, packet.bounds);
        for leaf in polygons.by_ref() {
            let leaf = cell.fills[leaf as usize];
            let held = self.held_by_fill(cell, leaf, &packet, packet.open, &mut counts);
            if held != 0 {
                found.push(leaf.item, held);
            }
        }
        counts.nodes += lines.visited + polygons.visited;
        found.sort();
        if self.settings.overlaps == Overlaps::Once {
            found.join();
        }
        // What lies below what is opaque is left out, as where the order is known beforehand.
        let mut open = packet.open;
        for hit in found.found() {
            let held = hit.samples & open;
            if held != 0 {
                hits.push(hit.item, held);
            }
            if palette.is_opaque(hit.item) {
                open &= !held;
            }
        }
        counts
    }

    /// Which of the wanted samples a segment holds.
    #[inline]
    fn held_by_line(
        &self,
        cell: &Cell,
        leaf: LineLeaf,
        packet: &Packet,
        wanted: u64,
        counts: &mut LookupCounts,
    ) -> u64 {
        counts.leaves += 1;
        let mut held = match self.is_single {
            false => self.source.segment(leaf).map_or(0, |segment| match packet.points {
                [only] => u64::from(segment.holds(*only)),
                _ => segment.mask_of(packet.x, packet.y) & wanted,
            }),
            true => {
                let segment = self.source.single_segment(leaf);
                segment.map_or(0, |segment| of(packet.points, wanted, |at| segment.holds(single(*at))))
            }
        };
        let style = self.list().style_of(leaf.item);
        if let Some(side) = style.cut
            && held != 0
        {
            held = match self.settings.outlines {
                Outlines::Side => {
                    let is_left_inside = self.sides.is_left_inside(&self.source, leaf.item, leaf.chain);
                    let Some(segment) = self.source.segment(leaf) else { return 0 };
                    let is_wanted = |at: &Plan| {
                        let turn = segment.side(*at);
                        // A point on the centre line lies on both sides.
                        turn == 0.0 || ((turn > 0.0) == is_left_inside) == (side == Side::Inside)
                    };
                    of(packet.points, held, is_wanted)
                }
                Outlines::Polygon => {
                    let owner = self.list().area_owner(leaf.item);
                    let inside = self.held_by_area(cell, cell.area_of(owner), (packet, held), counts);
                    if side == Side::Inside { inside } else { held & !inside }
                }
            };
        }
        held
    }

    /// Which of the wanted samples a fill holds.
    #[inline]
    fn held_by_fill(
        &self,
        cell: &Cell,
        leaf: FillLeaf,
        packet: &Packet,
        wanted: u64,
        counts: &mut LookupCounts,
    ) -> u64 {
        counts.leaves += 1;
        let inside = self.held_by_area(cell, leaf.area, (packet, wanted), counts);
        if self.list().style_of(leaf.item).role == Role::Outside { wanted & !inside } else { inside }
    }

    /// Which of the wanted samples lie inside of any member of an area: the rule says which of the winding numbers of a member's rings, exterior
    /// and interior ones at any nesting, are inside.
    fn held_by_area(
        &self,
        cell: &Cell,
        area: u32,
        (packet, wanted): (&Packet, u64),
        counts: &mut LookupCounts,
    ) -> u64 {
        if area == NOTHING {
            return 0;
        }
        let rings = cell.rings_of(area);
        let rule = self.list().style_of(cell.areas[area as usize].owner).rule;
        let vertices = self.list().vertices();
        let (mut inside, mut done) = (0, QuadtreeCounts::default());
        for member in
            rings.chunk_by(|a, b| self.source.chain_of(a.ring).member == self.source.chain_of(b.ring).member)
        {
            let mut left = wanted & !inside;
            if !self.is_single
                && left != 0
                && let Some(turns) = self.turns_throughout(member, packet, &mut done)
            {
                // As a rule no edge is near.
                inside |= if rule.contains(turns) { left } else { 0 };
                continue;
            }
            while left != 0 {
                let k = left.trailing_zeros() as usize;
                left &= left - 1;
                let mut turns = 0;
                for part in member {
                    let quadtree = self.source.quadtree(part.ring);
                    turns += match self.is_single {
                        false => quadtree.winding(vertices, part.start, packet.points[k], &mut done),
                        true => {
                            quadtree.winding_f32(vertices, part.start, single(packet.points[k]), &mut done)
                        }
                    };
                }
                if rule.contains(turns) {
                    inside |= 1 << k;
                }
            }
        }
        counts.quadtree_nodes += done.nodes;
        counts.edges += done.edges;
        inside
    }

    /// How often a member's rings turn around all of the samples, where that is one number.
    #[inline]
    fn turns_throughout(
        &self,
        member: &[RingPart],
        packet: &Packet,
        done: &mut QuadtreeCounts,
    ) -> Option<i32> {
        let vertices = self.list().vertices();
        let one = |part: &RingPart| {
            let quadtree = self.source.quadtree(part.ring);
            quadtree.turns_throughout(vertices, part.start, (&packet.plan, packet.plan.min), done)
        };
        member.iter().map(one).sum()
    }

    /// Whether a point lies inside of an area of its cell.
    pub(super) fn is_inside(&self, cell: &Cell, area: u32, at: Plan) -> bool {
        let packet = Packet {
            points: &[at],
            x: &[at.x],
            y: &[at.y],
            plan: PlanBox::around([at]),
            bounds: SmallBox::around(&PlanBox::around([at])),
            open: 1,
        };
        self.held_by_area(cell, area, (&packet, 1), &mut LookupCounts::default()) == 1
    }

    /// Bytes held, without the draw list: of what has been built.
    pub fn memory(&self) -> Memory {
        let cells = self.built.cells();
        Memory {
            cells,
            grid: size_of_val(&self.cells[..]) + cells * size_of::<Cell>(),
            lines: self.built.line_bytes(),
            polygons: self.built.polygon_bytes(),
            quadtrees: self.source.quadtree_bytes(),
            index: self.source.index_bytes(),
        }
    }
}

/// Which of the wanted points are as they should be.
#[inline(always)]
fn of<P>(points: &[P], mut wanted: u64, is: impl Fn(&P) -> bool) -> u64 {
    let mut held = 0;
    while wanted != 0 {
        let k = wanted.trailing_zeros();
        wanted &= wanted - 1;
        held |= u64::from(is(&points[k as usize])) << k;
    }
    held
}

#[inline(always)]
fn single(at: Plan) -> [f32; 2] {
    [at.x as f32, at.y as f32]
}
