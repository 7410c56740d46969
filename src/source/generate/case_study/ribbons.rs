//! Floods along rivers: nested areas, each a winding ribbon with jagged banks and many islands.

use super::super::apportion::apportion;
use super::super::jagged::{jagged, shore};
use super::super::random::Sequence;
use super::super::random::{scramble, signed, unit};
use super::super::roads::direction;
use super::scatter::Scatter;
use crate::math::sin;
use crate::parallel;
use crate::scene::Shape;
use crate::scene_file::Amount;
use crate::space::{Plan, PlanBox};
use glam::DVec2;
use std::f64::consts::TAU;

/// Pieces of a bank before it is made jagged.
const BENDS: usize = 12;
const ROUGHNESS: f64 = 0.16;
/// Half the length of a ribbon, of the room that it has.
const HALF_LENGTH: f64 = 0.85;

/// How floods look.
#[derive(Clone, Copy)]
pub(super) struct Ribbons {
    /// How many areas lie in one another.
    pub(super) levels: usize,
    /// Half the width of the widest, of the room that it has.
    pub(super) half_width: f64,
}

impl Ribbons {
    /// So many areas, of each river the widest first, with so many islands in all of them.
    pub(super) fn areas(self, areas: Amount, islands: Amount, seed: u64, window: PlanBox) -> Vec<Shape> {
        let rivers = areas.decals.div_ceil(self.levels);
        let scatter = Scatter::new(rivers, seed, window);
        let hash = |kind: u64, number: usize| scramble(seed ^ scramble(kind ^ (number as u64) << 3));
        let vertices = apportion(areas.vertices, areas.decals, 4, |area| 0.4 + unit(hash(1, area)));
        let of_area = apportion(islands.decals, areas.decals, 0, |area| vertices[area] as f64);
        let of_island = apportion(islands.vertices, islands.decals, 3, |island| 0.3 + unit(hash(2, island)));
        let ends = of_area.iter().scan(0, |end, islands| {
            *end += islands;
            Some(*end)
        });
        let ends: Vec<usize> = ends.collect();
        parallel::map_indices(areas.decals, |area| {
            let (river, level) = (area / self.levels, area % self.levels);
            let room = scatter.room();
            let ribbon = Ribbon {
                course: Course::new(scatter.place(river, room), room, hash(3, river)),
                half_length: room * HALF_LENGTH * (1.0 - 0.04 * level as f64 / self.levels as f64),
                half_width: room * self.half_width * (1.0 - 0.5 * level as f64 / self.levels as f64),
                hash: hash(4, area),
            };
            let first = ends[area] - of_area[area];
            Shape::Polygon(ribbon.rings(vertices[area], &of_island[first..ends[area]]))
        })
    }
}

/// The line that a river follows.
struct Course {
    middle: Plan,
    along: DVec2,
    room: f64,
    phases: [f64; 2],
}

impl Course {
    fn new(middle: Plan, room: f64, hash: u64) -> Self {
        let along = direction(&mut Sequence::new(hash));
        Self { middle, along, room, phases: [unit(scramble(hash ^ 1)), unit(scramble(hash ^ 2))] }
    }

    /// The point of the plan so far along the river, so far to its left. Different points come from different ones.
    fn point(&self, along: f64, left: f64) -> Plan {
        let s = along / self.room;
        let bend =
            0.17 * sin(TAU * (0.7 * s + self.phases[0])) + 0.06 * sin(TAU * (1.9 * s + self.phases[1]));
        self.middle + self.along * along + self.along.perp() * (left + bend * self.room)
    }
}

/// A flooded area, along the river and to its left.
struct Ribbon {
    course: Course,
    half_length: f64,
    half_width: f64,
    hash: u64,
}

impl Ribbon {
    /// Half the width somewhere along the river.
    fn reach(&self, along: f64) -> f64 {
        let s = along / self.half_length;
        self.half_width * (0.3 + 0.7 * (1.0 - s * s))
    }

    fn rings(&self, vertices: usize, islands: &[usize]) -> Vec<Vec<Plan>> {
        let mut rings = Vec::with_capacity(1 + islands.len());
        rings.push(self.banks(vertices));
        let (size, places) = self.places(islands.len());
        for (number, vertices) in islands.iter().enumerate() {
            let middle = places[number * places.len() / islands.len()];
            let mut ring =
                shore(middle, 0.45 * size, *vertices, scramble(self.hash ^ (1000 + number) as u64));
            ring.reverse();
            rings.push(ring);
        }
        rings.iter_mut().flatten().for_each(|p| *p = self.course.point(p.x, p.y));
        rings
    }

    /// The right bank downstream, then the left one back.
    fn banks(&self, vertices: usize) -> Vec<Plan> {
        let bends = (vertices / 2 - 1).clamp(1, BENDS);
        let corner = |k: usize| {
            let (step, side) = if k <= bends { (k, -1.0) } else { (2 * bends + 1 - k, 1.0) };
            let along = self.half_length * (2.0 * step as f64 / bends as f64 - 1.0);
            let wide = 0.92 + 0.08 * signed(scramble(self.hash ^ k as u64));
            Plan::new(along, side * wide * self.reach(along))
        };
        let corners = 2 * bends + 2;
        let until = |k: usize| k * vertices / corners;
        let mut ring = Vec::with_capacity(vertices);
        for k in 0..corners {
            let side = (corner(k), corner((k + 1) % corners));
            jagged(
                &mut ring,
                side,
                until(k + 1) - until(k),
                ROUGHNESS,
                scramble(self.hash ^ (100 + k) as u64),
            );
        }
        ring
    }

    /// At least so many places in the middle of the ribbon, and how far they are from one another.
    fn places(&self, count: usize) -> (f64, Vec<Plan>) {
        let area = 2.0 * self.half_length * self.half_width;
        let mut size = (area / count.max(1) as f64).sqrt();
        let mut places = Vec::new();
        while places.len() < count {
            places.clear();
            let columns = (1.8 * self.half_length / size) as usize;
            for column in 0..columns {
                let along = (column as f64 + 0.5 - 0.5 * columns as f64) * size;
                let rows = (1.2 * self.reach(along) / size) as usize;
                let left = |row: usize| (row as f64 + 0.5 - 0.5 * rows as f64) * size;
                places.extend((0..rows).map(|row| Plan::new(along, left(row))));
            }
            size *= 0.93;
        }
        (size, places)
    }
}
