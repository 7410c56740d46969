//! Catchments and land use: areas that fill the window without gaps and share the vertices of their borders.
//!
//! A lattice of hexagons; each area is grown from one of them until all are taken, as water runs: over the easiest border first. Three
//! hexagons meet at each corner, so that no border touches itself.

use super::super::apportion::apportion;
use super::super::jagged::{jagged, jagged_backwards, shore};
use super::super::random::{at, scramble, signed, unit};
use crate::parallel;
use crate::scene::Shape;
use crate::scene_file::Amount;
use crate::space::{Plan, PlanBox};
use glam::DVec2;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// The most hexagons of an area on average.
const MOST_HEXAGONS: usize = 12;
/// How much of a border's length its middle may be displaced by.
const ROUGHNESS: f64 = 0.16;
/// A hexagon's hole reaches so far, of its smaller side.
const HOLE: f64 = 0.28;

/// So many areas with their holes.
pub(super) fn partition(areas: Amount, holes: Amount, seed: u64, window: PlanBox) -> Vec<Shape> {
    let per_area = (areas.vertices / areas.decals / 6).clamp(1, MOST_HEXAGONS);
    let lattice = Lattice::new(areas.decals * per_area, seed, window);
    let area_of = lattice.grown(areas.decals);
    let borders = lattice.borders(&area_of);
    // Edges at the window's border are straight; the others have as many pieces as it takes.
    let inner = (borders.edges - borders.outer).max(1);
    let pieces = areas.vertices.saturating_sub(borders.outer) as f64 / inner as f64;
    let holes = lattice.holes(holes);
    let hexagons = by_area(&area_of, areas.decals);
    parallel::map(&hexagons, |own| lattice.shape(own, &area_of, pieces, &holes))
}

/// The hexagons of each area.
fn by_area(area_of: &[u32], areas: usize) -> Vec<Vec<u32>> {
    let mut all = vec![Vec::new(); areas];
    area_of.iter().enumerate().for_each(|(hexagon, area)| all[*area as usize].push(hexagon as u32));
    all
}

/// How many edges of hexagons are borders of areas, counted once for each area, and how many of them lie at the window's.
struct Borders {
    edges: usize,
    outer: usize,
}

/// Holes: the hexagon of each in ascending order, and how many vertices it has.
type Holes = Vec<(u32, usize)>;

/// A corner: half columns from the west, rows from the south.
type Corner = (usize, usize);

/// Hexagons in rows; those of odd rows lie half a column farther to the east. A row's hexagon has three corners below and three above.
struct Lattice {
    seed: u64,
    columns: usize,
    rows: usize,
    window: PlanBox,
}

impl Lattice {
    /// At least so many hexagons, about as wide as high.
    fn new(hexagons: usize, seed: u64, window: PlanBox) -> Self {
        let size = window.max - window.min;
        let columns = ((hexagons as f64 * size.x / size.y).sqrt().round() as usize).clamp(1, hexagons);
        Self { seed, columns, rows: hexagons.div_ceil(columns), window }
    }

    fn hexagons(&self) -> usize {
        self.columns * self.rows
    }

    /// The western half column of a hexagon.
    fn west(&self, hexagon: usize) -> Corner {
        let (column, row) = (hexagon % self.columns, hexagon / self.columns);
        (2 * column + row % 2, row)
    }

    /// The hexagon of a row over or under a corner's eastern side.
    fn hexagon_at(&self, half_column: usize, row: usize) -> Option<usize> {
        let column = half_column.checked_sub(row % 2)? / 2;
        (column < self.columns && row < self.rows).then_some(row * self.columns + column)
    }

    /// The edges of a hexagon, counter-clockwise: from where to where, and who lies beyond.
    fn edges(&self, hexagon: usize) -> [(Corner, Corner, Option<usize>); 6] {
        let (x, y) = self.west(hexagon);
        let below = |x| y.checked_sub(1).and_then(|row| self.hexagon_at(x, row));
        let column = hexagon % self.columns;
        [
            ((x, y), (x + 1, y), below(x)),
            ((x + 1, y), (x + 2, y), below(x + 1)),
            ((x + 2, y), (x + 2, y + 1), (column + 1 < self.columns).then_some(hexagon + 1)),
            ((x + 2, y + 1), (x + 1, y + 1), self.hexagon_at(x + 1, y + 1)),
            ((x + 1, y + 1), (x, y + 1), self.hexagon_at(x, y + 1)),
            ((x, y + 1), (x, y), (column > 0).then(|| hexagon - 1)),
        ]
    }

    /// The area of each hexagon: of so many, each is grown from a hexagon of its own. Whoever is reached first by an area, belongs to it.
    fn grown(&self, areas: usize) -> Vec<u32> {
        let hexagons = self.hexagons();
        let mut area_of = vec![u32::MAX; hexagons];
        let mut front = BinaryHeap::with_capacity(2 * hexagons);
        for area in 0..areas {
            front.push(Reverse((0, self.one_of(hexagons, area, areas, 1), area as u32)));
        }
        while let Some(Reverse((cost, hexagon, area))) = front.pop() {
            if area_of[hexagon] != u32::MAX {
                continue;
            }
            area_of[hexagon] = area;
            for (from, to, beyond) in self.edges(hexagon) {
                let Some(beyond) = beyond.filter(|beyond| area_of[*beyond] == u32::MAX) else { continue };
                // A border is easy or hard to pass whichever way.
                front.push(Reverse((cost + 1 + (self.hash(2, from, to) & 0xff), beyond, area)));
            }
        }
        area_of
    }

    /// One of all hexagons for the thing with a number out of so many: each has another.
    fn one_of(&self, hexagons: usize, number: usize, of: usize, kind: u64) -> usize {
        let (low, high) = (number * hexagons / of, (number + 1) * hexagons / of);
        low + (unit(scramble(self.seed ^ scramble(kind ^ (number as u64) << 3))) * (high - low) as f64)
            as usize
    }

    fn borders(&self, area_of: &[u32]) -> Borders {
        let mut borders = Borders { edges: 0, outer: 0 };
        for hexagon in 0..self.hexagons() {
            for (_, _, beyond) in self.edges(hexagon) {
                borders.outer += usize::from(beyond.is_none());
                borders.edges += usize::from(is_border(area_of, hexagon, beyond));
            }
        }
        borders
    }

    fn holes(&self, holes: Amount) -> Holes {
        let count = holes.decals.min(self.hexagons());
        let weight = |hole| 0.3 + unit(scramble(self.seed ^ scramble(7 ^ (hole as u64) << 3)));
        let vertices = apportion(holes.vertices, count, 3, weight);
        let hexagon = |hole| self.one_of(self.hexagons(), hole, count, 5) as u32;
        vertices.into_iter().enumerate().map(|(hole, vertices)| (hexagon(hole), vertices)).collect()
    }

    /// An area's rings: the outer one first, then those around areas that it encloses, then its holes.
    fn shape(&self, own: &[u32], area_of: &[u32], pieces: f64, holes: &Holes) -> Shape {
        let mut edges: Vec<(Corner, Corner, bool)> = Vec::with_capacity(2 * own.len() + 4);
        for hexagon in own {
            let hexagon = *hexagon as usize;
            let bordering = self.edges(hexagon).into_iter();
            let bordering = bordering.filter(|(_, _, beyond)| is_border(area_of, hexagon, *beyond));
            edges.extend(bordering.map(|(from, to, beyond)| (from, to, beyond.is_none())));
        }
        edges.sort_unstable_by_key(|(from, ..)| *from);
        let mut is_done = vec![false; edges.len()];
        let mut rings = Vec::new();
        // The south-westernmost corner of all belongs to the outer ring.
        for first in 0..edges.len() {
            let (mut next, mut chain) = (first, Vec::new());
            while !is_done[next] {
                is_done[next] = true;
                chain.push(edges[next]);
                let Ok(found) = edges.binary_search_by_key(&edges[next].1, |(from, ..)| *from) else { break };
                next = found;
            }
            if !chain.is_empty() {
                rings.push(self.ring(&chain, pieces));
            }
        }
        for hexagon in own {
            let found = holes.binary_search_by_key(hexagon, |(hexagon, _)| *hexagon);
            rings.extend(found.ok().map(|hole| self.hole(*hexagon as usize, holes[hole].1)));
        }
        Shape::Polygon(rings)
    }

    fn ring(&self, chain: &[(Corner, Corner, bool)], pieces: f64) -> Vec<Plan> {
        let of = |(from, to, is_straight): &(Corner, Corner, bool)| {
            let whole = pieces + unit(self.hash(3, *from, *to));
            if *is_straight { 1 } else { (whole as usize).max(1) }
        };
        let mut ring = Vec::with_capacity(chain.iter().map(of).sum());
        for edge in chain {
            let (from, to, _) = *edge;
            let (pieces, hash) = (of(edge), self.hash(4, from, to));
            // The same vertices from both sides.
            if from < to {
                jagged(&mut ring, (self.place(from), self.place(to)), pieces, ROUGHNESS, hash);
            } else {
                jagged_backwards(&mut ring, (self.place(to), self.place(from)), pieces, ROUGHNESS, hash);
            }
        }
        ring
    }

    fn hole(&self, hexagon: usize, vertices: usize) -> Vec<Plan> {
        let (x, y) = self.west(hexagon);
        let corners =
            [(x, y), (x + 2, y), (x + 2, y + 1), (x, y + 1)].map(|corner| self.place(corner).to_vec());
        let middle = ((corners[0] + corners[2]) + (corners[1] + corners[3])) * 0.25;
        let sides = [corners[1] - corners[0], corners[3] - corners[0]].map(DVec2::length);
        let reach = HOLE * crate::math::min(sides[0], sides[1]);
        let mut ring =
            shore(middle.into(), reach, vertices, scramble(self.seed ^ scramble(6 ^ (hexagon as u64) << 3)));
        ring.reverse();
        ring
    }

    /// Where a corner lies. Those of the window's sides lie on these.
    fn place(&self, (x, y): Corner) -> Plan {
        let (low, high) = (self.window.min, self.window.max);
        let is_end = y == 0 || y == self.rows;
        // The row whose upright edges start or end here points away from it.
        let is_under_edge = x % 2 == y % 2;
        let row = if is_end { y.saturating_sub(1) } else { y };
        let jitter = |kind| 0.12 * signed(self.hash(kind, (x, y), (x, y)));
        let across = if is_end { (x - row % 2) as f64 } else { x as f64 - 0.5 + jitter(5) };
        let up = y as f64 + if is_under_edge { 1.0 / 6.0 } else { -1.0 / 6.0 } + jitter(6);
        let last = 2 * self.columns;
        let px = match x {
            _ if is_end && x - row % 2 == last => high.x,
            _ if is_end => low.x + (high.x - low.x) * (across / last as f64),
            0 | 1 => low.x,
            _ if x >= last => high.x,
            _ => low.x + (high.x - low.x) * (across / last as f64),
        };
        let py = match y {
            0 => low.y,
            _ if y == self.rows => high.y,
            _ => low.y + (high.y - low.y) * (up / self.rows as f64),
        };
        Plan::new(px, py)
    }

    /// A hash of a thing of some kind between two corners, whichever comes first.
    fn hash(&self, kind: u64, a: Corner, b: Corner) -> u64 {
        let (a, b) = (a.min(b), a.max(b));
        // Of two corners that an edge joins, one step leads from the first to the second: it is upright or not.
        at(self.seed ^ scramble(2 * kind + u64::from(a.0 == b.0)), a.0 as i64, a.1 as i64)
    }
}

fn is_border(area_of: &[u32], hexagon: usize, beyond: Option<usize>) -> bool {
    beyond.is_none_or(|beyond| area_of[beyond] != area_of[hexagon])
}
