//! The kernels give the same bits whatever vectors they are compiled for.

use super::{Facet, Lattice, Samples, Tile, TileView};
use crate::scene::{Diagonal, Posts, Surface};
use crate::space::{Plan, ViewFrame, Viewpoint, World};
use crate::terrain::Mesh;
use glam::{DVec2, DVec3};

fn mesh() -> Mesh {
    let heights = (0..31 * 31).map(|k| f64::from((k * 7919) % 101) / 60.0).collect();
    let posts = Posts::new((31, 31), Plan::new(-15.0, -15.0), (DVec2::X, DVec2::Y), heights).unwrap();
    Mesh::new(Surface::Grid(posts), Diagonal::SwNe).unwrap()
}

fn frame() -> ViewFrame {
    let view = Viewpoint {
        eye: World::new(3.0, -24.0, 14.0),
        target: World::new(0.0, 0.0, 0.0),
        up: DVec3::Z,
        near: 0.5,
        far: f64::INFINITY,
    };
    ViewFrame::perspective(&view, 60.0, (90, 70)).unwrap()
}

#[test]
fn a_triangle_fills_the_same_samples_with_plain_and_with_wide_arithmetic() {
    let (mesh, frame) = (mesh(), frame());
    let lattice = Lattice::centres(&frame, 0);
    let draw = |arch: pulp::Arch| {
        let mut samples = Samples::default();
        let mut tile = Tile::new(TileView::new(&frame, &lattice, (0, 0), 128), &mesh, &mut samples);
        tile.arch = arch;
        for id in 0..mesh.triangle_ids() {
            Facet::draw(&mut tile, id, &mesh.triangle(id).unwrap());
        }
        samples
    };
    let (plain, wide) = (draw(pulp::Arch::Scalar), draw(pulp::Arch::new()));
    assert_eq!(plain.ids, wide.ids);
    assert_eq!(plain.keys, wide.keys);
}

#[test]
fn a_patch_of_posts_draws_the_same_samples_with_plain_and_with_wide_arithmetic() {
    let (mesh, frame) = (mesh(), frame());
    let Mesh::Grid(grid) = &mesh else { panic!("a grid") };
    let lattice = Lattice::centres(&frame, 0);
    let draw = |arch: pulp::Arch| {
        let mut samples = Samples::default();
        let mut tile = Tile::new(TileView::new(&frame, &lattice, (0, 0), 128), &mesh, &mut samples);
        tile.arch = arch;
        mesh.for_each_child(mesh.root(), |leaf| {
            let bounds = mesh.bounds(leaf).unwrap();
            let reach = tile.view.reach_of(&bounds).unwrap();
            let patch = super::Patch::new(&tile.view, reach.depth, reach.size, &reach.rectangle()).unwrap();
            patch.draw_grid(&mut tile, grid, leaf);
        });
        samples
    };
    let (plain, wide) = (draw(pulp::Arch::Scalar), draw(pulp::Arch::new()));
    assert!(plain.ids.iter().any(|id| *id != crate::terrain::SKY));
    assert_eq!(plain.ids, wide.ids);
    assert_eq!(plain.keys, wide.keys);
}
