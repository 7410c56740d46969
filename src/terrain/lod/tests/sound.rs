//! Meshes of random views: covered once, without cracks, within the error, of whole quads.

use super::*;
use crate::parallel;
use crate::terrain::lod::{CELLS, QuadInUse};
use std::collections::BTreeMap;

/// What a mesh must be whatever it was made for.
fn check(hierarchy: &Hierarchy, mesh: &LodMesh) {
    let covered = covered(mesh);
    edges(mesh, &covered);
    quads(hierarchy, mesh);
    for triangle in triangles(mesh) {
        assert!(triangle.corners().into_iter().all(|corner| mesh.has_vertex(corner)), "{triangle:?}");
        assert!(triangle.middle().is_none_or(|middle| !mesh.has_vertex(middle)), "{triangle:?}");
    }
}

/// The smallest triangles, each with the mesh's that lies over it: no two do, and none where a post is missing.
fn covered(mesh: &LodMesh) -> BTreeMap<RightTriangle, RightTriangle> {
    let posts = posts(mesh);
    let is_there = |[i, j]: Post| {
        let (i, j) = (i as usize, j as usize);
        i < posts.columns() && j < posts.rows() && !posts.heights()[j * posts.columns() + i].is_nan()
    };
    let mut covered = BTreeMap::new();
    for triangle in triangles(mesh) {
        assert!(posts_in(&triangle).into_iter().all(is_there), "{triangle:?} covers a hole");
        for_each_below(triangle, &mut |below| {
            if below.layer() == 0 {
                assert_eq!(covered.insert(*below, triangle), None, "{below:?} is covered twice");
            }
        });
    }
    covered
}

/// The posts between the ends of a side.
fn between(a: Post, b: Post) -> impl Iterator<Item = Post> {
    let length = a[0].abs_diff(b[0]).max(a[1].abs_diff(b[1]));
    let step = [0, 1].map(|k| (i64::from(b[k]) - i64::from(a[k])) / i64::from(length));
    (1..i64::from(length)).map(move |n| [0, 1].map(|k| (i64::from(a[k]) + n * step[k]) as u32))
}

/// No vertex lies on another triangle's side, and a side is one of two triangles or has none beyond.
fn edges(mesh: &LodMesh, covered: &BTreeMap<RightTriangle, RightTriangle>) {
    let mut sides: BTreeMap<[Post; 2], u32> = BTreeMap::new();
    for triangle in triangles(mesh) {
        let [a, b, c] = triangle.corners();
        for (from, to) in [(a, b), (b, c), (c, a)] {
            assert!(!between(from, to).any(|post| mesh.has_vertex(post)), "a vertex on {from:?} - {to:?}");
            *sides.entry([from.min(to), from.max(to)]).or_default() += 1;
        }
    }
    // The sides of smallest triangles that only one covered triangle has.
    let mut small: BTreeMap<[Post; 2], u32> = BTreeMap::new();
    for triangle in covered.keys() {
        let [a, b, c] = triangle.corners();
        for (from, to) in [(a, b), (b, c), (c, a)] {
            *small.entry([from.min(to), from.max(to)]).or_default() += 1;
        }
    }
    for ([from, to], count) in sides {
        let along: Vec<Post> = [from].into_iter().chain(between(from, to)).chain([to]).collect();
        let is_border = |pair: &[Post]| small.get(&[pair[0], pair[1]]) == Some(&1);
        match count {
            1 => assert!(along.windows(2).all(is_border), "{from:?} - {to:?} is open"),
            count => assert_eq!(count, 2, "{from:?} - {to:?}"),
        }
    }
}

/// Quads in use lie side by side, along the curve, and hold no vertex finer than theirs; each triangle lies in one of them.
fn quads(hierarchy: &Hierarchy, mesh: &LodMesh) {
    let extent = hierarchy.extent();
    let mut places = Vec::new();
    let mut area = 0;
    for QuadInUse { quad, data } in mesh.quads() {
        let [[west, south], [east, north]] = quad.corners();
        let below = |at: u32, last: u32| at.min(last) as usize;
        area +=
            (below(east, extent.last[0]) - west as usize) * (below(north, extent.last[1]) - south as usize);
        places.push(crate::index::morton(west / CELLS, south / CELLS));
        assert!(data.contains([west, south]) && data.contains([east, north]) && data.level >= quad.level);
        let vertices = (south..=north).flat_map(|j| (west..=east).map(move |i| [i, j]));
        let finest = vertices.filter(|post| mesh.has_vertex(*post)).map(|post| extent.level_of(post)).min();
        assert!(finest.is_none_or(|finest| finest >= data.level), "{quad:?} by {data:?} has {finest:?}");
    }
    assert!(places.is_sorted_by(|a, b| a < b), "{places:?}");
    assert_eq!(area, extent.last.into_iter().map(|last| last as usize).product::<usize>());
    for triangle in triangles(mesh) {
        let holds =
            |used: &&QuadInUse| triangle.corners().into_iter().all(|corner| used.quad.contains(corner));
        assert_eq!(mesh.quads().iter().filter(holds).count(), 1, "{triangle:?}");
    }
}

/// Every post that a view sees is within the error, seen from where it is.
fn check_seen(mesh: &LodMesh, view: &ViewFrame, error_px: f64) {
    let posts = posts(mesh);
    for id in 0..mesh.tin().triangles().len() as u32 {
        let [a, b, c] = mesh.tin().triangle(id);
        for [i, j] in posts_in(&mesh.right_triangle(id)) {
            let post = posts.world(i as usize, j as usize);
            let is_seen = view.screen_from_world(post).is_some_and(|at| {
                (0.0..=view.width() as f64).contains(&at.x) && (0.0..=view.height() as f64).contains(&at.y)
            });
            if !is_seen || view.depth(post) < view.near() {
                continue;
            }
            let p = post.plan();
            let across = |q: World, r: World| (q.plan() - p).perp_dot(r.plan() - p);
            let weights = [across(b, c), across(c, a), across(a, b)];
            let sum: f64 = weights.iter().sum();
            let height = (a.z * weights[0] + b.z * weights[1] + c.z * weights[2]) / sum;
            let off = (height - post.z).abs();
            assert!(off <= error_px * view.pixel_m(post) + 1e-9, "{off} at {i}, {j}");
            assert!(off <= mesh.deviation().metres + 1e-9, "{off} at {i}, {j}");
        }
    }
    assert!(mesh.deviation().pixels <= error_px * (1.0 + 1e-12), "{:?}", mesh.deviation());
}

#[test]
fn meshes_of_random_views_have_no_cracks_and_are_within_the_error() {
    let mut dice = Dice(11);
    for (columns, rows, height) in
        [(129, 129, hills as fn(u32, u32) -> f64), (150, 139, with_holes), (260, 40, hills)]
    {
        let hierarchy = Hierarchy::new(grid(columns, rows, height)).unwrap();
        for error_px in [0.7, 6.0] {
            let view = view(&mut dice);
            let mesh = hierarchy.mesh_for(&view, &within(error_px, 0.0));
            check(&hierarchy, &mesh);
            check_seen(&mesh, &view, error_px);
            let (count, all) = (triangles(&mesh).len(), 2 * (columns - 1) * (rows - 1));
            assert!(count < all, "{count} of {all}");
        }
    }
}

#[test]
fn a_mesh_of_borrowed_vertices_has_no_cracks_and_no_vertex_of_quads_that_are_not_there() {
    let hierarchy = Hierarchy::new(grid(300, 200, with_holes)).unwrap();
    let mut dice = Dice(5);
    let (mut borrowed, mut fine) = (0, 0);
    for (wanted, share) in [(Detail::ErrorPx(0.5), 0.3), (Detail::Level(0), 0.12), (Detail::Level(0), 0.15)] {
        let mesh = hierarchy.mesh_for(&view(&mut dice), &LevelOfDetail { detail: wanted, borrow: share });
        check(&hierarchy, &mesh);
        borrowed += mesh.quads().iter().filter(|used| used.data != used.quad).count();
        fine += mesh.quads().iter().filter(|used| used.data.level == 0).count();
    }
    assert!(borrowed > 0 && fine > 0, "{borrowed} borrowed, {fine} by their own finest vertices");
    // Nothing but the root is there.
    let mesh = hierarchy.mesh_for(&view(&mut dice), &within(0.1, 1.0));
    let root = hierarchy.extent().root;
    assert!(root > 0 && mesh.quads().iter().all(|used| used.data.level == root), "{:?}", mesh.quads());
    check(&hierarchy, &mesh);
}

#[test]
fn a_smaller_error_keeps_all_vertices_of_a_larger_one() {
    let hierarchy = Hierarchy::new(grid(150, 139, with_holes)).unwrap();
    for (seed, borrow) in [(1, 0.0), (2, 0.0), (3, 0.3)] {
        let view = view(&mut Dice(seed));
        let [coarse, fine] = [3.0, 0.8].map(|error| hierarchy.mesh_for(&view, &within(error, borrow)));
        let posts = (0..=256).flat_map(|j| (0..=256).map(move |i| [i, j]));
        let (mut lost, mut more) = (0, 0);
        for post in posts {
            lost += usize::from(coarse.has_vertex(post) && !fine.has_vertex(post));
            more += usize::from(fine.has_vertex(post) && !coarse.has_vertex(post));
        }
        assert!(lost == 0 && more > 0, "{lost} lost, {more} more");
    }
}

#[test]
fn without_error_there_are_all_triangles_of_the_grid_and_at_a_level_those_of_its_squares() {
    let lattice = grid(150, 139, with_holes);
    let Lattice::Plane(posts) = lattice.clone() else { panic!("a globe") };
    let hierarchy = Hierarchy::new(lattice).unwrap();
    let view = view(&mut Dice(8));
    let mesh = hierarchy.mesh_for(&view, &within(0.0, 0.0));
    let full = crate::terrain::Mesh::Grid(posts);
    let mut expected: Vec<[u32; 3]> = (0..full.triangle_ids()).filter_map(|id| full.corners(id)).collect();
    let number = |post: Post| post[1] * 150 + post[0];
    let mut found: Vec<[u32; 3]> = triangles(&mesh).iter().map(|t| t.corners().map(number)).collect();
    for all in [&mut expected, &mut found] {
        all.iter_mut().for_each(|corners| corners.sort_unstable());
        all.sort_unstable();
    }
    assert_eq!(found, expected);
    assert_eq!(mesh.deviation(), crate::terrain::lod::Deviation::default());

    let hierarchy = Hierarchy::new(grid(150, 139, hills)).unwrap();
    for level in [1, 3, 7] {
        let mesh = hierarchy.mesh_for(&view, &at_level(level, 0.0));
        let cells = [149 >> level, 138 >> level];
        let squares = (0..cells[1]).flat_map(|y| (0..cells[0]).map(move |x| [x, y]));
        let mut expected: Vec<_> =
            squares.flat_map(|cell| RightTriangle::of_cell(cell, 1 << level)).collect();
        expected.sort_unstable();
        assert_eq!(triangles(&mesh), expected, "level {level}");
        check_seen(&mesh, &view, f64::INFINITY);
    }
}

#[test]
fn any_number_of_threads_makes_the_same_mesh() {
    let view = view(&mut Dice(4));
    let [one, three] = [1, 3].map(|threads| {
        let made = parallel::with_threads(threads, || {
            let hierarchy = Hierarchy::new(grid(300, 150, with_holes)).unwrap();
            let mesh = hierarchy.mesh_for(&view, &within(1.0, 0.2));
            let corners: Vec<_> = mesh.tin().triangles().iter().map(|t| t.map(|v| mesh.post_of(v))).collect();
            (corners, mesh.quads().to_vec(), mesh.deviation())
        });
        made.unwrap()
    });
    assert_eq!(one, three);
}

#[test]
fn quarters_of_a_divided_quad_are_whole_triangles_though_one_alone_is_fine() {
    let hierarchy = Hierarchy::new(grid(257, 257, |i, j| f64::from([i, j] == [10, 11]))).unwrap();
    let down = Viewpoint {
        eye: World::new(300.0, 400.0, 500.0),
        target: World::new(300.0, 400.0, 0.0),
        up: DVec3::Y,
        near: 1.0,
        far: f64::INFINITY,
    };
    let view = ViewFrame::orthographic(&down, 2000.0, (50, 50)).unwrap();
    let mesh = hierarchy.mesh_for(&view, &within(0.001, 0.0));
    assert_eq!((mesh.quads().len(), triangles(&mesh).len() < 200), (4, true));
    quads(&hierarchy, &mesh);
}

#[test]
fn what_is_not_in_view_is_coarse() {
    let hierarchy = Hierarchy::new(grid(300, 300, hills)).unwrap();
    let eye = World::new(0.0, 100.0, 80.0);
    let view =
        Viewpoint { eye, target: World::new(-80.0, 60.0, 0.0), up: DVec3::Z, near: 1.0, far: f64::INFINITY };
    let view = ViewFrame::perspective(&view, 40.0, (400, 300)).unwrap();
    let mesh = hierarchy.mesh_for(&view, &within(0.5, 0.0));
    let coarsest = triangles(&mesh).iter().map(RightTriangle::layer).max();
    assert!(coarsest >= Some(12), "{coarsest:?}");
    assert!(mesh.deviation().pixels <= 0.5 && triangles(&mesh).len() < 60_000);
}
