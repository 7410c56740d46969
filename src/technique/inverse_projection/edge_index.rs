//! A uniform grid over the plan that finds the edges near a pixel and the windings of areas at a point (She 3.5: "only
//! several lines are involved in the repeated calculation").
//!
//! Each cell lists the edges that meet it, and the areas that wind around its south-west corner. The winding of a point follows
//! from the corner's by the edges that a path from the corner crosses: up along the cell's western side, then east.

use super::expansion::{AreaId, Edge, expanded};
use super::quadrilateral::Quadrilateral;
use crate::draw_list::{DrawList, Role, Side};
use crate::error::{Error, Result};
use crate::index::CellLists;
use crate::math;
use crate::parallel;
use crate::predicate::orient2d;
use crate::scene::{Group, Rule};
use crate::space::{Plan, PlanBox};
use std::ops::Range;

/// Most cells of the grid.
const MAX_CELLS: f64 = (1u32 << 24) as f64;

/// Most cells that are searched for the edges of several pixels at once.
const MOST_SHARED_CELLS: usize = 16;

/// The edges of a draw list's areas, and the grid over them.
#[derive(Debug)]
pub struct EdgeIndex<'l> {
    list: &'l DrawList,
    area_count: usize,
    edges: Vec<Edge>,
    origin: Plan,
    cell: f64,
    /// 1 / cell, to find cells without a division.
    per_metre: f64,
    columns: usize,
    rows: usize,
    /// The edges that meet each cell.
    members: CellLists<u32>,
    /// The areas that wind around each cell's corner.
    covers: CellLists<Winding>,
    /// `sums[r * (columns + 1) + c]`: how many members the cells of rows below r and columns below c have.
    sums: Vec<u64>,
    /// The rectangle of the plan that the terrain covers.
    terrain: PlanBox,
}

/// How often an area winds around a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Winding {
    /// The area.
    pub area: AreaId,
    /// The number of turns, counter-clockwise positive.
    pub turns: i32,
}

/// The areas that wind around a point, kept as the point moves on.
#[derive(Debug)]
pub struct Around {
    at: Plan,
    windings: Vec<Winding>,
}

impl Around {
    /// Around no point yet.
    pub fn nowhere() -> Self {
        Self { at: Plan::new(f64::NAN, f64::NAN), windings: Vec::new() }
    }

    /// The windings that differ from 0, in the areas' order.
    pub fn windings(&self) -> &[Winding] {
        &self.windings
    }

    /// Adds to an area's turns, of which none may be left.
    fn add(&mut self, area: AreaId, turns: i32) {
        match self.windings.binary_search_by_key(&area, |w| w.area) {
            Ok(at) if self.windings[at].turns + turns == 0 => {
                self.windings.remove(at);
            }
            Ok(at) => self.windings[at].turns += turns,
            Err(at) => self.windings.insert(at, Winding { area, turns }),
        }
    }
}

impl<'l> EdgeIndex<'l> {
    /// Builds the grid over the part of the areas that lies in `bounds` (the terrain's rectangle).
    ///
    /// # Errors
    /// When there are more edges than can be numbered.
    pub fn new(list: &'l DrawList, bounds: &PlanBox) -> Result<Self> {
        let mut edges = expanded(list);
        if edges.len() > u32::MAX as usize / 2 {
            return Err(Error::unsupported("more edges than this program can number")
                .help("give the terrain a `window`"));
        }
        let layout = Layout::new(&edges, bounds);
        let mut index = Self {
            origin: layout.origin,
            cell: layout.cell,
            per_metre: 1.0 / layout.cell,
            columns: layout.columns,
            rows: layout.rows,
            members: CellLists::default(),
            covers: CellLists::default(),
            sums: Vec::new(),
            terrain: *bounds,
            list,
            area_count: area_count(list),
            edges: Vec::new(),
        };
        // What neither meets the grid nor lies west of it can change nothing in it.
        let (east, north) = (index.corner(index.columns, 0).x, index.corner(0, index.rows).y);
        edges.retain(|e| {
            math::min(e.a.x, e.b.x) <= east
                && math::max(e.a.y, e.b.y) >= index.origin.y
                && math::min(e.a.y, e.b.y) <= north
        });
        edges.shrink_to_fit();
        index.edges = edges;
        index.list_members();
        index.list_covers();
        index.find_outsides();
        Ok(index)
    }

    /// How many areas there are: one for each item, and one for each outline that is cut to a polygon without a fill.
    pub fn area_count(&self) -> usize {
        self.area_count
    }

    /// Which windings are inside an area.
    #[inline]
    pub fn rule_of(&self, area: AreaId) -> Rule {
        if area.is_stroke() { Rule::NonZero } else { self.list.style_of(area.item()).rule }
    }

    /// The style with whose paint an area is painted; `None`: it only cuts an outline.
    #[inline]
    pub fn painted_by(&self, area: AreaId) -> Option<u32> {
        let style = self.list.items()[area.item() as usize].style;
        let is_filled = matches!(self.list.styles()[style as usize].role, Role::Fill | Role::Outside);
        let is_painted = area.is_stroke() || is_filled;
        is_painted.then_some(style)
    }

    /// What the areas of a style are composed with first.
    #[inline]
    pub fn group_of(&self, style: u32) -> Option<Group> {
        self.list.styles()[style as usize].group
    }

    /// The polygon that an area is cut to, and whether the points in it (or those outside) count.
    #[inline]
    pub fn cut_of(&self, area: AreaId) -> Option<(AreaId, bool)> {
        let side = self.list.style_of(area.item()).cut.filter(|_| area.is_stroke())?;
        Some((AreaId::polygon_of(self.list.area_owner(area.item())), side == Side::Inside))
    }

    /// All edges, area by area.
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// An edge.
    #[inline(always)]
    pub fn edge(&self, index: u32) -> &Edge {
        &self.edges[index as usize]
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.edges[..])
            + self.members.bytes()
            + self.covers.bytes()
            + size_of_val(&self.sums[..])
    }

    /// How many edges are in the grid.
    pub fn edge_count(&self) -> usize {
        self.edges.len()
    }

    /// The south-west corner of cell (column, row).
    #[inline(always)]
    fn corner(&self, column: usize, row: usize) -> Plan {
        Plan::new(self.origin.x + column as f64 * self.cell, self.origin.y + row as f64 * self.cell)
    }

    /// The cell of a point; `None` outside the grid.
    #[inline]
    fn cell_of(&self, p: Plan) -> Option<(usize, usize)> {
        let (x, y) = ((p.x - self.origin.x) * self.per_metre, (p.y - self.origin.y) * self.per_metre);
        let inside = x >= 0.0 && y >= 0.0 && x < self.columns as f64 && y < self.rows as f64;
        inside.then_some((x as usize, y as usize))
    }

    /// The columns or rows between two offsets from the origin, with a margin that covers rounding.
    #[inline]
    fn cells_between(&self, low: f64, high: f64, count: usize) -> Range<usize> {
        const MARGIN: f64 = 1e-6;
        let (low, high) = (low * self.per_metre - MARGIN, high * self.per_metre + MARGIN);
        if high < 0.0 || low >= count as f64 {
            return 0..0;
        }
        let first = if low > 0.0 { low as usize } else { 0 };
        first..(high as usize + 1).min(count)
    }

    #[inline]
    fn members_of(&self, column: usize, row: usize) -> &[u32] {
        self.members.of(row * self.columns + column)
    }

    #[inline]
    fn covers_of(&self, column: usize, row: usize) -> &[Winding] {
        self.covers.of(row * self.columns + column)
    }

    /// Collects the edges whose boxes meet a quadrilateral's in the cells that it touches, each once, in order.
    pub fn edges_near(&self, quad: &Quadrilateral, found: &mut Vec<u32>) {
        found.clear();
        let bounds = quad.bounds();
        let (low, high) = (bounds.min - self.origin, bounds.max - self.origin);
        let columns = self.cells_between(low.x, high.x, self.columns);
        let rows = self.cells_between(low.y, high.y, self.rows);
        if columns.is_empty() || rows.is_empty() || self.members_in(&columns, &rows) == 0 {
            return;
        }
        if columns.len() * rows.len() <= 4 {
            for row in rows {
                columns
                    .clone()
                    .for_each(|column| self.take_near(self.members_of(column, row), &bounds, found));
            }
            found.sort_unstable();
            found.dedup();
            return;
        }
        for row in rows {
            let south = self.corner(0, row).y;
            let Some((west, east)) = quad.span(south, south + self.cell) else {
                continue;
            };
            for column in self.cells_between(west - self.origin.x, east - self.origin.x, self.columns) {
                self.take_near(self.members_of(column, row), &bounds, found);
            }
        }
        found.sort_unstable();
        found.dedup();
    }

    /// Collects the edges that may have a point in a rectangle, each once, in order; `false`: that would be to search too many cells.
    pub fn edges_in(&self, bounds: &PlanBox, found: &mut Vec<u32>) -> bool {
        found.clear();
        let (low, high) = (bounds.min - self.origin, bounds.max - self.origin);
        let columns = self.cells_between(low.x, high.x, self.columns);
        let rows = self.cells_between(low.y, high.y, self.rows);
        if columns.len() * rows.len() > MOST_SHARED_CELLS {
            return false;
        }
        for row in rows {
            for column in columns.clone() {
                self.take_near(self.members_of(column, row), bounds, found);
            }
        }
        found.retain(|&edge| !self.edge(edge).passes_by(bounds));
        found.sort_unstable();
        found.dedup();
        true
    }

    /// The cell around a point when neither an edge nor an area has a part in it.
    #[inline]
    pub fn empty_cell(&self, p: Plan) -> Option<PlanBox> {
        let (column, row) = self.cell_of(p)?;
        let is_empty = self.members_of(column, row).is_empty() && self.covers_of(column, row).is_empty();
        is_empty.then(|| PlanBox { min: self.corner(column, row), max: self.corner(column + 1, row + 1) })
    }

    /// Adds the edges whose boxes meet `bounds`.
    #[inline(always)]
    fn take_near(&self, members: &[u32], bounds: &PlanBox, found: &mut Vec<u32>) {
        let apart = |p: f64, q: f64, low: f64, high: f64| (p < low) & (q < low) | (p > high) & (q > high);
        found.extend(members.iter().copied().filter(|&member| {
            let Edge { a, b, .. } = self.edge(member);
            !(apart(a.x, b.x, bounds.min.x, bounds.max.x) | apart(a.y, b.y, bounds.min.y, bounds.max.y))
        }));
    }

    /// Whether any edge lies in the cells around a quadrilateral of these bounds.
    #[inline]
    pub fn has_edges_near(&self, bounds: &PlanBox) -> bool {
        let (low, high) = (bounds.min - self.origin, bounds.max - self.origin);
        let columns = self.cells_between(low.x, high.x, self.columns);
        let rows = self.cells_between(low.y, high.y, self.rows);
        !columns.is_empty() && !rows.is_empty() && self.members_in(&columns, &rows) > 0
    }

    /// How many members a block of cells has.
    #[inline]
    fn members_in(&self, columns: &Range<usize>, rows: &Range<usize>) -> u64 {
        let at = |c: usize, r: usize| self.sums[r * (self.columns + 1) + c];
        at(columns.end, rows.end) + at(columns.start, rows.start)
            - at(columns.end, rows.start)
            - at(columns.start, rows.end)
    }

    /// Collects the windings of all areas around a point that differ from 0, in the areas' order.
    pub fn windings_at(&self, p: Plan, found: &mut Vec<Winding>) {
        found.clear();
        let Some((column, row)) = self.cell_of(p) else {
            return;
        };
        found.extend_from_slice(self.covers_of(column, row));
        let corner = self.corner(column, row);
        let mut changed = false;
        for &member in self.members_of(column, row) {
            let edge = self.edge(member);
            let turns = turns_on_path(edge, corner, p);
            if turns != 0 {
                changed = true;
                match found.binary_search_by_key(&edge.area, |w| w.area) {
                    Ok(at) => found[at].turns += turns,
                    Err(at) => found.insert(at, Winding { area: edge.area, turns }),
                }
            }
        }
        if changed {
            found.retain(|w| w.turns != 0);
        }
    }

    /// Moves to a point.
    #[inline]
    pub fn move_to(&self, p: Plan, around: &mut Around) {
        if around.at != p {
            self.windings_at(p, &mut around.windings);
            around.at = p;
        }
    }

    /// Moves straight on to a point; `edges` has all edges that meet the way.
    #[inline]
    pub fn move_straight(&self, to: Plan, edges: &[u32], around: &mut Around) {
        let from = around.at;
        // Beyond the grid nothing is known.
        if self.cell_of(from).is_none() || self.cell_of(to).is_none() {
            return;
        }
        around.at = to;
        for edge in edges.iter().map(|&edge| self.edge(edge)) {
            let turns = turns_straight(edge, from, to);
            if turns != 0 {
                around.add(edge.area, turns);
            }
        }
    }

    /// How often one area winds around a point.
    pub fn winding_of(&self, area: AreaId, p: Plan) -> i32 {
        let Some((column, row)) = self.cell_of(p) else {
            return 0;
        };
        let covers = self.covers_of(column, row);
        let start = covers.binary_search_by_key(&area, |w| w.area).map_or(0, |at| covers[at].turns);
        let corner = self.corner(column, row);
        let members = self.members_of(column, row);
        let first = members.partition_point(|&m| self.edge(m).area < area);
        let own = members[first..].iter().map(|&m| self.edge(m)).take_while(|e| e.area == area);
        start + own.map(|e| turns_on_path(e, corner, p)).sum::<i32>()
    }

    /// Calls `visit` with each cell that an edge meets.
    fn for_each_cell(&self, edge: &Edge, mut visit: impl FnMut(usize)) {
        let (a, b) = if edge.a.y <= edge.b.y { (edge.a, edge.b) } else { (edge.b, edge.a) };
        for row in self.cells_between(a.y - self.origin.y, b.y - self.origin.y, self.rows) {
            // The part of the edge in a band slightly wider than the row.
            let south = self.corner(0, row).y - self.cell * 1e-6;
            let north = south + self.cell * (1.0 + 2e-6);
            let x_at = |y: f64| {
                if y <= a.y {
                    a.x
                } else if y >= b.y {
                    b.x
                } else {
                    a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y))
                }
            };
            let (p, q) = (x_at(south), x_at(north));
            let (west, east) = if p < q { (p, q) } else { (q, p) };
            for column in self.cells_between(west - self.origin.x, east - self.origin.x, self.columns) {
                visit(row * self.columns + column);
            }
        }
    }

    fn list_members(&mut self) {
        let members = CellLists::new(self.columns * self.rows, |members| {
            for (index, edge) in self.edges.iter().enumerate() {
                self.for_each_cell(edge, |cell| members.put(cell, index as u32));
            }
        });
        let stride = self.columns + 1;
        let mut sums = vec![0u64; stride * (self.rows + 1)];
        for row in 0..self.rows {
            for column in 0..self.columns {
                sums[(row + 1) * stride + column + 1] = members.of(row * self.columns + column).len() as u64
                    + sums[(row + 1) * stride + column]
                    + sums[row * stride + column + 1]
                    - sums[row * stride + column];
            }
        }
        (self.members, self.sums) = (members, sums);
    }

    /// Finds the windings at the cells' corners, row by row: what an area winds around changes where one of its edges
    /// crosses the row's line.
    fn list_covers(&mut self) {
        let crossings = CellLists::new(self.rows, |crossings| {
            for (index, edge) in self.edges.iter().enumerate() {
                self.rows_crossed(edge).for_each(|row| crossings.put(row, index as u32));
            }
        });
        let rows = parallel::map_indices(self.rows, |row| self.covers_in_row(row, crossings.of(row)));
        rows.iter().for_each(|row| self.covers.append(row));
    }

    /// The rows whose southern line an edge crosses (half-open: a line through an end counts as just below it).
    fn rows_crossed(&self, edge: &Edge) -> impl Iterator<Item = usize> {
        let (low, high) = if edge.a.y < edge.b.y { (edge.a.y, edge.b.y) } else { (edge.b.y, edge.a.y) };
        let candidates = self.cells_between(low - self.origin.y, high - self.origin.y, self.rows);
        let (origin, cell) = (self.origin.y, self.cell);
        candidates.filter(move |row| {
            let y = origin + *row as f64 * cell;
            low <= y && high > y
        })
    }

    /// The covering areas of each cell of a row, given the edges that cross the row's line.
    fn covers_in_row(&self, row: usize, crossings: &[u32]) -> CellLists<Winding> {
        let mut changes: Vec<(AreaId, usize, i32)> = crossings
            .iter()
            .map(|&index| {
                let edge = self.edge(index);
                // Eastwards across an upward edge one leaves its left side.
                (edge.area, self.first_column_beyond(edge, row), if edge.b.y > edge.a.y { -1 } else { 1 })
            })
            .collect();
        changes.sort_unstable();
        let mut runs: Vec<(Range<usize>, Winding)> = Vec::new();
        let (mut area, mut turns, mut from) = (AreaId::LAST, 0, 0);
        for (next_area, column, change) in changes.into_iter().chain([(AreaId::LAST, self.columns, 0)]) {
            let until = if next_area == area { column } else { self.columns };
            if turns != 0 && from < until {
                runs.push((from..until, Winding { area, turns }));
            }
            turns = change + if next_area == area { turns } else { 0 };
            (area, from) = (next_area, column);
        }
        // Runs come in the order of areas.
        CellLists::new(self.columns, |covers| {
            for (columns, winding) in &runs {
                columns.clone().for_each(|column| covers.put(column, *winding));
            }
        })
    }

    /// The first column whose corner on a row's line lies east of where an edge crosses the line.
    fn first_column_beyond(&self, edge: &Edge, row: usize) -> usize {
        let y = self.corner(0, row).y;
        let x = edge.a.x + (edge.b.x - edge.a.x) * ((y - edge.a.y) / (edge.b.y - edge.a.y));
        let guess = (x - self.origin.x) / self.cell;
        let mut column = if guess > 0.0 { (guess as usize).min(self.columns) } else { 0 };
        let upward = edge.b.y > edge.a.y;
        let is_beyond = |column: usize| is_left(edge, self.corner(column, row)) != upward;
        while column > 0 && is_beyond(column - 1) {
            column -= 1;
        }
        while column < self.columns && !is_beyond(column) {
            column += 1;
        }
        column
    }

    /// The middle of the part of an edge that lies over the terrain.
    fn middle_over_terrain(&self, edge: &Edge) -> Option<Plan> {
        let PlanBox { min: low, max: high } = self.terrain;
        let along = edge.b - edge.a;
        let (mut from, mut to) = (0.0, 1.0);
        for (start, step, low, high) in
            [(edge.a.x, along.x, low.x, high.x), (edge.a.y, along.y, low.y, high.y)]
        {
            if step == 0.0 {
                if start < low || start > high {
                    return None;
                }
                continue;
            }
            let (p, q) = ((low - start) / step, (high - start) / step);
            from = math::max(if p < q { p } else { q }, from);
            to = math::min(if p < q { q } else { p }, to);
        }
        (from <= to).then(|| edge.a + along * ((from + to) / 2.0))
    }

    /// Finds on which side of each ring's edges the outside is; where the ring crosses itself that changes along an edge, and it is the side at
    /// its middle over the terrain.
    fn find_outsides(&mut self) {
        let outside: Vec<bool> = parallel::map_indices(self.edges.len(), |k| {
            let edge = &self.edges[k];
            // The outside of a stroke is on the right; an edge beside the terrain meets no pixel.
            !edge.area.is_stroke()
                && self.middle_over_terrain(edge).is_some_and(|middle| {
                    let turns = self.winding_of(edge.area, middle);
                    self.rule_of(edge.area).contains(turns) != is_left(edge, middle)
                })
        });
        for (edge, is_left) in self.edges.iter_mut().zip(outside) {
            edge.outside_is_left = is_left;
        }
    }
}

/// How many areas a list has.
fn area_count(list: &DrawList) -> usize {
    let is_cut_alone = |item: &u32| list.style_of(*item).cut.is_some() && list.area_owner(*item) == *item;
    let items = list.items().len() as u32;
    items as usize + (0..items).filter(is_cut_alone).count()
}

/// Whether a point lies left of an edge. A point on it is moved a little east and a little less north, the same for all
/// edges, so that areas that share an edge share no point and leave none out.
#[inline]
fn is_left(edge: &Edge, p: Plan) -> bool {
    let side = orient2d(edge.a, edge.b, p);
    if side != 0.0 {
        return side > 0.0;
    }
    let along = edge.b - edge.a;
    if along.y != 0.0 { along.y < 0.0 } else { along.x > 0.0 }
}

/// How an area's winding changes along the path from a cell's corner north to the height of `p` and east to `p`.
#[inline]
fn turns_on_path(edge: &Edge, corner: Plan, p: Plan) -> i32 {
    let bend = Plan::new(corner.x, p.y);
    let mut turns = 0;
    if (edge.a.x > corner.x) != (edge.b.x > corner.x) {
        turns += turns_between(edge, corner, bend);
    }
    if (edge.a.y > p.y) != (edge.b.y > p.y) {
        turns += turns_between(edge, bend, p);
    }
    turns
}

#[inline]
fn turns_between(edge: &Edge, from: Plan, to: Plan) -> i32 {
    i32::from(is_left(edge, to)) - i32::from(is_left(edge, from))
}

/// How an area's winding changes along the straight way between two points, both moved as in [`is_left`].
#[inline]
fn turns_straight(edge: &Edge, from: Plan, to: Plan) -> i32 {
    let turns = turns_between(edge, from, to);
    if turns == 0 {
        return 0;
    }
    // The way moves east and less north: what lies on it comes to lie on its left when it leads north, or west.
    let way = to - from;
    let moves_off = if way.y != 0.0 { way.y > 0.0 } else { way.x < 0.0 };
    let is_left_of_way = |end: Plan| {
        let side = orient2d(from, to, end);
        if side != 0.0 { side > 0.0 } else { moves_off }
    };
    if is_left_of_way(edge.a) == is_left_of_way(edge.b) { 0 } else { turns }
}

/// Where the grid lies and how fine it is.
struct Layout {
    origin: Plan,
    cell: f64,
    columns: usize,
    rows: usize,
}

impl Layout {
    /// About one edge in two cells, but cells no smaller than a third of the mean edge.
    fn new(edges: &[Edge], bounds: &PlanBox) -> Self {
        let mut all = PlanBox::EMPTY;
        let mut length = 0.0;
        for edge in edges {
            all.include(edge.a);
            all.include(edge.b);
            let extent = (edge.b - edge.a).abs();
            length += extent.x + extent.y;
        }
        let min = Plan::new(math::max(all.min.x, bounds.min.x), math::max(all.min.y, bounds.min.y));
        let max = Plan::new(math::min(all.max.x, bounds.max.x), math::min(all.max.y, bounds.max.y));
        let size = max - min;
        if !(size.x >= 0.0 && size.y >= 0.0) {
            return Self { origin: min, cell: 1.0, columns: 0, rows: 0 };
        }
        let count = edges.len() as f64;
        let cells = math::min(2.0 * count, MAX_CELLS);
        let longest = math::max(size.x, size.y);
        let cell = math::max((size.x * size.y / cells).sqrt(), length / (3.0 * count));
        // No more than MAX_CELLS even for a needle, no cell of size zero even for a point.
        let cell = math::max(math::max(cell, longest / cells), math::max(f64::MIN_POSITIVE, longest * 1e-12));
        let cell = if cell > 1e-9 { cell } else { 1e-9 };
        let along = |extent: f64| (extent / cell) as usize + 1;
        Self { origin: min, cell, columns: along(size.x), rows: along(size.y) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Color, Feature, Fill, Layer, Shape, Style};
    use proptest::prelude::*;

    fn list_of(rings: &[Vec<Plan>]) -> DrawList {
        let fill = Fill { color: Color([1.0; 4]), rule: Rule::EvenOdd };
        let feature = |(index, ring): (usize, &Vec<Plan>)| {
            let shape = Shape::Polygon(vec![ring.clone()]);
            Feature { index, style: 0, shape }
        };
        let features = rings.iter().enumerate().map(feature).collect();
        let style = Style { fill: Some(fill), ..Style::default() };
        DrawList::new(&mut [Layer::uniform("rings", style, features)], &PlanBox::EMPTY).unwrap()
    }

    /// The winding number by the crossings of a ray to the west, half-open.
    fn winding(ring: &[Plan], p: Plan) -> i32 {
        (0..ring.len())
            .map(|k| (ring[k], ring[(k + 1) % ring.len()]))
            .filter(|(a, b)| (a.y > p.y) != (b.y > p.y))
            .map(|(a, b)| {
                let east_of_edge =
                    if b.y > a.y { orient2d(a, b, p) <= 0.0 } else { orient2d(a, b, p) >= 0.0 };
                if !east_of_edge {
                    0
                } else if b.y > a.y {
                    -1
                } else {
                    1
                }
            })
            .sum()
    }

    fn coordinate() -> impl Strategy<Value = f64> {
        prop_oneof![(-8..9i32).prop_map(|k| f64::from(k) / 2.0), -4.0..4.0f64]
    }

    /// The crossing is at a height of 477 m; over the terrain the edge has its middle at 468.5 m.
    #[test]
    fn where_a_ring_crosses_itself_an_edge_has_its_outside_where_it_is_at_its_middle_over_the_terrain() {
        let ring = [(-652.0, 799.0), (-1174.0, 260.0), (-921.0, 1682.0), (-983.0, -63.0)];
        let list = list_of(&[ring.map(|(x, y)| Plan::new(x, y)).to_vec()]);
        let outside_is_left = |top: f64| {
            let terrain = PlanBox { min: Plan::new(-1000.0, -1000.0), max: Plan::new(1000.0, top) };
            let index = EdgeIndex::new(&list, &terrain).unwrap();
            index.edges.iter().find(|edge| edge.a.x == -921.0).unwrap().outside_is_left
        };
        assert_eq!([1000.0, 1100.0].map(outside_is_left), [false, true]);
    }

    proptest! {
        #[test]
        fn windings_are_those_of_the_whole_ring_even_at_its_vertices_and_on_its_edges(
            rings in prop::collection::vec(
                prop::collection::vec((coordinate(), coordinate()).prop_map(|(x, y)| Plan::new(x, y)), 1..9), 1..5),
            points in prop::collection::vec((coordinate(), coordinate()).prop_map(|(x, y)| Plan::new(x, y)), 40),
        ) {
            let list = list_of(&rings);
            let bounds = PlanBox { min: Plan::new(-3.0, -3.0), max: Plan::new(3.0, 3.0) };
            let index = EdgeIndex::new(&list, &bounds).unwrap();
            let mut found = Vec::new();
            for p in points.iter().chain(rings.iter().flatten()) {
                if index.cell_of(*p).is_none() {
                    continue;
                }
                index.windings_at(*p, &mut found);
                for (item, ring) in (0..).zip(&rings) {
                    let (area, expected) = (AreaId::polygon_of(item), winding(ring, *p));
                    let turns = found.iter().find(|w| w.area == area).map_or(0, |w| w.turns);
                    prop_assert_eq!(turns, expected, "area {:?} at {:?}", area, p);
                    prop_assert_eq!(index.winding_of(area, *p), expected);
                }
            }
        }

        #[test]
        fn windings_are_the_same_whichever_way_a_point_was_come_to(
            rings in prop::collection::vec(
                prop::collection::vec((coordinate(), coordinate()).prop_map(|(x, y)| Plan::new(x, y)), 1..9), 1..5),
            points in prop::collection::vec((coordinate(), coordinate()).prop_map(|(x, y)| Plan::new(x, y)), 40),
        ) {
            let list = list_of(&rings);
            let bounds = PlanBox { min: Plan::new(-3.0, -3.0), max: Plan::new(3.0, 3.0) };
            let index = EdgeIndex::new(&list, &bounds).unwrap();
            let all: Vec<u32> = (0..index.edge_count() as u32).collect();
            let (mut around, mut expected) = (Around::nowhere(), Vec::new());
            for p in points.iter().chain(rings.iter().flatten()) {
                index.move_straight(*p, &all, &mut around);
                index.move_to(*p, &mut around);
                index.windings_at(*p, &mut expected);
                prop_assert_eq!(around.windings(), &expected[..], "at {:?}", p);
            }
        }

        #[test]
        fn the_edges_in_a_rectangle_are_all_that_have_a_point_in_it(
            rings in prop::collection::vec(
                prop::collection::vec((coordinate(), coordinate()).prop_map(|(x, y)| Plan::new(x, y)), 1..9), 1..5),
            corners in prop::collection::vec((coordinate(), coordinate()).prop_map(|(x, y)| Plan::new(x, y)), 2),
        ) {
            let list = list_of(&rings);
            let bounds = PlanBox { min: Plan::new(-9.0, -9.0), max: Plan::new(9.0, 9.0) };
            let index = EdgeIndex::new(&list, &bounds).unwrap();
            let rectangle = PlanBox::around(corners);
            let (low, high) = (rectangle.min, rectangle.max);
            let sides = [low, Plan::new(high.x, low.y), high, Plan::new(low.x, high.y)];
            let (mut found, quad) = (Vec::new(), Quadrilateral(sides));
            if index.edges_in(&rectangle, &mut found) {
                let edges = (0..index.edge_count() as u32).filter(|&k| quad.meets(&rectangle, index.edge(k).a, index.edge(k).b));
                let missed: Vec<u32> = edges.filter(|edge| found.binary_search(edge).is_err()).collect();
                prop_assert!(missed.is_empty(), "{:?} are not among {:?}", missed, found);
            }
        }
    }
}
