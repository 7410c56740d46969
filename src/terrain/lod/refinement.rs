//! Which posts are vertices, and which quads are divided: what a split needs is split too, so that there are no cracks.
//!
//! Input: posts that shall be vertices, which quads are not there. Output: [`Refinement`]. Refuses, silently, a vertex that is not available, and
//! every one that would need it (Wartell et al. 2003, 3.2.1: a mesh of borrowed vertices).
//!
//! A vertex halves the longest side of two triangles, which are there only where their right angles are vertices (Lindstrom et al. 1996: the
//! vertices that it depends on). It also divides all coarser quads that hold it, and a divided quad's quarters have their corners: a quad that is
//! drawn is drawn by whole triangles, of vertices no finer than its own. All that a vertex needs is of a higher level, or of the same level
//! and nearer to the middle of a square: the recursion ends.

use super::extent::Extent;
use super::quad::{Quad, QuadInUse};
use super::right_triangle::Post;
use super::vertices::Vertices;
use crate::math;

/// Which quads' vertices are not there.
#[derive(Debug, Clone, Copy)]
struct Borrowing {
    root: u32,
    share: f64,
}

impl Borrowing {
    /// Whether a quad's own vertices are there: those of the largest are, those below a quad that is not there are not.
    fn is_there(&self, quad: Quad) -> bool {
        let number = u64::from(quad.x) << 32 | u64::from(quad.y);
        let hash = math::scramble(math::scramble(u64::from(quad.level)) ^ number);
        // The upper 53 bits, as a number from 0 to 1.
        let is_kept = || (hash >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0) >= self.share;
        quad.level >= self.root || (is_kept() && self.is_there(quad.parent()))
    }
}

/// A set of quads.
#[derive(Debug)]
struct Quads {
    /// Columns of each level, and its quads.
    levels: Vec<(u32, Vec<bool>)>,
}

impl Quads {
    fn none(extent: &Extent) -> Self {
        let levels = (0..=extent.root).map(|level| {
            let [columns, rows] = extent.cells(level + super::CELLS.trailing_zeros());
            (columns, vec![false; columns as usize * rows as usize])
        });
        Self { levels: levels.collect() }
    }

    fn of(&mut self, quad: Quad) -> &mut bool {
        let (columns, quads) = &mut self.levels[quad.level as usize];
        &mut quads[quad.y as usize * *columns as usize + quad.x as usize]
    }

    fn contains(&self, quad: Quad) -> bool {
        let (columns, quads) = &self.levels[quad.level as usize];
        quads[quad.y as usize * *columns as usize + quad.x as usize]
    }
}

/// What is known of what may be a vertex, where some quads are not there.
#[derive(Debug)]
struct Available {
    borrowing: Borrowing,
    vertices: [Vertices; 2],
    quads: [Quads; 2],
}

/// Vertices and divided quads that grow.
#[derive(Debug)]
pub(super) struct Refinement {
    extent: Extent,
    vertices: Vertices,
    divided: Quads,
    available: Option<Box<Available>>,
}

impl Refinement {
    /// The two largest triangles; a share of quads is not there.
    pub fn new(extent: Extent, borrow: f64) -> Self {
        let available = (borrow > 0.0).then(|| {
            Box::new(Available {
                borrowing: Borrowing { root: extent.root, share: borrow },
                vertices: [Vertices::none(extent), Vertices::none(extent)],
                quads: [Quads::none(&extent), Quads::none(&extent)],
            })
        });
        let mut vertices = Vertices::none(extent);
        let [[west, south], [east, north]] = extent.root().corners();
        for corner in [[west, south], [east, south], [west, north], [east, north]] {
            vertices.insert(corner);
        }
        Self { extent, vertices, divided: Quads::none(&extent), available }
    }

    /// Makes a post a vertex, and all that it needs; returns whether they are available.
    pub fn add(&mut self, post: Post) -> bool {
        if self.vertices.contains(post) {
            return true;
        }
        let is_available = self.is_available(post);
        if is_available {
            self.insert(post);
        }
        is_available
    }

    fn insert(&mut self, post: Post) {
        if !self.vertices.insert(post) {
            return;
        }
        let extent = self.extent;
        extent.apexes(post).for_each(|apex| self.insert(apex));
        finer_than(&extent, post).for_each(|quad| self.divide(quad));
    }

    fn divide(&mut self, quad: Quad) {
        if std::mem::replace(self.divided.of(quad), true) {
            return;
        }
        if quad.level < self.extent.root {
            self.divide(quad.parent());
        }
        let extent = self.extent;
        corners_of_quarters(&extent, quad).for_each(|corner| self.insert(corner));
    }

    /// Whether a post and all that it needs may be vertices.
    fn is_available(&mut self, post: Post) -> bool {
        self.available.as_mut().is_none_or(|available| available.vertex(&self.extent, post))
    }

    /// The vertices.
    pub fn vertices(&self) -> &Vertices {
        &self.vertices
    }

    /// The vertices alone.
    pub fn into_vertices(self) -> Vertices {
        self.vertices
    }

    /// The quads that are drawn, along the curve that runs through a quarter before the next.
    pub fn quads(&self) -> Vec<QuadInUse> {
        let mut all = Vec::new();
        self.collect(self.extent.root(), &mut all);
        all
    }

    fn collect(&self, quad: Quad, all: &mut Vec<QuadInUse>) {
        if !self.extent.holds_quad(quad) {
            return;
        }
        match quad.children().filter(|_| self.divided.contains(quad)) {
            Some(children) => children.into_iter().for_each(|child| self.collect(child, all)),
            None => all.push(QuadInUse { quad, data: self.data_of(quad) }),
        }
    }

    /// The quad itself, or the nearest above it that is there.
    fn data_of(&self, quad: Quad) -> Quad {
        match &self.available {
            Some(available) if !available.borrowing.is_there(quad) => self.data_of(quad.parent()),
            _ => quad,
        }
    }
}

impl Available {
    fn vertex(&mut self, extent: &Extent, post: Post) -> bool {
        let [possible, impossible] = &self.vertices;
        if possible.contains(post) || impossible.contains(post) {
            return possible.contains(post);
        }
        let level = extent.level_of(post);
        let is_possible = level > extent.root
            || (extent.quads_at(level, post).all(|quad| self.borrowing.is_there(quad))
                && extent.apexes(post).all(|apex| self.vertex(extent, apex))
                && finer_than(extent, post).all(|quad| self.quad(extent, quad)));
        self.vertices[usize::from(!is_possible)].insert(post);
        is_possible
    }

    /// Whether a quad may be divided.
    fn quad(&mut self, extent: &Extent, quad: Quad) -> bool {
        let [possible, impossible] = &self.quads;
        if possible.contains(quad) || impossible.contains(quad) {
            return possible.contains(quad);
        }
        let is_possible = (quad.level >= extent.root || self.quad(extent, quad.parent()))
            && corners_of_quarters(extent, quad).all(|corner| self.vertex(extent, corner));
        *self.quads[usize::from(!is_possible)].of(quad) = true;
        is_possible
    }
}

/// The smallest quads that a vertex divides: it is finer than theirs.
fn finer_than(extent: &Extent, post: Post) -> impl Iterator<Item = Quad> {
    let level = extent.level_of(post) + 1;
    (level <= extent.root).then(|| extent.quads_at(level, post)).into_iter().flatten()
}

/// The corners of a quad's quarters that are no corners of its own; those of quarters that reach into the grid.
fn corners_of_quarters(extent: &Extent, quad: Quad) -> impl Iterator<Item = Post> {
    let [[west, south], [east, north]] = quad.corners();
    let [x, y] = [(west + east) / 2, (south + north) / 2];
    let last = extent.last;
    let around = [
        ([x, y], [west, south]),
        ([x, south], [west, south]),
        ([west, y], [west, south]),
        ([x, north], [west, y]),
        ([east, y], [x, south]),
    ];
    around.into_iter().filter(move |(_, low)| low[0] < last[0] && low[1] < last[1]).map(|(corner, _)| corner)
}
