//! Lakes with islands, and closed borders: shores around places of their own.

use super::super::apportion::{apportion, uneven};
use super::super::jagged::shore;
use super::super::random::{scramble, unit};
use super::scatter::Scatter;
use crate::parallel;
use crate::scene::Shape;
use crate::scene_file::Amount;
use crate::space::{Plan, PlanBox};
use glam::DVec2;

/// Islands of a lake that has some.
const ISLANDS: usize = 4;

/// So many lakes, as large as they have vertices; the largest have the islands.
pub(super) fn lakes(lakes: Amount, islands: Amount, seed: u64, window: PlanBox) -> Vec<Shape> {
    let scatter = Scatter::new(lakes.decals, seed, window);
    let hash = |kind: u64, number: usize| scramble(seed ^ scramble(kind ^ (number as u64) << 3));
    let vertices = apportion(lakes.vertices, lakes.decals, 3, |lake| uneven(unit(hash(1, lake))));
    let of_islands = apportion(islands.vertices, islands.decals, 3, |island| 0.3 + unit(hash(2, island)));
    let most = vertices.iter().copied().max().unwrap_or(1);
    let mut by_size: Vec<usize> = (0..lakes.decals).collect();
    by_size.sort_by_key(|lake| (std::cmp::Reverse(vertices[*lake]), *lake));
    let mut rank = vec![0; lakes.decals];
    by_size.iter().enumerate().for_each(|(at, lake)| rank[*lake] = at);
    // All lakes together have room for all of them, the last one for what is left.
    let a_lake = ISLANDS.max(islands.decals.div_ceil(lakes.decals.max(1)));
    parallel::map_indices(lakes.decals, |lake| {
        let reach = 0.95 * scatter.room() * (vertices[lake] as f64 / most as f64);
        let middle = scatter.place(lake, reach);
        let mut rings = vec![shore(middle, reach, vertices[lake], hash(3, lake))];
        let first = (rank[lake] * a_lake).min(islands.decals);
        let side = (a_lake as f64).sqrt().ceil() as usize;
        let end = (first + a_lake).min(islands.decals);
        for (cell, vertices) in of_islands[first..end].iter().enumerate() {
            let at = DVec2::new((cell % side) as f64 + 0.5, (cell / side) as f64 + 0.5) / side as f64;
            let at = middle + (at - DVec2::splat(0.5)) * (0.66 * reach);
            let mut ring = shore(at, 0.27 * reach / side as f64, *vertices, hash(4, first + cell));
            ring.reverse();
            rings.push(ring);
        }
        Shape::Polygon(rings)
    })
}

/// Few closed lines of many vertices.
pub(super) fn borders(lines: Amount, seed: u64, window: PlanBox) -> Vec<Shape> {
    let scatter = Scatter::new(lines.decals, seed, window);
    let vertices = apportion(lines.vertices, lines.decals, 4, |_| 1.0);
    parallel::map_indices(lines.decals, |line| {
        let reach = scatter.room();
        let hash = scramble(seed ^ scramble(5 ^ (line as u64) << 3));
        let mut ring: Vec<Plan> = shore(scatter.place(line, reach), reach, vertices[line] - 1, hash);
        ring.push(ring[0]);
        Shape::Line(vec![ring])
    })
}
