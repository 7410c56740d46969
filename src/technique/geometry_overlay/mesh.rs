//! The mesh in use as the triangle clippings see it: quads, vertices, posts.
//!
//! Input: the terrain, and what of it a view shows. Output: [`MeshInUse`], of its triangles the [`Ground`]. Refuses: nothing.

use super::dag::{Crossing, GridPoint, Plane, QuadClipping, TriangleClipping, halves_of_cell};
use crate::math;
use crate::raster::{Lattice as Samples, TileView};
use crate::scene::Posts;
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
                all.extend(points.map(|(at, height)| over_plane(posts, at, height)));
            }
            Lattice::Globe(_) => {
                let points = of.points(clipping, |post| self.in_space(post), |corner| !corner.is_nan());
                all.extend(points.map(|(_, at)| World::from(at)));
            }
        }
    }

    /// Where a post of a globe stands; NaN where there is none.
    fn in_space(&self, post: Post) -> DVec3 {
        match self.lattice.height(post) {
            height if height.is_nan() => DVec3::NAN,
            _ => self.lattice.vertex(post).world.to_vec(),
        }
    }

    /// The plane of a triangle in use; `None` over a hole.
    pub(super) fn ground(&self, triangle: &RightTriangle) -> Option<Ground<'_>> {
        match &self.lattice {
            Lattice::Plane(grid) => {
                let heights = Plane::new(*triangle, |post| self.lattice.height(post));
                let is_there = heights.corners().iter().all(|height| !height.is_nan());
                is_there.then(|| Ground::Heights(grid.posts(), heights, triangle.corners()))
            }
            Lattice::Globe(_) => {
                let places = Plane::new(*triangle, |post| self.in_space(post));
                places.corners().iter().all(|at| !at.is_nan()).then_some(Ground::Space(places))
            }
        }
    }

    /// Calls `visit` with the triangles in use of a quad, those of holes too. At a pole a triangle of two corners there is a side, and none.
    pub(super) fn for_each_triangle(&self, quad: Quad, visit: &mut dyn FnMut(&RightTriangle)) {
        let is_side = |triangle: &RightTriangle| {
            let [south, north] = self.lattice.poles();
            let last = self.lattice.size()[1] as u32 - 1;
            let is_at_pole = |post: &Post| south && post[1] == 0 || north && post[1] == last;
            triangle.corners().iter().filter(|post| is_at_pole(post)).count() > 1
        };
        let mut visit = |triangle: &RightTriangle| {
            if !is_side(triangle) {
                visit(triangle);
            }
        };
        if self.lod.is_some() {
            return quad.roots().iter().for_each(|root| self.for_each_below(root, &mut visit));
        }
        let ([low, high], last) = (quad.corners(), self.lattice.size().map(|count| count as u32 - 1));
        for row in low[1]..high[1].min(last[1]) {
            for column in low[0]..high[0].min(last[0]) {
                let cell = [column, row];
                halves_of_cell(cell, 1, self.splits_sw_ne(cell)).iter().for_each(&mut visit);
            }
        }
    }

    /// Those that a triangle is split into.
    fn for_each_below(&self, triangle: &RightTriangle, visit: &mut dyn FnMut(&RightTriangle)) {
        let is_split = triangle.middle().is_some_and(|middle| self.has_vertex(middle));
        match triangle.halves().filter(|_| is_split) {
            Some(halves) => halves.iter().for_each(|half| self.for_each_below(half, visit)),
            None if self.is_drawn(triangle) => visit(triangle),
            None => {}
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

/// The plane of a triangle of the ground.
pub(super) enum Ground<'m> {
    /// Its heights, over a plane.
    Heights(&'m Posts, Plane<f64>, [Post; 3]),
    /// Its places in space, on a globe.
    Space(Plane<DVec3>),
}

impl Ground<'_> {
    /// A point of it.
    pub(super) fn at(&self, point: GridPoint) -> World {
        match self {
            Self::Heights(posts, heights, _) => over_plane(posts, point, heights.at(point)),
            Self::Space(places) => World::from(places.at(point)),
        }
    }

    /// A corner of it, 0 being the apex.
    pub(super) fn corner(&self, corner: usize) -> World {
        match self {
            Self::Heights(posts, heights, corners) => {
                over_plane(posts, corners[corner].map(f64::from), heights.corners()[corner])
            }
            Self::Space(places) => World::from(places.corners()[corner]),
        }
    }

    /// A point of one of its edges: the same for both triangles that have the edge.
    pub(super) fn on_edge(&self, crossing: &Crossing) -> Option<World> {
        match self {
            Self::Heights(posts, heights, _) => {
                Some(over_plane(posts, crossing.at, heights.on_edge(crossing)?))
            }
            Self::Space(places) => places.on_edge(crossing).map(World::from),
        }
    }
}

/// The point of so much height at a place among the posts of a plane.
fn over_plane(posts: &Posts, [column, row]: GridPoint, height: f64) -> World {
    let at = posts.first + (posts.east() * column + posts.north() * row);
    World::new(at.x, at.y, height)
}
