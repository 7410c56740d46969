//! Heights -> a triangle mesh with a hierarchy of bounding boxes.
//!
//! Input: a [`Surface`] (posts of a grid or scattered points), or the vertices and triangles of a surface themselves. Output: a [`Mesh`]:
//! triangles with fixed numbers, how they are draped (`drape`), and nodes whose boxes bound them, for culling. Holes are triangles
//! that do not exist. Refuses: more triangles than a `u32` can number, and points that span no triangle.
//!
//! # The interface
//! A kind of terrain has numbered triangles over numbered vertices, and a tree of [`Node`]s with boxes whose leaves hold triangles. All that
//! other rooms ask for are the methods of [`Mesh`]; none of them asks which kind it is. [`Mesh`] is an enum and no trait: inner loops take
//! triangles by the million, by calls that are compiled into them, and the two ways in which they take them are the two kinds of
//! [`Leaf`]. A new kind is a file, a variant, and an arm in each method here, which the compiler asks for.

mod drape;
mod globe;
mod grid;
mod lattice;
pub mod lod;
mod tin;

pub use drape::{Drape, PlanMap, SurfaceTriangle, SurfaceVertex, TriangleDrape, upward_normal};
pub use globe::GlobeMesh;
pub use grid::Grid;
pub use lattice::Lattice;
pub use tin::Tin;

use crate::error::Result;
use crate::math;
use crate::scene::{Diagonal, Surface};
use crate::space::{Globe, Plan, PlanBox, World};
use glam::DVec3;
use lod::LodMesh;
use std::ops::Range;
use std::sync::Arc;

/// Cells a side of a grid's smallest node.
pub const BLOCK: usize = 15;

/// "No triangle": the sky.
pub const SKY: u32 = u32::MAX;

/// The terrain as triangles.
#[derive(Debug, Clone)]
pub enum Mesh {
    /// Two triangles a cell of a grid of posts.
    Grid(Arc<Grid>),
    /// Triangles over scattered points, or over vertices with plan points of their own.
    Tin(Tin),
    /// Triangles over the posts of a globe.
    Globe(Arc<GlobeMesh>),
    /// Triangles over some posts of a grid or a globe, as many as a view needs.
    Lod(Box<LodMesh>),
}

/// What a leaf of the hierarchy holds.
#[derive(Debug, Clone)]
pub enum Leaf<'a> {
    /// Cells of a regular grid: those of [`Grid::cells`].
    Cells(&'a Grid),
    /// The triangles with these numbers.
    Triangles(Range<u32>),
}

/// A node has at most so many children.
pub const MOST_CHILDREN: usize = 4;

/// A node of the hierarchy: level 0 holds triangles, higher levels hold nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Node {
    /// Height in the tree, 0 at the leaves.
    pub level: u32,
    /// Column of the node in its level.
    pub x: u32,
    /// Row of the node in its level (0 in a TIN).
    pub y: u32,
}

/// A box `center + a * axes[0] + b * axes[1] + c * axes[2]` with a, b, c in -1..=1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Its middle.
    pub center: World,
    /// Its half extents, in any direction.
    pub axes: [DVec3; 3],
}

impl Bounds {
    /// The lowest and the highest z in it: heights, where draping is vertical.
    #[inline]
    pub fn heights(&self) -> (f64, f64) {
        let [a, b, c] = self.axes.map(|axis| axis.z.abs());
        let reach = a + b + c;
        (self.center.z - reach, self.center.z + reach)
    }

    /// The rectangle of the plan straight below it, grown by the roundings of its making.
    #[inline]
    pub fn below(&self) -> PlanBox {
        let [a, b, c] = self.axes.map(|axis| axis.truncate().abs());
        let reach = a + b + c;
        let slack = 1e-9 * (reach.element_sum() + self.center.x.abs() + self.center.y.abs());
        let middle = self.center.plan();
        PlanBox { min: middle + -reach, max: middle + reach }.grown(slack)
    }
}

impl Mesh {
    /// Triangulates a surface.
    ///
    /// # Errors
    /// When there are too many triangles to number, or none.
    pub fn new(surface: Surface, diagonal: Diagonal) -> Result<Self> {
        match surface {
            Surface::Grid(posts) => Ok(Self::Grid(Arc::new(Grid::new(posts, diagonal)?))),
            Surface::Points(points) => Ok(Self::Tin(Tin::new(points)?)),
            Surface::Globe(posts) => Ok(Self::Globe(Arc::new(GlobeMesh::new(posts, diagonal)?))),
        }
    }

    /// The mesh of a surface that is given as it is: vertices, and triangles as numbers of three of them. Where each vertex lies straight over
    /// its plan point and has z up, the mesh is draped vertically, like one that was triangulated. Triangles are numbered anew, along a
    /// space-filling curve of the plan.
    ///
    /// # Errors
    /// When there is no triangle or too many, one names a vertex that is not there, a coordinate is not finite, or an up is no
    /// unit vector.
    pub fn of_surface(vertices: Vec<SurfaceVertex>, triangles: Vec<[u32; 3]>) -> Result<Self> {
        Tin::of_surface(vertices, triangles).map(Self::Tin)
    }

    /// How the mesh is draped.
    #[inline]
    pub fn drape(&self) -> Drape {
        match self {
            Self::Grid(_) => Drape::Vertical,
            Self::Tin(tin) => tin.drape(),
            Self::Globe(_) => Drape::Affine,
            Self::Lod(lod) => lod.lattice().drape(),
        }
    }

    /// The corners of triangle `id`; `None` for a hole. Those of a mesh over the plan run counter-clockwise there.
    ///
    /// # Panics
    /// When `id` is not below [`Mesh::triangle_ids`].
    #[inline]
    pub fn triangle(&self, id: u32) -> Option<[World; 3]> {
        match self {
            Self::Grid(grid) => grid.triangle(id),
            Self::Tin(tin) => Some(tin.triangle(id)),
            Self::Globe(globe) => Some(globe.tin().triangle(id)),
            Self::Lod(lod) => Some(lod.tin().triangle(id)),
        }
    }

    /// Triangle `id` and how its points get to the plan; `None` for a hole.
    ///
    /// # Panics
    /// When `id` is not below [`Mesh::triangle_ids`].
    #[inline]
    pub fn surface_triangle(&self, id: u32) -> Option<SurfaceTriangle> {
        match self {
            Self::Grid(grid) => grid.triangle(id).map(SurfaceTriangle::vertical),
            Self::Tin(tin) => Some(tin.surface_triangle(id)),
            Self::Globe(globe) => Some(globe.tin().surface_triangle(id)),
            Self::Lod(lod) => Some(lod.tin().surface_triangle(id)),
        }
    }

    /// The unit normal of triangle `id` on its upper side, as components east, north and up; `None` for a hole.
    ///
    /// # Panics
    /// When `id` is not below [`Mesh::triangle_ids`].
    #[inline]
    pub fn normal(&self, id: u32) -> Option<DVec3> {
        match self.drape() {
            Drape::Vertical => self.triangle(id).map(|triangle| upward_normal(&triangle)),
            Drape::Affine => self.surface_triangle(id).map(|triangle| triangle.normal()),
        }
    }

    /// The numbers of the corners of triangle `id`, in the order of [`Mesh::triangle`]; `None` for a hole.
    ///
    /// # Panics
    /// When `id` is not below [`Mesh::triangle_ids`].
    pub fn corners(&self, id: u32) -> Option<[u32; 3]> {
        match self {
            Self::Grid(grid) => grid.corners(id),
            Self::Tin(tin) => Some(tin.triangles()[id as usize]),
            Self::Globe(globe) => Some(globe.tin().triangles()[id as usize]),
            Self::Lod(lod) => Some(lod.tin().triangles()[id as usize]),
        }
    }

    /// The vertices of a mesh whose leaves hold [triangles](Leaf::Triangles), and all of these as numbers of three; `None` of a grid.
    pub fn numbered(&self) -> Option<(&[World], &[[u32; 3]])> {
        let tin = match self {
            Self::Grid(_) => return None,
            Self::Tin(tin) => tin,
            Self::Globe(globe) => globe.tin(),
            Self::Lod(lod) => lod.tin(),
        };
        Some((tin.vertices(), tin.triangles()))
    }

    /// The layer of triangle `id` of a level-of-detail mesh ([`lod::RightTriangle::layer`]); `None` of other meshes.
    ///
    /// # Panics
    /// When `id` is not below [`Mesh::triangle_ids`].
    pub fn layer_of(&self, id: u32) -> Option<u32> {
        if let Self::Lod(lod) = self { Some(lod.right_triangle(id).layer()) } else { None }
    }

    /// The vertices in the order of their numbers. Those that no triangle has may have no height (NaN).
    pub fn vertices(&self) -> impl Iterator<Item = SurfaceVertex> + '_ {
        let count = match self {
            Self::Grid(grid) => grid.posts().heights().len(),
            Self::Tin(tin) => tin.vertices().len(),
            Self::Globe(globe) => globe.tin().vertices().len(),
            Self::Lod(lod) => lod.tin().vertices().len(),
        };
        (0..count).map(move |number| match self {
            Self::Grid(grid) => SurfaceVertex::vertical(grid.vertex(number)),
            Self::Tin(tin) => tin.vertex(number),
            Self::Globe(globe) => globe.tin().vertex(number),
            Self::Lod(lod) => lod.tin().vertex(number),
        })
    }

    /// Triangles have numbers below this.
    pub fn triangle_ids(&self) -> u32 {
        match self {
            Self::Grid(grid) => grid.triangle_ids(),
            Self::Tin(tin) => tin.triangles().len() as u32,
            Self::Globe(globe) => globe.tin().triangles().len() as u32,
            Self::Lod(lod) => lod.tin().triangles().len() as u32,
        }
    }

    /// The rectangle of the plan that the terrain lies in.
    pub fn plan_bounds(&self) -> PlanBox {
        match self {
            Self::Grid(grid) => grid.plan_bounds(),
            Self::Globe(globe) => globe.plan_bounds(),
            Self::Lod(lod) => lod.lattice().plan_bounds(),
            Self::Tin(_) => PlanBox::around(self.vertices().map(|vertex| vertex.plan)),
        }
    }

    /// The node that holds everything.
    pub fn root(&self) -> Node {
        let level = match self {
            Self::Grid(grid) => grid.levels() - 1,
            Self::Tin(tin) => tin.levels() - 1,
            Self::Globe(globe) => globe.tin().levels() - 1,
            Self::Lod(lod) => lod.tin().levels() - 1,
        };
        Node { level: level as u32, x: 0, y: 0 }
    }

    /// The box around a node; `None` when it holds no triangle.
    #[inline]
    pub fn bounds(&self, node: Node) -> Option<Bounds> {
        match self {
            Self::Grid(grid) => grid.bounds(node),
            Self::Tin(tin) => Some(tin.bounds(node)),
            Self::Globe(globe) => Some(globe.tin().bounds(node)),
            Self::Lod(lod) => lod.bounds(node),
        }
    }

    /// A rectangle of the plan around all that a node's triangles lie over; `None` when it holds no triangle.
    pub fn plan_of(&self, node: Node) -> Option<PlanBox> {
        match self {
            Self::Grid(grid) => grid.bounds(node).map(|bounds| bounds.below()),
            Self::Tin(tin) => Some(tin.plan_of(node)),
            Self::Globe(globe) => Some(globe.tin().plan_of(node)),
            Self::Lod(lod) => lod.plan_of(node),
        }
    }

    /// The lowest and the highest that the terrain comes; `None` where draping is not vertical, so that heights are no axis of the world.
    pub fn heights(&self) -> Option<(f64, f64)> {
        let all = || self.bounds(self.root()).map_or((0.0, 0.0), |bounds| bounds.heights());
        (self.drape() == Drape::Vertical).then(all)
    }

    /// The height of the surface over a plan point of a mesh that is draped vertically; `None` beside it and in holes.
    pub fn height_at(&self, at: Plan) -> Option<f64> {
        match self {
            Self::Grid(grid) => grid.height_at(at),
            Self::Tin(tin) => tin.height_at(at),
            Self::Globe(_) => None,
            Self::Lod(lod) => lod.height_at(at),
        }
    }

    /// How far apart posts are, metres of the plan: the smaller side of the cells of a grid or a globe, whatever of it a level-of-detail mesh
    /// has; of a TIN the side of the square that two triangles cover
    /// on the average.
    pub fn resolution(&self) -> f64 {
        match self {
            Self::Grid(grid) => grid.resolution(),
            Self::Globe(globe) => globe.resolution(),
            Self::Lod(lod) => lod.lattice().resolution(),
            Self::Tin(tin) => tin.resolution(),
        }
    }

    /// The farthest that the terrain may come from a point, metres.
    pub fn farthest_from(&self, point: World) -> f64 {
        let reach = |bounds: Bounds| bounds.axes.iter().map(|axis| axis.length()).sum::<f64>();
        let farthest = |bounds: Bounds| (bounds.center - point).length() + reach(bounds);
        // The sum of a few roundings is far below this share.
        self.bounds(self.root()).map_or(0.0, |bounds| farthest(bounds) * (1.0 + 1e-9))
    }

    /// What a leaf, a node of level 0, holds.
    #[inline]
    pub fn leaf(&self, node: Node) -> Leaf<'_> {
        match self {
            Self::Grid(grid) => Leaf::Cells(grid),
            Self::Tin(tin) => Leaf::Triangles(tin.leaf(node)),
            Self::Globe(globe) => Leaf::Triangles(globe.tin().leaf(node)),
            Self::Lod(lod) => Leaf::Triangles(lod.tin().leaf(node)),
        }
    }

    /// How far plan points lie from where a map takes the same points of the world, at the middles of the triangles (there the combination of
    /// the corners is off most): the largest distance, which `distance` tells between the place of a point of the world and a plan point. A
    /// globe's map, along the normal of the ellipsoid, is curved; the smaller its triangles, the smaller is this.
    pub fn largest_deviation(&self, distance: impl Fn(World, Plan) -> f64) -> f64 {
        let middle = |[a, b, c]: [DVec3; 3]| (a + b + c) / 3.0;
        let triangles = (0..self.triangle_ids()).filter_map(|id| self.surface_triangle(id));
        let deviations = triangles.map(|triangle| {
            let at = middle(triangle.plan().map(|p| p.to_vec().extend(0.0))).truncate();
            distance(World::from(middle(triangle.world.map(World::to_vec))), Plan::from(at))
        });
        deviations.fold(0.0, |most, deviation| math::max(deviation, most))
    }

    /// The same of all triangles that the posts of a globe have, or a little more, found without making them; of another mesh the [largest](Self::largest_deviation).
    pub fn most_deviation(&self, distance: impl Fn(World, Plan) -> f64 + Sync) -> f64 {
        match self {
            Self::Globe(globe) => globe.most_deviation(distance),
            Self::Grid(_) | Self::Tin(_) | Self::Lod(_) => self.largest_deviation(distance),
        }
    }

    /// Calls `visit` with each child of a node above level 0: at most [`MOST_CHILDREN`].
    #[inline]
    pub fn for_each_child(&self, node: Node, visit: impl FnMut(Node)) {
        match self {
            Self::Grid(grid) => grid.for_each_child(node, visit),
            Self::Tin(tin) => tin.for_each_child(node, visit),
            Self::Globe(globe) => globe.tin().for_each_child(node, visit),
            Self::Lod(lod) => lod.tin().for_each_child(node, visit),
        }
    }

    /// The posts that it is a mesh of, as a lattice; `None` of scattered points and of surfaces that are given as triangles.
    pub fn lattice(&self) -> Option<Lattice> {
        match self {
            Self::Grid(grid) => Some(Lattice::Plane(Arc::clone(grid))),
            Self::Tin(_) => None,
            Self::Globe(globe) => Some(Lattice::Globe(Arc::clone(globe))),
            Self::Lod(lod) => Some(lod.lattice().clone()),
        }
    }

    /// The globe that it lies on; `None` of one over a plane.
    pub fn globe(&self) -> Option<&Globe> {
        match self {
            Self::Globe(globe) => Some(&globe.posts().globe),
            Self::Lod(lod) => match lod.lattice() {
                Lattice::Globe(globe) => Some(&globe.posts().globe),
                Lattice::Plane(_) => None,
            },
            Self::Grid(_) | Self::Tin(_) => None,
        }
    }

    /// How far a level-of-detail mesh is from all of the grid; `None`: it is all that is known of the terrain.
    pub fn deviation(&self) -> Option<lod::Deviation> {
        match self {
            Self::Grid(_) | Self::Tin(_) | Self::Globe(_) => None,
            Self::Lod(lod) => Some(lod.deviation()),
        }
    }

    /// Bytes held by the mesh and its hierarchy.
    pub fn bytes(&self) -> usize {
        match self {
            Self::Grid(grid) => grid.bytes(),
            Self::Tin(tin) => tin.bytes(),
            Self::Globe(globe) => globe.bytes(),
            Self::Lod(lod) => lod.bytes(),
        }
    }
}
