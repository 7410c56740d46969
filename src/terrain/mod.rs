//! Heights -> a triangle mesh with a hierarchy of bounding boxes.
//!
//! Input: a [`Surface`] (posts of a grid or scattered points). Output: a [`Mesh`]: triangles with fixed numbers,
//! counter-clockwise in plan, and nodes whose boxes bound them, for culling. Holes are triangles that do not exist.
//! Refuses: more triangles than a `u32` can number, and points that span no triangle.

mod grid;
mod node;
mod tin;

pub use grid::Grid;
pub use node::{Bounds, Node};
pub use tin::Tin;

use crate::error::Result;
use crate::scene::{Diagonal, Surface};
use crate::space::{PlanBox, World};
use glam::DVec3;

/// "No triangle": the sky.
pub const SKY: u32 = u32::MAX;

/// The terrain as triangles.
#[derive(Debug, Clone)]
pub enum Mesh {
    /// Two triangles a cell of a grid of posts.
    Grid(Grid),
    /// Delaunay triangles over scattered points.
    Tin(Tin),
}

impl Mesh {
    /// Triangulates a surface.
    ///
    /// # Errors
    /// When there are too many triangles to number, or none.
    pub fn new(surface: Surface, diagonal: Diagonal) -> Result<Self> {
        match surface {
            Surface::Grid(posts) => Ok(Self::Grid(Grid::new(posts, diagonal)?)),
            Surface::Points(points) => Ok(Self::Tin(Tin::new(points)?)),
        }
    }

    /// The corners of triangle `id`, counter-clockwise in plan; `None` for a hole.
    ///
    /// # Panics
    /// When `id` is not below [`Mesh::triangle_ids`].
    #[inline]
    pub fn triangle(&self, id: u32) -> Option<[World; 3]> {
        match self {
            Self::Grid(grid) => grid.triangle(id),
            Self::Tin(tin) => Some(tin.triangle(id)),
        }
    }

    /// Triangles have numbers below this.
    pub fn triangle_ids(&self) -> u32 {
        match self {
            Self::Grid(grid) => grid.triangle_ids(),
            Self::Tin(tin) => tin.triangles().len() as u32,
        }
    }

    /// The rectangle that the terrain lies in.
    pub fn plan_bounds(&self) -> PlanBox {
        match self {
            Self::Grid(grid) => grid.plan_bounds(),
            Self::Tin(tin) => PlanBox::around(tin.vertices().iter().map(|v| v.plan())),
        }
    }

    /// The node that holds everything.
    pub fn root(&self) -> Node {
        let level = match self {
            Self::Grid(grid) => grid.levels() - 1,
            Self::Tin(tin) => tin.levels() - 1,
        };
        Node { level: level as u32, x: 0, y: 0 }
    }

    /// The box around a node; `None` when it holds no triangle.
    #[inline]
    pub fn bounds(&self, node: Node) -> Option<Bounds> {
        match self {
            Self::Grid(grid) => grid.bounds(node),
            Self::Tin(tin) => tin.bounds(node),
        }
    }

    /// The lowest and the highest that the terrain comes.
    pub fn heights(&self) -> (f64, f64) {
        self.bounds(self.root()).map_or((0.0, 0.0), |b| (b.center.z - b.axes[2].z, b.center.z + b.axes[2].z))
    }

    /// Calls `visit` with each child of a node above level 0.
    #[inline]
    pub fn for_each_child(&self, node: Node, visit: impl FnMut(Node)) {
        match self {
            Self::Grid(grid) => grid.for_each_child(node, visit),
            Self::Tin(tin) => tin.for_each_child(node, visit),
        }
    }
}

/// The unit normal of a triangle, pointing up; straight up for a degenerate one.
pub fn upward_normal([a, b, c]: &[World; 3]) -> DVec3 {
    let normal = (*b - *a).cross(*c - *a).try_normalize().unwrap_or(DVec3::Z);
    if normal.z < 0.0 { -normal } else { normal }
}
