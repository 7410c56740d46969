//! Which posts are vertices, and which quads are divided: what a split needs is split too, so that there are no cracks.
//!
//! Input: posts that shall be vertices, which quads are not there. Output: [`Refinement`]. Refuses, silently, a vertex that is not available, and
//! every one that would need it (Wartell et al. 2003, 3.2.1: a mesh of borrowed vertices).
//!
//! A vertex halves the longest side of two triangles, which are there only where their right angles are vertices (Lindstrom et al. 1996: the
//! vertices that it depends on). It also divides all coarser quads that hold it, and a divided quad's quarters have their corners: a quad that is
//! drawn is drawn by whole triangles, of vertices no finer than its own. Where posts go all around a globe, a vertex of the first column is one of the last,
//! and the other way round. What is a vertex already is not asked again: the recursion ends, whatever needs whatever in a circle.

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

/// What is known of vertices where some quads are not there.
#[derive(Debug)]
struct Available {
    borrowing: Borrowing,
    /// Posts that cannot be vertices, as far as that was found out.
    impossible: Vertices,
}

/// What was added so far of what a vertex needs.
#[derive(Debug, Default)]
struct Added {
    vertices: Vec<Post>,
    quads: Vec<Quad>,
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
                impossible: Vertices::none(extent),
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
        let mut added = Added::default();
        let is_available = self.insert(post, &mut added);
        if !is_available {
            added.vertices.into_iter().for_each(|post| self.vertices.remove(post));
            added.quads.into_iter().for_each(|quad| *self.divided.of(quad) = false);
        }
        is_available
    }

    /// Adds a post and all that it needs; `false`: some of it cannot be, and the rest is still to be taken out.
    fn insert(&mut self, post: Post, added: &mut Added) -> bool {
        if self.available.as_ref().is_some_and(|available| available.impossible.contains(post)) {
            return false;
        }
        if !self.vertices.insert(post) {
            return true;
        }
        if self.available.is_some() {
            added.vertices.push(post);
        }
        let extent = self.extent;
        let is_possible = self.is_there(post)
            && extent.apexes(post).all(|apex| self.insert(apex, added))
            && finer_than(&extent, post).all(|quad| self.divide(quad, added))
            && extent.twin(post).is_none_or(|twin| self.insert(twin, added));
        if let Some(available) = self.available.as_mut().filter(|_| !is_possible) {
            available.impossible.insert(post);
        }
        is_possible
    }

    fn divide(&mut self, quad: Quad, added: &mut Added) -> bool {
        if std::mem::replace(self.divided.of(quad), true) {
            return true;
        }
        if self.available.is_some() {
            added.quads.push(quad);
        }
        let extent = self.extent;
        (quad.level >= extent.root || self.divide(quad.parent(), added))
            && corners_of_quarters(&extent, quad).all(|corner| self.insert(corner, added))
    }

    /// Whether all quads are there whose vertex a post is.
    fn is_there(&self, post: Post) -> bool {
        let level = self.extent.level_of(post);
        let is_there = |available: &Available| {
            self.extent.quads_at(level, post).all(|quad| available.borrowing.is_there(quad))
        };
        level > self.extent.root || self.available.as_ref().is_none_or(|available| is_there(available))
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
