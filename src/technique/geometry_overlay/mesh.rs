//! The mesh in use as the triangle clippings see it: quads, vertices, posts.
//!
//! Input: the terrain, and what of it a view shows. Output: [`MeshInUse`]. Refuses: nothing.

use crate::math;
use crate::raster::{Lattice, TileView};
use crate::scene::Posts;
use crate::space::{Plan, ViewFrame, World};
use crate::terrain::lod::{CELLS, LodMesh, Post, Quad, QuadInUse, RightTriangle};
use crate::terrain::{Bounds, Grid, Mesh};
use glam::{DVec2, DVec3};

/// No line is drawn farther beside the picture: the guard band clips there.
const FARTHEST: f64 = 65_536.0;

/// Between the plan and columns and rows of posts (which need not be whole).
#[derive(Debug, Clone, Copy)]
pub(super) struct GridMap {
    first: Plan,
    east: DVec2,
    north: DVec2,
}

impl GridMap {
    pub(super) fn new(posts: &Posts) -> Self {
        Self { first: posts.first, east: posts.east(), north: posts.north() }
    }

    /// Where a plan point lies among the posts, rounded: what is cut at triangles is the line through these points.
    pub(super) fn grid_from_plan(&self, at: Plan) -> [f64; 2] {
        let from = at - self.first;
        let area = self.east.perp_dot(self.north);
        [from.perp_dot(self.north) / area, self.east.perp_dot(from) / area]
    }

    /// The point of space at a place among the posts and a height.
    pub(super) fn world_from_grid(&self, [column, row, height]: [f64; 3]) -> World {
        let at = self.first + (self.east * column + self.north * row);
        World::new(at.x, at.y, height)
    }
}

/// What a view shows of a grid.
#[derive(Debug, Clone, Copy)]
pub(super) struct MeshInUse<'m> {
    grid: &'m Grid,
    /// The lowest and the highest that it comes.
    heights: (f64, f64),
    /// `None`: every post is a vertex.
    lod: Option<&'m LodMesh>,
}

impl<'m> MeshInUse<'m> {
    /// Of a mesh of the posts of a grid; `None` of another.
    pub(super) fn of(full: &'m Mesh, shown: &'m Mesh) -> Option<Self> {
        let Mesh::Grid(grid) = full else { return None };
        let lod = if let Mesh::Lod(lod) = shown { Some(&**lod) } else { None };
        Some(Self { grid, heights: full.heights()?, lod })
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

    /// The height of a post; NaN where there is none.
    pub(super) fn height(&self, [column, row]: Post) -> f64 {
        let posts = self.grid.posts();
        let (column, row) = (column as usize, row as usize);
        if column < posts.columns() && row < posts.rows() {
            posts.heights()[row * posts.columns() + column]
        } else {
            f64::NAN
        }
    }

    /// Which way a cell of the grid is split.
    pub(super) fn splits_sw_ne(&self, [column, row]: [u32; 2]) -> bool {
        self.grid.splits_sw_ne(column as usize, row as usize)
    }

    /// The quads in use whose lines the view may see, in a fixed order: lines reach so many pixels beside themselves, at most
    /// [`FARTHEST`].
    pub(super) fn quads(&self, view: &ViewFrame, reach_px: f64) -> Vec<QuadInUse> {
        let posts = self.grid.posts();
        let last = [posts.columns() - 1, posts.rows() - 1];
        let every = || {
            let [columns, rows] = last.map(|cells| cells.div_ceil(CELLS as usize) as u32);
            let quads = (0..rows).flat_map(move |y| (0..columns).map(move |x| Quad { level: 0, x, y }));
            quads.map(|quad| QuadInUse { quad, data: quad }).collect()
        };
        let all = self.lod.map_or_else(every, |lod| lod.quads().to_vec());
        let lattice = Lattice::centres(view, math::min(reach_px, FARTHEST).ceil() as usize + 1);
        let whole = TileView::new(view, &lattice, (0, 0), lattice.columns.max(lattice.rows));
        let (map, heights) = (GridMap::new(posts), self.heights);
        let is_seen = |of: &QuadInUse| {
            let [low, high] = of.quad.corners();
            let half = [0, 1].map(|k| f64::from(high[k] - low[k]) / 2.0);
            let middle = [0, 1].map(|k| (f64::from(low[k]) + f64::from(high[k])) / 2.0);
            let bounds = Bounds {
                center: map.world_from_grid([middle[0], middle[1], (heights.0 + heights.1) / 2.0]),
                axes: [
                    (posts.east() * half[0]).extend(0.0),
                    (posts.north() * half[1]).extend(0.0),
                    DVec3::Z * ((heights.1 - heights.0) / 2.0),
                ],
            };
            whole.reach_of(&bounds).is_some()
        };
        all.into_iter().filter(is_seen).collect()
    }
}
