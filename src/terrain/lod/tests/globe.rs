//! Meshes over globes: closed at the seam and the poles, within the bound in space, of the triangles that the full surface has.

use super::*;
use crate::math;
use crate::parallel;
use crate::scene::GlobePosts;
use crate::space::{Ellipsoid, Globe};
use crate::terrain::{GlobeMesh, Mesh, SurfaceTriangle, SurfaceVertex};
use std::collections::BTreeMap;

/// A ball that is a little flat, so large that hills of twenty metres are a part of its curvature.
const ELLIPSOID: Ellipsoid = Ellipsoid { a: 6000.0, f: 0.01 };

/// A globe of so many columns all around, and rows of which the outermost are `at_pole` cells from the poles; heights by column and row.
pub(super) fn world(
    [columns, rows]: [usize; 2],
    at_pole: f64,
    height: impl Fn(u32, u32) -> f64,
    is_closed: bool,
) -> Arc<GlobeMesh> {
    let globe =
        Globe { ellipsoid: ELLIPSOID, plan_origin: DVec2::ZERO, world_origin: DVec3::new(3.0, -2.0, 1.0) };
    let across = if is_closed { columns as f64 } else { 2.0 * columns as f64 };
    let steps = [globe.turn() / across, 0.5 * globe.turn() / (rows as f64 - 1.0 + 2.0 * at_pole)];
    let first = Plan::new(-0.5 * globe.turn(), -0.25 * globe.turn() + at_pole * steps[1]);
    let heights = (0..columns * rows).map(|k| height((k % columns) as u32, (k / columns) as u32)).collect();
    let posts =
        Posts::new((columns, rows), first, (DVec2::X * steps[0], DVec2::Y * steps[1]), heights).unwrap();
    let poles = [Some(7.0), Some(-2.0)].map(|pole| pole.filter(|_| is_closed));
    let posts = GlobePosts { posts, globe, is_closed, poles };
    Arc::new(GlobeMesh::new(posts, Diagonal::Alternating).unwrap())
}

/// From a place over the globe, in its radii, to a point near its middle.
fn from(eye: [f64; 3], fov_y_deg: f64) -> ViewFrame {
    let eye = World::from(DVec3::from(eye) * ELLIPSOID.a);
    let view = Viewpoint {
        eye,
        target: World::new(400.0, 900.0, -300.0),
        up: DVec3::Z,
        near: 1.0,
        far: f64::INFINITY,
    };
    ViewFrame::perspective(&view, fov_y_deg, (90, 70)).unwrap()
}

fn views() -> [ViewFrame; 4] {
    // The seam is at x < 0; one looks along the ground.
    let low = Viewpoint {
        eye: World::new(-6100.0, 30.0, 80.0),
        target: World::new(-6000.0, 2000.0, 900.0),
        up: -DVec3::X,
        near: 1.0,
        far: f64::INFINITY,
    };
    [
        from([-2.0, 0.3, 0.2], 50.0),
        from([0.1, -0.2, 1.4], 40.0),
        from([-0.4, 0.5, -2.5], 20.0),
        ViewFrame::perspective(&low, 60.0, (90, 70)).unwrap(),
    ]
}

fn corners(mesh: &LodMesh) -> impl Iterator<Item = [SurfaceVertex; 3]> + '_ {
    mesh.tin().triangles().iter().map(|triangle| triangle.map(|v| mesh.tin().vertex(v as usize)))
}

fn bits(world: World) -> [u64; 3] {
    // Zeros of both signs are one place.
    world.to_vec().to_array().map(|at| (at + 0.0).to_bits())
}

/// The sides of a mesh's triangles that have no other triangle beyond, told by their ends in space, to the bit.
fn open_sides(mesh: &LodMesh) -> usize {
    let mut sides: BTreeMap<([u64; 3], [u64; 3]), i32> = BTreeMap::new();
    for corners in corners(mesh) {
        let at = corners.map(|corner| bits(corner.world));
        for (from, to) in [(0, 1), (1, 2), (2, 0)] {
            assert_ne!(at[from], at[to]);
            let count = sides.entry((at[from], at[to])).or_default();
            *count += 1;
            assert_eq!(*count, 1, "one triangle on a side of an edge");
        }
    }
    sides.keys().filter(|(from, to)| !sides.contains_key(&(*to, *from))).count()
}

/// The posts in a triangle and, between three that are neighbours, some points of the full surface, each with its share of the triangle's corners.
fn places_in(triangle: &RightTriangle) -> Vec<[f64; 2]> {
    let posts = posts_in(triangle).into_iter().map(|post| post.map(f64::from));
    let mut all: Vec<[f64; 2]> = posts.collect();
    for_each_below(*triangle, &mut |below| {
        if below.layer() == 0 {
            let [a, b, c] = below.corners().map(|post| post.map(f64::from));
            all.extend(
                [[0.5, 0.25], [0.1, 0.6]]
                    .map(|[s, t]| [0, 1].map(|k| a[k] + s * (b[k] - a[k]) + t * (c[k] - a[k]))),
            );
        }
    });
    all
}

/// The point of the full surface at a place among the posts.
fn full_at(lattice: &Lattice, [x, y]: [f64; 2]) -> DVec3 {
    let last = lattice.size().map(|count| count as u32 - 2);
    let (i, j) = ((x as u32).min(last[0]), (y as u32).min(last[1]));
    let holds = |t: &RightTriangle| {
        let [a, b, c] = t.corners().map(|post| post.map(f64::from));
        let side = |p: [f64; 2], q: [f64; 2]| (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]) >= 0.0;
        side(a, b) && side(b, c) && side(c, a)
    };
    let of = RightTriangle::of_cell([i, j], 1).into_iter().find(holds).unwrap();
    on(&of, [x, y], of.corners().map(|post| lattice.vertex(post).world.to_vec()))
}

/// The point of a triangle at a place among the posts.
fn on(triangle: &RightTriangle, [x, y]: [f64; 2], [a, l, r]: [DVec3; 3]) -> DVec3 {
    let [apex, left, right] = triangle.corners().map(|post| post.map(f64::from));
    let leg = |end: [f64; 2]| {
        let [u, v] = [0, 1].map(|k| end[k] - apex[k]);
        (u * (x - apex[0]) + v * (y - apex[1])) / (u * u + v * v)
    };
    a + (l - a) * leg(left) + (r - a) * leg(right)
}

/// Checks that what a view sees of the full surface is as near as the mesh says, and no farther than so many pixels.
fn check_seen(mesh: &LodMesh, view: &ViewFrame, error_px: f64) -> usize {
    let lattice = mesh.lattice();
    let middle = -DVec3::new(3.0, -2.0, 1.0);
    let mut seen = 0;
    for (id, corners) in (0..).zip(corners(mesh)) {
        let triangle = mesh.right_triangle(id);
        let hull =
            crate::terrain::lod::hull::Hull { corners: corners.map(|corner| corner.world), reach: 0.0 };
        for place in places_in(&triangle) {
            let point = full_at(lattice, place);
            let at = World::from(point);
            let is_seen = view.screen_from_world(at).is_some_and(|at| {
                (0.0..=view.width() as f64).contains(&at.x) && (0.0..=view.height() as f64).contains(&at.y)
            });
            let is_near = (view.eye().to_vec() - point).dot(point - middle) > 0.0;
            if !is_seen || view.depth(at) < view.near() || !is_near {
                continue;
            }
            seen += 1;
            let off = hull.distance_from(at);
            assert!(off <= error_px * view.pixel_m(at) + 1e-9, "{off} at {place:?}");
            assert!(off <= mesh.deviation().metres + 1e-9, "{off} at {place:?}");
            // Away from the poles the same place of the plan is as near.
            if triangle.corners().iter().all(|post| !is_at_pole(lattice, *post)) {
                let own = on(&triangle, place, corners.map(|corner| corner.world.to_vec()));
                assert!((own - point).length() <= mesh.deviation().metres + 1e-9);
            }
        }
    }
    assert!(mesh.deviation().pixels <= error_px * (1.0 + 1e-12), "{:?}", mesh.deviation());
    seen
}

fn is_at_pole(lattice: &Lattice, [_, row]: Post) -> bool {
    let [south, north] = lattice.poles();
    south && row == 0 || north && row as usize == lattice.size()[1] - 1
}

#[test]
fn meshes_of_a_whole_globe_are_closed_at_the_seam_and_the_poles_and_within_the_error() {
    for (size, at_pole) in [([150, 71], 1.0), ([144, 72], 0.5)] {
        let hierarchy = Hierarchy::new(Lattice::Globe(world(size, at_pole, hills, true))).unwrap();
        for (view, error_px) in views().iter().zip([1.0, 0.6, 2.0, 1.0]) {
            let mesh = hierarchy.mesh_for(view, &within(error_px, 0.0));
            assert_eq!(open_sides(&mesh), 0);
            let all = 2 * size[0] * size[1];
            assert!(mesh.tin().triangles().len() < all * 9 / 10, "{} of {all}", mesh.tin().triangles().len());
            assert!(check_seen(&mesh, view, error_px) > 50);
        }
        for level in [1, 3, 6] {
            let mesh = hierarchy.mesh_for(&views()[0], &at_level(level, 0.0));
            assert_eq!((open_sides(&mesh), mesh.deviation().left_out), (0, 0), "level {level}");
        }
    }
}

#[test]
fn meshes_of_borrowed_vertices_are_closed_too() {
    let hierarchy = Hierarchy::new(Lattice::Globe(world([512, 255], 1.0, hills, true))).unwrap();
    let mesh = hierarchy.mesh_for(&views()[0], &within(0.05, 0.3));
    let borrowed = mesh.quads().iter().filter(|used| used.data != used.quad).count();
    assert!(borrowed > 0 && borrowed < mesh.quads().len(), "{:?}", mesh.quads());
    assert_eq!(open_sides(&mesh), 0);
}

#[test]
fn a_vertex_of_the_first_column_is_one_of_the_last() {
    let hierarchy = Hierarchy::new(Lattice::Globe(world([150, 71], 1.0, hills, true))).unwrap();
    for (view, borrow) in views().iter().zip([0.0, 0.2, 0.0, 0.1]) {
        let mesh = hierarchy.mesh_for(view, &within(1.0, borrow));
        let on_seam = (0..=72).filter(|row| mesh.has_vertex([0, *row])).count();
        assert!(on_seam > 10);
        assert!((0..=72).all(|row| mesh.has_vertex([0, row]) == mesh.has_vertex([150, row])));
    }
}

#[test]
fn without_error_there_are_the_triangles_of_all_posts() {
    for (is_closed, height) in [(true, with_holes as fn(u32, u32) -> f64), (false, hills), (true, hills)] {
        let globe = world([150, 71], 1.0, height, is_closed);
        let full = Mesh::Globe(Arc::clone(&globe));
        let mesh = Hierarchy::new(Lattice::Globe(globe)).unwrap().mesh_for(&views()[1], &within(0.0, 0.0));
        let of = |triangle: SurfaceTriangle| {
            let plan = triangle.plan().map(|at| [at.x, at.y].map(|at| (at * 1024.0).round() as i64));
            let mut all: Vec<_> = triangle.world.map(bits).into_iter().zip(plan).collect();
            all.sort_unstable();
            all
        };
        let mut expected: Vec<_> =
            (0..full.triangle_ids()).map(|id| of(full.surface_triangle(id).unwrap())).collect();
        let mut found: Vec<_> = corners(&mesh).map(|corners| of(SurfaceTriangle::between(corners))).collect();
        expected.sort_unstable();
        found.sort_unstable();
        assert!(found == expected, "{} and {} triangles", found.len(), expected.len());
        assert_eq!(mesh.deviation(), crate::terrain::lod::Deviation::default());
    }
}

#[test]
fn holes_at_the_seam_and_a_part_of_a_globe_stay_what_they_are() {
    let hole =
        |i: u32, j: u32| if !(4..148).contains(&i) && (20..26).contains(&j) { f64::NAN } else { hills(i, j) };
    for (is_closed, size) in [(true, [150, 71]), (false, [150, 40])] {
        let globe = world(size, if is_closed { 1.0 } else { 14.0 }, hole, is_closed);
        let hierarchy = Hierarchy::new(Lattice::Globe(globe)).unwrap();
        assert!(hierarchy.core().is_none(), "what lies behind may be seen");
        let view = &views()[0];
        let mesh = hierarchy.mesh_for(view, &within(1.0, 0.0));
        assert!(mesh.deviation().left_out == 0 && check_seen(&mesh, view, 1.0) > 300);
        let is_hole = |post: Post| mesh.lattice().height(post).is_nan();
        for id in 0..mesh.tin().triangles().len() as u32 {
            assert!(!posts_in(&mesh.right_triangle(id)).into_iter().any(is_hole));
        }
    }
}

#[test]
fn what_lies_beyond_the_horizon_is_coarse_and_nothing_that_is_seen() {
    let hierarchy = Hierarchy::new(Lattice::Globe(world([256, 127], 1.0, hills, true))).unwrap();
    let view = &views()[3];
    let mesh = hierarchy.mesh_for(view, &within(0.5, 0.0));
    let middle = DVec3::new(-3.0, 2.0, -1.0);
    let far = |corners: &[SurfaceVertex; 3]| {
        corners.iter().all(|corner| (corner.world.to_vec() - middle).dot(DVec3::new(-1.0, 0.3, 0.1)) < 1500.0)
    };
    let (beyond, this_side): (Vec<_>, Vec<_>) = corners(&mesh).partition(far);
    assert!(beyond.len() * 4 < this_side.len(), "{} beyond, {} this side", beyond.len(), this_side.len());
    assert!(check_seen(&mesh, view, 0.5) > 50);
}

#[test]
fn any_number_of_threads_makes_the_same_mesh_of_a_globe() {
    let [one, three] = [1, 3].map(|threads| {
        parallel::with_threads(threads, || {
            let hierarchy = Hierarchy::new(Lattice::Globe(world([300, 149], 1.0, with_holes, true))).unwrap();
            let mesh = hierarchy.mesh_for(&views()[0], &within(1.0, 0.2));
            let all: Vec<_> =
                corners(&mesh).map(|c| c.map(|corner| (bits(corner.world), corner.plan))).collect();
            (all, mesh.quads().to_vec(), mesh.deviation())
        })
        .unwrap()
    });
    assert!(one == three);
}

#[test]
fn a_chord_is_off_by_what_it_cuts_off_the_ellipsoid() {
    // A bare ball: along the equator a side of n cells is off by its sagitta.
    let hierarchy = Hierarchy::new(Lattice::Globe(world([256, 127], 1.0, |_, _| 0.0, true))).unwrap();
    let mesh = hierarchy.mesh_for(&views()[0], &at_level(4, 0.0));
    let sagitta = ELLIPSOID.a * (1.0 - math::cos(std::f64::consts::PI / 16.0));
    let metres = mesh.deviation().metres;
    // Both sides of a square, and its diagonal is no better.
    assert!(metres >= sagitta && metres < 3.0 * sagitta, "{metres} {sagitta}");
}

#[test]
fn a_level_of_detail_needs_no_triangle_of_the_full_surface() {
    let globe = world([300, 149], 1.0, hills, true);
    let hierarchy = Hierarchy::new(Lattice::Globe(Arc::clone(&globe))).unwrap();
    hierarchy.mesh_for(&views()[0], &within(1.0, 0.0));
    let (full, own) = (Mesh::Globe(globe), |at, plan| {
        Globe { ellipsoid: ELLIPSOID, plan_origin: DVec2::ZERO, world_origin: DVec3::new(3.0, -2.0, 1.0) }
            .distance_on_the_ground(at, plan)
    });
    let (most, bytes) = (full.most_deviation(own), full.bytes());
    let largest = full.largest_deviation(own);
    assert!(full.bytes() > 10 * bytes, "these are the first that asked for all triangles");
    assert!(largest <= most && most < 2.0 * largest, "{largest} {most}");
}
