//! The structures, named as the paper's (3.1).
//!
//! Input: heights of posts, to have points in space. Output: [`PolylineLods`] and what it is made of. Refuses: nothing.

use super::crossing::Crossing;
use super::grid::{Block, GridPoint};
use super::plane::Plane;
use crate::terrain::lod::{Post, RightTriangle};
use std::ops::{Add, Mul, Range, Sub};

/// The number of no clipping and of no crossing.
pub(super) const NONE: u32 = u32::MAX;

/// The polylines that cross a quad (`polyline_LODs_t`).
#[derive(Debug, PartialEq)]
pub struct PolylineLods {
    /// The quad's block of vertices.
    pub block: Block,
    /// Those of which something lies in the quad, in the chains' order.
    pub polylines: Vec<PolylineLod>,
}

/// A polyline that crosses a quad (`polyline_LOD_t`).
#[derive(Debug, PartialEq)]
pub struct PolylineLod {
    /// Its number among the chains.
    pub chain: u32,
    /// What of it lies in the quad, in its order.
    pub quad_clippings: Vec<QuadClipping>,
}

/// What of a polyline lies in a quad from an entrance (or its start) to an exit, or its end (`quad_clipping_t`).
#[derive(Debug, PartialEq)]
pub struct QuadClipping {
    /// The number, in the chain, of the first of its vertices.
    pub first_vertex: u32,
    /// Its vertices, in grid coordinates: the projectors of 3.3.
    pub vertices: Vec<GridPoint>,
    /// Where it crosses edges of the smallest triangles, in its order; the entrance and the exit too.
    pub crossings: Vec<Crossing>,
    /// Its clippings: those of the smallest triangles first, in the order in which it visits them, then layer by layer (3.2).
    pub triangle_clippings: Vec<TriangleClipping>,
}

/// What of a polyline lies in a triangle from an entrance to an exit (`triangle_clipping_t`).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TriangleClipping {
    /// The triangle.
    pub triangle: RightTriangle,
    /// If this is a vertex of the mesh in use, the first of two `next` follows, otherwise the second. Without a second it says nothing.
    pub decision_vertex: Post,
    /// Of the quad clipping's vertices, the first and the one after the last.
    pub(super) vertices: [u32; 2],
    /// Entrance and exit among the quad clipping's crossings; [`NONE`] where the polyline starts or ends.
    pub(super) crossings: [u32; 2],
    pub(super) next: [u32; 2],
    pub(super) parent: u32,
    /// The clipping of a smallest triangle that it ends with: whose exit edge lies in its own, or that holds the polyline's end. Of a smallest
    /// triangle's, itself.
    pub finest_exit_descendant: u32,
}

/// A number that may be none's.
fn some(number: u32) -> Option<u32> {
    (number != NONE).then_some(number)
}

impl TriangleClipping {
    /// The clippings of which one follows (`nextTriangle`): the first unless the second is there and [`Self::decision_vertex`] is no vertex
    /// of the mesh in use.
    #[inline]
    pub fn next(&self) -> [Option<u32>; 2] {
        self.next.map(some)
    }

    /// The clipping of the triangle that this one is a half of; `None` in the coarsest layer.
    #[inline]
    pub fn parent(&self) -> Option<u32> {
        some(self.parent)
    }

    /// Which of the quad clipping's vertices it has.
    pub fn vertices(&self) -> Range<usize> {
        self.vertices[0] as usize..self.vertices[1] as usize
    }

    /// Its entrance and its exit among the quad clipping's crossings; `None` where the polyline starts or ends in it.
    pub fn crossings(&self) -> [Option<u32>; 2] {
        self.crossings.map(some)
    }

    /// How many points it has.
    pub fn point_count(&self) -> usize {
        self.vertices().len() + self.crossings().iter().flatten().count()
    }

    /// Goes on as far as a part of it.
    pub(super) fn take_end_of(&mut self, part: &Self) {
        self.vertices[1] = part.vertices[1];
        self.crossings[1] = part.crossings[1];
        self.finest_exit_descendant = part.finest_exit_descendant;
    }
}

impl QuadClipping {
    /// The points of a clipping in its triangle's plane, in order: grid coordinates, and what the same combination of the corners has there that is known of
    /// posts (a height, a point of space). None where that of a corner is not there (a hole).
    ///
    /// A crossing has what the edge has there, whichever of its two triangles asks.
    pub fn points<V>(
        &self,
        clipping: &TriangleClipping,
        of: impl Fn(Post) -> V,
        is_there: impl Fn(&V) -> bool,
    ) -> impl Iterator<Item = (GridPoint, V)>
    where
        V: Copy + Add<Output = V> + Sub<Output = V> + Mul<f64, Output = V>,
    {
        let plane = Plane::new(clipping.triangle, of);
        let is_whole = plane.corners().iter().all(is_there);
        let [entrance, exit] = clipping.crossings().map(|number| {
            let crossing = self.crossings.get(number? as usize)?;
            Some((crossing.at, plane.on_edge(crossing)?))
        });
        let vertices = self.vertices[clipping.vertices()].iter().map(move |point| (*point, plane.at(*point)));
        let all = entrance.into_iter().chain(vertices).chain(exit);
        all.filter(move |_| is_whole)
    }
}
