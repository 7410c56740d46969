//! The structure as flat arrays whose rows refer to one another by number.
//!
//! Input: the structure of quads. Output: [`Arrays`]. Refuses: more rows than can be numbered.

use super::chains::Chains;
use super::crossing::Direction;
use super::grid::GridPoint;
use super::structure::{NONE, PolylineLods, QuadClipping};
use crate::error::{Error, Result};

/// The triangle-clipping DAGs of quads as arrays. [`u32::MAX`] is the number of no row. Points are grid coordinates; posts column and row.
#[derive(Debug, Default, PartialEq)]
pub struct Arrays {
    /// Of each quad: its south-western post (2), its side, how far apart its vertices are (posts), its first row of `polylines` and how many.
    pub quads: Vec<[u32; 6]>,
    /// The chain's number and its id, the first row of `quad_clippings` and how many.
    pub polylines: Vec<[u32; 4]>,
    /// The number in the chain of the first vertex; the first row and how many of `vertices`, of `crossings`, of `triangle_clippings`.
    pub quad_clippings: Vec<[u32; 7]>,
    /// Apex, left, right and decision vertex (2 each); the first row of `vertices` and the one after the last; the rows of `crossings` where it is
    /// entered and left; the rows of `next[0]`, `next[1]`, the parent, the finest exit descendant.
    pub triangle_clippings: Vec<[u32; 16]>,
    /// Vertices of chains.
    pub vertices: Vec<GridPoint>,
    /// Where chains cross edges of smallest triangles.
    pub crossings: Vec<GridPoint>,
    /// Which way the edge of a row of `crossings` runs: 0 south to north, 1 west to east, 2 south-west to north-east, 3 north-west to
    /// south-east.
    pub directions: Vec<u8>,
}

impl Arrays {
    /// Of quads, in this order, and the chains that they were made of.
    ///
    /// # Errors
    /// When an array has more rows than can be numbered.
    pub fn new<'a>(quads: impl IntoIterator<Item = &'a PolylineLods>, chains: &Chains) -> Result<Self> {
        let mut all = Self::default();
        for lods in quads {
            let [x, y] = lods.block.square.low;
            let (first, count) = (all.polylines.len() as u32, lods.polylines.len() as u32);
            all.quads.push([x, y, lods.block.square.side, lods.block.stride, first, count]);
            for line in &lods.polylines {
                let id = chains.all()[line.chain as usize].id;
                let first = all.quad_clippings.len() as u32;
                all.polylines.push([line.chain, id, first, line.quad_clippings.len() as u32]);
                line.quad_clippings.iter().for_each(|quad| all.add(quad));
            }
        }
        let rows = [all.triangle_clippings.len(), all.vertices.len(), all.crossings.len()];
        let most = rows.into_iter().max().unwrap_or(0);
        if most < NONE as usize {
            return Ok(all);
        }
        let what =
            format!("the triangle-clipping DAG has {most} rows in one array, more than can be numbered");
        Err(Error::unsupported(what).help("ask for no structures, or draw fewer lines"))
    }

    fn add(&mut self, quad: &QuadClipping) {
        let [vertices, crossings, clippings] =
            [self.vertices.len(), self.crossings.len(), self.triangle_clippings.len()].map(|n| n as u32);
        let [vertex_count, crossing_count, clipping_count] =
            [quad.vertices.len(), quad.crossings.len(), quad.triangle_clippings.len()].map(|n| n as u32);
        self.quad_clippings.push([
            quad.first_vertex,
            vertices,
            vertex_count,
            crossings,
            crossing_count,
            clippings,
            clipping_count,
        ]);
        self.vertices.extend(&quad.vertices);
        self.crossings.extend(quad.crossings.iter().map(|crossing| crossing.at));
        self.directions.extend(quad.crossings.iter().map(|crossing| match crossing.direction {
            Direction::Column => 0,
            Direction::Row => 1,
            Direction::Rising => 2,
            Direction::Falling => 3,
        }));
        let row = |first: u32, number: Option<u32>| number.map_or(NONE, |number| first + number);
        self.triangle_clippings.extend(quad.triangle_clippings.iter().map(|clipping| {
            let [apex, left, right] = clipping.triangle.corners();
            let decision = clipping.decision_vertex;
            let range = clipping.vertices();
            let [entrance, exit] = clipping.crossings().map(|number| row(crossings, number));
            let [next, other] = clipping.next().map(|number| row(clippings, number));
            [
                apex[0],
                apex[1],
                left[0],
                left[1],
                right[0],
                right[1],
                decision[0],
                decision[1],
                vertices + range.start as u32,
                vertices + range.end as u32,
                entrance,
                exit,
                next,
                other,
                row(clippings, clipping.parent()),
                clippings + clipping.finest_exit_descendant,
            ]
        }));
    }
}
