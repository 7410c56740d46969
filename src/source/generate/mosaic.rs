//! Land use: polygons that share their edges exactly.

use super::jagged::jagged;
use super::random::{at, scramble, signed, unit};
use crate::math::{cos, sin};
use crate::scene::Shape;
use crate::scene_file::VectorGenerator;
use crate::space::{Plan, PlanBox};
use glam::DVec2;
use std::f64::consts::PI;

/// Pieces of an edge: a power of two.
const PIECES: usize = 8;
/// Classes of polygons where a scene does not say how many.
const CLASSES: u32 = 6;
/// Vertices of a lake.
const SHORE: usize = 16;

/// `count` polygons that fill the window, of which those of one class are kept (or all).
pub(super) fn mosaic(
    generator: &VectorGenerator,
    class: Option<(u32, u32)>,
    holes: f64,
    window: PlanBox,
) -> Vec<Shape> {
    let grid = Grid::new(generator, window);
    let kept = grid.cells().filter(|cell| class.is_none_or(|(class, of)| grid.class(*cell, of) == class));
    kept.map(|(from, to, row)| grid.polygon(from, to, row, holes)).collect()
}

/// The classes of the polygons that are kept: of as many as the class that is kept is of, else of [`CLASSES`].
pub(super) fn classes(generator: &VectorGenerator, class: Option<(u32, u32)>, window: PlanBox) -> Vec<i64> {
    let grid = Grid::new(generator, window);
    let of = class.map_or(CLASSES, |(_, of)| of);
    let all = grid.cells().map(|cell| grid.class(cell, of));
    all.filter(|own| class.is_none_or(|(class, _)| class == *own)).map(i64::from).collect()
}

/// A grid whose corners are moved and whose edges wiggle, each by a hash of its own number: both neighbours of an edge
/// compute the same vertices.
struct Grid {
    seed: u64,
    columns: usize,
    rows: usize,
    /// Polygons in the last row, which may have fewer of them than columns.
    last: usize,
    window: PlanBox,
    cell: DVec2,
}

impl Grid {
    fn new(generator: &VectorGenerator, window: PlanBox) -> Self {
        let size = window.max - window.min;
        let count = generator.count.max(1);
        let columns = ((count as f64 * size.x / size.y).sqrt().ceil() as usize).clamp(1, count);
        let rows = count.div_ceil(columns);
        let cell = DVec2::new(size.x / columns as f64, size.y / rows as f64);
        let last = count - columns * (rows - 1);
        Self { seed: scramble(generator.seed), columns, rows, last, window, cell }
    }

    /// The polygons of a row, as ranges of its columns.
    fn groups(&self, row: usize) -> Vec<(usize, usize)> {
        let polygons = if row + 1 == self.rows { self.last } else { self.columns };
        let border = |n: usize| n * self.columns / polygons;
        (0..polygons).map(|n| (border(n), border(n + 1))).collect()
    }

    /// All polygons: their first column, the one after their last, their row.
    fn cells(&self) -> impl Iterator<Item = (usize, usize, usize)> {
        (0..self.rows).flat_map(|row| self.groups(row).into_iter().map(move |(from, to)| (from, to, row)))
    }

    /// The class of a polygon, of so many.
    fn class(&self, (from, _, row): (usize, usize, usize), of: u32) -> u32 {
        (self.hash(0, from, row) % u64::from(of)) as u32
    }

    /// A hash of a thing of some kind at a place.
    fn hash(&self, kind: u64, column: usize, row: usize) -> u64 {
        at(self.seed ^ scramble(kind), column as i64, row as i64)
    }

    fn polygon(&self, from: usize, to: usize, row: usize, holes: f64) -> Shape {
        let mut ring = Vec::new();
        (from..to).for_each(|column| ring.extend(self.edge_east(column, row)));
        ring.extend(self.edge_north(to, row));
        (from..to).rev().for_each(|column| {
            ring.extend(backwards(self.edge_east(column, row + 1), self.corner(column + 1, row + 1)))
        });
        ring.extend(backwards(self.edge_north(from, row), self.corner(from, row + 1)));
        let lake = unit(self.hash(1, from, row)) < holes;
        Shape::Polygon(if lake { vec![ring, self.lake(from, row)] } else { vec![ring] })
    }

    /// The corner south-west of a cell; those on the window's border stay on it.
    fn corner(&self, column: usize, row: usize) -> Plan {
        let moved = |kind, place: usize, places: usize| {
            let inner = 0 < place && place < places;
            place as f64 + if inner { 0.28 * signed(self.hash(kind, column, row)) } else { 0.0 }
        };
        let (i, j) = (moved(2, column, self.columns), moved(3, row, self.rows));
        let x = if column == self.columns { self.window.max.x } else { self.window.min.x + i * self.cell.x };
        let y = if row == self.rows { self.window.max.y } else { self.window.min.y + j * self.cell.y };
        Plan::new(x, y)
    }

    /// From a corner to its eastern neighbour, without the last vertex.
    fn edge_east(&self, column: usize, row: usize) -> Vec<Plan> {
        let straight = row == 0 || row == self.rows;
        self.edge(self.corner(column, row), self.corner(column + 1, row), self.hash(4, column, row), straight)
    }

    /// From a corner to its northern neighbour, without the last vertex.
    fn edge_north(&self, column: usize, row: usize) -> Vec<Plan> {
        let straight = column == 0 || column == self.columns;
        self.edge(self.corner(column, row), self.corner(column, row + 1), self.hash(5, column, row), straight)
    }

    /// A jagged way.
    fn edge(&self, from: Plan, to: Plan, hash: u64, straight: bool) -> Vec<Plan> {
        if straight {
            return vec![from];
        }
        let mut vertices = Vec::with_capacity(PIECES);
        jagged(&mut vertices, (from, to), PIECES, 0.16, hash);
        vertices
    }

    /// A lake around the middle of a cell.
    fn lake(&self, column: usize, row: usize) -> Vec<Plan> {
        let corners =
            [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| self.corner(column + i, row + j).to_vec());
        let middle: Plan = ((corners[0] + corners[1] + (corners[2] + corners[3])) * 0.25).into();
        let radius = 0.2 * crate::math::min(self.cell.x, self.cell.y);
        let vertex = |n: usize| {
            let angle = -2.0 * PI * n as f64 / SHORE as f64;
            let reach = radius * (1.0 + 0.25 * signed(scramble(self.hash(6, column, row) ^ n as u64)));
            middle + DVec2::new(cos(angle), sin(angle)) * reach
        };
        (0..SHORE).map(vertex).collect()
    }
}

/// An edge from its end to its start, without the start.
fn backwards(edge: Vec<Plan>, end: Plan) -> Vec<Plan> {
    let inner = edge.into_iter().skip(1).rev();
    std::iter::once(end).chain(inner).collect()
}

#[cfg(test)]
mod tests {
    use super::super::{features, tests::*};
    use super::*;
    use crate::scene_file::VectorKind;
    use std::collections::BTreeMap;

    fn rings(count: usize, class: Option<(u32, u32)>, holes: f64) -> Vec<Vec<Vec<Plan>>> {
        let kind = VectorKind::Mosaic { class, holes };
        let generator = VectorGenerator { kind, seed: 5, count, window: None };
        let rings = |shape| {
            if let Shape::Polygon(rings) = shape { rings } else { panic!("not a polygon") }
        };
        features(&generator, window()).into_iter().map(|feature| rings(feature.shape)).collect()
    }

    /// Twice the signed area, and the edges, of all outer rings.
    fn area(ring: &[Plan]) -> f64 {
        edges(ring).map(|(a, b)| a.to_vec().perp_dot(b.to_vec())).sum()
    }

    fn edges(ring: &[Plan]) -> impl Iterator<Item = (Plan, Plan)> {
        (0..ring.len()).map(|n| (ring[n], ring[(n + 1) % ring.len()]))
    }

    #[test]
    fn a_mosaic_has_exactly_the_polygons_asked_for() {
        for count in [1, 2, 3, 7, 100, 1013] {
            assert_eq!(rings(count, None, 0.1).len(), count);
        }
    }

    #[test]
    fn neighbours_share_their_edges_bit_for_bit() {
        let key = |a: Plan, b: Plan| [a.x, a.y, b.x, b.y].map(f64::to_bits);
        let mut open: BTreeMap<[u64; 4], usize> = BTreeMap::new();
        let polygons = rings(103, None, 0.0);
        for (a, b) in polygons.iter().flat_map(|rings| edges(&rings[0])) {
            *open.entry(key(a, b)).or_default() += 1;
        }
        assert!(open.values().all(|times| *times == 1), "an edge is used twice in one direction");
        let on_border = |a: Plan, b: Plan| {
            let w = window();
            [w.min.x, w.max.x].iter().any(|x| a.x == *x && b.x == *x)
                || [w.min.y, w.max.y].iter().any(|y| a.y == *y && b.y == *y)
        };
        for (a, b) in polygons.iter().flat_map(|rings| edges(&rings[0])) {
            assert_eq!(open.contains_key(&key(b, a)), !on_border(a, b));
        }
    }

    #[test]
    fn a_mosaic_fills_its_window() {
        let size = window().max - window().min;
        let sum: f64 = rings(103, None, 0.3).iter().map(|rings| 0.5 * area(&rings[0])).sum();
        assert!((sum / (size.x * size.y) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn classes_part_the_mosaic() {
        let all: usize = (0..4).map(|class| rings(500, Some((class, 4)), 0.1).len()).sum();
        assert_eq!(all, 500);
        assert!((0..4).all(|class| rings(500, Some((class, 4)), 0.1).len() > 80));
    }

    #[test]
    fn some_polygons_have_a_lake_that_runs_the_other_way() {
        let polygons = rings(500, None, 0.2);
        let lakes: Vec<_> = polygons.iter().filter_map(|rings| rings.get(1)).collect();
        assert!((50..150).contains(&lakes.len()));
        assert!(lakes.iter().all(|lake| area(lake) < 0.0));
    }

    #[test]
    fn a_mosaic_keeps_its_bits() {
        assert_eq!(bits(&rings(200, None, 0.2).concat()), "d0a4859afe95172d");
    }
}
