//! The mesh in use as the triangle clippings see it: quads, vertices, posts.
//!
//! Input: the terrain, and what of it a view shows. Output: [`MeshInUse`]. Refuses: nothing.

use super::dag::{QuadClipping, TriangleClipping};
use crate::math;
use crate::raster::{Lattice as Samples, TileView};
use crate::space::{ViewFrame, World};
use crate::terrain::lod::{CELLS, LodMesh, Post, Quad, QuadInUse, RightTriangle};
use crate::terrain::{Lattice, Mesh};
use glam::DVec3;

/// No line is drawn farther beside the picture: the guard band clips there.
const FARTHEST: f64 = 65_536.0;

/// What a view shows of a grid or a globe.
#[derive(Debug, Clone)]
pub(super) struct MeshInUse<'m> {
    lattice: Lattice,
    /// The lowest and the highest that it comes, over the plane or above the ellipsoid.
    heights: (f64, f64),
    /// `None`: every post is a vertex.
    lod: Option<&'m LodMesh>,
}

impl<'m> MeshInUse<'m> {
    /// Of a mesh of the posts of a grid or a globe; `None` of another.
    pub(super) fn of(full: &Mesh, shown: &'m Mesh) -> Option<Self> {
        let lattice = full.lattice()?;
        let heights = full.heights().unwrap_or_else(|| lattice.heights());
        let lod = if let Mesh::Lod(lod) = shown { Some(&**lod) } else { None };
        Some(Self { lattice, heights, lod })
    }

    /// Whether the mesh has triangles of several levels.
    pub(super) fn has_levels(&self) -> bool {
        self.lod.is_some()
    }

    /// Whether a post is a vertex.
    pub(super) fn has_vertex(&self, post: Post) -> bool {
        self.lod.is_none_or(|lod| lod.has_vertex(post))
    }

    /// Whether a triangle in use is drawn.
    pub(super) fn is_drawn(&self, triangle: &RightTriangle) -> bool {
        self.lod.is_none_or(|lod| lod.is_drawn(triangle))
    }

    /// Adds the points of a clipping on its triangle's plane, in order; none over a hole.
    pub(super) fn add_points(
        &self,
        (of, clipping): (&QuadClipping, &TriangleClipping),
        all: &mut Vec<World>,
    ) {
        match &self.lattice {
            Lattice::Plane(grid) => {
                let posts = grid.posts();
                let points = of.points(clipping, |post| self.lattice.height(post), |height| !height.is_nan());
                all.extend(points.map(|([column, row], height)| {
                    let at = posts.first + (posts.east() * column + posts.north() * row);
                    World::new(at.x, at.y, height)
                }));
            }
            Lattice::Globe(_) => {
                let corner = |post: Post| match self.lattice.height(post) {
                    height if height.is_nan() => DVec3::NAN,
                    _ => self.lattice.vertex(post).world.to_vec(),
                };
                let points = of.points(clipping, corner, |corner| !corner.is_nan());
                all.extend(points.map(|(_, at)| World::from(at)));
            }
        }
    }

    /// Which way a cell is split.
    pub(super) fn splits_sw_ne(&self, cell: [u32; 2]) -> bool {
        self.lattice.splits_sw_ne(cell)
    }

    /// The quads in use whose lines the view may see, in a fixed order: lines reach so many pixels beside themselves, at most
    /// [`FARTHEST`].
    pub(super) fn quads(&self, view: &ViewFrame, reach_px: f64) -> Vec<QuadInUse> {
        let last = self.lattice.size().map(|count| count - 1);
        let every = || {
            let [columns, rows] = last.map(|cells| cells.div_ceil(CELLS as usize) as u32);
            let quads = (0..rows).flat_map(move |y| (0..columns).map(move |x| Quad { level: 0, x, y }));
            quads.map(|quad| QuadInUse { quad, data: quad }).collect()
        };
        let all = self.lod.map_or_else(every, |lod| lod.quads().to_vec());
        let lattice = Samples::centres(view, math::min(reach_px, FARTHEST).ceil() as usize + 1);
        let whole = TileView::new(view, &lattice, (0, 0), lattice.columns.max(lattice.rows));
        let is_seen = |of: &QuadInUse| {
            whole.reach_of(&self.lattice.bounds_of(of.quad.corners(), self.heights)).is_some()
        };
        all.into_iter().filter(is_seen).collect()
    }
}
