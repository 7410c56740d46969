//! What the filters leave is what exact arithmetic decides of every triangle at every sample; and they leave little of it to do.

use super::*;
use crate::raster::KEY_ERROR;
use crate::scene::{Diagonal, Posts, Surface};
use crate::space::{Plan, Viewpoint, World};
use crate::terrain::SurfaceVertex;
use glam::{DVec2, DVec3};

const DIAGONALS: [Diagonal; 3] = [Diagonal::SwNe, Diagonal::NwSe, Diagonal::Alternating];

/// Ground around the origin, 8 m wide, as rough with few large cells as with many small ones, with a hole.
fn ground(posts: usize, diagonal: Diagonal) -> Mesh {
    let cell = 8.0 / (posts - 1) as f64;
    let height =
        |k: usize| if k == posts + 2 { f64::NAN } else { f64::from((k * 7919 % 101) as u32) * cell / 120.0 };
    let heights = (0..posts * posts).map(height).collect();
    let (corner, steps) = (Plan::new(-4.0, -4.0), (DVec2::X * cell, DVec2::Y * cell));
    Mesh::new(Surface::Grid(Posts::new((posts, posts), corner, steps, heights).unwrap()), diagonal).unwrap()
}

/// The same as triangles of no grid.
fn triangles(of: &Mesh) -> Mesh {
    let level = |w: World| World::new(w.x, w.y, if w.z.is_nan() { 0.0 } else { w.z });
    let vertices = of.vertices().map(|vertex| SurfaceVertex::vertical(level(vertex.world))).collect();
    let corners = (0..of.triangle_ids()).filter_map(|id| of.corners(id)).collect();
    Mesh::of_surface(vertices, corners).unwrap()
}

fn views(size: (usize, usize)) -> Vec<ViewFrame> {
    let at = |eye: [f64; 3], near, far| Viewpoint {
        eye: World::new(eye[0], eye[1], eye[2]),
        target: World::new(0.1, -0.2, 0.3),
        up: DVec3::Z,
        near,
        far,
    };
    let (above, far_off) = (at([3.0, -7.0, 6.0], 0.5, f64::INFINITY), at([-40.0, -70.0, 30.0], 1.0, 1e4));
    let (cut, within) = (at([5.0, -6.0, 4.0], 6.0, 11.0), at([1.5, -2.0, 1.4], 1e-2, f64::INFINITY));
    let mut views: Vec<ViewFrame> =
        [above, cut, within].iter().map(|view| ViewFrame::perspective(view, 60.0, size).unwrap()).collect();
    views.push(ViewFrame::perspective(&far_off, 6.0, size).unwrap());
    views.extend([above, cut].iter().map(|view| ViewFrame::orthographic(view, 9.0, size).unwrap()));
    // Straight down, half a metre a pixel: posts and edges of ground with cells of whole halves lie on samples, or a hair beside.
    for hair in [0.0, 1e-7, -1e-7] {
        let (eye, target) = (World::new(hair, hair, 9.0), World::new(hair, hair, 0.0));
        let down = Viewpoint { eye, target, up: DVec3::Y, ..above };
        views.push(ViewFrame::orthographic(&down, size.1 as f64 / 2.0, size).unwrap());
    }
    views
}

/// Triangles and keys by exact arithmetic alone.
fn exactly(frame: &ViewFrame, lattice: &Lattice, mesh: &Mesh) -> (Vec<u32>, Vec<f32>) {
    let mut visible = Visible::new(lattice, 512);
    let only = &mut visible.tiles[0];
    let mut tile = Tile::new(TileView::new(frame, lattice, (0, 0), 512), mesh, &mut only.samples);
    for (r, c) in (0..lattice.rows).flat_map(|r| (0..lattice.columns).map(move |c| (r, c))) {
        (0..mesh.triangle_ids()).for_each(|id| tile.decide(c, r, id));
    }
    (visible.triangles(), visible.keys())
}

/// Draws it in tiles of several sizes and compares.
fn check(frame: &ViewFrame, lattice: &Lattice, mesh: &Mesh) {
    let (ids, keys) = exactly(frame, lattice, mesh);
    assert!(ids.iter().any(|id| *id != SKY));
    for tile in [7, 512] {
        let mut visible = Visible::new(lattice, tile);
        visible.see(frame, mesh);
        assert_eq!(visible.triangles(), ids);
        for (found, exact) in visible.keys().iter().zip(&keys) {
            let off = f64::from(*found) - f64::from(*exact);
            assert!(
                found == exact || off.abs() <= KEY_ERROR * f64::from(exact.abs()),
                "{found}, not {exact}"
            );
        }
    }
}

/// Grids with each diagonal, and triangles of no grid.
fn grounds(posts: usize) -> [Mesh; 4] {
    let [first, second, third] = DIAGONALS.map(|diagonal| ground(posts, diagonal));
    let scattered = triangles(&third);
    [first, second, third, scattered]
}

#[test]
fn triangles_of_several_samples_are_seen_where_exact_arithmetic_sees_them() {
    let meshes = grounds(5);
    for (k, frame) in views((20, 14)).iter().enumerate() {
        let lattices = [Lattice::centres(frame, k % 2), Lattice::corners(frame)];
        for (k, mesh) in meshes.iter().enumerate() {
            check(frame, &lattices[k % 2], mesh);
        }
    }
}

#[test]
fn triangles_of_about_a_sample_are_seen_where_exact_arithmetic_sees_them() {
    let meshes = grounds(17);
    for frame in views((8, 6)) {
        let lattices = [Lattice::corners(&frame), Lattice::samples([1, 1], [6, 4], 2)];
        for (k, mesh) in meshes.iter().enumerate() {
            check(&frame, &lattices[k % 2], mesh);
        }
    }
}

#[test]
fn few_samples_need_exact_arithmetic() {
    let size = (96, 72);
    let share = |frame: &ViewFrame, posts: usize, diagonal: Diagonal| {
        let mut visible = Visible::new(&Lattice::centres(frame, 0), TILE);
        visible.see(frame, &ground(posts, diagonal));
        visible.counts().exact_decisions as f64 / (size.0 * size.1) as f64
    };
    // Not those from straight above, made of ties.
    for (k, frame) in views(size)[..6].iter().enumerate() {
        let share = share(frame, 9, DIAGONALS[k % 3]);
        assert!(share < 0.17, "view {k}: {share}");
    }
    // Triangles smaller than a sample, and so far off that their depths are all but one.
    let (eye, target) = (World::new(-400.0, -700.0, 300.0), World::new(0.1, -0.2, 0.3));
    let view = Viewpoint { eye, target, up: DVec3::Z, near: 1.0, far: f64::INFINITY };
    let share = share(&ViewFrame::perspective(&view, 0.6, size).unwrap(), 129, Diagonal::SwNe);
    assert!(share < 0.17, "{share}");
}
