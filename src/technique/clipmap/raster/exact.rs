//! Exact areas: how much of each texel of a tile an item covers.
//!
//! Edges leave signed areas in an accumulator of whole numbers, summed along each row: one pass over the edges, whatever
//! their order, with the same bits in any tile. The sum is the area where winding numbers are 0 and 1. Where an item may overlap
//! itself (several pieces of a stroke, several edges of a polygon that is not simple meet a texel) its winding numbers are told apart
//! exactly instead ([`super::winding`]). Of a row only the blocks of texels are looked at that an edge meets; between them nothing
//! changes.

use super::fixed::{BITS, Edge, FARTHEST, Fixed, ONE, without_far};
use super::lanes::{LANES, Line, texel_of};
use super::rows::{ByRows, FOUR, FOUR_BITS, Runs};
use super::sweep::Sweep;
use super::weight::Weight;
use super::winding::{Fragment, Texel as Winding, Windings};
use crate::space::Texel;
use std::ops::Range;

/// What the rings of an item are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Rings {
    /// Simple pieces that turn counter-clockwise, each a ring; they may overlap.
    Pieces,
    /// A polygon whose winding numbers are 0 and 1.
    Simple,
    /// A polygon of any kind.
    Any,
}

/// Columns that a piece has a part in: `first..=last`, -1 for all that is west of the tile, its width for all east.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Span {
    first: i32,
    last: i32,
}

impl Span {
    const EMPTY: Self = Self { first: i32::MAX, last: i32::MIN };

    #[inline(always)]
    fn include(&mut self, first: i32, last: i32) {
        self.first = if first < self.first { first } else { self.first };
        self.last = if last > self.last { last } else { self.last };
    }
}

/// A ring's edges.
#[derive(Debug, Clone, Copy)]
struct RingEdges {
    edges: (u32, u32),
    rows: (u32, u32),
}

/// What a piece has a part in, in one row.
#[derive(Debug, Clone, Copy)]
struct Interval {
    span: Span,
    /// The next one of the row.
    next: u32,
}

/// An item with more edges than this in a tile has them sorted by rows and columns where winding numbers are to be told apart.
const MANY: usize = 64;

/// Of more pieces in a row, pairs are not compared: pieces are counted instead.
const FEW_PIECES: usize = 12;

/// The end of a row's intervals.
const NONE: u32 = u32::MAX;

/// A tile's accumulator. Sums of areas hold winding numbers below 2^15 in magnitude; beyond, a polygon that is not simple may be taken
/// for its outside.
#[derive(Debug)]
pub(super) struct Accumulator {
    width: i32,
    height: usize,
    origin: (i64, i64),
    rings: Rings,
    /// Cells of a row: its texels, to whole blocks, and two that edges in the last one leave something to.
    stride: usize,
    /// A block has 2^shift texels, a row at most 64 blocks.
    shift: u32,
    /// Differences of covered areas along rows, in units of 2^-16 texel.
    areas: Vec<i32>,
    /// The blocks of each row that an edge has met; those beyond the tile mean nothing.
    touched: Vec<u64>,
    /// The blocks of the tile.
    blocks: u64,
    /// How many edges of a polygon of any kind meet each texel.
    crowd: Vec<u16>,
    /// Rows that the item may have a part in.
    rows: (usize, usize),
    /// The parts of the piece at hand, a row each.
    spans: Vec<Span>,
    /// The parts of all pieces: where each row's list begins.
    intervals_of_rows: Vec<u32>,
    intervals: Vec<Interval>,
    /// Columns of the row at hand in which pieces may overlap.
    overlaps: Vec<(i32, i32)>,
    edges: Vec<[Fixed; 2]>,
    pieces: Vec<RingEdges>,
    /// The pieces of each row (the edges, of an item that has many), once they are asked for.
    of_rows: Vec<Vec<u32>>,
    are_rows_sorted: bool,
    /// The rows of an item with many edges.
    sweeps: Vec<Sweep>,
    /// Whether the edges of a simple polygon are asked for.
    keeps_edges: bool,
    room: Vec<Texel>,
    texel: Winding,
    arch: pulp::Arch,
}

impl Accumulator {
    /// An accumulator of a tile whose first texel is `origin`; with `keeps_edges`, [`Accumulator::gather`] has those of simple polygons
    /// too.
    pub(super) fn new(origin: (i64, i64), (width, height): (usize, usize), keeps_edges: bool) -> Self {
        let mut shift = FOUR_BITS;
        while width > 64 << shift {
            shift += 1;
        }
        let stride = width.next_multiple_of(1 << shift) + 2;
        Self {
            width: width as i32,
            height,
            origin,
            rings: Rings::Simple,
            stride,
            shift,
            areas: vec![0; stride * height],
            touched: vec![0; height],
            blocks: u64::MAX >> (64 - width.div_ceil(1 << shift)),
            crowd: Vec::new(),
            rows: (height, 0),
            spans: vec![Span::EMPTY; height],
            intervals_of_rows: vec![NONE; height],
            intervals: Vec::new(),
            overlaps: Vec::new(),
            edges: Vec::new(),
            pieces: Vec::new(),
            of_rows: vec![Vec::new(); height],
            are_rows_sorted: false,
            sweeps: Vec::new(),
            keeps_edges,
            room: Vec::new(),
            texel: Winding::default(),
            arch: pulp::Arch::new(),
        }
    }

    /// Moves to another tile of the same size.
    pub(super) fn move_to(&mut self, origin: (i64, i64)) {
        self.start(self.rings);
        self.origin = origin;
    }

    /// Starts an item; what is left of the one before is forgotten.
    pub(super) fn start(&mut self, rings: Rings) {
        for row in self.rows.0..self.rows.1 {
            self.forget_row(row);
        }
        self.rings = rings;
        self.rows = (self.height, 0);
        self.intervals.clear();
        self.edges.clear();
        self.pieces.clear();
        self.are_rows_sorted = false;
        if rings == Rings::Any && self.crowd.is_empty() {
            self.crowd = vec![0; self.areas.len()];
        }
    }

    /// Empties a row that has not been taken.
    fn forget_row(&mut self, row: usize) {
        self.intervals_of_rows[row] = NONE;
        if std::mem::take(&mut self.touched[row]) != 0 {
            let cells = row * self.stride..(row + 1) * self.stride;
            self.areas[cells.clone()].fill(0);
            if self.rings == Rings::Any {
                self.crowd[cells].fill(0);
            }
        }
    }

    /// Whether nothing is left of an item whose rows have all been taken.
    #[cfg(test)]
    pub(super) fn is_empty(&self) -> bool {
        let width = self.width as usize;
        self.areas.chunks(self.stride).all(|row| row[..width].iter().all(|area| *area == 0))
            && self.crowd.chunks(self.stride).all(|row| row[..width].iter().all(|edges| *edges == 0))
            && self.touched.iter().all(|blocks| *blocks == 0)
            && self.spans.iter().all(|span| *span == Span::EMPTY)
            && self.intervals_of_rows.iter().all(|first| *first == NONE)
    }

    /// Adds a ring.
    pub(super) fn ring(&mut self, ring: &[Texel]) {
        let arch = self.arch;
        let mut room = std::mem::take(&mut self.room);
        let ring = without_far(ring, FARTHEST, &mut room);
        if self.may_touch(ring) {
            arch.dispatch(AddRing { to: self, ring });
        }
        self.room = room;
    }

    /// Whether a ring's box meets the tile: a closed ring changes nothing outside it.
    fn may_touch(&self, ring: &[Texel]) -> bool {
        let size = (f64::from(self.width), self.height as f64);
        let (west, north) = (self.origin.0 as f64 - 1.0, self.origin.1 as f64 - 1.0);
        let (east, south) = (west + size.0 + 2.0, north + size.1 + 2.0);
        let (mut is_west, mut is_east, mut is_north, mut is_south) = (true, true, true, true);
        for p in ring {
            is_west &= p.x < west;
            is_east &= p.x > east;
            is_north &= p.y < north;
            is_south &= p.y > south;
        }
        !(is_west | is_east | is_north | is_south)
    }

    /// A piece is complete: lists where it has a part.
    #[inline(always)]
    fn end_ring(&mut self, start: usize, rows: (usize, usize)) {
        for row in rows.0..rows.1 {
            let span = std::mem::replace(&mut self.spans[row], Span::EMPTY);
            // A ring that is closed beside the tile leaves nothing in it.
            if self.rings == Rings::Pieces && span.last >= 0 && span.first < self.width {
                let next = std::mem::replace(&mut self.intervals_of_rows[row], self.intervals.len() as u32);
                self.intervals.push(Interval { span, next });
            }
        }
        let edges = (start as u32, self.edges.len() as u32);
        if edges.0 < edges.1 {
            self.pieces.push(RingEdges { edges, rows: (rows.0 as u32, rows.1 as u32) });
        }
        self.rows = (self.rows.0.min(rows.0), self.rows.1.max(rows.1));
    }

    #[inline(always)]
    fn edge(&mut self, from: Fixed, to: Fixed, rows: &mut (usize, usize)) {
        // Most edges of a large item pass the tile by.
        let (top, bottom) = if from.y < to.y { (from.y, to.y) } else { (to.y, from.y) };
        let passed = texel_of(top).max(0)..(texel_of(bottom - 1) + 1).min(self.height as i64);
        if top == bottom {
            return self.level_edge(from, to, rows);
        }
        if passed.is_empty() {
            return;
        }
        rows.0 = rows.0.min(passed.start as usize);
        rows.1 = rows.1.max(passed.end as usize);
        if self.rings != Rings::Simple || self.keeps_edges {
            self.edges.push([from, to]);
        }
        let (west, east) = if from.x < to.x { (from.x, to.x) } else { (to.x, from.x) };
        let limit = i64::from(self.width) << BITS;
        if west >= limit || east < 0 {
            let column = if east < 0 { -1 } else { self.width };
            return self.edge_beside((top, bottom), column, if from.y < to.y { 1 } else { -1 });
        }
        let Some(edge) = Edge::new(from, to) else { return };
        if self.rings == Rings::Any {
            self.count_edge(&edge, passed.clone());
        }
        let is_within = west >= 0 && east < limit && top >= 0 && bottom <= (self.height as i64) << BITS;
        match (edge.is_steep(), is_within) {
            (true, true) => self.steep_edge(&edge, passed),
            (true, false) => self.steep_edge_across_border(&edge, passed),
            (false, true) => self.shallow_edge(&edge, texel_of(west)..texel_of(east) + 1),
            (false, false) => self.shallow_edge_across_border(&edge, (west, east)),
        }
    }

    #[inline(always)]
    fn steep_edge(&mut self, edge: &Edge, rows: Range<i64>) {
        let line = Line::new(edge);
        for first in rows.clone().step_by(LANES) {
            let parts = line.steep_parts(first);
            let count = ((rows.end - first) as usize).min(LANES);
            let first = first as usize;
            let cells = self.areas[first * self.stride..].chunks_exact_mut(self.stride);
            let marks = self.touched[first..].iter_mut().zip(&mut self.spans[first..]);
            for ((k, (touched, span)), cells) in (0..count).zip(marks).zip(cells) {
                span.include(parts.column[k], parts.last[k]);
                let column = parts.column[k] as usize;
                *touched |= blocks_of_three(column, self.shift);
                if let Some([a, b, c]) = cells.get_mut(column..column + 3) {
                    change(a, parts.adds[0][k]);
                    change(b, parts.adds[1][k]);
                    change(c, parts.adds[2][k]);
                }
            }
        }
    }

    fn steep_edge_across_border(&mut self, edge: &Edge, rows: Range<i64>) {
        let line = Line::new(edge);
        for first in rows.clone().step_by(LANES) {
            let parts = line.steep_parts(first);
            for k in 0..((rows.end - first) as usize).min(LANES) {
                let row = first as usize + k;
                // Numbers of far columns would not fit: only on which side they are counts.
                let part = edge.in_row(row as i64);
                let (west, east) = (part.top.x.min(part.bottom.x), part.top.x.max(part.bottom.x));
                let is_cut = east > (texel_of(west) + 1) << BITS;
                let (column, last) = (self.column(west), self.column(west + if is_cut { ONE } else { 0 }));
                self.spans[row].include(column, last);
                let cells = &mut self.areas[row * self.stride..(row + 1) * self.stride];
                let adds = parts.adds.map(|adds| adds[k]);
                if column >= self.width {
                    continue;
                }
                self.touched[row] |= blocks_of_three(column.max(0) as usize, self.shift);
                if last < 0 {
                    change(&mut cells[0], adds[0].wrapping_add(adds[1]).wrapping_add(adds[2]));
                } else if column < 0 {
                    // The western texel lies beside the tile, its neighbour in it.
                    change(&mut cells[0], adds[0].wrapping_add(adds[1]));
                    change(&mut cells[1], adds[2]);
                } else {
                    for (cell, add) in cells[column as usize..].iter_mut().zip(adds) {
                        change(cell, add);
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn shallow_edge(&mut self, edge: &Edge, columns: Range<i64>) {
        let line = Line::new(edge);
        for first in columns.clone().step_by(LANES) {
            let parts = line.shallow_parts(first);
            for k in 0..((columns.end - first) as usize).min(LANES) {
                for half in 0..2 {
                    let (row, column) = (parts.row[k] as usize + half, first as usize + k);
                    self.add_shallow(row, column, parts.heights[half][k], parts.adds[half][k], edge.sign);
                }
            }
        }
    }

    /// One of the two parts of a shallow edge in a column.
    #[inline(always)]
    fn add_shallow(&mut self, row: usize, column: usize, height: i32, here: i32, sign: i32) {
        if height > 0 {
            self.spans[row].include(column as i32, column as i32);
            self.touched[row] |= blocks_of_three(column, self.shift);
            let at = row * self.stride + column;
            if let Some([cell, next]) = self.areas.get_mut(at..at + 2) {
                change(cell, here);
                change(next, sign * height - here);
            }
        }
    }

    fn shallow_edge_across_border(&mut self, edge: &Edge, (west, east): (i64, i64)) {
        let line = Line::new(edge);
        let (width, limit) = (i64::from(self.width), i64::from(self.width) << BITS);
        if west < 0 {
            let heights = if east <= 0 { (edge.top.y, edge.bottom.y) } else { line.heights_beside(0, true) };
            self.edge_beside(heights, -1, edge.sign);
        }
        if east > limit {
            let heights =
                if west >= limit { (edge.top.y, edge.bottom.y) } else { line.heights_beside(limit, false) };
            self.edge_beside(heights, self.width, edge.sign);
        }
        let columns = texel_of(west).max(0)..(texel_of(east) + 1).min(width);
        for first in columns.clone().step_by(LANES) {
            let parts = line.shallow_parts(first);
            for k in 0..((columns.end - first) as usize).min(LANES) {
                for half in 0..2 {
                    let row = i64::from(parts.row[k]) + half as i64;
                    if (0..self.height as i64).contains(&row) {
                        let (height, here) = (parts.heights[half][k], parts.adds[half][k]);
                        self.add_shallow(row as usize, first as usize + k, height, here, edge.sign);
                    }
                }
            }
        }
    }

    /// A part of an edge that lies beside the tile, between two heights.
    fn edge_beside(&mut self, (north, south): (i64, i64), column: i32, sign: i32) {
        let rows = texel_of(north).max(0)..(texel_of(south - 1) + 1).min(self.height as i64);
        for row in rows {
            let height = south.min((row + 1) << BITS) - north.max(row << BITS);
            if height > 0 {
                self.spans[row as usize].include(column, column);
                if column < 0 {
                    self.touched[row as usize] |= 1;
                    change(&mut self.areas[row as usize * self.stride], sign * height as i32);
                }
            }
        }
    }

    /// Counts an edge in the texels that it may touch.
    fn count_edge(&mut self, edge: &Edge, rows: Range<i64>) {
        for row in rows {
            let part = edge.in_row(row);
            self.count_columns(row as usize, part.top.x.min(part.bottom.x), part.top.x.max(part.bottom.x));
        }
    }

    fn count_columns(&mut self, row: usize, west: i64, east: i64) {
        for column in self.column(west).max(0)..=self.column(east).min(self.width - 1) {
            let edges = &mut self.crowd[row * self.stride + column as usize];
            *edges = edges.saturating_add(1);
            self.touched[row] |= 1 << (column as u32 >> self.shift);
        }
    }

    /// A level edge has no area; it matters where edges in a texel are counted.
    fn level_edge(&mut self, from: Fixed, to: Fixed, rows: &mut (usize, usize)) {
        let row = texel_of(from.y);
        if self.rings == Rings::Any && row >= 0 && row < self.height as i64 {
            self.count_columns(row as usize, from.x.min(to.x), from.x.max(to.x));
            *rows = (rows.0.min(row as usize), rows.1.max(row as usize + 1));
        }
    }

    /// The column of an x, -1 for all west of the tile, its width for all east.
    fn column(&self, x: i64) -> i32 {
        texel_of(x).clamp(-1, i64::from(self.width)) as i32
    }

    /// The coverage of a texel in which winding numbers need not be told apart.
    #[inline(always)]
    fn plain(&self, area: i32, weight: Weight) -> f32 {
        match self.rings {
            Rings::Simple | Rings::Pieces => covered(area),
            Rings::Any => shared(area, weight),
        }
    }

    /// Finds where pieces may overlap in a row; the row's intervals are used up. Returns the blocks there.
    #[inline(always)]
    fn take_overlaps(&mut self, row: usize) -> u64 {
        let mut at = std::mem::replace(&mut self.intervals_of_rows[row], NONE);
        let (first, mut blocks, mut pieces) = (at, 0, 0);
        while at != NONE {
            pieces += 1;
            if pieces > FEW_PIECES {
                return self.count_overlaps(first);
            }
            let Interval { span, next } = self.intervals[at as usize];
            let mut other = next;
            while other != NONE {
                let against = self.intervals[other as usize];
                let first = span.first.max(against.span.first).max(0);
                let last = span.last.min(against.span.last).min(self.width - 1);
                if first <= last {
                    self.overlaps.push((first, last));
                    (first >> self.shift..=last >> self.shift).for_each(|block| blocks |= 1 << block);
                }
                other = against.next;
            }
            at = next;
        }
        blocks
    }

    /// The same for many pieces: counts them in each column.
    #[cold]
    #[inline(never)]
    fn count_overlaps(&mut self, first: u32) -> u64 {
        let mut changes = vec![0i32; self.width as usize + 1];
        let mut at = first;
        while at != NONE {
            let Interval { span, next } = self.intervals[at as usize];
            let (west, east) = (span.first.max(0), span.last.min(self.width - 1));
            if west <= east {
                changes[west as usize] += 1;
                changes[east as usize + 1] -= 1;
            }
            at = next;
        }
        self.overlaps.clear();
        let (mut blocks, mut pieces) = (0, 0);
        for (column, change) in (0..self.width).zip(changes) {
            pieces += change;
            if pieces >= 2 {
                match self.overlaps.last_mut() {
                    Some((_, last)) if *last + 1 == column => *last = column,
                    _ => self.overlaps.push((column, column)),
                }
                blocks |= 1 << (column >> self.shift);
            }
        }
        blocks
    }

    /// Corrects the coverage of those of four texels in which winding numbers must be told apart.
    #[inline(never)]
    fn tell_apart(&mut self, row: usize, first: usize, weight: Weight, coverage: &mut [f32; FOUR]) {
        for (k, coverage) in coverage.iter_mut().enumerate() {
            let column = first + k;
            let is_crowded = match self.rings {
                Rings::Any => std::mem::take(&mut self.crowd[row * self.stride + column]) >= 2,
                _ => self.overlaps.iter().any(|(low, high)| (*low..=*high).contains(&(column as i32))),
            };
            if is_crowded {
                *coverage = self.crowded(row, column, weight);
            }
        }
    }

    /// The coverage of a texel in which winding numbers must be told apart.
    #[cold]
    #[inline(never)]
    fn crowded(&mut self, row: usize, column: usize, weight: Weight) -> f32 {
        let mut texel = std::mem::take(&mut self.texel);
        texel.clear([0, 0]);
        self.gather(row, column, [1, 0], &mut texel);
        let mut covered = 0.0;
        let is_alike = |range| weight.is_alike(range);
        texel.areas(&is_alike, &mut |winding, area| covered += weight.of(winding[0]) * area);
        self.texel = texel;
        covered as f32
    }

    /// Adds all edges that have a part in a texel, or stand west of it in its row, to `texel`; crossing one changes windings by
    /// `adds`.
    pub(super) fn gather(&mut self, row: usize, column: usize, adds: Windings, texel: &mut Winding) {
        self.sort_rows();
        if self.edges.len() > MANY {
            let edge = |k: &u32| {
                let [from, to] = self.edges[*k as usize];
                Edge::new(from, to)
            };
            let sweep = &mut self.sweeps[row];
            sweep.prepare(row, self.width, self.of_rows[row].iter().filter_map(edge));
            return sweep.gather(row, column, adds, texel);
        }
        let start = Fixed { x: (column as i64) << BITS, y: (row as i64) << BITS };
        for &piece in &self.of_rows[row] {
            let piece = self.pieces[piece as usize];
            let edges = &self.edges[piece.edges.0 as usize..piece.edges.1 as usize];
            if self.rings == Rings::Pieces && !may_meet(edges, row, start.x) {
                continue;
            }
            for edge in in_row(edges, row) {
                add_edge(&edge, row, start, adds, texel);
            }
        }
    }

    /// Lists the pieces, or the edges, of each row.
    fn sort_rows(&mut self) {
        if self.are_rows_sorted {
            return;
        }
        self.are_rows_sorted = true;
        self.of_rows.iter_mut().for_each(Vec::clear);
        if self.edges.len() > MANY {
            self.sweeps.resize_with(self.height, Sweep::default);
            self.sweeps.iter_mut().for_each(Sweep::clear);
            for (k, [from, to]) in self.edges.iter().enumerate() {
                let (top, bottom) = (from.y.min(to.y), from.y.max(to.y));
                let rows = texel_of(top).max(0)..(texel_of(bottom - 1) + 1).min(self.height as i64);
                rows.for_each(|row| self.of_rows[row as usize].push(k as u32));
            }
            return;
        }
        for (k, piece) in self.pieces.iter().enumerate() {
            for row in piece.rows.0..piece.rows.1 {
                self.of_rows[row as usize].push(k as u32);
            }
        }
    }
}

impl ByRows for Accumulator {
    fn width(&self) -> usize {
        self.width as usize
    }

    fn rows(&self) -> Range<usize> {
        self.rows.0..self.rows.1
    }

    #[inline(always)]
    fn take_row(&mut self, row: usize, weight: Weight, to: &mut impl Runs) {
        let mut blocks = std::mem::take(&mut self.touched[row]) & self.blocks;
        if self.rings == Rings::Pieces {
            blocks |= self.take_overlaps(row);
        }
        let (mut area, mut next) = (0i32, 0);
        while blocks != 0 {
            // Between blocks that an edge meets nothing changes.
            let block = blocks.trailing_zeros() as usize;
            blocks &= blocks - 1;
            if area != 0 && next < block {
                to.alike(next << self.shift..block << self.shift, self.plain(area, weight));
            }
            for four in block << self.shift >> FOUR_BITS..(block + 1) << self.shift >> FOUR_BITS {
                let first = four << FOUR_BITS;
                let cells = row * self.stride + first;
                let mut areas = [0; FOUR];
                if let Some(cells) = self.areas.get_mut(cells..cells + FOUR) {
                    for k in 0..FOUR {
                        area = area.wrapping_add(cells[k]);
                        areas[k] = area;
                        cells[k] = 0;
                    }
                }
                let mut coverage = [0.0; FOUR];
                for k in 0..FOUR {
                    coverage[k] = self.plain(areas[k], weight);
                }
                if self.rings == Rings::Any || !self.overlaps.is_empty() {
                    self.tell_apart(row, first, weight, &mut coverage);
                }
                to.four(first, &coverage);
            }
            next = block + 1;
        }
        let rest = next << self.shift..self.width as usize;
        if area != 0 && !rest.is_empty() {
            to.alike(rest, self.plain(area, weight));
        }
        self.overlaps.clear();
    }
}

/// Adds a ring; compiled for the widest vectors of the machine at hand, the bits are the same with any.
struct AddRing<'a> {
    to: &'a mut Accumulator,
    ring: &'a [Texel],
}

impl pulp::WithSimd for AddRing<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { to, ring } = self;
        let start = to.edges.len();
        let mut rows = (to.height, 0);
        if let Some(&last) = ring.last() {
            let mut from = Fixed::new(last, to.origin);
            for &at in ring {
                let next = Fixed::new(at, to.origin);
                to.edge(from, next, &mut rows);
                from = next;
            }
        }
        to.end_ring(start, rows);
    }
}

/// The blocks of a texel and its two eastern neighbours; what lies beyond the last block has none.
#[inline(always)]
fn blocks_of_three(column: usize, shift: u32) -> u64 {
    let (first, last) = (column >> shift, (column + 2) >> shift);
    (1u64 << first) | (((last - first) as u64) << first << 1)
}

/// A texel as a number of units of area.
const UNIT: f32 = 1.0 / ONE as f32;

/// Adds to a sum, which may run over as [`Accumulator`] says.
#[inline(always)]
fn change(cell: &mut i32, by: i32) {
    *cell = cell.wrapping_add(by);
}

/// The coverage of a texel with winding numbers 0 and 1.
#[inline(always)]
fn covered(area: i32) -> f32 {
    area.clamp(0, ONE as i32) as f32 * UNIT
}

/// The coverage of a texel that winding numbers k and k + 1 share, of which `area` is the mean.
#[inline(always)]
fn shared(area: i32, weight: Weight) -> f32 {
    let (low, share) = (area >> BITS, (area & (ONE as i32 - 1)) as f32 * UNIT);
    weight.of(low) as f32 * (1.0 - share) + weight.of(low + 1) as f32 * share
}

/// The edges of a piece that pass through a row.
fn in_row(edges: &[[Fixed; 2]], row: usize) -> impl Iterator<Item = Edge> {
    let (north, south) = ((row as i64) << BITS, (row as i64 + 1) << BITS);
    let edges = edges.iter().filter_map(|[from, to]| Edge::new(*from, *to));
    edges.filter(move |e| e.top.y < south && e.bottom.y > north)
}

/// Whether a piece's columns in a row reach around those of a texel: others count nothing there.
fn may_meet(edges: &[[Fixed; 2]], row: usize, west: i64) -> bool {
    let (mut least, mut most) = (i64::MAX, i64::MIN);
    for edge in in_row(edges, row) {
        let part = edge.in_row(row as i64);
        least = least.min(part.top.x.min(part.bottom.x));
        most = most.max(part.top.x.max(part.bottom.x));
    }
    least < west + ONE && most >= west
}

/// Adds an edge's part in a row to a texel that starts at `start`.
fn add_edge(edge: &Edge, row: usize, start: Fixed, adds: Windings, texel: &mut Winding) {
    let part = edge.in_row(row as i64);
    let unit = |v: i64| v as f64 / ONE as f64;
    let adds = adds.map(|v| v * edge.sign);
    let height = |y: i64| unit(y - start.y);
    let (least, most) =
        if part.top.x < part.bottom.x { (part.top.x, part.bottom.x) } else { (part.bottom.x, part.top.x) };
    if least >= start.x + ONE {
        return;
    }
    if most <= start.x {
        return texel.add_west((height(part.top.y), height(part.bottom.y)), adds);
    }
    let y_at = |x: i64| edge.y_at(x).clamp(part.top.y, part.bottom.y);
    // Cut off what is west and what is east of the texel.
    let (mut top, mut bottom) = (part.top, part.bottom);
    if least < start.x {
        let y = y_at(start.x);
        let cut = Fixed { x: start.x, y };
        if top.x < start.x {
            texel.add_west((height(top.y), height(y)), adds);
            top = cut;
        } else {
            texel.add_west((height(y), height(bottom.y)), adds);
            bottom = cut;
        }
    }
    let east = start.x + ONE;
    if most > east {
        let cut = Fixed { x: east, y: y_at(east) };
        if top.x > east {
            top = cut;
        } else {
            bottom = cut;
        }
    }
    if top.y < bottom.y {
        let point = |p: Fixed| [unit(p.x - start.x), height(p.y)];
        texel.fragments.push(Fragment { top: point(top), bottom: point(bottom), adds });
    }
}
