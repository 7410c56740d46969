//! Meshes against what they must be, post by post.

mod exact;
mod globe;
mod sound;

use super::{Hierarchy, LodMesh, Post, RightTriangle};
use crate::scene::{Detail, Diagonal, LevelOfDetail, Posts};
use crate::space::{Plan, ViewFrame, Viewpoint, World};
use crate::terrain::{Grid, Lattice};
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// Numbers that look random.
struct Dice(u64);

impl Dice {
    /// The next one, below `n`.
    fn below(&mut self, n: u64) -> u64 {
        self.0 += 1;
        crate::math::scramble(self.0) % n
    }

    /// The next one, between two.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.below(1 << 30) as f64 / f64::from(1u32 << 30)
    }
}

/// A grid of posts three metres apart.
fn grid(columns: usize, rows: usize, height: impl Fn(u32, u32) -> f64) -> Lattice {
    let heights = (0..columns * rows).map(|k| height((k % columns) as u32, (k / columns) as u32));
    let steps = (DVec2::new(3.0, 0.25), DVec2::new(-0.5, 3.0));
    let posts = Posts::new((columns, rows), Plan::new(-100.0, 40.0), steps, heights.collect()).unwrap();
    Lattice::Plane(Arc::new(Grid::new(posts, Diagonal::Alternating).unwrap()))
}

/// Hills with a rough part in the west.
fn hills(i: u32, j: u32) -> f64 {
    let rough = crate::math::scramble(u64::from(i) << 32 | u64::from(j)) % 64;
    let wave = |at: u32, length: f64| crate::math::sin(f64::from(at) / length);
    20.0 * wave(i, 13.0) * wave(j, 29.0) + if i < 40 { rough as f64 / 16.0 } else { 0.0 }
}

/// The hills with holes: some posts, and a strip.
fn with_holes(i: u32, j: u32) -> f64 {
    let is_hole = (i * 7919 + j * 104_729).is_multiple_of(1511) || (90..97).contains(&j) && i > 60;
    if is_hole { f64::NAN } else { hills(i, j) }
}

/// Some view of the hills, near or far, from above or from the side.
fn view(dice: &mut Dice) -> ViewFrame {
    let mut at = |reach: f64| World::from(DVec3::from([(); 3].map(|()| dice.between(-reach, reach))));
    let (eye, target) = (at(600.0), at(250.0));
    let eye = World::new(eye.x, eye.y, 30.0 + eye.z.abs());
    let view = Viewpoint { eye, target, up: DVec3::new(0.01, 0.02, 1.0), near: 1.0, far: f64::INFINITY };
    match dice.below(4) {
        0 => ViewFrame::orthographic(&view, dice.between(50.0, 900.0), (90, 70)).unwrap(),
        _ => ViewFrame::perspective(&view, dice.between(10.0, 80.0), (90, 70)).unwrap(),
    }
}

fn within(error_px: f64, borrow: f64) -> LevelOfDetail {
    LevelOfDetail { detail: Detail::ErrorPx(error_px), borrow }
}

fn at_level(level: u32, borrow: f64) -> LevelOfDetail {
    LevelOfDetail { detail: Detail::Level(level), borrow }
}

/// The posts of a grid over a plane.
fn posts(mesh: &LodMesh) -> &Posts {
    let Lattice::Plane(grid) = mesh.lattice() else { panic!("a globe") };
    grid.posts()
}

/// The triangles of a mesh, sorted.
fn triangles(mesh: &LodMesh) -> Vec<RightTriangle> {
    let mut all: Vec<_> =
        (0..mesh.tin().triangles().len() as u32).map(|id| mesh.right_triangle(id)).collect();
    all.sort_unstable();
    all
}

/// Calls `visit` with a triangle and all that it can be split into.
fn for_each_below(triangle: RightTriangle, visit: &mut dyn FnMut(&RightTriangle)) {
    visit(&triangle);
    triangle.halves().into_iter().flatten().for_each(|half| for_each_below(half, visit));
}

/// The posts in a triangle, those of its sides too.
fn posts_in(triangle: &RightTriangle) -> Vec<Post> {
    let corners = triangle.corners().map(|post| post.map(i64::from));
    let range = |k: usize| {
        let at = corners.map(|post| post[k]);
        at.into_iter().min().unwrap()..=at.into_iter().max().unwrap()
    };
    let side =
        |a: [i64; 2], b: [i64; 2], p: [i64; 2]| (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
    let is_in = |p: &[i64; 2]| (0..3).all(|k| side(corners[k], corners[(k + 1) % 3], *p) >= 0);
    let all = range(1).flat_map(|j| range(0).map(move |i| [i, j]));
    all.filter(is_in).map(|post| post.map(|at| at as u32)).collect()
}
