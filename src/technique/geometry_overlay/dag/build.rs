//! The structure of a quad from polylines (3.2).
//!
//! Input: chains, a quad and its layers. Output: [`PolylineLods`]. Refuses: nothing.

use super::cells::{Cells, Layers};
use super::chains::Chains;
use super::climb::climb;
use super::grid::Block;
use super::structure::{PolylineLod, PolylineLods, QuadClipping};
use super::trace::trace;

impl PolylineLods {
    /// Cuts chains at the triangles of a quad (3.2).
    pub fn new(block: Block, layers: Layers, chains: &Chains) -> Self {
        let cells = Cells::new(block, layers);
        let count = match layers {
            Layers::All => 2 * (block.square.side / block.stride).ilog2() + 1,
            Layers::Smallest(_) => 1,
        };
        let mut polylines: Vec<PolylineLod> = Vec::new();
        for (chain, start, points) in chains.near(block.square) {
            let sections = trace(&cells, points);
            let clippings = sections.into_iter().map(|section| {
                let vertices = section.triangles.last().map_or(0, |(_, end)| *end as usize);
                QuadClipping {
                    first_vertex: start + section.first as u32,
                    vertices: points[section.first..][..vertices].to_vec(),
                    triangle_clippings: climb(&section, count),
                    crossings: section.crossings,
                }
            });
            let clippings: Vec<QuadClipping> = clippings.collect();
            match polylines.last_mut() {
                Some(last) if last.chain == chain => last.quad_clippings.extend(clippings),
                _ if clippings.is_empty() => {}
                _ => polylines.push(PolylineLod { chain, quad_clippings: clippings }),
            }
        }
        Self { block, polylines }
    }
}
