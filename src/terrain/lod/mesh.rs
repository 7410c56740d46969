//! The level-of-detail mesh of a view.
//!
//! Input: the posts of a grid or a globe, which of them are vertices. Output: [`LodMesh`]. Refuses: nothing; it may have no triangle.

use super::extent::Extent;
use super::quad::QuadInUse;
use super::refinement::Refinement;
use super::right_triangle::{Post, RightTriangle};
use super::vertices::{Numbered, Vertices};
use crate::space::{Plan, PlanBox};
use crate::terrain::{Bounds, Lattice, Node, SurfaceVertex, Tin};

/// How far a mesh is from the full surface, over the triangles that its view may see.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Deviation {
    /// No more than so many metres: up or down, on a globe in any direction.
    pub metres: f64,
    /// No more than so many pixels, of their size where each triangle comes nearest to the eye; infinite where the eye may be in one.
    pub pixels: f64,
    /// Triangles that are left out because some of the posts in them are missing, and some are not: larger holes than the full surface has.
    pub left_out: u32,
}

/// A restricted quadtree triangulation of a grid or a globe (Wartell et al. 2003, 2.1): of its posts those that a view needs.
#[derive(Debug, Clone)]
pub struct LodMesh {
    tin: Tin,
    /// The post of each vertex.
    posts: Vec<Post>,
    lattice: Lattice,
    vertices: Vertices,
    quads: Vec<QuadInUse>,
    /// Sorted.
    left_out: Vec<RightTriangle>,
    deviation: Deviation,
}

impl LodMesh {
    /// The mesh of a refinement's triangles, of which `collected` has those that are drawn.
    pub(super) fn new(
        lattice: &Lattice,
        refinement: Refinement,
        collected: Collected,
        deviation: Deviation,
    ) -> Self {
        let Collected { posts, at_poles, triangles, mut left_out } = collected;
        left_out.sort_unstable();
        let mut vertices: Vec<SurfaceVertex> = posts.iter().map(|post| lattice.vertex(*post)).collect();
        for (vertex, columns) in at_poles {
            if let Lattice::Globe(globe) = lattice {
                vertices[vertex as usize] = globe.pole_between(posts[vertex as usize][1], columns);
            }
        }
        let tin = Tin::in_order(vertices, triangles);
        let quads = refinement.quads();
        Self {
            tin,
            posts,
            lattice: lattice.clone(),
            vertices: refinement.into_vertices(),
            quads,
            left_out,
            deviation,
        }
    }

    /// Its triangles.
    pub fn tin(&self) -> &Tin {
        &self.tin
    }

    /// The posts that it is a mesh of.
    pub(in crate::terrain) fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// Whether a post is enabled (3.2.1): the triangles whose longest side it halves are split. Posts beyond the grid may be.
    #[inline]
    pub fn has_vertex(&self, post: Post) -> bool {
        self.vertices.contains(post)
    }

    /// The quads that are drawn, along the curve that runs through a quarter before the next.
    pub fn quads(&self) -> &[QuadInUse] {
        &self.quads
    }

    /// The post that a vertex is.
    ///
    /// # Panics
    /// When there is no such vertex.
    #[inline]
    pub fn post_of(&self, vertex: u32) -> Post {
        self.posts[vertex as usize]
    }

    /// A triangle as one of the hierarchy.
    ///
    /// # Panics
    /// When there is no such triangle.
    #[inline]
    pub fn right_triangle(&self, id: u32) -> RightTriangle {
        let [apex, left, right] = self.tin.triangles()[id as usize].map(|vertex| self.post_of(vertex));
        RightTriangle { apex, left, right }
    }

    /// Whether a triangle that is not split, by its [vertices](Self::has_vertex), is drawn: holes are not, nor what they lie in.
    pub fn is_drawn(&self, triangle: &RightTriangle) -> bool {
        self.left_out.binary_search(triangle).is_err()
    }

    /// How far it is from the full surface.
    pub fn deviation(&self) -> Deviation {
        self.deviation
    }

    /// The box around a node of its triangles; `None` where there is no triangle.
    #[inline]
    pub(in crate::terrain) fn bounds(&self, node: Node) -> Option<Bounds> {
        (!self.tin.triangles().is_empty()).then(|| self.tin.bounds(node))
    }

    /// The rectangle of the plan around a node's triangles; `None` where there is no triangle.
    pub(in crate::terrain) fn plan_of(&self, node: Node) -> Option<PlanBox> {
        (!self.tin.triangles().is_empty()).then(|| self.tin.plan_of(node))
    }

    /// The height over a plan point; `None` beside its triangles.
    pub(in crate::terrain) fn height_at(&self, at: Plan) -> Option<f64> {
        if self.tin.triangles().is_empty() { None } else { self.tin.height_at(at) }
    }

    /// Bytes held, without the grid.
    pub(in crate::terrain) fn bytes(&self) -> usize {
        self.tin.bytes()
            + size_of_val(&self.posts[..])
            + self.vertices.bytes()
            + size_of_val(&self.quads[..])
            + size_of_val(&self.left_out[..])
    }
}

/// The vertex is no corner so far.
const NO_NUMBER: u32 = u32::MAX;

/// Triangles that are drawn, and the posts that are their corners in the order of first use.
#[derive(Debug, Default)]
pub(super) struct Collected {
    posts: Vec<Post>,
    /// Vertices at a pole, each of one triangle, and the columns of the triangle's other corners.
    at_poles: Vec<(u32, [u32; 2])>,
    triangles: Vec<[u32; 3]>,
    /// Triangles that are neither split nor drawn.
    left_out: Vec<RightTriangle>,
}

impl Collected {
    /// Those of a set of vertices; `is_drawn` tells of each triangle that is not split whether it is drawn.
    pub fn of(extent: Extent, vertices: &Vertices, is_drawn: &mut dyn FnMut(&RightTriangle) -> bool) -> Self {
        let numbered = Numbered::new(vertices);
        let numbers = vec![NO_NUMBER; numbered.count()];
        let mut collecting =
            Collecting { extent, vertices, is_drawn, numbered, numbers, all: Self::default() };
        extent.root().roots().into_iter().for_each(|root| collecting.add(root));
        collecting.all
    }
}

/// Triangles being collected.
struct Collecting<'a> {
    extent: Extent,
    vertices: &'a Vertices,
    is_drawn: &'a mut dyn FnMut(&RightTriangle) -> bool,
    numbered: Numbered<'a>,
    /// The numbers that vertices get when a triangle first has them as a corner.
    numbers: Vec<u32>,
    all: Collected,
}

impl Collecting<'_> {
    /// Collects what a triangle is split into.
    fn add(&mut self, triangle: RightTriangle) {
        if !self.extent.holds(&triangle) {
            return;
        }
        let middle = triangle.middle().filter(|middle| self.vertices.contains(*middle));
        match middle.and_then(|_| triangle.halves()) {
            Some(halves) => halves.into_iter().for_each(|half| self.add(half)),
            None if (self.is_drawn)(&triangle) => self.draw(&triangle),
            None => self.all.left_out.push(triangle),
        }
    }

    /// Two corners at a pole are one point: such a triangle has no area, and is none.
    fn draw(&mut self, triangle: &RightTriangle) {
        let corners = triangle.corners();
        let numbers = match (0..3).filter(|k| self.extent.is_at_pole(corners[*k])).collect::<Vec<_>>()[..] {
            [] => corners.map(|post| self.number_of(post)),
            [pole] => {
                let columns = [1, 2].map(|k| corners[(pole + k) % 3][0]);
                let own = self.all.posts.len() as u32;
                self.all.posts.push(corners[pole]);
                self.all.at_poles.push((own, columns));
                let mut numbers = [own; 3];
                [1, 2].map(|k| (pole + k) % 3).iter().for_each(|&k| numbers[k] = self.number_of(corners[k]));
                numbers
            }
            _ => return,
        };
        self.all.triangles.push(numbers);
    }

    fn number_of(&mut self, post: Post) -> u32 {
        let number = &mut self.numbers[self.numbered.of(post)];
        if *number == NO_NUMBER {
            *number = self.all.posts.len() as u32;
            self.all.posts.push(post);
        }
        *number
    }
}
