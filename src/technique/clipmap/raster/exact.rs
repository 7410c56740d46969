//! Exact areas: how much of each texel of a tile an item covers.
//!
//! Edges leave signed areas in an accumulator of whole numbers, summed along each row: one pass over the edges, whatever
//! their order, with the same bits in any tile. The sum is the area where winding numbers are 0 and 1. Where an item may overlap
//! itself (several pieces of a stroke, several edges of a polygon that is not simple meet a texel) its winding numbers are told apart
//! exactly instead ([`super::winding`]).

use super::fixed::{BITS, Edge, FARTHEST, Fixed, ONE, without_far};
use super::weight::Weight;
use super::winding::{Fragment, Texel as Winding, Windings};
use crate::space::Texel;

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

/// An item's coverage of the texels of one row.
#[derive(Debug, Clone, Default)]
pub(super) struct RowCoverage {
    /// The first texel's column.
    pub(super) first: usize,
    /// How much of each texel is covered; where it is covered several times, how much once would be the same (see [`Weight`]).
    pub(super) coverage: Vec<f32>,
}

/// Columns that something may have a part in: `first..=last`, -1 for all that is west of the tile, its width for all east.
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
struct Piece {
    edges: (u32, u32),
    rows: (u32, u32),
}

/// A tile's accumulator.
#[derive(Debug)]
pub(super) struct Accumulator {
    width: i32,
    height: usize,
    origin: (i64, i64),
    rings: Rings,
    stride: usize,
    /// Differences of covered areas along rows, in units of 2^-16 texel.
    areas: Vec<i32>,
    /// Differences of the number of pieces along rows, or the number of edges in a texel.
    crowd: Vec<i32>,
    /// What the item may have a part in, a row each.
    spans: Vec<Span>,
    /// The same of the piece at hand.
    piece_spans: Vec<Span>,
    rows: (usize, usize),
    edges: Vec<Edge>,
    pieces: Vec<Piece>,
    /// The pieces of each row, once they are asked for.
    pieces_of_rows: Vec<Vec<u32>>,
    are_pieces_sorted: bool,
    ring: Vec<Texel>,
    texel: Winding,
}

impl Accumulator {
    /// An accumulator of a tile whose first texel is `origin`.
    pub(super) fn new(origin: (i64, i64), (width, height): (usize, usize)) -> Self {
        let stride = width + 2;
        Self {
            width: width as i32,
            height,
            origin,
            rings: Rings::Simple,
            stride,
            areas: vec![0; stride * height],
            crowd: vec![0; stride * height],
            spans: vec![Span::EMPTY; height],
            piece_spans: vec![Span::EMPTY; height],
            rows: (height, 0),
            edges: Vec::new(),
            pieces: Vec::new(),
            pieces_of_rows: vec![Vec::new(); height],
            are_pieces_sorted: false,
            ring: Vec::new(),
            texel: Winding::default(),
        }
    }

    /// Starts an item; what is left of the one before is forgotten.
    pub(super) fn start(&mut self, rings: Rings) {
        for row in self.rows.0..self.rows.1 {
            self.forget_row(row);
        }
        self.rings = rings;
        self.rows = (self.height, 0);
        self.edges.clear();
        self.pieces.clear();
        self.are_pieces_sorted = false;
    }

    fn forget_row(&mut self, row: usize) {
        if self.spans[row] != Span::EMPTY {
            let cells = row * self.stride..(row + 1) * self.stride;
            self.areas[cells.clone()].fill(0);
            self.crowd[cells].fill(0);
            self.spans[row] = Span::EMPTY;
        }
    }

    /// The rows that the item may have a part in.
    pub(super) fn rows(&self) -> std::ops::Range<usize> {
        self.rows.0..self.rows.1
    }

    /// Adds a ring.
    pub(super) fn ring(&mut self, ring: &[Texel]) {
        let mut near = std::mem::take(&mut self.ring);
        without_far(ring, FARTHEST, &mut near);
        let start = self.edges.len();
        let mut rows = (self.height, 0);
        if let Some(&last) = near.last() {
            let mut from = Fixed::new(last, self.origin);
            for &at in &near {
                let to = Fixed::new(at, self.origin);
                self.edge(from, to, &mut rows);
                from = to;
            }
        }
        self.ring = near;
        self.end_ring(start, rows);
    }

    /// A piece is complete: counts it where it may be.
    fn end_ring(&mut self, start: usize, rows: (usize, usize)) {
        for row in rows.0..rows.1 {
            let span = std::mem::replace(&mut self.piece_spans[row], Span::EMPTY);
            if span == Span::EMPTY {
                continue;
            }
            self.spans[row].include(span.first, span.last);
            if self.rings == Rings::Pieces && span.last >= 0 && span.first < self.width {
                let counts = &mut self.crowd[row * self.stride..(row + 1) * self.stride];
                counts[span.first.max(0) as usize] += 1;
                counts[span.last.min(self.width - 1) as usize + 1] -= 1;
            }
        }
        let edges = (start as u32, self.edges.len() as u32);
        if edges.0 < edges.1 {
            self.pieces.push(Piece { edges, rows: (rows.0 as u32, rows.1 as u32) });
        }
        self.rows = (self.rows.0.min(rows.0), self.rows.1.max(rows.1));
    }

    fn edge(&mut self, from: Fixed, to: Fixed, rows: &mut (usize, usize)) {
        let Some(edge) = Edge::new(from, to) else {
            return self.level_edge(from, to, rows);
        };
        let passed = edge.rows(self.height as i64);
        if passed.is_empty() {
            return;
        }
        rows.0 = rows.0.min(passed.start as usize);
        rows.1 = rows.1.max(passed.end as usize);
        self.edges.push(edge);
        let (west, east) = if from.x < to.x { (from.x, to.x) } else { (to.x, from.x) };
        let is_east = west >= i64::from(self.width) << BITS;
        if is_east || east < 0 {
            // All of it on one side.
            let column = if is_east { self.width } else { -1 };
            for row in passed {
                self.piece_spans[row as usize].include(column, column);
                if !is_east {
                    let (north, south) = (row << BITS, (row + 1) << BITS);
                    let height = edge.bottom.y.min(south) - edge.top.y.max(north);
                    self.areas[row as usize * self.stride] += edge.sign * height as i32;
                }
            }
            return;
        }
        let mut at = edge.top;
        if at.y < 0 {
            at = Fixed { x: edge.x_at(0), y: 0 };
        }
        for row in passed {
            let south = (row + 1) << BITS;
            let next =
                if edge.bottom.y <= south { edge.bottom } else { Fixed { x: edge.x_at(south), y: south } };
            self.edge_in_row(row as usize, &edge, at, next);
            at = next;
        }
    }

    /// A level edge has no area; it matters where edges in a texel are counted.
    fn level_edge(&mut self, from: Fixed, to: Fixed, rows: &mut (usize, usize)) {
        let row = from.y >> BITS;
        if self.rings != Rings::Any || row < 0 || row >= self.height as i64 {
            return;
        }
        let (west, east) = if from.x < to.x { (from.x, to.x) } else { (to.x, from.x) };
        let (first, last) = (self.column(west), self.column(east));
        *rows = (rows.0.min(row as usize), rows.1.max(row as usize + 1));
        self.piece_spans[row as usize].include(first, last);
        for column in first.max(0)..=last.min(self.width - 1) {
            self.crowd[row as usize * self.stride + column as usize] += 1;
        }
    }

    /// The column of an x, -1 for all west of the tile, its width for all east.
    #[inline(always)]
    fn column(&self, x: i64) -> i32 {
        if x < 0 {
            -1
        } else {
            let column = x >> BITS;
            if column < i64::from(self.width) { column as i32 } else { self.width }
        }
    }

    #[inline(always)]
    fn edge_in_row(&mut self, row: usize, edge: &Edge, top: Fixed, bottom: Fixed) {
        let (west, east) = if top.x < bottom.x { (top, bottom) } else { (bottom, top) };
        let (first, last) = (self.column(west.x), self.column(east.x));
        self.piece_spans[row].include(first, last);
        if self.rings == Rings::Any {
            for column in first.max(0)..=last.min(self.width - 1) {
                self.crowd[row * self.stride + column as usize] += 1;
            }
        }
        if first == last {
            if first >= 0 && first < self.width {
                let start = i64::from(first) << BITS;
                self.cell(
                    row,
                    first as usize,
                    edge.sign,
                    bottom.y - top.y,
                    (west.x - start) + (east.x - start),
                );
            } else if first < 0 {
                self.areas[row * self.stride] += edge.sign * (bottom.y - top.y) as i32;
            }
            return;
        }
        self.edge_in_cells(row, edge, (top.y, bottom.y), west, east);
    }

    /// An edge that crosses texels of a row, from the west to the east.
    fn edge_in_cells(
        &mut self,
        row: usize,
        edge: &Edge,
        (north, south): (i64, i64),
        west: Fixed,
        east: Fixed,
    ) {
        let mut at = west;
        let y_at = |x: i64| edge.y_at(x).clamp(north, south);
        if at.x < 0 {
            let y = y_at(0);
            self.areas[row * self.stride] += edge.sign * (y - at.y).abs() as i32;
            at = Fixed { x: 0, y };
        }
        for column in at.x >> BITS..i64::from(self.width) {
            let (start, end) = (column << BITS, (column + 1) << BITS);
            let next = if end < east.x { Fixed { x: end, y: y_at(end) } } else { east };
            self.cell(
                row,
                column as usize,
                edge.sign,
                (next.y - at.y).abs(),
                (at.x - start) + (next.x - start),
            );
            if end >= east.x {
                break;
            }
            at = next;
        }
    }

    /// A part of an edge in one texel: its height, and the sum of its ends' distances from the western side.
    #[inline(always)]
    fn cell(&mut self, row: usize, column: usize, sign: i32, height: i64, doubled_x: i64) {
        // East of the edge lies the trapezoid (1 - mean x) * height of this texel, and all of the height in those farther east.
        let here = sign * ((height * (2 * ONE - doubled_x) + ONE) >> (BITS + 1)) as i32;
        let at = row * self.stride + column;
        self.areas[at] += here;
        self.areas[at + 1] += sign * height as i32 - here;
    }

    /// The coverage of a row; what the accumulator holds of it is used up. False where the item has no part in it.
    pub(super) fn take_row(&mut self, row: usize, weight: Weight, out: &mut RowCoverage) -> bool {
        out.coverage.clear();
        let Span { first, last } = self.spans[row];
        let (first, last) = (first.max(0), last.min(self.width - 1));
        if first > last {
            self.forget_row(row);
            return false;
        }
        out.first = first as usize;
        let (mut area, mut pieces) = (0i32, 0i32);
        let cells = row * self.stride..(row + 1) * self.stride;
        // Sums run from the tile's western side: nothing stands before the first column.
        let columns = first as usize..=last as usize;
        for column in columns {
            area = area.wrapping_add(self.areas[cells.start + column]);
            let crowd = self.crowd[cells.start + column];
            let many = match self.rings {
                Rings::Simple => 0,
                Rings::Any => crowd,
                Rings::Pieces => {
                    pieces += crowd;
                    pieces
                }
            };
            let coverage =
                if many >= 2 { self.crowded(row, column, weight) } else { self.plain(area, weight) };
            out.coverage.push(coverage);
        }
        self.forget_row(row);
        true
    }

    /// The coverage of a texel that winding numbers k and k + 1 share, of which `area` is the mean.
    #[inline(always)]
    fn plain(&self, area: i32, weight: Weight) -> f32 {
        const UNIT: f32 = 1.0 / ONE as f32;
        if self.rings != Rings::Any {
            return area.clamp(0, ONE as i32) as f32 * UNIT;
        }
        let (low, share) = (area >> BITS, (area & (ONE as i32 - 1)) as f32 * UNIT);
        weight.of(low) as f32 * (1.0 - share) + weight.of(low + 1) as f32 * share
    }

    /// The coverage of a texel in which winding numbers must be told apart.
    #[cold]
    fn crowded(&mut self, row: usize, column: usize, weight: Weight) -> f32 {
        let mut texel = std::mem::take(&mut self.texel);
        texel.clear([0, 0]);
        self.gather(row, column, [1, 0], &mut texel);
        let mut covered = 0.0;
        texel.areas(&mut |winding, area| covered += weight.of(winding[0]) * area);
        self.texel = texel;
        covered as f32
    }

    /// Adds all edges that have a part in a texel, or stand west of it in its row, to `texel`; crossing one changes windings by
    /// `adds`.
    pub(super) fn gather(&mut self, row: usize, column: usize, adds: Windings, texel: &mut Winding) {
        self.sort_pieces();
        let start = Fixed { x: (column as i64) << BITS, y: (row as i64) << BITS };
        for &piece in &self.pieces_of_rows[row] {
            let piece = self.pieces[piece as usize];
            let edges = &self.edges[piece.edges.0 as usize..piece.edges.1 as usize];
            if self.rings == Rings::Pieces && !may_meet(edges, row, start.x) {
                continue;
            }
            for edge in edges {
                if (edge.top.y < start.y + ONE) && (edge.bottom.y > start.y) {
                    add_edge(edge, row, start, adds, texel);
                }
            }
        }
    }

    /// Lists the pieces of each row.
    fn sort_pieces(&mut self) {
        if self.are_pieces_sorted {
            return;
        }
        self.pieces_of_rows.iter_mut().for_each(Vec::clear);
        for (k, piece) in self.pieces.iter().enumerate() {
            for row in piece.rows.0..piece.rows.1 {
                self.pieces_of_rows[row as usize].push(k as u32);
            }
        }
        self.are_pieces_sorted = true;
    }
}

/// Whether a piece's columns in a row reach around those of a texel: others count nothing there.
fn may_meet(edges: &[Edge], row: usize, west: i64) -> bool {
    let (north, south) = ((row as i64) << BITS, (row as i64 + 1) << BITS);
    let (mut least, mut most) = (i64::MAX, i64::MIN);
    for edge in edges.iter().filter(|e| e.top.y < south && e.bottom.y > north) {
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
