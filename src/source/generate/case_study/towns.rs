//! Towns: streets between crossings, and buildings in the blocks that they enclose.

use super::super::apportion::{apportion, uneven};
use super::super::jagged::jagged;
use super::super::random::{Sequence, at, scramble, signed, unit};
use super::super::roads::direction;
use crate::parallel;
use crate::scene::Shape;
use crate::scene_file::Amount;
use crate::space::{Plan, PlanBox};
use glam::DVec2;

/// The share of the window that all towns cover together, where none lies on another.
const BUILT: f64 = 0.35;
/// How much of a street's length its middle may be displaced by.
const ROUGHNESS: f64 = 0.04;

/// Towns of very different sizes.
pub(super) struct Towns {
    seed: u64,
    weights: Vec<f64>,
    /// The middle of each, and its side as a vector.
    places: Vec<(Plan, DVec2)>,
}

impl Towns {
    /// So many, at least one.
    pub(super) fn new(count: usize, seed: u64, window: PlanBox) -> Self {
        let count = count.max(1);
        let seed = scramble(seed ^ 77);
        let mut random = Sequence::new(seed);
        let weights: Vec<f64> = (0..count).map(|_| uneven(random.unit())).collect();
        let whole: f64 = weights.iter().sum();
        let size = window.max - window.min;
        let place = |weight: &f64| {
            let side = (BUILT * size.x * size.y * weight / whole).sqrt();
            // A whole town is in the window, if it can be: half its diagonal and what its corners move.
            let margin = DVec2::splat(0.75 * side).min(size * 0.5);
            let middle = margin + DVec2::new(random.unit(), random.unit()) * (size - margin * 2.0);
            (window.min + middle, direction(&mut random) * side)
        };
        let places = weights.iter().map(place).collect();
        Self { seed, weights, places }
    }

    /// So many things shared out to the towns.
    fn shared(&self, things: usize) -> Vec<usize> {
        apportion(things, self.weights.len(), 0, |town| self.weights[town])
    }

    /// A town with at least so many streets.
    fn town(&self, number: usize, streets: usize) -> Town {
        let mut blocks = 1;
        while 2 * blocks * (blocks + 1) < streets {
            blocks += 1;
        }
        let (middle, side) = self.places[number];
        Town { middle, step: side / blocks as f64, blocks, seed: scramble(self.seed ^ number as u64) }
    }

    /// Streets from crossing to crossing.
    pub(super) fn streets(&self, lines: Amount) -> Vec<Shape> {
        let weight = |street| 0.3 + unit(scramble(self.seed ^ scramble(1 ^ (street as u64) << 3)));
        let vertices = apportion(lines.vertices, lines.decals, 2, weight);
        let streets = self.shared(lines.decals);
        self.in_each(&streets, |number, street, all| {
            let town = self.town(number, streets[number]);
            Shape::Line(vec![town.street(street, streets[number], vertices[all])])
        })
    }

    /// Buildings in the blocks between so many streets.
    pub(super) fn buildings(&self, areas: Amount, streets: usize) -> Vec<Shape> {
        let weight = |building| 0.3 + unit(scramble(self.seed ^ scramble(2 ^ (building as u64) << 3)));
        let vertices = apportion(areas.vertices, areas.decals, 4, weight);
        let (buildings, streets) = (self.shared(areas.decals), self.shared(streets));
        self.in_each(&buildings, |number, building, all| {
            let town = self.town(number, streets[number]);
            Shape::Polygon(vec![town.building(building, buildings[number], vertices[all])])
        })
    }

    /// `make` of each thing of each town, of which there are so many: the town's number, the thing's number in it and among all.
    fn in_each(
        &self,
        counts: &[usize],
        make: impl Fn(usize, usize, usize) -> Shape + Sync + Send,
    ) -> Vec<Shape> {
        let mut all = 0;
        let mut things = Vec::with_capacity(counts.iter().sum());
        for (number, count) in counts.iter().enumerate() {
            things.extend(parallel::map_indices(*count, |thing| make(number, thing, all + thing)));
            all += count;
        }
        things
    }
}

/// A square of blocks.
struct Town {
    middle: Plan,
    /// From a crossing to the next of its row.
    step: DVec2,
    blocks: usize,
    seed: u64,
}

impl Town {
    fn crossing(&self, column: usize, row: usize) -> Plan {
        let moved = |kind, place: usize| {
            place as f64 - 0.5 * self.blocks as f64
                + 0.15 * signed(at(self.seed ^ kind, column as i64, row as i64))
        };
        self.middle + self.step * moved(1, column) + self.step.perp() * moved(2, row)
    }

    /// One of so many.
    fn street(&self, number: usize, of: usize, vertices: usize) -> Vec<Plan> {
        let rows = self.blocks * (self.blocks + 1);
        let edge = number * 2 * rows / of;
        let (a, b) = (edge % rows % self.blocks, edge % rows / self.blocks);
        let (from, to) = if edge < rows { ((a, b), (a + 1, b)) } else { ((b, a), (b, a + 1)) };
        let (from, to) = (self.crossing(from.0, from.1), self.crossing(to.0, to.1));
        let mut line = Vec::with_capacity(vertices);
        jagged(&mut line, (from, to), vertices - 1, ROUGHNESS, scramble(self.seed ^ edge as u64));
        line.push(to);
        line
    }

    /// One of so many.
    fn building(&self, number: usize, of: usize, vertices: usize) -> Vec<Plan> {
        let blocks = self.blocks * self.blocks;
        let side = (of.div_ceil(blocks) as f64).sqrt().ceil() as usize;
        let lot = number * (blocks * side * side) / of;
        let (block, lot) = (lot / (side * side), lot % (side * side));
        let (column, row) = (block % self.blocks, block / self.blocks);
        let corners = [(0, 0), (1, 0), (0, 1), (1, 1)];
        let corners = corners.map(|(i, j)| self.crossing(column + i, row + j).to_vec());
        let share = |k: usize| 0.2 + 0.6 * (k as f64 + 0.5) / side as f64;
        let (u, v) = (share(lot % side), share(lot / side));
        let low = corners[0] + (corners[1] - corners[0]) * u;
        let high = corners[2] + (corners[3] - corners[2]) * u;
        let middle = Plan::from(low + (high - low) * v);
        let hash = scramble(self.seed ^ scramble(3 ^ (number as u64) << 3));
        let half = |hash| 0.24 / side as f64 * (0.75 + 0.25 * signed(hash));
        footprint(vertices, half(hash), half(scramble(hash)))
            .into_iter()
            .map(|p| middle + self.step * p.x + self.step.perp() * p.y)
            .collect()
    }
}

/// A house with so many corners (at least four), one of them stepped; half its sides are `u` and `v`.
fn footprint(vertices: usize, u: f64, v: f64) -> Vec<Plan> {
    let steps = (vertices - 4) / 2;
    let mut ring = Vec::with_capacity(vertices);
    ring.push(Plan::new(-u, -v));
    if vertices % 2 == 1 {
        ring.push(Plan::new(0.0, -v));
    }
    ring.push(Plan::new(u, -v));
    let (dx, dy) = (1.2 * u / steps.max(1) as f64, 1.2 * v / steps.max(1) as f64);
    ring.push(Plan::new(u, v - dy * steps as f64));
    for step in 1..=steps {
        let x = u - dx * step as f64;
        ring.push(Plan::new(x, v - dy * (steps - step + 1) as f64));
        ring.push(Plan::new(x, v - dy * (steps - step) as f64));
    }
    ring.push(Plan::new(-u, v));
    ring
}
