//! The pictures of the corners of neighbouring triangles, each point's once.
//!
//! Input: vertices, some triangles as numbers of three. Output: [`Pictures`]. Refuses: nothing.
//!
//! Neighbours share corners: of 128 triangles, 384 corners, some 80 points. These are read once and projected together, in double precision, and rounded
//! to single precision.

use super::TileView;
use crate::space::World;

/// Triangles whose corners are found together.
pub(super) const TOGETHER: usize = 128;
/// They have no more points.
const MOST: usize = 3 * TOGETHER;
/// How many of the points that came last are recognized, by the last digits of their numbers.
const KNOWN: usize = 128;
/// No vertex has this number.
const NO_VERTEX: u32 = u32::MAX;

/// Tile coordinates and depth keys of the corners of some triangles.
pub(super) struct Pictures {
    x: [f32; MOST],
    y: [f32; MOST],
    key: [f32; MOST],
    /// Of each triangle the places of its corners.
    corners: [[u16; 3]; TOGETHER],
    /// Triangles.
    count: usize,
}

impl Pictures {
    /// No pictures.
    pub const NONE: Self =
        Self { x: [0.0; MOST], y: [0.0; MOST], key: [0.0; MOST], corners: [[0; 3]; TOGETHER], count: 0 };

    /// Those of the corners of no more than [`TOGETHER`] triangles.
    pub fn take(&mut self, view: &TileView, arch: pulp::Arch, vertices: &[World], triangles: &[[u32; 3]]) {
        let mut points = [World::default(); MOST];
        let mut known = [(NO_VERTEX, 0); KNOWN];
        let mut count = 0;
        for (places, numbers) in self.corners.iter_mut().zip(triangles) {
            for (place, number) in places.iter_mut().zip(numbers) {
                let last = &mut known[*number as usize % KNOWN];
                if last.0 != *number {
                    *last = (*number, count as u16);
                    points[count] = vertices[*number as usize];
                    count += 1;
                }
                *place = last.1;
            }
        }
        self.count = triangles.len().min(TOGETHER);
        arch.dispatch(Project { view, points: &points[..count], to: self });
    }

    /// Calls `set` with each of so many triangles from one on: its place among them, a corner's place in it, and the corner's picture.
    #[inline(always)]
    pub fn each(&self, (first, most): (usize, usize), mut set: impl FnMut(usize, usize, (f32, f32, f32))) {
        let own = &self.corners[first..self.count.min(first + most)];
        for (lane, places) in own.iter().enumerate() {
            for (corner, place) in places.iter().enumerate() {
                let at = *place as usize;
                set(lane, corner, (self.x[at], self.y[at], self.key[at]));
            }
        }
    }
}

/// Projects points; compiled for the widest vectors of the machine at hand.
struct Project<'a> {
    view: &'a TileView,
    points: &'a [World],
    to: &'a mut Pictures,
}

impl pulp::WithSimd for Project<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { view, points, to } = self;
        let is_parallel = view.is_parallel();
        let all = to.x.iter_mut().zip(&mut to.y).zip(&mut to.key).zip(points);
        for (((x, y), key), point) in all {
            let h = view.map_point(*point);
            let depth = view.depth(*point - view.frame.eye());
            *x = (h.x / h.z) as f32;
            *y = (h.y / h.z) as f32;
            *key = (if is_parallel { -depth } else { 1.0 / depth }) as f32;
        }
    }
}
