//! The kernels give the same bits whatever vectors they are compiled for; samples lie where they are said to, and no box that touches
//! one is left out.

use super::device::{Pipeline, clip_from_world};
use super::{Facet, Lattice, Samples, Tile, TileView};
use crate::scene::{Device, Diagonal, Posts, Surface};
use crate::space::{Plan, Screen, ViewFrame, Viewpoint, World};
use crate::terrain::{Bounds, Mesh};
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

#[test]
fn samples_lie_in_the_middles_of_equal_squares_and_where_they_are_asked_for() {
    let at = |lattice: &Lattice, [column, row]: [usize; 2]| {
        let at = lattice.at(column, row);
        [at.x, at.y]
    };
    let size = |lattice: &Lattice| [lattice.columns, lattice.rows];
    let four = Lattice::samples([3, 5], [2, 1], 4);
    assert_eq!((at(&four, [0, 0]), at(&four, [7, 3])), ([3.125, 5.125], [4.875, 5.875]));
    assert_eq!((size(&four), four.step), ([8, 4], 0.25));
    let one = Lattice::one_each([3, 5], [2, 1], [0.25, 0.75]);
    assert_eq!((at(&one, [0, 0]), at(&one, [1, 2]), size(&one)), ([3.25, 5.75], [4.25, 7.75], [2, 1]));
    let frame = frame();
    let centres = Lattice::centres(&frame, 2);
    assert_eq!((at(&centres, [0, 0]), at(&centres, [4, 1])), ([-1.5, -1.5], [2.5, -0.5]));
    assert_eq!(size(&centres), [94, 74]);
    let corners = Lattice::corners(&frame);
    assert_eq!((at(&corners, [0, 0]), size(&corners)), ([0.0, 0.0], [91, 71]));
}

#[test]
fn a_box_that_touches_the_outermost_sample_or_a_plane_is_kept_and_one_beside_is_not() {
    // A metre a pixel, without a rounding: samples 4 metres to each side, depths of 8 - z; near the origin and far from it.
    for east in [0.0, f64::from(1 << 20)] {
        let at = |p: DVec3| World::new(p.x + east, p.y, p.z);
        let (eye, target) = (at(DVec3::Z * 8.0), at(DVec3::ZERO));
        let view = Viewpoint { eye, target, up: DVec3::Y, near: 2.0, far: 14.0 };
        let frame = ViewFrame::orthographic(&view, 8.0, (8, 8)).unwrap();
        let tile = TileView::new(&frame, &Lattice::corners(&frame), (0, 0), 16);
        let half = 64.0;
        let is_kept = |center: DVec3| {
            let axes = [DVec3::X * half, DVec3::Y * half, DVec3::Z * half];
            tile.reach_of(&Bounds { center: at(center), axes }).is_some()
        };
        for (axis, reach) in [(DVec3::X, 4.0), (DVec3::Y, 4.0), (DVec3::Z, 6.0)] {
            for way in [axis, -axis] {
                assert!(is_kept(way * (reach + half)), "{way}");
                assert!(!is_kept(way * (reach + half + 1e-5)), "{way}");
            }
        }
    }
}

/// The same place and way to look, a near plane at half a metre, and a far plane.
fn frames(far: f64) -> [ViewFrame; 2] {
    let view = Viewpoint {
        eye: World::new(3.0, -24.0, 14.0),
        target: World::new(0.0, 0.0, 0.0),
        up: DVec3::Z,
        near: 0.5,
        far,
    };
    [ViewFrame::perspective(&view, 60.0, (90, 70)), ViewFrame::orthographic(&view, 30.0, (90, 70))]
        .map(|frame| frame.unwrap())
}

#[test]
fn an_imitated_machines_depth_runs_from_the_near_plane_to_the_far_one() {
    let (mesh, device) = (mesh(), Device::default());
    for frame in frames(64.0).into_iter().chain(frames(f64::INFINITY)) {
        let rows = clip_from_world(&frame, &mesh, &device);
        let depth_at = |depth: f64| {
            let p = (frame.eye() + frame.forward() * depth).to_vec();
            let of = |row: [f64; 4]| row[0] * p.x + row[1] * p.y + row[2] * p.z + row[3];
            of(rows[2]) / of(rows[3])
        };
        assert!((depth_at(0.5) - 1.0).abs() < 1e-12, "{}", depth_at(0.5));
        if frame.far().is_finite() {
            assert!(depth_at(64.0).abs() < 1e-12, "{}", depth_at(64.0));
        }
    }
    let [central, parallel] = frames(f64::INFINITY);
    assert_eq!(clip_from_world(&central, &mesh, &device)[2], [0.0, 0.0, 0.0, 0.5]);
    // A parallel lens has no depth for what is infinitely far: its far plane lies beyond the terrain.
    assert_ne!(clip_from_world(&parallel, &mesh, &device)[2][..3], [0.0; 3]);
}

#[test]
fn an_imitated_machine_finds_the_point_of_a_depth_and_none_in_the_sky() {
    let mesh = mesh();
    for frame in frames(64.0).into_iter().chain(frames(f64::INFINITY)) {
        let pipeline = Pipeline::<f64>::new(&frame, &mesh, &Device::default());
        let at = Screen::new(31.5, 44.25);
        let (point, depth) = pipeline.unproject(at, 0.125).unwrap();
        let seen = frame.screen_from_world(point).unwrap();
        assert!((seen.x - at.x).abs() < 1e-9 && (seen.y - at.y).abs() < 1e-9);
        assert!((frame.depth(point) - depth).abs() < 1e-9 * depth);
    }
    let [central, _] = frames(f64::INFINITY);
    let pipeline = Pipeline::<f64>::new(&central, &mesh, &Device::default());
    assert_eq!(pipeline.unproject(Screen::new(31.5, 44.25), pipeline.depth().cleared()), None);
}
