//! A triangulated irregular network: Delaunay triangles over scattered points (the sole user of spade).

use super::node::{Bounds, Node};
use crate::error::{Error, Result};
use crate::math;
use crate::parallel;
use crate::space::World;
use glam::DVec3;
use spade::{DelaunayTriangulation, HasPosition, InsertionError, Point2, Triangulation};
use std::ops::Range;

/// Triangles in a leaf of the hierarchy.
const CLUSTER: usize = 128;
/// Children of a node.
const FAN: usize = 4;

/// Triangles over scattered points, numbered along a space-filling curve.
#[derive(Debug, Clone)]
pub struct Tin {
    vertices: Vec<World>,
    triangles: Vec<[u32; 3]>,
    /// From the leaves up: the lowest and highest corner of each node.
    levels: Vec<Vec<(DVec3, DVec3)>>,
}

#[derive(Clone, Copy)]
struct Sample {
    at: World,
    index: u32,
}

impl HasPosition for Sample {
    type Scalar = f64;
    fn position(&self) -> Point2<f64> {
        Point2::new(self.at.x, self.at.y)
    }
}

/// What the triangulation could not take, in words.
fn refused(error: InsertionError) -> Error {
    let why = match error {
        InsertionError::TooSmall => "a coordinate is nearer to 0 than 1.8e-43, but not 0",
        InsertionError::TooLarge => "a coordinate is beyond 3e60",
        InsertionError::NAN => "a coordinate is not a number",
    };
    Error::new(format!("the points cannot be triangulated: {why}"))
}

impl Tin {
    /// The Delaunay triangulation of points; of points at the same place the last counts.
    ///
    /// # Errors
    /// When a coordinate is out of range, or the points span no triangle.
    pub fn new(points: Vec<World>) -> Result<Self> {
        if points.len() >= u32::MAX as usize / 2 {
            return Err(
                Error::new("more points than this program can number").help("give the terrain a `window`")
            );
        }
        let samples = points.iter().enumerate().map(|(i, &at)| Sample { at, index: i as u32 }).collect();
        let delaunay = DelaunayTriangulation::<Sample>::bulk_load_stable(samples).map_err(refused)?;
        let mut triangles: Vec<[u32; 3]> =
            delaunay.inner_faces().map(|f| f.vertices().map(|v| v.data().index)).map(from_lowest).collect();
        if triangles.is_empty() {
            return Err(Error::new("the points span no triangle")
                .help("at least three points off one line are needed"));
        }
        order_by_place(&points, &mut triangles);
        let levels = hierarchy(&points, &triangles);
        Ok(Self { vertices: points, triangles, levels })
    }

    /// The points.
    pub fn vertices(&self) -> &[World] {
        &self.vertices
    }

    /// The triangles as numbers of points, counter-clockwise.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The corners of a triangle.
    ///
    /// # Panics
    /// When there is no such triangle.
    #[inline]
    pub fn triangle(&self, id: u32) -> [World; 3] {
        self.triangles[id as usize].map(|v| self.vertices[v as usize])
    }

    /// The triangles of a leaf.
    pub fn leaf(&self, node: Node) -> Range<u32> {
        let first = node.x as usize * CLUSTER;
        first as u32..(first + CLUSTER).min(self.triangles.len()) as u32
    }

    pub(super) fn levels(&self) -> usize {
        self.levels.len()
    }

    pub(super) fn bounds(&self, node: Node) -> Option<Bounds> {
        let (low, high) = self.levels[node.level as usize][node.x as usize];
        let half = (high - low) / 2.0;
        Some(Bounds {
            center: World::from(low + half),
            axes: [DVec3::X * half.x, DVec3::Y * half.y, DVec3::Z * half.z],
        })
    }

    pub(super) fn for_each_child(&self, node: Node, mut visit: impl FnMut(Node)) {
        let level = node.level - 1;
        let end = (node.x as usize + 1) * FAN;
        for x in node.x as usize * FAN..end.min(self.levels[level as usize].len()) {
            visit(Node { level, x: x as u32, y: 0 });
        }
    }
}

/// The triangle turned so that its lowest number comes first: one form for each.
fn from_lowest([a, b, c]: [u32; 3]) -> [u32; 3] {
    if a < b && a < c {
        [a, b, c]
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

/// Sorts triangles along the Morton curve of their centroids, so that neighbours have near numbers.
fn order_by_place(points: &[World], triangles: &mut [[u32; 3]]) {
    let bounds = crate::space::PlanBox::around(points.iter().map(|p| p.plan()));
    let size = bounds.max - bounds.min;
    let scale = 65_535.0 / math::max(math::max(size.x, size.y), f64::MIN_POSITIVE);
    parallel::sort_by_key(triangles, |t| {
        let sum = t.map(|v| points[v as usize].plan() - bounds.min).into_iter().sum::<glam::DVec2>();
        let cell = sum / 3.0 * scale;
        (morton(cell.x as u32, cell.y as u32), *t)
    });
}

/// The bits of two 16-bit numbers in alternation.
fn morton(x: u32, y: u32) -> u32 {
    let spread = |v: u32| {
        let v = (v | v << 8) & 0x00ff_00ff;
        let v = (v | v << 4) & 0x0f0f_0f0f;
        let v = (v | v << 2) & 0x3333_3333;
        (v | v << 1) & 0x5555_5555
    };
    spread(x) | spread(y) << 1
}

fn hierarchy(points: &[World], triangles: &[[u32; 3]]) -> Vec<Vec<(DVec3, DVec3)>> {
    let around = |corners: &mut dyn Iterator<Item = (DVec3, DVec3)>| {
        let nothing = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        corners.fold(nothing, |(low, high), (l, h)| (low.min(l), high.max(h)))
    };
    let corner = |&v: &u32| (points[v as usize].to_vec(), points[v as usize].to_vec());
    let leaf = |c: &[[u32; 3]]| around(&mut c.iter().flatten().map(corner));
    let mut levels = vec![triangles.chunks(CLUSTER).map(leaf).collect::<Vec<_>>()];
    while let Some(top) = levels.last().filter(|l| l.len() > 1) {
        let next = top.chunks(FAN).map(|c| around(&mut c.iter().copied())).collect();
        levels.push(next);
    }
    levels
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_corners_and_a_middle_make_four_triangles() {
        let p = |x: f64, y: f64| World::new(x, y, x + y);
        let tin = Tin::new(vec![p(0.0, 0.0), p(4.0, 0.0), p(4.0, 4.0), p(0.0, 4.0), p(2.0, 2.0)]).unwrap();
        assert_eq!(tin.triangles().len(), 4);
        for t in 0..4 {
            let [a, b, c] = tin.triangle(t);
            assert!(crate::predicate::orient2d(a.plan(), b.plan(), c.plan()) > 0.0);
        }
    }

    #[test]
    fn points_on_one_line_are_refused() {
        let line: Vec<_> = (0..5).map(|k| World::new(f64::from(k), 0.0, 0.0)).collect();
        assert!(Tin::new(line).unwrap_err().to_string().contains("no triangle"));
    }
}
